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
    for (std::size_t r = 2; r < rows + 2; ++r) start[r] += start[r - 1];
    if (to.first.size() < runs.size() + 32)
        for (auto* list : {&to.first, &to.count, &to.light}) list->resize(2 * runs.size() + 32);
    for (Run const& run : runs) {
        std::uint32_t const at = start[run.row + 1]++;
        to.first[at] = static_cast<std::uint16_t>(run.first);
        to.count[at] = static_cast<std::uint16_t>(run.count);
        to.light[at] = static_cast<std::uint16_t>(run.light);
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
GNOMON_WIDE_INLINE std::uint32_t write_cells(__m512i counts, std::uint32_t offset, std::uint32_t lanes, void* cells) noexcept {
    __m512i const sums = running_sums(counts);
    __m512i const offsets = _mm512_add_epi32(_mm512_sub_epi32(sums, counts), _mm512_set1_epi32(static_cast<int>(offset)));
    __m512i const first = _mm512_setr_epi32(0, 16, 1, 17, 2, 18, 3, 19, 4, 20, 5, 21, 6, 22, 7, 23);
    __m512i const second = _mm512_add_epi32(first, _mm512_set1_epi32(8));
    std::uint32_t const there = _bzhi_u32(0xFFFFU, lanes);
    auto* const at = static_cast<std::uint64_t*>(cells);
    _mm512_mask_storeu_epi64(at, static_cast<__mmask8>(there), _mm512_permutex2var_epi32(offsets, first, counts));
    _mm512_mask_storeu_epi64(at + 8, static_cast<__mmask8>(there >> 8U), _mm512_permutex2var_epi32(offsets, second, counts));
    return static_cast<std::uint32_t>(_mm_extract_epi32(_mm512_extracti32x4_epi32(sums, 3), 3));
}

/// The cells of all rows, and which columns are touched; `cells` are pairs of 32-bit offset and count.
GNOMON_WIDE_TARGET inline void cells_by_rows(std::size_t rows, std::uint32_t columns, RowRuns& by_rows, unsigned char* cells) {
    std::uint32_t const words = (columns + 31) / 32;
    by_rows.touched.resize(rows * words);
    std::uint64_t sum = 0;
    alignas(64) static constexpr std::uint16_t numbers[32] = {0,  1,  2,  3,  4,  5,  6,  7,  8,  9,  10, 11, 12, 13, 14, 15,
                                                              16, 17, 18, 19, 20, 21, 22, 23, 24, 25, 26, 27, 28, 29, 30, 31};
    for (std::size_t row = 0; row < rows; ++row)
        for (std::uint32_t word = 0; word < words; ++word) {
            __m512i const column = _mm512_add_epi16(_mm512_load_si512(numbers), _mm512_set1_epi16(static_cast<short>(32 * word)));
            __m512i counts = _mm512_setzero_si512();
            for (std::uint32_t i = by_rows.start[row]; i < by_rows.start[row + 1]; ++i) {
                __m512i const off = _mm512_sub_epi16(column, _mm512_set1_epi16(static_cast<short>(by_rows.first[i])));
                __mmask32 const in = _mm512_cmplt_epu16_mask(off, _mm512_set1_epi16(static_cast<short>(by_rows.count[i])));
                counts = _mm512_mask_add_epi16(counts, in, counts, _mm512_set1_epi16(1));
            }
            by_rows.touched[row * words + word] = _mm512_test_epi16_mask(counts, counts);
            std::uint32_t const left = columns - 32 * word;
            unsigned char* const at = cells + 8 * (row * columns + 32 * word);
            sum += write_cells(_mm512_cvtepu16_epi32(_mm512_castsi512_si256(counts)), static_cast<std::uint32_t>(sum), left, at);
            if (left > 16)
                sum += write_cells(_mm512_cvtepu16_epi32(_mm512_extracti64x4_epi64(counts, 1)), static_cast<std::uint32_t>(sum), left - 16, at + 128);
        }
    by_rows.written = sum;
}

/// Where lists go: one after the other.
template <class Index>
struct ListEnd {
    Index* at;
    Index* end;

    /// Appends the lights of `some`.
    GNOMON_WIDE_INLINE void put(__mmask32 some, __m512i lights) noexcept {
        __m512i const packed = _mm512_maskz_compress_epi16(some, lights);
        auto const n = static_cast<std::uint32_t>(_mm_popcnt_u32(some));
        if constexpr (std::is_same_v<Index, std::uint16_t>) {
            // What is written too far is written over: lists ascend.
            if (end - at >= 32) _mm512_storeu_si512(at, packed);
            else _mm512_mask_storeu_epi16(at, _bzhi_u32(~0U, n), packed);
        } else {
            alignas(64) std::uint16_t one[32];
            _mm512_store_si512(one, packed);
            for (std::uint32_t i = 0; i < n; ++i) at[i] = static_cast<Index>(one[i]);
        }
        at += n;
    }
};

/// expects: `indices` of `written` elements.
template <class Index>
GNOMON_WIDE_TARGET void fill_by_rows(RowRuns const& by_rows, Index* indices) noexcept {
    std::size_t const rows = by_rows.start.size() - 2, words = rows != 0 ? by_rows.touched.size() / rows : 0;
    ListEnd<Index> list{indices, indices + by_rows.written};
    for (std::size_t row = 0; row < rows; ++row) {
        std::uint32_t const start = by_rows.start[row], end = by_rows.start[row + 1];
        for (std::uint32_t word = 0; word < words; ++word)
            for (std::uint32_t some = by_rows.touched[row * words + word]; some != 0; some &= some - 1) {
                __m512i const column = _mm512_set1_epi16(static_cast<short>(32 * word + static_cast<std::uint32_t>(std::countr_zero(some))));
                for (std::uint32_t i = start; i < end; i += 32) {
                    __m512i const off = _mm512_sub_epi16(column, _mm512_loadu_si512(by_rows.first.data() + i));
                    __mmask32 const in = _mm512_cmplt_epu16_mask(off, _mm512_loadu_si512(by_rows.count.data() + i));
                    list.put(in & _bzhi_u32(~0U, end - i), _mm512_loadu_si512(by_rows.light.data() + i));
                }
            }
    }
}

GNOMON_WIDE_END
#endif

}  // namespace gnomon::lights::detail
