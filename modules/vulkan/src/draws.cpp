#include <gnomon/vulkan/draws.hpp>

#include <gnomon/math/scalar.hpp>

#include "draw_list.hpp"
#include "memory_barrier.hpp"
#include "stage_draws.hpp"

#include <algorithm>
#include <cstring>
#include <string>

namespace gnomon::vulkan {

namespace {

using detail::CallState;
using detail::CommandOrder;
using detail::DrawCommand;
using detail::Section;
using detail::record_barrier;

constexpr VkDeviceSize section_alignment = 256;  // The most that a device may ask of a storage buffer's offset.

constexpr int rank_of(CallState const& state) noexcept {
    return static_cast<int>(state.cull) * 2 + (state.masked ? 1 : 0);
}

CommandOrder order_of(std::vector<DrawCommand> commands) {
    CommandOrder order;
    order.commands = std::move(commands);
    for (std::size_t i = 0; i < order.commands.size(); ++i) {
        CallState const& state = order.commands[i].state;
        if (order.runs.empty() || !(order.runs.back().state == state))
            order.runs.push_back({state, static_cast<std::uint32_t>(i), 0});
        ++order.runs.back().count;
    }
    return order;
}

void make_orders(DrawList::State& state, std::vector<DrawCommand> const& given) {
    auto const less = [](DrawCommand const& a, DrawCommand const& b) { return rank_of(a.state) < rank_of(b.state); };
    std::vector<DrawCommand> sorted = given;
    std::stable_sort(sorted.begin(), sorted.end(), less);
    state.sorted = order_of(std::move(sorted));
    if (!std::is_sorted(given.begin(), given.end(), less)) state.in_order = order_of(given);
}

/// Gives out places of the static buffer, and fills them.
class Layout {
  public:
    Section add(std::size_t bytes) {
        Section const section{size_, std::max<VkDeviceSize>(bytes, 16)};
        size_ = (size_ + section.size + section_alignment - 1) / section_alignment * section_alignment;
        return section;
    }
    template <class T>
    Section add(std::vector<T> const& array) {
        return add(array.size() * sizeof(T));
    }
    [[nodiscard]] VkDeviceSize size() const noexcept { return size_; }

