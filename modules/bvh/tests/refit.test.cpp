#include <gnomon/bvh.hpp>
#include <gnomon/check/allocations.hpp>
#include <gnomon/core/executor_threads.hpp>

#include "items_list.hpp"

#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

using namespace gnomon;
using items_list::Balls;

GNOMON_COUNT_ALLOCATIONS;

TEST_CASE("refit in place is the tree itself, and its quality is 1", "[bvh]") {
    Balls const balls = items_list::cloud(5000);
    auto tree = bvh::build_tree(balls.list());
    auto const before = tree.nodes;
    bvh::Refit const same = refit(tree, balls.list());
    CHECK(tree.nodes == before);
    CHECK(same.quality == Approx(1.0).epsilon(0.0));
    CHECK(same.lost == 0);
}

TEST_CASE("refit follows moved items for any executor; the quality falls as neighbours part", "[bvh]") {
    Balls balls = items_list::cloud(40000);
    auto tree = bvh::build_tree(balls.list());
    auto by_threads = tree;
    items_list::Random random{3};
    double last = 1.0;
    for (int frame = 0; frame < 3; ++frame) {
        for (std::size_t i = 0; i < balls.size(); ++i) {
            math::vec3 const step = random.point(-8.0F, 8.0F);
            balls.x[i] += step.x;
            balls.y[i] += step.y;
            balls.z[i] += step.z;
        }
        bvh::Refit const now = refit(tree, balls.list());
        CHECK(validate(tree) == bvh::TreeFault::none);
        static_cast<void>(refit(by_threads, balls.list(), core::ThreadExecutor(3)));
        CHECK(by_threads.nodes == tree.nodes);
        CHECK(by_threads.items == tree.items);
        CHECK(now.quality < last);
        last = now.quality;
    }
    CHECK(bvh::build_tree(balls.list()).built_cost < 0.6 * cost(tree.view()));
    std::vector<std::uint32_t> out(balls.size());
    bvh::SphereRegion const region{{math::vec3(10.0F), 15.0F}};
    out.resize(query_by_id(tree.view(), region, out));
    std::vector<std::uint32_t> expected(balls.size());
    auto const fresh = bvh::build_tree(balls.list());
    expected.resize(query_by_id(fresh.view(), region, expected));
    CHECK(out == expected);
}

TEST_CASE("an item that is no longer usable is touched by nothing until it is again", "[bvh]") {
    Balls balls = items_list::cloud(100);
    auto tree = bvh::build_tree(balls.list());
    bvh::SphereRegion const all{{math::vec3(0.0F), 1e20F}};
    std::vector<std::uint32_t> out(100);
    float const x = balls.x[7];
    balls.x[7] = std::numeric_limits<float>::quiet_NaN();
    CHECK(refit(tree, balls.list()).lost == 1);
    CHECK(validate(tree) == bvh::TreeFault::none);
    CHECK(query(tree.view(), all, out) == 99);
    balls.x[7] = x;
    CHECK(refit(tree, balls.list()).lost == 0);
    CHECK(query(tree.view(), all, out) == 100);

    auto boxes = bvh::build_tree(items_list::crates_of(balls).list());
    balls.z[9] = std::numeric_limits<float>::infinity();
    CHECK(refit(boxes, items_list::crates_of(balls).list()).lost == 1);
    CHECK(query(boxes.view(), all, out) == 99);
}

TEST_CASE("build, refit and query allocate nothing after the first build", "[bvh][memory]") {
    Balls const balls = items_list::cloud(50000);
    Balls const fewer = items_list::cloud(20000, 2);
    bvh::Workspace work;
    bvh::SphereTree tree;
    core::SerialExecutor const serial;
    build(balls.list(), bvh::CodeBits::bits_30, work, tree, serial);
    build(balls.list(), bvh::CodeBits::bits_63, work, tree, serial);
    std::vector<std::uint32_t> out(50000);
    std::uint64_t const before = check::allocations_made();
    build(fewer.list(), bvh::CodeBits::bits_30, work, tree, serial);
    build(balls.list(), bvh::CodeBits::bits_63, work, tree, items_list::BackwardExecutor{});
    static_cast<void>(refit(tree, balls.list()));
    std::size_t const hits = query_by_id(tree.view(), bvh::SphereRegion{{math::vec3(0.0F), 50.0F}}, out);
    CHECK(check::allocations_made() == before);
    CHECK(hits > 1000);
}
