#pragma once
// What a lookup must know of the view that a shadow map was drawn with: plain floats, as a shader would get them.
//
// Positions go in as the depth pass had them: work-space floats, from which the light's eye is subtracted in float. So
// a map 1e7 m from the world's origin is looked up as exactly as one that lies on it.

#include <gnomon/math/vec.hpp>
#include <gnomon/math/view.hpp>
#include <gnomon/shadow/formula/map.glsl>

#include <cstddef>
#include <cstdint>

namespace gnomon::shadow {

enum class Format : std::uint8_t {
    f32,      ///< Depths as they are.
    unorm16,  ///< Codes c that stand for c / 65535, rounded to nearest.
};

/// The constants of a lookup; a shader gets the same bytes. See formula/map.glsl for the members.
using MapView = formula::GnShadowMap;

static_assert(sizeof(MapView) == 160 && offsetof(MapView, clip_from_relative) == 0 && offsetof(MapView, eye) == 64 &&
              offsetof(MapView, near_m) == 76 && offsetof(MapView, right) == 80 && offsetof(MapView, depth_scale) == 92 &&
              offsetof(MapView, up) == 96 && offsetof(MapView, depth_offset) == 108 && offsetof(MapView, back) == 112 &&
              offsetof(MapView, half_code) == 124 && offsetof(MapView, texel) == 128 &&
              offsetof(MapView, size_px) == 136 && offsetof(MapView, perspective) == 144 &&
              offsetof(MapView, reversed) == 148);

/// The lookup's constants for a map drawn with `view`, for positions that are world minus `origin_m`.
///
/// expects: a view made by a `make_` function; the depth pass drew with the same `eye` and `clip_from_relative`.
[[nodiscard]] inline MapView make_map_view(math::View const& view, math::dvec3 const& origin_m,
                                           Format format = Format::f32) noexcept {
    math::DepthLine const line = math::depth_line(view);
    math::dvec2 const texel = math::pixel_size_m(view, 1.0);
    MapView map{};
    map.clip_from_relative = math::clip_from_relative(view);
    map.eye = math::to_float(view.eye_m - origin_m);
    map.right = math::to_float(view.right);
    map.up = math::to_float(view.up);
    map.back = math::to_float(view.back);
    map.texel = math::vec2(static_cast<float>(texel.x), static_cast<float>(texel.y));
    map.size_px = math::vec2(static_cast<float>(view.size_px.x), static_cast<float>(view.size_px.y));
    map.depth_scale = static_cast<float>(line.scale);
    map.depth_offset = static_cast<float>(line.offset);
    map.near_m = static_cast<float>(view.near_m);
    map.half_code = format == Format::unorm16 ? 0.5F / 65535.0F : 0.0F;
    map.perspective = view.lens == math::Lens::perspective ? 1U : 0U;
    map.reversed = view.depth == math::Depth::reversed ? 1U : 0U;
    return map;
}

}  // namespace gnomon::shadow
