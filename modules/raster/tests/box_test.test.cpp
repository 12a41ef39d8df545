#include <gnomon/check/check.hpp>
#include <gnomon/core/executor_threads.hpp>
#include <gnomon/raster.hpp>

#include "oracle.hpp"
#include "query_scene.hpp"

#include <chrono>
#include <cstdio>
#include <limits>
#include <vector>

namespace {

using namespace gnomon;
using namespace gnomon::raster;
using oracle::Random;

/// One way of looking at the street, drawn, with its pyramid.
struct BoxView {
    std::vector<float> depth;
    std::vector<std::uint16_t> codes;
    DepthPyramid pyramid;
    Layer layer{.target = ImageView<float>{}};
    math::View view;

    BoxView(query::Street const& street, math::View const& seen, bool unorm16, DepthRange range) : view(seen) {
        std::size_t const size = static_cast<std::size_t>(view.size_px.x) * static_cast<std::size_t>(view.size_px.y);
        depth.resize(unorm16 ? 0 : size);
        codes.resize(unorm16 ? size : 0);
        layer.target = unorm16 ? DepthTarget(make_image(codes.data(), view.size_px.x, view.size_px.y))
                               : DepthTarget(make_image(depth.data(), view.size_px.x, view.size_px.y));
        layer.config.depth = view.depth;
        layer.config.range = range;
        layer.config.pyramid = &pyramid;
        layer.origin = math::to_float(view.eye_m);
        layer.clip_from_relative = math::clip_from_relative(view);
        Draw const draw = street.draw(view);
        Workspace workspace;
        core::SerialExecutor serial;
        layered_pass({&draw, 1}, {&layer, 1}, workspace, serial);
    }
};

math::View sun_view(math::Depth depth, math::ivec2 size_px) {
    return math::make_orthographic({.eye_m = {40, 200, 60},
                                    .target_m = {0, 0, 0},
                                    .window_m = {-230, 230, -230, 230},
                                    .near_m = 0.0,
                                    .far_m = 600.0,
                                    .size_px = size_px,
                                    .depth = depth})
        .value();
}

math::View air_view(math::Depth depth, math::ivec2 size_px, double far_m) {
    return math::make_perspective({.eye_m = {30, 60, 230},
                                   .target_m = {0, 10, 0},
                                   .near_m = 1.0,
                                   .far_m = far_m,
                                   .size_px = size_px,
                                   .depth = depth})
        .value();
}

/// The views of round `i`: street, air and sun, both depth conventions, odd sizes, 16-bit targets, clamped depths.
BoxView make_box_view(query::Street const& street, int i, std::int32_t size) {
    math::Depth const depth = i % 2 == 0 ? math::Depth::reversed : math::Depth::forward;
    math::ivec2 const px(size + 13 * (i % 3), size - 7 * (i % 4));
    double const infinite = std::numeric_limits<double>::infinity();
    bool const unorm16 = i % 7 == 6;
    DepthRange const range = i % 5 == 4 ? DepthRange::clamp : DepthRange::clip;
    math::View const view = i % 3 == 0   ? query::Street::view(depth, px)
                            : i % 3 == 1 ? air_view(depth, px, i % 4 < 2 ? infinite : 500.0)
                                         : sun_view(depth, px);
    return BoxView(street, view, unorm16, range);
}

/// Boxes that stress the test: props, walls, slivers, flat ones, some below a pixel, some that touch a building.
math::Aabb make_query_box(Random& random, query::Street const& street) {
    auto const in = [&](float low, float high) { return low + random.unit() * (high - low); };
    math::vec3 const at{in(-210.0F, 210.0F), in(-2.0F, 25.0F), in(-210.0F, 215.0F)};
    float const size = random.in(0, 9) == 0 ? 40.0F : random.in(0, 2) == 0 ? 8.0F : 1.0F;
    math::vec3 d{in(0.0F, size), in(0.0F, size), in(0.0F, size)};
    switch (random.in(0, 9)) {
        case 0: d[random.in(0, 2)] *= 0x1p-12F; break;  // A sliver.
        case 1: d[random.in(0, 2)] = 0.0F; break;       // Flat.
        case 2: d = d * 0.01F; break;                   // Below a pixel.
        case 3: {                                       // Against a building's wall, or on its roof, or the building.
            auto const last = static_cast<std::int32_t>(street.boxes.size()) - 1;
            math::Aabb const& wall = street.boxes[static_cast<std::size_t>(random.in(1, last))];
            if (random.in(0, 3) == 0) return wall;
            math::Aabb box{wall.lo, glm::min(wall.hi, wall.lo + d)};
            math::axis_t const axis = random.in(0, 2);
            box.lo[axis] = random.in(0, 1) == 0 ? wall.hi[axis] : wall.lo[axis];
            box.hi[axis] = box.lo[axis] + d[axis] * static_cast<float>(random.in(0, 1));
            return box;
        }
        default: break;
    }
    return {at, at + d};
}

struct BoxCounts {
    std::uint64_t boxes = 0, outside = 0, hidden = 0, visible = 0;
    std::uint64_t truly_hidden = 0;  // In the view, no sample passes.
    std::uint64_t found = 0;         // Of those.
    std::uint64_t false_hidden = 0;
    std::uint64_t unequal = 0;  // Verdicts of the two kernels.
};

void count_verdicts(BoxView& view, std::vector<math::Aabb> const& boxes, BoxCounts& counts, QueryWorkspace& workspace) {
    core::SerialExecutor serial;
    std::vector<BoxVerdict> verdict(boxes.size(), BoxVerdict::outside);
    std::vector<BoxVerdict> scalar(boxes.size(), BoxVerdict::visible);
    std::vector<std::uint8_t> any(boxes.size());
    test_boxes(boxes, view.layer, view.pyramid, verdict, serial);
    view.layer.config.kernel = Kernel::scalar;
    std::size_t const checked = std::min<std::size_t>(boxes.size(), 4000);
    test_boxes({boxes.data(), checked}, view.layer, view.pyramid, {scalar.data(), checked}, serial);
    view.layer.config.kernel = Kernel::automatic;
    any_sample_passing(boxes, view.layer, any, workspace, serial);
    for (std::size_t i = 0; i < boxes.size(); ++i) {
        BoxVerdict const v = verdict[i];
        ++counts.boxes;
        counts.outside += v == BoxVerdict::outside ? 1U : 0U;
        counts.hidden += v == BoxVerdict::hidden ? 1U : 0U;
        counts.visible += v == BoxVerdict::visible ? 1U : 0U;
        counts.unequal += i < checked && v != scalar[i] ? 1U : 0U;
        if (any[i] != 0) {
            counts.false_hidden += v != BoxVerdict::visible ? 1U : 0U;
        } else if (v != BoxVerdict::outside) {
            ++counts.truly_hidden;
            counts.found += v == BoxVerdict::hidden ? 1U : 0U;
        }
    }
}

/// expects: `per_view` boxes in each of `views` views.
BoxCounts compare_with_truth(int views, std::size_t per_view, std::int32_t size) {
    BoxCounts counts;
    QueryWorkspace workspace;
    Random random{81};
    for (int i = 0; i < views; ++i) {
        query::Street const street(82 + static_cast<std::uint64_t>(i % 4), 120 + 40 * (i % 3));
        BoxView view = make_box_view(street, i, size);
        std::vector<math::Aabb> boxes(per_view);
        for (math::Aabb& box : boxes) box = make_query_box(random, street);
        BoxCounts const before = counts;
        count_verdicts(view, boxes, counts, workspace);
        CAPTURE(i);
        CHECK(counts.false_hidden == before.false_hidden);
        CHECK(counts.unequal == before.unequal);
        // No view is left to the others.
        CHECK(static_cast<double>(counts.found - before.found) >=
              0.85 * static_cast<double>(counts.truly_hidden - before.truly_hidden));
    }
    return counts;
}

void print(BoxCounts const& c, double seconds) {
    std::printf("%llu boxes: %llu outside, %llu hidden, %llu visible; %llu truly hidden, %llu of them found; %llu "
                "falsely hidden; %.1f s\n",
                static_cast<unsigned long long>(c.boxes), static_cast<unsigned long long>(c.outside),
                static_cast<unsigned long long>(c.hidden), static_cast<unsigned long long>(c.visible),
                static_cast<unsigned long long>(c.truly_hidden), static_cast<unsigned long long>(c.found),
                static_cast<unsigned long long>(c.false_hidden), seconds);
}

}  // namespace

