// The orthographic integer pass beside the depth pass, on the city of 254k triangles from the sun, one thread.

#include <gnomon/raster.hpp>

#include <benchmark/benchmark.h>

#include <algorithm>
#include <cmath>

#include "city.hpp"

namespace {

using namespace gnomon;

raster::IntegerOrtho light_of(math::View const& view, int size) {
    double const extent = std::max(view.window.right - view.window.left, view.window.top - view.window.bottom);
    raster::IntegerOrtho light{.right = view.right,
                               .down = math::dvec3(0.0) - view.up,
                               .away = math::dvec3(0.0) - view.back,
                               .texel_m = extent / size,
                               .depth_unit_m = (view.far_m - view.near_m) * 0x1p-24};
    light.origin_x = std::llround(view.window.left / light.texel_m);
    light.origin_y = std::llround(-view.window.top / light.texel_m);
    light.origin_z = std::llround(view.near_m / light.depth_unit_m);
    return light;
}

/// 0: the depth pass, 1: the integer pass.
void ortho_of_city(benchmark::State& state) {
    bench::City const city = bench::make_city(1);
    auto const size = static_cast<std::int32_t>(state.range(1));
    math::View const view = bench::make_view(true, size);
    raster::Draw const draw{.positions = std::span<math::vec3 const>(city.positions),
                            .indices = std::span<std::uint32_t const>(city.indices),
                            .origin = math::to_float(view.eye_m),
                            .clip_from_relative = math::clip_from_relative(view)};
    raster::OrthoDraw const whole{.positions = std::span<math::vec3 const>(city.positions),
                                  .indices = std::span<std::uint32_t const>(city.indices)};
    raster::IntegerOrtho const light = light_of(view, size);
    std::vector<float> depth(static_cast<std::size_t>(size) * static_cast<std::size_t>(size));
    auto const target = raster::make_image(depth.data(), size, size);
    raster::Workspace workspace;
    raster::TileWorkspace tiles;
    core::SerialExecutor serial;
    std::uint64_t written = 0;
    for (auto _ : state)
        written = state.range(0) == 0
                      ? raster::depth_pass({&draw, 1}, target, {.depth = view.depth}, workspace, serial).samples_written
                      : raster::ortho_pass({&whole, 1}, light, target, {}, tiles, serial).samples_written;
    state.counters["Msamples"] = static_cast<double>(written) * 1e-6;
}

BENCHMARK(ortho_of_city)->ArgNames({"pass", "px"})->ArgsProduct({{0, 1}, {1024, 2048}})->Unit(benchmark::kMillisecond);

}  // namespace
