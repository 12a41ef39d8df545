// One thread against two, interleaved, each after a pass of its own kind: medians of nine.
//
// `wall_ratio` is what the clock on the wall shows. It says little on a machine whose cores are busy with other work,
// so `path_ratio` compares CPU times: one thread's, over the two threads' critical path. That path is the main thread's
// CPU time outside of parallel loops, and for each loop that of the busier thread. It counts what the pass itself does
// not share (serial parts, uneven shares, caches and memory that both fight for), not the cores that others took.
// `machine_ratio` is the same for two loops that share nothing: virtual processors may well share a core.

#include <gnomon/core/executor_tbb.hpp>
#include <gnomon/raster.hpp>

#include <benchmark/benchmark.h>

#include <algorithm>
#include <cstdint>
#include <map>
#include <mutex>
#include <thread>

#include "city.hpp"
#include "clocks.hpp"

namespace {

using namespace gnomon;

/// Adds up the CPU time of the busier thread of each loop.
class MeteredExecutor {
  public:
    explicit MeteredExecutor(core::TbbExecutor const& pool) : pool_(pool) {}

    template <class F>
    void parallel_for(std::size_t n, std::size_t grain, F&& f) {
        std::map<std::thread::id, double> busy;
        std::mutex mutex;
        double const start = bench::now_ms(CLOCK_THREAD_CPUTIME_ID);
        pool_.parallel_for(n, grain, [&](std::size_t begin, std::size_t end) {
            double const from = bench::now_ms(CLOCK_THREAD_CPUTIME_ID);
            f(begin, end);
            double const spent = bench::now_ms(CLOCK_THREAD_CPUTIME_ID) - from;
            std::lock_guard const lock(mutex);
            busy[std::this_thread::get_id()] += spent;
        });
        in_loops_ += bench::now_ms(CLOCK_THREAD_CPUTIME_ID) - start;
        double most = 0.0;
        for (auto const& [thread, spent] : busy) most = std::max(most, spent);
        path_ += most;
    }

    /// Of a run that took the main thread `main_ms` of CPU time in all.
    [[nodiscard]] double critical_path_ms(double main_ms) const { return main_ms - in_loops_ + path_; }

  private:
    core::TbbExecutor const& pool_;
    double in_loops_ = 0.0;
    double path_ = 0.0;
};

/// Runs ranges of `grain` on one thread and adds up what the busier of two would take.
class SharingExecutor {
  public:
    template <class F>
    void parallel_for(std::size_t n, std::size_t grain, F&& f) {
        double busy[2] = {0.0, 0.0};
        double const start = bench::now_ms(CLOCK_THREAD_CPUTIME_ID);
        for (std::size_t begin = 0; begin < n; begin += grain) {
            double const from = bench::now_ms(CLOCK_THREAD_CPUTIME_ID);
            f(begin, std::min(n, begin + grain));
            busy[busy[1] < busy[0] ? 1 : 0] += bench::now_ms(CLOCK_THREAD_CPUTIME_ID) - from;
        }
        in_loops_ += bench::now_ms(CLOCK_THREAD_CPUTIME_ID) - start;
        path_ += std::max(busy[0], busy[1]);
        sum_ += busy[0] + busy[1];
    }

    /// Of a run that took `main_ms` of CPU time in all, the timing of ranges left out: one thread over two.
    [[nodiscard]] double ratio(double main_ms) const {
        return (main_ms - in_loops_ + sum_) / (main_ms - in_loops_ + path_);
    }

  private:
    double in_loops_ = 0.0;
    double path_ = 0.0;
    double sum_ = 0.0;
};

/// Two pieces of work that share nothing, not even memory: what the machine itself makes of two threads.
void count_twice(core::ExecutorRef executor) {
    executor.parallel_for(2, 1, [](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            std::uint32_t x[8] = {1, 2, 3, 4, 5, 6, 7, 8};
            for (int step = 0; step < 2'000'000; ++step)
                for (std::uint32_t& lane : x) lane = lane * 1664525U + 1013904223U;
            benchmark::DoNotOptimize(x);
        }
    });
}

void two_threads(benchmark::State& state) {
    bench::City const city = bench::make_city(static_cast<int>(state.range(0)));
    auto const size = static_cast<std::int32_t>(state.range(2));
    math::View const view = bench::make_view(state.range(1) == 0, size);
    raster::Draw const draw{.positions = std::span<math::vec3 const>(city.positions),
                            .indices = std::span<std::uint32_t const>(city.indices),
                            .origin = math::to_float(view.eye_m),
                            .clip_from_relative = math::clip_from_relative(view)};
    std::vector<float> depth(static_cast<std::size_t>(size) * static_cast<std::size_t>(size));
    raster::Workspace workspace;
    auto const pass = [&](core::ExecutorRef executor) {
        raster::depth_pass({&draw, 1}, raster::make_image(depth.data(), size, size), {.depth = math::Depth::forward},
                           workspace, executor);
    };
    core::SerialExecutor serial;
    core::TbbExecutor const pool(2);
    pass(serial);
    pass(pool);
    bench::Times one;
    bench::Times two;
    bench::Times counting_one;
    bench::Times counting_two;
    std::vector<double> path;
    std::vector<double> share;
    for (auto _ : state) {
        // As in a program that draws frame after frame: a core that slept through the last pass is slow in the next.
        pass(serial);
        one.measure([&] { pass(serial); });
        counting_one.measure([&] { count_twice(serial); });
        pass(pool);
        two.measure([&] { pass(pool); });
        counting_two.measure([&] { count_twice(pool); });
        MeteredExecutor metered(pool);
        double const start = bench::now_ms(CLOCK_THREAD_CPUTIME_ID);
        pass(metered);
        path.push_back(metered.critical_path_ms(bench::now_ms(CLOCK_THREAD_CPUTIME_ID) - start));
        SharingExecutor sharing;
        double const alone = bench::now_ms(CLOCK_THREAD_CPUTIME_ID);
        pass(sharing);
        share.push_back(sharing.ratio(bench::now_ms(CLOCK_THREAD_CPUTIME_ID) - alone));
    }
    state.counters["one_ms"] = bench::median(one.cpu);
    state.counters["path_ms"] = bench::median(path);
    state.counters["path_ratio"] = bench::median(one.cpu) / bench::median(path);
    state.counters["share_ratio"] = bench::median(share);
    state.counters["wall_ratio"] = bench::median(one.wall) / bench::median(two.wall);
    state.counters["machine_ratio"] = bench::median(counting_one.wall) / bench::median(counting_two.wall);
    state.counters["best_wall_ratio"] =
        *std::min_element(one.wall.begin(), one.wall.end()) / *std::min_element(two.wall.begin(), two.wall.end());
}

BENCHMARK(two_threads)
    ->ArgNames({"city", "persp", "px"})
    ->ArgsProduct({{0, 1, 2}, {0, 1}, {1024, 2048, 4096}})
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime()
    ->Iterations(9);

}  // namespace
