#pragma once
// What a map shows, in whole texels and depth units of light space; boxes in the same units, and how the two meet.
//
// A map at (x, y, z) of S texels and C codes shows texels [x, x + S) x [y, y + S); code c stands for depth unit z + c,
// and the last code, C, for "nothing drawn". All comparisons are of integers.

#include <gnomon/cascade/light_frame.hpp>
#include <gnomon/math/bounds.hpp>

#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>

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

/// What is at least x0 and below x1, and so on. Empty where an end does not lie beyond its beginning.
struct LightBox {
    std::int64_t x0 = 0, y0 = 0, z0 = 0;
    std::int64_t x1 = 0, y1 = 0, z1 = 0;

    friend constexpr bool operator==(LightBox const&, LightBox const&) noexcept = default;
};

/// The box of the depths that a map can hold: to be told from what its casters are looked for in, `may_cast`.
[[nodiscard]] constexpr LightBox box_of(Volume const& v) noexcept {
    return {v.at.x, v.at.y, v.at.z, v.at.x + v.size_px, v.at.y + v.size_px, v.at.z + v.codes};
}

/// Whether what is in `box` can change a texel: beside the map and behind its last code it cannot. There is no end
/// toward the light: what lies in front of code 0 is drawn at code 0.
///
/// source:  [CSM Scrolling, 3: V]; without the near end, so that a caster that was clamped stays a member
[[nodiscard]] constexpr bool may_cast(Volume const& v, LightBox const& box) noexcept {
    LightBox const map = box_of(v);
    return box.x0 < map.x1 && map.x0 < box.x1 && box.y0 < map.y1 && map.y0 < box.y1 && box.z0 < map.z1 &&
           box.z0 < box.z1;
}

/// Whether the map holds all of the box, undistorted: nothing beside it, nothing clamped at either end.
[[nodiscard]] constexpr bool holds(Volume const& v, LightBox const& box) noexcept {
    LightBox const map = box_of(v);
    return map.x0 <= box.x0 && box.x1 <= map.x1 && map.y0 <= box.y0 && box.y1 <= map.y1 && map.z0 <= box.z0 &&
           box.z1 <= map.z1;
}

/// Whether a position (relative to the anchor, light axes) is near enough that its coordinates, in units of `v`, are
/// off by less than 2^-7 units in double: all three, even where one unit is far smaller than the other.
[[nodiscard]] inline bool is_near(Volume const& v, math::dvec3 const& light_m) noexcept {
    double const unit_m = v.texel_m < v.depth_unit_m ? v.texel_m : v.depth_unit_m;
    double const sum = (std::abs(light_m.x) + std::abs(light_m.y)) + std::abs(light_m.z);
    return sum / unit_m < static_cast<double>(max_light_units);  // false for a NaN
}

/// The light box of all that is drawn of what lies in a box of the world: every texel whose centre a triangle within it
/// can cover, and every code it can give there.
///
///     x0 = ceil(lo / texel - 1/2 - e),  x1 = floor(hi / texel - 1/2 + e) + 1
///     z0 = floor(lo / unit + 1/2 - e),  z1 = floor(hi / unit + 1/2 + e) + 1,   e = 2^-6
///
/// e holds what is rounded: corners to the nearest 1/256 unit (1/512), depths at centres (1/500 of a code), and sums in
/// double (2^-7, `is_near`). A box between two columns of centres is empty. As light space does not move with the
/// camera, a box stays as it is until its object, the light or the units change.
///
/// `bounds` is relative to `offset_m`, which is relative to the anchor.
/// expects: `v` from a placed cascade; only its units are read.
/// returns: nothing for an empty box, NaN, and what is not near (`is_near`)
[[nodiscard]] inline std::optional<LightBox> try_box_in_light(LightFrame const& light, Volume const& v,
                                                              math::Aabb const& bounds,
                                                              math::dvec3 const& offset_m) noexcept {
    if (math::is_empty(bounds)) return std::nullopt;
    math::dvec3 lo(std::numeric_limits<double>::infinity());
    math::dvec3 hi(-std::numeric_limits<double>::infinity());
    for (unsigned i = 0; i < 8; ++i) {
        math::dvec3 const p = light_from_relative(light, offset_m + math::to_double(math::corner(bounds, i)));
        if (!is_near(v, p)) return std::nullopt;
        math::dvec3 const at(p.x / v.texel_m, p.y / v.texel_m, p.z / v.depth_unit_m);
        for (math::axis_t axis = 0; axis < 3; ++axis) {
            lo[axis] = at[axis] < lo[axis] ? at[axis] : lo[axis];
            hi[axis] = at[axis] > hi[axis] ? at[axis] : hi[axis];
        }
    }
    constexpr double e = 0x1p-6;
    auto const down = [](double x) { return static_cast<std::int64_t>(std::floor(x)); };
    auto const up = [](double x) { return static_cast<std::int64_t>(std::ceil(x)); };
    return LightBox{up(lo.x - 0.5 - e),       up(lo.y - 0.5 - e),       down(lo.z + 0.5 - e),
                    down(hi.x - 0.5 + e) + 1, down(hi.y - 0.5 + e) + 1, down(hi.z + 0.5 + e) + 1};
}

}  // namespace gnomon::cascade
