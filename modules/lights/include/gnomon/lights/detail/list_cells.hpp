#pragma once
// Cells and lists row by row with AVX-512: of a row's runs, those over a column are packed at once.

#include <gnomon/cull/detail/avx512.hpp>
#include <gnomon/cull/rows.hpp>
#include <gnomon/lights/admit.hpp>

#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>
#include <type_traits>

namespace gnomon::lights::detail {

/// Sorts runs by rows: in each they stay by lights.
inline void sort_by_rows(std::span<Run const> runs, std::size_t rows, RowRuns& to) {
    to.start.assign(rows + 2, 0);
    std::uint32_t* const start = to.start.data();
    for (Run const& run : runs) ++start[run.row + 2];
    std::uint32_t sum = 0;
    for (std::size_t r = 2; r < rows + 2; ++r) start[r] = sum += start[r];
    if (to.first.size() < runs.size() + 32)
        for (auto* list : {&to.first, &to.count, &to.light}) list->resize(2 * runs.size() + 32);
    std::uint16_t *const first = to.first.data(), *const count = to.count.data(), *const light = to.light.data();
#pragma GCC unroll 4
    for (std::size_t i = 0; i < runs.size(); ++i) {
        std::uint32_t const at = start[runs[i].row + 1]++;
        first[at] = static_cast<std::uint16_t>(runs[i].first);
        count[at] = static_cast<std::uint16_t>(runs[i].count);
        light[at] = static_cast<std::uint16_t>(runs[i].light);
    }
}

#if GNOMON_CULL_AVX2
GNOMON_WIDE_BEGIN

/// Sums of the lanes up to each.
GNOMON_WIDE_INLINE __m512i running_sums(__m512i a) noexcept {
    __m512i const zero = _mm512_setzero_si512();
    a = _mm512_add_epi32(a, _mm512_alignr_epi32(a, zero, 15));
    a = _mm512_add_epi32(a, _mm512_alignr_epi32(a, zero, 14));
    a = _mm512_add_epi32(a, _mm512_alignr_epi32(a, zero, 12));
    return _mm512_add_epi32(a, _mm512_alignr_epi32(a, zero, 8));
}

/// Up to sixteen cells (offset, count). returns: the sum of the counts.
GNOMON_WIDE_INLINE std::uint32_t write_cells(__m512i counts, std::uint32_t offset, std::uint32_t lanes, std::uint32_t* at) noexcept {
    __m512i const sums = running_sums(counts);
    __m512i const offsets = _mm512_add_epi32(_mm512_sub_epi32(sums, counts), _mm512_set1_epi32(static_cast<int>(offset)));
    __m512i const first = _mm512_setr_epi32(0, 16, 1, 17, 2, 18, 3, 19, 4, 20, 5, 21, 6, 22, 7, 23);
    __m512i const second = _mm512_add_epi32(first, _mm512_set1_epi32(8));
    std::uint32_t const there = 0xFFFFU >> (lanes < 16 ? 16 - lanes : 0);
    _mm512_mask_storeu_epi64(at, static_cast<__mmask8>(there), _mm512_permutex2var_epi32(offsets, first, counts));
    _mm512_mask_storeu_epi64(at + 16, static_cast<__mmask8>(there >> 8U), _mm512_permutex2var_epi32(offsets, second, counts));
    return static_cast<std::uint32_t>(_mm_extract_epi32(_mm512_extracti32x4_epi32(sums, 3), 3));
}

/// How many runs are over each of 32 columns.
GNOMON_WIDE_INLINE __m512i count_over(RowRuns const& runs, std::uint32_t start, std::uint32_t end, std::uint32_t column) noexcept {
    alignas(64) static constexpr std::uint16_t numbers[32] = {0,  1,  2,  3,  4,  5,  6,  7,  8,  9,  10, 11, 12, 13, 14, 15,
                                                              16, 17, 18, 19, 20, 21, 22, 23, 24, 25, 26, 27, 28, 29, 30, 31};
    __m512i const columns = _mm512_add_epi16(_mm512_load_si512(numbers), _mm512_set1_epi16(static_cast<short>(column)));
    __m512i counts = _mm512_setzero_si512();
    for (std::uint32_t i = start; i < end; ++i) {
        __m512i const off = _mm512_sub_epi16(columns, _mm512_set1_epi16(static_cast<short>(runs.first[i])));
        __mmask32 const in = _mm512_cmplt_epu16_mask(off, _mm512_set1_epi16(static_cast<short>(runs.count[i])));
        counts = _mm512_mask_add_epi16(counts, in, counts, _mm512_set1_epi16(1));
    }
    return counts;
}

/// The cells of all rows, pairs of 32-bit offset and count, and the rows' parts. returns: the sum of the counts.
GNOMON_WIDE_TARGET inline std::uint64_t cells_by_rows(std::size_t rows, std::uint32_t columns, RowRuns& runs, std::uint32_t* cells) {
    runs.parts.resize(rows * ((columns + 31) / 32));
    RowPart* part = runs.parts.data();
    std::uint64_t sum = 0;
    for (std::size_t row = 0; row < rows; ++row, cells += 2 * columns) {
        std::uint32_t const start = runs.start[row], end = runs.start[row + 1];
        for (std::uint32_t column = 0; column < columns; column += 32) {
            __m512i const counts = count_over(runs, start, end, column);
            std::uint32_t const left = columns - column;
            std::uint32_t* const at = cells + 2 * column;
            sum += write_cells(_mm512_cvtepu16_epi32(_mm512_castsi512_si256(counts)), static_cast<std::uint32_t>(sum), left, at);
            __m512i const others = _mm512_cvtepu16_epi32(_mm512_extracti64x4_epi64(counts, 1));
            if (left > 16) sum += write_cells(others, static_cast<std::uint32_t>(sum), left - 16, at + 32);
            std::uint32_t const touched = _mm512_test_epi16_mask(counts, counts);
            *part = {start, end, column, touched, sum};
            part += touched != 0 ? 1 : 0;
        }
    }
    runs.part_count = static_cast<std::size_t>(part - runs.parts.data());
    return sum;
}

/// Writes the lights of `some`. returns: the end. `roomy`: 32 numbers may be written, as the next list writes over the rest.
template <bool roomy, class Index>
GNOMON_WIDE_INLINE Index* put(__mmask32 some, __m512i lights, Index* at) noexcept {
    __m512i const packed = _mm512_maskz_compress_epi16(some, lights);
    auto const n = static_cast<std::uint32_t>(_mm_popcnt_u32(some));
    if constexpr (roomy) {
        _mm512_storeu_si512(at, packed);
    } else if constexpr (std::is_same_v<Index, std::uint16_t>) {
        _mm512_mask_storeu_epi16(at, _bzhi_u32(~0U, n), packed);
    } else {
        alignas(64) std::uint16_t one[32];
        _mm512_store_si512(one, packed);
        for (std::uint32_t i = 0; i < n; ++i) at[i] = static_cast<Index>(one[i]);
    }
    return at + n;
}

/// Up to 32 runs of a row.
struct Runs32 {
    __m512i first, count, light;

