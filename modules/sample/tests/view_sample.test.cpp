#include <gnomon/check/check.hpp>

#include <gnomon/sample/view_sample.hpp>

#include "../../predicates/tests/exact_oracle.hpp"
#include "../../predicates/tests/hard_floats.hpp"

#include <cmath>
#include <limits>

using namespace gnomon;
using hard::Random;
using predicates::Sign;
using predicates::Target;
using sample::faces_away;
using sample::make_view_sample;
using sample::SampleRay;
using sample::Triangle;

namespace {

oracle::Point to_point(math::vec3 const& p) { return {p.x, p.y, p.z}; }

int exact_side(Triangle const& t, Target const& p) {
    return oracle::orient3d(to_point(t[0]), to_point(t[1]), to_point(t[2]), to_point(p.xyz), p.at_infinity);
}

/// Distance of `p` from the plane of `t`, in double.
double distance_m(Triangle const& t, math::vec3 const& p) {
    math::dvec3 const a = math::to_double(t[0]);
    math::dvec3 const n = glm::cross(math::to_double(t[1]) - a, math::to_double(t[2]) - a);
    return std::abs(glm::dot(n, math::to_double(p) - a)) / std::sqrt(glm::dot(n, n));
}

/// A camera somewhere, and a triangle before it that covers the ray through (px, py), far from work space's zero by `offset`.
struct Case {
    Triangle triangle;
    SampleRay ray;
    Target eye;
    math::dvec3 aimed;  ///< The inner point that the ray goes to.
};

Case make_case(Random& random, float offset, bool orthographic) {
    auto const unit = [&] { return random.uniform(-1.0F, 1.0F); };
    Case c;
    math::vec3 const center{offset + 10.0F * unit(), offset + 10.0F * unit(), offset + 10.0F * unit()};
    float const size = random.below(2) == 0 ? 1.0F : 0.01F;
    for (math::vec3& p : c.triangle) p = center + math::vec3{unit(), unit(), unit()} * size;
    if (random.below(4) == 0) c.triangle[2] = (c.triangle[0] + c.triangle[1]) * 0.5F + math::vec3{unit(), unit(), unit()} * 1e-4F;
    math::dvec3 const reach{static_cast<double>(unit()), static_cast<double>(unit()), static_cast<double>(unit())};
    math::dvec3 const eye = math::to_double(center) + reach * 30.0;
    c.aimed = math::to_double(c.triangle[0]) * 0.25 + math::to_double(c.triangle[1]) * 0.5 + math::to_double(c.triangle[2]) * 0.25;
    c.ray = {eye, (c.aimed - eye) / 3.0, !orthographic};
    c.eye = orthographic ? Target::direction(math::to_float(-c.ray.step)) : Target::point(math::to_float(eye));
    return c;
}

}  // namespace

