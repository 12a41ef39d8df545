#pragma once
// A float whose arithmetic is as bad as Vulkan allows: any rounding, quotients 2.5 units off, denormals flushed or not.
// A bound that holds for it whatever it draws holds on every device.

#include "../../predicates/tests/hard_floats.hpp"

#include <bit>
#include <cmath>
#include <cstdint>

namespace sloppy {

/// How the next operations round: a direction for all, or one drawn for each.
enum class Rounding : int { nearest, down, up, to_zero, from_zero, drawn };

struct State {
    hard::Random random{1};
    Rounding rounding = Rounding::drawn;
    bool flush = true;
};

inline State& state() {
    static thread_local State s;
    return s;
}

/// Another habit for the next formula.
inline void redraw() {
    State& s = state();
    s.rounding = static_cast<Rounding>(s.random.below(6));
    s.flush = s.random.below(2) == 0;
}

struct Float {
    float v;

    Float() noexcept = default;
    template <class X>
    explicit constexpr Float(X x) noexcept : v(static_cast<float>(x)) {}

    /// The neighbour of `x` below or above, or the nearest; x is exact, or off by far less than a float's unit.
    static Float rounded(double x) noexcept {
        State& s = state();
        auto const nearest = static_cast<float>(x);
        auto const wide = static_cast<double>(nearest);
        if (wide == x && std::abs(nearest) >= 0x1p-126F) return Float(nearest);
        int const way = s.rounding == Rounding::drawn ? s.random.below(2) : 0;
        bool const down = s.rounding == Rounding::down || (s.rounding == Rounding::to_zero && x > 0.0) ||
                          (s.rounding == Rounding::from_zero && x < 0.0) || (s.rounding == Rounding::drawn && way == 0);
        float r = nearest;
        if (s.rounding != Rounding::nearest && wide != x) {
            if (down && wide > x) r = std::nextafter(nearest, -INFINITY);
            if (!down && wide < x) r = std::nextafter(nearest, INFINITY);
        }
        return flushed(r);
    }
    static Float flushed(float x) noexcept {
        State& s = state();
        bool const flush =
            s.flush && std::abs(x) < 0x1p-126F && (s.rounding != Rounding::drawn || s.random.below(2) == 0);
        return Float(flush ? 0.0F : x);
    }
    static double operand(Float const& x) noexcept { return static_cast<double>(flushed(x.v).v); }

    friend Float operator+(Float const& a, Float const& b) noexcept { return rounded(operand(a) + operand(b)); }
    friend Float operator-(Float const& a, Float const& b) noexcept { return rounded(operand(a) - operand(b)); }
    friend Float operator*(Float const& a, Float const& b) noexcept { return rounded(operand(a) * operand(b)); }
    friend Float operator/(Float const& a, Float const& b) noexcept {
        double const exact = operand(a) / operand(b);
        Float r = rounded(exact);
        if (r.v == 0.0F || state().rounding == Rounding::nearest) return r;
        // At most one unit off so far; one and a half more may be. (A power of two apart, a unit is the larger one.)
        bool const up = static_cast<double>(r.v) > exact;
        if (state().random.below(2) == 0) r.v = std::nextafter(r.v, up ? INFINITY : -INFINITY);
        return flushed(r.v);
    }
    friend Float operator-(Float const& a) noexcept { return Float(-a.v); }
    friend bool operator<(Float const& a, Float const& b) noexcept { return a.v < b.v; }
    friend bool operator<=(Float const& a, Float const& b) noexcept { return a.v <= b.v; }
    friend bool operator>(Float const& a, Float const& b) noexcept { return a.v > b.v; }
    friend bool operator>=(Float const& a, Float const& b) noexcept { return a.v >= b.v; }
    friend bool operator==(Float const& a, Float const& b) noexcept { return a.v == b.v; }
    friend bool operator!=(Float const& a, Float const& b) noexcept { return a.v != b.v; }
    explicit operator std::int32_t() const noexcept { return static_cast<std::int32_t>(v); }
};

}  // namespace sloppy
