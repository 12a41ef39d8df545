#include <gnomon/check/check.hpp>
#include <gnomon/core/executor_threads.hpp>

#include <gnomon/trace/build.hpp>
#include <gnomon/trace/query.hpp>
#include <gnomon/trace/validate.hpp>

#include "scenes.hpp"

#include <algorithm>
#include <cstring>
#include <limits>

using namespace gnomon;
using scenes::Light;
using scenes::Mesh;
using scenes::Random;
using scenes::TriangleId;
using trace::BvhFault;

namespace {

/// A grid of small separate triangles in the plane y = 1, and how many of them a segment aimed at each finds.
struct Field {
    Mesh mesh;
    int side;

    explicit Field(int n) : side(n) {
        for (int i = 0; i < n * n; ++i) {
            math::vec3 const at(static_cast<float>(i % n), 1.0F, static_cast<float>(i / n));
            mesh.add(at, at + math::vec3(0.0F, 0.0F, 0.5F), at + math::vec3(0.5F, 0.0F, 0.0F));
        }
    }
    [[nodiscard]] int found(trace::Bvh const& bvh, int skip) const {
        int count = 0;
        for (int i = 0; i < side * side; ++i) {
            if (i == skip) continue;
            math::vec3 const start(static_cast<float>(i % side) + 0.125F, 0.0F, static_cast<float>(i / side) + 0.125F);
            auto const hit = nearest_blocker(bvh, {start, Light::point(start + math::vec3(0.0F, 2.0F, 0.0F))});
            count += hit && hit->triangle.value == static_cast<std::uint32_t>(i) ? 1 : 0;
        }
        return count;
    }
};

bool same_bits(trace::Bvh const& a, trace::Bvh const& b) {
    auto const same_nodes = [](trace::Node const& x, trace::Node const& y) {  // but for the padding
        return std::memcmp(x.lo, y.lo, sizeof(x.lo)) == 0 && std::memcmp(x.hi, y.hi, sizeof(x.hi)) == 0 &&
               std::memcmp(x.child, y.child, sizeof(x.child)) == 0;
    };
    return a.blocks.size() == b.blocks.size() &&
           std::memcmp(a.blocks.data(), b.blocks.data(), a.blocks.size() * sizeof(trace::Block)) == 0 &&
           std::equal(a.nodes.begin(), a.nodes.end(), b.nodes.begin(), b.nodes.end(), same_nodes);
}

}  // namespace

TEST_CASE("build_bvh makes a valid hierarchy of any number of triangles", "[trace]") {
    Random random{31};
    for (std::size_t const n : {0U, 1U, 2U, 3U, 4U, 5U, 16U, 17U, 1000U, 5000U}) {
        Mesh const mesh = scenes::soup(random, n);
        trace::Bvh const bvh = trace::build_bvh(mesh.list());
        CAPTURE(n);
        CHECK(validate(bvh) == BvhFault::none);
        CHECK(bvh.triangles + bvh.left_out.zero_area == n);
    }
}

