#pragma once
// Lengths in a few steps for each doubling, by the bits of the number: no logarithm.

#include <cmath>
#include <cstdint>

namespace gnomon::cascade::detail {

/// The least (1 + i / steps) 2^e that is not below `x`; `x` itself with no steps.
///
/// expects: x above 0 and finite, `steps` 0 or a power of two of at most 2^20.
[[nodiscard]] inline double quantized_up(double x, std::uint32_t steps) noexcept {
    if (steps == 0) return x;
    int exponent = 0;
    double const mantissa = std::frexp(x, &exponent);  // [1/2, 1)
    double const scale = 2.0 * static_cast<double>(steps);
    return std::ldexp(std::ceil(mantissa * scale) / scale, exponent);
}

/// The greatest one that is not above `x`.
[[nodiscard]] inline double quantized_down(double x, std::uint32_t steps) noexcept {
    if (steps == 0) return x;
    int exponent = 0;
    double const mantissa = std::frexp(x, &exponent);
    double const scale = 2.0 * static_cast<double>(steps);
    return std::ldexp(std::floor(mantissa * scale) / scale, exponent);
}

}  // namespace gnomon::cascade::detail
