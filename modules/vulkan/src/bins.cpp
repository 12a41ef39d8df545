#include <gnomon/vulkan/bins.hpp>

#include <gnomon/vulkan/barrier.hpp>

#include "shaders/bin_count_comp.hpp"
#include "shaders/bin_lists_comp.hpp"
#include "shaders/bin_scatter_comp.hpp"

#include <algorithm>
#include <string>

namespace gnomon::vulkan {

namespace {

constexpr std::uint32_t digit_bits = 4;
constexpr std::uint32_t digits = 1U << digit_bits;

struct BinPassConstants {
    std::uint32_t count;
    std::uint32_t bins;
    std::uint32_t shift;
    std::uint32_t is_first;
};
struct BinListsConstants {
    std::uint32_t count;
    std::uint32_t bins;
    std::uint32_t capacity;
};

constexpr std::uint32_t bin_tiles(std::uint32_t count) noexcept {
    return (count + scan_tile_items - 1) / scan_tile_items;
}

VkDescriptorBufferInfo all_of(Buffer const& buffer) noexcept { return {buffer.handle.get(), 0, VK_WHOLE_SIZE}; }

}  // namespace

Result<BinLists> BinLists::make(GpuRef const& gpu, std::uint32_t max_items) {
    BinLists lists;
    lists.gpu_ = gpu;
    lists.max_items_ = max_items;
    if (max_items > max_scan_items)
        return core::Failure{Error::too_large, "lists of " + std::to_string(max_items) + " items; there may be " +
                                                   std::to_string(max_scan_items)};
    auto scan = Scan::make(gpu, digits * bin_tiles(max_items));
    if (!scan) return std::move(scan).failure();
    lists.scan_ = *std::move(scan);
    struct Row {
        ComputeKernel& kernel;
        ComputeConfig config;
    };
    Row const rows[] = {
        {lists.count_, {.name = "bin_count", .spirv = bin_count_comp, .buffers = 2, .targets = 0, .constant_bytes = 16}},
        {lists.scatter_,
         {.name = "bin_scatter", .spirv = bin_scatter_comp, .buffers = 3, .targets = 0, .constant_bytes = 16}},
        {lists.lists_, {.name = "bin_lists", .spirv = bin_lists_comp, .buffers = 3, .targets = 0, .constant_bytes = 12}},
    };
    for (Row const& row : rows) {
        auto kernel = ComputeKernel::make(gpu, row.config);
        if (!kernel) return std::move(kernel).failure();
        row.kernel = *std::move(kernel);
    }
    struct Room {
        Buffer& buffer;
        VkDeviceSize words;
    };
    VkDeviceSize const pair_words = VkDeviceSize{std::max(max_items, 1U)} * 2;
    Room const rooms[] = {{lists.pairs_[0], pair_words},
                          {lists.pairs_[1], pair_words},
                          {lists.counts_, VkDeviceSize{digits} * std::max(bin_tiles(max_items), 1U)},
                          {lists.total_, 2}};
    for (Room const& room : rooms) {
        auto buffer = make_buffer(gpu, room.words * 4, VK_BUFFER_USAGE_STORAGE_BUFFER_BIT, MemoryUse::device);
        if (!buffer) return std::move(buffer).failure();
        room.buffer = *std::move(buffer);
    }
    return lists;
}

VkDescriptorBufferInfo BinLists::pairs(std::uint32_t passes) const noexcept { return all_of(pairs_[passes % 2]); }

Result<core::Done> BinLists::sort(VkCommandBuffer commands, DescriptorRing& sets, BinCall const& call,
                                  std::uint32_t shift) const {
    std::uint32_t const pass = shift / digit_bits;
    BinPassConstants const constants{call.count, call.bins, shift, pass == 0 ? 1U : 0U};
    auto const bytes = std::as_bytes(std::span(&constants, 1));
    std::uint64_t const invocations = std::uint64_t{bin_tiles(call.count)} * compute_local_size;
    VkDescriptorBufferInfo const from = pass == 0 ? call.bin_of_item : pairs(pass);
    VkDescriptorBufferInfo const counts = all_of(counts_);
    VkDescriptorBufferInfo const counted[] = {from, counts};
    order_all(*gpu_, commands);
    if (auto ok = count_.record(commands, sets, {invocations, counted, {}, bytes}); !ok) return ok;
    ScanCall const scan{digits * bin_tiles(call.count), counts, counts, all_of(total_)};
    if (auto ok = scan_.record(commands, sets, scan); !ok) return ok;
    VkDescriptorBufferInfo const moved[] = {from, counts, pairs(pass + 1)};
    order_all(*gpu_, commands);
    return scatter_.record(commands, sets, {invocations, moved, {}, bytes});
}

Result<core::Done> BinLists::record(VkCommandBuffer commands, DescriptorRing& sets, BinCall const& call) const {
    if (call.count > max_items_ || call.bins > max_bins)
        return core::Failure{Error::too_large, "lists of " + std::to_string(call.count) + " items in " +
                                                   std::to_string(call.bins) + " bins; there may be " +
                                                   std::to_string(max_items_) + " and " + std::to_string(max_bins)};
    std::uint32_t passes = 0;
    // The items in no bin sort as bin `bins`, which counts too.
    if (call.count > 0)
        for (std::uint32_t shift = 0; shift == 0 || call.bins >> shift != 0; shift += digit_bits, ++passes)
            if (auto ok = sort(commands, sets, call, shift); !ok) return ok;
    BinListsConstants const constants{call.count, call.bins, call.capacity};
    VkDescriptorBufferInfo const buffers[] = {pairs(passes), call.begins, call.list};
    std::uint64_t const invocations = std::max<std::uint64_t>(call.count, std::uint64_t{call.bins} + 1);
    order_all(*gpu_, commands);
    return lists_.record(commands, sets, {invocations, buffers, {}, std::as_bytes(std::span(&constants, 1))});
}

}  // namespace gnomon::vulkan
