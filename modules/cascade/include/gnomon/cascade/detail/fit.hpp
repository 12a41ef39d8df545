#pragma once
// Checks of a fit's configuration, and the depth range; see fit.hpp.

#include <gnomon/cascade/fit.hpp>

namespace gnomon::cascade {

namespace detail {

[[nodiscard]] inline core::Result<core::Done, Error> validate_depth(DepthConfig const& d) {
    if (d.codes < 16 || d.codes > float_codes)
        return core::Failure{Error::bad_depth,
                             core::sentence({"a last depth code of ", std::to_string(d.codes), ": need 16 to 16777216"})};
    constexpr double longest = 1e12;
    if (d.range == DepthRange::fixed_length &&
        !(d.length_m >= 1e-6 && d.length_m <= longest && d.guard_m >= 0.0 && d.guard_m <= longest))
        return core::Failure{Error::bad_depth,
                             core::sentence({"a depth of ", math::text_of(d.length_m), " m with a guard of ", math::text_of(d.guard_m),
                                       " m: need a length of 1e-6 to 1e12 and a guard of 0 to 1e12"})};
    if (d.range != DepthRange::scene_bounds) return core::Done{};
    auto const within = [](math::dvec3 const& p) {
        return std::abs(p.x) <= longest && std::abs(p.y) <= longest && std::abs(p.z) <= longest;  // false for a NaN
    };
    if (!within(d.scene_lo_m) || !within(d.scene_hi_m))
        return core::Failure{Error::not_finite,
                             core::sentence({"the scene's bounds ", math::text_of(d.scene_lo_m), " to ", math::text_of(d.scene_hi_m),
                                       " must lie within 1e12 m of the anchor"})};
    if (!(d.scene_lo_m.x <= d.scene_hi_m.x && d.scene_lo_m.y <= d.scene_hi_m.y && d.scene_lo_m.z <= d.scene_hi_m.z))
        return core::Failure{Error::bad_depth, core::sentence({"the scene's bounds ", math::text_of(d.scene_lo_m), " to ",
                                                         math::text_of(d.scene_hi_m), " hold nothing"})};
    return core::Done{};
}

}  // namespace detail

inline core::Result<core::Done, Error> validate(FitConfig const& c) {
    bool const positive = c.size_px >= 1 && c.size_px <= max_map_px && c.filter_px >= 0 && c.filter_px <= max_map_px &&
                          c.guard_px >= 0 && c.guard_px <= max_map_px;
    if (!positive || usable_px(c) < 1)
        return core::Failure{
            Error::bad_size,
            core::sentence({"a map of ", std::to_string(c.size_px), " texels with a filter of ",
                              std::to_string(c.filter_px), " and a guard band of ", std::to_string(c.guard_px),
                              ": need at most ", std::to_string(max_map_px),
                              ", and a texel left between twice filter, guard and one"})};
    bool const power = (c.texel_steps & (c.texel_steps - 1)) == 0 && c.texel_steps <= (1U << 20U);
    if (!power || !(c.hold >= 0.0 && c.hold <= 1.0))
        return core::Failure{Error::bad_fraction,
                             core::sentence({std::to_string(c.texel_steps),
                                               " texel sizes for each doubling, held for ", math::text_of(c.hold),
                                               ": need 0 or a power of two up to 2^20, and a fraction in [0, 1]"})};
    return detail::validate_depth(c.depth);
}

inline DepthFit fit_depth(DepthConfig const& config, LightFrame const& light, double diameter_m) noexcept {
    double const room = static_cast<double>(config.codes - spare_codes);
    constexpr std::uint32_t steps = 8;
    DepthFit fit{};
    if (config.range == DepthRange::scene_bounds) {
        double lo = std::numeric_limits<double>::infinity();
        double hi = -lo;
        double farthest_m = 0.0;
        for (unsigned i = 0; i < 8; ++i) {
            math::dvec3 const corner((i & 1U) != 0 ? config.scene_hi_m.x : config.scene_lo_m.x,
                                     (i & 2U) != 0 ? config.scene_hi_m.y : config.scene_lo_m.y,
                                     (i & 4U) != 0 ? config.scene_hi_m.z : config.scene_lo_m.z);
            double const depth_m = along(light.away, corner);
            double const sum = (std::abs(corner.x) + std::abs(corner.y)) + std::abs(corner.z);
            farthest_m = sum > farthest_m ? sum : farthest_m;
            lo = depth_m < lo ? depth_m : lo;
            hi = depth_m > hi ? depth_m : hi;
        }
        double const span_m = hi - lo > 1.0 ? hi - lo : 1.0;  // a flat scene gets a metre
        fit.unit_m = detail::quantized_up(span_m * (1.0 + 0x1p-20) / room, steps);
        double const first = std::floor(lo / fit.unit_m);
        bool const near = farthest_m / fit.unit_m < static_cast<double>(max_light_units);
        fit.z = near ? static_cast<std::int64_t>(first) - 2 : max_light_units;
        return fit;
    }
    double const given_m = config.length_m / static_cast<double>(config.codes);
    double const needed_m = diameter_m * (1.0 + 0x1p-20) / room;
    fit.unit_m = given_m >= needed_m ? given_m : detail::quantized_up(needed_m, steps);
    fit.reach = static_cast<std::int64_t>(std::ceil(diameter_m * 0.5 / fit.unit_m)) + 2;
    // The band takes at most what is not needed on both sides of the sub-frustum.
    std::int64_t const most = (std::int64_t{config.codes} - 2 * fit.reach - 2) / 2;
    double const wanted = std::floor(config.guard_m / fit.unit_m);
    fit.guard = wanted < static_cast<double>(most) ? static_cast<std::int64_t>(wanted) : most;
    fit.guard = fit.guard > 0 ? fit.guard : 0;
    return fit;
}

}  // namespace gnomon::cascade
