#pragma once
// Conservative tests of spheres, boxes and half-spaces against each other, for one pair or for lanes of them.
//
// `formula::GnSphere<S>`, `formula::GnBox<S>` and the tests themselves are in formula/touch.glsl, for S = float,
// math::Lanes<float, N> and GLSL; here are the wrappers for one pair. All may keep a pair too many, never drop one.

#include <gnomon/math/bounds.hpp>
#include <gnomon/math/formula/touch.glsl>
#include <gnomon/math/plane.hpp>
#include <gnomon/math/scalar.hpp>

#include <algorithm>
#include <cmath>

namespace gnomon::math {

[[nodiscard]] inline formula::GnBox<float> formula_box(Aabb const& box) noexcept {
    return {formula::Vec3<float>(box.lo), formula::Vec3<float>(box.hi)};
}

[[nodiscard]] inline formula::GnSphere<float> formula_sphere(Sphere const& sphere) noexcept {
    return {formula::Vec3<float>(sphere.center), formula::Float<float>(sphere.radius)};
}

/// The smallest box, to three units of the last place a side, that holds the sphere; empty if the sphere is.
[[nodiscard]] inline Aabb box_of(Sphere const& sphere) noexcept {
    formula::GnBox<float> const box = gn_box_of(formula_sphere(sphere));
    return {static_cast<vec3>(box.lo), static_cast<vec3>(box.hi)};
}

/// `plane` in float, with what its tests need to stay conservative. Scaled by a power of two; a coefficient that is no
/// number makes it the half-space of all points.
[[nodiscard]] inline formula::GnPlane formula_plane(Plane const& plane) noexcept {
    dvec3 const n = plane.normal;
    double const largest = std::max({std::abs(n.x), std::abs(n.y), std::abs(n.z)});
    if (!is_finite(n) || !is_finite(plane.offset)) return {vec3(0.0F), 1.0F, vec3(1.0F), 0.0F};
    int exponent = 0;
    static_cast<void>(std::frexp(largest, &exponent));
    auto const scaled = [&](double x) { return std::ldexp(x, -exponent); };
    formula::GnPlane f{};
    f.normal = to_float(dvec3(scaled(n.x), scaled(n.y), scaled(n.z)));
    f.offset = detail::rounded(scaled(plane.offset));
    // (1 + 4 e) and two steps hold what rounding to float and the sums of the length lose.
    for (axis_t axis = 0; axis < 3; ++axis) f.magnitude[axis] = next_up(std::abs(f.normal[axis]) * 1.0000003F) + 0x1p-100F;
    double const length = std::sqrt(scaled(n.x) * scaled(n.x) + scaled(n.y) * scaled(n.y) + scaled(n.z) * scaled(n.z));
    f.norm = next_up(next_up(detail::rounded(length)));
    return f;
}

/// Sphere and box. A sphere of negative, infinite or no radius touches nothing; a centre that is no number neither.
[[nodiscard]] inline bool may_touch(Sphere const& sphere, Aabb const& box) noexcept {
    formula::Float<float> const limit = gn_touch_limit(formula::Float<float>(sphere.radius));
    return gn_touches_sphere_box(formula::Vec3<float>(sphere.center), limit, formula_box(box)).v && !is_empty(box);
}

/// Two spheres.
[[nodiscard]] inline bool may_touch(Sphere const& a, Sphere const& b) noexcept {
    return gn_touches_sphere_sphere(formula::Vec3<float>(a.center), formula::Float<float>(a.radius), formula_sphere(b)).v;
}

}  // namespace gnomon::math
