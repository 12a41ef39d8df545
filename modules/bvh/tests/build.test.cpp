#include <gnomon/bvh.hpp>
#include <gnomon/core/executor_threads.hpp>

#include "items_list.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <numeric>
#include <tuple>
#include <vector>

using namespace gnomon;
using items_list::Balls;

namespace {

/// Ids in the order that the definition says, by another sort and other arithmetic.
std::vector<std::uint32_t> order_from_scratch(Balls const& balls, std::uint32_t cells) {
    double lo[3] = {1e300, 1e300, 1e300};
    double hi[3] = {-1e300, -1e300, -1e300};
    std::vector<std::uint32_t> ids;
    auto const at = [&balls](std::size_t i, std::size_t k) {
        return k == 0 ? balls.x[i] : k == 1 ? balls.y[i] : balls.z[i];
    };
    for (std::uint32_t i = 0; i < balls.size(); ++i) {
        ids.push_back(i);
        for (std::size_t k = 0; k < 3; ++k) {
            lo[k] = std::min(lo[k], static_cast<double>(at(i, k)));
            hi[k] = std::max(hi[k], static_cast<double>(at(i, k)));
        }
    }
    auto const code = [&](std::uint32_t i) {
        std::uint32_t cell[3] = {0, 0, 0};
        for (std::size_t k = 0; k < 3; ++k) {
            float const extent = static_cast<float>(hi[k]) * 0.5F - static_cast<float>(lo[k]) * 0.5F;
            if (!(extent > 0.0F)) continue;
            float const scale = static_cast<float>(cells) / extent;
            float const place = (at(i, k) * 0.5F - static_cast<float>(lo[k]) * 0.5F) * scale;
            cell[k] = static_cast<std::uint32_t>(std::clamp(place, 0.0F, static_cast<float>(cells - 1)));
        }
        std::uint64_t bits = 0;
        for (unsigned bit = 0; bit < 21; ++bit)
            for (unsigned k = 0; k < 3; ++k) bits |= std::uint64_t{cell[k] >> bit & 1U} << (3 * bit + k);
        return bits;
    };
    std::vector<std::uint64_t> codes;
    for (std::uint32_t const i : ids) codes.push_back(code(i));
    std::stable_sort(ids.begin(), ids.end(), [&codes](std::uint32_t a, std::uint32_t b) { return codes[a] < codes[b]; });
    return ids;
}

template <class Items, std::uint32_t W>
bool same(bvh::Tree<Items, W> const& a, bvh::Tree<Items, W> const& b) {
    return a.layout == b.layout && a.ids == b.ids && a.items == b.items && a.nodes == b.nodes && a.left_out == b.left_out &&
           a.built_cost >= b.built_cost && a.built_cost <= b.built_cost;
}

template <std::uint32_t W>
std::size_t faults_of_sizes() {
    std::size_t faults = 0;
    for (std::size_t const n : {0U, 1U, 2U, W - 1, W, W + 1, W * W, W * W + 1, 3000U}) {
        Balls const balls = items_list::cloud(n);
        auto const tree = bvh::build_tree<W>(balls.list());
        auto const crates = items_list::crates_of(balls);
        auto const boxes = bvh::build_tree<W>(crates.list());
        faults += validate(tree) == bvh::TreeFault::none && tree.ids.size() == n ? 0U : 1U;
        faults += validate(boxes) == bvh::TreeFault::none && boxes.ids.size() == n ? 0U : 1U;
        faults += tree.ids == order_from_scratch(balls, 1024) ? 0U : 1U;
    }
    return faults;
}

}  // namespace

TEST_CASE("build makes a valid tree in Morton order of any number of items and any width", "[bvh]") {
    CHECK(faults_of_sizes<8>() == 0);
    CHECK(faults_of_sizes<16>() == 0);
    CHECK(faults_of_sizes<32>() == 0);
}

TEST_CASE("codes of 63 bits order what 30 bits cannot tell apart", "[bvh]") {
    Balls balls = items_list::cloud(2000);
    balls.add({math::vec3(1e6F), 1.0F});  // all others share few of 1,024 cells
    auto const coarse = bvh::build_tree(balls.list(), bvh::CodeBits::bits_30);
    auto const fine = bvh::build_tree(balls.list(), bvh::CodeBits::bits_63);
    CHECK(validate(fine) == bvh::TreeFault::none);
    CHECK(fine.ids == order_from_scratch(balls, 1U << 21U));
    auto const opened = [](bvh::SphereTree const& tree) {
        return for_each_touched(tree.view(), bvh::SphereRegion{{math::vec3(10.0F), 2.0F}}, [](std::uint32_t, std::uint32_t) {}).nodes;
    };
    CHECK(2 * opened(fine) < opened(coarse));
}

TEST_CASE("any executor and thread count builds the same tree", "[bvh]") {
    Balls const balls = items_list::cloud(70000);
    auto const alone = bvh::build_tree(balls.list());
    CHECK(alone.ids == order_from_scratch(balls, 1024));
    bvh::Workspace work;
    bvh::SphereTree tree;
    build(balls.list(), bvh::CodeBits::bits_30, work, tree, core::ThreadExecutor(3));
    CHECK(same(alone, tree));
    build(balls.list(), bvh::CodeBits::bits_30, work, tree, items_list::BackwardExecutor{});
    CHECK(same(alone, tree));
    auto const alone_63 = bvh::build_tree(balls.list(), bvh::CodeBits::bits_63);
    build(balls.list(), bvh::CodeBits::bits_63, work, tree, core::ThreadExecutor(2));
    CHECK(same(alone_63, tree));
}

