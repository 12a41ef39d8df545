#include <gnomon/check/check.hpp>
#include <gnomon/math/text.hpp>

TEST_CASE("vectors are named to nine digits", "[math]") {
    CHECK(gnomon::math::text_of(gnomon::math::dvec3(1.0, -0.5, 1e-12)) == "(1, -0.5, 1e-12)");
}
