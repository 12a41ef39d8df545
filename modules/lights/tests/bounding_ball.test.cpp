#include <gnomon/check/check.hpp>
#include <gnomon/lights/bounding_ball.hpp>
#include <gnomon/math/generators.hpp>

#include <cmath>
#include <limits>
#include <string>

using namespace gnomon;
using namespace gnomon::check;

namespace {

struct SectorPoint {
    lights::Light light;
    math::dvec3 point;
    double half_angle = 0.0;
};

std::string check_string(SectorPoint const& s) {
    return "half angle " + std::to_string(s.half_angle) + ", range " + std::to_string(s.light.range_m);
}

/// A spot and a point that it reaches: at its apex, on its rim, on its cap, or anywhere within.
auto sector_points() {
    return [](Choices& choices) {
        double const half = static_cast<double>(floats(0.0F, 3.14F)(choices));
        float const range = floats(1e-3F, 1e3F)(choices);
        math::vec3 const center = math::points()(choices);
        double const z = floats(-1.0, 1.0)(choices);
        double const turn = floats(0.0, 6.28)(choices);
        double const ring = std::sqrt(1.0 - z * z);
        math::dvec3 const axis(ring * std::cos(turn), ring * std::sin(turn), z);
        math::dvec3 const seed = std::abs(z) < 0.9 ? math::dvec3(0.0, 0.0, 1.0) : math::dvec3(1.0, 0.0, 0.0);
        math::dvec3 const u = glm::normalize(glm::cross(axis, seed));
        math::dvec3 const v = glm::cross(axis, u);
        double const out = choices.draw(2) == 0 ? half : half * floats(0.0, 1.0)(choices);
        double const far = choices.draw(2) == 0 ? 1.0 : floats(0.0, 1.0)(choices);
        double const around = floats(0.0, 6.28)(choices);
        math::dvec3 const way = axis * std::cos(out) + (u * std::cos(around) + v * std::sin(around)) * std::sin(out);
        return SectorPoint{lights::make_spot(center, range, math::to_float(axis), static_cast<float>(half)),
                           math::to_double(center) + way * (far * static_cast<double>(range)), half};
    };
}

}  // namespace

TEST_CASE("a light's ball holds every point of it, and is not larger than that of its range", "[lights][property]") {
    for_all(cases(20000), sector_points(), [](SectorPoint const& s) {
        math::Sphere const ball = lights::bounding_ball(s.light);
        double const off = glm::length(s.point - math::to_double(ball.center));
        double const size = std::abs(s.point.x) + std::abs(s.point.y) + std::abs(s.point.z) + static_cast<double>(s.light.range_m);
        CHECK(off <= static_cast<double>(ball.radius) + 1e-14 * size);  // the point itself is rounded
        double const r = static_cast<double>(s.light.range_m);
        double const least = s.half_angle >= 1.5707963 ? r : s.half_angle > 0.7854 ? r * std::sin(s.half_angle) : r / (2.0 * std::cos(s.half_angle));
        CHECK(static_cast<double>(ball.radius) <= least * 1.00001 + 4e-6 * size);
    });
}

TEST_CASE("a light that is none has no ball, a directional one an infinite one", "[lights]") {
    float const none = std::numeric_limits<float>::quiet_NaN();
    CHECK(lights::bounding_ball(lights::make_point(math::vec3(none, 0.0F, 0.0F), 1.0F)).radius < 0.0F);
    CHECK(lights::bounding_ball(lights::make_point(math::vec3(0.0F), none)).radius < 0.0F);
    CHECK(lights::bounding_ball(lights::make_point(math::vec3(0.0F), 0.0F)).radius < 0.0F);
    CHECK(lights::bounding_ball(lights::make_directional()).radius > 1e38F);
    CHECK(lights::bounding_ball(lights::make_point(math::vec3(1.0F, 2.0F, 3.0F), 4.0F)).radius >= 4.0F);
}
