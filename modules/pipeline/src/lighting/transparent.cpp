// Transparent surfaces: forward shading through the grid of the opaque ones. [Olsson 2014, Paper I, 4 and 6.3]

#include "transparent.hpp"

#include "forward.hpp"
#include "lighting.hpp"
#include "surface_table.hpp"
#include "../workspace.hpp"

#include <algorithm>
#include <array>
#include <limits>
#include <utility>

namespace gnomon::pipeline {

namespace {

constexpr float unbounded_m = std::numeric_limits<float>::infinity();

/// Up to the farthest opaque sample of each tile; a pixel that shows none hides nothing.
TileRanges behind_nothing(Frame const& frame, std::uint32_t tile_px) {
    TileRanges made = ranges_of_samples(frame, tile_px);
    auto const width = static_cast<std::uint32_t>(frame.view.size_px.x);
    for (std::uint32_t pixel = 0; pixel < frame.sample_of_pixel.size(); ++pixel)
        if (frame.sample_of_pixel[pixel] == no_sample) made.of(pixel % width, pixel / width).add(unbounded_m);
    for (cull::DepthRange& range : made.ranges) range = cull::far_only(range);
    return made;
}

/// The sorted triangles as one draw, ids counting from 0.
struct SortedDraw {
    std::vector<std::uint32_t> indices;
    std::vector<TriangleStd> triangles;
    backend::Draw draw;

