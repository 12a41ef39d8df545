#include <gnomon/check/check.hpp>
#include <gnomon/math/generators.hpp>
#include <gnomon/math/plane.hpp>

namespace {

using namespace gnomon;
using math::Aabb;
using math::Plane;
using math::vec3;

/// The plane's function at a corner, in 113 bits: products are exact, the three sums err below any double's bound.
__float128 exact_value(Plane const& plane, vec3 const& p) {
    __float128 sum = plane.offset;
    for (math::axis_t axis = 0; axis < 3; ++axis)
        sum += static_cast<__float128>(plane.normal[axis]) * static_cast<__float128>(p[axis]);
    return sum;
}

}  // namespace

TEST_CASE("a box that reaches into the half-space is never called outside", "[math][plane][property]") {
    check::for_all(check::cases(20'000), math::boxes(), math::directions(), math::points(),
                   [](Aabb const& box, math::dvec3 const& normal, vec3 const& on) {
                       Plane const plane{normal, -glm::dot(normal, math::to_double(on))};
                       bool inside = false;
                       for (unsigned i = 0; i < 8; ++i) inside = inside || exact_value(plane, math::corner(box, i)) >= 0;
                       if (inside) CHECK_FALSE(math::surely_outside(plane, box));
                   });
}

TEST_CASE("a box within rounding of the plane is kept, one clearly behind it is not", "[math][plane]") {
    Plane const right_of_1000{math::dvec3(1.0, 0.0, 0.0), -1000.0};
    CHECK_FALSE(math::surely_outside(right_of_1000, Aabb{vec3(999.0F), vec3(1000.0F)}));
    CHECK(math::surely_outside(right_of_1000, Aabb{vec3(999.0F), vec3(math::next_down(1000.0F))}));
}

TEST_CASE("a plane without a normal has everything inside", "[math][plane][property]") {
    check::for_all(math::boxes(), [](Aabb const& box) { CHECK_FALSE(math::surely_outside(Plane{}, box)); });
}
