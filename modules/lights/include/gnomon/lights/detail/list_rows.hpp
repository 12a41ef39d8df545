#pragma once
// From rows to runs of clusters, by lights in ascending order, for the lists.

#include <gnomon/cull/detail/rows_avx2.hpp>
#include <gnomon/cull/rows.hpp>
#include <gnomon/lights/admit.hpp>
#include <gnomon/lights/detail/list_stream.hpp>
#include <gnomon/lights/detail/scalar.hpp>

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>

namespace gnomon::lights::detail {

struct RunSink {
    Workspace& work;
    std::uint32_t index = 0;

    void light(std::uint32_t i) noexcept { index = i; }
    void row(std::uint32_t row, cull::Columns const& run) {
        if (work.run_count == work.runs.size()) work.runs.resize(2 * work.runs.size() + 1024);
        work.runs[work.run_count++] = {row, run.first, run.count(), index};
    }
};

#if GNOMON_CULL_AVX2

/// The small lights of an eight go through their rows in step, so each has runs of its own until the eight is done.
struct RunSink8 {
    static constexpr std::size_t most = cull::detail::small_rows * cull::detail::small_slices;

    Workspace& work;
    cull::RowGrid const& grid;
    Run* next = nullptr;
    std::uint32_t const* index = nullptr;
    std::uint32_t flushed = 0;
    std::uint32_t counts[8];
    std::uint32_t first[8];
    alignas(32) std::int32_t origin[8];
    Run small[8][most];
    std::uint32_t from = 0, past = 0, light = 0;

    GNOMON_ROWS_INLINE void eight(std::size_t n, cull::detail::Ready8 const& b) noexcept {
        cull::detail::store(origin, b.slices.first * cull::detail::all(static_cast<std::int32_t>(grid.rows)) + b.rows.first);
        cull::detail::store(reinterpret_cast<std::int32_t*>(first), b.columns.first);
        for (std::uint32_t& c : counts) c = 0;
        index = work.index.data() + n;
        flushed = 0;
        reserve(8 * most);
    }
    void reserve(std::size_t more) {
        if (next != nullptr) work.run_count = static_cast<std::size_t>(next - work.runs.data());
        if (work.runs.size() < work.run_count + more) work.runs.resize(2 * work.runs.size() + more);
        next = work.runs.data() + work.run_count;
    }
    GNOMON_ROWS_INLINE std::uint32_t touched(std::uint32_t column, __m256 low, __m256 high) const noexcept {
        __m256 const in = _mm256_and_ps(_mm256_cmp_ps(_mm256_loadu_ps(grid.left.data() + column), high, _CMP_LE_OQ),
                                        _mm256_cmp_ps(_mm256_loadu_ps(grid.right.data() + column), low, _CMP_GE_OQ));
        return static_cast<std::uint32_t>(_mm256_movemask_ps(in));
    }
    GNOMON_ROWS_INLINE void small_row(std::uint32_t lane, std::uint32_t slice, std::uint32_t row, float low, float high) noexcept {
        std::uint32_t const in = touched(first[lane], _mm256_set1_ps(low), _mm256_set1_ps(high));
        std::uint32_t const at = static_cast<std::uint32_t>(origin[lane]) + slice * grid.rows + row;
        small[lane][counts[lane]] = {at, first[lane] + static_cast<std::uint32_t>(_tzcnt_u32(in)), static_cast<std::uint32_t>(_mm_popcnt_u32(in)), index[lane]};
        counts[lane] += in != 0 ? 1 : 0;
    }
    GNOMON_ROWS_INLINE void flush(std::uint32_t lanes) noexcept {
        for (; flushed < lanes; ++flushed)
            for (std::uint32_t i = 0; i < counts[flushed]; ++i) *next++ = small[flushed][i];
    }
    GNOMON_ROWS_INLINE void large(std::uint32_t lane, cull::detail::Ready8 const& b) {
        flush(lane);
        reserve(std::size_t{8 * most} + std::size_t{grid.rows} * grid.slices);
        from = cull::detail::pick(b.columns.first, lane);
        past = cull::detail::pick(b.columns.last, lane) + 1;
        light = index[lane];
    }
    GNOMON_ROWS_INLINE void large_row(std::uint32_t slice, std::uint32_t row, float low, float high) noexcept {
        __m256 const l = _mm256_set1_ps(low), h = _mm256_set1_ps(high);
        std::uint32_t const start = from, end = past;
        std::uint32_t begin = end, count = 0;
        if (end - start <= 64) {
            std::uint64_t in = 0;
            for (std::uint32_t i = start; i < end; i += 8) in |= std::uint64_t{touched(i, l, h)} << (i - start);
            begin = start + static_cast<std::uint32_t>(_tzcnt_u64(in));
            count = static_cast<std::uint32_t>(_mm_popcnt_u64(in));
        } else {
            for (std::uint32_t i = start; i < end; i += 8) {
                std::uint32_t const in = touched(i, l, h);
                std::uint32_t const at = i + static_cast<std::uint32_t>(_tzcnt_u32(in));
                begin = at < begin && in != 0 ? at : begin;
                count += static_cast<std::uint32_t>(_mm_popcnt_u32(in));
            }
        }
        *next = {slice * grid.rows + row, begin, count, light};
        next += count != 0 ? 1 : 0;
    }
    GNOMON_ROWS_INLINE void done() noexcept { flush(8); }
};

template <bool perspective>
GNOMON_ROWS_INLINE void find_runs_8(cull::RowGrid const& grid, Workspace& work) {
    RunSink8 sink{work, grid, nullptr, nullptr, 0, {}, {}, {}, {}};
    sink.reserve(1);
    cull::detail::visit_all<perspective>(grid, input_of(work), work.count, sink);
    sink.reserve(1);
}
template <bool perspective>
GNOMON_ROWS_TARGET void find_runs_avx2(cull::RowGrid const& grid, Workspace& work) {
    find_runs_8<perspective>(grid, work);
}
template <bool perspective>
GNOMON_ROWS_TARGET_32 void find_runs_32(cull::RowGrid const& grid, Workspace& work) {
    find_runs_8<perspective>(grid, work);
}

#endif

inline bool find_runs_lanes(cull::RowGrid const& grid, Workspace& work) {
#if GNOMON_CULL_AVX2
    if (!work.cones && cull::detail::has_stream(grid)) {
        find_ball_runs(grid, work);
        return true;
    }
    if (cull::detail::has_avx2()) {
        bool const wide = cull::detail::has_32_registers();
        if (grid.perspective) (wide ? find_runs_32<true> : find_runs_avx2<true>)(grid, work);
        else (wide ? find_runs_32<false> : find_runs_avx2<false>)(grid, work);
        return true;
    }
#endif
    (void)grid, (void)work;
    return false;
}

/// Fills `work.runs` with what every light that takes part touches, by lights.
inline void find_runs(cull::RowGrid const& grid, std::span<Light const> lights, Workspace& work, bool lanes) {
    work.run_count = 0;
    RunSink sink{work};
    if (!lanes || !find_runs_lanes(grid, work)) scatter_scalar(grid, lights, {work.index.data(), work.count}, sink);
    if (work.others.empty()) return;
    scatter_scalar(grid, lights, work.others, sink);
    std::sort(work.runs.begin(), work.runs.begin() + static_cast<std::ptrdiff_t>(work.run_count),
              [](Run const& a, Run const& b) { return a.light != b.light ? a.light < b.light : a.row < b.row; });
}

}  // namespace gnomon::lights::detail
