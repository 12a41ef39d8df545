#pragma once
// Interval arithmetic whose bounds always hold the exact result: each rounded end is moved one step outward.
//
// Round-to-nearest errs by at most half a step, so one step outward bounds it, in any rounding mode but the compiler's
// "fast" ones. No product is summed in one expression, so contraction to FMA cannot change an end.

#include <gnomon/core/contract.hpp>
#include <gnomon/math/scalar.hpp>

#include <algorithm>
#include <concepts>
#include <optional>

namespace gnomon::math {

/// All x with lo <= x <= hi. An operation on NaN or on overflow gives the whole line, never an empty interval.
template <std::floating_point T>
struct Interval {
    T lo{};
    T hi{};

    [[nodiscard]] static constexpr Interval exactly(T x) noexcept { return {x, x}; }
    [[nodiscard]] static constexpr Interval everything() noexcept {
        return {-std::numeric_limits<T>::infinity(), std::numeric_limits<T>::infinity()};
    }
    friend constexpr bool operator==(Interval const&, Interval const&) noexcept = default;
};

namespace detail {

template <std::floating_point T>
[[nodiscard]] constexpr Interval<T> outward(T lo, T hi) noexcept {
    if (is_nan(lo) || is_nan(hi)) return Interval<T>::everything();
    return {next_down(lo), next_up(hi)};
}

}  // namespace detail

template <std::floating_point T>
[[nodiscard]] constexpr bool contains(Interval<T> const& a, T x) noexcept {
    return a.lo <= x && x <= a.hi;
}

template <std::floating_point T>
[[nodiscard]] constexpr Interval<T> operator-(Interval<T> const& a) noexcept {
    return {-a.hi, -a.lo};
}

template <std::floating_point T>
[[nodiscard]] constexpr Interval<T> operator+(Interval<T> const& a, Interval<T> const& b) noexcept {
    return detail::outward(a.lo + b.lo, a.hi + b.hi);
}

template <std::floating_point T>
[[nodiscard]] constexpr Interval<T> operator-(Interval<T> const& a, Interval<T> const& b) noexcept {
    return a + -b;
}

template <std::floating_point T>
[[nodiscard]] constexpr Interval<T> operator*(Interval<T> const& a, Interval<T> const& b) noexcept {
    T const p[4] = {a.lo * b.lo, a.lo * b.hi, a.hi * b.lo, a.hi * b.hi};
    for (T const x : p)
        if (is_nan(x)) return Interval<T>::everything();
    return detail::outward(std::min({p[0], p[1], p[2], p[3]}), std::max({p[0], p[1], p[2], p[3]}));
}

/// Quotient; nothing if the divisor may be zero.
template <std::floating_point T>
[[nodiscard]] constexpr std::optional<Interval<T>> try_divide(Interval<T> const& a, Interval<T> const& b) noexcept {
    if (!(b.lo > T{0} || b.hi < T{0})) return std::nullopt;
    T const q[4] = {a.lo / b.lo, a.lo / b.hi, a.hi / b.lo, a.hi / b.hi};
    for (T const x : q)
        if (is_nan(x)) return Interval<T>::everything();
    return detail::outward(std::min({q[0], q[1], q[2], q[3]}), std::max({q[0], q[1], q[2], q[3]}));
}

/// Sign shared by every number of the interval: -1, 0 (the interval is exactly zero) or 1; nothing if it has several.
template <std::floating_point T>
[[nodiscard]] constexpr std::optional<int> try_sign(Interval<T> const& a) noexcept {
    if (a.lo > T{0}) return 1;
    if (a.hi < T{0}) return -1;
    if (a.lo == T{0} && a.hi == T{0}) return 0;
    return std::nullopt;
}

}  // namespace gnomon::math