TEST_CASE("no box that passes at a sample is called hidden, and nine of ten hidden ones are found", "[raster][boxes]") {
    BoxCounts const counts = compare_with_truth(24, 3000, 200);
    CHECK(counts.truly_hidden > counts.boxes / 5);
    CHECK(counts.visible > counts.boxes / 20);
    CHECK(counts.found * 100 >= counts.truly_hidden * 90);
    if (counts.found * 100 < counts.truly_hidden * 90) print(counts, 0.0);
}

TEST_CASE("boxes across many blocks of a large image are tested as well as small ones", "[raster][boxes]") {
    BoxCounts const counts = compare_with_truth(4, 1500, 1300);
    CHECK(counts.found * 100 >= counts.truly_hidden * 90);
}

TEST_CASE("verdicts do not depend on threads, and without an image they are of blocks", "[raster][boxes][determinism]") {
    query::Street const street(91, 150);
    BoxView view = make_box_view(street, 0, 230);
    Random random{92};
    std::vector<math::Aabb> boxes(5000);
    for (math::Aabb& box : boxes) box = make_query_box(random, street);
    core::SerialExecutor serial;
    core::ThreadExecutor pool(3);
    std::vector<BoxVerdict> one(boxes.size());
    std::vector<BoxVerdict> many(boxes.size());
    std::vector<BoxVerdict> coarse(boxes.size());
    test_boxes(boxes, view.layer, view.pyramid, one, serial);
    test_boxes(boxes, view.layer, view.pyramid, many, pool);
    CHECK(one == many);
    Layer without = view.layer;
    without.target = ImageView<float>{nullptr, view.view.size_px.x, view.view.size_px.y, 0};
    test_boxes(boxes, without, view.pyramid, coarse, serial);
    int more = 0;
    int wrong = 0;
    for (std::size_t i = 0; i < boxes.size(); ++i) {
        more += coarse[i] == BoxVerdict::visible && one[i] != BoxVerdict::visible ? 1 : 0;
        wrong += coarse[i] != BoxVerdict::visible && one[i] == BoxVerdict::visible ? 1 : 0;
        if (i < 50) CHECK(test_box(boxes[i], view.layer, view.pyramid) == one[i]);
    }
    CHECK(wrong == 0);
    CHECK(more > 0);
}

