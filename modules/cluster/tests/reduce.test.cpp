#include <gnomon/check/allocations.hpp>
#include <gnomon/check/check.hpp>
#include <gnomon/cluster/reduce.hpp>
#include <gnomon/core/executor_threads.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

namespace {

using namespace gnomon;
using cluster::no_cluster;

core::SerialExecutor const reduce_serial;
core::ThreadExecutor const reduce_threads(3);
core::ExecutorRef const one_thread(reduce_serial);  // by reference: each reduction is compiled once
core::ExecutorRef const three_threads(reduce_threads);

struct ReduceCase {
    std::vector<std::uint32_t> index;
    std::vector<math::vec3> values;
    std::uint32_t clusters = 0;
};

std::string check_string(ReduceCase const& c) {
    return std::to_string(c.index.size()) + " samples of " + std::to_string(c.clusters) + " clusters";
}

/// Runs of samples; values near each other in a cluster or anywhere, some NaN, zeros of both signs.
auto reduce_cases(int most) {
    return [most](check::Choices& choices) {
        ReduceCase c;
        c.clusters = check::integers(1U, 50U)(choices);
        auto const samples = static_cast<std::size_t>(check::integers(0, most)(choices));
        auto const longest = check::element_of({1U, 5U, 300U})(choices);
        bool const bad_ones = choices.draw(1) != 0;
        float const spread = check::element_of({1.0F, 0.1F, 1e-3F})(choices);
        std::uint32_t state = check::integers(1U, 1000000U)(choices);
        auto const random = [&state] { return (state = state * 1664525U + 1013904223U) >> 8U; };
        auto const part = [&] { return static_cast<float>(random()) * 0x1p-23F - 1.0F; };
        while (c.index.size() < samples) {
            std::uint32_t const cluster = random() % (c.clusters + 2);  // one beyond, and none
            std::uint32_t const length = 1 + random() % longest;
            for (std::uint32_t i = 0; i < length && c.index.size() < samples; ++i) {
                math::vec3 v(part() * spread, part() * spread, 1.0F + part() * spread);
                if (cluster % 2 == 1) v = -v;
                if (bad_ones && random() % 64 == 0) v.x = std::numeric_limits<float>::quiet_NaN();
                if (bad_ones && random() % 64 == 0) v.y = std::numeric_limits<float>::infinity();
                if (random() % 32 == 0) v.x = random() % 2 == 0 ? 0.0F : -0.0F;
                c.index.push_back(cluster > c.clusters ? no_cluster : cluster);
                c.values.push_back(v);
            }
        }
        return c;
    };
}

std::vector<math::Aabb> boxes_by(ReduceCase const& c, core::ExecutorRef const& executor, cluster::ReduceStats& stats) {
    std::vector<math::Aabb> boxes(c.clusters);
    cluster::ReduceWorkspace work;
    stats = cluster::explicit_bounds(c.index, c.values, boxes, work, executor);
    return boxes;
}

std::vector<cluster::NormalCone> cones_by(ReduceCase const& c, core::ExecutorRef const& executor, cluster::ReduceStats& stats) {
    std::vector<cluster::NormalCone> cones(c.clusters);
    cluster::ReduceWorkspace work;
    stats = cluster::explicit_cones(c.index, c.values, cones, work, executor);
    return cones;
}

}  // namespace

TEST_CASE("explicit boxes are the samples' own, for any executor, and what is left out is counted", "[cluster][property]") {
    auto const check_case = [](ReduceCase const& c) {
        cluster::ReduceStats stats;
        auto const boxes = boxes_by(c, one_thread, stats);
        std::vector<math::Aabb> expected(c.clusters);
        cluster::ReduceStats left_out;
        for (std::size_t i = 0; i < c.index.size(); ++i) {
            if (c.index[i] == c.clusters) ++left_out.outside;
            if (c.index[i] >= c.clusters) continue;
            if (math::is_finite(c.values[i])) expected[c.index[i]] = math::extended(expected[c.index[i]], c.values[i]);
            else ++left_out.not_finite;
        }
        CHECK(boxes == expected);
        CHECK(stats == left_out);
        for (math::Aabb const& box : boxes) CHECK_FALSE((box.lo.x == 0.0F && std::signbit(box.lo.x)));
        if (c.index.size() < 20000) return;
        cluster::ReduceStats by_threads;
        CHECK(boxes_by(c, three_threads, by_threads) == boxes);
        CHECK(by_threads == stats);
    };
    check::for_all(check::cases(300), reduce_cases(400), check_case);
    check::for_all(check::cases(6), reduce_cases(70000), check_case);
}

