#pragma once
// How large a cascade's texels and depth units are: from its sub-frustum's own size and the light's depth range, never
// from where the camera is or how it is turned.
//
// source: [CSM Scrolling, 5]

#include <gnomon/cascade/detail/quantize.hpp>
#include <gnomon/cascade/sub_frustum.hpp>
#include <gnomon/cascade/volume.hpp>

#include <string>

namespace gnomon::cascade {

enum class Extent : std::uint8_t {
    diameter,  ///< The greatest distance between two points: what is needed.
    sphere,    ///< The bounding sphere's diameter: larger, as other systems have it.
};

enum class DepthRange : std::uint8_t {
    fixed_length,  ///< `length_m`, placed about the sub-frustum in whole units, with all that is spare toward the
                   ///< light.
    scene_bounds,  ///< From the scene's first depth to its last: it stands still.
};

struct DepthConfig {
    DepthRange range = DepthRange::fixed_length;
    std::int32_t codes = unorm16_codes;  ///< The last code: `unorm16_codes`, `float_codes`, or any from 16 to 2^24.
    double length_m = 1000.0;  ///< Of `fixed_length`: codes * unit, longer only where the sub-frustum needs it.
    double guard_m = 50.0;     ///< Of `fixed_length`: moves along the light by this much leave the map's depth alone.
    math::dvec3 scene_lo_m{0.0, 0.0, 0.0};  ///< Of `scene_bounds`: relative to the anchor.
    math::dvec3 scene_hi_m{0.0, 0.0, 0.0};
};

struct FitConfig {
    std::int32_t size_px = 512;
    std::int32_t filter_px = 2;  ///< Texels that a lookup reads beyond its point, rounded up.
    std::int32_t guard_px = 0;   ///< On each side: the map proper moves this far before anything scrolls.
    Extent extent = Extent::diameter;
    std::uint32_t texel_steps = 8;  ///< Sizes of a texel for each doubling, a power of two; 0: any size.
    double hold = 0.0625;           ///< A texel is kept until one smaller by this fraction would do.
    DepthConfig depth;
};

/// Texels of the map across which the sub-frustum's diameter must fit: a filter's radius, and one for placing by whole
/// texels, stay free on each side of the map proper.
[[nodiscard]] constexpr std::int32_t usable_px(FitConfig const& config) noexcept {
    return config.size_px - 2 * (config.guard_px + config.filter_px + 1);
}

/// The first thing wrong, or success.
[[nodiscard]] core::Result<core::Done, Error> validate(FitConfig const& config);

/// The texel of a map that holds `extent_m` wherever it is placed, in `texel_steps` sizes for each doubling.
///
/// `held_m` is the texel of the frame before (0: none). It is kept while it is large enough and not `hold` too large:
/// a field of view that breathes does not redraw the map with every breath.
///
/// expects: a `config` that passes `validate`, `extent_m` above 0.
[[nodiscard]] inline double texel_for(FitConfig const& config, double extent_m, double held_m = 0.0) noexcept {
    // 2^-20 of the extent pays for axes that are not quite of length 1, 1/64 of a texel on each side for coordinates in
    // double (`is_near`), so that the exact sub-frustum is held.
    double const needed_m = extent_m * (1.0 + 0x1p-20) / (static_cast<double>(usable_px(config)) - 0.03125);
    if (held_m >= needed_m && held_m <= detail::quantized_up(needed_m * (1.0 + config.hold), config.texel_steps))
        return held_m;
    return detail::quantized_up(needed_m, config.texel_steps);
}

/// The depth unit of a map, and for `scene_bounds` also where its code 0 stands.
struct DepthFit {
    double unit_m;
    std::int64_t z = 0;      ///< Of `scene_bounds`: where code 0 stands; `max_light_units` where that is too far.
    std::int64_t reach = 0;  ///< Of `fixed_length`: units behind the sub-frustum's middle that must be held.
    std::int64_t guard = 0;  ///< Of `fixed_length`: whole units.
};

/// A few units are kept free at both ends: for rounding down and up, and because the last code means "nothing drawn".
inline constexpr std::int32_t spare_codes = 8;

/// expects: a `config` that passes `validate`, `diameter_m` above 0.
/// returns: unit_m = length / codes, or as long a unit as the diameter or the scene needs, in 8 sizes for each doubling
[[nodiscard]] DepthFit fit_depth(DepthConfig const& config, LightFrame const& light, double diameter_m) noexcept;

}  // namespace gnomon::cascade

#include <gnomon/cascade/detail/fit.hpp>
