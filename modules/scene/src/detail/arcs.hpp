#pragma once
// Angles by + - * / and square roots alone: the C library's sines differ between machines in their last bits, and with
// them every triangle of a turning object would.

#include <gnomon/math/vec.hpp>

#include <cmath>

namespace gnomon::scene::detail {

/// atan x for 0 <= x <= 1, within some 4e-16.
///
///     atan x = 2 atan(x / (1 + sqrt(1 + x^2))), twice; then the series, whose argument is at most tan(pi/16)
inline double arc_tangent(double x) noexcept {
    x = x / (1.0 + std::sqrt(1.0 + x * x));
    x = x / (1.0 + std::sqrt(1.0 + x * x));
    double const sq = x * x;
    double sum = 0.0;
    for (int n = 23; n > 0; n -= 2) sum = 1.0 / n - sq * sum;
    return 4.0 * (x * sum);
}

/// sin x for 0 <= x <= pi/2, within some 4e-16.
///
///     sin x = 2 sin(x/2) cos(x/2), both by their series
inline double sine(double x) noexcept {
    double const half = x * 0.5;
    double const sq = half * half;
    double s = 1.0;
    double c = 1.0;
    for (int n = 18; n > 0; n -= 2) {
        s = 1.0 - sq * s / (n * (n + 1));
        c = 1.0 - sq * c / (n * (n - 1));
    }
    return 2.0 * (half * s) * c;
}

/// `q` with length 1; no turn where it has none.
inline math::dvec4 unit_rotation(math::dvec4 const& q) noexcept {
    double const length = std::sqrt(((q.x * q.x + q.y * q.y) + q.z * q.z) + q.w * q.w);
    return length > 0.0 && length <= 1e300 ? q / length : math::dvec4(0.0, 0.0, 0.0, 1.0);
}

/// The rotation a part `t` of the way from `from` to `to`, along the shorter great arc.
///
///     (sin((1-t) w) from + sin(t w) to) / sin w, w the angle between them on the 3-sphere
///
/// source:  [glTF 2.0, appendix C.4]; the angle by [Kahan 2006, section 12], exact for small ones too
/// expects: unit quaternions, 0 <= t <= 1.
inline math::dvec4 slerp(math::dvec4 const& from, math::dvec4 to, double t) noexcept {
    double const cosine = ((from.x * to.x + from.y * to.y) + from.z * to.z) + from.w * to.w;
    if (cosine < 0.0) to = -to;
    auto const length = [](math::dvec4 const& v) {
        return std::sqrt(((v.x * v.x + v.y * v.y) + v.z * v.z) + v.w * v.w);
    };
    double const angle = 2.0 * arc_tangent(length(to - from) / length(to + from));
    double const whole = sine(angle);
    // Below this the arc is straight to the last bit of a double.
    if (angle < 1e-9) return unit_rotation(from * (1.0 - t) + to * t);
    return unit_rotation(from * (sine((1.0 - t) * angle) / whole) + to * (sine(t * angle) / whole));
}

}  // namespace gnomon::scene::detail
