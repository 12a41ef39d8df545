#pragma once
// Boxes of casters and volumes of maps in whole units of an absolute light space: x texels to the right, y texels down,
// z depth units away from the light, all relative to an anchor that moves with the world's origin.
//
// With whole numbers "touches the map" and "lies inside of what the last frame's map showed" are comparisons, and what
// they say of a box holds for every texel drawn from it.

#include <gnomon/core/contract.hpp>
#include <gnomon/math/scalar.hpp>
#include <gnomon/math/vec.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>

namespace gnomon::cache {

inline constexpr std::int64_t max_units = std::int64_t{1} << 60;  ///< Of any coordinate.

/// All texels and depth units that a caster may be drawn to: [x0, x1) x [y0, y1), depths z0 to z1, both included.
struct Box {
    std::int64_t x0 = 0;
    std::int64_t y0 = 0;
    std::int64_t z0 = 0;
    std::int64_t x1 = 0;
    std::int64_t y1 = 0;
    std::int64_t z1 = 0;

    friend constexpr bool operator==(Box const&, Box const&) noexcept = default;
};

/// What a map shows: texels [x, x + width) x [y, y + height); code 0 is depth z, and code `far_code` means unwritten.
///
/// A depth before z is drawn as code 0, so that a volume has no end toward the light.
struct Volume {
    std::int64_t x = 0;
    std::int64_t y = 0;
    std::int64_t z = 0;
    std::int64_t width = 0;
    std::int64_t height = 0;
    std::int64_t far_code = 65535;  ///< 65535 of 16 bits; 2^24 of floats, whose unit is 2^-24 of the range.

    friend constexpr bool operator==(Volume const&, Volume const&) noexcept = default;
};

/// How far a volume moved, never wrapped: new texel (i, j) is old texel (i + x, j + y), its new code the old one - z.
struct Shift {
    std::int64_t x = 0;
    std::int64_t y = 0;
    std::int64_t z = 0;

    friend constexpr bool operator==(Shift const&, Shift const&) noexcept = default;
};

[[nodiscard]] constexpr Shift shift_between(Volume const& before, Volume const& now) noexcept {
    return {now.x - before.x, now.y - before.y, now.z - before.z};
}

/// A box without a texel or a depth is drawn nowhere.
[[nodiscard]] constexpr bool is_empty(Box const& box) noexcept {
    return box.x0 >= box.x1 || box.y0 >= box.y1 || box.z0 > box.z1;
}

/// The texels alone.
struct TexelRect {
    std::int64_t x0 = 0;
    std::int64_t y0 = 0;
    std::int64_t x1 = 0;
    std::int64_t y1 = 0;

