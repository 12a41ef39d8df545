// Six cube faces in the middle of the city: one pass for all, and six passes. Wall-clock milliseconds.

#include <gnomon/core/executor_tbb.hpp>
#include <gnomon/raster.hpp>

#include <benchmark/benchmark.h>

#include "city.hpp"

namespace {

using namespace gnomon;

std::vector<math::View> cube(int size_px) {
    std::vector<math::View> views;
    math::dvec3 const eye(3.0, 12.0, 3.0);
    for (int face = 0; face < 6; ++face) {
        math::dvec3 way(0.0);
        way[static_cast<math::axis_t>(face / 2)] = face % 2 == 0 ? 1.0 : -1.0;
        math::dvec3 const up = face / 2 == 1 ? math::dvec3(0, 0, 1) : math::dvec3(0, 1, 0);
        views.push_back(math::make_perspective({.eye_m = eye,
                                                .target_m = eye + way,
                                                .up = up,
                                                .fov_y_rad = 1.5707963267948966,
                                                .near_m = 0.5,
                                                .far_m = 1000.0,
                                                .size_px = {size_px, size_px}})
                            .value());
    }
    return views;
}

void cube_of_city(benchmark::State& state, bool together) {
    bench::City const city = bench::make_city(static_cast<int>(state.range(0)));
    auto const size = static_cast<std::int32_t>(state.range(1));
    core::TbbExecutor pool(static_cast<int>(state.range(2)));
    raster::Draw draw{.positions = std::span<math::vec3 const>(city.positions),
                      .indices = std::span<std::uint32_t const>(city.indices)};
    std::vector<float> depth(static_cast<std::size_t>(size) * static_cast<std::size_t>(size) * 6);
    raster::ImageView<float> const strip = raster::make_image(depth.data(), size, size * 6);
    std::vector<raster::Layer> layers;
    for (math::View const& view : cube(size))
        layers.push_back({.target = strip.sub({0, size * static_cast<std::int32_t>(layers.size()), size, size}),
                          .origin = math::to_float(view.eye_m),
                          .clip_from_relative = math::clip_from_relative(view)});
    raster::Workspace workspace;
    for (auto _ : state) {
        if (together) {
            benchmark::DoNotOptimize(raster::layered_pass({&draw, 1}, layers, workspace, pool).data());
            continue;
        }
        for (raster::Layer const& layer : layers) {
            draw.origin = layer.origin;
            draw.clip_from_relative = layer.clip_from_relative;
            raster::depth_pass({&draw, 1}, layer.target, layer.config, workspace, pool);
        }
    }
}

void arguments(benchmark::internal::Benchmark* b) {
    b->ArgNames({"city", "px", "threads"})
        ->ArgsProduct({{0, 1}, {128, 512, 2048}, {1, 2}})
        ->Unit(benchmark::kMillisecond)
        ->UseRealTime();
}

BENCHMARK_CAPTURE(cube_of_city, one_pass, true)->Apply(arguments);
BENCHMARK_CAPTURE(cube_of_city, six_passes, false)->Apply(arguments);

}  // namespace
