#pragma once
// The rows of balls with AVX2: the formula's bits, without what the formula computes in vain.
//
// Two shapes of work. Balls that reach at most 4 rows, 4 slices and 8 columns go eight at a time, a ball a lane, in step
// over their borders; larger ones one at a time, a border a lane. Arcs are made once a border, corners once a border and
// plane, for both slices beside it.

#include <gnomon/cull/detail/spots_avx2.hpp>

#if GNOMON_CULL_AVX2

#include <bit>

namespace gnomon::cull::detail {

inline constexpr int small_rows = 4, small_slices = 4, small_columns = 8;

/// The directions' ends in the slices between the planes of `cut`, a light a lane.
template <bool perspective>
GNOMON_ROWS_INLINE void make_sides(F8 depth, Spots8 const& spots, Cut8 const* cut, int slices, Sides8* sides) noexcept {
    Aim8 const aim{depth, spots.slack, spots.depth};
    for (int i = 0; i < 4; ++i) {
        SideCut8 near = side_cut<perspective>(aim, spots.side[i], cut[0]);
        for (int k = 0; k < slices; ++k) {
            SideCut8 const far = side_cut<perspective>(aim, spots.side[i], cut[k + 1]);
            sides[k].t[i] = side_within(spots.side[i].bound, near, far);
            near = far;
        }
    }
}

/// One spot of eight: what `side_cut` needs with a direction a lane, and its silhouettes in every lane.
struct OneSpot {
    Aim8 aim;
    Side8 side;
    Silhouette8 outline[2];
};

GNOMON_ROWS_INLINE F8 four(F8 const& a, F8 const& b, F8 const& c, F8 const& d, std::uint32_t lane) noexcept {
    auto const at = [lane](F8 const& from) { return lane_of<float>(&from, lane); };
    return {_mm256_setr_ps(at(a), at(b), at(c), at(d), 0.0F, 0.0F, 0.0F, 0.0F)};
}

GNOMON_ROWS_INLINE void pick(Ready8 const& b, Spots8 const& from, std::uint32_t lane, OneSpot& to) noexcept {
    Side8 const(&s)[4] = from.side;
    to.aim = {pick(b.depth, lane), pick(from.slack, lane), {pick(from.depth.low, lane), pick(from.depth.high, lane)}};
    to.side.middle = four(s[0].middle, s[1].middle, s[2].middle, s[3].middle, lane);
    to.side.bound = four(s[0].bound, s[1].bound, s[2].bound, s[3].bound, lane);
    to.side.first = {four(s[0].first.slope, s[1].first.slope, s[2].first.slope, s[3].first.slope, lane),
                     four(s[0].first.inverse, s[1].first.inverse, s[2].first.inverse, s[3].first.inverse, lane),
                     four(s[0].first.at_eye, s[1].first.at_eye, s[2].first.at_eye, s[3].first.at_eye, lane)};
    to.side.second = {four(s[0].second.slope, s[1].second.slope, s[2].second.slope, s[3].second.slope, lane),
                      four(s[0].second.inverse, s[1].second.inverse, s[2].second.inverse, s[3].second.inverse, lane),
                      four(s[0].second.at_eye, s[1].second.at_eye, s[2].second.at_eye, s[3].second.at_eye, lane)};
    for (int i = 0; i < 2; ++i)
        to.outline[i] = {pick(from.outline[i].upper, lane), pick(from.outline[i].start, lane), pick(from.outline[i].lean, lane),
                         pick(from.outline[i].off, lane)};
}

/// Calls `sink.row(lane, slice, row, low, high)` for the rows of the balls of `lanes` (a mask) that are not empty: slice
/// and row counted from each ball's first. All of them must be small.
template <bool perspective, bool with_spots, class Sink>
GNOMON_ROWS_INLINE void visit_small(RowGrid const& g, Ready8 const& b, Spots8 const& spots, F8 lanes, Sink& sink) noexcept {
    I8 const rows = b.rows.last - b.rows.first, slices = b.slices.last - b.slices.first;
    int slice_count = 1, row_count = 1;
    while (slice_count < small_slices && bits_of((slices > all(slice_count - 1)) & lanes) != 0) ++slice_count;
    while (row_count < small_rows && bits_of((rows > all(row_count - 1)) & lanes) != 0) ++row_count;

    Cut8 cut[small_slices + 1];
    Cap8 cap[small_slices];
    Span8 above[small_slices];
    for (int k = 0; k <= slice_count; ++k) gather_cut(g, b, b.slices.first + all(k), lanes, cut[k]);
    for (int k = 0; k < slice_count; ++k) cap[k] = slice_cap(b, cut[k], cut[k + 1]);
    Sides8 sides[small_slices];
    if constexpr (with_spots) {
        make_sides<perspective>(b.depth, spots, cut, slice_count, sides);
        for (int k = 0; k < slice_count; ++k)
            sides[k].inverse = gather(g.inverse.data(), least(b.slices.first + all(k), all(static_cast<std::int32_t>(g.slices))));
    }

    F8 y = all(0.0F);
    for (int j = 0; j <= row_count; ++j) {
        I8 const at = least(b.rows.first + all(j), all(static_cast<std::int32_t>(g.rows)));
        F8 const next_y = gather(g.y.data(), at);
        Arc8 const arc = border_arc<perspective>(b, {next_y, gather(g.secant.data(), at), gather(g.cosine.data(), at)});
        F8 const in_rows = and_not(lanes, all(j - 1) > rows);
        Span8 near_corner{all(0.0F), all(0.0F)}, far_corner = near_corner;
        for (int k = 0; k <= slice_count; ++k) {
            near_corner = far_corner;
            if (cut[k].crosses) far_corner = corner(b.x, next_y * cut[k].scale - b.y, cut[k].rest, cut[k].inverse);
            if (k == 0) continue;
            Span8 const below = within(arc, cut[k - 1], near_corner, cut[k], far_corner);
            if (j > 0) {
                Span8 s = joined(b, {y, next_y, above[k - 1], below}, cap[k - 1]);
                if constexpr (with_spots) {
                    Span8 const in_spot = cut_row(s, sides[k - 1], spots.outline, y, next_y);
                    s = {select(spots.there, in_spot.low, s.low), select(spots.there, in_spot.high, s.high)};
                }
                std::uint32_t some = bits_of(and_not((s.low <= s.high) & in_rows, all(k - 1) > slices));
                if (some != 0) {
                    alignas(32) float low[8], high[8];
                    store(low, s.low);
                    store(high, s.high);
                    for (; some != 0; some &= some - 1) {
                        auto const lane = static_cast<std::uint32_t>(std::countr_zero(some));
                        sink.small_row(lane, static_cast<std::uint32_t>(k - 1), static_cast<std::uint32_t>(j - 1), low[lane], high[lane]);
                    }
                }
            }
            above[k - 1] = below;
        }
        y = next_y;
    }
}

/// Calls `sink.row(slice, row, low, high)` for the rows of one ball of eight, slice and row counted from the grid's first.
template <bool perspective, bool is_spot, class Sink>
GNOMON_ROWS_INLINE void visit_large(RowGrid const& g, Ready8 const& eight, Spots8 const& spots, std::uint32_t lane, Sink& sink) noexcept {
    Ready8 b;
    OneSpot spot;
    pick(eight, lane, b);
    if constexpr (is_spot) pick(eight, spots, lane, spot);
    std::uint32_t const first = pick(eight.rows.first, lane), last = pick(eight.rows.last, lane);
    std::uint32_t const slice_first = pick(eight.slices.first, lane), slice_last = pick(eight.slices.last, lane);
    for (std::uint32_t j = first; j <= last; j += 7) {
        std::uint32_t const rows = last - j + 1 < 7 ? last - j + 1 : 7;
        F8 const y = load(g.y.data() + j), next_y = load(g.y.data() + j + 1);
        Arc8 const arc = border_arc<perspective>(b, {y, load(g.secant.data() + j), load(g.cosine.data() + j)});
        Cut8 near;
        Span8 near_corner = spread_cut(g, b, y, slice_first, near);
        SideCut8 near_sides;
        if constexpr (is_spot) near_sides = side_cut<perspective>(spot.aim, spot.side, near);
        for (std::uint32_t k = slice_first; k <= slice_last; ++k) {
            Cut8 far;
            Span8 const far_corner = spread_cut(g, b, y, k + 1, far);
            Span8 const top = within(arc, near, near_corner, far, far_corner);
            Span8 s = joined(b, {y, next_y, top, {next_lane(top.low), next_lane(top.high)}}, slice_cap(b, near, far));
            if constexpr (is_spot) {
                SideCut8 const far_sides = side_cut<perspective>(spot.aim, spot.side, far);
                F8 const t = side_within(spot.side.bound, near_sides, far_sides);
                s = cut_row(s, {{pick(t, 0), pick(t, 1), pick(t, 2), pick(t, 3)}, spread(g.inverse.data() + k)}, spot.outline, y, next_y);
                near_sides = far_sides;
            }
            std::uint32_t some = bits_of(s.low <= s.high) & ((1U << rows) - 1U);
            alignas(32) float low[8], high[8];
            store(low, s.low);
            store(high, s.high);
            for (; some != 0; some &= some - 1) {
                auto const i = static_cast<std::uint32_t>(std::countr_zero(some));
                sink.large_row(k, j + i, low[i], high[i]);
            }
            near = far;
            near_corner = far_corner;
        }
    }
}

/// What is culled, in arrays that may be read in eights: balls, and for cones axis, cosine and sine. `cosine` is -1 where
/// there is no cone; null: there are none at all.
struct Input {
    float const* x;
    float const* y;
    float const* depth;
    float const* radius;
    float const* axis[3];
    float const* cosine;
    float const* sine;
};

template <bool perspective>
GNOMON_ROWS_INLINE void find_spots(RowGrid const& g, Input const& in, std::size_t n, Ready8& b, Spots8& spots) noexcept {
    spots.there = all(0.0F);
    if (in.cosine != nullptr) {
        F8 const cosine = load(in.cosine + n), sine = load(in.sine + n);
        spots.there = cosine >= all(0.015625F) * sine;
        if (bits_of(spots.there) != 0) {
            make_cone(b, {load(in.axis[0] + n), load(in.axis[1] + n), load(in.axis[2] + n)}, cosine, sine, spots);
            make_spots<perspective>(b, spots);
        }
    }
    find_reach(g, b);
    if (bits_of(spots.there) != 0) cut_slices(g, spots, b);
}

/// All lights: `sink.eight(n, ready)` before each eight; `sink.large(lane, ready)` before the rows of a large one, which
/// come after those of the small ones and in the order of lanes; `sink.done()` after each eight.
template <bool perspective, class Sink>
GNOMON_ROWS_INLINE void visit_all(RowGrid const& g, Input const& in, std::size_t count, Sink& sink) noexcept {
    Ready8 b;
    Spots8 spots;
    for (std::size_t n = 0; n < count; n += 8) {
        make_ready<perspective>(load(in.x + n), load(in.y + n), load(in.depth + n), load(in.radius + n), b);
        find_spots<perspective>(g, in, n, b, spots);
        std::uint32_t const there = count - n < 8 ? (1U << (count - n)) - 1U : 255U;
        F8 const big = (b.rows.last - b.rows.first > all(small_rows - 1)) | (b.slices.last - b.slices.first > all(small_slices - 1)) |
                       (b.columns.last - b.columns.first > all(small_columns - 1));
        std::uint32_t const some = bits_of(b.reaches) & there, cones = bits_of(spots.there);
        if (some == 0) continue;
        sink.eight(n, b);
        std::uint32_t large = bits_of(big) & some;
        if (large != some) {
            alignas(32) static constexpr std::int32_t bit[8] = {1, 2, 4, 8, 16, 32, 64, 128};
            __m256i const bits = _mm256_load_si256(reinterpret_cast<__m256i const*>(bit));
            __m256i const set = _mm256_and_si256(_mm256_set1_epi32(static_cast<int>(some & ~large)), bits);
            F8 const lanes{_mm256_castsi256_ps(_mm256_cmpeq_epi32(set, bits))};
            if (cones != 0) visit_small<perspective, true>(g, b, spots, lanes, sink);
            else visit_small<perspective, false>(g, b, spots, lanes, sink);
        }
        for (; large != 0; large &= large - 1) {
            auto const lane = static_cast<std::uint32_t>(std::countr_zero(large));
            sink.large(lane, b);
            if ((cones >> lane & 1U) != 0) visit_large<perspective, true>(g, b, spots, lane, sink);
            else visit_large<perspective, false>(g, b, spots, lane, sink);
        }
        sink.done();
    }
}

}  // namespace gnomon::cull::detail
#endif
