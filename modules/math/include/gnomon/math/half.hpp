#pragma once
// IEEE 754 halves in 16 bits: what a G-buffer of 16 bits holds.

#include <gnomon/math/formula/bits.glsl>

#include <bit>
#include <cstdint>

namespace gnomon::math {

/// The half nearest to x, ties to even.
///
/// returns: the largest finite half, 65504, for what is above it, infinity too; 0 for NaN. The sign is kept.
[[nodiscard]] constexpr std::uint16_t half_of_float(float x) noexcept {
    std::uint32_t const bits = std::bit_cast<std::uint32_t>(x);
    std::uint32_t const sign = bits >> 16U & 0x8000U;
    std::uint32_t const magnitude = bits & 0x7FFFFFFFU;
    if (magnitude > 0x7F800000U) return 0;
    if (magnitude >= 0x477FF000U) return static_cast<std::uint16_t>(sign | 0x7BFFU);
    if (magnitude < 0x38800000U) {  // below 2^-14: multiples of 2^-24; the sum rounds to them
        float const rounded = std::bit_cast<float>(magnitude) + 0.5F;
        return static_cast<std::uint16_t>(sign | (std::bit_cast<std::uint32_t>(rounded) - 0x3F000000U));
    }
    std::uint32_t const odd = magnitude >> 13U & 1U;
    return static_cast<std::uint16_t>(sign | ((magnitude - 0x38000000U + 0xFFFU + odd) >> 13U));
}

/// expects: a finite half.
[[nodiscard]] constexpr float float_of_half(std::uint16_t bits) noexcept {
    return gn_float_of_half(formula::Uint<float>(std::uint32_t{bits})).v;
}

}  // namespace gnomon::math
