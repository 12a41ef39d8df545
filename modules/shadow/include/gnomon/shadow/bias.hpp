#pragma once
// How far a receiver is moved toward the light before it is compared: enough that no surface shadows itself, and as
// little as that takes, for whatever is nearer to the surface than the bias casts no shadow on it.
//
// Everything is in metres or texels, never in raw depth: the same settings mean the same for every light and map.

#include <gnomon/shadow/receiver.hpp>

#include <cmath>
#include <cstdint>

namespace gnomon::shadow {

enum class BiasUnit : std::uint8_t {
    texels,  ///< Times the texel's world size at the receiver.
    metres,
};

struct BiasConfig {
    bool automatic = true;            ///< Picks what the map's own errors need; the three below come on top.
    bool receiver_plane = true;       ///< Compare each tap with the receiver's plane under it, not with the receiver.
    float constant = 0.0F;            ///< Along the light's way.
    float slope = 0.0F;               ///< Times tan of the angle between normal and light.
    float normal_offset = 0.0F;       ///< Along the normal, times sin of that angle.
    float max_tan = shadow::max_tan;  ///< Limits `slope`.
    BiasUnit unit = BiasUnit::texels;
};

struct Bias {
    float depth = 0.0F;   ///< Toward the light, as the map stores depth.
    float metres = 0.0F;  ///< The same, along the light's ray.
};

namespace detail {

inline constexpr float half_ulp = 5.9604645e-8F;  ///< 2^-24

/// How far, in texels per axis, a stored depth may belong to a point beside the one that is asked for: corners are
/// snapped to 1/256 texel (1/512 off, in the map and, by the interpolated depth, along the plane), and image points
/// round at 8 half ulps of the map's size in the pass and again in the lookup.
[[nodiscard]] inline float misplacement_px(MapView const& map) noexcept {
    float const longest = map.size_px.x > map.size_px.y ? map.size_px.x : map.size_px.y;
    return 1.0F / 256.0F + 16.0F * half_ulp * longest;
}

/// What a surface may bend within the filter's reach before its own facets shadow each other: a facet of a dent or a
/// groove stands before its neighbour's plane, as no facet of a bulge does. Chosen by measuring; see the README.
inline constexpr float bend_constant_px = 0.5F;
inline constexpr float bend_slope_px = 0.1F;
inline constexpr float bend_max_tan = 8.0F;

}  // namespace detail

/// The largest distance per axis, in texels, from the receiver's image point to the centre of a texel that `taps`
/// reads.
///
///     taps / 2: half a texel for one tap, and half a texel more for each texel that the filter is wider
[[nodiscard]] constexpr float filter_reach_px(int taps) noexcept {
    return 0.5F * static_cast<float>(taps < 1 ? 1 : taps);
}

/// The bias that an unshadowed plane needs to stay lit in this map, whatever its tilt.
///
///     depth = half_code + 16 e max(1 or depth) + p |d depth / d m| + (|gx| + |gy|) (m + p / texel + reach)
///
/// half_code: the stored format's rounding; 16 e: rounding of depth in pass and lookup, e = 2^-24; p: rounding of
/// positions, 4 e of the largest coordinate; g: the plane's depth per texel; m: `misplacement_px`; reach:
/// `filter_reach_px`, the half-texel-diagonal error times tan of the angle, or 0 if the taps follow the plane.
///
/// source:  numerics: half-texel error of a tilted plane; [this module's README, table]
[[nodiscard]] inline float automatic_bias(MapView const& map, Receiver const& at, math::vec3 const& position, int taps,
                                          bool receiver_plane) noexcept {
    auto const largest = [](math::vec3 const& v) {
        return glm::max(glm::max(std::abs(v.x), std::abs(v.y)), std::abs(v.z));
    };
    float const place_m = 4.0F * detail::half_ulp * (largest(position) + largest(position - map.eye));
    float const magnitude = map.perspective ? std::abs(map.depth_scale) + std::abs(at.depth) : 1.0F;
    float const rounding = map.half_code + 16.0F * detail::half_ulp * magnitude;
    float const reach = receiver_plane ? 0.0F : filter_reach_px(taps);
    float const beside = detail::misplacement_px(map) + place_m / at.texel_m + reach;
    return rounding + place_m * at.depth_per_m + (std::abs(at.gradient.x) + std::abs(at.gradient.y)) * beside;
}

/// The automatic bias's part for surfaces that are not planes.
///
///     metres = texel (0.5 + 0.1 min(tan, 8))
[[nodiscard]] inline float bend_allowance_m(Receiver const& at) noexcept {
    return at.texel_m *
           (detail::bend_constant_px + detail::bend_slope_px * glm::min(at.tan_angle, detail::bend_max_tan));
}

/// Depth units for a move of `metres` toward the light, never past half the way to it.
[[nodiscard]] inline float depth_of_move(MapView const& map, Receiver const& at, float metres) noexcept {
    if (!map.perspective) return metres * at.depth_per_m;
    float const d = at.distance_m;
    float const nearer = glm::max(d - metres, 0.5F * d);
    return std::abs(map.depth_offset) * glm::min(metres, 0.5F * d) / (d * nearer);
}

/// The whole bias at a receiver, without the normal offset (which moves the receiver itself, see `offset_position`).
[[nodiscard]] inline Bias bias_at(MapView const& map, Receiver const& at, math::vec3 const& position,
                                  BiasConfig const& config, int taps) noexcept {
    float const unit_m = config.unit == BiasUnit::texels ? at.texel_m : 1.0F;
    float const tangent = glm::min(at.tan_angle, config.max_tan);
    float metres = (config.constant + config.slope * tangent) * unit_m;
    if (config.automatic) metres += bend_allowance_m(at);
    Bias bias;
    bias.depth = depth_of_move(map, at, metres);
    if (config.automatic) bias.depth += automatic_bias(map, at, position, taps, config.receiver_plane);
    bias.metres = bias.depth / at.depth_per_m * at.per_axis;
    return bias;
}

/// `position` moved along `normal` by the config's normal offset; `at` is the receiver there.
[[nodiscard]] inline math::vec3 offset_position(Receiver const& at, math::vec3 const& position,
                                                math::vec3 const& normal, BiasConfig const& config) noexcept {
    float const unit_m = config.unit == BiasUnit::texels ? at.texel_m : 1.0F;
    float const sine = std::sqrt(glm::max(0.0F, 1.0F - at.cos_angle * at.cos_angle));
    return position + normal * (config.normal_offset * unit_m * sine);
}

}  // namespace gnomon::shadow
