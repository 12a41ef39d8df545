#pragma once
// Bounds of clusters in the view space of the culling (x right, y down, depth): what a cluster's planes imply, and the
// approximate explicit bounds, one word a cluster, that OR-ing over its samples makes.
//
// source: [Olsson 2014, Paper II, 3.2, 3.3; Paper III, 4.4]

#include <gnomon/cluster/formula/bounds.glsl>
#include <gnomon/cluster/grid.hpp>
#include <gnomon/math/bounds.hpp>
#include <gnomon/math/scalar.hpp>

#include <algorithm>
#include <cstdint>
#include <limits>

namespace gnomon::cluster {

namespace detail {

/// The greatest float not above `x`.
[[nodiscard]] inline float float_below(double x) noexcept {
    float const nearest = static_cast<float>(std::clamp(x, -0x1.fffffep127, 0x1.fffffep127));
    if (!math::is_finite(x)) return x > 0.0 ? std::numeric_limits<float>::infinity() : -std::numeric_limits<float>::infinity();
    if (x < -0x1.fffffep127) return -std::numeric_limits<float>::infinity();
    return static_cast<double>(nearest) > x ? math::next_down(nearest) : nearest;
}

[[nodiscard]] inline float float_above(double x) noexcept { return -float_below(-x); }

/// Where a border of x or y is at a depth: exact, as a product of two floats is a double. 0 stays 0 at infinity.
[[nodiscard]] inline double border_at(GridView const& grid, float border, float depth_m) noexcept {
    if (!grid.perspective) return static_cast<double>(border);
    return border == 0.0F ? 0.0 : static_cast<double>(border) * static_cast<double>(depth_m);
}

/// `gn_part_bit` of one axis after another, by a guess of the part that the comparisons of its definition correct.
class BoxTenths {
public:
    explicit BoxTenths(math::Aabb const& box) noexcept : box_(box), extent_(box.hi - box.lo) {
        for (math::axis_t axis = 0; axis < 3; ++axis) {
            float const scale = 10.0F / extent_[axis];
            scale_[axis] = scale < std::numeric_limits<float>::max() ? scale : 0.0F;
        }
    }
    [[nodiscard]] std::uint32_t bits(math::vec3 const& p) const noexcept {
        return bit(p.x, 0) | bit(p.y, 1) << 10U | bit(p.z, 2) << 20U;
    }

private:
    [[nodiscard]] std::uint32_t bit(float at, math::axis_t axis) const noexcept {
        if (!(extent_[axis] <= 3.4e38F)) return 0x201U;
        float const guess = (at - box_.lo[axis]) * scale_[axis];
        int part = guess > 0.0F ? static_cast<int>(guess < 9.0F ? guess : 9.0F) : 0;
        while (part > 0 && at < begin(part, axis)) --part;
        while (part < 9 && at >= begin(part + 1, axis)) ++part;
        return 1U << part;
    }
    [[nodiscard]] float begin(int part, math::axis_t axis) const noexcept {
        using Float = formula::Float<float>;
        return gn_part_begin(Float(box_.lo[axis]), Float(extent_[axis]), Float(part)).v;
    }

    math::Aabb box_;
    math::vec3 extent_;
    math::vec3 scale_{0.0F};
};

}  // namespace detail

/// The smallest box of floats that holds a cluster's hexahedron, and `slack_m` more on each side along x and y.
///
/// returns: infinite ends where the cluster has an open border. A sample lies in the box if it lies in the hexahedron;
///          `Grid::border_slack_m`, and a sample's own error, are what `slack_m` is for.
/// source:  [Olsson 2014, Paper II, 3.2]: implicit bounds
[[nodiscard]] inline math::Aabb implicit_bounds(GridView const& grid, ClusterCoordinates const& c, double slack_m = 0.0) noexcept {
    float const near_m = grid.depth_m[c.slice];
    float const far_m = grid.depth_m[c.slice + 1];
    auto const low = [&](float border) {
        return detail::float_below(std::min(detail::border_at(grid, border, near_m), detail::border_at(grid, border, far_m)) - slack_m);
    };
    auto const high = [&](float border) {
        return detail::float_above(std::max(detail::border_at(grid, border, near_m), detail::border_at(grid, border, far_m)) + slack_m);
    };
    return {math::vec3(low(grid.x[c.column]), low(grid.y[c.row]), near_m),
            math::vec3(high(grid.x[c.column + 1]), high(grid.y[c.row + 1]), far_m)};
}

/// Three unary sets of ten bits: which tenths of a box its samples take. 0: no sample. OR joins two.
using PositionBits = std::uint32_t;

/// The bits of one sample.
///
/// expects: a position in the box, which is a cluster's implicit one; outside of it the bounds would not hold it
/// source:  [Olsson 2014, Paper III, 4.4]
[[nodiscard]] inline PositionBits position_bits(math::Aabb const& implicit, math::vec3 const& position) noexcept {
    return detail::BoxTenths(implicit).bits(position);
}

/// The box of the tenths that `bits` take: it holds the box of the samples that set them.
///
/// A sample's tenth is the number of them that begin at or before it, so it lies between where its own and the next
/// begin, as floats, whatever their rounding.
///
/// returns: the empty box for no bits; all of an axis that is infinite
[[nodiscard]] inline math::Aabb approximate_bounds(math::Aabb const& implicit, PositionBits bits) noexcept {
    math::Aabb box;
    if (bits == 0) return box;
    using Float = formula::Float<float>;
    using Uint = formula::Uint<float>;
    for (math::axis_t axis = 0; axis < 3; ++axis) {
        Uint const field(bits >> (10U * static_cast<unsigned>(axis)));
        Float const lo(implicit.lo[axis]);
        Float const hi(implicit.hi[axis]);
        bool const whole = (field.v & 0x201U) == 0x201U;
        box.lo[axis] = whole ? lo.v : gn_parts_low(field, lo, hi).v;
        box.hi[axis] = whole ? hi.v : gn_parts_high(field, lo, hi).v;
    }
    return box;
}

}  // namespace gnomon::cluster