TEST_CASE("one NaN, infinite or huge vertex costs its own triangle at most", "[trace][degenerate]") {
    int const bad = 4711;
    Field const whole(100);
    REQUIRE(whole.found(trace::build_bvh(whole.mesh.list()), -1) == 10'000);
    for (float const value : {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity(),
                              -std::numeric_limits<float>::infinity()}) {
        Field field(100);
        field.mesh.positions[3 * bad + 1].y = value;
        trace::Bvh const bvh = trace::build_bvh(field.mesh.list());
        CHECK(bvh.left_out == trace::LeftOut{0, 1, 0});
        CHECK(validate(bvh) == BvhFault::none);
        CHECK(field.found(bvh, bad) == 9'999);
    }
    for (float const value : {1e30F, std::numeric_limits<float>::max()}) {
        Field field(100);
        field.mesh.positions[3 * bad + 1].y = value;  // upwards: it passes over nothing else
        trace::Bvh const bvh = trace::build_bvh(field.mesh.list());
        CHECK(bvh.left_out == trace::LeftOut{});
        CHECK(validate(bvh) == BvhFault::none);
        CHECK(field.found(bvh, bad) == 9'999);
    }
}

TEST_CASE("10,000 identical triangles are a legal scene", "[trace][degenerate]") {
    Mesh mesh;
    mesh.add(math::vec3(0.0F, 1.0F, 0.0F), math::vec3(0.0F, 1.0F, 4.0F), math::vec3(4.0F, 1.0F, 0.0F));
    mesh.corners.resize(10'000, mesh.corners[0]);
    trace::Bvh const bvh = trace::build_bvh(mesh.list());
    CHECK(validate(bvh) == BvhFault::none);
    CHECK(bvh.triangles == 10'000);
    auto const hit = nearest_blocker(bvh, {math::vec3(1.0F, 0.0F, 1.0F), Light::direction(math::vec3(0.0F, 1.0F, 0.0F))}, TriangleId(0));
    REQUIRE(hit.has_value());
    CHECK(hit->triangle == TriangleId(1));
}

TEST_CASE("triangles that can block nothing are left out and counted, each under its reason", "[trace][degenerate]") {
    Mesh mesh;
    mesh.add(math::vec3(0.0F), math::vec3(1.0F), math::vec3(2.0F));                                         // on a line
    mesh.add(math::vec3(0.0F), math::vec3(0.0F), math::vec3(2.0F, 1.0F, 0.0F));                             // two equal
    mesh.add(math::vec3(0.1F), math::vec3(0.3F), math::vec3(0.7F));                                         // diagonal: exactly on a line
    mesh.add(math::vec3(0.0F), math::vec3(1e-45F, 0.0F, 0.0F), math::vec3(0.0F, 1e-45F, 0.0F));             // tiny, not empty
    mesh.add(math::vec3(0.0F), math::vec3(1.0F, std::numeric_limits<float>::infinity(), 0.0F), math::vec3(1.0F));
    mesh.corners.emplace_back(0, 1, 999);
    trace::Bvh const bvh = trace::build_bvh(mesh.list());
    CHECK(bvh.left_out == trace::LeftOut{1, 1, 3});
    CHECK(bvh.triangles == 1);
}

TEST_CASE("coordinates that double at every step cannot make the hierarchy too deep", "[trace][degenerate]") {
    Mesh mesh;
    for (int i = -149; i < 127; ++i)
        for (int k = 0; k < 20; ++k) {
            float const x = std::ldexp(1.0F, i);
            mesh.add(math::vec3(x, 0.0F, 0.0F), math::vec3(x, 1.0F, 0.0F), math::vec3(x, 0.0F, 1.0F));
        }
    CHECK(validate(trace::build_bvh(mesh.list())) == BvhFault::none);
}

TEST_CASE("the hierarchy is the same for any number of threads", "[trace][determinism]") {
    scenes::Yard const yard(3, 16);
    trace::Bvh const serial = trace::build_bvh(yard.mesh.list());
    REQUIRE(serial.triangles > 20'000);
    for (int const threads : {1, 2, 7}) {
        core::ThreadExecutor const executor(threads);
        CHECK(same_bits(trace::build_bvh(yard.mesh.list(), executor), serial));
    }
}

TEST_CASE("validate names each fault", "[trace]") {
    scenes::Yard const yard(1, 4);
    trace::Bvh const good = trace::build_bvh(yard.mesh.list());
    REQUIRE(validate(good) == BvhFault::none);
    auto const broken = [&](auto&& change) {
        trace::Bvh bvh = good;
        change(bvh);
        return validate(bvh);
    };
    CHECK(broken([](trace::Bvh& b) { b.nodes.clear(); }) == BvhFault::empty_root);
    CHECK(broken([](trace::Bvh& b) { b.nodes[0].child[0] = trace::Child::node(1U << 29U); }) == BvhFault::bad_child);
    CHECK(broken([](trace::Bvh& b) { b.nodes[0].child[0] = trace::Child::node(0); }) == BvhFault::shared_child);
    CHECK(broken([](trace::Bvh& b) { b.nodes[0].lo[0][0] += 1.0F; }) == BvhFault::loose_box);
    CHECK(broken([](trace::Bvh& b) { b.triangles += 1; }) == BvhFault::wrong_count);
    CHECK(broken([](trace::Bvh& b) { b.blocks.push_back(b.blocks[0]); }) == BvhFault::unreachable);
}