    GNOMON_WIDE_INLINE void read(RowRuns const& from, std::uint32_t start, std::uint32_t end) noexcept {
        first = _mm512_loadu_si512(from.first.data() + start);
        count = _mm512_maskz_loadu_epi16(_bzhi_u32(~0U, end - start < 32 ? end - start : 32), from.count.data() + start);
        light = _mm512_loadu_si512(from.light.data() + start);
    }
    [[nodiscard]] GNOMON_WIDE_INLINE __mmask32 over(__m512i column) const noexcept {
        return _mm512_cmplt_epu16_mask(_mm512_sub_epi16(column, first), count);
    }
};

/// The next of a part's columns, in all lanes.
GNOMON_WIDE_INLINE __m512i next_column(RowPart& part) noexcept {
    std::uint32_t const at = part.column + static_cast<std::uint32_t>(std::countr_zero(part.touched));
    part.touched &= part.touched - 1;
    return _mm512_set1_epi16(static_cast<short>(at));
}

/// A row of up to 32 * `vectors` runs, which stay in registers, of lists that have room. returns: where they end.
template <std::uint32_t vectors, class Index>
GNOMON_WIDE_INLINE Index* fill_row(RowRuns const& from, RowPart row, Index* at) noexcept {
    Runs32 runs[vectors];
    for (std::uint32_t i = 0; i < vectors; ++i) runs[i].read(from, row.start + 32 * i, row.end);
    while (row.touched != 0) {
        __m512i const column = next_column(row);
        for (std::uint32_t i = 0; i < vectors; ++i) at = put<true>(runs[i].over(column), runs[i].light, at);
    }
    return at;
}

/// A row of any number of runs.
template <bool roomy, class Index>
GNOMON_WIDE_INLINE Index* fill_long_row(RowRuns const& from, RowPart row, Index* at) noexcept {
    while (row.touched != 0) {
        __m512i const column = next_column(row);
        for (std::uint32_t i = row.start; i < row.end; i += 32) {
            Runs32 runs;
            runs.read(from, i, row.end);
            at = put<roomy>(runs.over(column), runs.light, at);
        }
    }
    return at;
}

template <bool roomy, class Index>
GNOMON_WIDE_INLINE Index* fill_parts(RowRuns const& from, std::size_t first, std::size_t end, Index* at) noexcept {
    for (RowPart const *part = from.parts.data() + first, *const last = from.parts.data() + end; part != last; ++part) {
        if constexpr (roomy) {  // the others are few, or in need of another number type
            std::uint32_t const vectors = (part->end - part->start + 31) / 32;
            if (vectors == 1) at = fill_row<1>(from, *part, at);
            else if (vectors == 2) at = fill_row<2>(from, *part, at);
            else if (vectors == 3) at = fill_row<3>(from, *part, at);
            else at = fill_long_row<true>(from, *part, at);
        } else {
            at = fill_long_row<false>(from, *part, at);
        }
    }
    return at;
}

/// expects: `indices` of as many elements as the cells say.
template <class Index>
GNOMON_WIDE_TARGET void fill_by_rows(RowRuns const& runs, Index* indices) noexcept {
    std::size_t const parts = runs.part_count;
    std::size_t roomy = 0;
    if constexpr (std::is_same_v<Index, std::uint16_t>) {
        for (roomy = parts; roomy > 0 && runs.parts[parts - 1].list_end - runs.parts[roomy - 1].list_end < 32;) --roomy;
        indices = fill_parts<true>(runs, 0, roomy, indices);
    }
    fill_parts<false>(runs, roomy, parts, indices);
}

GNOMON_WIDE_END
#endif

}  // namespace gnomon::lights::detail
