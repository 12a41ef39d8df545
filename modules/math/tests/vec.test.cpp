#include <gnomon/check/check.hpp>
#include <gnomon/math/generators.hpp>
#include <gnomon/math/vec.hpp>

using namespace gnomon;

TEST_CASE("a vector that was rounded to float and taken back to double is rounded", "[math][vec][property]") {
    auto const any = check::floats(-1e7, 1e7);
    check::for_all(any, any, any, [](double x, double y, double z) {
        math::dvec3 const back = math::to_double(math::to_float(math::dvec3(x, y, z)));
        // Through memory that the optimizer cannot see through, one number at a time.
        double const wide[3] = {x, y, z};
        for (math::axis_t axis = 0; axis < 3; ++axis) {
            float const volatile narrow = static_cast<float>(wide[axis]);
            CHECK(back[axis] == static_cast<double>(narrow));
        }
    });
}
