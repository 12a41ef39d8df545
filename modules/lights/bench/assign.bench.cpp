// Assignment of lights to clusters: the grid and the scenes of the yardsticks, one thread.

#include "../../cull/tests/light_scenes.hpp"

#include <gnomon/lights.hpp>

#include <benchmark/benchmark.h>

#include <cstdint>
#include <string>
#include <vector>

namespace {

using namespace gnomon;

struct Setup {
    test::YardGrid yard;
    cull::RowGrid grid;
    std::vector<lights::Light> lights;

    Setup(std::int64_t scene, std::int64_t count, bool spots) : grid(cull::make_row_grid(yard.view())) {
        for (test::SceneLight const& l : test::make_lights(test::light_scenes[scene], static_cast<std::size_t>(count))) {
            if (spots) lights.push_back(lights::make_spot(l.center, l.range, l.axis, l.half_angle_rad));
            else lights.push_back(lights::make_point(l.center, l.range));
        }
    }
};

void planes(benchmark::State& state) {
    Setup const setup(state.range(0), state.range(1), state.range(2) != 0);
    lights::Workspace work;
    lights::BitPlanes out;
    lights::PlanesConfig config;
    config.lanes = state.range(3) != 0;
    for ([[maybe_unused]] auto _ : state) {
        lights::assign_planes(setup.grid, setup.lights, config, work, out);
        benchmark::DoNotOptimize(out.words.data());
    }
    std::size_t pairs = 0;
    for (std::uint32_t const word : out.words) pairs += static_cast<std::size_t>(__builtin_popcount(word));
    state.counters["pairs"] = static_cast<double>(pairs);
}

void lists(benchmark::State& state) {
    Setup const setup(state.range(0), state.range(1), state.range(2) != 0);
    lights::Workspace work;
    std::vector<lights::Cell> cells(setup.grid.clusters());
    std::vector<std::uint16_t> indices(4'000'000);
    double pairs = 0;
    for ([[maybe_unused]] auto _ : state) {
        pairs = static_cast<double>(lights::count_lists(setup.grid, setup.lights, {}, work, cells).written);
        lights::fill_lists<std::uint16_t>(work, indices);
        benchmark::DoNotOptimize(indices.data());
    }
    state.counters["pairs"] = pairs;
}

/// The floor: the same lists from runs that are known.
void lists_fill_only(benchmark::State& state) {
    Setup const setup(state.range(0), state.range(1), state.range(2) != 0);
    lights::Workspace work;
    std::vector<lights::Cell> cells(setup.grid.clusters());
    std::vector<std::uint16_t> indices(4'000'000);
    double const pairs = static_cast<double>(lights::count_lists(setup.grid, setup.lights, {}, work, cells).written);
    for ([[maybe_unused]] auto _ : state) {
        work.cursors.assign(setup.grid.clusters(), 0);
        lights::detail::count_runs({work.runs.data(), work.run_count}, work.cursors.data());
        benchmark::DoNotOptimize(lights::detail::make_cells(work.cursors, cells));
        lights::fill_lists<std::uint16_t>(work, indices);
        benchmark::DoNotOptimize(indices.data());
    }
    state.counters["pairs"] = pairs;
}

}  // namespace

BENCHMARK(lists)->ArgNames({"scene", "lights", "spots"})->ArgsProduct({{0, 1, 2, 3}, {256, 4096}, {0, 1}});
BENCHMARK(lists_fill_only)->ArgNames({"scene", "lights", "spots"})->ArgsProduct({{0, 1, 2, 3}, {256, 4096}, {0, 1}});
BENCHMARK(planes)->ArgNames({"scene", "lights", "spots", "lanes"})->ArgsProduct({{0, 1, 2, 3}, {0, 256, 4096}, {0, 1}, {1}});
BENCHMARK(planes)->ArgNames({"scene", "lights", "spots", "lanes"})->ArgsProduct({{0, 1, 2, 3}, {256}, {0, 1}, {0}});
