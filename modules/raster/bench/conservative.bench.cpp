// Conservative passes beside the depth pass, on the city of 254k triangles, one thread. Milliseconds per pass.

#include <gnomon/raster.hpp>

#include <benchmark/benchmark.h>

#include "city.hpp"

namespace {

using namespace gnomon;

/// 0: the depth pass, 1: outer coverage with the nearest depth, 2: inner with the farthest.
void bounds_of_city(benchmark::State& state) {
    bench::City const city = bench::make_city(1);
    auto const size = static_cast<std::int32_t>(state.range(2));
    math::View const view = bench::make_view(state.range(1) == 0, size);
    raster::Draw const draw{.positions = std::span<math::vec3 const>(city.positions),
                            .indices = std::span<std::uint32_t const>(city.indices),
                            .origin = math::to_float(view.eye_m),
                            .clip_from_relative = math::clip_from_relative(view)};
    std::vector<float> depth(static_cast<std::size_t>(size) * static_cast<std::size_t>(size));
    auto const target = raster::make_image(depth.data(), size, size);
    raster::Workspace workspace;
    raster::TileWorkspace tiles;
    core::SerialExecutor serial;
    raster::ConservativeConfig config{.depth = math::Depth::forward};
    if (state.range(0) == 2) {
        config.coverage = raster::Coverage::inner;
        config.bound = raster::Bound::farthest;
    }
    std::uint64_t written = 0;
    for (auto _ : state)
        written =
            state.range(0) == 0
                ? raster::depth_pass({&draw, 1}, target, {.depth = config.depth}, workspace, serial).samples_written
                : raster::conservative_pass({&draw, 1}, target, config, tiles, serial).pixels_written;
    state.counters["Mpixels"] = static_cast<double>(written) * 1e-6;
}

BENCHMARK(bounds_of_city)
    ->ArgNames({"pass", "persp", "px"})
    ->ArgsProduct({{0, 1, 2}, {0, 1}, {1024, 2048}})
    ->Unit(benchmark::kMillisecond);

}  // namespace
