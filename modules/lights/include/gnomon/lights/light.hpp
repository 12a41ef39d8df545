#pragma once
// Lights as the assignment reads them, in culling space: x right, y DOWN, depth in front of the eye, relative to it.

#include <gnomon/math/vec.hpp>

#include <cmath>
#include <cstdint>

namespace gnomon::lights {

enum class Kind : std::uint32_t {
    point,        ///< the ball about `center` of `range_m`
    spot,         ///< that ball and a cone: directions v with angle(v, axis) <= atan2(sin_half, cos_half), 0 to pi
    directional,  ///< everywhere
    box,          ///< center + a u + b v + c w with |a|, |b|, |c| <= 1: a probe's or decal's volume
};

/// What lies in clusters: 80 bytes, five vec4 in a shader's storage buffer.
///
/// `axis` is of length 1 for a spot, up to rounding; for a box `axis`, `side` and `other` are the half axes u, v, w.
struct Light {
    math::vec3 center = math::vec3(0.0F);
    float range_m = 0.0F;
    math::vec3 axis = math::vec3(0.0F, 0.0F, 1.0F);
    float cos_half = -1.0F;
    math::vec3 side = math::vec3(0.0F);
    float sin_half = 0.0F;
    math::vec3 other = math::vec3(0.0F);
    Kind kind = Kind::point;
    std::uint32_t layers = ~0U;  ///< A light is assigned where `layers & config.layers` is not 0.
    float importance = 0.0F;     ///< The larger, the later it is left out where a fixed capacity overflows.
    std::uint32_t user[2] = {0, 0};
};

static_assert(sizeof(Light) == 80);

[[nodiscard]] inline Light make_point(math::vec3 const& center, float range_m) noexcept {
    Light l;
    l.center = center;
    l.range_m = range_m;
    return l;
}

/// `axis` of any length above 0. Angles of pi / 2 and more are whole balls to the assignment.
[[nodiscard]] inline Light make_spot(math::vec3 const& center, float range_m, math::vec3 const& axis, float half_angle_rad) noexcept {
    Light l = make_point(center, range_m);
    l.kind = Kind::spot;
    math::dvec3 const a = math::to_double(axis);
    l.axis = math::to_float(a / std::sqrt(a.x * a.x + a.y * a.y + a.z * a.z));
    l.cos_half = static_cast<float>(std::cos(static_cast<double>(half_angle_rad)));
    l.sin_half = static_cast<float>(std::sin(static_cast<double>(half_angle_rad)));
    return l;
}

/// Half axes of any length and direction; a parallelepiped where they are not at right angles.
[[nodiscard]] inline Light make_box(math::vec3 const& center, math::vec3 const& u, math::vec3 const& v, math::vec3 const& w) noexcept {
    Light l = make_point(center, 0.0F);
    l.kind = Kind::box;
    l.axis = u;
    l.side = v;
    l.other = w;
    return l;
}

[[nodiscard]] inline Light make_directional() noexcept {
    Light l;
    l.kind = Kind::directional;
    return l;
}

}  // namespace gnomon::lights
