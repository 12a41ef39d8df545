// Assignment of lights to clusters: the grid and the scenes of the yardsticks, one thread.

#include "setup.hpp"

#include <gnomon/lights.hpp>

#include <benchmark/benchmark.h>

#include <cstdint>
#include <string>
#include <vector>

namespace {

using namespace gnomon;

using bench::Setup;

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

/// The floor: the same lists from runs that are known, by the plain loops.
void lists_fill_only(benchmark::State& state) {
    Setup const setup(state.range(0), state.range(1), state.range(2) != 0);
    lights::Workspace work;
    std::vector<lights::Cell> cells(setup.grid.clusters());
    std::vector<std::uint16_t> indices(4'000'000);
    double const pairs = static_cast<double>(lights::count_lists(setup.grid, setup.lights, {}, work, cells).written);
    for ([[maybe_unused]] auto _ : state) {
        benchmark::DoNotOptimize(lights::detail::lay_out_scalar(setup.grid.columns, work, cells));
        lights::detail::fill_scalar<std::uint16_t>(work, indices);
        benchmark::DoNotOptimize(indices.data());
    }
    state.counters["pairs"] = pairs;
}

#if GNOMON_CULL_AVX2
struct Bounds {
    float low[3], high[3];
};

std::vector<Bounds> bounds_of(cull::RowGrid const& g) {
    std::vector<Bounds> list;
    for (std::uint32_t k = 0; k < g.slices; ++k)
        for (std::uint32_t j = 0; j < g.rows; ++j)
            for (std::uint32_t i = 0; i < g.columns; ++i) {
                float const near = g.depth_m[k], far = g.depth_m[k + 1];
                auto const least = [&](float t) { return t < 0.0F ? t * far : t * near; };
                auto const most = [&](float t) { return t < 0.0F ? t * near : t * far; };
                list.push_back({{least(g.left[i]), least(g.y[j]), near}, {most(g.right[i]), most(g.y[j + 1]), far}});
            }
    return list;
}

/// The baseline: every ball against every cluster's box, eight lights at a time, into words of lights.
GNOMON_ROWS_TARGET void against_boxes(std::vector<Bounds> const& boxes, lights::Workspace const& work, std::vector<std::uint32_t>& words) {
    using namespace cull::detail;
    for (std::size_t n = 0; n < work.count; n += 8) {
        F8 const at[3] = {load(work.x.data() + n), load(work.y.data() + n), load(work.depth.data() + n)};
        F8 const r = load(work.radius.data() + n), reach = r * r, zero = all(0.0F);
        auto* const bytes = reinterpret_cast<unsigned char*>(words.data() + n / 32 * boxes.size()) + n / 8 % 4;
        for (std::size_t c = 0; c < boxes.size(); ++c) {
            F8 square = zero;
            for (int a = 0; a < 3; ++a) {
                F8 const off = greatest(greatest(spread(&boxes[c].low[a]) - at[a], at[a] - spread(&boxes[c].high[a])), zero);
                square = square + off * off;
            }
            bytes[4 * c] = static_cast<unsigned char>(bits_of(square <= reach));
        }
    }
}

void brute_force_boxes(benchmark::State& state) {
    Setup const setup(state.range(0), state.range(1), false);
    std::vector<Bounds> const boxes = bounds_of(setup.grid);
    lights::Workspace work;
    benchmark::DoNotOptimize(lights::admit(setup.lights, ~0U, work).taken);
    std::vector<std::uint32_t> words((setup.lights.size() + 31) / 32 * boxes.size());
    for ([[maybe_unused]] auto _ : state) {
        against_boxes(boxes, work, words);
        benchmark::DoNotOptimize(words.data());
    }
    std::size_t pairs = 0;
    for (std::uint32_t const word : words) pairs += static_cast<std::size_t>(__builtin_popcount(word));
    state.counters["pairs"] = static_cast<double>(pairs);
}
#endif

}  // namespace

#if GNOMON_CULL_AVX2
BENCHMARK(brute_force_boxes)->ArgNames({"scene", "lights"})->ArgsProduct({{0, 1, 2, 3}, {256}});
#endif
BENCHMARK(lists)->ArgNames({"scene", "lights", "spots"})->ArgsProduct({{0, 1, 2, 3}, {256, 4096}, {0, 1}});
BENCHMARK(lists_fill_only)->ArgNames({"scene", "lights", "spots"})->ArgsProduct({{0, 1, 2, 3}, {256, 4096}, {0, 1}});
BENCHMARK(planes)->ArgNames({"scene", "lights", "spots", "lanes"})->ArgsProduct({{0, 1, 2, 3}, {0, 256, 4096}, {0, 1}, {1}});
BENCHMARK(planes)->ArgNames({"scene", "lights", "spots", "lanes"})->ArgsProduct({{0, 1, 2, 3}, {256}, {0, 1}, {0}});
