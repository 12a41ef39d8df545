#pragma once
// Which texels a texture coordinate lies between: wrapping and bilinear weights, once for every module that filters.

#include <gnomon/math/scalar.hpp>

#include <cmath>
#include <cstdint>

namespace gnomon::math {

/// How a texture continues outside [0, 1]: glTF's three.
enum class Wrap : std::uint8_t {
    repeat,
    clamp,
    mirror,
};

/// The two texels on both sides of a coordinate, and the weight of the second; the first has the rest.
struct Tap {
    std::int32_t first;
    std::int32_t second;
    double weight;
};

namespace detail {

/// expects: -1 <= i <= n (clamp, repeat) or 2n (mirror): one step outside at most, so no division is needed.
[[nodiscard]] constexpr std::int32_t wrapped(std::int32_t i, std::int32_t n, Wrap wrap) noexcept {
    switch (wrap) {
        case Wrap::repeat: return i < 0 ? n - 1 : i < n ? i : 0;
        case Wrap::clamp: return i < 0 ? 0 : i < n ? i : n - 1;
        case Wrap::mirror: return i < 0 ? 0 : i < n ? i : i < 2 * n ? 2 * n - 1 - i : 0;
    }
    return 0;
}

}  // namespace detail

/// The texels around coordinate `u` on an axis of `size` texels; u = 1 is the texture's far border.
///
/// Whole repeats are dropped in double before anything becomes an integer, so any number is legal: NaN and infinities
/// read as 0.
///
/// expects: 1 <= size <= 2^29.
[[nodiscard]] inline Tap make_tap(double u, std::int32_t size, Wrap wrap) noexcept {
    double reduced = 0.0;
    switch (wrap) {
        case Wrap::repeat: reduced = u - std::floor(u); break;
        case Wrap::clamp: reduced = u < 0.0 ? 0.0 : u > 1.0 ? 1.0 : u; break;
        case Wrap::mirror: reduced = u - 2.0 * std::floor(u * 0.5); break;
    }
    if (!is_finite(reduced)) reduced = 0.0;
    double const place = reduced * size - 0.5;
    double const whole = std::floor(place);
    auto const i = static_cast<std::int32_t>(whole);
    return {detail::wrapped(i, size, wrap), detail::wrapped(i + 1, size, wrap), place - whole};
}

}  // namespace gnomon::math
