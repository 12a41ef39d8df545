#include <gnomon/check/check.hpp>
#include <gnomon/math/texel.hpp>

#include "texels.hpp"

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

using math::AlphaTexture;
using texels::Texels;

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

TEST_CASE("alpha_at gives the texel at its centre and the mean half way", "[math][texel]") {
    Texels const texels(0, 255, 51, 102);
    AlphaTexture const t = texels.texture(Wrap::clamp);
    CHECK(alpha_at(t, math::dvec2(0.25, 0.25)) == 0.0);
    CHECK(alpha_at(t, math::dvec2(0.75, 0.25)) == 1.0);
    CHECK(alpha_at(t, math::dvec2(0.25, 0.75)) == 0.2);
    CHECK(alpha_at(t, math::dvec2(0.5, 0.25)) == 0.5);
    CHECK(alpha_at(t, math::dvec2(0.5, 0.5)) == (0.0 + 255.0 + 51.0 + 102.0) / 4.0 / 255.0);
}

TEST_CASE("alpha_at wraps as glTF says", "[math][texel]") {
    Texels const texels(0, 255, 0, 255);
    // At u = 0 the taps are texels -1 and 0.
    CHECK(alpha_at(texels.texture(Wrap::clamp), math::dvec2(0.0, 0.25)) == 0.0);
    CHECK(alpha_at(texels.texture(Wrap::repeat), math::dvec2(0.0, 0.25)) == 0.5);
    CHECK(alpha_at(texels.texture(Wrap::mirror), math::dvec2(0.0, 0.25)) == 0.0);
    CHECK(alpha_at(texels.texture(Wrap::clamp), math::dvec2(9.0, 0.25)) == 1.0);
    CHECK(alpha_at(texels.texture(Wrap::repeat), math::dvec2(9.25, 0.25)) == 0.0);
    CHECK(alpha_at(texels.texture(Wrap::mirror), math::dvec2(1.25, 0.25)) == 1.0);
    CHECK(alpha_at(texels.texture(Wrap::mirror), math::dvec2(-0.25, 0.25)) == 0.0);
    CHECK(alpha_at(texels.texture(Wrap::repeat), math::dvec2(-0.25, 0.25)) == 1.0);
}

TEST_CASE("alpha_at takes any numbers and any texture", "[math][texel]") {
    Texels const texels(255, 255, 255, 255);
    double const inf = std::numeric_limits<double>::infinity();
    for (Wrap const wrap : {Wrap::clamp, Wrap::repeat, Wrap::mirror})
        for (double const u : {inf, -inf, std::numeric_limits<double>::quiet_NaN(), 1e300, -1e300, 1e-300, -0.0, 1e15})
            CHECK(alpha_at(texels.texture(wrap), math::dvec2(u, 0.3)) == 1.0);
}

TEST_CASE("a texture is complete when it holds the texels that its size promises", "[math][texel]") {
    Texels const texels(255, 255, 255, 255);
    AlphaTexture texture = texels.texture(Wrap::repeat);
    CHECK(is_complete(texture));
    CHECK_FALSE(is_complete(AlphaTexture{}));
    texture.size_px = math::ivec2(2, 3);
    CHECK_FALSE(is_complete(texture));
    texture.size_px = math::ivec2(2147483647, 2147483647);
    CHECK_FALSE(is_complete(texture));
    texture.size_px = math::ivec2(4, 4);
    texture.channels = 1;
    CHECK(is_complete(texture));
}
