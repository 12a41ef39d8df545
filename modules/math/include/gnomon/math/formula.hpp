#pragma once
// The types that a formula file is written in, as C++ sees them: numbers over a scalar type S that is float, double or
// math::Lanes<float, N>. Every operation is the IEEE one per lane, so that all of them give float's bits.
//
// Formula files are found by their suffix: gnomon/<module>/formula/<x>.glsl. Each is GLSL 4.50 too; see
// formula.glsl for the words that the two languages spell differently. Everything stands in gnomon::formula: one space
// of names, as in GLSL. Programs call the wrappers in each module's headers and need none of this.

#include <gnomon/math/detail/formula_ops.hpp>
#include <gnomon/math/lanes.hpp>
#include <gnomon/math/vec.hpp>

#include <concepts>
#include <cstddef>
#include <cstdint>

// Inlined for certain, as math::Lanes is.
#define GNOMON_OP [[gnu::always_inline]] friend constexpr

namespace gnomon::formula {

// The same for all lanes.
using uint = std::uint32_t;
using math::mat4;
using math::vec2;
using math::vec3;
using math::vec4;

[[nodiscard]] constexpr float abs(float x) noexcept { return detail::magnitude(x); }
[[nodiscard]] constexpr float gn_min(float a, float b) noexcept { return b < a ? b : a; }
[[nodiscard]] constexpr float gn_max(float a, float b) noexcept { return b > a ? b : a; }
[[nodiscard]] constexpr float gn_div(float a, float b) noexcept { return a / b; }

template <class S>
struct Float;
template <class S>
struct Int;
template <class S>
struct Uint;

template <class S>
struct Bool {
    using Type = typename detail::Scalar<S>::Bool;
    Type v;

    constexpr Bool() noexcept = default;
    template <detail::OneOf<Type, bool> X>
    [[gnu::always_inline]] constexpr Bool(X const& x) noexcept : v(detail::spread<Type>(x)) {}

    // No short cut: both sides are computed, as in every lane.
    GNOMON_OP Bool operator&&(Bool const& a, Bool const& b) noexcept { return detail::both(a.v, b.v); }
    GNOMON_OP Bool operator||(Bool const& a, Bool const& b) noexcept { return detail::either(a.v, b.v); }
    GNOMON_OP Bool operator!(Bool const& a) noexcept { return detail::inverted(a.v); }
    GNOMON_OP bool gn_any(Bool const& a) noexcept { return detail::is_any(a.v); }

    GNOMON_OP Float<S> gn_select(Bool const& m, Float<S> const& yes, Float<S> const& no) noexcept {
        return detail::chosen(m.v, yes.v, no.v);
    }
    GNOMON_OP Int<S> gn_select(Bool const& m, Int<S> const& yes, Int<S> const& no) noexcept {
        return detail::chosen(m.v, yes.v, no.v);
    }
    GNOMON_OP Uint<S> gn_select(Bool const& m, Uint<S> const& yes, Uint<S> const& no) noexcept {
        return detail::chosen(m.v, yes.v, no.v);
    }
    GNOMON_OP Bool gn_select(Bool const& m, Bool const& yes, Bool const& no) noexcept {
        return (m && yes) || (!m && no);
    }
};

#define GNOMON_FORMULA_COMPARISONS(T) \
    GNOMON_OP Bool<S> operator<(T const& a, T const& b) noexcept { return {a.v < b.v}; } \
    GNOMON_OP Bool<S> operator<=(T const& a, T const& b) noexcept { return {a.v <= b.v}; } \
    GNOMON_OP Bool<S> operator>(T const& a, T const& b) noexcept { return {a.v > b.v}; } \
    GNOMON_OP Bool<S> operator>=(T const& a, T const& b) noexcept { return {a.v >= b.v}; } \
    GNOMON_OP Bool<S> operator==(T const& a, T const& b) noexcept { return {a.v == b.v}; } \
    GNOMON_OP Bool<S> operator!=(T const& a, T const& b) noexcept { return {a.v != b.v}; }

#define GNOMON_FORMULA_RING(T) \
    GNOMON_OP T operator+(T const& a, T const& b) noexcept { return {a.v + b.v}; } \
    GNOMON_OP T operator-(T const& a, T const& b) noexcept { return {a.v - b.v}; } \
    GNOMON_OP T operator*(T const& a, T const& b) noexcept { return {a.v * b.v}; }

#define GNOMON_FORMULA_BITS(T) \
    GNOMON_OP T operator&(T const& a, T const& b) noexcept { return {a.v & b.v}; } \
    GNOMON_OP T operator|(T const& a, T const& b) noexcept { return {a.v | b.v}; } \
    GNOMON_OP T operator^(T const& a, T const& b) noexcept { return {a.v ^ b.v}; } \
    GNOMON_OP T operator<<(T const& a, int places) noexcept { return {a.v << places}; } \
    GNOMON_OP T operator>>(T const& a, int places) noexcept { return {a.v >> places}; }

template <class S>
struct Int {
    using Type = typename detail::Scalar<S>::Int;
    Type v;

