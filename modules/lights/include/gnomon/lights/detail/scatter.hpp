#pragma once
// From lights to rows, and from rows to bits.

#include <gnomon/cull/detail/rows_avx2.hpp>
#include <gnomon/cull/rows.hpp>
#include <gnomon/lights/admit.hpp>
#include <gnomon/lights/detail/shapes.hpp>

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

/// Every row of every slice that a light touches, one at a time: `sink.light(index)`, then `sink.row(row, columns)`.
template <class Sink>
void scatter_scalar(cull::RowGrid const& grid, std::span<Light const> lights, Workspace const& work, Sink& sink) {
    for (std::size_t n = 0; n < work.index.size(); ++n) {
        sink.light(work.index[n]);
        for_each_row(grid, lights[work.index[n]], work.radius[n],
                     [&](std::uint32_t row, cull::Span const& span) {
                         cull::Columns const columns = cull::columns_of(grid, span);
                         if (!columns.empty()) sink.row(row, columns);
                     });
    }
}

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

using cull::detail::L8;
using cull::detail::M8;

/// The same bits by comparing every column of the light's reach with the span: no run has ends to branch on.
struct PlaneSink8 {
    PlaneTarget to;
    float const* left;
    float const* right;
    std::uint32_t columns;
    std::uint32_t* plane;
    __m256i bit;
    std::uint32_t first, past;

    GNOMON_ROWS_INLINE void begin(cull::detail::Reach const& reach) noexcept {
        first = reach.column_first;
        past = reach.column_last + 1;
    }
    GNOMON_ROWS_INLINE void row(std::uint32_t row, float low, float high) const noexcept {
        __m256 const l = _mm256_set1_ps(low), h = _mm256_set1_ps(high);
        std::uint32_t* const at = plane + std::size_t{row} * columns;
        for (std::uint32_t i = first; i < past; i += 8) {
            __m256 const in = _mm256_and_ps(_mm256_cmp_ps(_mm256_loadu_ps(left + i), h, _CMP_LE_OQ),
                                            _mm256_cmp_ps(_mm256_loadu_ps(right + i), l, _CMP_GE_OQ));
            auto* const word = reinterpret_cast<__m256i*>(at + i);
            _mm256_storeu_si256(word, _mm256_or_si256(_mm256_loadu_si256(word), _mm256_and_si256(_mm256_castps_si256(in), bit)));
        }
    }
};

template <bool perspective>
GNOMON_ROWS_TARGET void scatter_planes_avx2(cull::RowGrid const& grid, std::span<Light const> lights, Workspace const& work,
                                            PlaneTarget const& to) {
    cull::detail::ReadyFields fields;
    PlaneSink8 sink{to, grid.left.data(), grid.right.data(), grid.columns, nullptr, {}, 0, 0};
    std::uint32_t cleared = 0;
    (void)lights;
    for (std::size_t n = 0; n < work.index.size(); n += 8) {
        cull::detail::make_ready(work.x.data() + n, work.y.data() + n, work.depth.data() + n, work.radius.data() + n, perspective, fields);
        for (std::size_t lane = 0; lane < 8 && n + lane < work.index.size(); ++lane) {
            std::uint32_t const index = work.index[n + lane];
            for (; cleared <= index / 32; ++cleared) std::fill_n(to.words + cleared * to.stride, to.stride, 0U);
            sink.plane = to.words + index / 32 * to.stride;
            sink.bit = _mm256_set1_epi32(static_cast<int>(1U << (index % 32)));
            cull::detail::visit_ball<perspective>(grid, fields, lane, sink);
        }
    }
    for (; cleared < to.groups; ++cleared) std::fill_n(to.words + cleared * to.stride, to.stride, 0U);
}

#endif

inline void scatter_planes(cull::RowGrid const& grid, std::span<Light const> lights, Workspace const& work, PlaneTarget const& to,
                           bool lanes) {
#if GNOMON_CULL_AVX2
    if (lanes && cull::detail::has_avx2() && grid.slices <= cull::detail::max_slices_avx2) {
        if (grid.perspective) return scatter_planes_avx2<true>(grid, lights, work, to);
        return scatter_planes_avx2<false>(grid, lights, work, to);
    }
#endif
    (void)lanes;
    std::fill_n(to.words, to.groups * to.stride, 0U);
    PlaneSink sink{to, grid.columns};
    scatter_scalar(grid, lights, work, sink);
}

}  // namespace gnomon::lights::detail
