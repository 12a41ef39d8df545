#pragma once
// Sine and cosine from additions and products alone, in a fixed order: libm's differ between machines.

#include <gnomon/math/vec.hpp>

#include <cmath>

namespace gnomon::scene::detail {

struct SinCos {
    double sin = 0.0;
    double cos = 1.0;
};

/// Of `turns` full turns; within 1e-15, and exact at whole quarters.
///
/// source: the Taylor series up to x^17, for |x| <= pi / 4.
/// expects: |turns| below 2^50.
inline SinCos sin_cos(double turns) noexcept {
    double const quarters = std::floor(turns * 4.0 + 0.5);
    double const x = (turns * 4.0 - quarters) * 1.5707963267948966;
    double const xx = x * x;
    double sin = 0.0;
    double cos = 0.0;
    for (int n = 16; n >= 2; n -= 2) {
        sin = xx / (n * (n + 1)) * (1.0 - sin);
        cos = xx / (n * (n - 1)) * (1.0 - cos);
    }
    double const s = x * (1.0 - sin);
    double const c = 1.0 - cos;
    double const quarter = quarters - 4.0 * std::floor(quarters * 0.25);
    if (quarter == 0.0) return {s, c};
    if (quarter == 1.0) return {c, -s};
    if (quarter == 2.0) return {-s, -c};
    return {-c, s};
}

/// A level direction: 0 turns is +x, a quarter is -z, so that turns count counter-clockwise seen from above.
inline math::dvec3 level_direction(double turns) noexcept {
    SinCos const a = sin_cos(turns);
    return {a.cos, 0.0, -a.sin};
}

inline constexpr double turns_per_degree = 1.0 / 360.0;

/// 0 for t <= 0, 1 for t >= 1, with a level start and end.
inline double smooth_step(double t) noexcept {
    double const x = t < 0.0 ? 0.0 : t > 1.0 ? 1.0 : t;
    return x * x * (3.0 - 2.0 * x);
}

}  // namespace gnomon::scene::detail
