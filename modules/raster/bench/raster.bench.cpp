// The depth pass on the three cities, from the sun and from the street, one thread. Milliseconds per pass, clear
// included.

#include <gnomon/raster.hpp>

#include <benchmark/benchmark.h>

#include "city.hpp"

namespace {

using namespace gnomon;

void depth_of_city(benchmark::State& state, raster::Kernel kernel) {
    bench::City const city = bench::make_city(static_cast<int>(state.range(0)));
    auto const size = static_cast<std::int32_t>(state.range(2));
    math::View const view = bench::make_view(state.range(1) == 0, size);
    raster::Draw const draw{.positions = std::span<math::vec3 const>(city.positions),
                            .indices = std::span<std::uint32_t const>(city.indices),
                            .origin = math::to_float(view.eye_m),
                            .clip_from_relative = math::clip_from_relative(view)};
    std::vector<float> depth(static_cast<std::size_t>(size) * static_cast<std::size_t>(size));
    raster::Workspace workspace;
    core::SerialExecutor serial;
    raster::PassStats stats;
    for (auto _ : state)
        stats = raster::depth_pass({&draw, 1}, raster::make_image(depth.data(), size, size),
                                   {.depth = math::Depth::forward, .kernel = kernel}, workspace, serial);
    state.counters["drawn"] = static_cast<double>(stats.drawn);
    state.counters["no_sample"] = static_cast<double>(stats.no_sample);
    state.counters["Msamples"] = static_cast<double>(stats.samples_written) * 1e-6;
    state.counters["MiB"] = static_cast<double>(workspace.size_bytes()) / 1048576.0;
}

void arguments(benchmark::internal::Benchmark* b) {
    b->ArgNames({"city", "persp", "px"})
        ->ArgsProduct({{0, 1, 2}, {0, 1}, {1024, 2048, 4096}})
        ->Unit(benchmark::kMillisecond);
}

BENCHMARK_CAPTURE(depth_of_city, automatic, raster::Kernel::automatic)->Apply(arguments);
BENCHMARK_CAPTURE(depth_of_city, avx2, raster::Kernel::avx2)->Apply(arguments);
BENCHMARK_CAPTURE(depth_of_city, scalar, raster::Kernel::scalar)->Apply(arguments);

}  // namespace
