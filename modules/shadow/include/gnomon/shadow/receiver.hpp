#pragma once
// A receiver as the shadow map sees it: where it falls, how deep it lies, and how its own plane runs through the map.
//
// The plane comes from the geometric normal, not from screen-space differences, so it is right at depth edges too.

#include <gnomon/shadow/formula/receiver.glsl>
#include <gnomon/shadow/map_view.hpp>

namespace gnomon::shadow {

/// Steeper planes count as this steep: tan of 89.94 degrees. Beyond, a texel of 1 cm spans 10 m of depth.
inline constexpr float max_tan = 1000.0F;

struct Receiver {
    math::vec2 texel{0.0F};     ///< Image point in texels; a texel's centre is at +0.5, y down.
    float depth = 0.0F;         ///< As the map stores it, not clamped.
    math::vec2 gradient{0.0F};  ///< Depth of the receiver's plane per texel to the right and down.
    float distance_m = 0.0F;    ///< Along the map's axis of sight.
    float per_axis = 1.0F;      ///< Metres along the light's ray for each along the axis of sight.
    float texel_m = 0.0F;       ///< World size of a texel here, the longer side.
    float depth_per_m = 0.0F;   ///< |d depth / d distance| here.
    float cos_angle = 0.0F;     ///< Of the normal with the direction to the light; < 0: the plane faces away.
    float tan_angle = 0.0F;     ///< At most `max_tan`.
    bool in_front = false;      ///< Of the light's own plane; otherwise the map says nothing.
};

namespace detail {

/// What the formulas say; nothing but that where the receiver is not in front.
[[nodiscard]] inline Receiver plain(formula::GnReceiver<float> const& at) noexcept {
    if (!at.in_front.v) return {};
    return {.texel = math::vec2(at.texel),
            .depth = at.depth.v,
            .gradient = math::vec2(at.gradient),
            .distance_m = at.distance_m.v,
            .per_axis = at.per_axis.v,
            .texel_m = at.texel_m.v,
            .depth_per_m = at.depth_per_m.v,
            .cos_angle = at.cos_angle.v,
            .tan_angle = at.tan_angle.v,
            .in_front = true};
}

[[nodiscard]] inline formula::GnReceiver<float> as_formula(Receiver const& at) noexcept {
    return {.texel = formula::Vec2<float>(at.texel),
            .depth = at.depth,
            .gradient = formula::Vec2<float>(at.gradient),
            .distance_m = at.distance_m,
            .per_axis = at.per_axis,
            .texel_m = at.texel_m,
            .depth_per_m = at.depth_per_m,
            .cos_angle = at.cos_angle,
            .tan_angle = at.tan_angle,
            .in_front = at.in_front};
}

}  // namespace detail

/// Projects `position` and its plane into the map.
///
///     orthographic: d = (n.r x + n.u y - h) / n.b      depth = scale d + offset
///     perspective:  1/d = (n.r a + n.u b - n.b) / h    depth = scale + offset / d      h = n . relative
///
/// In both the depth of a plane is an affine function of the image point, with gradient
///
///     k n.r texel.x,  -k n.u texel.y      k = scale / n.b  or  offset / h
///
/// The denominator is kept at or above 1 / `max_tan` of its largest value, so a plane seen edge on has a finite one.
/// expects: a unit normal. A NaN gives a receiver that is not in front.
[[nodiscard]] inline Receiver receiver_at(MapView const& map, math::vec3 const& position,
                                          math::vec3 const& normal) noexcept {
    return detail::plain(gn_receiver_at(map, formula::Vec3<float>(position), formula::Vec3<float>(normal)));
}

}  // namespace gnomon::shadow
