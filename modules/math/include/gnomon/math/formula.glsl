// The words that make one text a formula in two languages: GLSL 4.50 and C++20 templated over the scalar type.
//
//     #include <gnomon/math/formula.glsl>        in GLSL: #extension GL_GOOGLE_include_directive : require
//     GN_BEGIN
//     GN_FN GN_FLOAT gn_lerp(GN_FLOAT a, GN_FLOAT b, GN_FLOAT t) {
//         GN_PRECISE GN_FLOAT r = a + (b - a) * t;
//         return r;
//     }
//     GN_END
//
// Upper case types differ from lane to lane (C++: float, math::Lanes, double); the plain int, uint, float, bool, vec2
// ... mat4 are the same for all lanes. The table of all words, and the rules of the text, are in this module's README.

#ifndef GNOMON_MATH_FORMULA_GLSL
#define GNOMON_MATH_FORMULA_GLSL

#ifdef __cplusplus

#include <gnomon/math/formula.hpp>

// A literal times a plain float would be computed in double: an error, as GLSL has no such promotion. Wide lanes as
// arguments are passed as each target passes them; nothing here is called across objects compiled for different ones.
#define GN_BEGIN                                           \
    _Pragma("GCC diagnostic push")                         \
    _Pragma("GCC diagnostic error \"-Wdouble-promotion\"") \
    _Pragma("GCC diagnostic ignored \"-Wpsabi\"")          \
    namespace gnomon::formula {
#define GN_END \
    }          \
    _Pragma("GCC diagnostic pop")
#define GN_FN template <class S> [[nodiscard, gnu::always_inline]] constexpr
#define GN_PLAIN_FN [[nodiscard]] constexpr
#define GN_PLAIN_VEC_FN [[nodiscard]] inline  // some of GLM's macros make constructors of vectors not constexpr
#define GN_STRUCT(name) template <class S> struct name
#define GN_TYPE(name) name<S>
#define GN_FLOAT Float<S>
#define GN_INT Int<S>
#define GN_UINT Uint<S>
#define GN_BOOL Bool<S>
#define GN_VEC2 Vec2<S>
#define GN_VEC3 Vec3<S>
#define GN_VEC4 Vec4<S>
#define GN_PRECISE
#define GN_SELECT(mask, yes, no) gn_select(mask, yes, no)
#define GN_ANY(mask) gn_any(mask)
#define GN_IN(type) type const&
#define GN_TEXELS_FN template <class S, class T> [[nodiscard, gnu::always_inline]] constexpr
#define GN_TEXELS T const&
#define GN_TEXEL(texels, x, y) gn_texel(texels, x, y)
#define GN_WORDS_FN template <class S> [[nodiscard, gnu::always_inline]] constexpr
#define GN_WORDS Words const&
#define GN_WORD(words, i) gn_word(words, i)

#else

#define GN_BEGIN
#define GN_END
#define GN_FN
#define GN_PLAIN_FN
#define GN_PLAIN_VEC_FN
#define GN_STRUCT(name) struct name
#define GN_TYPE(name) name
#define GN_FLOAT float
#define GN_INT int
#define GN_UINT uint
#define GN_BOOL bool
#define GN_VEC2 vec2
#define GN_VEC3 vec3
#define GN_VEC4 vec4
#define GN_PRECISE precise
#define GN_SELECT(mask, yes, no) mix(no, yes, mask)
#define GN_ANY(mask) (mask)
#define GN_IN(type) type
#define GN_TEXELS_FN
#define GN_WORDS_FN

// What C++ has from formula.hpp: the least and the greatest, with a NaN in `b` leaving `a`.
float gn_min(float a, float b) { return mix(a, b, b < a); }
float gn_max(float a, float b) { return mix(a, b, b > a); }
int gn_min(int a, int b) { return min(a, b); }
int gn_max(int a, int b) { return max(a, b); }
uint gn_min(uint a, uint b) { return min(a, b); }
uint gn_max(uint a, uint b) { return max(a, b); }

#include <gnomon/math/formula/exact.glsl>

#endif
#endif  // GNOMON_MATH_FORMULA_GLSL
