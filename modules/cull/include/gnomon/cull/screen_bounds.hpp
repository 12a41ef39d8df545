#pragma once
// Where a sphere lies on the image plane: exact tangent planes through the eye, cut at the near plane.
//
// In the plane of one image axis and depth the sphere is a disc (c, z, r). With D^2 = c^2 + z^2 and L^2 = D^2 - r^2 the
// direction of its upper tangent point is (c L + z r, z L - c r). Where that point lies in front of the near plane, the
// bound is its slope; else the chord that the near plane cuts out has the bound. Inside the sphere there are no tangents.

#include <gnomon/math/bounds.hpp>
#include <gnomon/math/scalar.hpp>
#include <gnomon/math/touch.hpp>
#include <gnomon/math/vec.hpp>

#include <cmath>
#include <limits>

namespace gnomon::cull {

/// x / depth and y / depth of what can be seen (x and y themselves in an orthographic view); empty where lo > hi.
struct ScreenBounds {
    math::vec2 lo = math::vec2(std::numeric_limits<float>::infinity());
    math::vec2 hi = math::vec2(-std::numeric_limits<float>::infinity());

    [[nodiscard]] bool empty() const noexcept { return !(lo.x <= hi.x && lo.y <= hi.y); }
};

namespace detail {

/// c^2 + z^2 - r^2 of three floats: their squares are exact in double, and what the sums round is added again.
[[nodiscard]] inline double tangent_sq(double c, double z, double r) noexcept {
    double const a = c * c;
    double const b = z * z;
    double const d = -(r * r);
    double const sum = a + b;
    double const b_part = sum - a;
    double const lost = (a - (sum - b_part)) + (b - b_part);
    double const all = sum + d;
    double const d_part = all - sum;
    double const lost_too = (sum - (all - d_part)) + (d - d_part);
    return all + (lost + lost_too);
}

/// Least upper bound of c' / z' over the part of the disc with z' >= near, rounded up.
///
/// L errs by a few 2^-53 of itself, the tangent's direction by as many of D; its z is at least near D where it counts,
/// so that the slope errs by less than 2^-48 (1 + |slope|) (1 + D / near). The chord errs by less.
[[nodiscard]] inline double upper_slope(double c, double z, double r, double near_m) noexcept {
    double const size = std::sqrt(c * c + z * z);
    double const l_sq = tangent_sq(c, z, r);
    double const l = std::sqrt(l_sq > 0.0 ? l_sq : 0.0);
    double const tangent_x = c * l + z * r;
    double const tangent_z = z * l - c * r;
    double const reach = z < near_m ? near_m - z : 0.0;  // from a centre behind the near plane
    double const cut = (z - near_m) * (z - near_m);
    double slope = tangent_x / tangent_z;
    if (!(l > 0.0) || !(tangent_z * l >= near_m * size * size)) {
        double const chord_sq = r * r - cut;
        slope = (c + std::sqrt(chord_sq > 0.0 ? chord_sq : 0.0)) / near_m;
        // A root of nearly nothing loses half its digits.
        slope += 0x1p-24 * (r + reach) / near_m;
    }
    return slope + 0x1p-46 * (1.0 + std::abs(slope)) * (1.0 + (size + r) / near_m);
}

[[nodiscard]] inline float up(double x) noexcept { return math::next_up(math::detail::rounded(x)); }

}  // namespace detail

/// Bounds of what a sphere covers in front of a perspective view's near plane. The eye may be inside it.
///
/// expects: a near plane at a positive depth.
/// returns: bounds that hold every point of the sphere with depth >= near_m; empty if there is none, or if the sphere has
///          a number that is none, infinite, or a negative radius.
[[nodiscard]] inline ScreenBounds screen_bounds(math::Sphere const& sphere, float near_m) noexcept {
    ScreenBounds bounds;
    math::dvec3 const c = math::to_double(sphere.center);
    auto const r = static_cast<double>(sphere.radius);
    auto const near = static_cast<double>(near_m);
    bool const usable = math::is_finite(sphere.center) && math::is_finite(sphere.radius) && r >= 0.0 && near > 0.0;
    if (!usable || c.z + r < near) return bounds;
    bounds.hi = math::vec2(detail::up(detail::upper_slope(c.x, c.z, r, near)), detail::up(detail::upper_slope(c.y, c.z, r, near)));
    bounds.lo = math::vec2(-detail::up(detail::upper_slope(-c.x, c.z, r, near)), -detail::up(detail::upper_slope(-c.y, c.z, r, near)));
    return bounds;
}

/// The same in an orthographic view: metres, whatever the depth.
[[nodiscard]] inline ScreenBounds screen_bounds_orthographic(math::Sphere const& sphere) noexcept {
    ScreenBounds bounds;
    if (!math::is_finite(sphere.center) || !math::is_finite(sphere.radius) || !(sphere.radius >= 0.0F)) return bounds;
    math::Aabb const box = math::box_of(sphere);
    return {math::vec2(box.lo.x, box.lo.y), math::vec2(box.hi.x, box.hi.y)};
}

}  // namespace gnomon::cull
