#pragma once
// The smallest ball that holds a light, for tests that know balls alone.

#include <gnomon/lights/admit.hpp>
#include <gnomon/lights/light.hpp>
#include <gnomon/math/bounds.hpp>
#include <gnomon/math/scalar.hpp>

#include <cmath>
#include <limits>

namespace gnomon::lights {

/// The ball that holds all that a light reaches; a spot's is that of its sector, with c and s of its half angle:
///
///     c >= s:      centre apex + axis r / (2 c), radius r / (2 c)      through the apex and the rim
///     0 <= c < s:  centre apex + axis r c, radius r s                  about the rim
///
/// The radius is larger by 2^-21 of the coordinates' sum, which covers the rounding of centre and radius.
/// returns: radius -1 for a light that is not sound; an infinite one about the eye for a directional light
[[nodiscard]] inline math::Sphere bounding_ball(Light const& l) noexcept {
    if (!is_sound(l)) return {math::vec3(0.0F), -1.0F};
    if (l.kind == Kind::directional) return {math::vec3(0.0F), std::numeric_limits<float>::infinity()};
    math::Sphere ball{l.center, bounding_radius_m(l)};
    if (l.kind != Kind::spot || !(l.cos_half > 0.0F)) return ball;
    double const unit = std::hypot(static_cast<double>(l.cos_half), static_cast<double>(l.sin_half));
    double const c = static_cast<double>(l.cos_half) / unit, s = static_cast<double>(l.sin_half) / unit;
    double const r = static_cast<double>(l.range_m);
    math::dvec3 const axis = math::to_double(l.axis);
    double const along = (c >= s ? r / (2.0 * c) : r * c) / std::sqrt(axis.x * axis.x + axis.y * axis.y + axis.z * axis.z);
    ball.center = math::to_float(math::to_double(l.center) + axis * along);
    double const size = std::abs(static_cast<double>(ball.center.x)) + std::abs(static_cast<double>(ball.center.y)) +
                        std::abs(static_cast<double>(ball.center.z)) + r;
    ball.radius = math::next_up(static_cast<float>((c >= s ? r / (2.0 * c) : r * s) + 0x1p-21 * size));
    return ball;
}

}  // namespace gnomon::lights
