#include <gnomon/check/check.hpp>
#include <gnomon/math/texel.hpp>

#include <cmath>
#include <cstdint>
#include <limits>

namespace {

using namespace gnomon;
using math::Wrap;

/// Texel of any integer coordinate, by the definition of each mode.
std::int64_t wrapped_by_division(std::int64_t i, std::int64_t n, Wrap wrap) {
    auto const modulo = [](std::int64_t a, std::int64_t m) { return ((a % m) + m) % m; };
    if (wrap == Wrap::clamp) return i < 0 ? 0 : i >= n ? n - 1 : i;
    if (wrap == Wrap::repeat) return modulo(i, n);
    std::int64_t const m = modulo(i, 2 * n);
    return m < n ? m : 2 * n - 1 - m;
}

auto const modes = check::element_of({Wrap::repeat, Wrap::clamp, Wrap::mirror});

}  // namespace

TEST_CASE("taps are the texels on both sides, whatever the coordinate and the mode", "[math][texel][property]") {
    // Sixteenths of a texel of power-of-two textures: every step is exact, so the division must agree to the bit.
    check::for_all(check::cases(20'000), check::integers(-100'000, 100'000), check::integers(0, 8), modes,
                   [](int sixteenths, int log_size, Wrap wrap) {
                       std::int32_t const size = 1 << log_size;
                       double const place = sixteenths / 16.0 - 0.5;
                       auto const low = static_cast<std::int64_t>(std::floor(place));
                       math::Tap const tap = math::make_tap(sixteenths / 16.0 / size, size, wrap);
                       CHECK(tap.first == wrapped_by_division(low, size, wrap));
                       CHECK(tap.second == wrapped_by_division(low + 1, size, wrap));
                       bool const outside = wrap == Wrap::clamp && (place < -0.5 || place > size - 0.5);
                       if (!outside) CHECK(tap.weight == place - std::floor(place));
                   });
}

TEST_CASE("any coordinate has taps in range and a weight in [0, 1)", "[math][texel][property]") {
    check::for_all(check::any_float<double>().with_nan().with_inf(), check::integers(1, 5000), modes,
                   [](double u, std::int32_t size, Wrap wrap) {
                       math::Tap const tap = math::make_tap(u, size, wrap);
                       CHECK((tap.first >= 0 && tap.first < size && tap.second >= 0 && tap.second < size));
                       CHECK((tap.weight >= 0.0 && tap.weight < 1.0));
                   });
}
