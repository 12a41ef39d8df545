#pragma once
// The lights of a segment of a row: their spans in lanes, the predicate of `cull` to the bit, and which clusters they touch.

#include <gnomon/bvh/detail/lanes_of.hpp>
#include <gnomon/bvh/tree.hpp>
#include <gnomon/cull/formula/normal_cone.glsl>
#include <gnomon/cull/rows.hpp>
#include <gnomon/lights/detail/shapes.hpp>
#include <gnomon/lights/light.hpp>

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace gnomon::lights::detail {

using bvh::detail::bits_of;
using bvh::detail::lane_count;
using bvh::detail::load;
using bvh::detail::store;

/// Arrays of floats, one after the other, all of the same room.
template <std::size_t count>
struct FloatArrays {
    std::vector<float> memory;
    std::size_t room = 0;

    void grow(std::size_t size) {
        if (size <= room) return;
        room = 2 * size;
        memory.resize(count * room);
    }
    [[nodiscard]] float* operator[](std::size_t k) noexcept { return memory.data() + k * room; }
};

/// Where the clusters of a segment are.
struct SegmentPlace {
    std::uint32_t row = 0;
    std::uint32_t slice = 0;
    std::uint32_t first = 0;  ///< Columns.
    std::uint32_t last = 0;
};

/// Spans of lights over a row, and the lights' slots in the tree.
struct FoundSpans {
    float* low;
    float* high;
    std::uint32_t* slot;
};

template <class S>
[[nodiscard, gnu::always_inline]] inline formula::GnRow<S> spread_row(formula::GnRow<float> const& row) noexcept {
    auto const border = [](formula::GnRowBorder<float> const& b) {
        return formula::GnRowBorder<S>{formula::Float<S>(b.y.v), formula::Float<S>(b.secant.v), formula::Float<S>(b.cosine.v)};
    };
    auto const plane = [](formula::GnSlicePlane<float> const& p) {
        return formula::GnSlicePlane<S>{formula::Float<S>(p.depth.v), formula::Float<S>(p.scale.v), formula::Float<S>(p.inverse.v)};
    };
    return {border(row.top), border(row.bottom), plane(row.near), plane(row.far)};
}

using TreeArrays = bvh::TreeView<bvh::Spheres, 32>;

/// What the spans of a segment are made of.
struct SegmentInput {
    cull::RowGrid const& grid;
    SegmentPlace at;
    TreeArrays tree;
    std::span<Light const> lights;
};

/// A group of balls out of the tree; lanes beyond the last repeat it.
template <class S>
[[nodiscard, gnu::always_inline]] inline bvh::ItemOf<S, 4> gather_balls(TreeArrays const& tree, std::uint32_t const* slots,
                                                                        std::size_t count) noexcept {
    constexpr std::size_t n = lane_count<S>;
    float numbers[4][n];
    for (std::size_t i = 0; i < n; ++i)
        for (std::size_t k = 0; k < 4; ++k) numbers[k][i] = tree.items[k][slots[i < count ? i : count - 1]];
    return {load<S>(numbers[0]), load<S>(numbers[1]), load<S>(numbers[2]), load<S>(numbers[3])};
}

/// The spans of the balls in `slots` that touch the segment. returns: how many there are. `out` may begin at `slots`.
template <class S>
[[gnu::always_inline]] inline std::size_t find_spans(SegmentInput const& in, std::span<std::uint32_t const> slots, FoundSpans const& out) noexcept {
    constexpr std::size_t n = lane_count<S>;
    formula::GnRow<S> const row = spread_row<S>(in.grid.row(in.at.row, in.at.slice));
    formula::Float<S> const left(in.grid.left[in.at.first]), right(in.grid.right[in.at.last]);
    std::size_t found = 0;
    for (std::size_t i = 0; i < slots.size(); i += n) {
        std::size_t const count = std::min(n, slots.size() - i);
        bvh::ItemOf<S, 4> const b = gather_balls<S>(in.tree, slots.data() + i, count);
        auto const ready = gn_ready_ball(formula::Vec3<S>(b[0], b[1], b[2]), b[3], in.grid.perspective);
        formula::GnSpan<S> const span = gn_ball_row(ready, row, in.grid.perspective);
        std::uint32_t bits = bits_of(gn_touches(span, left, right)) & ((1U << count) - 1U);
        float low[n], high[n];
        store(low, span.low);
        store(high, span.high);
        for (; bits != 0; bits &= bits - 1, ++found) {
            auto const k = static_cast<std::size_t>(std::countr_zero(bits));
            out.low[found] = low[k];
            out.high[found] = high[k];
            out.slot[found] = slots[i + k];
        }
    }
    return found;
}

/// Cuts the spans of narrow spots, given by their places among the found, to what the spots cover of the row.
template <class S>
[[gnu::always_inline]] inline void cut_spots(SegmentInput const& in, std::span<std::uint32_t const> places, FoundSpans const& found) noexcept {
    constexpr std::size_t n = lane_count<S>;
    formula::GnRow<S> const row = spread_row<S>(in.grid.row(in.at.row, in.at.slice));
    for (std::size_t i = 0; i < places.size(); i += n) {
        std::size_t const count = std::min(n, places.size() - i);
        std::uint32_t slots[n];
        float cone[5][n];
        for (std::size_t k = 0; k < n; ++k) {
            slots[k] = found.slot[places[i + std::min(k, count - 1)]];
            Light const& l = in.lights[in.tree.ids[slots[k]]];
            float const numbers[5] = {l.axis.x, l.axis.y, l.axis.z, l.cos_half, l.sin_half};
            for (std::size_t c = 0; c < 5; ++c) cone[c][k] = numbers[c];
        }
        bvh::ItemOf<S, 4> const b = gather_balls<S>(in.tree, slots, n);
        auto const ready = gn_ready_ball(formula::Vec3<S>(b[0], b[1], b[2]), b[3], in.grid.perspective);
        formula::Vec3<S> const axis(load<S>(cone[0]), load<S>(cone[1]), load<S>(cone[2]));
        auto const spot = gn_ready_spot(ready, axis, formula::Float<S>(load<S>(cone[3])), formula::Float<S>(load<S>(cone[4])), in.grid.perspective);
        formula::GnSpan<S> const span = gn_spot_row(spot, row, in.grid.perspective);
        float low[n], high[n];
        store(low, span.low);
        store(high, span.high);
        for (std::size_t k = 0; k < count; ++k) {
            found.low[places[i + k]] = low[k];
            found.high[places[i + k]] = high[k];
        }
    }
}

/// The lights of a segment in ascending order, an array each; padded with what touches nothing.
struct SortedLights {
    static constexpr std::size_t padding = 8;

    std::size_t count = 0;
    std::uint32_t const* id = nullptr;
    float const* low = nullptr;
    float const* high = nullptr;
    // Only where there are boxes or cones.
    float const* x = nullptr;
    float const* y = nullptr;
    float const* depth = nullptr;
    float const* limit = nullptr;   ///< Of its radius, see gn_touch_limit; infinite for a light that is everywhere.
    float const* facing = nullptr;  ///< x again, or NaN for what shines from no one place.
};

/// What a cluster asks of the lights of its segment.
struct MemberTest {
    float left = 0.0F;
    float right = 0.0F;
    bool has_box = false;
    bool has_cone = false;
    formula::GnBox<float> box;
    formula::GnNormalCone<float> cone;
    formula::GnSphere<float> samples;  ///< Where the cone's normals are.
};

/// Writes the lights that a cluster keeps. returns: how many; `out` has room for all.
template <class S>
[[gnu::always_inline]] inline std::size_t find_members(SortedLights const& s, MemberTest const& test, std::uint32_t* out) noexcept {
    auto const each = [](formula::Vec3<float> const& v) {
        return formula::Vec3<S>(formula::Float<S>(v.x.v), formula::Float<S>(v.y.v), formula::Float<S>(v.z.v));
    };
    formula::Float<S> const left(test.left), right(test.right);
    std::size_t kept = 0;
    for (std::size_t i = 0; i < s.count; i += lane_count<S>) {
        formula::GnSpan<S> const span{load<S>(s.low + i), load<S>(s.high + i)};
        formula::Bool<S> keeps = gn_touches(span, left, right);
        if (test.has_box && gn_any(keeps)) {
            formula::GnBox<S> const box{each(test.box.lo), each(test.box.hi)};
            formula::Vec3<S> const center(load<S>(s.x + i), load<S>(s.y + i), load<S>(s.depth + i));
            keeps = keeps && gn_touches_sphere_box(center, formula::Float<S>(load<S>(s.limit + i)), box);
        }
        if (test.has_cone && gn_any(keeps)) {
            formula::GnNormalCone<S> const cone{each(test.cone.axis), formula::Float<S>(test.cone.cosine.v), formula::Float<S>(test.cone.sine.v)};
            formula::GnSphere<S> const samples{each(test.samples.center), formula::Float<S>(test.samples.radius.v)};
            formula::Vec3<S> const from(load<S>(s.facing + i), load<S>(s.y + i), load<S>(s.depth + i));
            keeps = keeps && gn_may_face(cone, samples, from);
        }
        for (std::uint32_t bits = bits_of(keeps); bits != 0; bits &= bits - 1) out[kept++] = s.id[i + static_cast<std::size_t>(std::countr_zero(bits))];
    }
    return kept;
}

#if GNOMON_VECTOR_EXTENSION
using SparseLanes = math::Lanes<float, 4>;
#else
using SparseLanes = float;
#endif

#if GNOMON_BVH_AVX2
#define GNOMON_SPARSE_AVX2 [[gnu::target("avx2,bmi,popcnt"), gnu::flatten]] inline
GNOMON_SPARSE_AVX2 std::size_t find_spans_avx2(SegmentInput const& in, std::span<std::uint32_t const> slots, FoundSpans const& out) noexcept {
    return find_spans<math::Lanes<float, 8>>(in, slots, out);
}
GNOMON_SPARSE_AVX2 void cut_spots_avx2(SegmentInput const& in, std::span<std::uint32_t const> places, FoundSpans const& found) noexcept {
    cut_spots<math::Lanes<float, 8>>(in, places, found);
}
GNOMON_SPARSE_AVX2 std::size_t find_members_avx2(SortedLights const& s, MemberTest const& test, std::uint32_t* out) noexcept {
    return find_members<math::Lanes<float, 8>>(s, test, out);
}
#undef GNOMON_SPARSE_AVX2
#endif

/// The kernels above in the widest lanes there are here, or one by one.
struct SparseKernels {
    bool wide = false;
    bool lanes = true;

    [[nodiscard]] std::size_t spans(SegmentInput const& in, std::span<std::uint32_t const> slots, FoundSpans const& out) const noexcept {
#if GNOMON_BVH_AVX2
        if (wide) return find_spans_avx2(in, slots, out);
#endif
        if (lanes) return find_spans<SparseLanes>(in, slots, out);
        return find_spans<float>(in, slots, out);
    }
    void spots(SegmentInput const& in, std::span<std::uint32_t const> places, FoundSpans const& found) const noexcept {
#if GNOMON_BVH_AVX2
        if (wide) return cut_spots_avx2(in, places, found);
#endif
        if (lanes) return cut_spots<SparseLanes>(in, places, found);
        cut_spots<float>(in, places, found);
    }
    [[nodiscard]] std::size_t members(SortedLights const& s, MemberTest const& test, std::uint32_t* out) const noexcept {
#if GNOMON_BVH_AVX2
        if (wide) return find_members_avx2(s, test, out);
#endif
        if (lanes) return find_members<SparseLanes>(s, test, out);
        return find_members<float>(s, test, out);
    }
};

}  // namespace gnomon::lights::detail
