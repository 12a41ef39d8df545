#pragma once
// The checked way to split a view; see splits.hpp.

#include <gnomon/cascade/detail/quantize.hpp>
#include <gnomon/cascade/splits.hpp>

#include <string>

namespace gnomon::cascade {

namespace detail {

/// The greatest double whose power, multiplied up one by one, is not above `x`: the same on every machine.
///
/// expects: x of at least 1.
[[nodiscard]] inline double root_of(double x, std::uint32_t power) noexcept {
    if (power == 1) return x;
    double low = 1.0;
    double high = x;
    for (double middle = low + (high - low) / 2; low < middle && middle < high; middle = low + (high - low) / 2) {
        double product = 1.0;
        for (std::uint32_t i = 0; i < power && product <= x; ++i) product *= middle;
        (product <= x ? low : high) = middle;
    }
    return low;
}

/// Both ends of what is split, or what is wrong with them.
[[nodiscard]] inline core::Result<VisibleRange, Error> validate_splits(SplitConfig const& config,
                                                                       math::View const& camera) {
    if (config.count < 1 || config.count > max_cascades)
        return core::Failure{Error::bad_count, core::sentence({std::to_string(config.count), " cascades: need 1 to ",
                                                         std::to_string(max_cascades)})};
    auto const is_part = [](double x) { return x >= 0.0 && x <= 1.0; };
    if (!is_part(config.lambda) || !is_part(config.overlap) || !is_part(config.fade))
        return core::Failure{Error::bad_fraction,
                             core::sentence({"lambda ", math::text_of(config.lambda), ", overlap ", math::text_of(config.overlap),
                                       " and fade ", math::text_of(config.fade), ": each must be in [0, 1]"})};
    double const near_m = config.near_m == 0.0 ? camera.near_m : config.near_m;
    double const last_m = config.scheme == SplitScheme::given ? config.ends_m[config.count - 1] : config.far_m;
    double const far_m = last_m == 0.0 ? camera.far_m : last_m;
    if (!math::is_finite(near_m) || !math::is_finite(far_m))
        return core::Failure{Error::not_finite,
                             core::sentence({"cascades from ", math::text_of(near_m), " m to ", math::text_of(far_m),
                                       " m: both must be finite; a view without end needs a shadow distance far_m"})};
    if (!(near_m < far_m))
        return core::Failure{Error::bad_range, core::sentence({"cascades from ", math::text_of(near_m), " m to ", math::text_of(far_m),
                                                         " m: need near < far"})};
    bool const logarithmic = config.scheme == SplitScheme::logarithmic || config.scheme == SplitScheme::practical;
    bool const behind = camera.lens == math::Lens::perspective && !(near_m >= 0.0);
    if (behind || (logarithmic && !(near_m > 0.0)))
        return core::Failure{Error::bad_range, core::sentence({"cascades from ", math::text_of(near_m),
                                                         " m: this scheme or camera needs a near depth above 0"})};
    return VisibleRange{near_m, far_m};
}

}  // namespace detail

inline core::Result<Splits, Error> make_splits(SplitConfig const& config, math::View const& camera) {
    auto const range = detail::validate_splits(config, camera);
    if (!range) return range.failure();
    double const near_m = range->near_m;
    double const length_m = range->far_m - near_m;
    double const lambda = config.scheme == SplitScheme::uniform       ? 0.0
                          : config.scheme == SplitScheme::logarithmic ? 1.0
                                                                      : config.lambda;
    bool const needs_root = config.scheme != SplitScheme::given && lambda > 0.0;
    double const ratio = needs_root ? detail::root_of(range->far_m / near_m, config.count) : 1.0;
    Splits splits;
    splits.count = config.count;
    double previous_m = near_m;
    double begin_m = near_m;
    double logarithmic_m = near_m;
    for (std::uint32_t k = 0; k < config.count; ++k) {
        logarithmic_m *= ratio;
        double const uniform_m = near_m + length_m * (static_cast<double>(k + 1) / static_cast<double>(config.count));
        double end_m = lambda * logarithmic_m + (1.0 - lambda) * uniform_m;
        if (config.scheme == SplitScheme::given) end_m = config.ends_m[k];
        bool const last = k + 1 == config.count;
        if (last) end_m = range->far_m;
        if (!(end_m > previous_m && end_m <= range->far_m))
            return core::Failure{
                Error::bad_range,
                core::sentence({"cascade ", std::to_string(k), " from ", math::text_of(previous_m), " m to ",
                                  math::text_of(end_m), " m: each end must lie beyond the one before"})};
        double const blend_m = end_m - (last ? config.fade : config.overlap) * (end_m - previous_m);
        splits.of[k] = {begin_m, end_m, blend_m};
        begin_m = blend_m;
        previous_m = end_m;
    }
    return splits;
}

inline VisibleRange follow_visible(VisibleRange const& held, double nearest_m, double farthest_m) noexcept {
    bool const legal = nearest_m > 0.0 && nearest_m <= farthest_m && math::is_finite(farthest_m);
    if (!legal) return held;
    bool const holds = held.near_m <= nearest_m && farthest_m <= held.far_m;
    bool const close = held.near_m >= nearest_m * 0.5 && held.far_m <= farthest_m * 2.0;
    if (holds && close) return held;
    return {detail::quantized_down(nearest_m, 4), detail::quantized_up(farthest_m, 4)};
}

}  // namespace gnomon::cascade
