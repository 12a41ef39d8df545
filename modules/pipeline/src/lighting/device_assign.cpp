// The kernels of assignment: their C++ halves. [Olsson 2014, Paper II, 3.4]

#include <shaders/assign_lights_comp.hpp>
#include <shaders/order_lists_comp.hpp>
#include <shaders/ready_lights_comp.hpp>

#include "device_layout.hpp"
#include "device_tree.hpp"

#include <gnomon/cluster/key.hpp>
#include <gnomon/cull/rows.hpp>
#include <gnomon/lights/formula/assign.glsl>
#include <gnomon/lights/lists.hpp>

#include <algorithm>
#include <array>
#include <atomic>
#include <cstddef>
#include <cstring>
#include <type_traits>

namespace gnomon::pipeline {

namespace {

/// What the predicate needs of a light.
struct ReadyLight {
    cull::ReadySpot spot;
    bool narrow;
};
static_assert(sizeof(ReadyLight) <= ready_words * 4 && std::is_trivially_copyable_v<ReadyLight>);

struct ReadyRecord {
    alignas(ReadyLight) std::byte bytes[ready_words * 4];
};

void make_ready_lights(backend::KernelData const& data, std::size_t begin, std::size_t end) {
    auto const c = data.constant<ReadyLightsStd>();
    auto const lights = data.buffer<formula::GnLight const>(0);
    auto const balls = data.buffer<std::array<float, 4> const>(1);
    auto const records = data.buffer<ReadyRecord>(2);
    bool const perspective = c.perspective != 0;
    for (std::size_t i = begin; i < std::min<std::size_t>(end, c.count); ++i) {
        if (!(balls[i][3] >= 0.0F)) continue;
        formula::GnLight const& l = lights[i];
        ReadyLight ready{};
        ready.narrow = gn_is_narrow_spot(l);
        cull::ReadyBall const ball = cull::ready_ball(l.center, l.range_m, perspective);
        if (ready.narrow) ready.spot = cull::ready_spot(ball, l.axis, l.cos_half, l.sin_half, perspective);
        else ready.spot.ready = ball;
        std::memcpy(records[i].bytes, &ready, sizeof ready);
    }
}

/// What `row_tables` writes, taken apart.
struct TableView {
    float const* numbers;
    AssignLightsStd const& c;

    [[nodiscard]] float left(std::uint32_t column) const noexcept { return numbers[column]; }
    [[nodiscard]] float right(std::uint32_t column) const noexcept { return numbers[c.columns + column]; }
    [[nodiscard]] formula::GnRowBorder<float> border(std::uint32_t j) const noexcept {
        float const* const at = numbers + 2 * std::size_t{c.columns} + j;
        std::size_t const step = c.rows + 1;
        return {at[0], at[step], at[2 * step]};
    }
    [[nodiscard]] formula::GnSlicePlane<float> plane(std::uint32_t k) const noexcept {
        float const* const at = numbers + 2 * std::size_t{c.columns} + 3 * (std::size_t{c.rows} + 1) + k;
        std::size_t const step = c.slices + 1;
        return {at[0], at[step], at[2 * step]};
    }
};

/// The buffers of assign_lights.
struct Assigning {
    AssignLightsStd const& c;
    DeviceLayout layout;
    DeviceStateStd const& state;
    TableView tables;
    TreeBuffers tree;
    std::span<std::uint32_t const> unique;
    std::span<ReadyRecord const> ready;
    std::span<std::uint32_t const> ids;
    std::span<std::uint32_t const> everywhere;

    /// Calls `found(light)` for the lights of a cluster, in no order that means anything.
    template <class F>
    void each_light(std::size_t cluster, F&& found) const {
        cluster::KeyParts const at = layout.parts(unique[cluster]);
        formula::Float<float> const left(tables.left(at.column));
        formula::Float<float> const right(tables.right(at.column));
        bool const perspective = c.perspective != 0;
        formula::GnRow<float> const row{tables.border(at.row), tables.border(at.row + 1), tables.plane(at.slice), tables.plane(at.slice + 1)};
        auto const box = gn_cluster_box(row, left, right, perspective);
        for (std::size_t i = 0; i < state.everywhere; ++i) found(everywhere[i]);
        visit(box, [&](std::size_t slot) {
            std::uint32_t const light = ids[slot];
            ReadyLight l;
            std::memcpy(&l, ready[light].bytes, sizeof l);
            cull::Span const span = l.narrow ? gn_spot_row(l.spot, row, perspective) : gn_ball_row(l.spot.ready, row, perspective);
            if (gn_touches(span, left, right).v) found(light);
        });
    }

  private:
    struct Node {
        std::uint32_t level;
        std::uint32_t index;
    };

