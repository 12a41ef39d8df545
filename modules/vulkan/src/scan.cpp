#include <gnomon/vulkan/scan.hpp>

#include <gnomon/vulkan/barrier.hpp>

#include "shaders/scan_apply_comp.hpp"
#include "shaders/scan_fill_comp.hpp"
#include "shaders/scan_sum_comp.hpp"

#include <algorithm>
#include <string>

namespace gnomon::vulkan {

namespace {

constexpr std::uint32_t max_levels = 3;
constexpr VkDeviceSize total_bytes = sizeof(ScanTotal);
/// Offsets in bindings are multiples of what no device asks to be more.
constexpr VkDeviceSize binding_step = 256;

struct ScanLevelConstants {
    std::uint32_t count;
    std::uint32_t stride;
    std::uint32_t has_bases;
};
struct FillConstants {
    std::uint32_t count;
    std::uint32_t capacity;
};

constexpr std::uint32_t tiles_of(std::uint32_t count) noexcept {
    return std::max(1U, (count + scan_tile_items - 1) / scan_tile_items);
}

constexpr VkDeviceSize level_bytes(std::uint32_t count) noexcept {
    return (tiles_of(count) * total_bytes + binding_step - 1) / binding_step * binding_step;
}

}  // namespace

Result<Scan> Scan::make(GpuRef const& gpu, std::uint32_t max_items) {
    if (max_items > max_scan_items)
        return core::Failure{Error::too_large, "a scan of " + std::to_string(max_items) + " numbers; there may be " +
                                                   std::to_string(max_scan_items)};
    Scan scan;
    scan.gpu_ = gpu;
    scan.max_items_ = max_items;
    struct Row {
        ComputeKernel& kernel;
        ComputeConfig config;
    };
    Row const rows[] = {
        {scan.sum_, {.name = "scan_sum", .spirv = scan_sum_comp, .buffers = 2, .targets = 0, .constant_bytes = 12}},
        {scan.apply_, {.name = "scan_apply", .spirv = scan_apply_comp, .buffers = 3, .targets = 0, .constant_bytes = 12}},
        {scan.fill_, {.name = "scan_fill", .spirv = scan_fill_comp, .buffers = 3, .targets = 0, .constant_bytes = 8}},
    };
    for (Row const& row : rows) {
        auto kernel = ComputeKernel::make(gpu, row.config);
        if (!kernel) return std::move(kernel).failure();
        row.kernel = *std::move(kernel);
    }
    VkDeviceSize const bytes = level_bytes(max_items) + level_bytes(tiles_of(max_items));
    auto scratch = make_buffer(gpu, bytes, VK_BUFFER_USAGE_STORAGE_BUFFER_BIT, MemoryUse::device);
    if (!scratch) return std::move(scratch).failure();
    scan.scratch_ = *std::move(scratch);
    return scan;
}

std::uint32_t Scan::levels_of(ScanCall const& call, Level* levels) const noexcept {
    std::uint32_t n = 0;
    VkDeviceSize at = 0;
    levels[0] = {call.count, call.values, call.sums, {}};
    while (tiles_of(levels[n].count) > 1) {
        std::uint32_t const tiles = tiles_of(levels[n].count);
        levels[n].totals = {scratch_.handle.get(), at, tiles * total_bytes};
        levels[n + 1] = {tiles, levels[n].totals, levels[n].totals, {}};
        at += level_bytes(levels[n].count);
        ++n;
    }
    levels[n].totals = call.total;
    return n + 1;
}

Result<core::Done> Scan::record(VkCommandBuffer commands, DescriptorRing& sets, ScanCall const& call) const {
    if (call.count > max_items_)
        return core::Failure{Error::too_large, "a scan of " + std::to_string(call.count) + " numbers was made for " +
                                                   std::to_string(max_items_)};
    Level levels[max_levels] = {};
    std::uint32_t const count = levels_of(call, levels);
    auto const dispatch = [&](ComputeKernel const& kernel, std::uint32_t l, bool has_bases,
                              std::span<VkDescriptorBufferInfo const> buffers) {
        ScanLevelConstants const constants{levels[l].count, l == 0 ? 1U : 2U, has_bases ? 1U : 0U};
        std::uint64_t const invocations = std::uint64_t{tiles_of(levels[l].count)} * compute_local_size;
        order_all(*gpu_, commands);
        return kernel.record(commands, sets, {invocations, buffers, {}, std::as_bytes(std::span(&constants, 1))});
    };
    for (std::uint32_t l = 0; l < count; ++l) {
        VkDescriptorBufferInfo const buffers[] = {levels[l].values, levels[l].totals};
        if (auto ok = dispatch(sum_, l, false, buffers); !ok) return ok;
    }
    if (call.count == 0) return core::Done{};
    for (std::uint32_t l = count; l-- > 0;) {
        bool const has_bases = l + 1 < count;
        VkDescriptorBufferInfo const buffers[] = {levels[l].values, levels[l].totals, levels[l].results};
        if (auto ok = dispatch(apply_, l, has_bases, buffers); !ok) return ok;
    }
    return core::Done{};
}

Result<core::Done> Scan::fill(VkCommandBuffer commands, DescriptorRing& sets, FillCall const& call) const {
    FillConstants const constants{call.count, call.capacity};
    VkDescriptorBufferInfo const buffers[] = {call.counts, call.offsets, call.list};
    order_all(*gpu_, commands);
    return fill_.record(commands, sets, {call.count, buffers, {}, std::as_bytes(std::span(&constants, 1))});
}

}  // namespace gnomon::vulkan