TEST_CASE("keys made in lanes are the scalar ones", "[bvh]") {
    Balls balls = items_list::cloud(1003);
    balls.x[17] = std::numeric_limits<float>::quiet_NaN();
    balls.radius[1000] = -1.0F;
    auto const arrays = balls.list().arrays();
    auto const run = [&]<class S>(S) {
        bvh::detail::BlockSummary sum;
        bvh::detail::summarize<bvh::Spheres, S>(arrays, 0, balls.size(), sum);
        std::vector<bvh::detail::Key63> keys(balls.size());
        std::vector<float> records(4 * balls.size());
        bvh::detail::make_keys<bvh::Spheres, bvh::detail::Key63, S>(
            arrays, bvh::detail::make_code_grid(sum, 2097152.0F), 0, balls.size(), {keys.data(), records.data()});
        std::vector<std::uint64_t> flat;
        for (auto const& key : keys) flat.insert(flat.end(), {key.code(), key.id()});
        return std::tuple(sum.usable, sum.lo, sum.hi, flat);
    };
    auto const scalar = run(0.0F);
    CHECK(std::get<0>(scalar) == 1001);
    CHECK(run(math::Lanes<float, 4>{}) == scalar);
    CHECK(run(math::Lanes<float, 8>{}) == scalar);
}

TEST_CASE("items that are not usable are left out and counted, everything else is unchanged", "[bvh]") {
    float const nan = std::numeric_limits<float>::quiet_NaN();
    float const inf = std::numeric_limits<float>::infinity();
    Balls const good = items_list::cloud(500);
    Balls mixed;
    std::vector<std::uint32_t> place;
    for (std::size_t i = 0; i < good.size(); ++i) {
        if (i % 50 == 0) mixed.add({math::vec3(nan, 0.0F, 0.0F), 1.0F});
        if (i % 50 == 10) mixed.add({math::vec3(0.0F, -inf, 0.0F), 1.0F});
        if (i % 50 == 20) mixed.add({math::vec3(0.0F), nan});
        if (i % 50 == 30) mixed.add({math::vec3(0.0F), inf});
        if (i % 50 == 40) mixed.add({math::vec3(1e9F), -0.5F});
        place.push_back(static_cast<std::uint32_t>(mixed.size()));
        mixed.add(good.at(i));
    }
    auto const tree = bvh::build_tree(mixed.list());
    auto expected = bvh::build_tree(good.list());
    CHECK(tree.left_out == 50);
    CHECK(validate(tree) == bvh::TreeFault::none);
    for (std::uint32_t& id : expected.ids) id = place[id];
    CHECK(tree.ids == expected.ids);
    CHECK(tree.nodes == expected.nodes);

    items_list::Crates crates = items_list::crates_of(good);
    crates.add({math::vec3(1.0F), math::vec3(0.0F)});
    crates.add({math::vec3(-inf), math::vec3(inf)});
    CHECK(bvh::build_tree(crates.list()).left_out == 2);
}

TEST_CASE("coincident, flat and enormous input makes a tree too", "[bvh]") {
    Balls same_place;
    for (int i = 0; i < 10000; ++i) same_place.add({math::vec3(3.0F, 4.0F, 5.0F), 0.0F});
    auto const tree = bvh::build_tree(same_place.list());
    CHECK(validate(tree) == bvh::TreeFault::none);
    CHECK(std::is_sorted(tree.ids.begin(), tree.ids.end()));

    Balls line;
    for (int i = 0; i < 1000; ++i) line.add({math::vec3(static_cast<float>(999 - i), 0.0F, 0.0F), 0.1F});
    auto const sorted = bvh::build_tree(line.list());
    CHECK(std::is_sorted(sorted.ids.rbegin(), sorted.ids.rend()));

    float const most = std::numeric_limits<float>::max();
    float const least = std::numeric_limits<float>::denorm_min();
    Balls wild;
    for (float const x : {-most, most, 0.0F, least, 1e30F})
        for (float const r : {0.0F, least, 1.0F, most}) wild.add({math::vec3(x, -x, 1.0F), r});
    for (bvh::CodeBits const codes : {bvh::CodeBits::bits_30, bvh::CodeBits::bits_63}) {
        auto const t = bvh::build_tree(wild.list(), codes);
        CHECK(validate(t) == bvh::TreeFault::none);
        CHECK(t.ids.size() == 20);
        CHECK(t.built_cost >= 1.0);
    }
}

TEST_CASE("validate finds what is broken", "[bvh]") {
    auto const good = bvh::build_tree<8>(items_list::cloud(100).list());
    CHECK(validate(good) == bvh::TreeFault::none);
    auto tree = good;
    tree.layout.count[1] = 12;
    CHECK(validate(tree) == bvh::TreeFault::bad_layout);
    tree = good;
    tree.nodes.pop_back();
    CHECK(validate(tree) == bvh::TreeFault::short_arrays);
    tree = good;
    tree.ids[3] = tree.ids[4];
    CHECK(validate(tree) == bvh::TreeFault::repeated_id);
    tree = good;
    tree.nodes[2] = math::next_up(tree.nodes[2]);
    CHECK(validate(tree) == bvh::TreeFault::loose_box);
    tree = good;
    for (std::size_t k = 0; k < 4; ++k) tree.items[k * tree.layout.item_slots + 101] = 1.0F;
    CHECK(validate(tree) == bvh::TreeFault::bad_padding);
}
