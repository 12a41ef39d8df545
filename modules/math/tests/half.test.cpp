#include <gnomon/check/check.hpp>
#include <gnomon/math/half.hpp>

#include <cmath>
#include <cstdint>
#include <limits>

using namespace gnomon;

namespace {

/// A finite half's value, from the definition.
double value_of(std::uint16_t bits) {
    int const exponent = bits >> 10 & 31;
    int const fraction = bits & 1023;
    double const magnitude = exponent == 0 ? std::ldexp(fraction, -24) : std::ldexp(1024 + fraction, exponent - 25);
    return bits >> 15 != 0 ? -magnitude : magnitude;
}

}  // namespace

TEST_CASE("every finite half comes back from its float", "[math][half]") {
    for (std::uint32_t bits = 0; bits < 0x10000U; ++bits) {
        auto const half = static_cast<std::uint16_t>(bits);
        if ((half & 0x7C00U) == 0x7C00U) continue;
        float const x = math::float_of_half(half);
        REQUIRE(static_cast<double>(x) == value_of(half));
        REQUIRE(math::half_of_float(x) == half);
    }
}

TEST_CASE("a float between two halves rounds to the nearer, the middle to the even one", "[math][half]") {
    for (std::uint16_t half = 0; half < 0x7BFFU; ++half) {
        auto const next = static_cast<std::uint16_t>(half + 1);
        auto const middle = static_cast<float>((value_of(half) + value_of(next)) / 2);  // exact: one bit more
        REQUIRE(math::half_of_float(middle) == (half % 2 == 0 ? half : next));
        REQUIRE(math::half_of_float(std::nextafter(middle, 0.0F)) == half);
        REQUIRE(math::half_of_float(std::nextafter(middle, 1e6F)) == next);
    }
}

TEST_CASE("what no half holds becomes the largest, NaN becomes 0", "[math][half]") {
    float const infinity = std::numeric_limits<float>::infinity();
    for (float const x : {65504.0F, 65519.9F, 65520.0F, 1e30F, infinity}) {
        CHECK(math::half_of_float(x) == 0x7BFFU);
        CHECK(math::half_of_float(-x) == 0xFBFFU);
    }
    CHECK(math::half_of_float(std::numeric_limits<float>::quiet_NaN()) == 0);
    CHECK(math::half_of_float(std::numeric_limits<float>::denorm_min()) == 0);
    static_assert(math::half_of_float(1.0F) == 0x3C00U && math::float_of_half(0xC000U) == -2.0F);
}
