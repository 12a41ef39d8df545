#pragma once
// The answer of every predicate: on which side, exactly.

#include <cstdint>

namespace gnomon::predicates {

enum class Sign : std::int8_t { negative = -1, zero = 0, positive = 1 };

[[nodiscard]] constexpr Sign operator-(Sign s) noexcept { return static_cast<Sign>(-static_cast<int>(s)); }

/// Zero for zero, and for NaN.
[[nodiscard]] constexpr Sign sign_of(double x) noexcept {
    return x > 0.0 ? Sign::positive : x < 0.0 ? Sign::negative : Sign::zero;
}

/// One is positive and the other negative. Zero is opposite to nothing.
[[nodiscard]] constexpr bool strictly_opposite(Sign a, Sign b) noexcept {
    return static_cast<int>(a) * static_cast<int>(b) < 0;
}

/// Not strictly opposite, for three: they do not hold both a positive and a negative sign.
[[nodiscard]] constexpr bool none_opposite(Sign a, Sign b, Sign c) noexcept {
    bool const has_positive = a == Sign::positive || b == Sign::positive || c == Sign::positive;
    bool const has_negative = a == Sign::negative || b == Sign::negative || c == Sign::negative;
    return !(has_positive && has_negative);
}

/// A value in double, and a proven bound of its distance from the exact one.
struct Estimate {
    double value;
    double bound;

    /// The sign of `value` is the exact one. (Bound 0: every product is exactly zero.)
    [[nodiscard]] bool is_certain() const noexcept { return value > bound || -value > bound || bound == 0.0; }
};

static_assert(-Sign::positive == Sign::negative && sign_of(-0.0) == Sign::zero);
static_assert(strictly_opposite(Sign::positive, Sign::negative) && !strictly_opposite(Sign::zero, Sign::negative));
static_assert(none_opposite(Sign::zero, Sign::negative, Sign::negative));
static_assert(!none_opposite(Sign::positive, Sign::zero, Sign::negative));

}  // namespace gnomon::predicates
