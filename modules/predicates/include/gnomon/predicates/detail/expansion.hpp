#pragma once
// Exact sums and products of doubles as expansions: sums of doubles that do not overlap, smallest first.
//
// source:  J. R. Shewchuk, "Adaptive Precision Floating-Point Arithmetic and Fast Robust Geometric Predicates", 1997:
//          two_sum, two_diff, fast expansion sum, scale expansion, all with elimination of zeros.
// expects: round to nearest even, denormals not flushed, no value-changing compiler flags. FMA contraction is harmless:
//          sums hold no product that a compiler could see, since products come from explicit calls of fma. (The
//          product a * b is written fma(a, b, 0): a plain product could be fused into a sum that follows it, and the
//          error term would then belong to another number.)

#include <cfloat>
#include <cmath>
#include <cstddef>

#if defined(__FAST_MATH__) || defined(__ASSOCIATIVE_MATH__) || defined(_M_FP_FAST)
#error "gnomon/predicates: exact arithmetic cannot be compiled with -ffast-math or -fassociative-math"
#endif
#if FLT_EVAL_METHOD != 0
#error "gnomon/predicates: doubles must be evaluated as doubles (not x87; use -mfpmath=sse)"
#endif

namespace gnomon::predicates::detail {

/// high + low, exactly; low is the rounding error of high.
struct Pair {
    double high;
    double low;
};

[[nodiscard]] inline Pair two_sum(double a, double b) noexcept {
    double const sum = a + b;
    double const b_virtual = sum - a;
    double const a_virtual = sum - b_virtual;
    return {sum, (a - a_virtual) + (b - b_virtual)};
}

[[nodiscard]] inline Pair two_diff(double a, double b) noexcept { return two_sum(a, -b); }

[[nodiscard]] inline Pair two_prod(double a, double b) noexcept {
    double const product = std::fma(a, b, 0.0);
    return {product, std::fma(a, b, -product)};
}

/// At most N terms, increasing in magnitude, no two overlapping, none zero; no term at all is the number zero.
template <std::size_t N>
struct Expansion {
    double term[N];
    int size = 0;

    void push_unless_zero(double x) noexcept {
        if (x != 0.0) term[size++] = x;
    }
};

[[nodiscard]] inline Expansion<2> expansion(Pair const& p) noexcept {
    Expansion<2> e;
    e.push_unless_zero(p.low);
    e.push_unless_zero(p.high);
    return e;
}

template <std::size_t N, std::size_t M>
[[nodiscard]] Expansion<N + M> sum(Expansion<N> const& e, Expansion<M> const& f) noexcept {
    Expansion<N + M> out;
    int i = 0;
    int j = 0;
    auto const smallest = [&]() noexcept {
        bool const from_e = j == f.size || (i < e.size && std::abs(e.term[i]) < std::abs(f.term[j]));
        return from_e ? e.term[i++] : f.term[j++];
    };
    int const count = e.size + f.size;
    if (count == 0) return out;
    double running = smallest();
    for (int k = 1; k < count; ++k) {
        Pair const s = two_sum(running, smallest());
        out.push_unless_zero(s.low);
        running = s.high;
    }
    out.push_unless_zero(running);
    return out;
}

template <std::size_t N>
[[nodiscard]] Expansion<2 * N> scaled(Expansion<N> const& e, double factor) noexcept {
    Expansion<2 * N> out;
    if (e.size == 0 || factor == 0.0) return out;
    Pair const first = two_prod(e.term[0], factor);
    out.push_unless_zero(first.low);
    double running = first.high;
    for (int i = 1; i < e.size; ++i) {
        Pair const product = two_prod(e.term[i], factor);
        Pair const middle = two_sum(running, product.low);
        out.push_unless_zero(middle.low);
        Pair const top = two_sum(product.high, middle.high);
        out.push_unless_zero(top.low);
        running = top.high;
    }
    out.push_unless_zero(running);
    return out;
}

/// e * f, for a factor of two terms, as a difference of floats is.
template <std::size_t N>
[[nodiscard]] Expansion<4 * N> product(Expansion<N> const& e, Expansion<2> const& f) noexcept {
    if (f.size == 0) return {};
    if (f.size == 1) return sum(scaled(e, f.term[0]), Expansion<2 * N>{});
    return sum(scaled(e, f.term[0]), scaled(e, f.term[1]));
}

template <std::size_t N>
[[nodiscard]] Expansion<N> negated(Expansion<N> e) noexcept {
    for (int i = 0; i < e.size; ++i) e.term[i] = -e.term[i];
    return e;
}

}  // namespace gnomon::predicates::detail
