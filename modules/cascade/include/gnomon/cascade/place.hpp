#pragma once
// Where a cascade's map stands: rounded down to whole texels and depth units, and left there while the guard band lets
// it. The numbers are integers from here on.
//
// source: [CSM Scrolling, 5]

#include <gnomon/cascade/fit.hpp>

#include <limits>
#include <optional>

namespace gnomon::cascade {

/// A box about a sub-frustum, light axes, metres from the anchor.
struct LightBounds {
    math::dvec3 lo_m{std::numeric_limits<double>::infinity()};
    math::dvec3 hi_m{-std::numeric_limits<double>::infinity()};
};

[[nodiscard]] inline LightBounds bounds_in_light(LightFrame const& light,
                                                 std::array<math::dvec3, 8> const& relative_m) noexcept {
    LightBounds box;
    for (math::dvec3 const& p : relative_m) {
        math::dvec3 const q = light_from_relative(light, p);
        for (math::axis_t axis = 0; axis < 3; ++axis) {
            box.lo_m[axis] = q[axis] < box.lo_m[axis] ? q[axis] : box.lo_m[axis];
            box.hi_m[axis] = q[axis] > box.hi_m[axis] ? q[axis] : box.hi_m[axis];
        }
    }
    return box;
}

/// One coordinate of the whole map, with its guard band: the held one while the map proper, which begins at `proper`,
/// has not left the band; else the band is centred about it again.
[[nodiscard]] constexpr std::int64_t guarded(std::int64_t const* held, std::int64_t proper,
                                             std::int64_t guard) noexcept {
    if (held != nullptr && *held <= proper && proper <= *held + 2 * guard) return *held;
    return proper - guard;
}
static_assert(guarded(nullptr, 10, 4) == 6);

/// What placing needs to know of one cascade.
struct PlaceInput {
    LightBounds bounds;  ///< Of the sub-frustum.
    double texel_m = 1.0;
    DepthFit depth{};
    Volume const* held = nullptr;  ///< The volume of the frame before, with the same units; null where there is none.
};

/// The volume that holds the sub-frustum, one filter's radius from the border of the map proper.
///
///     proper = floor(centre / texel) - (S - 2 guard) / 2,  at = guarded(held, proper, guard)
///
/// expects: `config` passes `validate`; `texel_m` and `depth` from `texel_for` and `fit_depth` for this sub-frustum.
/// returns: nothing where a coordinate would lie beyond `max_light_units`
[[nodiscard]] inline std::optional<Volume> try_place(FitConfig const& config, PlaceInput const& in) noexcept {
    Volume v;
    v.size_px = config.size_px;
    v.codes = config.depth.codes;
    v.texel_m = in.texel_m;
    v.depth_unit_m = in.depth.unit_m;
    math::dvec3 const centre_m = (in.bounds.lo_m + in.bounds.hi_m) * 0.5;
    if (!is_near(v, centre_m) || in.depth.z >= max_light_units) return std::nullopt;
    auto const whole = [](double x) { return static_cast<std::int64_t>(std::floor(x)); };
    bool const same_units = in.held != nullptr && in.held->size_px == v.size_px && in.held->codes == v.codes &&
                            in.held->texel_m == v.texel_m && in.held->depth_unit_m == v.depth_unit_m;
    Place const* const held = same_units ? &in.held->at : nullptr;
    std::int64_t const half = (config.size_px - 2 * config.guard_px) / 2;
    v.at.x = guarded(held != nullptr ? &held->x : nullptr, whole(centre_m.x / v.texel_m) - half, config.guard_px);
    v.at.y = guarded(held != nullptr ? &held->y : nullptr, whole(centre_m.y / v.texel_m) - half, config.guard_px);
    v.at.z = in.depth.z;
    if (config.depth.range == DepthRange::fixed_length) {
        std::int64_t const end = whole(centre_m.z / v.depth_unit_m) + in.depth.reach;
        std::int64_t const proper = end - (v.codes - 2 * in.depth.guard);
        v.at.z = guarded(held != nullptr ? &held->z : nullptr, proper, in.depth.guard);
    }
    return v;
}

}  // namespace gnomon::cascade