    /// Calls `candidate(slot)` for items whose box a cluster's may touch.
    template <class F>
    void visit(formula::GnBox<float> const& box, F&& candidate) const {
        if (state.levels == 0) return;
        std::array<Node, bvh::max_levels * tree_width> stack;
        std::size_t depth = 0;
        stack[depth++] = {state.levels, 0};
        while (depth > 0) {
            Node const node = stack[--depth];
            std::uint32_t const end = std::min((node.index + 1) * tree_width, state.count[node.level - 1]);
            for (std::uint32_t child = node.index * tree_width; child < end; ++child) {
                if (node.level == 1) {
                    if (gn_may_hold(box, tree.item_box(child)).v) candidate(child);
                } else if (gn_may_hold(box, tree.node_box(node.level - 1, child)).v) {
                    stack[depth++] = {node.level - 1, child};
                }
            }
        }
    }
};

/// To `value`, if it is less.
void raise(std::uint32_t& number, std::uint32_t value) noexcept {
    std::atomic_ref<std::uint32_t> const shared(number);
    std::uint32_t held = shared.load(std::memory_order_relaxed);
    while (held < value && !shared.compare_exchange_weak(held, value, std::memory_order_relaxed)) {
    }
}

void assign_device_lights(backend::KernelData const& data, std::size_t begin, std::size_t end) {
    auto const c = data.constant<AssignLightsStd>();
    DeviceStateStd& state = data.buffer<DeviceStateStd>(0)[0];
    Assigning const work{c,
                         {{c.columns, c.rows, c.slices, c.cells, 0}, c.packed != 0},
                         state,
                         {data.buffer<float const>(2).data(), c},
                         {data.buffer<float const>(4), data.buffer<float const>(5), state},
                         data.buffer<std::uint32_t const>(1),
                         data.buffer<ReadyRecord const>(3),
                         data.buffer<std::uint32_t const>(6),
                         data.buffer<std::uint32_t const>(7)};
    auto const offsets = data.buffer<std::uint32_t>(8);
    auto const cells = data.buffer<lights::Cell>(9);
    auto const list = data.buffer<std::uint32_t>(10);
    for_each_group(begin, end, [&](std::size_t group) {
        for (std::size_t cluster = group; cluster < state.clusters; cluster += c.groups) {
            std::uint32_t count = 0;
            if (c.fill == 0) {
                work.each_light(cluster, [&](std::uint32_t) { ++count; });
                offsets[cluster] = count;
                raise(state.longest, count);
            } else {
                std::uint32_t const first = offsets[cluster];
                work.each_light(cluster, [&](std::uint32_t light) { list[first + count++] = light; });
                cells[cluster] = {first, count};
            }
        }
    });
}

void order_device_lists(backend::KernelData const& data, std::size_t begin, std::size_t end) {
    auto const c = data.constant<OrderListsStd>();
    if (c.first_step != 0) return;  // ordered at once
    DeviceStateStd const& state = data.buffer<DeviceStateStd const>(0)[0];
    auto const cells = data.buffer<lights::Cell const>(1);
    auto const list = data.buffer<std::uint32_t const>(2);
    auto const ordered = data.buffer<std::uint32_t>(3);
    for_each_group(begin, end, [&](std::size_t group) {
        for (std::size_t cluster = group; cluster < state.clusters; cluster += c.groups) {
            auto const from = list.subspan(cells[cluster].offset, cells[cluster].count);
            auto const to = ordered.subspan(cells[cluster].offset, cells[cluster].count);
            std::copy(from.begin(), from.end(), to.begin());
            std::sort(to.begin(), to.end());
        }
    });
}

}  // namespace

constinit backend::Kernel const ready_lights_kernel{.name = "ready_lights",
                                                    .cpu = &make_ready_lights,
                                                    .spirv = ready_lights_comp,
                                                    .buffers = 3,
                                                    .constant_bytes = sizeof(ReadyLightsStd),
                                                    .grain = 1024};
constinit backend::Kernel const assign_lights_kernel{.name = "assign_lights",
                                                     .cpu = &assign_device_lights,
                                                     .spirv = assign_lights_comp,
                                                     .buffers = 11,
                                                     .constant_bytes = sizeof(AssignLightsStd),
                                                     .grain = 4 * backend::kernel_local_size};
constinit backend::Kernel const order_lists_kernel{.name = "order_lists",
                                                   .cpu = &order_device_lists,
                                                   .spirv = order_lists_comp,
                                                   .buffers = 4,
                                                   .constant_bytes = sizeof(OrderListsStd),
                                                   .grain = 16 * backend::kernel_local_size};

}  // namespace gnomon::pipeline
