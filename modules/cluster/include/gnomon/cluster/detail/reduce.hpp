#pragma once
// How the reductions of reduce.hpp go: runs of samples in registers, then one update of their cluster a run.

#include <gnomon/cluster/reduce.hpp>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>

namespace gnomon::cluster {

namespace detail {

inline constexpr std::int32_t last_place = std::numeric_limits<std::int32_t>::max();
inline constexpr std::size_t reduce_grain = 16384;

/// Lowers `value` to `other`, as other threads may be doing.
inline void lower(std::int32_t& value, std::int32_t other) noexcept {
    std::atomic_ref<std::int32_t> const shared(value);
    std::int32_t now = shared.load(std::memory_order_relaxed);
    while (other < now && !shared.compare_exchange_weak(now, other, std::memory_order_relaxed)) {}
}

/// Lowers six shared places, of a box's lower ends and of its upper ends' negatives, in the order of floats: there both
/// zeros are one.
inline void lower_box(std::int32_t* shared, math::Aabb const& box) noexcept {
    if (is_empty(box)) return;
    for (std::size_t i = 0; i < 3; ++i) {
        lower(shared[i], math::ordinal(box.lo[static_cast<math::axis_t>(i)]));
        lower(shared[i + 3], -math::ordinal(box.hi[static_cast<math::axis_t>(i)]));
    }
}

[[nodiscard]] inline math::Aabb box_of(std::int32_t const* places) noexcept {
    math::Aabb box;
    if (places[0] == last_place) return box;
    for (std::size_t i = 0; i < 3; ++i) {
        box.lo[static_cast<math::axis_t>(i)] = math::from_ordinal(places[i]);
        box.hi[static_cast<math::axis_t>(i)] = math::from_ordinal(-places[i + 3]);
    }
    return box;
}

/// Calls `one_run(begin, end, cluster, stats)` for each run of samples of one cluster, on any thread, and adds up stats.
template <core::Executor E, class F>
[[nodiscard]] ReduceStats for_each_cluster_run(std::span<std::uint32_t const> index, std::size_t clusters, E& executor,
                                               F const& one_run) {
    std::atomic<std::size_t> not_finite{0};
    std::atomic<std::size_t> outside{0};
    executor.parallel_for(index.size(), reduce_grain, [&](std::size_t begin, std::size_t end) {
        ReduceStats stats;
        for (std::size_t i = begin; i < end;) {
            std::uint32_t const cluster = index[i];
            std::size_t const first = i;
            while (i < end && index[i] == cluster) ++i;
            if (cluster < clusters) one_run(first, i, cluster, stats);
            else if (cluster != no_cluster) stats.outside += i - first;
        }
        not_finite.fetch_add(stats.not_finite, std::memory_order_relaxed);
        outside.fetch_add(stats.outside, std::memory_order_relaxed);
    });
    return {not_finite.load(), outside.load()};
}

/// The least cosine of the angle between one vector and several, kept as the fraction of its square with its sign and
/// the square of the vector's length: no root and no quotient but at the end.
class LeastCosine {
public:
    explicit LeastCosine(math::vec3 const& axis) noexcept : axis_(math::to_double(axis)) {}

