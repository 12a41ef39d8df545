#include <gnomon/check/check.hpp>
#include <gnomon/math/generators.hpp>
#include <gnomon/math/lanes.hpp>

#include <array>
#include <bit>
#include <cstdint>

namespace {

using namespace gnomon;

template <std::size_t N>
using Floats = math::Lanes<float, N>;

/// Equal bits, so that signed zeros and NaN count.
bool same(float a, float b) { return std::bit_cast<std::uint32_t>(a) == std::bit_cast<std::uint32_t>(b); }

template <std::size_t N>
void compare_with_scalar(std::array<float, 16> const& x, std::array<float, 16> const& y) {
    auto const a = Floats<N>::load(x.data());
    auto const b = Floats<N>::load(y.data());
    std::uint32_t const less = math::bits(a < b);
    std::uint32_t const equal = math::bits(a == b);
    for (std::size_t i = 0; i < N; ++i) {
        CHECK(same((a + b)[i], x[i] + y[i]));
        CHECK(same((a - b)[i], x[i] - y[i]));
        CHECK(same((a * b)[i], x[i] * y[i]));
        CHECK(same((-a)[i], -x[i]));
        CHECK(((less >> i & 1U) != 0) == (x[i] < y[i]));
        CHECK(((equal >> i & 1U) != 0) == (x[i] == y[i]));
        CHECK(same(math::min(a, b)[i], y[i] < x[i] ? y[i] : x[i]));
        CHECK(same(math::max(a, b)[i], y[i] > x[i] ? y[i] : x[i]));
        CHECK(same(math::select(a < b, a, b)[i], x[i] < y[i] ? x[i] : y[i]));
    }
}

}  // namespace

TEST_CASE("lanes of every width give the scalar's bits", "[math][lanes][property]") {
    auto const sixteen = check::array_of<16>(check::any_float<float>());
    check::for_all(sixteen, sixteen, [](std::array<float, 16> const& x, std::array<float, 16> const& y) {
        compare_with_scalar<2>(x, y);
        compare_with_scalar<4>(x, y);
        compare_with_scalar<8>(x, y);
        compare_with_scalar<16>(x, y);
    });
}

TEST_CASE("any and all see every lane", "[math][lanes]") {
    auto const ramp = math::Lanes<std::int32_t, 8>::ramp(0, 1);
    for (std::int32_t i = 0; i < 8; ++i) {
        auto const only = ramp == math::Lanes<std::int32_t, 8>::all(i);
        CHECK(math::bits(only) == 1U << i);
        CHECK(math::any(only));
        CHECK_FALSE(math::all(only));
    }
    CHECK(math::all(ramp == ramp));
    CHECK_FALSE(math::any(ramp != ramp));
}

TEST_CASE("a conversion is static_cast per lane", "[math][lanes]") {
    auto const halves = math::Lanes<float, 4>::ramp(-1.5F, 1.0F);
    auto const whole = math::convert<std::int32_t>(halves);
    for (std::size_t i = 0; i < 4; ++i) CHECK(whole[i] == static_cast<std::int32_t>(halves[i]));
    CHECK(math::convert<double>(halves)[1] == -0.5);
}
