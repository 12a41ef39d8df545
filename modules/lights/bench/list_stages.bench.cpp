// What each stage of the lists takes, beside the same lists from known runs. A table: --benchmark_filter=list_stages
// --benchmark_counters_tabular=true
//
// Microseconds, the least of many calls. `plain_floor`: count, sums and fill from known runs, one after the other;
// `wide_floor`: the same by the lanes that the lists take, which is sort + cells + fill. `roots`: the roots and
// divisions of the spans alone.

#include "setup.hpp"

#include <benchmark/benchmark.h>

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <vector>

#if GNOMON_CULL_AVX2

namespace {

using namespace gnomon;
using bench::Setup;

template <class Work>
double least_us(Work work) {
    using Clock = std::chrono::steady_clock;
    double least = 1e9;
    for (int turn = 0; turn < 1000; ++turn) {
        Clock::time_point const start = Clock::now();
        work();
        least = std::min(least, std::chrono::duration<double, std::micro>(Clock::now() - start).count());
    }
    return least;
}

/// Counts what a stream has and gives, and writes nothing.
struct CountSink {
    std::size_t borders = 0;
    std::size_t rows_touched = 0;

    void reserve(std::size_t most) noexcept { borders += most; }
    void balls(std::size_t) noexcept {}
    GNOMON_WIDE_INLINE void rows(cull::detail::Rows16 const& r) noexcept {
        rows_touched += static_cast<std::size_t>(__builtin_popcount(static_cast<unsigned>(r.some.v)));
    }
};

GNOMON_WIDE_TARGET void find_reaches(cull::RowGrid const& grid, cull::detail::Input const& in, std::size_t count) {
    using namespace cull::detail;
    Tables16 const tables = make_tables(grid);
    Balls16 balls;
    Reach16 reach;
    for (std::size_t n = 0; n < count; n += 16) {
        make_ready<true>(wide_load(in.x + n), wide_load(in.y + n), wide_load(in.depth + n), wide_load(in.radius + n), balls);
        find_reach<true>(tables, balls, reach);
        benchmark::DoNotOptimize(&balls);
        benchmark::DoNotOptimize(&reach);
        benchmark::ClobberMemory();
    }
}

GNOMON_WIDE_TARGET void find_spans(cull::RowGrid const& grid, cull::detail::Input const& in, std::size_t count, CountSink& sink) {
    cull::detail::visit_stream<true, true>(grid, in, count, sink);
}

/// The roots and divisions of the spans of some sixteens of borders, and nothing else: five and two.
GNOMON_WIDE_TARGET void divide_only(float const* from, std::size_t sixteens) {
    using namespace cull::detail;
    F16 sum = wide(0.0F);
    for (std::size_t i = 0; i < sixteens; ++i) {
        float const* const at = from + 16 * (i % 32);
        for (int k = 0; k < 5; ++k) sum = greatest(sum, root(wide_load(at + 16 * k)));
        for (int k = 5; k < 7; ++k) sum = greatest(sum, wide_load(at + 16 * k) / wide_load(at + 16 * k + 16));
    }
    benchmark::DoNotOptimize(&sum);
    benchmark::ClobberMemory();
}

void list_stages(benchmark::State& state) {
    if (!cull::detail::has_wide_lanes()) return state.SkipWithError("there are no wide lanes here");
    Setup const setup(state.range(0), state.range(1), false);
    cull::RowGrid const& grid = setup.grid;
    std::size_t const rows = std::size_t{grid.rows} * grid.slices;
    lights::Workspace work;
    std::vector<lights::Cell> cells(grid.clusters());
    std::vector<std::uint16_t> indices(4'000'000);
    auto const report = lights::count_lists(grid, setup.lights, {}, work, cells);
    std::size_t const runs = work.run_count;
    CountSink counted;
    find_spans(grid, lights::detail::input_of(work), work.count, counted);
    for ([[maybe_unused]] auto _ : state) {
        auto const set = [&](char const* name, double us) { state.counters[name] = us; };
        set("1_read", least_us([&] { benchmark::DoNotOptimize(lights::admit(setup.lights, ~0U, work).taken); }));
        set("2_reach", least_us([&] { find_reaches(grid, lights::detail::input_of(work), work.count); }));
        set("3_spans", least_us([&] {
            CountSink sink;
            find_spans(grid, lights::detail::input_of(work), work.count, sink);
            benchmark::DoNotOptimize(sink.rows_touched);
        }) - state.counters["2_reach"]);
        std::vector<float> const numbers(1024, 3.7F);
        set("roots", least_us([&] { divide_only(numbers.data(), (counted.borders + 14) / 15); }));
        set("4_runs", least_us([&] {
            work.run_count = 0;
            lights::detail::find_ball_runs(grid, work);
        }) - state.counters["2_reach"] - state.counters["3_spans"]);
        set("5_sort", least_us([&] { lights::detail::sort_by_rows({work.runs.data(), runs}, rows, work.by_rows); }));
        set("6_cells", least_us([&] {
            lights::detail::cells_by_rows(rows, grid.columns, work.by_rows, reinterpret_cast<std::uint32_t*>(cells.data()));
        }));
        set("7_fill", least_us([&] { lights::fill_lists<std::uint16_t>(work, indices); }));
        double const all = least_us([&] {
            benchmark::DoNotOptimize(lights::count_lists(grid, setup.lights, {}, work, cells).written);
            lights::fill_lists<std::uint16_t>(work, indices);
        });
        double const wide_floor = state.counters["5_sort"] + state.counters["6_cells"] + state.counters["7_fill"];
        double const plain_floor = least_us([&] {
            benchmark::DoNotOptimize(lights::detail::lay_out_scalar(grid.columns, work, cells));
            lights::detail::fill_scalar<std::uint16_t>(work, indices);
        });
        set("all", all);
        set("plain_floor", plain_floor);
        set("wide_floor", wide_floor);
        set("all/plain", all / plain_floor);
        set("all/wide", all / wide_floor);
    }
    state.counters["borders"] = static_cast<double>(counted.borders);
    state.counters["runs"] = static_cast<double>(runs);
    state.counters["pairs"] = static_cast<double>(report.written);
}

}  // namespace

BENCHMARK(list_stages)->ArgNames({"scene", "lights"})->ArgsProduct({{0, 1, 2, 3}, {256, 4096}})->Iterations(1);

#endif
