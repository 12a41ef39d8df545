// The kernels of the light tree: their C++ halves. The tree is that of lights::build_light_tree, to the bit.
// [Olsson 2014, Paper II, 3.3]

#include <shaders/light_codes_comp.hpp>
#include <shaders/light_items_comp.hpp>
#include <shaders/tree_leaves_comp.hpp>
#include <shaders/tree_nodes_comp.hpp>

#include "device_tree.hpp"

#include <gnomon/bvh/formula/code.glsl>
#include <gnomon/bvh/items.hpp>
#include <gnomon/lights/formula/assign.glsl>
#include <gnomon/lights/light.hpp>
#include <gnomon/math/bounds.hpp>
#include <gnomon/math/scalar.hpp>

#include <algorithm>
#include <array>
#include <atomic>
#include <cstddef>

namespace gnomon::pipeline {

namespace {

static_assert(sizeof(formula::GnLight) == sizeof(lights::Light) && offsetof(formula::GnLight, sin_half) == offsetof(lights::Light, sin_half) &&
              offsetof(formula::GnLight, kind) == offsetof(lights::Light, kind) && offsetof(formula::GnLight, layers) == offsetof(lights::Light, layers));

constexpr std::size_t node_grain = 512;

constexpr std::uint32_t padded_slots(std::uint32_t n) noexcept { return (n + tree_width - 1) / tree_width * tree_width; }

/// A centre and a radius; -1 if it takes no part.
using Ball = std::array<float, 4>;

std::uint32_t add_one(std::uint32_t& counter) noexcept {
    return std::atomic_ref<std::uint32_t>(counter).fetch_add(1, std::memory_order_relaxed);
}

void lower_half_center(std::int32_t& value, std::int32_t other) noexcept {
    std::atomic_ref<std::int32_t> const shared(value);
    std::int32_t now = shared.load(std::memory_order_relaxed);
    while (other < now && !shared.compare_exchange_weak(now, other, std::memory_order_relaxed)) {}
}

bool is_sound_for_tree(formula::GnLight const& l) noexcept {
    using Float = formula::Float<float>;
    bool const ball = l.kind < 2 && gn_is_sound_ball(formula::Vec3<float>(l.center), Float(l.range_m)).v;
    if (l.kind != 1) return ball;
    return ball && gn_is_sound_cone(formula::Vec3<float>(l.axis), Float(l.cos_half), Float(l.sin_half)).v;
}

void make_light_items(backend::KernelData const& data, std::size_t begin, std::size_t end) {
    auto const c = data.constant<LightItemsStd>();
    auto const lights = data.buffer<formula::GnLight const>(0);
    auto const balls = data.buffer<Ball>(1);
    auto const everywhere = data.buffer<std::uint32_t>(2);
    DeviceStateStd& state = data.buffer<DeviceStateStd>(3)[0];
    for (std::size_t i = begin; i < std::min<std::size_t>(end, c.count); ++i) {
        formula::GnLight const& l = lights[i];
        balls[i] = bvh::Spheres::nothing;
        if ((l.layers & c.layers) == 0) {
            add_one(state.masked);
        } else if (l.kind == 2) {
            everywhere[add_one(state.everywhere)] = static_cast<std::uint32_t>(i);
        } else if (!is_sound_for_tree(l)) {
            add_one(state.bad);
        } else {
            balls[i] = {l.center.x, l.center.y, l.center.z, l.range_m};
            add_one(state.usable);
            for (std::size_t axis = 0; axis < 3; ++axis) {
                std::int32_t const place = math::ordinal(balls[i][axis] * 0.5F);
                lower_half_center(state.places[axis], place);
                lower_half_center(state.places[axis + 3], -place);
            }
        }
    }
}

void lay_out_tree(DeviceStateStd& state) noexcept {
    bvh::Layout const layout = bvh::make_layout(state.usable, tree_width);
    state.levels = layout.levels;
    state.item_slots = layout.item_slots;
    state.node_slots = layout.node_slots;
    std::copy(layout.count.begin(), layout.count.end(), state.count);
    std::copy(layout.first.begin(), layout.first.end(), state.first);
}

void make_light_codes(backend::KernelData const& data, std::size_t begin, std::size_t end) {
    std::size_t const count = data.constant<std::uint32_t>();
    auto const balls = data.buffer<Ball const>(0);
    DeviceStateStd& state = data.buffer<DeviceStateStd>(1)[0];
    auto const pairs = data.buffer<std::array<std::uint32_t, 2>>(2);
    if (begin == 0) lay_out_tree(state);
    formula::GnCodeGrid grid{};
    grid.last = 1023.0F;
    for (math::axis_t axis = 0; axis < 3; ++axis) {
        grid.half_lo[axis] = math::from_ordinal(state.places[axis]);
        grid.scale[axis] = formula::gn_code_scale(grid.half_lo[axis], math::from_ordinal(-state.places[axis + 3]), 1024.0F);
    }
    for (std::size_t i = begin; i < std::min(end, count); ++i) {
        Ball const& b = balls[i];
        formula::Vec3<float> const half_center = formula::Vec3<float>(b[0], b[1], b[2]) * formula::Float<float>(0.5F);
        std::uint32_t const code = b[3] >= 0.0F ? formula::gn_code_30(grid, half_center).v : 1U << 30U;
        pairs[i] = {code, static_cast<std::uint32_t>(i)};
    }
}

void fill_tree_leaves(backend::KernelData const& data, std::size_t begin, std::size_t end) {
    auto const balls = data.buffer<Ball const>(0);
    auto const sorted = data.buffer<std::array<std::uint32_t, 2> const>(1);
    DeviceStateStd const& state = data.buffer<DeviceStateStd const>(2)[0];
    auto const items = data.buffer<float>(3);
    auto const ids = data.buffer<std::uint32_t>(4);
    for (std::size_t slot = begin; slot < std::min<std::size_t>(end, state.item_slots); ++slot) {
        Ball ball = bvh::Spheres::nothing;
        if (slot < state.usable) {
            ids[slot] = sorted[slot][1];
            ball = balls[ids[slot]];
        }
        for (std::size_t k = 0; k < 4; ++k) items[k * state.item_slots + slot] = ball[k];
    }
}

void bound_tree_nodes(backend::KernelData const& data, std::size_t begin, std::size_t end) {
    auto const level = data.constant<std::uint32_t>();
    DeviceStateStd const& state = data.buffer<DeviceStateStd const>(1)[0];
    if (level > state.levels) return;
    auto const nodes = data.buffer<float>(2);
    TreeBuffers const tree{data.buffer<float const>(0), nodes, state};
    for (std::size_t node = begin; node < std::min<std::size_t>(end, padded_slots(state.count[level])); ++node) {
        math::Aabb sum;
        std::size_t const last = node < state.count[level] ? std::min<std::size_t>((node + 1) * tree_width, state.count[level - 1]) : 0;
        for (std::size_t child = node * tree_width; child < last; ++child) {
            auto const box = level == 1 ? tree.item_box(child) : tree.node_box(level - 1, child);
            sum = math::extended(math::extended(sum, math::vec3(box.lo)), math::vec3(box.hi));
        }
        for (std::size_t axis = 0; axis < 3; ++axis) {
            nodes[axis * state.node_slots + state.first[level] + node] = sum.lo[static_cast<math::axis_t>(axis)];
            nodes[(axis + 3) * state.node_slots + state.first[level] + node] = sum.hi[static_cast<math::axis_t>(axis)];
        }
    }
}

}  // namespace

constinit backend::Kernel const light_items_kernel{.name = "light_items",
                                                   .cpu = &make_light_items,
                                                   .spirv = light_items_comp,
                                                   .buffers = 4,
                                                   .constant_bytes = sizeof(LightItemsStd),
                                                   .grain = 16384};
constinit backend::Kernel const light_codes_kernel{
    .name = "light_codes", .cpu = &make_light_codes, .spirv = light_codes_comp, .buffers = 3, .constant_bytes = 4, .grain = 16384};
constinit backend::Kernel const tree_leaves_kernel{
    .name = "tree_leaves", .cpu = &fill_tree_leaves, .spirv = tree_leaves_comp, .buffers = 5, .constant_bytes = 0, .grain = 16384};
constinit backend::Kernel const tree_nodes_kernel{
    .name = "tree_nodes", .cpu = &bound_tree_nodes, .spirv = tree_nodes_comp, .buffers = 3, .constant_bytes = 4, .grain = node_grain};

}  // namespace gnomon::pipeline
