// The depth pass of a forest of alpha-tested leaves from the sun, one thread, milliseconds: the reference's loop, the
// vector kernel with texels alone, with the map of cells, and the same triangles solid.

#include <gnomon/core/executor.hpp>
#include <gnomon/raster.hpp>

#include <benchmark/benchmark.h>

#include "forest.hpp"

namespace {

using namespace gnomon;

enum class Leaves { mapped, textured, solid };

void depth_of_forest(benchmark::State& state, raster::Kernel kernel, Leaves leaves) {
    bench::Forest forest;
    auto const size = static_cast<std::int32_t>(state.range(0));
    if (leaves == Leaves::mapped) forest.test.map = &forest.map;
    std::vector<raster::Draw> draws = forest.draws(bench::make_forest_view(size));
    if (leaves == Leaves::solid) draws[1].alpha_test = nullptr;
    std::vector<float> depth(static_cast<std::size_t>(size) * static_cast<std::size_t>(size));
    raster::Workspace workspace;
    core::SerialExecutor serial;
    raster::PassStats stats;
    for (auto _ : state)
        stats = raster::depth_pass(draws, raster::make_image(depth.data(), size, size), {.kernel = kernel}, workspace,
                                   serial);
    state.counters["triangles"] = static_cast<double>(stats.triangles);
    state.counters["drawn"] = static_cast<double>(stats.drawn);
    state.counters["Msamples"] = static_cast<double>(stats.samples_written) * 1e-6;
}

void make_map(benchmark::State& state) {
    bench::Forest const forest;
    for (auto _ : state) benchmark::DoNotOptimize(raster::make_alpha_map(forest.test).words().data());
}

void sizes(benchmark::internal::Benchmark* b) { b->Arg(1024)->Arg(2048)->Arg(4096)->Unit(benchmark::kMillisecond); }

BENCHMARK_CAPTURE(depth_of_forest, mapped, raster::Kernel::automatic, Leaves::mapped)->Apply(sizes);
BENCHMARK_CAPTURE(depth_of_forest, textured, raster::Kernel::automatic, Leaves::textured)->Apply(sizes);
BENCHMARK_CAPTURE(depth_of_forest, scalar, raster::Kernel::scalar, Leaves::textured)->Apply(sizes);
BENCHMARK_CAPTURE(depth_of_forest, solid, raster::Kernel::automatic, Leaves::solid)->Apply(sizes);
BENCHMARK(make_map)->Unit(benchmark::kMillisecond);

}  // namespace
