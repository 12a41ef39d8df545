#include <gnomon/bvh.hpp>
#include <gnomon/math/view.hpp>

#include "items_list.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <tuple>
#include <vector>

using namespace gnomon;
using items_list::Balls;

namespace {

/// The same region for callers that know no lanes: every child is tested alone, as a box.
template <class R>
struct BoxesOnly {
    R region;
    [[nodiscard]] bool may_touch(math::Aabb const& box) const noexcept { return region.may_touch(box); }
};

// Not inlined, here and below: the compiler takes long over copies of the same.
template <class Tree, class R>
[[gnu::noinline]] std::vector<std::uint32_t> found(Tree const& tree, R const& region) {
    std::vector<std::uint32_t> ids(tree.ids.size());
    ids.resize(query(tree.view(), region, ids));
    return ids;
}

/// Every item in tree order, each asked alone.
template <class Items, std::uint32_t W, class R>
[[gnu::noinline]] std::vector<std::uint32_t> brute_force(bvh::Tree<Items, W> const& tree, R const& region) {
    std::vector<std::uint32_t> ids;
    for (std::size_t slot = 0; slot < tree.ids.size(); ++slot) {
        auto const item = bvh::detail::load_item<float>(tree.view().items, slot);
        if (bvh::detail::asked_item<float, Items>(region, item).v) ids.push_back(tree.ids[slot]);
    }
    return ids;
}

template <class S, class R>
[[gnu::noinline]] std::uint32_t mask_of(bvh::TreeView<bvh::Spheres> const& view, R const& region, std::uint32_t level, std::uint32_t node) {
    return bvh::detail::touched_children<S>(view, region, level, node);
}

/// A region among the items: some miss all, some hold all.
template <class R>
struct Maker;
template <>
struct Maker<bvh::SphereRegion> {
    static bvh::SphereRegion make(check::Choices& choices) {
        math::vec3 const c = math::points()(choices);
        float const r = choices.draw(3) == 0 ? 1e6F : check::floats(0.0F, 300.0F)(choices);
        return {{c, r}};
    }
};
template <>
struct Maker<bvh::BoxRegion> {
    static bvh::BoxRegion make(check::Choices& choices) { return {math::boxes()(choices)}; }
};
template <>
struct Maker<bvh::PlanesRegion> {
    static bvh::PlanesRegion make(check::Choices& choices) {
        return {math::PlaneSet(math::frustum_of(math::views()(choices)))};
    }
};
template <>
struct Maker<bvh::ConeRegion> {
    static bvh::ConeRegion make(check::Choices& choices) {
        math::Cone cone;
        cone.apex = math::points()(choices);
        cone.range = check::floats(0.0F, 2000.0F)(choices);
        cone.axis = math::to_float(math::directions()(choices));
        cone.half_angle_rad = check::floats(0.0F, 3.2F)(choices);
        return bvh::ConeRegion(cone);
    }
};

/// `all`: over boxes too, and by boxes alone.
template <class R, std::uint32_t W, bool all>
void check_region() {
    auto const regions = [](check::Choices& choices) { return Maker<R>::make(choices); };
    check::for_all(check::cases(60), items_list::balls(0, 200), regions, [](Balls const& balls, R const& region) {
        auto const spheres = bvh::build_tree<W>(balls.list());
        auto const expected = brute_force(spheres, region);
        CHECK(found(spheres, region) == expected);
        if constexpr (all) {
            auto const boxes = bvh::build_tree<W>(items_list::crates_of(balls).list());
            CHECK(found(boxes, region) == brute_force(boxes, region));
            BoxesOnly<R> const boxes_only{region};
            CHECK(found(boxes, boxes_only) == brute_force(boxes, boxes_only));
        }
        auto by_id = expected;
        std::sort(by_id.begin(), by_id.end());
        if constexpr (all) {
            std::vector<std::uint32_t> out(balls.size());
            out.resize(query_by_id(spheres.view(), region, out));
            CHECK(out == by_id);
        }
    });
}

}  // namespace

TEST_CASE("a query finds what brute force finds, in tree order, whatever the region and the width", "[bvh][property]") {
    check_region<bvh::SphereRegion, 32, true>();
    check_region<bvh::SphereRegion, 8, false>();
    check_region<bvh::BoxRegion, 16, false>();
    check_region<bvh::PlanesRegion, 32, false>();
    check_region<bvh::ConeRegion, 32, true>();
}

TEST_CASE("what touches a box touches every box around it, rounding included", "[bvh][property]") {
    check::for_all(check::cases(4000), math::boxes(), math::boxes(), [](check::Choices& choices) {
        return std::tuple(Maker<bvh::SphereRegion>::make(choices), Maker<bvh::PlanesRegion>::make(choices),
                          Maker<bvh::ConeRegion>::make(choices));
    }, [](math::Aabb const& inner, math::Aabb const& other, auto const& regions) {
        math::Aabb const outer = math::merged(inner, other);
        auto const grown = [&](auto const& region) { return !region.may_touch(inner) || region.may_touch(outer); };
        CHECK(grown(std::get<0>(regions)));
        CHECK(grown(std::get<1>(regions)));
        CHECK(grown(std::get<2>(regions)));
    });
}

