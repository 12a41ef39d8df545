#pragma once
// What a light gives to a surface. The formula, and what the numbers mean, are in formula/shade.glsl.

#include <gnomon/lights/formula/shade.glsl>
#include <gnomon/math/vec.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <type_traits>

namespace gnomon::lights {

/// A light as shading reads it; in the same space as the surfaces.
using ShadedLight = formula::GnShadedLight;

static_assert(sizeof(ShadedLight) == 64 && std::is_trivially_copyable_v<ShadedLight>);
static_assert(offsetof(ShadedLight, axis) == 32 && offsetof(ShadedLight, directional) == 48);

/// `range_m` above 0, or infinite for a light without an end.
[[nodiscard]] inline ShadedLight make_shaded_point(math::vec3 const& position, float range_m, math::vec3 const& color) noexcept {
    ShadedLight l{};
    l.position = position;
    l.inverse_range_sq = static_cast<float>(1.0 / (static_cast<double>(range_m) * static_cast<double>(range_m)));
    l.color = color;
    l.cos_outer = -2.0F;
    l.axis = math::vec3(0.0F, 0.0F, 1.0F);
    l.inverse_span = 1.0F;
    return l;
}

/// Half angles of a spot's cone: full strength within the inner, none beyond the outer.
struct ConeAngles {
    float inner_rad = 0.0F;
    float outer_rad = 0.78539816339744831F;
};

/// `axis`: where the spot shines, of any length above 0.
[[nodiscard]] inline ShadedLight make_shaded_spot(math::vec3 const& position, float range_m, math::vec3 const& color,
                                                  math::vec3 const& axis, ConeAngles const& cone) noexcept {
    ShadedLight l = make_shaded_point(position, range_m, color);
    l.axis = math::to_float(glm::normalize(math::to_double(axis)));
    l.cos_outer = std::cos(cone.outer_rad);
    l.inverse_span = 1.0F / std::max(std::cos(std::min(cone.inner_rad, cone.outer_rad)) - l.cos_outer, 1e-4F);
    return l;
}

/// `direction`: where the light goes, of any length above 0.
[[nodiscard]] inline ShadedLight make_shaded_directional(math::vec3 const& direction, math::vec3 const& color) noexcept {
    ShadedLight l = make_shaded_point(math::to_float(-glm::normalize(math::to_double(direction))), 1.0F, color);
    l.inverse_range_sq = 0.0F;
    l.directional = 1;
    return l;
}

/// A surface as shading reads it.
struct Surface {
    math::vec3 position = math::vec3(0.0F);
    math::vec3 normal = math::vec3(0.0F, 1.0F, 0.0F);
    math::vec3 to_eye = math::vec3(0.0F, 1.0F, 0.0F);
    math::vec3 diffuse = math::vec3(1.0F);
    math::vec3 specular = math::vec3(0.0F);
    int shininess = 5;  ///< The exponent is 2^shininess; 0 to 10.
};

/// (m + 8) / 8 for the exponent m = 2^shininess: what keeps a highlight's energy.
///
/// source: [Akenine-Moeller et al. 2008, Real-Time Rendering, 7.6], as the field uses it
[[nodiscard]] inline float highlight_scale(int shininess) noexcept {
    return (static_cast<float>(1 << shininess) + 8.0F) * 0.125F;
}

/// What `light` adds to the radiance of `surface` toward the eye, linear.
///
/// returns: 0 beyond the light's range or cone, and on the far side of the surface
[[nodiscard]] inline math::vec3 shade(ShadedLight const& light, Surface const& surface) noexcept {
    formula::GnSurface<float> const s{formula::Vec3<float>(surface.position), formula::Vec3<float>(surface.normal),
                                      formula::Vec3<float>(surface.to_eye), formula::Vec3<float>(surface.diffuse),
                                      formula::Vec3<float>(surface.specular * highlight_scale(surface.shininess)),
                                      formula::Float<float>(static_cast<float>(surface.shininess))};
    return math::vec3(gn_shade(light, s));
}

}  // namespace gnomon::lights
