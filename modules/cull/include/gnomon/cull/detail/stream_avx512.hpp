#pragma once
// Balls of any size, flat: a stream of (ball, slice, border between rows), border after border of each slice of each ball,
// of which sixteen at a time are cut, so that no lane idles where balls are small. Fifteen rows come of sixteen borders;
// the next sixteen begin with the last.

#include <gnomon/cull/detail/balls_avx512.hpp>
#include <gnomon/cull/detail/rows_avx2.hpp>

#if GNOMON_CULL_AVX2

namespace gnomon::cull::detail {

/// Elements: the ball in 4 bits, the border in 10, the slice in 18.
struct Stream16 {
    static constexpr std::uint32_t capacity = 4096, next_border = 16, most_rows = 1023, most_slices = 1U << 18U;

    std::uint32_t count = 0;
    alignas(64) std::uint32_t at[capacity + 48];
};

/// Whether sixteen lanes are there, and a grid's rows and slices have the bits.
[[nodiscard]] inline bool has_stream(RowGrid const& g) noexcept {
    return has_wide_lanes() && g.rows <= Stream16::most_rows && g.slices < Stream16::most_slices;
}

/// Whether each of a grid's tables fits two registers.
[[nodiscard]] inline bool has_small_tables(RowGrid const& g) noexcept { return g.columns < 32 && g.rows < 31 && g.slices < 31; }

/// Some rows that are touched: the lanes of `some`.
struct Rows16 {
    I16 ball, row, first, count;
    M16 some;
};

struct alignas(64) Reach16 {
    std::int32_t slice_first[16], slice_last[16], row_first[16], row_last[16];
};

/// What eight balls give to lanes `from` and on. returns: which of them reach the grid.
template <bool perspective>
GNOMON_WIDE_INLINE std::uint32_t ready_eight(RowGrid const& g, Input const& in, std::size_t n, std::uint32_t from, Balls16& b, Reach16& reach) noexcept {
    Ready8 r;
    make_ready<perspective>(load(in.x + n), load(in.y + n), load(in.depth + n), load(in.radius + n), r);
    find_reach(g, r);
    F8 const* const parts[] = {&r.x, &r.y, &r.depth, &r.radius_sq, &r.tangent, &r.cap.span.low, &r.cap.span.high, &r.cap.low_at, &r.cap.high_at,
                               &r.cap.unit, &r.cap_low_scale, &r.cap_high_scale, &r.x_bounds.low, &r.x_bounds.high};
    float(*const to[])[16] = {&b.x, &b.y, &b.depth, &b.radius_sq, &b.tangent, &b.cap_low, &b.cap_high, &b.cap_low_at, &b.cap_high_at,
                              &b.cap_unit, &b.cap_low_scale, &b.cap_high_scale, &b.x_low, &b.x_high};
#pragma GCC unroll 14
    for (int i = 0; i < 14; ++i) store(*to[i] + from, *parts[i]);
    store(reach.slice_first + from, r.slices.first);
    store(reach.slice_last + from, r.slices.last);
    store(reach.row_first + from, r.rows.first);
    store(reach.row_last + from, r.rows.last);
    return bits_of(r.reaches) << from;
}

/// Cuts what the stream has, and empties it: `sink.reserve(n)`, then `sink.rows` of at most n rows in the stream's order.
template <bool perspective, bool small, class Sink>
GNOMON_WIDE_INLINE void drain(RowGrid const& g, Tables16 const& t, Balls16 const& b, Stream16& stream, Sink& sink) noexcept {
    wide_store(stream.at + stream.count, wide(0U));  // no border below
    wide_store(stream.at + stream.count + 16, wide(0U));
    sink.reserve(stream.count);
    for (std::uint32_t i = 0; i + 1 < stream.count; i += 15) {
        I16 const at = wide_load(stream.at + i);
        M16 const has_row = M16{0x7FFF} & (wide_load(stream.at + i + 1) == at + wide(Stream16::next_border));
        Lanes16 const lanes{at, shift_right<4>(at) & wide(Stream16::most_rows), shift_right<14>(at)};
        Span16 const span = row_spans<perspective, small>(t, b, lanes);
        I16 const first = count_below<small, false>(t.right, span.low), end = count_below<small, true>(t.left, span.high);
        M16 const some = has_row & (span.low <= span.high) & (first < end);
        sink.rows({at, lanes.slice * wide(g.rows) + lanes.border, first, end - first, some});
    }
    stream.count = 0;
}

/// All balls, sixteen at a time: `sink.sixteen(n)` before the rows of those from `n` on.
template <bool perspective, bool small, class Sink>
GNOMON_WIDE_INLINE void visit_stream(RowGrid const& g, Input const& in, std::size_t count, Sink& sink) noexcept {
    Tables16 const tables = make_tables(g);
    Stream16 stream;
    Balls16 balls;
    Reach16 reach;
    for (std::size_t n = 0; n < count; n += 16) {
        std::uint32_t some = ready_eight<perspective>(g, in, n, 0, balls, reach);
        some |= ready_eight<perspective>(g, in, n + 8, 8, balls, reach);
        if (count - n < 16) some &= (1U << (count - n)) - 1U;
        sink.sixteen(n);
        for (; some != 0; some &= some - 1) {
            auto const ball = static_cast<std::uint32_t>(std::countr_zero(some));
            auto const top = static_cast<std::uint32_t>(reach.row_first[ball]), borders = static_cast<std::uint32_t>(reach.row_last[ball]) - top + 2;
            auto const last = static_cast<std::uint32_t>(reach.slice_last[ball]);
            for (auto k = static_cast<std::uint32_t>(reach.slice_first[ball]); k <= last; ++k) {
                if (stream.count + borders > Stream16::capacity) drain<perspective, small>(g, tables, balls, stream, sink);
                I16 const first = wide(ball | top << 4U | k << 14U) + lane_numbers() * wide(Stream16::next_border);
                for (std::uint32_t j = 0; j < borders; j += 16) wide_store(stream.at + stream.count + j, first + wide(j * Stream16::next_border));
                stream.count += borders;
            }
        }
        drain<perspective, small>(g, tables, balls, stream, sink);
    }
}

}  // namespace gnomon::cull::detail
#endif
