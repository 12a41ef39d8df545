#pragma once
// Axis-aligned boxes and spheres in float, closed sets. An empty box holds nothing and merges as the neutral element.

#include <gnomon/math/scalar.hpp>
#include <gnomon/math/vec.hpp>

#include <limits>
#include <span>

namespace gnomon::math {

/// All points p with lo <= p <= hi per axis; empty when lo > hi on any axis.
struct Aabb {
    vec3 lo = vec3(std::numeric_limits<float>::infinity());
    vec3 hi = vec3(-std::numeric_limits<float>::infinity());

    friend bool operator==(Aabb const&, Aabb const&) noexcept = default;
};

/// All points within `radius` of `center`; empty when the radius is negative.
struct Sphere {
    vec3 center = vec3(0.0F);
    float radius = -1.0F;
};

[[nodiscard]] inline bool is_empty(Aabb const& box) noexcept {
    return !(box.lo.x <= box.hi.x && box.lo.y <= box.hi.y && box.lo.z <= box.hi.z);
}

[[nodiscard]] inline bool contains(Aabb const& box, vec3 const& p) noexcept {
    return box.lo.x <= p.x && p.x <= box.hi.x && box.lo.y <= p.y && p.y <= box.hi.y && box.lo.z <= p.z && p.z <= box.hi.z;
}

/// Whether two closed boxes share a point. Exact: only comparisons.
[[nodiscard]] inline bool touches(Aabb const& a, Aabb const& b) noexcept {
    return a.lo.x <= b.hi.x && b.lo.x <= a.hi.x && a.lo.y <= b.hi.y && b.lo.y <= a.hi.y && a.lo.z <= b.hi.z &&
           b.lo.z <= a.hi.z;
}

/// The smallest box that holds both.
[[nodiscard]] inline Aabb merged(Aabb const& a, Aabb const& b) noexcept {
    return {glm::min(a.lo, b.lo), glm::max(a.hi, b.hi)};
}

/// The smallest box that holds `box` and `p`.
///
/// expects: `p` is finite (see `bounds_of` for data that may not be).
[[nodiscard]] inline Aabb extended(Aabb const& box, vec3 const& p) noexcept {
    return {glm::min(box.lo, p), glm::max(box.hi, p)};
}

/// The smallest box that holds every finite point of `points`; points with a NaN or an infinity are left out.
[[nodiscard]] inline Aabb bounds_of(std::span<vec3 const> points) noexcept {
    Aabb box;
    for (vec3 const& p : points)
        if (is_finite(p)) box = extended(box, p);
    return box;
}

/// Corner `i` of the box: bit 0 picks hi.x, bit 1 hi.y, bit 2 hi.z.
[[nodiscard]] inline vec3 corner(Aabb const& box, unsigned i) noexcept {
    return vec3((i & 1U) != 0 ? box.hi.x : box.lo.x, (i & 2U) != 0 ? box.hi.y : box.lo.y,
                (i & 4U) != 0 ? box.hi.z : box.lo.z);
}

/// The middle of the box: always inside it. Taken in double, where neither huge nor denormal corners round away.
[[nodiscard]] inline vec3 center(Aabb const& box) noexcept {
    return to_float((to_double(box.lo) + to_double(box.hi)) * 0.5);
}

}  // namespace gnomon::math