    constexpr Int() noexcept = default;
    template <detail::OneOf<Type, std::int32_t> X>
    [[gnu::always_inline]] constexpr Int(X const& x) noexcept : v(detail::spread<Type>(x)) {}
    /// Toward zero; expects: it fits.
    [[gnu::always_inline]] explicit constexpr Int(Float<S> const& x) noexcept : v(detail::converted<Type>(x.v)) {}
    [[gnu::always_inline]] explicit constexpr Int(Uint<S> const& x) noexcept : v(detail::same_bits<Type>(x.v)) {}

    GNOMON_FORMULA_RING(Int)
    GNOMON_FORMULA_BITS(Int)
    GNOMON_FORMULA_COMPARISONS(Int)
    GNOMON_OP Int operator-(Int const& a) noexcept { return {-a.v}; }
    GNOMON_OP Int gn_min(Int const& a, Int const& b) noexcept { return gn_select(b < a, b, a); }
    GNOMON_OP Int gn_max(Int const& a, Int const& b) noexcept { return gn_select(b > a, b, a); }
};

/// Wraps round at 2^32.
template <class S>
struct Uint {
    using Type = typename detail::Scalar<S>::Uint;
    Type v;

    constexpr Uint() noexcept = default;
    template <detail::OneOf<Type, std::uint32_t> X>
    [[gnu::always_inline]] constexpr Uint(X const& x) noexcept : v(detail::spread<Type>(x)) {}
    /// Toward zero; expects: it fits.
    [[gnu::always_inline]] explicit constexpr Uint(Float<S> const& x) noexcept : v(detail::converted<Type>(x.v)) {}
    [[gnu::always_inline]] explicit constexpr Uint(Int<S> const& x) noexcept : v(detail::same_bits<Type>(x.v)) {}

    GNOMON_FORMULA_RING(Uint)
    GNOMON_FORMULA_BITS(Uint)
    GNOMON_FORMULA_COMPARISONS(Uint)
    GNOMON_OP Uint gn_min(Uint const& a, Uint const& b) noexcept { return gn_select(b < a, b, a); }
    GNOMON_OP Uint gn_max(Uint const& a, Uint const& b) noexcept { return gn_select(b > a, b, a); }
    GNOMON_OP Float<S> uintBitsToFloat(Uint const& x) noexcept { return detail::same_bits<S>(x.v); }
};

/// A literal, which C++ reads as a double, becomes an S; so does a float that is the same for all lanes.
///
/// No operator /: GLSL's is not IEEE's; `gn_div` and `gn_sqrt` are, in both languages.
template <class S>
struct Float {
    S v;

    constexpr Float() noexcept = default;
    template <detail::OneOf<S, float, double> X>
    [[gnu::always_inline]] constexpr Float(X const& x) noexcept : v(detail::spread<S>(x)) {}
    template <detail::OneOf<std::int32_t, std::uint32_t> X>
    [[gnu::always_inline]] explicit constexpr Float(X x) noexcept : v(detail::spread<S>(x)) {}
    [[gnu::always_inline]] explicit constexpr Float(Int<S> const& x) noexcept : v(detail::converted<S>(x.v)) {}
    [[gnu::always_inline]] explicit constexpr Float(Uint<S> const& x) noexcept : v(detail::converted<S>(x.v)) {}

    GNOMON_FORMULA_RING(Float)
    GNOMON_FORMULA_COMPARISONS(Float)
    GNOMON_OP Float operator-(Float const& a) noexcept { return {-a.v}; }
    GNOMON_OP Float gn_min(Float const& a, Float const& b) noexcept { return gn_select(b < a, b, a); }
    GNOMON_OP Float gn_max(Float const& a, Float const& b) noexcept { return gn_select(b > a, b, a); }
    GNOMON_OP Float gn_div(Float const& a, Float const& b) noexcept { return {a.v / b.v}; }
    GNOMON_OP Float gn_sqrt(Float const& a) noexcept { return detail::root(a.v); }
    GNOMON_OP Float abs(Float const& a) noexcept { return detail::magnitude(a.v); }
    GNOMON_OP Uint<S> floatBitsToUint(Float const& a) noexcept {
        return detail::same_bits<typename Uint<S>::Type>(a.v);
    }
};

#undef GNOMON_FORMULA_COMPARISONS
#undef GNOMON_FORMULA_RING
#undef GNOMON_FORMULA_BITS

template <class S>
struct Vec2 {
    Float<S> x, y;

