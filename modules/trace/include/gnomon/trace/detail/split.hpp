#pragma once
// How the builder cuts a range of triangles in two; see build.hpp. Nothing here decides visibility: a bad split costs
// time, never a result.

#include <gnomon/math/lanes.hpp>
#include <gnomon/trace/bvh.hpp>

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>

namespace gnomon::trace::detail {

using Float4 = math::Lanes<float, 4>;  ///< x, y, z and a lane that nobody reads.

struct Box {
    Float4 lo = Float4::all(std::numeric_limits<float>::infinity());
    Float4 hi = Float4::all(-std::numeric_limits<float>::infinity());

    void grow(Float4 const& other_lo, Float4 const& other_hi) noexcept {
        lo = min(lo, other_lo);
        hi = max(hi, other_hi);
    }
    /// Half the surface, in double: float would overflow beyond 1e19 m.
    [[nodiscard]] double half_area() const noexcept {
        double const x = static_cast<double>(hi[0]) - static_cast<double>(lo[0]);
        double const y = static_cast<double>(hi[1]) - static_cast<double>(lo[1]);
        double const z = static_cast<double>(hi[2]) - static_cast<double>(lo[2]);
        return x < 0.0 ? 0.0 : x * y + y * z + z * x;
    }
};

/// A triangle while it is sorted: its box, and its id in the mantissas of the unread lanes (floats in [1, 2): plain
/// id bits would be denormals, on which arithmetic is slow).
struct Ref {
    Float4 lo;
    Float4 hi;

    static constexpr std::uint32_t one = 0x3F80'0000U;
    static constexpr std::uint32_t mantissa = 0x007F'FFFFU;

    [[nodiscard]] std::uint32_t id() const noexcept {
        return (std::bit_cast<std::uint32_t>(lo[3]) & mantissa) | (std::bit_cast<std::uint32_t>(hi[3]) & mantissa) << 23U;
    }
    /// Halves are added, so that no finite box overflows.
    [[nodiscard]] Float4 center() const noexcept { return lo * Float4::all(0.5F) + hi * Float4::all(0.5F); }
};

[[nodiscard]] inline Ref make_ref(Triangle const& t, core::TriangleId id) noexcept {
    std::array<float, 4> lo{};
    std::array<float, 4> hi{};
    for (int axis = 0; axis < 3; ++axis) {
        auto const i = static_cast<std::size_t>(axis);
        lo[i] = std::min({t[0][axis], t[1][axis], t[2][axis]});
        hi[i] = std::max({t[0][axis], t[1][axis], t[2][axis]});
    }
    lo[3] = std::bit_cast<float>(Ref::one | (id.value & Ref::mantissa));
    hi[3] = std::bit_cast<float>(Ref::one | id.value >> 23U);
    return {Float4::load(lo.data()), Float4::load(hi.data())};
}

/// refs[begin, end) and their bounds.
struct Range {
    std::uint32_t begin = 0;
    std::uint32_t end = 0;
    Box bounds;

    [[nodiscard]] std::uint32_t size() const noexcept { return end - begin; }
};

inline constexpr std::size_t bin_count = 16;

/// Maps centres to bins: floor((center - from) * scale) clamped to the last bin.
struct Binning {
    Float4 from;
    Float4 scale;

    [[nodiscard]] std::array<std::int32_t, 4> bins_of(Ref const& ref) const noexcept {
        Float4 const place = (ref.center() - from) * scale;
        // Clamped in float before the cast: huge boxes can give infinity here, and the unread lane anything.
        Float4 const last = Float4::all(static_cast<float>(bin_count - 1));
        Float4 const legal = select(place >= Float4::all(0.0F), min(place, last), Float4::all(0.0F));
        return std::bit_cast<std::array<std::int32_t, 4>>(math::convert<std::int32_t>(legal));
    }
};

[[nodiscard]] inline Binning make_binning(std::span<Ref const> refs) noexcept {
    Box centers;
    for (Ref const& ref : refs) {
        Float4 const c = ref.center();
        centers.grow(c, c);
    }
    std::array<float, 4> scale{};
    for (std::size_t axis = 0; axis < 3; ++axis) {
        float const extent = centers.hi[axis] - centers.lo[axis];
        float const wanted = static_cast<float>(bin_count) / extent;
        bool const legal = extent > 0.0F && wanted <= std::numeric_limits<float>::max() && wanted > 0.0F;
        scale[axis] = legal ? wanted : 0.0F;
    }
    return {centers.lo, Float4::load(scale.data())};
}

struct Split {
    std::size_t axis = 0;
    std::int32_t last_left = -1;  ///< Bins up to this one go left; none: no plane separates anything.
    double cost = std::numeric_limits<double>::infinity();
};

struct Bin {
    Box bounds;
    std::uint32_t count = 0;
};

using Bins = std::array<std::array<Bin, bin_count>, 3>;

/// A leaf costs whole blocks of four triangles.
[[nodiscard]] inline double blocks_for(std::uint32_t count) noexcept { return static_cast<double>((count + 3) / 4); }

[[nodiscard]] inline Split best_split(Bins const& bins) noexcept {
    Split best;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        std::array<double, bin_count> right_cost{};
        Bin right;
        for (std::size_t i = bin_count - 1; i > 0; --i) {
            right.bounds.grow(bins[axis][i].bounds.lo, bins[axis][i].bounds.hi);
            right.count += bins[axis][i].count;
            right_cost[i] = right.count == 0 ? std::numeric_limits<double>::infinity()
                                             : right.bounds.half_area() * blocks_for(right.count);
        }
        Bin left;
        for (std::size_t i = 0; i + 1 < bin_count; ++i) {
            left.bounds.grow(bins[axis][i].bounds.lo, bins[axis][i].bounds.hi);
            left.count += bins[axis][i].count;
            if (left.count == 0) continue;
            double const cost = left.bounds.half_area() * blocks_for(left.count) + right_cost[i + 1];
            if (cost < best.cost) best = {axis, static_cast<std::int32_t>(i), cost};
        }
    }
    return best;
}

[[nodiscard]] inline Box bounds_of(std::span<Ref const> refs) noexcept {
    Box box;
    for (Ref const& ref : refs) box.grow(ref.lo, ref.hi);
    return box;
}

}  // namespace gnomon::trace::detail
