#include "plan.hpp"

#include <algorithm>

namespace gnomon::raster::detail {

namespace {

constexpr std::int64_t streamed_pixels = std::int64_t{1} << 23U;  // 32 MiB of depth
constexpr std::size_t item_grain = 256;

void set_scissor(LayerPlan& plan, Rect const& scissor, Rect const& whole) {
    auto const end = [](std::int32_t at, std::int32_t size, std::int32_t limit) {
        return static_cast<std::int32_t>(std::min<std::int64_t>(std::int64_t{at} + std::max(size, 0), limit));
    };
    plan.x0 = std::max(scissor.x, 0);
    plan.y0 = std::max(scissor.y, 0);
    plan.x1 = end(scissor.x, scissor.width, whole.width);
    plan.y1 = end(scissor.y, scissor.height, whole.height);
}

/// How far into a cache line the image's rows begin: with the grid shifted by it, tiles are whole lines.
std::int32_t columns_past_a_line(ImageView<float> const& image) {
    auto const address = reinterpret_cast<std::uintptr_t>(image.data);
    return image.stride % 16 == 0 ? static_cast<std::int32_t>(address % 64 / sizeof(float)) : 0;
}

/// One that works in rows, as all of a tile's callers understand.
KernelTable const& kernel_of(Kernel kind) {
    KernelTable const* const simd = kind == Kernel::scalar ? nullptr : avx2_kernel();
    return simd != nullptr ? *simd : scalar_kernel();
}

/// Whether tiles can hand out their blocks as they are stored: whole blocks, all of them drawn by this pass.
bool hands_out_blocks(LayerPlan const& plan, Layer const& layer) {
    return layer.config.pyramid != nullptr && layer.config.load == Load::clear && plan.grid.shift_x % 8 == 0 &&
           plan.x0 == 0 && plan.y0 == 0 && plan.x1 == layer.target.width() && plan.y1 == layer.target.height();
}

/// returns: whether anything can be drawn: some pixels, and a viewport.
bool begin_layer(LayerPlan& plan, Layer const& layer) {
    Rect const whole{0, 0, layer.target.width(), layer.target.height()};
    GNOMON_EXPECT(whole.width <= max_size_px && whole.height <= max_size_px);
    GNOMON_EXPECT(layer.triangle.data == nullptr ||
                  (layer.triangle.width == whole.width && layer.triangle.height == whole.height));
    PassConfig const& config = layer.config;
    plan.layer = &layer;
    plan.kernel = &kernel_of(config.kernel);
    set_scissor(plan, config.scissor.value_or(whole), whole);
    if (plan.is_empty()) return false;
    plan.streams = plan.kernel->stream != nullptr && !layer.target.is_unorm16() &&
                   std::int64_t{whole.width} * whole.height >= streamed_pixels;
    std::int32_t shift = plan.streams ? columns_past_a_line(layer.target.f32()) : 0;
    // A pyramid's blocks must lie within tiles: worth more than stores past the caches.
    if (config.pyramid != nullptr && shift % 8 != 0) shift = 0;
    plan.grid = make_bin_grid(whole.width, whole.height, shift);
    plan.summarizes = hands_out_blocks(plan, layer);
    if (plan.summarizes) config.pyramid->fit(layer.target, config.depth);
    Rect const viewport = config.viewport.value_or(whole);
    if (viewport.width <= 0 || viewport.height <= 0) return false;
    plan.viewport = make_viewport(viewport, config.range == DepthRange::clip);
    plan.viewport.offset_x += config.subpixel.x;
    plan.viewport.offset_y += config.subpixel.y;
    return true;
}

/// Which positions to transform: all, or those that few indices into a large buffer name.
CornerRange corner_range(Draw const& draw) {
    std::size_t const size = std::min<std::size_t>(draw.positions.size(), ~0U);
    if (draw.indices.empty() || draw.indices.size() >= size) return {0, static_cast<std::uint32_t>(size)};
    std::uint32_t low = ~0U;
    std::uint32_t high = 0;
    for (std::size_t i = 0; i < draw.indices.size(); ++i) {
        std::uint32_t const index = draw.indices[i];
        if (index >= size) continue;
        low = std::min(low, index);
        high = std::max(high, index);
    }
    return low <= high ? CornerRange{low, high - low + 1} : CornerRange{0, 0};
}

void set_view(VertexJob& vertex, math::vec3 const& origin, math::mat4 const& clip_from_relative) {
    for (math::axis_t axis = 0; axis < 3; ++axis) vertex.origin[axis] = origin[axis];
    for (math::axis_t row = 0; row < 4; ++row)
        for (math::axis_t column = 0; column < 4; ++column) vertex.row[row][column] = clip_from_relative[column][row];
}

VertexJob make_vertex_job(LayerPlan const& layer, Draw const& draw, std::size_t instance) {
    ViewportTransform const& v = layer.viewport;
    VertexJob job{.positions = reinterpret_cast<unsigned char const*>(draw.positions.data()),
                  .stride = draw.positions.stride_bytes(),
                  .origin = {},
                  .row = {},
                  .half_width = v.half_width_px,
                  .half_height = v.half_height_px,
                  .offset_x = v.offset_x,
                  .offset_y = v.offset_y,
                  .guard_x = v.guard_x,
                  .guard_y = v.guard_y,
                  .clip_depth = v.clip_depth};
    math::vec3 const& origin = layer.draws_own_view ? draw.origin : layer.layer->origin;
    math::mat4 const& matrix = layer.draws_own_view ? draw.clip_from_relative : layer.layer->clip_from_relative;
    if (draw.instances.is_set())
        set_view(job, math::vec3(0.0F), clip_from_instance(matrix, origin, draw.instances[instance]));
    else
        set_view(job, origin, matrix);
    return job;
}

SetupJob make_setup_job(LayerPlan const& layer, Draw const& draw, CornerRange const& range) {
    SetupJob job{};
    job.index32 = draw.indices.wide();
    job.index16 = draw.indices.narrow();
    job.first_corner = range.first;
    job.corner_count = range.count;
    job.facing = draw.cull == Cull::none   ? Facing::any
                 : draw.cull == Cull::back ? Facing::negative_only
                                           : Facing::positive_only;
    job.x0 = layer.x0;
    job.y0 = layer.y0;
    job.x1 = layer.x1;
    job.y1 = layer.y1;
    return job;
}

void make_item(Plan& plan, Draw const& draw, Group const& group, std::size_t i) {
    std::size_t const instance = i - group.first_item;
    LayerPlan const& layer = plan.layers[group.layer];
    Item& item = plan.items.data()[i];
    item.vertex = make_vertex_job(layer, draw, instance);
    item.setup = make_setup_job(layer, draw, plan.ranges[group.draw]);
    item.setup.vertex = &item.vertex;
    item.setup.id_base = draw.first_triangle + static_cast<std::uint32_t>(instance * group.triangles);
    item.first_triangle = group.first_triangle + instance * group.triangles;
    item.triangles = group.triangles;
    item.first_corner = 0;
    item.kernel = layer.kernel;
    if (group.first_masked == 0) return;
    std::size_t const masked = group.first_masked + instance;
    plan.masked[masked - 1] = make_masked_draw(*draw.alpha_test, item.vertex, draw.indices, item.setup.id_base);
    item.setup.tag = static_cast<std::uint32_t>(masked) << 1U;
}

/// The groups of a layer, and its triangles' places in the pass.
void plan_layer(Plan& plan, std::span<Draw const> draws, std::size_t l) {
    LayerPlan& layer = plan.layers[l];
    PassStats& stats = plan.stats[l];
    bool const visible = begin_layer(layer, *layer.layer);
    layer.first_triangle = plan.triangles;
    for (std::size_t d = 0; d < draws.size(); ++d) {
        Draw const& draw = draws[d];
        std::size_t const each = triangle_count(draw);
        std::size_t const instances = draw.instances.size();
        if ((draw.groups & layer.layer->groups) == 0 && !layer.draws_own_view) continue;
        if (each == 0 || instances == 0) continue;
        stats.triangles += each * instances;
        if (!visible) continue;
        bool const masked = draw.alpha_test != nullptr && is_complete(*draw.alpha_test, draw.positions.size());
        plan.groups.push_back({plan.item_count, plan.triangles, each, static_cast<std::uint32_t>(d),
                               static_cast<std::uint32_t>(l),
                               masked ? static_cast<std::uint32_t>(plan.masked.size() + 1) : 0});
        if (masked) plan.masked.resize(plan.masked.size() + instances);
        plan.item_count += instances;
        plan.triangles += each * instances;
    }
    layer.end_triangle = plan.triangles;
    if (!visible) stats.outside = stats.triangles;
}

}  // namespace

void make_plan(Plan& plan, std::span<Draw const> draws, std::span<Layer const> layers, bool draws_own_view,
               core::ExecutorRef executor) {
    plan.layers.assign(layers.size(), LayerPlan{});
    plan.stats.assign(layers.size(), PassStats{});
    plan.groups.clear();
    plan.masked.clear();
    plan.ranges.resize(draws.size());
    plan.item_count = plan.triangles = plan.pixels = 0;
    executor.parallel_for(draws.size(), 1, [&](std::size_t begin, std::size_t end) {
        for (std::size_t d = begin; d < end; ++d) plan.ranges[d] = corner_range(draws[d]);
    });
    for (std::size_t l = 0; l < layers.size(); ++l) {
        plan.layers[l].layer = &layers[l];
        plan.layers[l].draws_own_view = draws_own_view;
        plan.pixels += static_cast<std::size_t>(std::max(layers[l].target.width(), 0)) *
                       static_cast<std::size_t>(std::max(layers[l].target.height(), 0));
        plan_layer(plan, draws, l);
    }
    plan.items.fit(plan.item_count);
    executor.parallel_for(plan.item_count, item_grain, [&](std::size_t begin, std::size_t end) {
        auto const after = std::upper_bound(plan.groups.begin(), plan.groups.end(), begin,
                                            [](std::size_t i, Group const& g) { return i < g.first_item; });
        auto group = after - (begin < end ? 1 : 0);
        for (std::size_t i = begin; i < end; ++i) {
            while (group + 1 != plan.groups.end() && i >= (group + 1)->first_item) ++group;
            make_item(plan, draws[group->draw], *group, i);
        }
    });
}

void prefer_blocks(Plan& plan) {
    KernelTable const* const wide = avx512_kernel();
    if (wide == nullptr) return;
    for (LayerPlan& layer : plan.layers) {
        Kernel const wanted = layer.layer->config.kernel;
        if (wanted == Kernel::automatic || wanted == Kernel::simd) layer.kernel = wide;
    }
    for (Group const& group : plan.groups) {
        LayerPlan& layer = plan.layers[group.layer];
        if (group.first_masked != 0) layer.kernel = &kernel_of(layer.layer->config.kernel);
    }
}

}  // namespace gnomon::raster::detail
