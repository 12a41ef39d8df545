#pragma once
// Balls of any size, flat: a stream of (ball, slice, border between rows), border after border of each slice of each ball,
// of which sixteen at a time are cut, so that no lane idles where balls are small. Fifteen rows come of sixteen borders;
// the next sixteen begin with the last.

#include <gnomon/cull/detail/balls_avx512.hpp>
#include <gnomon/cull/detail/rows_avx2.hpp>

#if GNOMON_CULL_AVX2

namespace gnomon::cull::detail {

/// Up to 64 balls and their stream. Elements: the ball in 6 bits, the border in 10, the slice in 16.
struct Stream16 {
    static constexpr std::uint32_t capacity = 2048, next_border = 1U << 6U;
    /// The last border's number is below the largest: one more must not be the next slice's first.
    static constexpr std::uint32_t most_rows = 1022, most_slices = 0xFFFF;

    Balls16 balls[4];
    std::uint32_t start[5] = {};  ///< of each sixteen's elements
    std::uint32_t count = 0;
    alignas(64) std::uint32_t at[capacity + 64];
    alignas(64) float low[capacity + 64];  ///< the span of the row below each element
    alignas(64) float high[capacity + 64];
};

/// Whether sixteen lanes are there, and a grid's rows and slices have the bits.
[[nodiscard]] inline bool has_stream(RowGrid const& g) noexcept {
    return has_wide_lanes() && g.rows <= Stream16::most_rows && g.slices <= Stream16::most_slices;
}

/// Whether each of a grid's tables fits two registers.
[[nodiscard]] inline bool has_small_tables(RowGrid const& g) noexcept { return g.columns < 32 && g.rows < 31 && g.slices < 31; }

/// Some rows that are touched: the lanes of `some`.
struct Rows16 {
    I16 ball, row, first, count;
    M16 some;
};

/// Which slices and borders each of sixteen balls may reach: the last is that below its last row.
struct Reach16 {
    alignas(64) std::uint32_t slice[16];
    alignas(64) std::uint32_t slice_end[16];
    alignas(64) std::uint32_t border[16];
    alignas(64) std::uint32_t border_end[16];
    M16 any;
};

template <bool small>
GNOMON_WIDE_INLINE void find_reach(Tables16 const& t, Balls16 const& b, Reach16& reach) noexcept {
    // gn_in_slice, by counting planes: those in front of the centre that miss the ball, and those that are there or cross it.
    I16 missed = wide(0U), before = wide(0U);
    for (std::uint32_t k = 0; k < t.depth_m.count; ++k) {
        F16 const at = wide(t.depth_m.numbers[k]), off = at - b.depth;
        M16 const crosses = b.radius_sq - off * off >= wide(0.0F), front = at <= b.depth;
        missed = add_one(missed, and_not(front, crosses));
        before = add_one(before, front | crosses);
    }
    I16 const slices = wide(t.depth_m.count - 1), rows = wide(t.y.count - 1);
    // gn_in_row
    I16 const top = one_less(count_below<small, false>(t.y, b.y_bounds.low)), bottom = least(count_below<small, true>(t.y, b.y_bounds.high), rows);
    F16 const left = wide(t.left.numbers[0]), right = wide(t.right.numbers[t.right.count - 1]);
    reach.any = ((missed < before) | (wide(0U) < before & before <= slices)) & (top < bottom) & (left <= b.x_bounds.high) & (b.x_bounds.low <= right);
    wide_store(reach.slice, one_less(missed));
    wide_store(reach.slice_end, least(before, slices));
    wide_store(reach.border, top);
    wide_store(reach.border_end, bottom + wide(1U));
}

GNOMON_WIDE_INLINE Lanes16 lanes_at(Stream16 const& stream, std::uint32_t i) noexcept {
    I16 const at = wide_load(stream.at + i);
    return {at, shift_right<6>(at) & wide(1023U), shift_right<16>(at)};
}

/// Cuts what the stream has of its first `sixteens`, and empties it: `sink.reserve(n)`, then `sink.rows` of at most n rows in the
/// stream's order.
template <bool perspective, bool small, class Sink>
[[gnu::noinline]] GNOMON_WIDE_TARGET void drain(RowGrid const& g, Tables16 const& t, int sixteens, Stream16& stream, Sink& sink) noexcept {
    sink.reserve(stream.count);
    stream.start[sixteens] = stream.count;
    wide_store(stream.at + stream.count, wide(0U));  // no border below
    wide_store(stream.at + stream.count + 16, wide(0U));
    for (int s = 0; s < sixteens; ++s)
        for (std::uint32_t i = stream.start[s]; i < stream.start[s + 1]; i += 15) {
            Span16 const span = row_spans<perspective, small>(t, stream.balls[s], lanes_at(stream, i));
            _mm512_storeu_ps(stream.low + i, span.low.v);
            _mm512_storeu_ps(stream.high + i, span.high.v);
        }
    for (std::uint32_t i = 0; i < stream.count; i += 16) {
        Lanes16 const lanes = lanes_at(stream, i);
        Span16 const span{wide_load(stream.low + i), wide_load(stream.high + i)};
        M16 const has_row = wide_load(stream.at + i + 1) == lanes.ball + wide(Stream16::next_border);
        I16 const first = count_below<small, false>(t.right, span.low), end = count_below<small, true>(t.left, span.high);
        M16 const some = has_row & (span.low <= span.high) & (first < end);
        sink.rows({lanes.ball, lanes.slice * wide(g.rows) + lanes.border, first, end - first, some});
    }
    for (std::uint32_t& start : stream.start) start = 0;
    stream.count = 0;
}

/// All balls, 64 at a time, so that the stream is read when its writing is long done: `sink.balls(from)` before the rows of
/// those.
template <bool perspective, bool small, class Sink>
GNOMON_WIDE_INLINE void visit_stream(RowGrid const& g, Input const& in, std::size_t count, Sink& sink) noexcept {
    Tables16 const tables = make_tables(g);
    Stream16 stream;
    Reach16 reach;
    for (std::size_t from = 0; from < count; from += 64) {
        sink.balls(from);
        int s = 0;
        for (std::size_t n = from; s < 4 && n < count; ++s, n += 16) {
            Balls16& balls = stream.balls[s];
            stream.start[s] = stream.count;
            make_ready<perspective>(wide_load(in.x + n), wide_load(in.y + n), wide_load(in.depth + n), wide_load(in.radius + n), balls);
            find_reach<small>(tables, balls, reach);
            std::uint32_t some = reach.any.v & (count - n < 16 ? (1U << (count - n)) - 1U : 0xFFFFU);
            for (; some != 0; some &= some - 1) {
                auto const ball = static_cast<std::uint32_t>(std::countr_zero(some));
                std::uint32_t const top = reach.border[ball], borders = reach.border_end[ball] - top;
                for (std::uint32_t k = reach.slice[ball]; k < reach.slice_end[ball]; ++k) {
                    if (stream.count + borders > Stream16::capacity) drain<perspective, small>(g, tables, s + 1, stream, sink);
                    I16 const first = wide((static_cast<std::uint32_t>(s) * 16 + ball) | top << 6U | k << 16U) + lane_numbers() * wide(Stream16::next_border);
                    for (std::uint32_t j = 0; j < borders; j += 16) wide_store(stream.at + stream.count + j, first + wide(j * Stream16::next_border));
                    stream.count += borders;
                }
            }
        }
        drain<perspective, small>(g, tables, s, stream, sink);
    }
}

}  // namespace gnomon::cull::detail
#endif