TEST_CASE("an explicit cone holds the normals it was made of, for any executor, and touches one", "[cluster][property]") {
    auto const cosine = [](math::vec3 const& a, math::vec3 const& b) {
        auto const dot = [](math::vec3 const& p, math::vec3 const& q) {
            return static_cast<long double>(p.x) * static_cast<long double>(q.x) + static_cast<long double>(p.y) * static_cast<long double>(q.y) +
                   static_cast<long double>(p.z) * static_cast<long double>(q.z);
        };
        return dot(a, b) / std::sqrt(dot(a, a) * dot(b, b));
    };
    auto const check_case = [&](ReduceCase const& c) {
        cluster::ReduceStats stats;
        auto const cones = cones_by(c, one_thread, stats);
        std::vector<long double> least(c.clusters, 2.0L);
        std::vector<bool> unknown(c.clusters, false);
        for (std::size_t i = 0; i < c.index.size(); ++i) {
            if (c.index[i] >= c.clusters) continue;
            auto const& cone = cones[c.index[i]];
            if (!math::is_finite(c.values[i])) {
                unknown[c.index[i]] = true;
                continue;
            }
            long double const at = cosine(cone.axis, c.values[i]);
            CHECK(at >= static_cast<long double>(cone.cos_half));
            least[c.index[i]] = std::min(least[c.index[i]], at);
        }
        for (std::uint32_t k = 0; k < c.clusters; ++k) {
            if (unknown[k]) CHECK(cones[k].cos_half == -1.0F);
            else CHECK(std::abs(static_cast<long double>(cones[k].cos_half) - least[k]) < 1.3e-7L);
        }
        if (c.index.size() < 20000) return;
        cluster::ReduceStats by_threads;
        CHECK(cones_by(c, three_threads, by_threads) == cones);
        CHECK(by_threads == stats);
    };
    check::for_all(check::cases(300), reduce_cases(400), check_case);
    check::for_all(check::cases(6), reduce_cases(70000), check_case);
}

TEST_CASE("cones of no, of opposite and of unknown normals are defined", "[cluster]") {
    ReduceCase c;
    c.clusters = 4;
    c.index = {1, 1, 2, 3, 3};
    c.values = {math::vec3(0, 1, 0), math::vec3(0, -1, 0), math::vec3(0.0F), math::vec3(3, 0, 0), math::vec3(0, 3, 0)};
    cluster::ReduceStats stats;
    auto const cones = cones_by(c, one_thread, stats);
    CHECK(cones[0].cos_half == 2.0F);
    CHECK(cones[1].cos_half == -1.0F);
    CHECK(cones[2].cos_half == -1.0F);
    CHECK(std::abs(cones[3].cos_half - std::sqrt(0.5F)) < 2e-7F);
    CHECK(stats == cluster::ReduceStats{1, 0});
}

TEST_CASE("reduced position bits are each sample's together, and samples outside of the box are counted", "[cluster][property]") {
    check::for_all(check::cases(200), reduce_cases(400), [](ReduceCase const& c) {
        math::Aabb const box{math::vec3(-0.9F, -1.0F, -2.0F), math::vec3(1.0F, 1.0F, 2.0F)};
        std::vector<math::Aabb> const implicit(c.clusters, box);
        std::vector<cluster::PositionBits> bits(c.clusters, 7);
        auto const stats = cluster::reduce_position_bits(c.index, c.values, implicit, bits, one_thread);
        std::vector<cluster::PositionBits> expected(c.clusters, 0);
        std::size_t outside = 0;
        for (std::size_t i = 0; i < c.index.size(); ++i) {
            if (c.index[i] == no_cluster || !math::is_finite(c.values[i])) {
                outside += c.index[i] == c.clusters ? 1U : 0U;
                continue;
            }
            bool const inside = c.index[i] < c.clusters && contains(box, c.values[i]);
            if (inside) expected[c.index[i]] |= cluster::position_bits(box, c.values[i]);
            outside += inside ? 0U : 1U;
        }
        CHECK(bits == expected);
        CHECK(stats.outside == outside);
        std::vector<cluster::PositionBits> by_threads(c.clusters);
        CHECK(cluster::reduce_position_bits(c.index, c.values, implicit, by_threads, three_threads) == stats);
        CHECK(by_threads == bits);
    });
}

TEST_CASE("reductions allocate nothing once the workspace has grown", "[cluster]") {
    std::vector<std::uint32_t> index(50000);
    std::vector<math::vec3> values(index.size(), math::vec3(0.5F));
    for (std::size_t i = 0; i < index.size(); ++i) index[i] = static_cast<std::uint32_t>(i / 7 % 100);
    std::vector<math::Aabb> boxes(100);
    std::vector<cluster::NormalCone> cones(100);
    cluster::ReduceWorkspace work;
    auto const run = [&] {
        auto const a = cluster::explicit_bounds(index, values, boxes, work, one_thread);
        auto const b = cluster::explicit_cones(index, values, cones, work, one_thread);
        return a.outside + b.outside;
    };
    std::size_t const first = run();
    std::uint64_t const before = check::allocations_made();
    CHECK(run() == first);
    CHECK(check::allocations_made() == before);
}
