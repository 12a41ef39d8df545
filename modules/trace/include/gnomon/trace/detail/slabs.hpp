#pragma once
// May a segment touch a box? Four boxes at once, in double, never wrong in the negative.
//
// The slab test is t_near = max over axes of (near plane - start) * inverse, t_far likewise, touched if
// max(t_near, 0) <= min(t_far, t_end) * (1 + 2^-49).
//
// Why it never rejects a box that the closed segment meets, u = 2^-53. Planes and end points are floats. Their
// difference in double has one rounding (1 + d, |d| <= u); the segment's extent end - start has one, its reciprocal one
// more; the product one. So a computed t differs from the exact one by a factor in (1 - u)^2 / (1 + u) .. (1 + u)^3 / (1 -
// u), within 1 +- 4.01 u, and has its sign. If the exact intervals meet, t_near <= t_far for the exact values with
// t_far >= 0, hence computed max(t_near, 0) <= t_far (1 + 4.01u) / (1 - 4.01u) < t_far (1 + 9u) < t_far (1 + 16u).
// Nothing overflows or underflows: differences of floats are 0 or in [2^-149, 2^129], so reciprocals are in [2^-129,
// 2^149] and products in [2^-278, 2^278].
//
// An axis along which the segment does not move (+0 or -0) has no reciprocal. There the start is widened to both sides
// by w = max(|start| 2^-50, 2^-300), far less than a float's ulp, and the factor is 2^800. A box that spans the start
// gets t_near < 0 and t_far > 2^300 (the difference is at least w / 4 >= 2^-302, or |start| 2^-52 >= 2^-201), no limit
// at all; the box beside it gets t_far < 0 or t_near > 2^300 and is left out, since t_end <= 2^300. No 0 * infinity can
// arise: the planes of an empty slot are infinite, but no factor is 0 or infinite.

#include <gnomon/math/lanes.hpp>
#include <gnomon/trace/bvh.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

namespace gnomon::trace::detail {

#if defined(__AVX__)
inline constexpr std::size_t double_lanes = 4;
#else
inline constexpr std::size_t double_lanes = 2;
#endif
using Doubles = math::Lanes<double, double_lanes>;

/// The next doubles of a row of floats; exact.
[[nodiscard]] inline Doubles widened(float const* from) noexcept {
    return math::convert<double>(math::Lanes<float, double_lanes>::load(from));
}

/// One axis of a segment.
struct Axis {
    double near_origin;
    double far_origin;
    double inverse;
    bool reversed;  ///< The near plane is hi.
};

struct Slabs {
    std::array<Axis, 3> axis;
    double t_end;  ///< 1 for a lamp, 2^300 for a sun.
};

inline constexpr double slab_slack = 1.0 + 0x1p-49;

/// expects: a valid segment.
[[nodiscard]] inline Slabs make_slabs(Segment const& s) noexcept {
    Slabs slabs;
    slabs.t_end = s.end.at_infinity ? 0x1p300 : 1.0;
    for (int i = 0; i < 3; ++i) {
        auto const start = static_cast<double>(s.start[i]);
        double const extent = static_cast<double>(s.end.xyz[i]) - (s.end.at_infinity ? 0.0 : start);
        Axis& axis = slabs.axis[static_cast<std::size_t>(i)];
        if (extent != 0.0) {
            axis = {start, start, 1.0 / extent, extent < 0.0};
        } else {
            double const wider = std::max(std::abs(start) * 0x1p-50, 0x1p-300);
            axis = {start + wider, start - wider, 0x1p800, false};
        }
    }
    return slabs;
}

/// The computed interval of a box; see the proof above.
struct Interval {
    Doubles near;
    Doubles far;
};

/// Lanes `first`.. of planes[axis][lane], in the order that `lo` and `hi` have in a node.
[[nodiscard]] inline Interval intersect(Slabs const& slabs, float const (*lo)[width], float const (*hi)[width],
                                        std::size_t first) noexcept {
    Interval t{Doubles::all(0.0), Doubles::all(slabs.t_end)};
    for (std::size_t i = 0; i < 3; ++i) {
        Axis const& axis = slabs.axis[i];
        Doubles const inverse = Doubles::all(axis.inverse);
        Doubles const near_plane = widened((axis.reversed ? hi : lo)[i] + first);
        Doubles const far_plane = widened((axis.reversed ? lo : hi)[i] + first);
        t.near = max(t.near, (near_plane - Doubles::all(axis.near_origin)) * inverse);
        t.far = min(t.far, (far_plane - Doubles::all(axis.far_origin)) * inverse);
    }
    return t;
}

/// One bit per slot of `node` that the segment may touch; `near` gets where it may enter each.
[[nodiscard]] inline std::uint32_t may_touch(Slabs const& slabs, Node const& node, double* near) noexcept {
    std::uint32_t touched = 0;
    for (std::size_t first = 0; first < width; first += double_lanes) {
        Interval const t = intersect(slabs, node.lo, node.hi, first);
        touched |= bits(t.near <= t.far * Doubles::all(slab_slack)) << first;
        t.near.store(near + first);
    }
    return touched;
}

}  // namespace gnomon::trace::detail
