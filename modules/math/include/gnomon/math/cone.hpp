#pragma once
// Cones of any half angle up to 180 degrees, cut off by a sphere around the apex: the volume that a spot light reaches.
//
// No tangent of the angle is taken anywhere, so none blows up. Cosine and sine come from a series in double, not from
// the C library, whose last bits differ from machine to machine.

#include <gnomon/math/bounds.hpp>
#include <gnomon/math/formula/separate.glsl>
#include <gnomon/math/scalar.hpp>
#include <gnomon/math/touch.hpp>

#include <cmath>

namespace gnomon::math {

/// All points within `range` of `apex` whose direction from it is within `half_angle_rad` of `axis`, the apex included.
struct Cone {
    vec3 apex = vec3(0.0F);
    float range = -1.0F;
    vec3 axis = vec3(0.0F, 0.0F, 1.0F);  ///< Any length but 0.
    float half_angle_rad = 0.0F;
};

namespace detail {

inline constexpr double pi = 3.14159265358979323846;

struct CosSin {
    double cosine;
    double sine;
};

/// To 1e-15, with the same bits everywhere. expects: an angle in [0, pi].
[[nodiscard]] inline CosSin cos_sin(double angle) noexcept {
    bool const obtuse = angle > pi / 2;
    double const x = obtuse ? pi - angle : angle;
    double const square = x * x;
    double cosine = 1.0;
    double sine = 1.0;
    for (int k = 13; k >= 1; --k) {  // Horner's scheme: the term after the last is below 1e-21
        cosine = 1.0 - square / static_cast<double>((2 * k - 1) * (2 * k)) * cosine;
        sine = 1.0 - square / static_cast<double>((2 * k) * (2 * k + 1)) * sine;
    }
    return {obtuse ? -cosine : cosine, sine * x};
}

}  // namespace detail

/// What the tests take: the axis made a unit vector, cosine and sine of an angle 2^-20 larger (formula/separate.glsl).
///
/// returns: a sector that touches nothing (a range of -1) where a number is none, infinite or negative, or the axis 0.
[[nodiscard]] inline formula::GnSector<float> formula_sector(Cone const& cone) noexcept {
    dvec3 const axis = to_double(cone.axis);
    double const length = std::sqrt(axis.x * axis.x + axis.y * axis.y + axis.z * axis.z);
    bool const good = is_finite(cone.apex) && is_finite(cone.range) && is_finite(cone.axis) && cone.range >= 0.0F &&
                      length > 0.0 && cone.half_angle_rad >= 0.0F;
    formula::Vec3<float> const nowhere(0.0F, 0.0F, 0.0F);
    if (!good) return {nowhere, -1.0F, {0.0F, 0.0F, 1.0F}, 1.0F, 0.0F};
    double const wide = static_cast<double>(cone.half_angle_rad) + 0x1p-20;
    detail::CosSin const angle = detail::cos_sin(wide < detail::pi ? wide : detail::pi);
    vec3 const unit = to_float(dvec3(axis.x / length, axis.y / length, axis.z / length));
    return {formula::Vec3<float>(cone.apex), cone.range, formula::Vec3<float>(unit), detail::rounded(angle.cosine),
            detail::rounded(angle.sine)};
}

/// Cone and box. Rarely true for what lies apart: see the figures in the README of `cull`.
[[nodiscard]] inline bool may_touch(formula::GnSector<float> const& sector, Aabb const& box) noexcept {
    return gn_touches_sector_box(sector, formula_box(box)).v && !is_empty(box);
}

[[nodiscard]] inline bool may_touch(formula::GnSector<float> const& sector, Sphere const& sphere) noexcept {
    return gn_touches_sector_sphere(sector, formula_sphere(sphere)).v;
}

}  // namespace gnomon::math
