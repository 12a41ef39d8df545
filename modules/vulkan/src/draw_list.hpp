#pragma once
// What a draw list holds: one buffer that stays as it was staged, one that passes write views and matrices into.

#include <gnomon/vulkan/draws.hpp>

#include "pass_layout.hpp"

#include <array>
#include <vector>

namespace gnomon::vulkan::detail {

/// Bytes of the static buffer.
struct Section {
    VkDeviceSize offset = 0;
    VkDeviceSize size = 0;
};

/// Sorted by culling and alpha test: what one call can draw.
struct CallState {
    backend::Cull cull = backend::Cull::none;
    bool masked = false;

    friend bool operator==(CallState const&, CallState const&) noexcept = default;
};

/// One draw, for one layer: a call of `layers` layers has so many times the instances, from item * layers on.
struct DrawCommand {
    std::uint32_t corners = 0;
    std::uint32_t first_index = 0;
    std::uint32_t first_position = 0;
    std::uint32_t first_item = 0;
    std::uint32_t instances = 1;
    std::uint32_t draw = 0;  ///< Its place among the caller's.
    CallState state;
};

/// Commands [first, first + count) that are drawn alike.
struct Run {
    CallState state;
    std::uint32_t first = 0;
    std::uint32_t count = 0;
};

/// The commands in one order, as spans of the staged ones: for each number of layers all commands.
struct CommandOrder {
    std::vector<DrawCommand> commands;
    std::vector<Run> runs;
    Section indexed;  ///< VkDrawIndexedIndirectCommand, max_layers times commands.size().
    Section pulled;   ///< VkDrawIndirectCommand; empty where ids need no pulling.
};

/// Triangles of the draws with the same groups.
struct GroupTriangles {
    std::uint64_t groups;
    std::uint64_t triangles;
};

struct PositionRange {
    std::uint32_t first;
    std::uint32_t count;
};

}  // namespace gnomon::vulkan::detail

namespace gnomon::vulkan {

struct DrawList::State {
    PassPipelinesRef pipelines;
    DrawListConfig config;
    Buffer fixed;
    Buffer staging;
    Buffer changing;  ///< View slots, then matrices.
    UniqueDescriptorPool pool;
    VkDescriptorSet set = VK_NULL_HANDLE;
    std::array<detail::Section, detail::binding_count> bound;  ///< Of `fixed`, or of `changing` (views, matrices).
    detail::CommandOrder sorted;    ///< By state: passes of depth alone, where order changes nothing.
    detail::CommandOrder in_order;  ///< As given: equal depths keep the first id. Empty where `sorted` is that order.
    std::vector<detail::PositionRange> positions;  ///< Of each draw.
    std::vector<std::uint32_t> command_of;          ///< Of each draw: its place in `sorted`, or none.
    std::vector<detail::GroupTriangles> groups;
    std::vector<math::mat4> instances;  ///< On the host where the device has no doubles.
    std::uint32_t instanced = 0;        ///< Number of instances that have a matrix.
    bool has_instances = false;         ///< Or a span of none.
    std::uint64_t triangles = 0;
    StagedFaults faults;
    std::uint32_t next_slot = 0;

    /// The index buffer is bound from its first byte on: lavapipe 22 forgets an offset in indirect draws.
    [[nodiscard]] std::uint32_t first_index() const noexcept {
        return static_cast<std::uint32_t>(bound[detail::binding_indices].offset / 4);
    }
    [[nodiscard]] detail::CommandOrder const& order(bool ids) const noexcept {
        return ids && !in_order.commands.empty() ? in_order : sorted;
    }
};

namespace detail {

/// The list's descriptor set, over its buffers.
[[nodiscard]] Result<core::Done> make_set(DrawList::State& state);

}  // namespace detail

}  // namespace gnomon::vulkan
