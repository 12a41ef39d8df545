#include <gnomon/check/check.hpp>
#include <gnomon/math/generators.hpp>
#include <gnomon/math/scalar.hpp>

#include <cmath>
#include <limits>

namespace {
using namespace gnomon;
constexpr float inf = std::numeric_limits<float>::infinity();
}  // namespace

TEST_CASE("next_up and next_down are the standard library's nextafter", "[math][scalar][property]") {
    check::for_all(check::any_float<float>(), [](float x) {
        CHECK(math::next_up(x) == std::nextafter(x, inf));
        CHECK(math::next_down(x) == std::nextafter(x, -inf));
    });
    CHECK(math::next_up(inf) == inf);
    CHECK(math::next_down(-inf) == -inf);
    CHECK(math::is_nan(math::next_up(std::numeric_limits<float>::quiet_NaN())));
}

TEST_CASE("classification agrees with the standard library on every kind of number", "[math][scalar][property]") {
    check::for_all(check::any_float<float>().with_nan().with_inf(), [](float x) {
        CHECK(math::is_finite(x) == std::isfinite(x));
        CHECK(math::is_nan(x) == std::isnan(x));
    });
}

TEST_CASE("n steps up are n ulps", "[math][scalar][property]") {
    check::for_all(check::any_float<float>(), check::integers(0, 40), [](float x, int steps) {
        float y = x;
        for (int i = 0; i < steps; ++i) y = math::next_up(y);
        if (math::is_finite(y)) CHECK(math::ulps_between(x, y) == steps);
    });
    CHECK(math::ulps_between(0.0F, -0.0F) == 0);
}
