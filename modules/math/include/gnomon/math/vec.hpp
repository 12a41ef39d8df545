#pragma once
// Vectors and matrices: GLM's, always with the packed qualifier.
//
// `glm::vec3` changes size and alignment with GLM's configuration macros; these types never do, so a component and
// the engine that includes it may disagree about the macros. Column-major matrices, column vectors.

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include <cstddef>
#include <cstdint>

namespace gnomon::math {

using vec2 = glm::vec<2, float, glm::packed_highp>;
using vec3 = glm::vec<3, float, glm::packed_highp>;
using vec4 = glm::vec<4, float, glm::packed_highp>;
using dvec2 = glm::vec<2, double, glm::packed_highp>;
using dvec3 = glm::vec<3, double, glm::packed_highp>;
using dvec4 = glm::vec<4, double, glm::packed_highp>;
using ivec2 = glm::vec<2, std::int32_t, glm::packed_highp>;
using ivec3 = glm::vec<3, std::int32_t, glm::packed_highp>;
using uvec2 = glm::vec<2, std::uint32_t, glm::packed_highp>;
using uvec3 = glm::vec<3, std::uint32_t, glm::packed_highp>;
using mat3 = glm::mat<3, 3, float, glm::packed_highp>;
using mat4 = glm::mat<4, 4, float, glm::packed_highp>;
using dmat3 = glm::mat<3, 3, double, glm::packed_highp>;
using dmat4 = glm::mat<4, 4, double, glm::packed_highp>;
using axis_t = glm::length_t;  ///< What `v[axis]` takes: int, or size_t under GLM_FORCE_SIZE_T_LENGTH.

static_assert(sizeof(vec3) == 12 && alignof(vec3) == 4 && sizeof(vec4) == 16 && alignof(vec4) == 4);
static_assert(sizeof(dvec3) == 24 && alignof(dvec3) == alignof(double) && sizeof(mat4) == 64 && alignof(mat4) == 4);

/// Exact: every float is a double.
[[nodiscard]] inline dvec3 to_double(vec3 const& v) noexcept {
    return dvec3(static_cast<double>(v.x), static_cast<double>(v.y), static_cast<double>(v.z));
}

namespace detail {

/// `x` rounded to float, for certain. GCC 12 at -O2 vectorizes pairs of conversions double -> float -> double and then
/// drops both as if nothing had been rounded; a value that passes through an empty asm is one it must compute.
[[nodiscard]] inline float rounded(double x) noexcept {
    auto value = static_cast<float>(x);
#if defined(__GNUC__) && !defined(__clang__)
#if defined(__SSE__)
    __asm__("" : "+x"(value));
#else
    __asm__("" : "+m"(value));
#endif
#endif
    return value;
}

}  // namespace detail

/// Each component rounded to the nearest float.
[[nodiscard]] inline vec3 to_float(dvec3 const& v) noexcept {
    return vec3(detail::rounded(v.x), detail::rounded(v.y), detail::rounded(v.z));
}

/// Each element rounded to the nearest float.
[[nodiscard]] inline mat4 to_float(dmat4 const& m) noexcept {
    mat4 rounded(1.0F);
    for (axis_t column = 0; column < 4; ++column)
        for (axis_t row = 0; row < 4; ++row) rounded[column][row] = static_cast<float>(m[column][row]);
    return rounded;
}

}  // namespace gnomon::math