    friend constexpr bool operator==(TexelRect const&, TexelRect const&) noexcept = default;
};

[[nodiscard]] constexpr bool is_empty(TexelRect const& r) noexcept { return r.x0 >= r.x1 || r.y0 >= r.y1; }
[[nodiscard]] constexpr TexelRect rect_of(Volume const& v) noexcept {
    return {v.x, v.y, v.x + v.width, v.y + v.height};
}
[[nodiscard]] constexpr TexelRect rect_of(Box const& b) noexcept { return {b.x0, b.y0, b.x1, b.y1}; }

/// The texels of both; empty rectangles come out as they may.
[[nodiscard]] constexpr TexelRect intersection(TexelRect const& a, TexelRect const& b) noexcept {
    return {std::max(a.x0, b.x0), std::max(a.y0, b.y0), std::min(a.x1, b.x1), std::min(a.y1, b.y1)};
}

/// The smallest rectangle that holds both.
[[nodiscard]] constexpr TexelRect merged(TexelRect const& a, TexelRect const& b) noexcept {
    if (is_empty(a)) return b;
    if (is_empty(b)) return a;
    return {std::min(a.x0, b.x0), std::min(a.y0, b.y0), std::max(a.x1, b.x1), std::max(a.y1, b.y1)};
}

/// Is every texel of `inner` one of `outer`?
[[nodiscard]] constexpr bool contains(TexelRect const& outer, TexelRect const& inner) noexcept {
    return is_empty(inner) ||
           (outer.x0 <= inner.x0 && outer.y0 <= inner.y0 && inner.x1 <= outer.x1 && inner.y1 <= outer.y1);
}

/// May a caster in `box` write a texel of a map of volume `v`?
///
/// Casters before the volume do: they are clamped to its near plane. Casters that begin at its far plane do not.
/// source: [CSM Scrolling, 2, "objects intersecting V"], with no end toward the light.
[[nodiscard]] constexpr bool may_touch(Box const& box, Volume const& v) noexcept {
    return !is_empty(box) && !is_empty(intersection(rect_of(box), rect_of(v))) && box.z0 < v.z + v.far_code;
}

/// May a caster in `box` have written what both volumes show: a texel that is kept when a map moves from one to the other?
///
/// source: [CSM Scrolling, 3, "the intersection of V and V'"], with no end toward the light.
[[nodiscard]] constexpr bool may_touch_both(Box const& box, Volume const& before, Volume const& now) noexcept {
    return !is_empty(box) && !is_empty(intersection(rect_of(box), intersection(rect_of(before), rect_of(now)))) &&
           box.z0 < std::min(before.z + before.far_code, now.z + now.far_code);
}

/// Does `now` show a part of `box` that `before` did not, to the side, before its near or beyond its far plane?
///
/// A map moved from `before` to `now` lacks that part; what it holds of the rest is exact. A part before both near planes
/// is clamped in both, and texels that were clamped stay so when the volume moves away from the light.
/// source: errata of [CSM Scrolling, 3, "the difference of S and S'"]: members that were not wholly inside V', here of
///         those only the ones of which V shows the missing part.
[[nodiscard]] constexpr bool shows_more(Box const& box, Volume const& before, Volume const& now) noexcept {
    bool const aside = !contains(rect_of(before), intersection(rect_of(box), rect_of(now)));
    bool const nearer = now.z < before.z && box.z0 < before.z;
    bool const farther = now.z + now.far_code > before.z + before.far_code && box.z1 >= before.z + before.far_code;
    return may_touch(box, now) && (aside || nearer || farther);
}

/// A light's axes and units: those of an `IntegerOrtho`, or of any orthographic light that rounds corners alike.
struct LightUnits {
    math::dvec3 right{1.0, 0.0, 0.0};  ///< Unit vectors at right angles.
    math::dvec3 down{0.0, -1.0, 0.0};
    math::dvec3 away{0.0, 0.0, -1.0};
    double texel_m = 0.015625;
    double depth_unit_m = 0.001;
};

namespace detail {

struct Span64 {
    std::int64_t begin;
    std::int64_t end;
};

/// [low, high] of a projected box in whole units, a unit larger on either side.
[[nodiscard]] inline std::optional<Span64> whole_span(math::dvec3 const& axis, math::dvec3 const& middle,
                                                      math::dvec3 const& half, double per_unit) noexcept {
    double const at = (axis.x * middle.x + axis.y * middle.y + axis.z * middle.z) * per_unit;
    double const reach = (std::abs(axis.x) * half.x + std::abs(axis.y) * half.y + std::abs(axis.z) * half.z) * per_unit;
    double const limit = 0x1p48;
    if (!(at - reach >= -limit && at + reach <= limit)) return std::nullopt;
    return Span64{static_cast<std::int64_t>(std::floor(at - reach)) - 1,
                  static_cast<std::int64_t>(std::ceil(at + reach)) + 1};
}

}  // namespace detail

/// The box of everything in [low_m, high_m], which are world positions minus the anchor.
///
/// One unit more on every side than the exact extent, rounded outward. That covers what drawing adds: corners rounded to
/// 1/256 (1/512), depth within 0.503 codes of the plane, and 2^-49 of the position by rounding here, an eighth of a unit
/// at most.
/// expects: the units are > 0.
/// returns: nothing if a corner is NaN, low exceeds high, or a coordinate exceeds 2^48 units.
[[nodiscard]] inline std::optional<Box> enclose(LightUnits const& light, math::dvec3 const& low_m,
                                                math::dvec3 const& high_m) noexcept {
    GNOMON_EXPECT(light.texel_m > 0.0 && light.depth_unit_m > 0.0);
    if (!(low_m.x <= high_m.x && low_m.y <= high_m.y && low_m.z <= high_m.z)) return std::nullopt;
    math::dvec3 const middle = low_m * 0.5 + high_m * 0.5;
    math::dvec3 const half = high_m * 0.5 - low_m * 0.5;
    auto const x = detail::whole_span(light.right, middle, half, 1.0 / light.texel_m);
    auto const y = detail::whole_span(light.down, middle, half, 1.0 / light.texel_m);
    auto const z = detail::whole_span(light.away, middle, half, 1.0 / light.depth_unit_m);
    if (!x || !y || !z) return std::nullopt;
    return Box{x->begin, y->begin, z->begin, x->end, y->end, z->end};
}

static_assert(may_touch(Box{0, 0, -9, 1, 1, -9}, Volume{0, 0, 0, 4, 4, 10}), "before the volume: clamped, still drawn");
static_assert(!may_touch(Box{0, 0, 10, 1, 1, 12}, Volume{0, 0, 0, 4, 4, 10}), "at the far code: unwritten");
static_assert(shows_more(Box{3, 0, 1, 6, 1, 2}, Volume{0, 0, 0, 4, 4, 10}, Volume{1, 0, 0, 4, 4, 10}));
static_assert(!shows_more(Box{-2, 0, 1, 3, 1, 2}, Volume{0, 0, 0, 4, 4, 10}, Volume{1, 0, 0, 4, 4, 10}));

}  // namespace gnomon::cache
