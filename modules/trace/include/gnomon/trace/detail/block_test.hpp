#pragma once
// Which triangles of a block does a segment meet? A filter in double for all lanes at once; what it cannot decide goes to
// the exact test, out of line.
//
// With A, B, C the corners and D the light, all relative to the start (D the direction itself for a sun):
//     u = D.(A x B), v = D.(B x C), w = D.(C x A)   the line's sides of the edges,
//     vol = A.(B x C)                               minus the start's side of the plane,
//     u + v + w - vol                               the light's side (without vol for a sun),
// so with u, v, w of one sign the triangle blocks if 0 < vol / (u + v + w) < 1.
//
// The bound. Each of u, v, w, vol is a sum of six products of one x, one y and one z, all at most M = Mx My Mz, the
// product of the largest |x|, |y|, |z| of A, B, C, D. With at most eight roundings each (det3.hpp) its error is below
// 8.01u * 6 M < 49u M, and the computed M, three roundings in its entries and two in its products, is above (1 - u)^5 M:
// bound = 50u M. The sum of the three adds two roundings of numbers up to 18 M, and the comparison with vol one of 24 M:
// 4 * 49u M + 60u M < 6 * 50u M. Fused multiply-adds only leave roundings out.

#include <gnomon/math/lanes.hpp>
#include <gnomon/trace/bvh.hpp>
#include <gnomon/trace/detail/slabs.hpp>

#include <cstddef>
#include <cstdint>

namespace gnomon::trace::detail {

struct Doubles3 {
    Doubles x;
    Doubles y;
    Doubles z;
};

[[nodiscard]] inline Doubles3 cross(Doubles3 const& a, Doubles3 const& b) noexcept {
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

[[nodiscard]] inline Doubles dot(Doubles3 const& a, Doubles3 const& b) noexcept {
    return a.x * b.x + a.y * b.y + a.z * b.z;
}

[[nodiscard]] inline Doubles absolute(Doubles const& a) noexcept { return max(a, -a); }

/// The segment, spread over the lanes.
struct SegmentLanes {
    Doubles3 start;
    Doubles3 extent;
    Doubles3 extent_size;  ///< |extent|, for the bound.
    bool at_infinity;
};

[[nodiscard]] inline SegmentLanes make_lanes(Segment const& s) noexcept {
    auto const spread = [](math::dvec3 const& p) noexcept {
        return Doubles3{Doubles::all(p.x), Doubles::all(p.y), Doubles::all(p.z)};
    };
    math::dvec3 const start = math::to_double(s.start);
    math::dvec3 const end = math::to_double(s.end.xyz);
    Doubles3 const extent = spread(s.end.at_infinity ? end : end - start);
    return {spread(start), extent, {absolute(extent.x), absolute(extent.y), absolute(extent.z)}, s.end.at_infinity};
}

/// One bit per lane. A lane with neither bit is certainly not met.
struct Verdict {
    std::uint32_t blocked = 0;
    std::uint32_t unsure = 0;
};

[[nodiscard]] inline Verdict test_lanes(SegmentLanes const& s, Block const& block, std::size_t first) noexcept {
    auto const corner = [&](std::size_t c) noexcept {
        return Doubles3{widened(block.corner[c][0] + first) - s.start.x, widened(block.corner[c][1] + first) - s.start.y,
                        widened(block.corner[c][2] + first) - s.start.z};
    };
    Doubles3 const a = corner(0);
    Doubles3 const b = corner(1);
    Doubles3 const c = corner(2);
    auto const largest = [](Doubles const& p, Doubles const& q, Doubles const& r, Doubles const& size) noexcept {
        return max(max(absolute(p), absolute(q)), max(absolute(r), size));
    };
    Doubles const m = largest(a.x, b.x, c.x, s.extent_size.x) * largest(a.y, b.y, c.y, s.extent_size.y) *
                      largest(a.z, b.z, c.z, s.extent_size.z);
    Doubles const bound = m * Doubles::all(50.0 * 0x1p-53);

    Doubles3 const b_x_c = cross(b, c);
    Doubles const u = dot(s.extent, cross(a, b));
    Doubles const v = dot(s.extent, b_x_c);
    Doubles const w = dot(s.extent, cross(c, a));
    Doubles const low = min(min(u, v), w);
    Doubles const high = max(max(u, v), w);
    auto const passes_beside = (low < -bound) & (high > bound);
    if (all(passes_beside)) return {};

    auto const all_positive = low > bound;
    auto const all_negative = high < -bound;
    Doubles const volume = dot(a, b_x_c);
    Doubles const total = u + v + w;
    // Mirrored, so that the total is positive where the signs agree.
    Doubles const depth = select(all_negative, -volume, volume);
    Doubles const beyond = s.at_infinity ? absolute(total) : absolute(total) - depth;
    Doubles const wide_bound = bound * Doubles::all(6.0);
    auto const agree = all_positive | all_negative;
    auto const blocked = agree & (depth > wide_bound) & (beyond > wide_bound);
    auto const off_plane = agree & ((depth < -wide_bound) | (beyond < -wide_bound));
    std::uint32_t const sure_miss = bits(passes_beside | off_plane);
    std::uint32_t const hit = bits(blocked);
    constexpr std::uint32_t lanes = (1U << double_lanes) - 1U;
    return {hit << first, (lanes & ~sure_miss & ~hit) << first};
}

[[nodiscard]] inline Verdict test_block(SegmentLanes const& s, Block const& block) noexcept {
    Verdict verdict;
    for (std::size_t first = 0; first < width; first += double_lanes) {
        Verdict const part = test_lanes(s, block, first);
        verdict.blocked |= part.blocked;
        verdict.unsure |= part.unsure;
    }
    return verdict;
}

}  // namespace gnomon::trace::detail
