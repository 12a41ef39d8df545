#pragma once
// A placed volume as an ordinary orthographic view: matrices for hardware, and for lookups.

#include <gnomon/cascade/cascades.hpp>
#include <gnomon/math/plane.hpp>

namespace gnomon::cascade {

/// The middle of a volume, in the world: what positions are best taken relative to.
[[nodiscard]] inline math::dvec3 middle_m(LightFrame const& light, Volume const& v,
                                          math::dvec3 const& anchor_m) noexcept {
    double const half_m = 0.5 * static_cast<double>(v.size_px) * v.texel_m;
    double const x = static_cast<double>(v.at.x) * v.texel_m + half_m;
    double const y = static_cast<double>(v.at.y) * v.texel_m + half_m;
    double const z = static_cast<double>(v.at.z) * v.depth_unit_m + 0.5 * static_cast<double>(v.codes) * v.depth_unit_m;
    return anchor_m + ((light.right * x + light.down * y) + light.away * z);
}

/// The volume seen from `eye_m`, any point of the world: the view's near plane is at code 0, its far plane at the last
/// code, which is the one that an integer pass over the same volume draws. Windows are differences of whole units from
/// the eye, in double; `math::clip_from_relative` rounds them to float. Depth d stands for code d * codes.
///
/// expects: a volume of `light` about `anchor_m`.
[[nodiscard]] inline math::View view_of(LightFrame const& light, Volume const& v, math::dvec3 const& anchor_m,
                                        math::dvec3 const& eye_m, math::Depth depth) noexcept {
    math::dvec3 const eye = light_from_relative(light, eye_m - anchor_m);
    double const left = static_cast<double>(v.at.x) * v.texel_m - eye.x;
    double const top = static_cast<double>(v.at.y) * v.texel_m - eye.y;
    double const size_m = static_cast<double>(v.size_px) * v.texel_m;
    math::View view;
    view.lens = math::Lens::orthographic;
    view.depth = depth;
    view.size_px = math::ivec2(v.size_px, v.size_px);
    view.eye_m = eye_m;
    view.right = light.right;
    view.up = -light.down;
    view.back = -light.away;
    view.window = {left, left + size_m, -(top + size_m), -top};
    view.near_m = static_cast<double>(v.at.z) * v.depth_unit_m - eye.z;
    view.far_m = view.near_m + static_cast<double>(v.codes) * v.depth_unit_m;
    return view;
}

/// The volume in which casters are looked for, as half-spaces for positions relative to `origin_m`: the map's four
/// sides and its far end, one unit farther out than the map. No plane bounds it toward the light: what lies in front of
/// code 0 is drawn at code 0. `cache::may_touch` asks the same of boxes in whole units.
///
/// expects: a volume of `light` about `anchor_m`.
/// returns: what is right of the left side, left of the right side, below the top, above the bottom, before the far
/// end; of what a triangle can cover in the map, nothing is outside
[[nodiscard]] inline std::array<math::Plane, 5> culling_planes(LightFrame const& light, Volume const& v,
                                                               math::dvec3 const& anchor_m,
                                                               math::dvec3 const& origin_m) noexcept {
    math::dvec3 const origin = light_from_relative(light, origin_m - anchor_m);
    auto const begin = [](std::int64_t first, double unit_m, double at) {
        return at - static_cast<double>(first - 1) * unit_m;
    };
    auto const end = [](std::int64_t last, double unit_m, double at) {
        return static_cast<double>(last + 1) * unit_m - at;
    };
    return {math::Plane{light.right, begin(v.at.x, v.texel_m, origin.x)},
            math::Plane{-light.right, end(v.at.x + v.size_px, v.texel_m, origin.x)},
            math::Plane{light.down, begin(v.at.y, v.texel_m, origin.y)},
            math::Plane{-light.down, end(v.at.y + v.size_px, v.texel_m, origin.y)},
            math::Plane{-light.away, end(v.at.z + v.codes, v.depth_unit_m, origin.z)}};
}

/// Seen from its middle.
[[nodiscard]] inline math::View view_of(CascadeFrame const& frame, std::uint32_t k, math::Depth depth) noexcept {
    GNOMON_EXPECT(k < frame.count);
    Volume const& v = frame.cascades[k].volume;
    return view_of(frame.light, v, frame.anchor_m, middle_m(frame.light, v, frame.anchor_m), depth);
}

}  // namespace gnomon::cascade