TEST_CASE("a sample lies where the ray meets its triangle, on the eye's side or in the plane", "[sample][property]") {
    Random random{61};
    int behind = 0;
    int off = 0;
    int far_off = 0;
    int samples = 0;
    for (int i = 0; i < 40'000; ++i) {
        float const offset = i % 3 == 0 ? 0.0F : i % 3 == 1 ? 8192.0F : 131072.0F;
        Case const c = make_case(random, offset, i % 2 == 0);
        auto const s = make_view_sample(core::TriangleId(3), c.triangle, c.ray, c.eye);
        REQUIRE(s.triangle == core::TriangleId(3));
        int const eye_side = exact_side(c.triangle, c.eye);
        if (eye_side == 0) continue;
        ++samples;
        int const side = exact_side(c.triangle, Target::point(s.position));
        behind += side == -eye_side ? 1 : 0;
        off += side != 0 ? 1 : 0;
        // Rounding moves each axis by half a float's step, the last move a plane's width of such steps at most.
        double const step = static_cast<double>(math::next_up(offset + 11.0F) - (offset + 11.0F));
        far_off += distance_m(c.triangle, s.position) > 3.0 * step ? 1 : 0;
    }
    CHECK(samples > 35'000);
    CHECK(behind == 0);
    CHECK(off > 30'000);
    CHECK(far_off == 0);
}

TEST_CASE("before rounding a sample is within a hundredth of a float step of its ray, on slivers and grazing triangles too", "[sample][property]") {
    Random random{62};
    double worst = 0.0;
    for (int i = 0; i < 20'000; ++i) {
        Case const c = make_case(random, 0.0F, i % 2 == 0);
        math::dvec3 const point = sample::detail::nearest_point(c.triangle, c.ray);
        math::dvec3 const off = point - c.aimed;
        math::dvec3 const step = c.ray.step;
        // Along a grazing triangle the crossing is ill conditioned; across the ray it is not.
        math::dvec3 const across = off - step * (glm::dot(off, step) / glm::dot(step, step));
        worst = std::fmax(worst, std::sqrt(glm::dot(across, across)));
    }
    CHECK(worst < 1e-8);
}

TEST_CASE("the move is the least: one float less is behind", "[sample][property]") {
    Random random{63};
    int moved = 0;
    for (int i = 0; i < 40'000; ++i) {
        Case const c = make_case(random, i % 2 == 0 ? 0.0F : 8192.0F, false);
        Sign const eye_side = predicates::orient3d(c.triangle[0], c.triangle[1], c.triangle[2], c.eye);
        if (eye_side == Sign::zero) continue;
        math::vec3 const rounded = math::to_float(sample::detail::nearest_point(c.triangle, c.ray));
        math::vec3 const placed = sample::detail::moved_to_side(c.triangle, rounded, eye_side);
        if (placed == rounded) continue;
        ++moved;
        int changed = 0;
        for (int axis = 0; axis < 3; ++axis) {
            if (placed[axis] == rounded[axis]) continue;
            ++changed;
            math::vec3 before = placed;
            before[axis] = rounded[axis] < placed[axis] ? math::next_down(placed[axis]) : math::next_up(placed[axis]);
            REQUIRE(exact_side(c.triangle, Target::point(before)) == -static_cast<int>(eye_side));
        }
        REQUIRE(changed == 1);
    }
    CHECK(moved > 10'000);
}

TEST_CASE("a plane that passes near zero in one axis and far in another is still reached", "[sample]") {
    // y is tiny, so its floats are dense: bringing the sample before the plane takes billions of them.
    Triangle const t{math::vec3(1000.0F, 0.0F, 1000.0F), math::vec3(1000.0F, 0.0F, 2000.0F), math::vec3(2000.0F, 100.0F, 1000.0F)};
    math::vec3 const rounded(1000.00006F, 1e-9F, 1500.0F);
    math::vec3 const placed = sample::detail::moved_to_side(t, rounded, predicates::orient3d(t[0], t[1], t[2], math::vec3(1500.0F, 900.0F, 1500.0F)));
    CHECK(placed.x == rounded.x);
    CHECK(placed.y > 1e-6F);
    CHECK(placed.y < 1e-5F);
}

TEST_CASE("a ray that misses its triangle by a little gives the nearest border point, also on a grazing triangle", "[sample]") {
    Triangle const ground{math::vec3(-1.0F, 0.0F, -100.0F), math::vec3(1.0F, 0.0F, -100.0F), math::vec3(0.0F, 0.0F, -1.0F)};
    // The eye is a nanometre above the plane; the ray points a little above the horizon: the plane is never met before it.
    SampleRay const above{math::dvec3(0.0, 1e-9, 5.0), math::dvec3(0.0, 1e-6, -1.0)};
    auto const eye = Target::point(math::vec3(0.0F, 1e-9F, 5.0F));
    auto const s = make_view_sample(core::TriangleId(0), ground, above, eye);
    CHECK(s.position.z >= -100.0F);
    CHECK(s.position.z <= -1.0F);
    CHECK(std::abs(s.position.x) <= 1.0F);
    CHECK(std::abs(s.position.y) <= 1e-9F);
    // Misses the left side by 1 mm.
    Triangle const wall{math::vec3(0.0F, 0.0F, -5.0F), math::vec3(2.0F, 0.0F, -5.0F), math::vec3(0.0F, 2.0F, -5.0F)};
    auto const beside = make_view_sample(core::TriangleId(0), wall, {math::dvec3(0.0), math::dvec3(-0.0002, 0.2, -1.0)},
                                         Target::point(math::vec3(0.0F)));
    CHECK(beside.position.x == 0.0F);
    CHECK(beside.position.y == Approx(1.0).epsilon(1e-4));
    CHECK(beside.position.z == -5.0F);
}

TEST_CASE("parts of a triangle behind the eye are not sampled", "[sample]") {
    Triangle const through{math::vec3(-1.0F, -1.0F, 50.0F), math::vec3(1.0F, -1.0F, 50.0F), math::vec3(0.0F, -1.0F, -50.0F)};
    // Beside the triangle: the nearest border point must be before the eye.
    auto const s = make_view_sample(core::TriangleId(0), through, {math::dvec3(0.0), math::dvec3(0.6, -0.3, -1.0)},
                                    Target::point(math::vec3(0.0F)));
    CHECK(s.position.z <= 0.0F);
    CHECK(s.position.x > 0.0F);
    // The ray's line, prolonged backwards, meets the edge behind the eye: that edge must not count.
    auto const upwards = make_view_sample(core::TriangleId(0), through, {math::dvec3(0.0), math::dvec3(0.0, 0.02, -1.0)},
                                          Target::point(math::vec3(0.0F)));
    CHECK(upwards.position.z <= 0.0F);
}

TEST_CASE("degenerate triangles and views give finite samples", "[sample][degenerate]") {
    float const huge = std::numeric_limits<float>::max();
    float const tiny = std::numeric_limits<float>::denorm_min();
    Triangle const cases[] = {
        {math::vec3(1.0F), math::vec3(1.0F), math::vec3(1.0F)},                                            // a point
        {math::vec3(0.0F, 0.0F, -1.0F), math::vec3(0.0F, 0.0F, -2.0F), math::vec3(0.0F, 0.0F, -3.0F)},     // along the ray
        {math::vec3(-1.0F, 0.0F, -1.0F), math::vec3(1.0F, 0.0F, -1.0F), math::vec3(0.0F, 0.0F, -9.0F)},    // edge-on
        {math::vec3(-huge, -huge, -huge), math::vec3(huge, -huge, -huge), math::vec3(0.0F, huge, -huge)},  // the largest
        {math::vec3(0.0F), math::vec3(tiny, 0.0F, 0.0F), math::vec3(0.0F, tiny, 0.0F)},                    // the smallest
        {math::vec3(-1.0F, 0.0F, 5.0F), math::vec3(1.0F, 0.0F, 5.0F), math::vec3(0.0F, 1.0F, 5.0F)},       // behind the eye
    };
    double const nan = std::numeric_limits<double>::quiet_NaN();
    for (Triangle const& t : cases)
        for (SampleRay const& ray : {SampleRay{math::dvec3(0.0), math::dvec3(0.0, 0.0, -1.0), true},
                                     SampleRay{math::dvec3(0.0), math::dvec3(0.0, 0.0, -1.0), false},
                                     SampleRay{math::dvec3(nan), math::dvec3(0.0), true},
                                     SampleRay{math::dvec3(1e300), math::dvec3(1e300), true}})
            for (Target const& eye : {Target::point(math::vec3(0.0F)), Target::direction(math::vec3(0.0F, 0.0F, 1.0F)),
                                      Target::point(math::vec3(std::numeric_limits<float>::quiet_NaN()))}) {
                auto const s = make_view_sample(core::TriangleId(1), t, ray, eye);
                CHECK(math::is_finite(s.position));
                CHECK(s.triangle == core::TriangleId(1));
            }
    Triangle broken = cases[2];
    broken[1].y = std::numeric_limits<float>::infinity();
    CHECK(make_view_sample(core::TriangleId(1), broken, {}, {}).triangle.is_none());
}

TEST_CASE("faces_away is strict: a light in the plane does not shadow it", "[sample]") {
    Triangle const t{math::vec3(0.0F), math::vec3(1.0F, 0.0F, 0.0F), math::vec3(0.0F, 0.0F, 1.0F)};
    auto const above = Target::point(math::vec3(0.0F, 1e-45F, 0.0F));
    CHECK(faces_away(t, above, Target::direction(math::vec3(0.0F, -1e-45F, 1.0F))));
    CHECK_FALSE(faces_away(t, above, Target::direction(math::vec3(1.0F, -0.0F, 1.0F))));
    CHECK_FALSE(faces_away(t, above, above));
    CHECK(faces_away(t, Target::direction(math::vec3(0.0F, -1.0F, 0.0F)), above));
}
