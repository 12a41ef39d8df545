#pragma once
// From rows to bits: planes written light by light.

#include <gnomon/cull/detail/rows_avx2.hpp>
#include <gnomon/cull/rows.hpp>
#include <gnomon/lights/admit.hpp>
#include <gnomon/lights/detail/scalar.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>

namespace gnomon::lights::detail {

struct PlaneTarget {
    std::uint32_t* words;
    std::size_t stride;
    std::uint32_t groups;
};

struct PlaneSink {
    PlaneTarget to;
    std::uint32_t columns;
    std::uint32_t* plane = nullptr;
    std::uint32_t bit = 0;

    void light(std::uint32_t index) noexcept {
        plane = to.words + index / 32 * to.stride;
        bit = 1U << (index % 32);
    }
    void row(std::uint32_t row, cull::Columns const& run) const noexcept {
        std::uint32_t* const at = plane + std::size_t{row} * columns;
        for (std::uint32_t i = run.first; i <= run.last; ++i) at[i] |= bit;
    }
};

#if GNOMON_CULL_AVX2

/// Apart, so that it stays the library's memset: inlined it becomes a string instruction.
[[gnu::noinline]] inline void clear_words(std::uint32_t* words, std::size_t count) noexcept { std::fill_n(words, count, 0U); }

/// The same bits by comparing columns with the span: no run has ends to branch on.
struct PlaneSink8 {
    PlaneTarget to;
    cull::RowGrid const& grid;
    std::uint32_t const* index;
    // Of eight lights: the first word of their reach, their bit, their first column's borders.
    std::uint32_t* origin[8];
    std::uint32_t bits[8];
    std::uint32_t first[8];
    // Of a large light.
    std::uint32_t* plane = nullptr;
    std::uint32_t bit = 0, from = 0, past = 0;
    std::uint32_t cleared = 0;

    /// Planes are cleared just before they are written to: they are then in the nearest cache.
    void clear(std::uint32_t groups) noexcept {
        if (groups <= cleared) return;
        clear_words(to.words + cleared * to.stride, (groups - cleared) * to.stride);
        cleared = groups;
    }
    GNOMON_ROWS_INLINE void eight(std::size_t n, cull::detail::Ready8 const& b) noexcept {
        alignas(32) std::int32_t word[8];
        cull::detail::I8 const rows = b.slices.first * cull::detail::all(static_cast<std::int32_t>(grid.rows)) + b.rows.first;
        cull::detail::store(word, rows * cull::detail::all(static_cast<std::int32_t>(grid.columns)) + b.columns.first);
        cull::detail::store(reinterpret_cast<std::int32_t*>(first), b.columns.first);
        for (std::uint32_t lane = 0; lane < 8; ++lane) {
            std::uint32_t const light = index[n + lane];
            if (light / 32 >= cleared) clear(light / 32 + 1);
            origin[lane] = to.words + light / 32 * to.stride + word[lane];
            bits[lane] = 1U << (light % 32);
        }
    }
    GNOMON_ROWS_INLINE void done() noexcept {}
    GNOMON_ROWS_INLINE static void put(std::uint32_t* at, float const* left, float const* right, cull::detail::Span8 span,
                                       __m256i bit) noexcept {
        __m256 const in = _mm256_and_ps(_mm256_cmp_ps(_mm256_loadu_ps(left), span.high.v, _CMP_LE_OQ),
                                        _mm256_cmp_ps(_mm256_loadu_ps(right), span.low.v, _CMP_GE_OQ));
        auto* const word = reinterpret_cast<__m256i*>(at);
        _mm256_storeu_si256(word, _mm256_or_si256(_mm256_loadu_si256(word), _mm256_and_si256(_mm256_castps_si256(in), bit)));
    }
    GNOMON_ROWS_INLINE void small_row(std::uint32_t lane, std::uint32_t slice, std::uint32_t row, float low, float high) noexcept {
        put(origin[lane] + std::size_t{slice * grid.rows + row} * grid.columns, grid.left.data() + first[lane],
            grid.right.data() + first[lane], {cull::detail::all(low), cull::detail::all(high)}, _mm256_set1_epi32(static_cast<int>(bits[lane])));
    }
    GNOMON_ROWS_INLINE void large(std::uint32_t lane, cull::detail::Ready8 const& b) noexcept {
        bit = bits[lane];
        from = cull::detail::pick(b.columns.first, lane);
        past = cull::detail::pick(b.columns.last, lane) + 1;
        plane = origin[lane] - (std::size_t{cull::detail::pick(b.slices.first, lane)} * grid.rows + cull::detail::pick(b.rows.first, lane)) * grid.columns - from;
    }
    GNOMON_ROWS_INLINE void large_row(std::uint32_t slice, std::uint32_t row, float low, float high) const noexcept {
        std::uint32_t* const at = plane + std::size_t{slice * grid.rows + row} * grid.columns;
        cull::detail::Span8 const span{cull::detail::all(low), cull::detail::all(high)};
        for (std::uint32_t i = from; i < past; i += 8)
            put(at + i, grid.left.data() + i, grid.right.data() + i, span, _mm256_set1_epi32(static_cast<int>(bit)));
    }
};

template <bool perspective>
GNOMON_ROWS_INLINE void scatter_planes_8(cull::RowGrid const& grid, Workspace const& work, PlaneTarget const& to) {
    PlaneSink8 sink{to, grid, work.index.data(), {}, {}, {}};
    cull::detail::visit_all<perspective>(grid, input_of(work), work.count, sink);
    sink.clear(to.groups);
}
template <bool perspective>
GNOMON_ROWS_TARGET void scatter_planes_avx2(cull::RowGrid const& grid, Workspace const& work, PlaneTarget const& to) {
    scatter_planes_8<perspective>(grid, work, to);
}
template <bool perspective>
GNOMON_ROWS_TARGET_32 void scatter_planes_32(cull::RowGrid const& grid, Workspace const& work, PlaneTarget const& to) {
    scatter_planes_8<perspective>(grid, work, to);
}

#endif

/// Points and spots. returns: false where there are no such lanes here.
inline bool scatter_planes_lanes(cull::RowGrid const& grid, Workspace const& work, PlaneTarget const& to) {
#if GNOMON_CULL_AVX2
    if (cull::detail::has_avx2()) {
        bool const wide = cull::detail::has_32_registers();
        if (grid.perspective) (wide ? scatter_planes_32<true> : scatter_planes_avx2<true>)(grid, work, to);
        else (wide ? scatter_planes_32<false> : scatter_planes_avx2<false>)(grid, work, to);
        return true;
    }
#endif
    (void)grid, (void)work, (void)to;
    return false;
}

inline void scatter_planes(cull::RowGrid const& grid, std::span<Light const> lights, Workspace const& work, PlaneTarget const& to,
                           bool lanes) {
    PlaneSink sink{to, grid.columns};
    if (!lanes || !scatter_planes_lanes(grid, work, to)) {
        std::fill_n(to.words, to.groups * to.stride, 0U);
        scatter_scalar(grid, lights, {work.index.data(), work.count}, sink);
    }
    scatter_scalar(grid, lights, work.others, sink);
}

}  // namespace gnomon::lights::detail
