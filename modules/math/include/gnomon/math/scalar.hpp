#pragma once
// Floating-point neighbours and classification that hold under any rounding-unsafe compiler flag: they work on bits.

#include <gnomon/math/formula/bits.glsl>
#include <gnomon/math/vec.hpp>

#include <bit>
#include <concepts>
#include <cstdint>
#include <limits>
#include <type_traits>

namespace gnomon::math {

namespace detail {

template <std::floating_point T>
using BitsOf = std::conditional_t<sizeof(T) == 4, std::uint32_t, std::uint64_t>;

template <std::floating_point T>
inline constexpr BitsOf<T> infinity_bits = std::bit_cast<BitsOf<T>>(std::numeric_limits<T>::infinity());

template <std::floating_point T>
inline constexpr BitsOf<T> sign_bit = BitsOf<T>{1} << (sizeof(T) * 8 - 1);

}  // namespace detail

/// Neither infinite nor NaN.
template <std::floating_point T>
[[nodiscard]] constexpr bool is_finite(T x) noexcept {
    return (std::bit_cast<detail::BitsOf<T>>(x) & detail::infinity_bits<T>) != detail::infinity_bits<T>;
}

template <std::floating_point T>
[[nodiscard]] constexpr bool is_nan(T x) noexcept {
    return (std::bit_cast<detail::BitsOf<T>>(x) & ~detail::sign_bit<T>) > detail::infinity_bits<T>;
}

[[nodiscard]] inline bool is_finite(vec3 const& v) noexcept { return is_finite(v.x) && is_finite(v.y) && is_finite(v.z); }
[[nodiscard]] inline bool is_finite(dvec3 const& v) noexcept { return is_finite(v.x) && is_finite(v.y) && is_finite(v.z); }

/// The next representable number above `x`. Both zeros give the smallest denormal; +infinity and NaN give themselves.
template <std::floating_point T>
[[nodiscard]] constexpr T next_up(T x) noexcept {
    using Bits = detail::BitsOf<T>;
    Bits const bits = std::bit_cast<Bits>(x);
    if (is_nan(x) || bits == detail::infinity_bits<T>) return x;
    if ((bits & ~detail::sign_bit<T>) == 0) return std::bit_cast<T>(Bits{1});
    return std::bit_cast<T>(static_cast<Bits>((bits & detail::sign_bit<T>) != 0 ? bits - 1 : bits + 1));
}

/// The next representable number below `x`.
template <std::floating_point T>
[[nodiscard]] constexpr T next_down(T x) noexcept {
    return -next_up(-x);
}

/// The place of `x` in the order of all floats; both zeros are 0.
[[nodiscard]] constexpr std::int32_t ordinal(float x) noexcept { return gn_ordinal(formula::Float<float>(x)).v; }

/// The float at that place.
///
/// expects: the place of a float, so not -2^31.
[[nodiscard]] constexpr float from_ordinal(std::int32_t place) noexcept {
    return gn_from_ordinal(formula::Int<float>(place)).v;
}

/// Number of representable steps from `a` to `b`, counted through zero; both zeros are one value.
///
/// expects: neither is NaN.
[[nodiscard]] constexpr std::int64_t ulps_between(float a, float b) noexcept {
    return std::int64_t{ordinal(b)} - std::int64_t{ordinal(a)};
}

/// The 16-bit code nearest to a depth, ties to even.
///
/// expects: a depth in [0, 1].
[[nodiscard]] constexpr std::uint16_t code_of_depth(float depth) noexcept {
    return static_cast<std::uint16_t>(gn_code_of_depth(formula::Float<float>(depth)).v);
}

/// The depth c / 65535 that a 16-bit code stands for: c times the float nearest to 1 / 65535.
[[nodiscard]] constexpr float depth_of_code(std::uint16_t code) noexcept {
    return gn_depth_of_code(formula::Float<float>(static_cast<float>(code))).v;
}

static_assert(next_up(1.0F) == 1.0F + std::numeric_limits<float>::epsilon());
static_assert(next_down(0.0) == -std::numeric_limits<double>::denorm_min());
static_assert(next_up(std::numeric_limits<float>::max()) == std::numeric_limits<float>::infinity());
static_assert(ulps_between(-std::numeric_limits<float>::denorm_min(), std::numeric_limits<float>::denorm_min()) == 2);

}  // namespace gnomon::math
