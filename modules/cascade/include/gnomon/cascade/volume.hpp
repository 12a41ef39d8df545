#pragma once
// What a map shows, in whole texels and depth units of light space. What may be drawn to it is for `cache` to say, whose
// boxes are in the same units.
//
// A map at (x, y, z) of S texels and C codes shows texels [x, x + S) x [y, y + S); code c stands for depth unit z + c,
// and the last code, C, for "nothing drawn". All comparisons are of integers.

#include <gnomon/cascade/light_frame.hpp>

#include <cmath>
#include <cstdint>

namespace gnomon::cascade {

inline constexpr std::int64_t max_light_units = std::int64_t{1} << 41;  ///< Of any coordinate in light space.
inline constexpr std::int32_t max_map_px = 16384;

/// The last code of a depth format: that of a texel on which nothing was drawn.
inline constexpr std::int32_t unorm16_codes = 65535;
inline constexpr std::int32_t float_codes = 1 << 24;  ///< A float holds code * 2^-24, exactly.

/// Texels right and down, depth units away from the light, all from the anchor.
struct Place {
    std::int64_t x = 0;
    std::int64_t y = 0;
    std::int64_t z = 0;

    friend constexpr bool operator==(Place const&, Place const&) noexcept = default;
    friend constexpr Place operator-(Place const& a, Place const& b) noexcept {
        return {a.x - b.x, a.y - b.y, a.z - b.z};
    }
};

struct Volume {
    Place at;
    std::int32_t size_px = 0;
    std::int32_t codes = unorm16_codes;
    double texel_m = 1.0;
    double depth_unit_m = 1.0;

    friend constexpr bool operator==(Volume const&, Volume const&) noexcept = default;
};

/// Whether a position (relative to the anchor, light axes) is near enough that its coordinates, in units of `v`, are
/// off by less than 2^-7 units in double: all three, even where one unit is far smaller than the other.
[[nodiscard]] inline bool is_near(Volume const& v, math::dvec3 const& light_m) noexcept {
    double const unit_m = v.texel_m < v.depth_unit_m ? v.texel_m : v.depth_unit_m;
    double const sum = (std::abs(light_m.x) + std::abs(light_m.y)) + std::abs(light_m.z);
    return sum / unit_m < static_cast<double>(max_light_units);  // false for a NaN
}

}  // namespace gnomon::cascade