TEST_CASE("eight, four and one child at a time give the same bits", "[bvh]") {
    auto const tree = bvh::build_tree(items_list::cloud(3000).list());
    auto const view = tree.view();
    math::PerspectiveConfig config;
    config.target_m = math::dvec3(0.0, 0.0, -1.0);
    config.size_px = math::ivec2(640, 480);
    bvh::PlanesRegion const planes{math::PlaneSet(math::frustum_of(math::make_perspective(config).value()))};
    items_list::Random random{9};
    std::size_t differ = 0;
    std::size_t some = 0;
    auto const compare = [&](auto const& region) {
        for (std::uint32_t level = 1; level <= view.layout.levels; ++level)
            for (std::uint32_t node = 0; node < view.layout.count[level]; ++node) {
                auto const one = mask_of<float>(view, region, level, node);
                auto const four = mask_of<math::Lanes<float, 4>>(view, region, level, node);
                auto const eight = mask_of<math::Lanes<float, 8>>(view, region, level, node);
                differ += one != four || one != eight || one != bvh::detail::make_child_tests(view, region)(level, node) ? 1U : 0U;
                some += one != 0 && one != ~0U ? 1U : 0U;
            }
    };
    compare(planes);
    for (int i = 0; i < 20; ++i) {
        math::vec3 const p = random.point(-100.0F, 100.0F);
        compare(bvh::SphereRegion{{p, random(0.0F, 80.0F)}});
        compare(bvh::BoxRegion{{p, p + math::vec3(random(0.0F, 50.0F))}});
        compare(bvh::ConeRegion({p, random(0.0F, 80.0F), random.point(-1.0F, 1.0F), random(0.0F, 3.2F)}));
    }
    CHECK(differ == 0);
    CHECK(some > 100);
}

TEST_CASE("a query says how many there are when the buffer is too small, and writes the first", "[bvh]") {
    auto const tree = bvh::build_tree(items_list::cloud(400).list());
    bvh::SphereRegion const region{{math::vec3(0.0F), 60.0F}};
    auto const all = found(tree, region);
    REQUIRE(all.size() > 20);
    std::vector<std::uint32_t> few(7, ~0U);
    CHECK(query(tree.view(), region, few) == all.size());
    CHECK(std::equal(few.begin(), few.end(), all.begin()));
    CHECK(query(tree.view(), region, {}) == all.size());
    std::vector<std::uint32_t> seen;
    auto const stats = for_each_touched(tree.view(), region, [&](std::uint32_t slot, std::uint32_t id) {
        CHECK(tree.ids[slot] == id);
        seen.push_back(id);
        return seen.size() < 3;
    });
    CHECK(stats.hits == 3);
    CHECK(std::equal(seen.begin(), seen.end(), all.begin()));
}

TEST_CASE("regions that hold no point touch nothing, empty trees neither", "[bvh]") {
    float const nan = std::numeric_limits<float>::quiet_NaN();
    float const inf = std::numeric_limits<float>::infinity();
    auto const tree = bvh::build_tree(items_list::cloud(100).list());
    auto const boxes = bvh::build_tree(items_list::crates_of(items_list::cloud(100)).list());
    std::vector<math::Sphere> const bad{{math::vec3(0.0F), -1.0F}, {math::vec3(0.0F), inf}, {math::vec3(0.0F), nan},
                                        {math::vec3(0.0F, nan, 0.0F), 10.0F}, {math::vec3(inf, 0.0F, 0.0F), 10.0F}};
    for (math::Sphere const& sphere : bad) {
        CHECK(found(tree, bvh::SphereRegion{sphere}).empty());
        CHECK(found(boxes, bvh::SphereRegion{sphere}).empty());
    }
    CHECK(found(tree, bvh::BoxRegion{}).empty());
    CHECK(found(boxes, bvh::BoxRegion{}).empty());
    CHECK(found(boxes, bvh::BoxRegion{{math::vec3(0.0F, nan, 0.0F), math::vec3(1.0F)}}).empty());
    CHECK(found(tree, bvh::PlanesRegion{}).size() == 100);
    CHECK(found(bvh::build_tree(Balls{}.list()), bvh::SphereRegion{{math::vec3(0.0F), 1.0F}}).empty());
}

TEST_CASE("a sphere so large that its box overflows is found from afar", "[bvh]") {
    Balls balls = items_list::cloud(40);
    balls.add({math::vec3(3e38F, 0.0F, 0.0F), 3e38F});
    auto const tree = bvh::build_tree(balls.list());
    auto const hits = found(tree, bvh::SphereRegion{{math::vec3(1e37F, 0.0F, 0.0F), 1.0F}});
    CHECK(hits == std::vector<std::uint32_t>{40});
}
