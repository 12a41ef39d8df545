#pragma once
// What a formula's types are made of, for a plain scalar and for lanes: the integers and the mask that go with it, and
// the few operations that C++ spells differently for the two.

#include <gnomon/math/detail/lanes_sqrt.hpp>
#include <gnomon/math/lanes.hpp>

#include <bit>
#include <cmath>
#include <concepts>
#include <cstddef>
#include <cstdint>

namespace gnomon::formula::detail {

template <class S>
struct Scalar {
    using Element = S;
    using Int = std::int32_t;
    using Uint = std::uint32_t;
    using Bool = bool;
};

template <std::size_t N>
struct Scalar<math::Lanes<float, N>> {
    using Element = float;
    using Int = math::Lanes<std::int32_t, N>;
    using Uint = math::Lanes<std::uint32_t, N>;
    using Bool = math::Lanes<std::int32_t, N>;
};

template <class X, class... T>
concept OneOf = (std::same_as<X, T> || ...);

/// `x` in every lane, or `x` itself.
template <class To, class X>
[[nodiscard, gnu::always_inline]] constexpr To spread(X const& x) noexcept {
    if constexpr (std::same_as<To, X>) return x;
    else if constexpr (std::same_as<X, bool>) return To::all(x ? -1 : 0);
    else if constexpr (requires { To::size; }) return To::all(static_cast<typename To::value_type>(x));
    else return static_cast<To>(x);
}

template <class To, class From>
[[nodiscard, gnu::always_inline]] constexpr To converted(From const& x) noexcept {
    if constexpr (requires { To::size; }) return math::convert<typename To::value_type>(x);
    else return static_cast<To>(x);
}

template <class To, class From>
[[nodiscard, gnu::always_inline]] constexpr To same_bits(From const& x) noexcept {
    if constexpr (requires { To::size; }) return math::bits_as<typename To::value_type>(x);
    else return std::bit_cast<To>(x);
}

template <class Mask, class X>
[[nodiscard, gnu::always_inline]] constexpr X chosen(Mask const& mask, X const& yes, X const& no) noexcept {
    if constexpr (requires { X::size; }) return math::select(mask, yes, no);
    else return mask ? yes : no;
}

template <class Mask>
[[nodiscard, gnu::always_inline]] constexpr Mask both(Mask const& a, Mask const& b) noexcept {
    if constexpr (requires { Mask::size; }) return a & b;
    else return a && b;
}

template <class Mask>
[[nodiscard, gnu::always_inline]] constexpr Mask either(Mask const& a, Mask const& b) noexcept {
    if constexpr (requires { Mask::size; }) return a | b;
    else return a || b;
}

template <class Mask>
[[nodiscard, gnu::always_inline]] constexpr Mask inverted(Mask const& a) noexcept {
    if constexpr (requires { Mask::size; }) return a == Mask::all(0);
    else return !a;
}

template <class Mask>
[[nodiscard, gnu::always_inline]] constexpr bool is_any(Mask const& a) noexcept {
    if constexpr (requires { Mask::size; }) return math::any(a);
    else return a;
}

template <class S>
[[nodiscard, gnu::always_inline]] constexpr S root(S const& x) noexcept {
    if constexpr (requires { S::size; }) return math::sqrt(x);
    else return std::sqrt(x);
}

template <class S>
[[nodiscard, gnu::always_inline]] constexpr S magnitude(S const& x) noexcept {
    if constexpr (requires { S::size; })
        return math::bits_as<float>(math::bits_as<std::int32_t>(x) & Scalar<S>::Int::all(0x7FFF'FFFF));
    else if constexpr (sizeof(S) == 4)
        return std::bit_cast<S>(std::bit_cast<std::uint32_t>(x) & 0x7FFF'FFFFU);
    else
        return std::bit_cast<S>(std::bit_cast<std::uint64_t>(x) & 0x7FFF'FFFF'FFFF'FFFFULL);
}

}  // namespace gnomon::formula::detail