    SortedDraw(scene::Geometry const& g, std::span<std::uint32_t const> order) {
        for (std::uint32_t const t : order) {
            std::uint32_t const* const corner = g.indices.data() + std::size_t{t} * 3;
            indices.insert(indices.end(), corner, corner + 3);
            triangles.push_back({{corner[0], corner[1], corner[2]}, g.triangle_material[t]});
        }
        draw.positions = std::span<math::vec3 const>(g.positions);
        draw.indices = std::span<std::uint32_t const>(indices);
    }
};

/// The farthest that a transparent surface may be, or an opaque one.
double deepest_of(Frame const& frame, SortedDraw const& sorted, core::ExecutorRef executor) {
    SampleDepth const depth_of(frame);
    double deepest = deepest_sample(frame, executor);
    for (std::uint32_t const index : sorted.indices)
        deepest = std::max(deepest, static_cast<double>(depth_of(frame.geometry->positions[index])));
    return deepest;
}

/// Draws the nearest transparent triangles and moves each tile's near end to the nearest of them.
void find_nearest(Verbs& verbs, LightingRun const& on, backend::DrawListId list, SortedDraw const& sorted, TileRanges& ranges) {
    ForwardState& f = on.workspace.state().lighting.forward;
    math::ivec2 const size = on.frame.view.size_px;
    if (f.front_px != size) {
        f.front = {};
        f.front_px = size;
        f.front = Held(verbs.device(), verbs(verbs.device().make_target({.size_px = size, .triangle_ids = true})));
    }
    std::vector<std::uint32_t> ids(pixel_count(size));
    backend::PassLayer const layer = layer_of(on.frame);
    verbs(on.device.draw(list, f.front.get(), {&layer, 1}));
    verbs(on.device.read({f.front.get(), 0, backend::Plane::triangle, {0, 0, size.x, size.y}}, std::as_writable_bytes(std::span(ids))));
    verbs(on.device.finish());
    CameraRays const rays = make_camera_rays(on.frame.view, on.frame.geometry->origin_m);
    SampleDepth const depth_of(on.frame);
    auto const width = static_cast<std::uint32_t>(size.x);
    std::vector<float> nearest(ranges.ranges.size(), unbounded_m);
    for (std::uint32_t pixel = 0; pixel < ids.size(); ++pixel) {
        if (ids[pixel] >= sorted.triangles.size()) continue;
        TriangleStd const& t = sorted.triangles[ids[pixel]];
        scene::Geometry const& g = *on.frame.geometry;
        auto const corners = triangle_of(vertex_of(g, t.corner[0]), vertex_of(g, t.corner[1]), vertex_of(g, t.corner[2]));
        math::vec2 const px(static_cast<float>(pixel % width) + 0.5F, static_cast<float>(pixel / width) + 0.5F);
        float const depth_m = depth_of(math::vec3(gn_surface_point(rays.camera, formula::Vec2<float>(px), corners).position));
        float& least = nearest[static_cast<std::size_t>(&ranges.of(pixel % width, pixel / width) - ranges.ranges.data())];
        // Of two triangles at nearly one depth the depth test may have shown either.
        least = std::min(least, depth_m * (1.0F - 0x1p-12F));
    }
    for (std::size_t i = 0; i < nearest.size(); ++i) ranges.ranges[i] = cull::transparent_range(ranges.ranges[i], nearest[i]);
}

/// Blends colours, then counts the lights of each fragment, as [Olsson 2014, Paper I, figure 3] counts them.
void record_layers(Verbs& verbs, LightingRun const& on, Lighting& l, ForwardPass pass, std::vector<math::vec4>& counted) {
    math::ivec2 const size = on.frame.view.size_px;
    backend::TargetPart const part{l.forward.target.get(), 0, backend::Plane::color, {0, 0, size.x, size.y}};
    l.forward.color.resize(pixel_count(size));
    counted.resize(pixel_count(size));
    on.device.stage("depth_pass");
    verbs(on.device.draw(l.forward.all.get(), l.forward.target.get(), {&pass.layer, 1}));
    on.device.stage("shade");
    pass.layer.load = backend::Load::keep;
    pass.test = backend::FragmentTest::behind_nothing;
    pass.constants.blends = 1;
    record_forward(verbs, l, pass);
    on.device.stage("");
    verbs(on.device.read(part, std::as_writable_bytes(std::span(l.forward.color))));
    pass.constants.blends = 0;
    pass.constants.counts = 1;
    record_forward(verbs, l, pass);
    verbs(on.device.read(part, std::as_writable_bytes(std::span(counted))));
}

TransparentOutput composite(Frame const& frame, std::span<math::vec3 const> radiance, std::span<math::vec4 const> layers,
                            std::span<math::vec4 const> counted) {
    TransparentOutput output;
    std::uint64_t computations = 0;
    for (std::size_t pixel = 0; pixel < layers.size(); ++pixel) {
        math::vec4 const& c = layers[pixel];
        std::uint32_t const i = frame.sample_of_pixel[pixel];
        math::vec3 const opaque = i != no_sample ? radiance[i] : math::vec3(0.0F);
        output.image.push_back(math::vec3(c.x, c.y, c.z) + opaque * (1.0F - c.w));
        output.computations.push_back(static_cast<std::uint32_t>(counted[pixel].w));
        computations += output.computations.back();
    }
    output.counts = {{"lighting_computations", computations}};
    return output;
}

}  // namespace

std::vector<std::uint32_t> sort_back_to_front(Frame const& frame) {
    scene::Geometry const& g = *frame.geometry;
    SampleDepth const depth_of(frame);
    std::vector<std::pair<float, std::uint32_t>> keys;
    for (std::uint32_t t = 0; t < g.triangle_material.size(); ++t) {
        if (frame.scene->materials[g.triangle_material[t]].alpha_mode != scene::AlphaMode::blend) continue;
        std::uint32_t const* const corner = g.indices.data() + std::size_t{t} * 3;
        math::vec3 const sum = g.positions[corner[0]] + g.positions[corner[1]] + g.positions[corner[2]];
        float const depth_m = depth_of(sum * (1.0F / 3.0F));
        keys.emplace_back(math::is_finite(depth_m) ? -depth_m : unbounded_m, t);
    }
    std::sort(keys.begin(), keys.end());
    std::vector<std::uint32_t> order;
    for (auto const& [key, triangle] : keys) order.push_back(triangle);
    return order;
}

Result<TransparentOutput> shade_transparent(LightingRun const& on, std::span<math::vec3 const> radiance,
                                            TransparencyConfig const& config) {
    GNOMON_EXPECT(on.frame.leaves_out_blended && radiance.size() == on.frame.samples.size() && config.tile_px > 0);
    Verbs verbs(on.device);
    Lighting& l = begin_forward(on, verbs);
    Stopwatch watch;
    SortedDraw const sorted(*on.frame.geometry, sort_back_to_front(on.frame));
    double const sort_ms = watch.lap_ms();
    Held const list(on.device, verbs(on.device.keep({&sorted.draw, 1})));
    l.forward.sorted_triangles.fill<TriangleStd>(verbs, sorted.triangles);
    TileRanges ranges = behind_nothing(on.frame, static_cast<std::uint32_t>(config.tile_px));
    if (config.nearest && !config.clusters) find_nearest(verbs, on, list.get(), sorted, ranges);
    double const nearest_ms = watch.lap_ms();
    auto const grid = config.clusters ? list_by_cluster(on, l, static_cast<std::uint32_t>(config.tile_px), deepest_of(on.frame, sorted, on.executor))
                                      : list_by_tile(on, l, static_cast<std::uint32_t>(config.tile_px), &ranges);
    if (!grid) return grid.failure();
    if (auto ok = check_loops(on.device, *grid, 1); !ok) return std::move(ok).failure();
    double const assign_ms = watch.lap_ms();
    stage_lists(verbs, l, *grid);
    std::vector<math::vec4> counted;
    record_layers(verbs, on, l, {list.get(), l.forward.sorted_triangles.get(), layer_of(on.frame), grid->constants}, counted);
    auto const device_stages = verbs(on.device.finish());
    if (!verbs.good()) return verbs.failure();
    TransparentOutput output = composite(on.frame, radiance, l.forward.color, counted);
    output.counts.insert(output.counts.end(), {{"light_pairs", grid->pairs},
                                               {"lists", grid->lists},
                                               {"transparent_triangles", sorted.triangles.size()}});
    output.stages = {{"sort", sort_ms}, {"nearest", nearest_ms}, {"assign", assign_ms}};
    output.stages.insert(output.stages.end(), device_stages.begin(), device_stages.end());
    return output;
}

}  // namespace gnomon::pipeline
