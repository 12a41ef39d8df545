#pragma once
// Where a sample goes: the nearest point of the triangle to the ray, then the eye's side of the plane.

#include <gnomon/math/scalar.hpp>
#include <gnomon/math/vec.hpp>
#include <gnomon/predicates/orient.hpp>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>

namespace gnomon::sample {

/// The points start + s * step in work space; s >= 0 where it is one-sided (perspective), any s where not.
struct SampleRay {
    math::dvec3 start;
    math::dvec3 step;
    bool one_sided = true;
};

namespace detail {

using Corners = std::array<math::vec3, 3>;

/// A candidate on an edge, and the square of its distance from the ray (times |step|^2).
struct Nearest {
    math::dvec3 point;
    double distance_sq = std::numeric_limits<double>::infinity();
};

/// The point of the segment pq that is nearest to the ray's line; only points before the ray's start count.
inline void consider_edge(math::dvec3 const& p, math::dvec3 const& q, SampleRay const& ray, Nearest& best) noexcept {
    // offset(s) = step x (p + s (q - p) - start) is linear in s, and its length is the distance.
    math::dvec3 const at_p = glm::cross(ray.step, p - ray.start);
    math::dvec3 const along = glm::cross(ray.step, q - p);
    double first = 0.0;
    double last = 1.0;
    if (ray.one_sided) {
        double const before_p = glm::dot(ray.step, p - ray.start);
        double const before_q = glm::dot(ray.step, q - ray.start);
        if (before_p <= 0.0 && before_q <= 0.0) return;
        if (before_p < 0.0) first = before_p / (before_p - before_q);
        if (before_q < 0.0) last = before_p / (before_p - before_q);
    }
    double const length_sq = glm::dot(along, along);
    double const wanted = length_sq > 0.0 ? -glm::dot(at_p, along) / length_sq : first;
    double const s = wanted > first ? (wanted < last ? wanted : last) : first;
    math::dvec3 const offset = at_p + along * s;
    double const distance_sq = glm::dot(offset, offset);
    if (distance_sq < best.distance_sq) best = {p * (1.0 - s) + q * s, distance_sq};
}

/// `p` with each axis limited to the triangle's; NaN becomes the first corner's.
[[nodiscard]] inline math::dvec3 limited(math::dvec3 p, Corners const& t) noexcept {
    for (int axis = 0; axis < 3; ++axis) {
        auto const lo = static_cast<double>(std::min({t[0][axis], t[1][axis], t[2][axis]}));
        auto const hi = static_cast<double>(std::max({t[0][axis], t[1][axis], t[2][axis]}));
        if (!(p[axis] >= lo)) p[axis] = p[axis] < lo ? lo : static_cast<double>(t[0][axis]);
        if (p[axis] > hi) p[axis] = hi;
    }
    return p;
}

/// The triangle's point on the ray, or nearest to it; within the triangle's bounds, so rounding to float stays there.
///
/// returns: the first corner for a triangle wholly behind a one-sided ray's start.
[[nodiscard]] inline math::dvec3 nearest_point(Corners const& t, SampleRay const& ray) noexcept {
    math::dvec3 const p[3] = {math::to_double(t[0]), math::to_double(t[1]), math::to_double(t[2])};
    // [Moeller, Trumbore 1997], from the ray's point nearest to the first corner: from a far start the products would be
    // large and the triangle's share of them rounding noise.
    math::dvec3 const ab = p[1] - p[0];
    math::dvec3 const ac = p[2] - p[0];
    math::dvec3 const away = ray.start - p[0];
    math::dvec3 const from = away - ray.step * (glm::dot(away, ray.step) / glm::dot(ray.step, ray.step));
    math::dvec3 const step_x_ac = glm::cross(ray.step, ac);
    double const det = glm::dot(ab, step_x_ac);
    double const b = glm::dot(from, step_x_ac) / det;
    double const c = glm::dot(ray.step, glm::cross(from, ab)) / det;
    if (b >= 0.0 && c >= 0.0 && b + c <= 1.0) {
        math::dvec3 const point = p[0] + ab * b + ac * c;
        if (!ray.one_sided || glm::dot(ray.step, point - ray.start) >= 0.0) return limited(point, t);
    }
    Nearest best{p[0]};
    consider_edge(p[0], p[1], ray, best);
    consider_edge(p[1], p[2], ray, best);
    consider_edge(p[2], p[0], ray, best);
    return limited(best.point, t);
}

/// The axis of the largest component of the normal whose exact sign is not zero, and that sign.
struct Dominant {
    int axis = 0;
    predicates::Sign sign = predicates::Sign::zero;
};

[[nodiscard]] inline Dominant dominant_axis(Corners const& t) noexcept {
    math::dvec3 const ab = math::to_double(t[1]) - math::to_double(t[0]);
    math::dvec3 const ac = math::to_double(t[2]) - math::to_double(t[0]);
    math::dvec3 const normal = glm::cross(ab, ac);
    std::array<int, 3> order{0, 1, 2};
    std::stable_sort(order.begin(), order.end(),
                     [&](int i, int j) { return std::abs(normal[i]) > std::abs(normal[j]); });
    for (int const axis : order) {
        int const u = (axis + 1) % 3;
        int const v = (axis + 2) % 3;
        auto const flat = [&](math::vec3 const& p) noexcept { return math::vec2(p[u], p[v]); };
        predicates::Sign const sign = predicates::orient2d(flat(t[0]), flat(t[1]), flat(t[2]));
        if (sign != predicates::Sign::zero) return {axis, sign};
    }
    return {};
}

/// `p`, moved by the least number of floats along the dominant axis so that it is not strictly behind the plane of `t`
/// as seen from `eye_side`. Exact, by bisection: the side is monotone along the axis.
///
/// returns: `p` itself where `eye_side` is zero; the last finite float where the plane is beyond it.
[[nodiscard]] inline math::vec3 moved_to_side(Corners const& t, math::vec3 p, predicates::Sign eye_side) noexcept {
    using predicates::Sign;
    auto const is_behind = [&](math::vec3 const& q) noexcept {
        return strictly_opposite(predicates::orient3d(t[0], t[1], t[2], q), eye_side);
    };
    if (eye_side == Sign::zero || !is_behind(p)) return p;
    Dominant const dominant = dominant_axis(t);
    std::int64_t const direction = dominant.sign == eye_side ? 1 : -1;
    std::int64_t const start = math::ordinal(p[dominant.axis]);
    std::int64_t const room = math::ordinal(std::numeric_limits<float>::max()) - direction * start;
    auto const moved = [&](std::int64_t steps) noexcept {
        math::vec3 q = p;
        q[dominant.axis] = math::from_ordinal(static_cast<std::int32_t>(start + direction * steps));
        return q;
    };
    std::int64_t behind = 0;
    std::int64_t before = std::min<std::int64_t>(1, room);
    while (before < room && is_behind(moved(before))) {
        behind = before;
        before = std::min(before * 2, room);
    }
    while (before - behind > 1) {
        std::int64_t const middle = behind + (before - behind) / 2;
        (is_behind(moved(middle)) ? behind : before) = middle;
    }
    return moved(before);
}

}  // namespace detail

}  // namespace gnomon::sample
