// Nanoseconds a pair of a light and a cluster, eight clusters at a time where the machine has AVX2. The peer, in the same
// turn, is the textbook's test of the same light: its ball against the cluster's box, which keeps far more.

#include <gnomon/cull.hpp>
#include <gnomon/math/lanes.hpp>

#include "../tests/light_scenes.hpp"

#include <benchmark/benchmark.h>

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

using namespace gnomon;

namespace {

#if GNOMON_VECTOR_EXTENSION && (defined(__x86_64__) || defined(__i386__))
using Wide = math::Lanes<float, 8>;
#define BENCH_WIDE [[gnu::target("avx2"), gnu::flatten, gnu::noinline]]
#else
using Wide = math::Lanes<float, 4>;
#define BENCH_WIDE [[gnu::noinline]]
#endif

template <class S>
[[gnu::always_inline]] inline formula::GnCell<S> cells_at(cluster::GridView const& g, std::uint32_t column, std::uint32_t row, std::uint32_t slice) {
    formula::Float<S> const left(S::load(g.x.data() + column));
    formula::Float<S> const right(S::load(g.x.data() + column + 1));
    return {left, right, g.y[row], g.y[row + 1], g.depth_m[slice], g.depth_m[slice + 1]};
}

template <class S>
[[gnu::always_inline]] inline formula::Vec3<S> spread(formula::Vec3<float> const& v) {
    return {formula::Float<S>(v.x.v), formula::Float<S>(v.y.v), formula::Float<S>(v.z.v)};
}

struct BallTest {
    formula::GnSphere<Wide> ball;
    explicit BallTest(test::SceneLight const& l) : ball{spread<Wide>(formula::Vec3<float>(l.center)), formula::Float<Wide>(l.range)} {}
    [[gnu::always_inline]] formula::Bool<Wide> operator()(formula::GnCell<Wide> const& c) const { return gn_touches_sphere_cell(ball, c, true); }
};

template <int steps>
struct ConeTest {
    formula::GnSector<Wide> cone;
    explicit ConeTest(test::SceneLight const& l) {
        auto const s = math::formula_sector({l.center, l.range, l.axis, l.half_angle_rad});
        cone = {spread<Wide>(s.apex), formula::Float<Wide>(s.range.v), spread<Wide>(s.axis), formula::Float<Wide>(s.cosine.v), formula::Float<Wide>(s.sine.v)};
    }
    [[gnu::always_inline]] formula::Bool<Wide> operator()(formula::GnCell<Wide> const& c) const { return gn_touches_sector_cell(cone, c, true, steps); }
};

struct TextbookTest {
    formula::Vec3<Wide> center;
    formula::Float<Wide> limit;
    explicit TextbookTest(test::SceneLight const& l)
        : center(spread<Wide>(formula::Vec3<float>(l.center))), limit(gn_touch_limit(formula::Float<Wide>(l.range))) {}
    [[gnu::always_inline]] formula::Bool<Wide> operator()(formula::GnCell<Wide> const& c) const {
        formula::GnBox<Wide> const box{{gn_min(c.left * c.near, c.left * c.far), gn_min(c.top * c.near, c.top * c.far), c.near},
                                       {gn_max(c.right * c.near, c.right * c.far), gn_max(c.bottom * c.near, c.bottom * c.far), c.far}};
        return gn_touches_sphere_box(center, limit, box);
    }
};

/// Every light against 24 of the 27 columns, all rows and those slices that its ball reaches.
template <class Test>
BENCH_WIDE std::size_t count_kept(std::vector<test::SceneLight> const& lights, cluster::GridView const& g, std::size_t& pairs) {
    std::size_t kept = 0;
    for (auto const& light : lights) {
        Test const touches(light);
        for (std::uint32_t slice = 0; slice < g.slices(); ++slice) {
            if (g.depth_m[slice] > light.center.z + light.range || g.depth_m[slice + 1] < light.center.z - light.range) continue;
            for (std::uint32_t row = 0; row < g.rows(); ++row)
                for (std::uint32_t column = 0; column + Wide::size <= 24; column += Wide::size) {
                    kept += static_cast<std::size_t>(__builtin_popcount(math::bits(touches(cells_at<Wide>(g, column, row, slice)).v)));
                    pairs += Wide::size;
                }
        }
    }
    return kept;
}

template <class Test>
void race(benchmark::State& state) {
    test::YardGrid const yard;
    auto const lights = test::make_lights(test::light_scenes[state.range(0)], 256);
    double ours = std::numeric_limits<double>::infinity();
    double peer = ours;
    std::size_t pairs = 0, kept = 0, kept_by_peer = 0;
    auto const timed = [&](auto&& f) {
        auto const start = std::chrono::steady_clock::now();
        f();
        return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    };
    for (auto _ : state) {
        pairs = 0;
        ours = std::min(ours, timed([&] { kept = count_kept<Test>(lights, yard.view(), pairs); }));
        pairs = 0;
        peer = std::min(peer, timed([&] { kept_by_peer = count_kept<TextbookTest>(lights, yard.view(), pairs); }));
    }
    state.counters["ours_ns"] = ours / static_cast<double>(pairs) * 1e9;
    state.counters["peer_ns"] = peer / static_cast<double>(pairs) * 1e9;
    state.counters["kept"] = static_cast<double>(kept);
    state.counters["kept_by_peer"] = static_cast<double>(kept_by_peer);
}

BENCHMARK_TEMPLATE(race, BallTest)->ArgNames({"scene"})->DenseRange(0, 3);
BENCHMARK_TEMPLATE(race, ConeTest<1>)->ArgNames({"scene"})->DenseRange(0, 3);
BENCHMARK_TEMPLATE(race, ConeTest<2>)->ArgNames({"scene"})->DenseRange(0, 3);

}  // namespace
