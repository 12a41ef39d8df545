#pragma once
// Light lists in three arrays: a cell (offset, count) a cluster, the indices of the lights, and the caller's lights.
//
// First the count, exact; then the fill. A cluster's indices ascend, whichever way the lists were made.
//
// source: [Olsson 2014, Paper II, 3.4]: grid, light index list, light list

#include <gnomon/core/contract.hpp>
#include <gnomon/cull/rows.hpp>
#include <gnomon/lights/admit.hpp>
#include <gnomon/lights/detail/list_cells.hpp>
#include <gnomon/lights/detail/list_rows.hpp>
#include <gnomon/lights/light.hpp>

#include <algorithm>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

namespace gnomon::lights {

/// A cluster's part of the index list. As two words in a shader.
struct Cell {
    std::uint32_t offset = 0;
    std::uint32_t count = 0;
    friend bool operator==(Cell const&, Cell const&) = default;
};

struct ListsConfig {
    std::uint32_t layers = ~0U;
    std::uint64_t capacity = 0xFFFFFFFFU;  ///< The most indices that the caller has room for.
    bool lanes = true;                     ///< false: the scalar code, which gives the same lists
};

struct ListsReport {
    Report lights;
    std::uint64_t needed = 0;    ///< indices of all lights that take part
    std::uint64_t written = 0;   ///< indices that `fill_lists` writes: `needed`, or less where the capacity is less
    std::uint32_t left_out = 0;  ///< lights left out for that, the least important: `work.pairs[i].light`, i < left_out
};

namespace detail {

/// Adds 1 to the count of each cluster of each run.
inline void count_runs(std::span<Run const> runs, std::uint32_t columns, std::uint32_t* counts) noexcept {
    for (Run const& run : runs) {
        std::uint32_t* const of_run = counts + std::size_t{run.row} * columns + run.first;
        for (std::uint32_t i = 0; i < run.count; ++i) ++of_run[i];
    }
}

/// Cells out of counts, whose list becomes that of the offsets. returns: the sum.
inline std::uint64_t make_cells(std::span<std::uint32_t> counts, std::span<Cell> cells) noexcept {
    std::uint64_t sum = 0;
    for (std::size_t i = 0; i < counts.size(); ++i) {
        std::uint32_t const count = counts[i];
        cells[i] = {static_cast<std::uint32_t>(sum), count};
        counts[i] = static_cast<std::uint32_t>(sum);
        sum += count;
    }
    return sum;
}

/// Cells and cursors out of runs. returns: the sum of the counts; above 2^32 - 1 the offsets are no use.
inline std::uint64_t lay_out_scalar(std::uint32_t columns, Workspace& work, std::span<Cell> cells) {
    work.by_rows.used = false;
    work.columns = columns;
    work.cursors.assign(cells.size(), 0);
    count_runs({work.runs.data(), work.run_count}, columns, work.cursors.data());
    return make_cells(work.cursors, cells);
}

/// The same cells by lanes where there are any, for what 16 bits can count.
inline std::uint64_t lay_out(cull::RowGrid const& grid, std::size_t lights, bool lanes, Workspace& work, std::span<Cell> cells) {
#if GNOMON_CULL_AVX2
    if (lanes && lights <= 0xFFFFU && grid.columns <= 0x8000U && cull::detail::has_wide_lanes()) {
        std::size_t const rows = std::size_t{grid.rows} * grid.slices;
        work.by_rows.used = true;
        work.by_rows.lights = lights;
        sort_by_rows({work.runs.data(), work.run_count}, rows, work.by_rows);
        return cells_by_rows(rows, grid.columns, work.by_rows, reinterpret_cast<std::uint32_t*>(cells.data()));
    }
#endif
    (void)lights, (void)lanes;
    return lay_out_scalar(grid.columns, work, cells);
}

/// Sorts `pairs` least important first, of the same importance the last light first, and says how many go until the others
/// fit. `written` becomes what those have.
inline std::uint32_t choose_left_out(std::vector<LightPairs>& pairs, std::uint64_t needed, std::uint64_t capacity,
                                     std::uint64_t& written) {
    std::sort(pairs.begin(), pairs.end(), [](LightPairs const& a, LightPairs const& b) {
        bool const a_nan = a.importance != a.importance, b_nan = b.importance != b.importance;  // NaN: least of all
        if (a_nan != b_nan) return a_nan;
        if (!a_nan && a.importance != b.importance) return a.importance < b.importance;
        return a.light > b.light;
    });
    written = needed;
    std::uint32_t out = 0;
    for (; written > capacity; ++out) written -= pairs[out].pairs;
    return out;
}

/// Takes the runs of the least important lights out until the rest fit; `work.pairs` is as `choose_left_out` leaves it.
/// returns: how many were left out.
inline std::uint32_t leave_out(std::span<Light const> lights, std::uint64_t needed, std::uint64_t capacity, Workspace& work,
                               std::uint64_t& written) {
    work.pairs.clear();
    for (std::size_t i = 0; i < work.run_count; ++i) {
        Run const& run = work.runs[i];
        if (work.pairs.empty() || work.pairs.back().light != run.light)
            work.pairs.push_back({run.light, lights[run.light].importance, 0});
        work.pairs.back().pairs += run.count;
    }
    std::uint32_t const out = choose_left_out(work.pairs, needed, capacity, written);
    std::vector<bool> gone(lights.size());
    for (std::uint32_t i = 0; i < out; ++i) gone[work.pairs[i].light] = true;
    std::size_t kept = 0;
    for (std::size_t i = 0; i < work.run_count; ++i)
        if (!gone[work.runs[i].light]) work.runs[kept++] = work.runs[i];
    work.run_count = kept;
    return out;
}

}  // namespace detail

/// Finds what every light touches, and writes to `cells` where each cluster's indices will be.
///
/// expects: the lights in the grid's culling space; as many cells as the grid has clusters; `work` untouched until the fill.
/// returns: exact sizes. Where `needed` is above `config.capacity`, the least important lights are left out until the
///          rest fits: of equal importance the last of the list first, NaN before all others.
/// cost:    O(clusters + pairs); allocates when `work` grows, and where lights are left out.
[[nodiscard]] inline ListsReport count_lists(cull::RowGrid const& grid, std::span<Light const> lights, ListsConfig const& config,
                                             Workspace& work, std::span<Cell> cells) {
    GNOMON_EXPECT(cells.size() == grid.clusters());
    ListsReport report;
    report.lights = admit(lights, config.layers, work);
    detail::find_runs(grid, lights, work, config.lanes);
    report.needed = report.written = detail::lay_out(grid, lights.size(), config.lanes, work, cells);
    std::uint64_t const capacity = std::min<std::uint64_t>(config.capacity, 0xFFFFFFFFU);
    if (report.needed > capacity) {
        report.left_out = detail::leave_out(lights, report.needed, capacity, work, report.written);
        (void)detail::lay_out(grid, lights.size(), config.lanes, work, cells);
    }
    return report;
}

namespace detail {

template <std::unsigned_integral Index>
void fill_scalar(Workspace& work, std::span<Index> indices) noexcept {
    std::uint32_t* const cursors = work.cursors.data();
    for (std::size_t r = 0; r < work.run_count; ++r) {
        Run const run = work.runs[r];
        GNOMON_EXPECT(run.light <= std::numeric_limits<Index>::max());
        std::uint32_t* const of_run = cursors + std::size_t{run.row} * work.columns + run.first;
        for (std::uint32_t i = 0; i < run.count; ++i) {
            std::uint32_t const at = of_run[i]++;
            GNOMON_EXPECT(at < indices.size());
            indices[at] = static_cast<Index>(run.light);
        }
    }
}

}  // namespace detail

/// Writes the lists that `count_lists` counted; uint16_t holds the indices of up to 65,536 lights.
///
/// expects: `work` as the count left it (one fill a count), `indices` of at least `written` elements.
/// cost:    O(pairs)
template <std::unsigned_integral Index>
void fill_lists(Workspace& work, std::span<Index> indices) noexcept {
#if GNOMON_CULL_AVX2
    if (work.by_rows.used) {
        GNOMON_EXPECT(work.by_rows.part_count == 0 || work.by_rows.parts[work.by_rows.part_count - 1].list_end <= indices.size());
        GNOMON_EXPECT(sizeof(Index) > 1 || work.by_rows.lights <= 256);
        detail::fill_by_rows(work.by_rows, indices.data());
        return;
    }
#endif
    detail::fill_scalar(work, indices);
}

}  // namespace gnomon::lights
