#pragma once
// The axes of a sun's light space: x right and y down as a map's columns and rows go, z away from the light. Turned by
// the light's direction and the world's up alone, never by the camera.
//
// source: [CSM Scrolling, 5]

#include <gnomon/math/text.hpp>
#include <gnomon/cascade/error.hpp>
#include <gnomon/core/result.hpp>
#include <gnomon/math/view.hpp>

namespace gnomon::cascade {

/// Unit vectors at right angles; right x down = away.
struct LightFrame {
    math::dvec3 right{1.0, 0.0, 0.0};
    math::dvec3 down{0.0, -1.0, 0.0};
    math::dvec3 away{0.0, 0.0, -1.0};

    friend bool operator==(LightFrame const&, LightFrame const&) noexcept = default;
};

/// (a.x p.x + a.y p.y) + a.z p.z, in this order on every machine: what decides texels is the same everywhere.
[[nodiscard]] inline double along(math::dvec3 const& axis, math::dvec3 const& p) noexcept {
    return (axis.x * p.x + axis.y * p.y) + axis.z * p.z;
}

/// A position relative to the anchor, in metres along the light's axes.
[[nodiscard]] inline math::dvec3 light_from_relative(LightFrame const& light, math::dvec3 const& relative_m) noexcept {
    return {along(light.right, relative_m), along(light.down, relative_m), along(light.away, relative_m)};
}

/// The frame of a light that travels along `direction` (any length above 0), with the map as upright as `up` allows.
///
/// Where `up` is parallel to the direction, has no length or is not finite, the world axis least aligned with the
/// direction takes its place: a sun overhead has a frame too, always the same.
///
/// returns: the frame, or what is wrong with the direction
[[nodiscard]] inline core::Result<LightFrame, Error> make_light_frame(math::dvec3 const& direction,
                                                                      math::dvec3 const& up = math::dvec3(0.0, 1.0,
                                                                                                          0.0)) {
    if (!math::is_finite(direction))
        return core::Failure{Error::not_finite, core::sentence({"the light's direction ", math::text_of(direction),
                                                                  " is not finite"})};
    if (direction == math::dvec3(0.0))
        return core::Failure{Error::no_direction,
                             "the light's direction (0, 0, 0) has no length: give one, such as (0, -1, 0)"};
    math::View const view = math::looking_along(math::View{}, direction, up);
    return LightFrame{view.right, -view.up, -view.back};
}

}  // namespace gnomon::cascade
