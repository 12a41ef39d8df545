#include <gnomon/check/check.hpp>
#include <gnomon/cull/normal_cone.hpp>
#include <gnomon/math/generators.hpp>

#include <cmath>
#include <cstdint>
#include <limits>
#include <string>

using namespace gnomon;
using namespace gnomon::check;

namespace {

struct Lit {
    cull::NormalCone cone;
    math::Sphere samples;
    math::vec3 light;
};

std::string check_string(Lit const& l) {
    return "axis " + math::check_string(l.cone.axis) + " cosine " + std::to_string(l.cone.cos_half_angle) + " samples " +
           math::check_string(l.samples.center) + " radius " + std::to_string(l.samples.radius) + " light " + math::check_string(l.light);
}

math::dvec3 turned(math::dvec3 const& from, math::dvec3 const& some, double angle) {
    math::dvec3 across = glm::cross(from, some);
    across = glm::length(across) > 1e-9 ? glm::normalize(across) : glm::normalize(glm::cross(from, math::dvec3(0.3, 0.4, -0.5)));
    return from * std::cos(angle) + across * std::sin(angle);
}

/// A light whose side of the border of rejection is off by at most 1e-6 of a right angle, or anywhere.
auto lit() {
    return [](Choices& choices) {
        Lit l;
        math::dvec3 const axis = math::directions()(choices);
        math::dvec3 const some = math::directions()(choices);
        double const alpha = floats(0.0, 1.5)(choices);
        l.cone = {math::to_float(axis), math::next_down(static_cast<float>(std::cos(alpha)))};
        l.samples = {math::points()(choices), floats(0.0F, 10.0F)(choices)};
        double const delta = floats(0.0, 1.57)(choices);
        double const off = choices.draw(1) == 0 ? floats(-1e-6, 1e-6)(choices) : floats(-1.0, 1.0)(choices);
        double const distance = static_cast<double>(l.samples.radius) / std::sin(delta + 1e-9);
        double const omega = 1.5707963267948966 + alpha + delta + off;
        l.light = math::to_float(math::to_double(l.samples.center) + turned(axis, some, omega) * distance);
        return l;
    };
}

}  // namespace

TEST_CASE("a light that some normal of the cone sees from some point of the ball is never rejected", "[cull][property]") {
    std::uint64_t rejected = 0;
    std::uint64_t faced = 0;
    for_all(cases(20000), lit(), [&](Lit const& l) {
        // The normal and the point that look at the light best: in the plane of the axis and the light.
        math::dvec3 const axis = glm::normalize(math::to_double(l.cone.axis));
        math::dvec3 const v = math::to_double(l.light) - math::to_double(l.samples.center);
        double const distance = glm::length(v);
        double const radius = static_cast<double>(l.samples.radius);
        double const alpha = std::acos(static_cast<double>(l.cone.cos_half_angle));
        double const omega = distance > 0.0 ? std::atan2(glm::length(glm::cross(v, axis)), glm::dot(v, axis)) : 0.0;
        double const delta = distance > radius ? std::asin(radius / distance) : 4.0;
        bool const sees = omega - alpha - delta < 1.5707963267948966;
        bool const may = cull::may_face(l.cone, l.samples, l.light);
        if (sees) CHECK(may);
        if (omega - alpha - delta > 1.5707963267948966 + 1e-3 && alpha + delta < 1.5 && distance > 1e-3) {
            double const ulps = (std::abs(static_cast<double>(l.light.x)) + std::abs(static_cast<double>(l.light.y)) +
                                 std::abs(static_cast<double>(l.light.z))) * 1e-7;
            if (ulps < 1e-5 * distance) CHECK_FALSE(may);
        }
        rejected += may ? 0U : 1U;
        faced += sees ? 1U : 0U;
    });
    CHECK(rejected > 1000);
    CHECK(faced > 2000);
}

TEST_CASE("directional lights, wide cones, balls around the light and NaN", "[cull]") {
    cull::NormalCone const up{math::vec3(0.0F, 0.0F, 1.0F), 0.5F};  // 60 degrees
    CHECK(cull::may_face(up, math::vec3(0.0F, 0.0F, 1.0F)));
    CHECK(cull::may_face(up, math::vec3(1.0F, 0.0F, 0.0F)));
    CHECK(cull::may_face(up, math::vec3(0.5F, 0.0F, -0.866025F)));
    CHECK_FALSE(cull::may_face(up, math::vec3(0.49F, 0.0F, -0.8717F)));
    CHECK(cull::may_face({math::vec3(0.0F, 0.0F, 1.0F), 0.0F}, math::vec3(0.0F, 0.0F, -1.0F)));
    CHECK(cull::may_face({}, math::vec3(0.0F, 0.0F, -1.0F)));
    CHECK(cull::may_face({math::vec3(0.0F, 0.0F, 1.0F), 1.0F}, {math::vec3(0.0F), 2.0F}, math::vec3(0.0F, 0.0F, -1.5F)));
    CHECK_FALSE(cull::may_face({math::vec3(0.0F, 0.0F, 1.0F), 1.0F}, {math::vec3(0.0F), 2.0F}, math::vec3(0.0F, 0.0F, -2.5F)));
    float const nan = std::numeric_limits<float>::quiet_NaN();
    CHECK(cull::may_face({math::vec3(0.0F, nan, 1.0F), 1.0F}, {math::vec3(0.0F), 2.0F}, math::vec3(0.0F, 0.0F, -9.0F)));
    CHECK(cull::may_face({math::vec3(0.0F, 0.0F, 1.0F), nan}, {math::vec3(0.0F), 2.0F}, math::vec3(0.0F, 0.0F, -9.0F)));
    CHECK(cull::may_face(up, {math::vec3(0.0F), nan}, math::vec3(0.0F, 0.0F, -9.0F)));
    CHECK(cull::may_face(up, {math::vec3(0.0F), 1.0F}, math::vec3(0.0F, nan, -9.0F)));
}

TEST_CASE("the ball of a box holds its corners", "[cull][property]") {
    for_all(cases(5000), math::boxes(), [](math::Aabb const& box) {
        math::Sphere const ball = cull::ball_of(box);
        for (unsigned i = 0; i < 8; ++i) {
            math::dvec3 const d = math::to_double(math::corner(box, i)) - math::to_double(ball.center);
            CHECK(glm::dot(d, d) <= static_cast<double>(ball.radius) * static_cast<double>(ball.radius));
        }
    });
}
