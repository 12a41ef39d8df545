#pragma once
// What a lookup must know of the view that a shadow map was drawn with: plain floats, as a shader would get them.
//
// Positions go in as the depth pass had them: work-space floats, from which the light's eye is subtracted in float. So
// a map 1e7 m from the world's origin is looked up as exactly as one that lies on it.

#include <gnomon/math/vec.hpp>
#include <gnomon/math/view.hpp>

#include <cstdint>

namespace gnomon::shadow {

enum class Format : std::uint8_t {
    f32,      ///< Depths as they are.
    unorm16,  ///< Codes c that stand for c / 65535, rounded to nearest.
};

struct MapView {
    math::mat4 clip_from_relative{1.0F};
    math::vec3 eye{0.0F};  ///< Work space, metres.
    math::vec3 right{1.0F, 0.0F, 0.0F};
    math::vec3 up{0.0F, 1.0F, 0.0F};
    math::vec3 back{0.0F, 0.0F, 1.0F};
    math::vec2 texel{1.0F, 1.0F};  ///< Metres: anywhere (orthographic) or at one metre along the axis (perspective).
    math::vec2 size_px{1.0F, 1.0F};
    float depth_scale = 1.0F;  ///< depth = scale * d + offset (orthographic) or scale + offset / d (perspective).
    float depth_offset = 0.0F;
    float near_m = 0.0F;
    float half_code = 0.0F;  ///< Half a step of the stored format, in depth: 0 for f32.
    bool perspective = false;
    bool reversed = false;
};

/// The lookup's constants for a map drawn with `view`, for positions that are world minus `origin_m`.
///
/// expects: a view made by a `make_` function; the depth pass drew with the same `eye` and `clip_from_relative`.
[[nodiscard]] inline MapView make_map_view(math::View const& view, math::dvec3 const& origin_m,
                                           Format format = Format::f32) noexcept {
    math::DepthLine const line = math::depth_line(view);
    math::dvec2 const texel = math::pixel_size_m(view, 1.0);
    MapView map;
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
    map.perspective = view.lens == math::Lens::perspective;
    map.reversed = view.depth == math::Depth::reversed;
    return map;
}

}  // namespace gnomon::shadow
