#pragma once
// The plane through an edge and a light: one side of a triangle's shadow volume.
//
// Built from the edge's end points in one fixed order (by position), so that the two triangles at the edge hold the
// same numbers and differ in a flag: a sample is never outside both, whatever rounding or FMA does.

#include <gnomon/math/vec.hpp>
#include <gnomon/predicates/orient.hpp>

#include <cmath>
#include <utility>

namespace gnomon::predicates {

/// A total order of positions, by x, then y, then z; 0 and -0 are the same number.
[[nodiscard]] constexpr bool comes_before(math::vec3 const& a, math::vec3 const& b) noexcept {
    if (a.x != b.x) return a.x < b.x;
    if (a.y != b.y) return a.y < b.y;
    return a.z < b.z;
}

/// normal . (p - anchor) is positive on the plane's own positive side; `flipped` says that the edge was given as
/// (second, first).
struct EdgePlane {
    math::vec3 first;
    math::vec3 second;
    Target light;
    math::vec3 anchor;       ///< A point of the plane that is given exactly: the light, or `first` for a sun.
    math::dvec3 normal;      ///< Rounded.
    math::dvec3 permanent;   ///< Sums of the absolute products that make `normal`: what its rounding is relative to.
    bool flipped = false;
};

/// The plane through the edge ab and `light`.
[[nodiscard]] inline EdgePlane make_edge_plane(math::vec3 const& a, math::vec3 const& b, Target const& light) noexcept {
    EdgePlane plane;
    plane.flipped = comes_before(b, a);
    plane.first = plane.flipped ? b : a;
    plane.second = plane.flipped ? a : b;
    plane.light = light;
    plane.anchor = light.at_infinity ? plane.first : light.xyz;
    math::dvec3 const first = math::to_double(plane.first);
    math::dvec3 const second = math::to_double(plane.second);
    math::dvec3 const towards = math::to_double(light.xyz);
    math::dvec3 const p = light.at_infinity ? towards : first - towards;
    math::dvec3 const q = light.at_infinity ? second - first : second - towards;
    plane.normal = math::dvec3(p.y * q.z - p.z * q.y, p.z * q.x - p.x * q.z, p.x * q.y - p.y * q.x);
    plane.permanent = math::dvec3(std::abs(p.y * q.z) + std::abs(p.z * q.y), std::abs(p.z * q.x) + std::abs(p.x * q.z),
                                  std::abs(p.x * q.y) + std::abs(p.y * q.x));
    if (light.at_infinity) return plane;
    plane.normal = -plane.normal;
    return plane;
}

/// The plane's value at `p` in double, and a proven bound of its distance from the exact value (det3_bound).
///
/// The two planes of an edge ab and ba give exactly opposite values and the same bound.
[[nodiscard]] inline Estimate evaluate(EdgePlane const& plane, math::vec3 const& p) noexcept {
    math::dvec3 const d = math::to_double(p) - math::to_double(plane.anchor);
    math::dvec3 const& n = plane.normal;
    double const value = n.x * d.x + n.y * d.y + n.z * d.z;
    double const permanent = plane.permanent.x * std::abs(d.x) + plane.permanent.y * std::abs(d.y) +
                             plane.permanent.z * std::abs(d.z);
    return {plane.flipped ? -value : value, detail::det3_bound * permanent};
}

/// The exact side of `p`: `line_side(p, light, a, b)` for the edge as it was given.
[[nodiscard]] inline Sign side(EdgePlane const& plane, math::vec3 const& p) noexcept {
    Estimate const estimate = evaluate(plane, p);
    if (estimate.is_certain()) return sign_of(estimate.value);
    Sign const exact = line_side(p, plane.light, plane.first, plane.second);
    return plane.flipped ? -exact : exact;
}

}  // namespace gnomon::predicates