    /// expects: a direction
    void add(math::vec3 const& n) noexcept {
        math::dvec3 const v = math::to_double(n);
        double const dot = glm::dot(axis_, v);
        double const square = dot * std::abs(dot);
        double const length_sq = glm::dot(v, v);
        bool const less = square * length_sq_ < square_ * length_sq;
        square_ = less ? square : square_;
        length_sq_ = less ? length_sq : length_sq_;
    }
    /// A float that is not above the least cosine, in exact arithmetic.
    [[nodiscard]] float below() const noexcept {
        double const cosine = std::sqrt(std::abs(square_) / (glm::dot(axis_, axis_) * length_sq_));
        return float_below((square_ < 0.0 ? -cosine : cosine) - 4e-15);
    }

private:
    math::dvec3 axis_;
    double square_ = 1e300;  ///< Above any: squares of floats are below 1e78.
    double length_sq_ = 1.0;
};

[[nodiscard]] inline bool has_direction(math::vec3 const& n) noexcept {
    return math::is_finite(n) && (n.x != 0.0F || n.y != 0.0F || n.z != 0.0F);
}

/// The middle of a box of normals, of length 1; zero where there is none.
[[nodiscard]] inline math::vec3 cone_axis(math::Aabb const& box) noexcept {
    math::dvec3 const middle = math::to_double(box.lo) + math::to_double(box.hi);
    double const length = std::sqrt(glm::dot(middle, middle));
    return length > 0.0 && math::is_finite(length) ? math::to_float(middle / length) : math::vec3(0.0F);
}

/// The boxes of `values`, without what `is_usable` refuses, as places in `work`.
template <core::Executor E, class F>
ReduceStats reduce_places(std::span<std::uint32_t const> index, std::span<math::vec3 const> values,
                          std::span<std::int32_t> places, E& executor, F const& is_usable) {
    return for_each_cluster_run(index, places.size() / 6, executor,
                                [&](std::size_t begin, std::size_t end, std::uint32_t cluster, ReduceStats& stats) {
                                    math::Aabb box;
                                    for (std::size_t i = begin; i < end; ++i) {
                                        if (is_usable(values[i])) box = math::extended(box, values[i]);
                                        else ++stats.not_finite;
                                    }
                                    lower_box(places.data() + std::size_t{6} * cluster, box);
                                });
}

}  // namespace detail

template <core::Executor E>
ReduceStats explicit_bounds(std::span<std::uint32_t const> index, std::span<math::vec3 const> positions,
                            std::span<math::Aabb> out, ReduceWorkspace& work, E& executor) {
    GNOMON_EXPECT(index.size() == positions.size());
    work.places.assign(6 * out.size(), detail::last_place);
    ReduceStats const stats = detail::reduce_places(index, positions, std::span<std::int32_t>(work.places), executor,
                                                    [](math::vec3 const& p) { return math::is_finite(p); });
    for (std::size_t c = 0; c < out.size(); ++c) out[c] = detail::box_of(work.places.data() + 6 * c);
    return stats;
}

template <core::Executor E>
ReduceStats reduce_position_bits(std::span<std::uint32_t const> index, std::span<math::vec3 const> positions,
                                 std::span<math::Aabb const> implicit, std::span<PositionBits> out, E& executor) {
    GNOMON_EXPECT(index.size() == positions.size() && implicit.size() == out.size());
    std::fill(out.begin(), out.end(), 0U);
    return detail::for_each_cluster_run(
        index, out.size(), executor, [&](std::size_t begin, std::size_t end, std::uint32_t cluster, ReduceStats& stats) {
            detail::BoxTenths const tenths(implicit[cluster]);
            PositionBits bits = 0;
            for (std::size_t i = begin; i < end; ++i) {
                bool const finite = math::is_finite(positions[i]);
                bool const inside = finite && math::contains(implicit[cluster], positions[i]);
                if (inside) bits |= tenths.bits(positions[i]);
                stats.not_finite += finite ? 0U : 1U;
                stats.outside += finite && !inside ? 1U : 0U;
            }
            std::atomic_ref<PositionBits>(out[cluster]).fetch_or(bits, std::memory_order_relaxed);
        });
}

template <core::Executor E>
ReduceStats explicit_cones(std::span<std::uint32_t const> index, std::span<math::vec3 const> normals,
                           std::span<NormalCone> out, ReduceWorkspace& work, E& executor) {
    GNOMON_EXPECT(index.size() == normals.size());
    constexpr float no_sample = 2.0F;
    work.places.assign(6 * out.size(), detail::last_place);
    ReduceStats const stats = detail::reduce_places(index, normals, std::span<std::int32_t>(work.places), executor, detail::has_direction);
    for (std::size_t c = 0; c < out.size(); ++c) {
        out[c].axis = detail::cone_axis(detail::box_of(work.places.data() + 6 * c));
        work.places[c] = math::ordinal(no_sample);
    }
    static_cast<void>(detail::for_each_cluster_run(
        index, out.size(), executor, [&](std::size_t begin, std::size_t end, std::uint32_t cluster, ReduceStats&) {
            detail::LeastCosine least(out[cluster].axis);
            bool known = detail::has_direction(out[cluster].axis);
            for (std::size_t i = begin; known && i < end; ++i) {
                known = detail::has_direction(normals[i]);
                if (known) least.add(normals[i]);
            }
            detail::lower(work.places[cluster], math::ordinal(known ? least.below() : -1.0F));
        }));
    for (std::size_t c = 0; c < out.size(); ++c) {
        bool const usable = detail::has_direction(out[c].axis);
        if (!usable) out[c].axis = math::vec3(0.0F, 0.0F, 1.0F);
        out[c].cos_half = std::max(-1.0F, math::from_ordinal(work.places[c]));
    }
    return stats;
}

}  // namespace gnomon::cluster
