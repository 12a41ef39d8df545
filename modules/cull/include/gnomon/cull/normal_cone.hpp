#pragma once
// Rejecting lights that all surfaces of a cluster turn their backs to [Olsson 2014, Paper II, section 3.3].

#include <gnomon/cull/formula/normal_cone.glsl>
#include <gnomon/math/bounds.hpp>
#include <gnomon/math/touch.hpp>
#include <gnomon/math/vec.hpp>

#include <algorithm>
#include <cmath>

namespace gnomon::cull {

/// Holds every shading normal of a cluster: within the half angle, given by its cosine, of the axis.
struct NormalCone {
    math::vec3 axis = math::vec3(0.0F, 0.0F, 1.0F);  ///< A unit vector, to rounding.
    float cos_half_angle = -1.0F;                     ///< 0 or below, or NaN: no light is rejected.
};

[[nodiscard]] inline formula::GnNormalCone<float> formula_cone(NormalCone const& cone) noexcept {
    double const c = static_cast<double>(cone.cos_half_angle);
    double const sine = std::sqrt(std::max(0.0, 1.0 - c * c));
    return {formula::Vec3<float>(cone.axis), cone.cos_half_angle, math::detail::rounded(sine)};
}

/// The ball that stands for a cluster's samples: around the box, its radius rounded up.
[[nodiscard]] inline math::Sphere ball_of(math::Aabb const& box) noexcept {
    math::vec3 const center = math::center(box);
    math::dvec3 const lo = math::to_double(center) - math::to_double(box.lo);
    math::dvec3 const hi = math::to_double(box.hi) - math::to_double(center);
    double sum = 0.0;
    for (math::axis_t k = 0; k < 3; ++k) sum += std::max(lo[k], hi[k]) * std::max(lo[k], hi[k]);
    return {center, math::next_up(math::next_up(math::detail::rounded(std::sqrt(sum))))};
}

/// Whether a light at `light` may shine on the front of any surface whose points are in `samples` and whose normals are in
/// `cone`. A NaN anywhere keeps the light.
///
///     rejects where omega > pi/2 + alpha + delta, in cosines
///
/// source: [Olsson 2014, Paper II, section 3.3, figure 7]; the cone must hold the normals that shading uses
[[nodiscard]] inline bool may_face(NormalCone const& cone, math::Sphere const& samples, math::vec3 const& light) noexcept {
    return gn_may_face(formula_cone(cone), math::formula_sphere(samples), formula::Vec3<float>(light)).v;
}

/// The same for a directional light; `toward` is a unit vector toward it.
[[nodiscard]] inline bool may_face(NormalCone const& cone, math::vec3 const& toward) noexcept {
    return gn_may_face_direction(formula_cone(cone), formula::Vec3<float>(toward)).v;
}

}  // namespace gnomon::cull
