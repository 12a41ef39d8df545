// What else is done with each sample of a 1080p picture: keys, explicit bounds, position bits, cones, depths of tiles.
// One thread; `ns` is a sample's. Peers: the keys' and bounds' plain loops, one sample at a time, in the same run.

#include "picture.hpp"

#include <benchmark/benchmark.h>

#include <algorithm>
#include <cmath>

using namespace gnomon;

namespace {

void report(benchmark::State& state, scene::Race const& race, std::size_t samples) {
    state.counters["ours_ns"] = race.ours_s * 1e9 / static_cast<double>(samples);
    state.counters["peer_ns"] = race.peer_s * 1e9 / static_cast<double>(samples);
    state.counters["ratio"] = race.peer_s / race.ours_s;
}

/// Against equation 2 with the library's logarithm, which is not exact.
void keys(benchmark::State& state) {
    auto const& p = scene::shared_picture(state.range(0) != 0, state.range(1) != 0 ? 3 : 0);
    std::vector<std::uint32_t> out(p.keys.size());
    auto const planes = p.grid.slices().planes_m();
    float const scale = 1.0F / std::log(planes[1] / planes[0]);
    scene::Race race;
    for (auto _ : state)
        race.run([&] { cluster::make_keys(p.grid, p.layout, {p.depth_m, p.normals}, std::span<std::uint32_t>(out)); },
                 [&] {
                     for (std::size_t i = 0; i < out.size(); ++i) {
                         auto const slice = static_cast<std::uint32_t>(std::min(1e3F, std::log(p.depth_m[i] / planes[0]) * scale));
                         auto const x = static_cast<std::uint32_t>(i % 1920);
                         auto const y = static_cast<std::uint32_t>(i / 1920);
                         std::uint32_t const cell = state.range(1) != 0 ? cluster::normal_cell(p.normals[i], 3) : 0;
                         out[i] = (y / 32) << 24U | (x / 32) << 16U | slice << 6U | cell;
                     }
                     benchmark::DoNotOptimize(out.data());
                 });
    report(state, race, out.size());
}
BENCHMARK(keys)->ArgNames({"leaves", "normals"})->ArgsProduct({{0, 1}, {0, 1}})->Iterations(20)->Unit(benchmark::kMillisecond);

/// 0: boxes, 1: position bits, 2: cones; against boxes taken one sample at a time.
void reduce(benchmark::State& state) {
    auto const& p = scene::shared_picture(state.range(1) != 0, 0);
    cluster::UniqueWorkspace<std::uint32_t> unique_work;
    std::vector<std::uint32_t> found(p.keys.size());
    std::vector<std::uint32_t> index(p.keys.size());
    auto const stats = unique_by_bitmap(p.layout, std::span<std::uint32_t const>(p.keys), {found, index}, unique_work);
    std::vector<math::Aabb> implicit(stats.clusters);
    for (std::size_t c = 0; c < stats.clusters; ++c) {
        auto const parts = cluster::unpack_key(found[c]);
        implicit[c] = implicit_bounds(p.grid.view(), {parts.column, parts.row, parts.slice}, 1e-3);
    }
    std::vector<math::Aabb> boxes(stats.clusters);
    std::vector<cluster::PositionBits> bits(stats.clusters);
    std::vector<cluster::NormalCone> cones(stats.clusters);
    cluster::ReduceWorkspace work;
    scene::Race race;
    cluster::ReduceStats left_out;
    for (auto _ : state)
        race.run(
            [&] {
                if (state.range(0) == 0) left_out = cluster::explicit_bounds(index, p.positions, boxes, work);
                if (state.range(0) == 1) left_out = cluster::reduce_position_bits(index, p.positions, implicit, bits);
                if (state.range(0) == 2) left_out = cluster::explicit_cones(index, p.normals, cones, work);
            },
            [&] {
                std::fill(boxes.begin(), boxes.end(), math::Aabb{});
                for (std::size_t i = 0; i < index.size(); ++i)
                    if (index[i] < boxes.size()) boxes[index[i]] = math::extended(boxes[index[i]], p.positions[i]);
                benchmark::DoNotOptimize(boxes.data());
            });
    report(state, race, index.size());
    state.counters["left_out"] = static_cast<double>(left_out.not_finite + left_out.outside);
    double exact = 0.0;
    double approximate = 0.0;
    double whole = 0.0;
    if (state.range(0) == 1)
        for (std::size_t c = 0; c < stats.clusters; ++c) {
            auto const volume = [](math::Aabb const& b) {
                math::dvec3 const size = math::to_double(b.hi) - math::to_double(b.lo);
                return size.x * size.y * size.z;
            };
            whole += 1.0;
            exact += volume(boxes[c]) / volume(implicit[c]);
            approximate += volume(cluster::approximate_bounds(implicit[c], bits[c])) / volume(implicit[c]);
        }
    state.counters["exact_volume"] = whole > 0.0 ? exact / whole : 0.0;
    state.counters["approximate_volume"] = whole > 0.0 ? approximate / whole : 0.0;
}
BENCHMARK(reduce)->ArgNames({"what", "leaves"})->ArgsProduct({{0, 1, 2}, {0, 1}})->Iterations(20)->Unit(benchmark::kMillisecond);

void tile_depths(benchmark::State& state) {
    auto const& p = scene::shared_picture(state.range(0) != 0, 0);
    std::vector<cluster::TileDepth> tiles(std::size_t{p.grid.table().columns} * p.grid.table().rows);
    scene::Race race;
    for (auto _ : state)
        race.run([&] { reduce_tile_depths(p.grid, p.depth_m, tiles); },
                 [&] {
                     std::fill(tiles.begin(), tiles.end(), cluster::TileDepth{});
                     for (std::size_t i = 0; i < p.depth_m.size(); ++i) {
                         auto& range = tiles[i / 1920 / 32 * 60 + i % 1920 / 32].range;
                         range = {std::min(range.near_m, p.depth_m[i]), std::max(range.far_m, p.depth_m[i])};
                     }
                     benchmark::DoNotOptimize(tiles.data());
                 });
    report(state, race, p.depth_m.size());
}
BENCHMARK(tile_depths)->ArgNames({"leaves"})->Arg(0)->Arg(1)->Iterations(20)->Unit(benchmark::kMillisecond);

}  // namespace
