#pragma once
// Lights of the world, placed in a view's culling space: relative to the eye in double, then rounded once.

#include <gnomon/lights/light.hpp>
#include <gnomon/math/vec.hpp>
#include <gnomon/math/view.hpp>

namespace gnomon::lights {

/// A light whose directions are the world's. `light.center` is not looked at.
struct WorldLight {
    math::dvec3 position_m = math::dvec3(0.0);
    Light light;
};

namespace detail {

/// The world's axes become x right, y down, depth in front.
[[nodiscard]] inline math::dvec3 turned(math::View const& view, math::dvec3 const& v) noexcept {
    auto const along = [&v](math::dvec3 const& axis) { return v.x * axis.x + v.y * axis.y + v.z * axis.z; };
    return math::dvec3(along(view.right), -along(view.up), -along(view.back));
}

}  // namespace detail

/// A light of the world in the culling space of `view`.
///
/// expects: `view` from one of math's factories.
/// returns: what is NaN or infinite stays so, and is left out and counted by the assignment.
[[nodiscard]] inline Light place(WorldLight const& light, math::View const& view) noexcept {
    Light placed = light.light;
    placed.center = math::to_float(detail::turned(view, light.position_m - view.eye_m));
    placed.axis = math::to_float(detail::turned(view, math::to_double(light.light.axis)));
    placed.side = math::to_float(detail::turned(view, math::to_double(light.light.side)));
    placed.other = math::to_float(detail::turned(view, math::to_double(light.light.other)));
    return placed;
}

}  // namespace gnomon::lights
