// A frame's geometry as the backend's draws, and what alpha means.

#include "detail.hpp"

#include <gnomon/scene/flatten.hpp>

#include <algorithm>

namespace gnomon::pipeline {

namespace {

raster::Draw draw_of(scene::Geometry const& geometry, std::uint32_t first, std::uint32_t count) {
    raster::Draw draw;
    draw.positions = std::span<math::vec3 const>(geometry.positions);
    draw.indices =
        std::span<std::uint32_t const>(geometry.indices).subspan(std::size_t{first} * 3, std::size_t{count} * 3);
    draw.first_triangle = first;
    return draw;
}

/// Many draws share few textures: a map is made where none serves yet.
raster::AlphaMap const* map_of(DrawList& list, raster::AlphaTest const& test) {
    for (raster::AlphaMap const& map : list.alpha_maps)
        if (map.is_of(test)) return &map;
    list.alpha_maps.push_back(raster::make_alpha_map(test));
    return &list.alpha_maps.back();
}

/// A pass transforms all vertices of a draw: one that uses a small stretch of them gets that stretch alone.
void keep_own_vertices(scene::Geometry const& geometry, DrawList& list) {
    for (raster::Draw& draw : list.draws) {
        std::span<std::uint32_t const> const indices(draw.indices.wide(), draw.indices.size());
        auto const [lo, hi] = std::minmax_element(indices.begin(), indices.end());
        std::size_t const first = *lo;
        std::size_t const count = std::size_t{*hi} - first + 1;
        if (*hi >= geometry.positions.size() || count * 2 > geometry.positions.size()) continue;
        std::vector<std::uint32_t> own(indices.begin(), indices.end());
        for (std::uint32_t& index : own) index -= static_cast<std::uint32_t>(first);
        list.rebased.push_back(std::move(own));
        draw.indices = std::span<std::uint32_t const>(list.rebased.back());
        draw.positions = std::span(geometry.positions).subspan(first, count);
        if (draw.alpha_test == nullptr || geometry.uv.size() < first + count) continue;
        auto const test = static_cast<std::size_t>(draw.alpha_test - list.alpha_tests.data());
        list.alpha_tests[test].uv = std::span(geometry.uv).subspan(first, count);
    }
}

}  // namespace

scene::Texture const* base_texture(scene::Scene const& scene, scene::Material const& material) noexcept {
    std::uint32_t const texture = material.base_color_texture.texture;
    return texture < scene.textures.size() ? &scene.textures[texture] : nullptr;
}

scene::Image const* base_image(scene::Scene const& scene, scene::Material const& material) noexcept {
    scene::Texture const* const texture = base_texture(scene, material);
    if (texture == nullptr || texture->image >= scene.images.size()) return nullptr;
    scene::Image const& image = scene.images[texture->image];
    return image.rgba.empty() ? nullptr : &image;
}

AlphaRule alpha_rule(scene::Scene const& scene, scene::Material const& material) noexcept {
    AlphaRule rule;
    // Blended surfaces count as masked at one half: what is mostly there blocks, what is mostly glass does not.
    if (material.alpha_mode == scene::AlphaMode::opaque) return rule;
    rule.cutoff = material.alpha_mode == scene::AlphaMode::mask ? static_cast<double>(material.alpha_cutoff) : 0.5;
    bool const textured = base_image(scene, material) != nullptr;
    rule.tested = textured;
    rule.nothing = !textured && static_cast<double>(material.base_color.w) < rule.cutoff;
    return rule;
}

DrawList make_draws(scene::Scene const& scene, scene::Geometry const& geometry, raster::Cull cull, Blended blended) {
    DrawList list;
    std::vector<std::pair<std::size_t, std::size_t>> tested;  // draw, alpha test: pointers once the list stops moving
    for (scene::Range const& range : geometry.ranges) {
        scene::Material const& material = scene.materials[range.material];
        AlphaRule const rule = alpha_rule(scene, material);
        if (rule.nothing || range.triangle_count == 0) continue;
        if (blended == Blended::left_out && material.alpha_mode == scene::AlphaMode::blend) continue;
        raster::Draw draw = draw_of(geometry, range.first_triangle, range.triangle_count);
        draw.cull = material.double_sided ? raster::Cull::none : cull;
        bool const follows =
            !list.draws.empty() && !rule.tested && list.draws.back().cull == draw.cull &&
            (tested.empty() || tested.back().first + 1 != list.draws.size()) &&
            list.draws.back().first_triangle + raster::triangle_count(list.draws.back()) == range.first_triangle;
        if (follows) {
            std::uint32_t const first = list.draws.back().first_triangle;
            list.draws.back() = draw_of(geometry, first, range.first_triangle - first + range.triangle_count);
            list.draws.back().cull = draw.cull;
            continue;
        }
        if (rule.tested) {
            scene::Image const& image = *base_image(scene, material);
            scene::Texture const& texture = *base_texture(scene, material);
            raster::AlphaTest test;
            test.uv = std::span<math::vec2 const>(geometry.uv);
            test.texture = {image.rgba, image.size_px, texture.wrap_u, texture.wrap_v};
            test.factor = static_cast<double>(material.base_color.w);
            test.cutoff = rule.cutoff;
            test.map = map_of(list, test);
            tested.emplace_back(list.draws.size(), list.alpha_tests.size());
            list.alpha_tests.push_back(test);
        }
        list.draws.push_back(draw);
    }
    for (auto const& [draw, test] : tested) list.draws[draw].alpha_test = &list.alpha_tests[test];
    keep_own_vertices(geometry, list);
    return list;
}

void DrawList::look_from(math::View const& view, math::dvec3 const& origin_m) {
    for (raster::Draw& draw : draws) {
        draw.origin = math::to_float(view.eye_m - origin_m);
        draw.clip_from_relative = math::clip_from_relative(view);
    }
}

}  // namespace gnomon::pipeline
