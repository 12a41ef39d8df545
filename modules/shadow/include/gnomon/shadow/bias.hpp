#pragma once
// How far a receiver is moved toward the light before it is compared: enough that no surface shadows itself, and as
// little as that takes, for whatever is nearer to the surface than the bias casts no shadow on it.
//
// Everything is in metres or texels, never in raw depth: the same settings mean the same for every light and map.

#include <gnomon/shadow/formula/bias.glsl>
#include <gnomon/shadow/receiver.hpp>

#include <cstddef>
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

/// The settings of a lookup as the formulas, and a shader, get them: 32 bytes.
[[nodiscard]] constexpr formula::GnShadowConfig formula_config(BiasConfig const& bias, int taps) noexcept {
    return {.taps = taps,
            .automatic = bias.automatic ? 1U : 0U,
            .receiver_plane = bias.receiver_plane ? 1U : 0U,
            .in_texels = bias.unit == BiasUnit::texels ? 1U : 0U,
            .constant = bias.constant,
            .slope = bias.slope,
            .normal_offset = bias.normal_offset,
            .max_tan = bias.max_tan};
}

static_assert(sizeof(formula::GnShadowConfig) == 32 && offsetof(formula::GnShadowConfig, in_texels) == 12 &&
              offsetof(formula::GnShadowConfig, constant) == 16 && offsetof(formula::GnShadowConfig, max_tan) == 28);

struct Bias {
    float depth = 0.0F;   ///< Toward the light, as the map stores depth.
    float metres = 0.0F;  ///< The same, along the light's ray.
};

/// The largest distance per axis, in texels, from the receiver's image point to the centre of a texel that `taps`
/// reads.
///
///     taps / 2: half a texel for one tap, and half a texel more for each texel that the filter is wider
[[nodiscard]] constexpr float filter_reach_px(int taps) noexcept {
    return formula::gn_filter_reach_px(taps);
}

/// The bias that an unshadowed plane needs to stay lit in this map, whatever its tilt.
///
///     depth = half_code + 16 e max(1 or depth) + p |d depth / d m| + (|gx| + |gy|) (m + p / texel + reach)
///
/// half_code: the stored format's rounding; 16 e: rounding of depth in pass and lookup, e = 2^-24; p: rounding of
/// positions, 4 e of the largest coordinate; g: the plane's depth per texel; m: snapping and rounding, `gn_misplacement_px`; reach:
/// `filter_reach_px`, the half-texel-diagonal error times tan of the angle, or 0 if the taps follow the plane.
///
/// source:  numerics: half-texel error of a tilted plane; [this module's README, table]
[[nodiscard]] inline float automatic_bias(MapView const& map, Receiver const& at, math::vec3 const& position, int taps,
                                          bool receiver_plane) noexcept {
    formula::GnShadowConfig config{};
    config.taps = taps;
    config.receiver_plane = receiver_plane ? 1U : 0U;
    return gn_automatic_bias(map, detail::as_formula(at), formula::Vec3<float>(position), config).v;
}

/// The automatic bias's part for surfaces that are not planes.
///
///     metres = texel (0.5 + 0.1 min(tan, 8))
///
/// What a surface may bend within the filter's reach before its own facets shadow each other: a facet of a dent or a
/// groove stands before its neighbour's plane, as no facet of a bulge does. Chosen by measuring; see the README.
[[nodiscard]] inline float bend_allowance_m(Receiver const& at) noexcept {
    return gn_bend_allowance_m(detail::as_formula(at)).v;
}

/// Depth units for a move of `metres` toward the light, never past half the way to it.
[[nodiscard]] inline float depth_of_move(MapView const& map, Receiver const& at, float metres) noexcept {
    return gn_depth_of_move(map, detail::as_formula(at), formula::Float<float>(metres)).v;
}

/// The whole bias at a receiver, without the normal offset (which moves the receiver itself, see `offset_position`).
[[nodiscard]] inline Bias bias_at(MapView const& map, Receiver const& at, math::vec3 const& position,
                                  BiasConfig const& config, int taps) noexcept {
    formula::GnBias<float> const bias =
        gn_bias_at(map, detail::as_formula(at), formula::Vec3<float>(position), formula_config(config, taps));
    return {bias.depth.v, bias.metres.v};
}

/// `position` moved along `normal` by the config's normal offset; `at` is the receiver there.
[[nodiscard]] inline math::vec3 offset_position(Receiver const& at, math::vec3 const& position,
                                                math::vec3 const& normal, BiasConfig const& config) noexcept {
    return math::vec3(gn_offset_position(detail::as_formula(at), formula::Vec3<float>(position),
                                         formula::Vec3<float>(normal), formula_config(config, 1)));
}

}  // namespace gnomon::shadow
