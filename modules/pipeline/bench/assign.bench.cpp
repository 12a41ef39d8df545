// Assignment of up to a million lights to the clusters that a frame of the atrium occupies: [Olsson 2014, Paper II, table 2].

#include <gnomon/cluster.hpp>
#include <gnomon/core/executor_threads.hpp>
#include <gnomon/cull/depth_range.hpp>
#include <gnomon/lights.hpp>
#include <gnomon/pipeline/lighting.hpp>
#include <gnomon/scene.hpp>

#include "../src/lighting/lighting.hpp"

#include <benchmark/benchmark.h>

#include <algorithm>
#include <cstdint>
#include <optional>
#include <vector>

namespace {

using namespace gnomon;

/// The atrium's view `still`, 1920x1080, tiles of 32 pixels, cubical slices: what is the same for any number of lights.
struct Occupied {
    scene::Scene scene;
    scene::Geometry geometry;
    pipeline::Frame frame;
    std::optional<cluster::Grid> grid;
    cull::RowGrid rows;
    std::vector<cluster::ClusterCoordinates> clusters;
    std::vector<lights::Light> lights;

    Occupied() {
        scene = scene::make_procedural({.name = "atrium", .lights = "million"}).value();
        geometry = scene::flatten(scene);
        auto const camera = std::ranges::find(scene.cameras, "still", &scene::Camera::name);
        core::ThreadExecutor const threads(2);
        math::View const view = scene::make_view(*camera, {1920, 1080}).value();
        frame = pipeline::make_frame(scene, geometry, {view, pipeline::sun({0.3, -1.0, 0.2}), false, nullptr}, threads).value();
        find_clusters();
        pipeline::PreparedLights prepared;
        pipeline::prepare_lights(frame, scene.lights, prepared);
        lights = prepared.culled;
    }
    void find_clusters() {
        pipeline::SampleDepth const depth_of(frame);
        double deepest = 0.0;
        for (math::vec3 const& p : frame.samples.position) deepest = std::max(deepest, static_cast<double>(depth_of(p)));
        grid = cluster::make_grid(frame.view, {32, 32}, cluster::make_cubical_slices(frame.view, 32, deepest).value()).value();
        rows = cull::make_row_grid(grid->view());
        std::vector<std::uint64_t> keys;
        for (std::size_t i = 0; i < frame.samples.size(); ++i) {
            math::uvec2 const pixel(frame.samples.pixel[i] % 1920, frame.samples.pixel[i] / 1920);
            cluster::ClusterCoordinates const c = cluster::coordinates_at(*grid, pixel, depth_of(frame.samples.position[i]));
            keys.push_back(cluster::pack_key<std::uint64_t>({c.column, c.row, c.slice, 0}));
        }
        std::ranges::sort(keys);
        keys.erase(std::unique(keys.begin(), keys.end()), keys.end());
        for (std::uint64_t const key : keys) {
            cluster::KeyParts const p = cluster::unpack_key(key);
            clusters.push_back({p.column, p.row, p.slice});
        }
    }
};

Occupied const& occupied() {
    static Occupied const all;
    return all;
}

std::span<lights::Light const> first_lights(std::int64_t count) {
    return std::span(occupied().lights).first(static_cast<std::size_t>(count));
}

void build_tree(benchmark::State& state) {
    auto const list = first_lights(state.range(0));
    core::ThreadExecutor const threads(static_cast<int>(state.range(1)));
    lights::LightTreeWorkspace work;
    lights::LightTree tree;
    for ([[maybe_unused]] auto _ : state) {
        lights::build_light_tree(list, ~0U, work, tree, threads);
        benchmark::DoNotOptimize(tree.tree.nodes.data());
    }
}

void assign_sparse(benchmark::State& state) {
    Occupied const& o = occupied();
    auto const list = first_lights(state.range(0));
    core::ThreadExecutor const threads(static_cast<int>(state.range(1)));
    lights::LightTree const tree = lights::build_light_tree(list, ~0U);
    lights::SparseWorkspace work;
    std::vector<lights::Cell> cells(o.clusters.size());
    std::vector<std::uint32_t> indices(4'000'000);
    lights::ListsReport report;
    for ([[maybe_unused]] auto _ : state) {
        report = lights::count_sparse_lists({o.rows, list, tree, o.clusters}, {}, work, cells, threads);
        lights::fill_sparse_lists<std::uint32_t>(work, cells, indices, threads);
        benchmark::DoNotOptimize(indices.data());
    }
    state.counters["pairs"] = static_cast<double>(report.written);
    state.counters["clusters"] = static_cast<double>(cells.size());
    state.counters["bytes"] = static_cast<double>(work.bytes() + report.written * 4 + cells.size() * sizeof(lights::Cell));
}

/// Tree and lists, as a frame has it.
void tree_and_lists(benchmark::State& state) {
    Occupied const& o = occupied();
    auto const list = first_lights(state.range(0));
    core::ThreadExecutor const threads(static_cast<int>(state.range(1)));
    lights::LightTreeWorkspace tree_work;
    lights::LightTree tree;
    lights::SparseWorkspace work;
    std::vector<lights::Cell> cells(o.clusters.size());
    std::vector<std::uint32_t> indices;
    for ([[maybe_unused]] auto _ : state) {
        lights::build_light_tree(list, ~0U, tree_work, tree, threads);
        auto const report = lights::count_sparse_lists({o.rows, list, tree, o.clusters}, {}, work, cells, threads);
        indices.resize(report.written);
        lights::fill_sparse_lists<std::uint32_t>(work, cells, indices, threads);
        benchmark::DoNotOptimize(indices.data());
    }
    std::uint32_t most = 0;
    for (lights::Cell const& cell : cells) most = std::max(most, cell.count);
    state.counters["pairs"] = static_cast<double>(indices.size());
    state.counters["mean"] = static_cast<double>(indices.size()) / static_cast<double>(cells.size());
    state.counters["most"] = most;
}

using Group = math::Lanes<float, 8>;

/// How many of the balls touch the box; the peer has the lanes that the assignment finds at run time.
#if GNOMON_BVH_AVX2
[[gnu::target("avx2,popcnt"), gnu::flatten]]
#endif
std::uint64_t count_touched(bvh::Spheres const& balls, math::Aabb const& bounds) {
    formula::GnBox<Group> const box{formula::Vec3<Group>(bounds.lo), formula::Vec3<Group>(bounds.hi)};
    std::uint64_t count = 0;
    for (std::size_t i = 0; i + 8 <= balls.size(); i += 8) {
        formula::Vec3<Group> const center(Group::load(&balls.x[i]), Group::load(&balls.y[i]), Group::load(&balls.z[i]));
        auto const limit = gn_touch_limit(formula::Float<Group>(Group::load(&balls.radius[i])));
        count += static_cast<std::uint64_t>(__builtin_popcount(math::bits(gn_touches_sphere_box(center, limit, box).v)));
    }
    return count;
}

/// The peer: every light against the box of every occupied cluster, eight lights at a time, as many threads.
void brute_force(benchmark::State& state) {
    Occupied const& o = occupied();
    auto const list = first_lights(state.range(0));
    core::ThreadExecutor const threads(static_cast<int>(state.range(1)));
    std::vector<math::Aabb> boxes;
    for (cluster::ClusterCoordinates const& c : o.clusters) boxes.push_back(cluster::implicit_bounds(o.grid->view(), c));
    lights::LightTreeWorkspace work;
    lights::LightTree tree;
    lights::build_light_tree(list, ~0U, work, tree, threads);
    bvh::Spheres const balls{std::span(work.x).first(list.size()), std::span(work.y).first(list.size()),
                             std::span(work.depth).first(list.size()), std::span(work.radius).first(list.size())};
    std::vector<std::uint64_t> pairs(boxes.size());
    for ([[maybe_unused]] auto _ : state) {
        threads.parallel_for(boxes.size(), 64, [&](std::size_t begin, std::size_t end) {
            for (std::size_t c = begin; c < end; ++c) pairs[c] = count_touched(balls, boxes[c]);
        });
        benchmark::DoNotOptimize(pairs.data());
    }
    std::uint64_t sum = 0;
    for (std::uint64_t const n : pairs) sum += n;
    state.counters["pairs"] = static_cast<double>(sum);
}

/// Tiles alone: no tree, every light scattered to the tiles that it touches.
void assign_tiled(benchmark::State& state) {
    Occupied const& o = occupied();
    auto const list = first_lights(state.range(0));
    std::vector<float> const planes{static_cast<float>(o.frame.view.near_m), std::numeric_limits<float>::infinity()};
    auto const tiles = cluster::make_grid(o.frame.view, {32, 32}, cluster::make_slices(std::span<float const>(planes)).value()).value();
    cull::RowGrid const rows = cull::make_row_grid(tiles.view());
    lights::Workspace work;
    std::vector<lights::Cell> cells(tiles.clusters());
    std::vector<std::uint32_t> indices;
    for ([[maybe_unused]] auto _ : state) {
        auto const report = lights::count_lists(rows, list, {}, work, cells);
        indices.resize(report.written);
        lights::fill_lists<std::uint32_t>(work, indices);
        benchmark::DoNotOptimize(indices.data());
    }
    state.counters["pairs"] = static_cast<double>(indices.size());
}

}  // namespace

BENCHMARK(build_tree)->ArgNames({"lights", "threads"})->ArgsProduct({{32, 1024, 32768, 1048576}, {1, 2}})->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK(assign_sparse)->ArgNames({"lights", "threads"})->ArgsProduct({{32, 1024, 32768, 1048576}, {1, 2}})->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK(tree_and_lists)->ArgNames({"lights", "threads"})->ArgsProduct({{32, 1024, 32768, 1048576}, {1, 2}})->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK(assign_tiled)->ArgNames({"lights"})->ArgsProduct({{32, 1024, 32768, 1048576}})->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK(brute_force)->ArgNames({"lights", "threads"})->Args({1048576, 2})->Iterations(1)->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK(brute_force)->ArgNames({"lights", "threads"})->ArgsProduct({{32, 1024, 32768}, {2}})->Unit(benchmark::kMillisecond)->UseRealTime();
