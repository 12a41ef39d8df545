#pragma once
// A receiver as the shadow map sees it: where it falls, how deep it lies, and how its own plane runs through the map.
//
// The plane comes from the geometric normal, not from screen-space differences, so it is right at depth edges too.

#include <gnomon/shadow/map_view.hpp>

#include <cmath>

namespace gnomon::shadow {

/// Steeper planes count as this steep: tan of 89.94 degrees. Beyond, a texel of 1 cm spans 10 m of depth.
inline constexpr float max_tan = 1000.0F;

struct Receiver {
    math::vec2 texel{0.0F};     ///< Image point in texels; a texel's centre is at +0.5, y down.
    float depth = 0.0F;         ///< As the map stores it, not clamped.
    math::vec2 gradient{0.0F};  ///< Depth of the receiver's plane per texel to the right and down.
    float distance_m = 0.0F;    ///< Along the map's axis of sight.
    float per_axis = 1.0F;      ///< Metres along the light's ray for each along the axis of sight.
    float texel_m = 0.0F;       ///< World size of a texel here, the longer side.
    float depth_per_m = 0.0F;   ///< |d depth / d distance| here.
    float cos_angle = 0.0F;     ///< Of the normal with the direction to the light; < 0: the plane faces away.
    float tan_angle = 0.0F;     ///< At most `max_tan`.
    bool in_front = false;      ///< Of the light's own plane; otherwise the map says nothing.
};

/// Projects `position` and its plane into the map.
///
///     orthographic: d = (n.r x + n.u y - h) / n.b      depth = scale d + offset
///     perspective:  1/d = (n.r a + n.u b - n.b) / h    depth = scale + offset / d      h = n . relative
///
/// In both the depth of a plane is an affine function of the image point, with gradient
///
///     k n.r texel.x,  -k n.u texel.y      k = scale / n.b  or  offset / h
///
/// The denominator is kept at or above 1 / `max_tan` of its largest value, so a plane seen edge on has a finite one.
/// expects: a unit normal. A NaN gives a receiver that is not in front.
[[nodiscard]] inline Receiver receiver_at(MapView const& map, math::vec3 const& position,
                                          math::vec3 const& normal) noexcept {
    math::vec3 const relative = position - map.eye;
    math::vec4 const clip = map.clip_from_relative * math::vec4(relative.x, relative.y, relative.z, 1.0F);
    float const distance = -glm::dot(map.back, relative);
    Receiver at;
    at.in_front = clip.w > 0.0F;
    if (!at.in_front) return at;
    float const inverse_w = 1.0F / clip.w;
    at.texel.x = (clip.x * inverse_w * 0.5F + 0.5F) * map.size_px.x;
    at.texel.y = (clip.y * inverse_w * 0.5F + 0.5F) * map.size_px.y;
    at.depth = clip.z * inverse_w;
    at.distance_m = distance;

    float const longest = map.texel.x > map.texel.y ? map.texel.x : map.texel.y;
    float const reach = std::sqrt(glm::dot(relative, relative));
    float const h = glm::dot(normal, relative);
    float const nb = glm::dot(normal, map.back);
    at.cos_angle = map.perspective ? -h / reach : nb;
    at.per_axis = map.perspective ? reach / distance : 1.0F;
    at.texel_m = map.perspective ? longest * distance : longest;
    at.depth_per_m = map.perspective ? std::abs(map.depth_offset) / (distance * distance) : std::abs(map.depth_scale);

    constexpr float least = 1.0F / max_tan;
    float const sine = std::sqrt(glm::max(0.0F, 1.0F - at.cos_angle * at.cos_angle));
    float const cosine = glm::max(std::abs(at.cos_angle), least);
    at.tan_angle = sine / cosine;
    float const steep = std::copysign(cosine, map.perspective ? h : nb);
    float const k = map.perspective ? map.depth_offset / (steep * reach) : map.depth_scale / steep;
    at.gradient.x = k * glm::dot(normal, map.right) * map.texel.x;
    at.gradient.y = -k * glm::dot(normal, map.up) * map.texel.y;
    return at;
}

}  // namespace gnomon::shadow
