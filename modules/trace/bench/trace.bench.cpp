// Build and trace of the exact-ray yard, beside Embree (ROBUST) in the same run. CPU time of all threads; `ratio` is
// ours over Embree's.

#include <gnomon/core/executor_tbb.hpp>
#include <gnomon/trace/build.hpp>
#include <gnomon/trace/visibility.hpp>

#include "../tests/embree_scene.hpp"
#include "../tests/scenes.hpp"
#include "../tests/yard_view.hpp"

#include <benchmark/benchmark.h>

#include <algorithm>
#include <ctime>
#include <limits>
#include <span>
#include <string>
#include <vector>

using namespace gnomon;
using scenes::Light;

namespace {

/// Of all threads of this process: other processes' load does not count.
double cpu_seconds() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

/// Least CPU time of each of two ways to do a thing, run in turn.
struct Race {
    double ours_s = std::numeric_limits<double>::infinity();
    double peer_s = std::numeric_limits<double>::infinity();

    template <class Ours, class Peer>
    void run(Ours&& ours, Peer&& peer) {
        double const start = cpu_seconds();
        ours();
        double const middle = cpu_seconds();
        peer();
        double const end = cpu_seconds();
        ours_s = std::min(ours_s, middle - start);
        peer_s = std::min(peer_s, end - middle);
    }
    void report(benchmark::State& state) const {
        state.counters["ours_cpu_ms"] = ours_s * 1e3;
        state.counters["embree_cpu_ms"] = peer_s * 1e3;
        state.counters["ratio"] = ours_s / peer_s;
    }
};

void build(benchmark::State& state) {
    scenes::Yard const yard(static_cast<int>(state.range(0)));
    auto const threads = static_cast<int>(state.range(1));
    core::TbbExecutor executor(threads);
    Race race;
    [[maybe_unused]] std::string const config = "threads=" + std::to_string(threads);
    for (auto _ : state)
        race.run([&] { benchmark::DoNotOptimize(trace::build_bvh(yard.mesh.list(), executor).nodes.data()); },
                 [&] {
#if defined(GNOMON_HAS_EMBREE)
                     peer::EmbreeScene const embree(yard.mesh.list(), config.c_str());
                     benchmark::DoNotOptimize(&embree);
#endif
                 });
    race.report(state);
    state.counters["triangles"] = static_cast<double>(yard.mesh.corners.size());
}

void trace_lamp(benchmark::State& state) {
    scenes::Yard const yard(static_cast<int>(state.range(0)));
    core::TbbExecutor executor(static_cast<int>(state.range(1)));
    trace::Bvh const bvh = trace::build_bvh(yard.mesh.list(), executor);
    auto const samples = scenes::yard_samples(yard.mesh, bvh, 1024);
    auto const light = Light::point(math::vec3(12.3F, 220.7F, -120.1F));
    trace::VisibilityConfig<> const config{light};
    std::vector<std::uint64_t> bits(trace::visibility_words(samples.size()));
    Race race;
    trace::VisibilityStats stats;
#if defined(GNOMON_HAS_EMBREE)
    peer::EmbreeScene const embree(yard.mesh.list(), "threads=1");
#endif
    for (auto _ : state)
        race.run([&] { stats = visibility(bvh, std::span<sample::ViewSample const>(samples), bits, executor, config); },
                 [&] {
#if defined(GNOMON_HAS_EMBREE)
                     executor.parallel_for(samples.size(), 1024, [&](std::size_t begin, std::size_t end) {
                         bool any = false;
                         for (std::size_t i = begin; i < end; ++i)
                             if (!samples[i].triangle.is_none())
                                 any ^= embree.is_blocked({samples[i].position, light}, samples[i].triangle);
                         benchmark::DoNotOptimize(any);
                     });
#endif
                 });
    race.report(state);
    state.counters["samples"] = static_cast<double>(stats.samples);
    state.counters["exact"] = static_cast<double>(stats.counts.exact);
}

}  // namespace

// Arguments: subdivision of the boxes (2, 5, 10: 59k, 274k, 1.04M triangles), threads.
BENCHMARK(build)->ArgsProduct({{2, 5, 10}, {1, 2}})->Unit(benchmark::kMillisecond)->Iterations(3);
BENCHMARK(trace_lamp)->ArgsProduct({{2, 5, 10}, {1, 2}})->Unit(benchmark::kMillisecond)->Iterations(3);