TEST_CASE("boxes in parts of the image, in viewports that stick out, and in tiny images keep to the rule",
          "[raster][boxes]") {
    query::Street const street(93, 150);
    Random random{94};
    QueryWorkspace workspace;
    BoxCounts counts;
    for (int round = 0; round < 12; ++round) {
        BoxView view = make_box_view(street, round, round % 4 == 3 ? 22 : 180);
        view.layer.config.pyramid = nullptr;
        if (round % 4 == 0) view.layer.config.scissor = Rect{21, 13, 90, 100};
        if (round % 4 == 1) view.layer.config.viewport = Rect{-50, -333, 700, 640};
        if (round % 4 == 2) view.layer.config.viewport = Rect{30, 20, 64, 300};
        Draw const draw = street.draw(view.view);
        Workspace passes;
        core::SerialExecutor serial;
        layered_pass({&draw, 1}, {&view.layer, 1}, passes, serial);
        build_pyramid(view.layer.target, view.view.depth, view.pyramid, serial);
        std::vector<math::Aabb> boxes(2000);
        for (math::Aabb& box : boxes) box = make_query_box(random, street);
        count_verdicts(view, boxes, counts, workspace);
        CAPTURE(round);
        CHECK(counts.false_hidden == 0);
        CHECK(counts.unequal == 0);
    }
    CHECK(counts.found * 100 >= counts.truly_hidden * 90);
    CHECK(counts.visible > 500);
}

TEST_CASE("boxes that hold nothing are outside, and those that cannot be projected are visible", "[raster][boxes]") {
    query::Street const street(95, 100);
    BoxView view = make_box_view(street, 0, 64);
    float const nan = std::numeric_limits<float>::quiet_NaN();
    float const inf = std::numeric_limits<float>::infinity();
    math::vec3 const eye = view.layer.origin;
    std::vector<math::Aabb> const boxes{
        {},
        {math::vec3(nan), math::vec3(1)},
        {math::vec3(0, nan, 0), math::vec3(1)},
        {math::vec3(1), math::vec3(-1)},
        {eye + math::vec3(-1, -1, 5), eye + math::vec3(1, 1, 6)},        // Behind.
        {eye + math::vec3(500, 0, -100), eye + math::vec3(501, 1, -99)},  // Beside.
        {math::vec3(-inf), math::vec3(inf)},
        {eye - math::vec3(1), eye + math::vec3(1)},                       // Around the eye.
        {math::vec3(-3e38F), math::vec3(3e38F)},
        {eye + math::vec3(-1e5F, -1, -3), eye + math::vec3(1e5F, 1, -2)},  // Through the guard band.
        {eye + math::vec3(-1, -1, -5e4F), eye + math::vec3(1, 1, -4e4F)},  // Beyond the far plane.
    };
    for (Kernel const kernel : {Kernel::scalar, Kernel::simd}) {
        view.layer.config.kernel = kernel;
        for (std::size_t i = 0; i < boxes.size(); ++i) {
            BoxVerdict const verdict = test_box(boxes[i], view.layer, view.pyramid);
            CAPTURE(i);
            CHECK(verdict == (i < 6 || i == 10 ? BoxVerdict::outside : BoxVerdict::visible));
        }
        Layer nothing = view.layer;
        nothing.config.scissor = Rect{5, 5, 0, 3};
        CHECK(test_box(boxes[7], nothing, view.pyramid) == BoxVerdict::outside);
    }
}

TEST_CASE("no box of ten million that passes at a sample is called hidden", "[.full][raster][boxes]") {
    auto const start = std::chrono::steady_clock::now();
    BoxCounts const counts = compare_with_truth(200, 50'000, 256);
    print(counts, std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
    CHECK(counts.boxes == 10'000'000);
    CHECK(counts.false_hidden == 0);
    CHECK(counts.found * 100 >= counts.truly_hidden * 90);
}
