#pragma once
// Lanes: N numbers that go through the same arithmetic at once.
//
// One type, two forms behind it: the compiler's vector extension (GCC, Clang), which becomes SSE, AVX or NEON as the
// target allows, or a plain array (GNOMON_SCALAR, other compilers). Every operation is the IEEE one per lane, so both
// forms, and every width, give the same bits as the scalar code. Loads need no alignment.
//
// Always inlined: a function compiled for AVX2 may use wide lanes though the rest of the program is not, and the two
// pass such arguments differently.

#include <array>
#include <bit>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <type_traits>

#if !defined(GNOMON_SCALAR) && (defined(__GNUC__) || defined(__clang__))
#define GNOMON_VECTOR_EXTENSION 1
#else
#define GNOMON_VECTOR_EXTENSION 0
#endif

namespace gnomon::math {

template <class T>
concept Lane = std::same_as<T, float> || std::same_as<T, double> || std::same_as<T, std::int32_t> ||
               std::same_as<T, std::int64_t> || std::same_as<T, std::uint32_t>;

namespace detail {

/// The integer of a lane's size: what a comparison yields, all ones or zero.
template <class T>
using MaskOf = std::conditional_t<sizeof(T) == 4, std::int32_t, std::int64_t>;

#if GNOMON_VECTOR_EXTENSION
template <class T, std::size_t N>
struct Storage {
    typedef T Type __attribute__((vector_size(sizeof(T) * N)));
};
#else
template <class T, std::size_t N>
struct Storage {
    using Type = std::array<T, N>;
};
#endif

}  // namespace detail

/// expects: N is a power of two, 2 to 16.
template <Lane T, std::size_t N>
struct Lanes {
    static_assert(std::has_single_bit(N) && N >= 2 && N <= 16);
    using value_type = T;
    using Mask = Lanes<detail::MaskOf<T>, N>;
    static constexpr std::size_t size = N;

    typename detail::Storage<T, N>::Type v;