    constexpr Vec2() noexcept = default;
    [[gnu::always_inline]] constexpr Vec2(Float<S> const& x_, Float<S> const& y_) noexcept : x(x_), y(y_) {}
    [[gnu::always_inline]] explicit constexpr Vec2(vec2 const& p) noexcept : x(p.x), y(p.y) {}
    [[gnu::always_inline]] explicit constexpr operator vec2() const noexcept requires std::same_as<S, float> { return vec2(x.v, y.v); }

    GNOMON_OP Vec2 operator+(Vec2 const& a, Vec2 const& b) noexcept { return {a.x + b.x, a.y + b.y}; }
    GNOMON_OP Vec2 operator-(Vec2 const& a, Vec2 const& b) noexcept { return {a.x - b.x, a.y - b.y}; }
    GNOMON_OP Vec2 operator*(Vec2 const& a, Float<S> const& s) noexcept { return {a.x * s, a.y * s}; }
};

template <class S>
struct Vec3 {
    Float<S> x, y, z;

    constexpr Vec3() noexcept = default;
    [[gnu::always_inline]] constexpr Vec3(Float<S> const& x_, Float<S> const& y_, Float<S> const& z_) noexcept : x(x_), y(y_), z(z_) {}
    [[gnu::always_inline]] explicit constexpr Vec3(vec3 const& p) noexcept : x(p.x), y(p.y), z(p.z) {}
    [[gnu::always_inline]] explicit constexpr operator vec3() const noexcept requires std::same_as<S, float> { return vec3(x.v, y.v, z.v); }

    GNOMON_OP Vec3 operator+(Vec3 const& a, Vec3 const& b) noexcept { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
    GNOMON_OP Vec3 operator-(Vec3 const& a, Vec3 const& b) noexcept { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
    GNOMON_OP Vec3 operator*(Vec3 const& a, Float<S> const& s) noexcept { return {a.x * s, a.y * s, a.z * s}; }
    GNOMON_OP Vec3 operator-(Vec3 const& a) noexcept { return {-a.x, -a.y, -a.z}; }
};

template <class S>
struct Vec4 {
    Float<S> x, y, z, w;

    constexpr Vec4() noexcept = default;
    [[gnu::always_inline]] constexpr Vec4(Float<S> const& x_, Float<S> const& y_, Float<S> const& z_, Float<S> const& w_) noexcept
        : x(x_), y(y_), z(z_), w(w_) {}
    [[gnu::always_inline]] explicit constexpr Vec4(vec4 const& p) noexcept : x(p.x), y(p.y), z(p.z), w(p.w) {}
    [[gnu::always_inline]] explicit constexpr operator vec4() const noexcept requires std::same_as<S, float> { return vec4(x.v, y.v, z.v, w.v); }

    GNOMON_OP Vec4 operator+(Vec4 const& a, Vec4 const& b) noexcept {
        return {a.x + b.x, a.y + b.y, a.z + b.z, a.w + b.w};
    }
    GNOMON_OP Vec4 operator*(Vec4 const& a, Float<S> const& s) noexcept {
        return {a.x * s, a.y * s, a.z * s, a.w * s};
    }
};

/// A table of words, as a shader has it in a storage buffer. Owns nothing.
struct Words {
    std::uint32_t const* data = nullptr;
};

/// What GN_WORD is in C++: one load for each lane.
///
/// expects: `i` within the table.
template <class S>
[[nodiscard, gnu::always_inline]] constexpr Uint<S> gn_word(Words const& words, Uint<S> const& i) noexcept {
    if constexpr (requires { S::size; }) {
        std::uint32_t loaded[S::size]{};
        for (std::size_t lane = 0; lane < S::size; ++lane) loaded[lane] = words.data[i.v[lane]];
        return {Uint<S>::Type::load(loaded)};
    } else {
        return {words.data[i.v]};
    }
}

}  // namespace gnomon::formula

#undef GNOMON_OP
