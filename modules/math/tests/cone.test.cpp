#include <gnomon/check/check.hpp>
#include <gnomon/math/cone.hpp>
#include <gnomon/math/generators.hpp>
#include <gnomon/math/plane_set.hpp>

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>

using namespace gnomon::check;
using namespace gnomon::math;
namespace formula = gnomon::formula;

namespace {

struct ConeAndPoint {
    Cone cone;
    dvec3 point;
};

/// A point of the cone, to 1e-12 of its range inside its border: at the rim, on the side, at the apex, on the cap.
auto points_of_cones() {
    return [](Choices& choices) {
        ConeAndPoint c;
        c.cone.apex = points()(choices);
        c.cone.range = element_of({1.0F, 1e-3F, 40.0F, 1e6F})(choices);
        dvec3 const axis = directions()(choices);
        c.cone.axis = to_float(axis * element_of({1.0, 1e-3, 700.0})(choices));
        c.cone.half_angle_rad = element_of({0.0F, 1e-4F, 0.5F, 1.56F, 1.5707963F, 1.6F, 2.1F, 3.1415925F, 4.0F})(choices);
        dvec3 const unit = glm::normalize(to_double(c.cone.axis));
        dvec3 const some = directions()(choices);
        dvec3 across = glm::cross(unit, some);
        across = glm::length(across) > 1e-6 ? glm::normalize(across) : glm::normalize(glm::cross(unit, dvec3(0.1, -0.7, 0.6)));
        double const angle = std::fmin(static_cast<double>(c.cone.half_angle_rad), 3.14159265358979) * (choices.draw(1) == 0 ? 1.0 : floats(0.0, 1.0)(choices));
        double const length = static_cast<double>(c.cone.range) * element_of({1.0, 0.5, 0.0})(choices) * (1.0 - 1e-12);
        c.point = to_double(c.cone.apex) + (unit * std::cos(angle) + across * std::sin(angle)) * length;
        return c;
    };
}

}  // namespace

TEST_CASE("the reach of a cone is no less than that of any of its points", "[cone][property]") {
    std::uint64_t tight = 0;
    for_all(cases(20000), points_of_cones(), directions(), [&](ConeAndPoint const& at, dvec3 const& n) {
        auto const sector = formula_sector(at.cone);
        vec3 const direction = to_float(n);
        auto const reach = gn_reach_of_sector(sector, formula::Vec3<float>(direction));
        double const exact = glm::dot(at.point, to_double(direction));
        double const range = static_cast<double>(at.cone.range);
        double const value = static_cast<double>(reach.value.v);
        double const error = 32.0 * 5.9604644775390625e-8 * static_cast<double>(reach.magnitude.v);
        CHECK(value + error >= exact - 1e-12 * (range + glm::length(at.point)));
        tight += value - error <= exact + 1e-3 * range ? 1U : 0U;
    });
    CHECK(tight > 200);  // of points tried, some are the farthest
}

TEST_CASE("cosine and sine agree with the C library's to 1e-15", "[cone]") {
    for (int i = 0; i <= 1000; ++i) {
        double const angle = 3.14159265358979323846 * i / 1000;
        gnomon::math::detail::CosSin const cs = gnomon::math::detail::cos_sin(angle);
        CHECK(std::abs(cs.cosine - std::cos(angle)) < 1e-15);
        CHECK(std::abs(cs.sine - std::sin(angle)) < 1e-15);
    }
}

TEST_CASE("a cone touches the spheres, boxes and half-spaces that hold one of its points", "[cone][property]") {
    for_all(cases(10000), points_of_cones(), directions(), floats(0.0, 5.0), [](ConeAndPoint const& at, dvec3 const& n, double size) {
        auto const sector = formula_sector(at.cone);
        double const slack = 1e-12 * static_cast<double>(at.cone.range);
        // A sphere and a box that the point lies on the border of, as far as its floats go.
        vec3 const c = to_float(at.point + n * size);
        double const d = glm::length(to_double(c) - at.point) + slack;
        CHECK(may_touch(sector, Sphere{c, next_up(static_cast<float>(d))}));
        Aabb box;
        for (axis_t k = 0; k < 3; ++k) {
            auto const p = static_cast<float>(at.point[k]);
            box.lo[k] = next_down(n[k] > 0.0 ? p : p - static_cast<float>(size));
            box.hi[k] = next_up(n[k] > 0.0 ? p + static_cast<float>(size) : p);
        }
        CHECK(may_touch(sector, box));
        CHECK(may_touch(pyramid_of(sector), box));
        std::array const planes{Plane{n, -glm::dot(n, at.point) + slack + 1e-15 * glm::length(at.point)}};
        CHECK(may_touch(PlaneSet(planes), sector));
        formula::GnCrate<float> const crate{formula::Vec3<float>(c), {static_cast<float>(d), 0.0F, 0.0F}, {0.0F, static_cast<float>(d), 0.0F},
                                            {0.0F, 0.0F, static_cast<float>(d)}};
        CHECK(may_touch(PlaneSet(planes), crate));
    });
}

TEST_CASE("cones reject what lies clearly apart", "[cone]") {
    Cone const cone{vec3(0.0F), 10.0F, vec3(0.0F, 0.0F, 2.0F), 0.5F};
    auto const sector = formula_sector(cone);
    CHECK_FALSE(may_touch(sector, Sphere{vec3(0.0F, 0.0F, 11.0F), 0.99F}));
    CHECK_FALSE(may_touch(sector, Sphere{vec3(0.0F, 0.0F, -1.0F), 0.99F}));
    CHECK_FALSE(may_touch(sector, Sphere{vec3(5.0F, 0.0F, 5.0F), 1.9F}));
    CHECK(may_touch(sector, Sphere{vec3(5.0F, 0.0F, 5.0F), 2.0F}));
    CHECK_FALSE(may_touch(sector, Aabb{vec3(2.0F, -1.0F, 1.0F), vec3(3.0F, 1.0F, 3.5F)}));
    CHECK_FALSE(may_touch(sector, Aabb{vec3(-1.0F, -1.0F, 10.001F), vec3(1.0F, 1.0F, 12.0F)}));
    CHECK(may_touch(sector, Aabb{vec3(-1.0F, -1.0F, 9.999F), vec3(1.0F, 1.0F, 12.0F)}));
    auto const half = formula_sector({vec3(0.0F), 10.0F, vec3(0.0F, 0.0F, 1.0F), 1.5707963F});
    CHECK_FALSE(may_touch(half, Aabb{vec3(-1.0F, -1.0F, -2.0F), vec3(1.0F, 1.0F, -0.001F)}));
    auto const wide = formula_sector({vec3(0.0F), 10.0F, vec3(0.0F, 0.0F, 1.0F), 2.0F});
    CHECK(may_touch(wide, Aabb{vec3(5.0F, -1.0F, -2.0F), vec3(6.0F, 1.0F, -1.0F)}));
    CHECK_FALSE(may_touch(wide, Aabb{vec3(-1.0F, -1.0F, -9.0F), vec3(1.0F, 1.0F, -5.0F)}));
    std::array const behind{Plane{dvec3(0.0, 0.0, -1.0), -0.01}};
    CHECK_FALSE(may_touch(PlaneSet(behind), sector));
}