  private:
    VkDeviceSize size_ = 0;
};

template <class T>
void copy_to(std::span<std::byte> bytes, Section const& section, std::vector<T> const& array) {
    if (!array.empty()) std::memcpy(bytes.data() + section.offset, array.data(), array.size() * sizeof(T));
}

bool uses_indirect(Features const& features) noexcept {
    return features.multi_draw_indirect && features.draw_indirect_first_instance;
}

void lay_out(DrawList::State& state, Layout& layout, detail::StagedDraws const& staged) {
    state.bound[detail::binding_items] = layout.add(staged.items);
    state.bound[detail::binding_coordinates] = layout.add(staged.coordinates);
    state.bound[detail::binding_alpha_tests] = layout.add(staged.alpha_tests);
    state.bound[detail::binding_texels] = layout.add((staged.texels.size() + 3) / 4 * 4);
    state.bound[detail::binding_positions] = layout.add(staged.positions);
    state.bound[detail::binding_indices] = layout.add(staged.indices);
    state.bound[detail::binding_instances] = layout.add(staged.instances);
    if (!uses_indirect(state.pipelines->gpu()->features)) return;
    for (CommandOrder* order : {&state.sorted, &state.in_order}) {
        std::size_t const count = order->commands.size() * state.config.max_layers;
        order->indexed = layout.add(count * sizeof(VkDrawIndexedIndirectCommand));
        if (state.pipelines->pulls_ids()) order->pulled = layout.add(count * sizeof(VkDrawIndirectCommand));
    }
}

/// The commands of 1, 2, .. max_layers layers, one after the other.
void write_commands(std::span<std::byte> bytes, DrawList::State const& state, CommandOrder const& order) {
    std::byte* indexed = bytes.data() + order.indexed.offset;
    std::byte* pulled = bytes.data() + order.pulled.offset;
    for (std::uint32_t layers = 1; layers <= state.config.max_layers; ++layers)
        for (DrawCommand const& c : order.commands) {
            VkDrawIndexedIndirectCommand const command{c.corners, c.instances * layers,
                                                       state.first_index() + c.first_index,
                                                       static_cast<std::int32_t>(c.first_position),
                                                       c.first_item * layers};
            std::memcpy(indexed, &command, sizeof command);
            indexed += sizeof command;
            if (order.pulled.size == 0) continue;
            VkDrawIndirectCommand const plain{c.corners, c.instances * layers, 0, c.first_item * layers};
            std::memcpy(pulled, &plain, sizeof plain);
            pulled += sizeof plain;
        }
}

void write_all(DrawList::State const& state, detail::StagedDraws const& staged) {
    std::span<std::byte> const bytes = state.staging.mapped();
    copy_to(bytes, state.bound[detail::binding_items], staged.items);
    copy_to(bytes, state.bound[detail::binding_coordinates], staged.coordinates);
    copy_to(bytes, state.bound[detail::binding_alpha_tests], staged.alpha_tests);
    copy_to(bytes, state.bound[detail::binding_texels], staged.texels);
    copy_to(bytes, state.bound[detail::binding_positions], staged.positions);
    copy_to(bytes, state.bound[detail::binding_indices], staged.indices);
    copy_to(bytes, state.bound[detail::binding_instances], staged.instances);
    for (CommandOrder const* order : {&state.sorted, &state.in_order})
        if (order->indexed.size != 0) write_commands(bytes, state, *order);
}

Result<core::Done> check_limits(DrawList::State const& state, detail::StagedDraws const& staged) {
    Gpu const& gpu = *state.pipelines->gpu();
    VkPhysicalDeviceLimits const& limits = gpu.properties.limits;
    auto const too_large = [&](std::string const& what, std::uint64_t value, char const* name, std::uint64_t limit) {
        return core::Failure{Error::too_large, "a draw list with " + what + " " + std::to_string(value) + "; " +
                                                   gpu.properties.name + " has " + name + " " + std::to_string(limit) +
                                                   ": split it"};
    };
    for (std::uint32_t i = detail::binding_items; i < detail::binding_count; ++i) {
        if (state.bound[i].size > limits.maxStorageBufferRange)
            return too_large("an array of bytes:", state.bound[i].size, "maxStorageBufferRange",
                             limits.maxStorageBufferRange);
    }
    for (detail::PositionRange const& range : staged.ranges)
        if (range.count > 0 && range.count - 1 > limits.maxDrawIndexedIndexValue)
            return too_large("an index up to", range.count - 1, "maxDrawIndexedIndexValue",
                             limits.maxDrawIndexedIndexValue);
    if (staged.items.size() * state.config.max_layers > 0xFFFF'FFFFU)
        return too_large("instances times layers:", staged.items.size() * state.config.max_layers, "32 bits for them,",
                         0xFFFF'FFFFU);
    return core::Done{};
}

Result<core::Done> make_buffers(DrawList::State& state, Layout const& layout) {
    GpuRef const& gpu = state.pipelines->gpu();
    constexpr VkBufferUsageFlags storage = VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_TRANSFER_DST_BIT;
    constexpr VkBufferUsageFlags geometry =
        VK_BUFFER_USAGE_VERTEX_BUFFER_BIT | VK_BUFFER_USAGE_INDEX_BUFFER_BIT | VK_BUFFER_USAGE_INDIRECT_BUFFER_BIT;
    auto fixed = make_buffer(gpu, layout.size(), storage | geometry, MemoryUse::device);
    if (!fixed) return std::move(fixed).failure();
    auto staging = make_buffer(gpu, layout.size(), VK_BUFFER_USAGE_TRANSFER_SRC_BIT, MemoryUse::upload);
    if (!staging) return std::move(staging).failure();
    state.bound[detail::binding_views] = {0, detail::view_slot_bytes};
    VkDeviceSize const matrices = VkDeviceSize{state.instanced} * state.config.max_layers * sizeof(math::mat4);
    state.bound[detail::binding_matrices] = {detail::view_slots * detail::view_slot_bytes, std::max<VkDeviceSize>(matrices, 64)};
    Section const& last = state.bound[detail::binding_matrices];
    auto changing = make_buffer(gpu, last.offset + last.size, storage | VK_BUFFER_USAGE_UNIFORM_BUFFER_BIT,
                                MemoryUse::device);
    if (!changing) return std::move(changing).failure();
    state.fixed = *std::move(fixed);
    state.staging = *std::move(staging);
    state.changing = *std::move(changing);
    return core::Done{};
}

constexpr detail::BarrierHalf after_copy{VK_PIPELINE_STAGE_2_ALL_TRANSFER_BIT, VK_ACCESS_2_TRANSFER_WRITE_BIT};
constexpr detail::BarrierHalf before_draws{
    VK_PIPELINE_STAGE_2_ALL_GRAPHICS_BIT | VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT, VK_ACCESS_2_MEMORY_READ_BIT};

}  // namespace

DrawList::DrawList() noexcept = default;
DrawList::DrawList(std::unique_ptr<State> state) noexcept : state_(std::move(state)) {}
DrawList::DrawList(DrawList&&) noexcept = default;
DrawList& DrawList::operator=(DrawList&&) noexcept = default;
DrawList::~DrawList() = default;

std::uint64_t DrawList::triangles() const noexcept { return state_->triangles; }
StagedFaults const& DrawList::faults() const noexcept { return state_->faults; }
VkDeviceSize DrawList::size_bytes() const noexcept { return state_->fixed.size + state_->changing.size; }

void DrawList::release_staging() noexcept { state_->staging = Buffer{}; }

void DrawList::record_upload(VkCommandBuffer commands) {
    Gpu const& gpu = *state_->pipelines->gpu();
    GNOMON_EXPECT(state_->staging.handle);
    VkBufferCopy const all{0, 0, state_->fixed.size};
    gpu.call.CmdCopyBuffer(commands, state_->staging.handle.get(), state_->fixed.handle.get(), 1, &all);
    record_barrier(gpu, commands, after_copy, before_draws);
}

Result<std::uint64_t> record_update(VkCommandBuffer commands, DrawList& list, std::size_t draw,
                                    core::StridedSpan<math::vec3> const& positions, HostRing& ring) {
    DrawList::State const& state = list.state();
    if (draw >= state.positions.size() || positions.size() != state.positions[draw].count)
        return core::Failure{Error::bad_argument,
                             "record_update: draw " + std::to_string(draw) + " with " + std::to_string(positions.size()) +
                                 " positions, of a list of " + std::to_string(state.positions.size()) +
                                 " draws; they keep the number of positions that they were made with"};
    detail::PositionRange const& range = state.positions[draw];
    if (range.count == 0) return std::uint64_t{0};
    Gpu const& gpu = *state.pipelines->gpu();
    auto slice = ring.take(VkDeviceSize{range.count} * 12);
    if (!slice) return std::move(slice).failure();
    std::uint64_t not_finite = 0;
    for (std::size_t i = 0; i < positions.size(); ++i) {
        math::vec3 const p = positions[i];
        float const packed[3] = {p.x, p.y, p.z};
        std::memcpy(slice->bytes.data() + i * sizeof packed, packed, sizeof packed);
        not_finite += math::is_finite(p.x) && math::is_finite(p.y) && math::is_finite(p.z) ? 0U : 1U;
    }
    record_barrier(gpu, commands,
                   {VK_PIPELINE_STAGE_2_VERTEX_INPUT_BIT | VK_PIPELINE_STAGE_2_VERTEX_SHADER_BIT |
                        VK_PIPELINE_STAGE_2_ALL_TRANSFER_BIT,
                    VK_ACCESS_2_TRANSFER_WRITE_BIT},
                   {VK_PIPELINE_STAGE_2_ALL_TRANSFER_BIT, VK_ACCESS_2_TRANSFER_WRITE_BIT});
    VkBufferCopy const copy{slice->offset,
                            state.bound[detail::binding_positions].offset + VkDeviceSize{range.first} * 12,
                            VkDeviceSize{range.count} * 12};
    gpu.call.CmdCopyBuffer(commands, slice->buffer, state.fixed.handle.get(), 1, &copy);
    record_barrier(gpu, commands, after_copy, before_draws);
    return not_finite;
}

Result<DrawList> make_draw_list(PassPipelinesRef const& pipelines, std::span<backend::Draw const> draws,
                                DrawListConfig const& config) {
    if (config.max_layers == 0 || config.max_layers > detail::max_views)
        return core::Failure{Error::bad_argument, "DrawListConfig::max_layers is " + std::to_string(config.max_layers) +
                                                      "; 1 to " + std::to_string(detail::max_views) + " may be"};
    auto staged = detail::stage_draws(draws, pipelines->alpha_tests());
    if (!staged) return std::move(staged).failure();
    auto state = std::make_unique<DrawList::State>();
    state->pipelines = pipelines;
    state->config = config;
    state->instanced = static_cast<std::uint32_t>(staged->instances.size());
    state->has_instances = std::any_of(draws.begin(), draws.end(), [](backend::Draw const& d) { return d.instances.is_set(); });
    make_orders(*state, staged->commands);
    Layout layout;
    lay_out(*state, layout, *staged);
    if (auto fits = check_limits(*state, *staged); !fits) return std::move(fits).failure();
    if (auto made = make_buffers(*state, layout); !made) return std::move(made).failure();
    write_all(*state, *staged);
    Memory const& memory = state->staging.allocation.memory();
    if (auto flushed = flush(*pipelines->gpu(), memory, 0, layout.size()); !flushed)
        return std::move(flushed).failure();
    if (auto made = detail::make_set(*state); !made) return std::move(made).failure();
    state->positions = std::move(staged->ranges);
    state->command_of.assign(state->positions.size(), detail::none);
    for (std::size_t i = 0; i < state->sorted.commands.size(); ++i)
        state->command_of[state->sorted.commands[i].draw] = static_cast<std::uint32_t>(i);
    state->groups = std::move(staged->groups);
    state->triangles = staged->triangles;
    state->faults = staged->faults;
    if (pipelines->instances() == VK_NULL_HANDLE) state->instances = std::move(staged->instances);
    return DrawList(std::move(state));
}

}  // namespace gnomon::vulkan
