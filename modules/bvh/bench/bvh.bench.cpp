// Build, refit and query of a million spheres. `peer` is what is measured in the same turn: std::sort of the same keys for
// a build, brute force with the same lanes for a query. Wall time, the least of all turns: the machine is not alone.

#include <gnomon/bvh.hpp>
#include <gnomon/core/executor_threads.hpp>

#include <benchmark/benchmark.h>

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

using namespace gnomon;

namespace {

struct Lamps {
    std::vector<float> x, y, z, radius;

    explicit Lamps(std::size_t n) {
        std::uint64_t state = 1;
        auto const draw = [&state] {
            state = state * 6364136223846793005ULL + 1442695040888963407ULL;
            return static_cast<float>(state >> 40U) / 16777216.0F;
        };
        for (std::size_t i = 0; i < n; ++i) {
            x.push_back(draw() * 100.0F);
            y.push_back(draw() * 20.0F);
            z.push_back(draw() * 100.0F);
            radius.push_back(0.1F + draw());
        }
    }
    [[nodiscard]] bvh::Spheres list() const { return {x, y, z, radius}; }
};

template <class F>
double seconds(F&& f) {
    auto const start = std::chrono::steady_clock::now();
    f();
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

struct Race {
    double ours = std::numeric_limits<double>::infinity();
    double peer = std::numeric_limits<double>::infinity();

    void report(benchmark::State& state, char const* unit, double scale) const {
        state.counters[std::string("ours_") + unit] = ours * scale;
        state.counters[std::string("peer_") + unit] = peer * scale;
        state.counters["ratio"] = ours / peer;
    }
};

void build(benchmark::State& state) {
    Lamps const lamps(static_cast<std::size_t>(state.range(0)));
    auto const codes = state.range(2) == 63 ? bvh::CodeBits::bits_63 : bvh::CodeBits::bits_30;
    core::ThreadExecutor const threads(static_cast<int>(state.range(1)));
    bvh::Workspace work;
    bvh::SphereTree tree;
    std::vector<std::uint64_t> keys(lamps.x.size());
    Race race;
    for (auto _ : state) {
        race.ours = std::min(race.ours, seconds([&] { build(lamps.list(), codes, work, tree, threads); }));
        // The keys that this build sorted, in the items' order.
        math::Aabb const box{math::vec3(0.0F), math::vec3(100.0F, 20.0F, 100.0F)};
        for (std::uint32_t i = 0; i < keys.size(); ++i)
            keys[i] = std::uint64_t{math::morton_30(box, math::vec3(lamps.x[i], lamps.y[i], lamps.z[i]))} << 32U | i;
        race.peer = std::min(race.peer, seconds([&] { std::sort(keys.begin(), keys.end()); }));
    }
    race.report(state, "ms", 1e3);
}
BENCHMARK(build)->ArgNames({"n", "threads", "bits"})->Args({1 << 20, 1, 30})->Args({1 << 20, 2, 30})->Args({1 << 20, 2, 63})->Args({32768, 1, 30})->Args({1024, 1, 30})
    ->Unit(benchmark::kMillisecond);

void refit(benchmark::State& state) {
    Lamps const lamps(1U << 20U);
    core::ThreadExecutor const threads(static_cast<int>(state.range(0)));
    bvh::Workspace work;
    bvh::SphereTree tree;
    Race race;
    for (auto _ : state) {
        race.peer = std::min(race.peer, seconds([&] { build(lamps.list(), bvh::CodeBits::bits_30, work, tree, threads); }));
        race.ours = std::min(race.ours, seconds([&] { benchmark::DoNotOptimize(refit(tree, lamps.list(), threads)); }));
    }
    race.report(state, "ms", 1e3);
}
BENCHMARK(refit)->ArgNames({"threads"})->Args({1})->Args({2})->Unit(benchmark::kMillisecond);

/// Every item, W at a time, by the same child tests.
template <class R>
std::size_t all_of(bvh::SphereTree const& tree, R const& region) {
    auto const touched = bvh::detail::make_child_tests(tree.view(), region);
    std::size_t hits = 0;
    for (std::uint32_t node = 0; node < tree.layout.count[1]; ++node)
        hits += static_cast<std::size_t>(__builtin_popcount(touched(1, node)));
    return hits;
}

template <class R>
void race_queries(benchmark::State& state, R const& region_at) {
    Lamps const lamps(static_cast<std::size_t>(state.range(0)));
    auto const tree = bvh::build_tree(lamps.list());
    std::vector<std::uint32_t> out(lamps.x.size());
    Race race;
    std::size_t hits = 0;
    for (auto _ : state)
        for (int i = 0; i < 50; ++i) {
            float const x = static_cast<float>(i) * 2.0F;
            auto const region = region_at(math::vec3(x, 10.0F, 100.0F - x));
            race.ours = std::min(race.ours, seconds([&] { hits = query(tree.view(), region, out); }));
            race.peer = std::min(race.peer, seconds([&] { benchmark::DoNotOptimize(all_of(tree, region)); }));
        }
    race.report(state, "us", 1e6);
    state.counters["hits"] = static_cast<double>(hits);
}

void by_sphere(benchmark::State& state) {
    race_queries(state, [](math::vec3 const& p) { return bvh::SphereRegion{{p, 2.0F}}; });
}
BENCHMARK(by_sphere)->ArgNames({"n"})->Args({1024})->Args({32768})->Args({1 << 20});

void by_box(benchmark::State& state) {
    race_queries(state, [](math::vec3 const& p) { return bvh::BoxRegion{{p, p + math::vec3(2.0F)}}; });
}
BENCHMARK(by_box)->ArgNames({"n"})->Args({1024})->Args({32768})->Args({1 << 20});

void by_cone(benchmark::State& state) {
    race_queries(state, [](math::vec3 const& p) { return bvh::ConeRegion({p, 4.0F, math::vec3(1.0F, 1.0F, 1.0F), 0.4F}); });
}
BENCHMARK(by_cone)->ArgNames({"n"})->Args({1024})->Args({32768})->Args({1 << 20});

void by_frustum(benchmark::State& state) {
    math::PerspectiveConfig config;
    config.target_m = math::dvec3(0.6, 0.1, 1.0);
    config.size_px = math::ivec2(640, 480);
    config.fov_y_rad = 0.1;
    bvh::PlanesRegion const region{math::PlaneSet(math::frustum_of(math::make_perspective(config).value()))};
    race_queries(state, [&](math::vec3 const&) { return region; });
}
BENCHMARK(by_frustum)->ArgNames({"n"})->Args({1024})->Args({32768})->Args({1 << 20});

}  // namespace
