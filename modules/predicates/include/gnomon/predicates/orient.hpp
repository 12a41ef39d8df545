#pragma once
// Orientation of points, exactly, for all finite floats: from the smallest denormal to 3.4e38, with or without FMA.
//
// A filter in double decides almost always; where its proven bound cannot, expansions do (detail/). No epsilons. The
// filter does not depend on the order of the arguments being canonical: an exact sign is antisymmetric by itself.

#include <gnomon/math/vec.hpp>
#include <gnomon/predicates/detail/det3.hpp>
#include <gnomon/predicates/sign.hpp>
#include <gnomon/predicates/target.hpp>

namespace gnomon::predicates {

namespace detail {

[[nodiscard]] GNOMON_PREDICATES_OUT_OF_LINE inline Sign det2_exact(math::vec2 const& a, math::vec2 const& b,
                                                                   math::vec2 const& c) noexcept {
    bool const finite = math::is_finite(a.x) && math::is_finite(a.y) && math::is_finite(b.x) &&
                        math::is_finite(b.y) && math::is_finite(c.x) && math::is_finite(c.y);
    if (!finite) return Sign::zero;
    auto const difference = [](float p, float from) noexcept {
        return expansion(two_diff(static_cast<double>(p), static_cast<double>(from)));
    };
    auto const det = minor(difference(b.x, a.x), difference(b.y, a.y), difference(c.x, a.x), difference(c.y, a.y));
    return det.size == 0 ? Sign::zero : sign_of(det.term[det.size - 1]);
}

}  // namespace detail

/// The sign of (b - a) x (c - a): positive when a, b, c run counter-clockwise.
///
/// returns: zero when the points lie on one line, and when any number is NaN or infinite.
[[nodiscard]] inline Sign orient2d(math::vec2 const& a, math::vec2 const& b, math::vec2 const& c) noexcept {
    auto const difference = [](float p, float from) noexcept {
        return static_cast<double>(p) - static_cast<double>(from);
    };
    double const left = difference(b.x, a.x) * difference(c.y, a.y);
    double const right = difference(b.y, a.y) * difference(c.x, a.x);
    Estimate const estimate{left - right, detail::det2_bound * (std::abs(left) + std::abs(right))};
    return estimate.is_certain() ? sign_of(estimate.value) : detail::det2_exact(a, b, c);
}

/// The sign of ((b - a) x (c - a)) . (d - a): positive when d is where the normal of a, b, c points, that is, when
/// a, b, c run counter-clockwise as seen from d.
///
/// source:  [Shewchuk 1997, orient3d], with the other sign.
/// returns: zero when the points lie in one plane, and when any number is NaN or infinite.
[[nodiscard]] inline Sign orient3d(math::vec3 const& a, math::vec3 const& b, math::vec3 const& c,
                                   math::vec3 const& d) noexcept {
    return detail::det3_sign({b, &a}, {c, &a}, {d, &a});
}

/// The same with d a target: for a direction v, the sign of ((b - a) x (c - a)) . v, the limit of d = a + s v.
[[nodiscard]] inline Sign orient3d(math::vec3 const& a, math::vec3 const& b, math::vec3 const& c,
                                   Target const& d) noexcept {
    return detail::det3_sign({b, &a}, {c, &a}, {d.xyz, d.at_infinity ? nullptr : &a});
}

/// The plane of a, b, c has p strictly on one side and q strictly on the other.
///
/// returns: false for a triangle without area, and when any number is NaN or infinite.
[[nodiscard]] inline bool separates(math::vec3 const& a, math::vec3 const& b, math::vec3 const& c, Target const& p,
                                    Target const& q) noexcept {
    return strictly_opposite(orient3d(a, b, c, p), orient3d(a, b, c, q));
}

/// On which side of the line from `start` to `end` the line from a to b passes.
///
///     orient3d(start, end, a, b) = ((end - start) x (a - start)) . (b - start)
///
/// A line that meets the plane of a, b, c in one point meets it in the closed triangle exactly if its sides of ab, bc
/// and ca do not hold both signs (`none_opposite`). Triangles that share an edge get opposite signs for it, or zero
/// both, so a line cannot slip between them.
///
/// returns: zero when the lines meet or are parallel, and when any number is NaN or infinite.
[[nodiscard]] inline Sign line_side(math::vec3 const& start, Target const& end, math::vec3 const& a,
                                    math::vec3 const& b) noexcept {
    return detail::det3_sign({end.xyz, end.at_infinity ? nullptr : &start}, {a, &start}, {b, &start});
}

}  // namespace gnomon::predicates
