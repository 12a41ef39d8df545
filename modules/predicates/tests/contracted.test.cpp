// Compiles the same headers a second time, with FMA instructions and -ffp-contract=fast, in a namespace of their own
// (inline functions of two builds must not share names).

#include "contracted.hpp"

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include <array>
#include <atomic>
#include <bit>
#include <cfloat>
#include <cmath>
#include <compare>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <limits>
#include <span>
#include <type_traits>
#include <utility>

#if defined(__x86_64__) && defined(__clang__)
#pragma clang attribute push(__attribute__((target("fma"))), apply_to = function)
#pragma clang fp contract(fast)
#define GNOMON_TEST_HAS_FMA 1
#elif defined(__x86_64__) && defined(__GNUC__)
#pragma GCC push_options
#pragma GCC target("fma")
#pragma GCC optimize("O2", "fp-contract=fast")
#define GNOMON_TEST_HAS_FMA 1
#else
#define GNOMON_TEST_HAS_FMA 0
#endif

#define gnomon gnomon_contracted
#include <gnomon/predicates.hpp>

namespace contracted {

namespace {

using gnomon::math::vec2;
using gnomon::math::vec3;
using gnomon::predicates::Target;

vec3 to_vec(oracle::Point const& p) { return vec3(p[0], p[1], p[2]); }

Target to_target(oracle::Point const& p, bool at_infinity) {
    return at_infinity ? Target::direction(to_vec(p)) : Target::point(to_vec(p));
}

}  // namespace

int orient2d(float ax, float ay, float bx, float by, float cx, float cy) {
    return static_cast<int>(gnomon::predicates::orient2d(vec2(ax, ay), vec2(bx, by), vec2(cx, cy)));
}

int orient3d(oracle::Point const& a, oracle::Point const& b, oracle::Point const& c, oracle::Point const& d,
             bool at_infinity) {
    return static_cast<int>(
        gnomon::predicates::orient3d(to_vec(a), to_vec(b), to_vec(c), to_target(d, at_infinity)));
}

int line_side(oracle::Point const& start, oracle::Point const& end, bool at_infinity, oracle::Point const& a,
              oracle::Point const& b) {
    return static_cast<int>(
        gnomon::predicates::line_side(to_vec(start), to_target(end, at_infinity), to_vec(a), to_vec(b)));
}

int edge_plane_side(oracle::Point const& p, oracle::Point const& light, bool at_infinity, oracle::Point const& a,
                    oracle::Point const& b) {
    auto const plane = gnomon::predicates::make_edge_plane(to_vec(a), to_vec(b), to_target(light, at_infinity));
    return static_cast<int>(gnomon::predicates::side(plane, to_vec(p)));
}

int fuses(double a, double b, double c) {
    double const product = a * b;
    return product + c == 0.0 ? 0 : 1;
}

}  // namespace contracted

#undef gnomon
#if GNOMON_TEST_HAS_FMA && defined(__clang__)
#pragma clang attribute pop
#elif GNOMON_TEST_HAS_FMA
#pragma GCC pop_options
#endif

namespace contracted {

bool is_available() {
#if GNOMON_TEST_HAS_FMA
    return __builtin_cpu_supports("fma") != 0;
#else
    return false;
#endif
}

}  // namespace contracted