    [[nodiscard, gnu::always_inline]] static Lanes all(T x) noexcept {
        Lanes r;
        for (std::size_t i = 0; i < N; ++i) r.v[i] = x;
        return r;
    }
    /// first, first + step, first + 2 step ...: each lane one product and one sum.
    [[nodiscard, gnu::always_inline]] static Lanes ramp(T first, T step) noexcept {
        Lanes r;
        for (std::size_t i = 0; i < N; ++i) r.v[i] = static_cast<T>(first + static_cast<T>(i) * step);
        return r;
    }
    /// expects: `from` holds N elements.
    [[nodiscard, gnu::always_inline]] static Lanes load(T const* from) noexcept {
        Lanes r;
        std::memcpy(&r.v, from, sizeof(r.v));
        return r;
    }
    [[gnu::always_inline]] void store(T* to) const noexcept { std::memcpy(to, &v, sizeof(v)); }
    [[nodiscard, gnu::always_inline]] T operator[](std::size_t i) const noexcept { return v[i]; }
};

#if GNOMON_VECTOR_EXTENSION
#define GNOMON_LANES_BINARY(op) \
    template <Lane T, std::size_t N> \
    [[nodiscard, gnu::always_inline]] inline Lanes<T, N> operator op(Lanes<T, N> const& a, \
                                                                     Lanes<T, N> const& b) noexcept { \
        return {a.v op b.v}; \
    }
#define GNOMON_LANES_COMPARE(op) \
    template <Lane T, std::size_t N> \
    [[nodiscard, gnu::always_inline]] inline typename Lanes<T, N>::Mask operator op( \
        Lanes<T, N> const& a, Lanes<T, N> const& b) noexcept { \
        return {a.v op b.v}; \
    }
#else
#define GNOMON_LANES_BINARY(op) \
    template <Lane T, std::size_t N> \
    [[nodiscard, gnu::always_inline]] inline Lanes<T, N> operator op(Lanes<T, N> const& a, \
                                                                     Lanes<T, N> const& b) noexcept { \
        Lanes<T, N> r; \
        for (std::size_t i = 0; i < N; ++i) r.v[i] = static_cast<T>(a.v[i] op b.v[i]); \
        return r; \
    }
#define GNOMON_LANES_COMPARE(op) \
    template <Lane T, std::size_t N> \
    [[nodiscard, gnu::always_inline]] inline typename Lanes<T, N>::Mask operator op( \
        Lanes<T, N> const& a, Lanes<T, N> const& b) noexcept { \
        typename Lanes<T, N>::Mask r; \
        for (std::size_t i = 0; i < N; ++i) r.v[i] = a.v[i] op b.v[i] ? -1 : 0; \
        return r; \
    }
#endif

GNOMON_LANES_BINARY(+)
GNOMON_LANES_BINARY(-)
GNOMON_LANES_BINARY(*)
GNOMON_LANES_BINARY(/)
GNOMON_LANES_BINARY(&)
GNOMON_LANES_BINARY(|)
GNOMON_LANES_BINARY(^)
GNOMON_LANES_COMPARE(<)
GNOMON_LANES_COMPARE(<=)
GNOMON_LANES_COMPARE(>)
GNOMON_LANES_COMPARE(>=)
GNOMON_LANES_COMPARE(==)
GNOMON_LANES_COMPARE(!=)

#undef GNOMON_LANES_BINARY
#undef GNOMON_LANES_COMPARE

template <Lane T, std::size_t N>
[[nodiscard, gnu::always_inline]] inline Lanes<T, N> operator-(Lanes<T, N> const& a) noexcept {
#if GNOMON_VECTOR_EXTENSION
    return {-a.v};
#else
    Lanes<T, N> r;
    for (std::size_t i = 0; i < N; ++i) r.v[i] = static_cast<T>(-a.v[i]);
    return r;
#endif
}

/// Each lane shifted up; expects: 0 <= places < the lane's width.
template <std::integral T, std::size_t N>
[[nodiscard, gnu::always_inline]] inline Lanes<T, N> operator<<(Lanes<T, N> const& a, int places) noexcept {
#if GNOMON_VECTOR_EXTENSION
    return {a.v << places};
#else
    Lanes<T, N> r;
    for (std::size_t i = 0; i < N; ++i) r.v[i] = static_cast<T>(a.v[i] << places);
    return r;
#endif
}

/// Each lane shifted down, with its sign where it has one; expects: 0 <= places < the lane's width.
template <std::integral T, std::size_t N>
[[nodiscard, gnu::always_inline]] inline Lanes<T, N> operator>>(Lanes<T, N> const& a, int places) noexcept {
#if GNOMON_VECTOR_EXTENSION
    return {a.v >> places};
#else
    Lanes<T, N> r;
    for (std::size_t i = 0; i < N; ++i) r.v[i] = static_cast<T>(a.v[i] >> places);
    return r;
#endif
}

/// The same bits, read as another type of the same size.
template <Lane To, Lane From, std::size_t N>
    requires(sizeof(To) == sizeof(From))
[[nodiscard, gnu::always_inline]] inline Lanes<To, N> bits_as(Lanes<From, N> const& a) noexcept {
    Lanes<To, N> r;
    std::memcpy(&r.v, &a.v, sizeof(r.v));
    return r;
}

/// Per lane `yes` where the mask is set, else `no`. No arithmetic: NaN and signed zeros pass through.
template <Lane T, std::size_t N>
[[nodiscard, gnu::always_inline]] inline Lanes<T, N> select(typename Lanes<T, N>::Mask const& mask,
                                                            Lanes<T, N> const& yes, Lanes<T, N> const& no) noexcept {
#if GNOMON_VECTOR_EXTENSION
    return {mask.v ? yes.v : no.v};
#else
    Lanes<T, N> r;
    for (std::size_t i = 0; i < N; ++i) r.v[i] = mask.v[i] != 0 ? yes.v[i] : no.v[i];
    return r;
#endif
}

/// Per lane `b < a ? b : a`: a NaN in `b` leaves `a`.
template <Lane T, std::size_t N>
[[nodiscard, gnu::always_inline]] inline Lanes<T, N> min(Lanes<T, N> const& a, Lanes<T, N> const& b) noexcept {
    return select(b < a, b, a);
}

/// Per lane `b > a ? b : a`: a NaN in `b` leaves `a`.
template <Lane T, std::size_t N>
[[nodiscard, gnu::always_inline]] inline Lanes<T, N> max(Lanes<T, N> const& a, Lanes<T, N> const& b) noexcept {
    return select(b > a, b, a);
}

/// One bit per lane, lane 0 lowest, of a mask (a comparison's result).
template <std::signed_integral T, std::size_t N>
[[nodiscard, gnu::always_inline]] inline std::uint32_t bits(Lanes<T, N> const& mask) noexcept {
    std::uint32_t r = 0;
#if GNOMON_VECTOR_EXTENSION && defined(__SSE2__)
    if constexpr (sizeof(T) == 4 && N >= 4) {  // compilers do not find the machine's instruction themselves
        typedef float Four __attribute__((vector_size(16)));
        for (std::size_t i = 0; i < N; i += 4) {
            Four part;
            std::memcpy(&part, reinterpret_cast<char const*>(&mask.v) + 4 * i, sizeof(part));
            r |= static_cast<std::uint32_t>(__builtin_ia32_movmskps(part)) << i;
        }
        return r;
    }
#endif
    for (std::size_t i = 0; i < N; ++i) r |= static_cast<std::uint32_t>(mask.v[i] < 0) << i;
    return r;
}

template <std::signed_integral T, std::size_t N>
[[nodiscard, gnu::always_inline]] inline bool any(Lanes<T, N> const& mask) noexcept {
    return bits(mask) != 0;
}

template <std::signed_integral T, std::size_t N>
[[nodiscard, gnu::always_inline]] inline bool all(Lanes<T, N> const& mask) noexcept {
    return bits(mask) == (N == 32 ? ~0U : (1U << N) - 1U);
}

/// Each lane converted as static_cast does.
///
/// expects: every lane fits `To`; a float that does not is undefined behaviour, as in plain C++.
template <Lane To, Lane From, std::size_t N>
[[nodiscard, gnu::always_inline]] inline Lanes<To, N> convert(Lanes<From, N> const& a) noexcept {
#if GNOMON_VECTOR_EXTENSION
    return {__builtin_convertvector(a.v, typename detail::Storage<To, N>::Type)};
#else
    Lanes<To, N> r;
    for (std::size_t i = 0; i < N; ++i) r.v[i] = static_cast<To>(a.v[i]);
    return r;
#endif
}

}  // namespace gnomon::math
