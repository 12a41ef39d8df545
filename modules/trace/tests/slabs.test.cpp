#include <gnomon/check/check.hpp>

#include <gnomon/trace/detail/slabs.hpp>

#include "scenes.hpp"

#include <cmath>
#include <limits>

using namespace gnomon;
using scenes::Light;
using scenes::Random;
using scenes::Segment;

namespace {

/// A node whose slot `slot` is the box; the others are empty.
trace::Node node_of(math::vec3 const& lo, math::vec3 const& hi, std::size_t slot) {
    trace::Node node{};
    for (int axis = 0; axis < 3; ++axis)
        for (std::size_t i = 0; i < trace::width; ++i) {
            node.lo[axis][i] = i == slot ? lo[axis] : std::numeric_limits<float>::infinity();
            node.hi[axis][i] = i == slot ? hi[axis] : -std::numeric_limits<float>::infinity();
        }
    return node;
}

bool touches(Segment const& s, math::vec3 const& lo, math::vec3 const& hi, std::size_t slot = 0) {
    double near[trace::width];
    std::uint32_t const touched = may_touch(trace::detail::make_slabs(s), node_of(lo, hi, slot), near);
    CHECK((touched & ~(1U << slot)) == 0);
    return touched != 0;
}

}  // namespace

TEST_CASE("a box that the segment meets in one corner, edge or face point is never rejected", "[trace][property]") {
    // Integers of few bits, so that the segment passes the point exactly, at every scale a float has.
    Random random{41};
    int rejected = 0;
    for (int i = 0; i < 200'000; ++i) {
        int const exponent = random.below(3) == 0 ? -149 : random.below(250) - 149;
        auto const number = [&](int range) { return std::ldexp(static_cast<float>(random.below(2 * range + 1) - range), exponent); };
        math::vec3 lo;
        math::vec3 hi;
        math::vec3 point;
        math::vec3 d;
        for (int axis = 0; axis < 3; ++axis) {
            lo[axis] = number(1000);
            hi[axis] = lo[axis] + std::abs(number(50));
            int const place = random.below(3);
            point[axis] = place == 0 ? lo[axis] : hi[axis];
            d[axis] = random.below(3) == 0 ? (random.below(2) == 0 ? 0.0F : -0.0F) : number(300);
        }
        float const back = static_cast<float>(random.below(4));
        Segment const lamp{point + d * back, Light::point(point - d)};
        if (is_valid(lamp)) rejected += touches(lamp, lo, hi, static_cast<std::size_t>(i) % 4) ? 0 : 1;
        Segment const sun{point + d * back, Light::direction(-d)};
        if (is_valid(sun)) rejected += touches(sun, lo, hi, static_cast<std::size_t>(i) % 4) ? 0 : 1;
    }
    CHECK(rejected == 0);
}

TEST_CASE("generic points of boxes are reached with any pair of end points", "[trace][property]") {
    // The point is rounded, so the box is grown round it by what the rounding can be: four ulps.
    Random random{42};
    int rejected = 0;
    for (int i = 0; i < 100'000; ++i) {
        auto const any = [&] { return random.uniform(-1.0F, 1.0F) * std::ldexp(1.0F, random.below(20)); };
        math::vec3 const a{any(), any(), any()};
        math::vec3 const b{any(), any(), any()};
        double const t = static_cast<double>(random.uniform(0.0F, 1.0F));
        math::vec3 lo;
        math::vec3 hi;
        for (int axis = 0; axis < 3; ++axis) {
            double const x = static_cast<double>(a[axis]) * (1.0 - t) + static_cast<double>(b[axis]) * t;
            auto const near = static_cast<float>(x);
            lo[axis] = near;
            hi[axis] = near;
            for (int k = 0; k < 2; ++k) {
                lo[axis] = math::next_down(lo[axis]);
                hi[axis] = math::next_up(hi[axis]);
            }
        }
        rejected += touches({a, Light::point(b)}, lo, hi) ? 0 : 1;
    }
    CHECK(rejected == 0);
}

TEST_CASE("the test is not merely cautious: boxes one ulp beside an axis-parallel segment are rejected", "[trace]") {
    for (float const x : {0.0F, 1.0F, -131072.0F, 1e-45F, 3e38F})
        for (int axis = 0; axis < 3; ++axis)
            for (bool const sun : {false, true}) {
                math::vec3 start(0.0F);
                start[axis] = x;
                int const along = (axis + 1) % 3;
                math::vec3 end = sun ? math::vec3(0.0F) : start;
                end[along] = -7.0F;
                Segment const s{start, {end, sun}};
                math::vec3 lo(-1.0F);
                math::vec3 hi(1.0F);
                lo[axis] = -std::numeric_limits<float>::max();
                hi[axis] = std::numeric_limits<float>::max();
                lo[axis] = x;
                CHECK(touches(s, lo, hi));
                lo[axis] = math::next_up(x);
                CHECK_FALSE(touches(s, lo, hi));
                lo[axis] = -std::numeric_limits<float>::max();
                hi[axis] = x;
                CHECK(touches(s, lo, hi));
                hi[axis] = math::next_down(x);
                CHECK_FALSE(touches(s, lo, hi));
                hi[axis] = x;
                lo[along] = 0.5F;  // behind the start
                CHECK_FALSE(touches(s, lo, hi));
                lo[along] = -9.0F;  // beyond the lamp, but on a sun's ray
                hi[along] = -8.0F;
                CHECK(touches(s, lo, hi) == sun);
            }
}
