#pragma once
// The rows of a box (any parallelepiped): in double, by its edges and faces. On the CPU only; balls and spots are formulas.
//
// What a box and a row have in common is convex with flat sides, so its extremes of x / depth are corners: ends of the
// box's twelve edges clipped by the row's four planes, and ends of the row's four edges (lines parallel to x) within the
// box. All planes stand off by 1e-9 of the coordinates' size, a million times what double rounds.

#include <gnomon/cull/rows.hpp>
#include <gnomon/math/vec.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>

namespace gnomon::cull {

/// center + a u + b v + c w with |a|, |b|, |c| <= 1.
struct Box {
    math::vec3 center, u, v, w;
};

namespace detail {

struct BoxRange {
    double low = std::numeric_limits<double>::infinity();
    double high = -std::numeric_limits<double>::infinity();

    void add(double t) noexcept {
        low = std::min(low, t);
        high = std::max(high, t);
    }
};

/// A row's planes as values of a point: at least 0 inside.
struct RowPlanes {
    double near, far, top, bottom;
    bool perspective;

    [[nodiscard]] std::array<double, 4> at(math::dvec3 const& p) const noexcept {
        double const scale = perspective ? p.z : 1.0;
        // An open border's plane is never crossed.
        double const above = std::isinf(top) ? 1.0 : p.y - top * scale, below = std::isinf(bottom) ? 1.0 : bottom * scale - p.y;
        return {p.z - near, std::isinf(far) ? 1.0 : far - p.z, above, below};
    }
};

/// Adds the ends of x / depth (of x) on what the row's planes leave of a segment.
inline void add_segment(RowPlanes const& row, double slack, std::array<math::dvec3, 2> const& ends, BoxRange& range) noexcept {
    auto const a = row.at(ends[0]), b = row.at(ends[1]);
    double from = 0.0, to = 1.0;
    for (std::size_t i = 0; i < 4; ++i) {
        double const f = a[i] + slack, g = b[i] + slack;
        if (f < 0.0 && g < 0.0) return;
        if (f < 0.0) from = std::max(from, f / (f - g));
        if (g < 0.0) to = std::min(to, f / (f - g));
    }
    if (from > to + 1e-9) return;
    for (double const s : {from, to}) {
        math::dvec3 const p = ends[0] * (1.0 - s) + ends[1] * s;
        range.add(row.perspective ? p.x / std::max(p.z, row.near) : p.x);
    }
}

/// An edge of a row.
struct RowLine {
    double y, depth, scale;
};

/// Adds the ends of a row's edge within the box, whose planes are n . (p - center) in [-1, 1].
inline void add_line(std::array<math::dvec3, 3> const& normals, math::dvec3 const& center, RowLine const& line, double slack,
                     BoxRange& range) noexcept {
    double low = -std::numeric_limits<double>::infinity(), high = -low;
    for (math::dvec3 const& n : normals) {
        double const size = std::sqrt(n.x * n.x + n.y * n.y + n.z * n.z), out = 1.0 + slack * size;
        double const rest = n.y * (line.y - center.y) + n.z * (line.depth - center.z);
        if (std::abs(n.x) < 1e-12 * size) {
            if (std::abs(rest) > out) return;
            continue;
        }
        double const a = (-out - rest) / n.x, b = (out - rest) / n.x;
        low = std::max(low, std::min(a, b));
        high = std::min(high, std::max(a, b));
    }
    if (low > high) return;
    range.add((center.x + low) / line.scale);
    range.add((center.x + high) / line.scale);
}

[[nodiscard]] inline math::dvec3 crossed(math::dvec3 const& a, math::dvec3 const& b) noexcept {
    return math::dvec3(a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x);
}

}  // namespace detail

/// The span of x / depth (of x) that a box may cover of a row.
///
/// expects: finite coordinates of at most 2^60 in size.
[[nodiscard]] inline Span box_row(RowGrid const& grid, Box const& box, std::uint32_t row, std::uint32_t slice) noexcept {
    using math::dvec3;
    detail::RowPlanes const planes{static_cast<double>(grid.depth_m[slice]), static_cast<double>(grid.depth_m[slice + 1]),
                                   static_cast<double>(grid.y[row]), static_cast<double>(grid.y[row + 1]), grid.perspective};
    dvec3 const c = math::to_double(box.center);
    std::array<dvec3, 3> const half{math::to_double(box.u), math::to_double(box.v), math::to_double(box.w)};
    double size = std::abs(c.x) + std::abs(c.y) + std::abs(c.z);
    for (dvec3 const& h : half) size += std::abs(h.x) + std::abs(h.y) + std::abs(h.z);
    double const slack = 1e-9 * size;
    detail::BoxRange range;
    for (std::size_t axis = 0; axis < 3; ++axis)
        for (unsigned signs = 0; signs < 4; ++signs) {
            dvec3 const side = half[(axis + 1) % 3] * ((signs & 1U) != 0 ? 1.0 : -1.0) + half[(axis + 2) % 3] * ((signs & 2U) != 0 ? 1.0 : -1.0);
            detail::add_segment(planes, slack, {c + side - half[axis], c + side + half[axis]}, range);
        }
    dvec3 const vw = detail::crossed(half[1], half[2]), wu = detail::crossed(half[2], half[0]), uv = detail::crossed(half[0], half[1]);
    double const volume = half[0].x * vw.x + half[0].y * vw.y + half[0].z * vw.z;
    // A box without volume has no inside for a row's edge to pass through but its faces': take the ball's bound instead.
    if (std::abs(volume) <= 1e-12 * size * size * size) {
        Span everything;
        everything.low = formula::Float<float>(-formula::gn_far());
        everything.high = formula::Float<float>(formula::gn_far());
        return everything;
    }
    std::array<dvec3, 3> const normals{vw / volume, wu / volume, uv / volume};
    for (double const depth : {planes.near, planes.far})
        for (double const y : {planes.top, planes.bottom})
            if (!std::isinf(depth) && !std::isinf(y)) {
                double const scale = grid.perspective ? depth : 1.0;
                detail::add_line(normals, c, {y * scale, depth, scale}, slack, range);
            }
    Span s;
    double const off = range.low <= range.high ? slack / (grid.perspective ? planes.near : 1.0) + 1e-7 * (std::abs(range.low) + std::abs(range.high)) : 0.0;
    auto const far = static_cast<double>(formula::gn_far());
    s.low = formula::Float<float>(static_cast<float>(std::clamp(range.low - off, -far, far)));
    s.high = formula::Float<float>(static_cast<float>(std::clamp(range.high + off, -far, far)));
    return s;
}

}  // namespace gnomon::cull
