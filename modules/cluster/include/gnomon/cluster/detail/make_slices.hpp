#pragma once
// The checked ways to make depth slices; see slices.hpp.

#include <gnomon/math/text.hpp>
#include <gnomon/cluster/slices.hpp>
#include <gnomon/math/scalar.hpp>

#include <algorithm>
#include <bit>
#include <cstddef>
#include <limits>
#include <string>
#include <string_view>

namespace gnomon::cluster {

namespace detail {

/// Parts of 2^shift places each, the fewest that hold at most one plane inside each, or as few planes as memory allows.
[[nodiscard]] inline SliceTable choose_parts(std::span<std::int32_t const> places) {
    SliceTable best{places[0], 31, 1, 0, 0, static_cast<std::uint32_t>(places.size())};
    auto const above = [&](std::size_t k) { return static_cast<std::uint32_t>(places[k]) - static_cast<std::uint32_t>(places[0]); };
    std::uint32_t const most = std::clamp(16 * best.slices, 256U, 65536U);
    std::uint32_t fewest = std::numeric_limits<std::uint32_t>::max();
    for (int shift = 31; shift >= 0; --shift) {
        std::uint32_t const parts = (above(places.size() - 1) >> shift) + 1;
        if (parts > most) break;
        std::uint32_t crowded = 0;
        std::uint32_t inside = 0;
        for (std::size_t k = 1; k < places.size(); ++k) {
            bool const starts = (above(k) & ((1U << shift) - 1U)) == 0;
            bool const new_part = above(k) >> shift != above(k - 1) >> shift;
            inside = (new_part ? 0U : inside) + (starts ? 0U : 1U);
            crowded = std::max(crowded, inside);
        }
        if (crowded >= fewest) continue;
        fewest = crowded;
        best.shift = shift;
        best.parts = parts;
        best.step = crowded == 0 ? 0U : std::bit_floor(crowded);
        if (crowded <= 1) break;
    }
    return best;
}

[[nodiscard]] inline DepthSlices tabulated(std::vector<float> planes_m) {
    std::vector<std::int32_t> places;
    for (std::size_t k = 0; k + 1 < planes_m.size(); ++k) places.push_back(math::ordinal(planes_m[k]));
    SliceTable table = choose_parts(places);
    std::vector<std::uint32_t> words;
    for (std::int32_t const place : places) words.push_back(static_cast<std::uint32_t>(place));
    for (std::uint32_t i = 0; i < table.step; ++i) words.push_back(0x7FFFFFFFU);
    table.guesses = static_cast<std::uint32_t>(words.size());
    std::uint32_t slice = 0;
    for (std::uint32_t part = 0; part < table.parts; ++part) {
        std::uint32_t const start = static_cast<std::uint32_t>(table.base) + (part << table.shift);
        while (slice + 1 < places.size() && places[slice + 1] <= static_cast<std::int32_t>(start)) ++slice;
        words.push_back(slice);
    }
    return DepthSlices(std::move(planes_m), table, std::move(words));
}

[[nodiscard]] inline SliceResult from_planes(std::vector<float> planes_m) {
    for (std::size_t k = 1; k < planes_m.size(); ++k)
        if (!(planes_m[k - 1] < planes_m[k]))
            return core::Failure{SliceError::too_thin,
                                 core::sentence({"planes ", std::to_string(k - 1), " and ", std::to_string(k), " are ",
                                           math::text_of(static_cast<double>(planes_m[k - 1])), " m and ",
                                           math::text_of(static_cast<double>(planes_m[k])),
                                           " m; each must lie beyond the one before: make fewer slices"})};
    return tabulated(std::move(planes_m));
}

/// What is wrong with a range of depths and a number of slices, or success.
struct RangeRule {
    bool above_zero = true;
    bool infinite_far = false;
};

[[nodiscard]] inline core::Result<core::Done, SliceError> validate_range(double near_m, double far_m, RangeRule rule) {
    double const largest = static_cast<double>(std::numeric_limits<float>::max());
    bool const bad_far = math::is_nan(far_m) || (far_m > largest && !(rule.infinite_far && !math::is_finite(far_m)));
    if (!math::is_finite(near_m) || near_m > largest || near_m < -largest || bad_far)
        return core::Failure{SliceError::not_finite,
                             core::sentence({"slices from ", math::text_of(near_m), " m to ", math::text_of(far_m),
                                       " m: each must be a finite float; for a view without end say open_end"})};
    if (!(near_m < far_m) || (rule.above_zero && !(near_m >= static_cast<double>(std::numeric_limits<float>::min()))))
        return core::Failure{SliceError::bad_range, core::sentence({"slices from ", math::text_of(near_m), " m to ", math::text_of(far_m),
                                                              rule.above_zero ? " m: need 0 < near < far"
                                                                              : " m: need near < far"})};
    return core::Done{};
}

[[nodiscard]] inline core::Result<core::Done, SliceError> validate_count(std::uint32_t count, std::uint32_t least) {
    if (count >= least && count <= max_slices) return core::Done{};
    return core::Failure{SliceError::bad_count,
                         core::sentence({std::to_string(count), " slices: need ", std::to_string(least), " to ",
                                   std::to_string(max_slices)})};
}

inline void end_with(std::vector<float>& planes_m, bool open_end) {
    if (open_end) planes_m.back() = std::numeric_limits<float>::infinity();
}

/// The greatest double whose power, multiplied up one by one, is not above `x`: the same on every machine.
///
/// expects: x above 1.
[[nodiscard]] inline double root_of(double x, std::uint32_t power) noexcept {
    double low = 1.0;
    double high = x;
    for (double middle = low + (high - low) / 2; low < middle && middle < high; middle = low + (high - low) / 2) {
        double product = 1.0;
        for (std::uint32_t i = 0; i < power && product <= x; ++i) product *= middle;
        (product <= x ? low : high) = middle;
    }
    return power == 1 ? x : low;
}

}  // namespace detail

inline SliceResult make_slices(std::span<float const> planes_m) {
    if (planes_m.size() < 2 || planes_m.size() > std::size_t{max_slices} + 1)
        return core::Failure{SliceError::bad_count, core::sentence({std::to_string(planes_m.size()), " planes: need 2 to ",
                                                                      std::to_string(max_slices + 1)})};
    for (std::size_t k = 0; k < planes_m.size(); ++k) {
        bool const may_be_infinite = k + 1 == planes_m.size() && !math::is_nan(planes_m[k]);
        if (!math::is_finite(planes_m[k]) && !may_be_infinite)
            return core::Failure{SliceError::not_finite, core::sentence({"plane ", std::to_string(k), " is ",
                                                                           math::text_of(static_cast<double>(planes_m[k])),
                                                                           "; only the last may be infinite"})};
    }
    return detail::from_planes({planes_m.begin(), planes_m.end()});
}

inline SliceResult make_slices(ExponentialSlices const& config) {
    if (auto range = detail::validate_range(config.near_m, config.far_m, {}); !range) return std::move(range).failure();
    if (!math::is_finite(config.extent_y) || !(config.extent_y > 0.0) || config.tiles_y == 0)
        return core::Failure{SliceError::bad_field,
                             core::sentence({"a field of ", math::text_of(config.extent_y), " in ",
                                               std::to_string(config.tiles_y),
                                               " tiles: need tan up + tan down above 0, and a tile"})};
    double const growth = 1.0 + config.extent_y / config.tiles_y;
    std::vector<float> planes_m{static_cast<float>(config.near_m)};
    double plane_m = config.near_m;
    while (plane_m < config.far_m) {
        if (planes_m.size() > max_slices || !(plane_m * growth > plane_m)) return detail::validate_count(max_slices + 1, 1).failure();
        plane_m *= growth;
        planes_m.push_back(static_cast<float>(plane_m < 3e38 ? plane_m : 3e38));
    }
    detail::end_with(planes_m, config.open_end);
    return detail::from_planes(std::move(planes_m));
}

inline SliceResult make_slices(UniformSlices const& config) {
    if (auto range = detail::validate_range(config.near_m, config.far_m, {false, false}); !range)
        return std::move(range).failure();
    if (auto count = detail::validate_count(config.count, 1); !count) return std::move(count).failure();
    std::vector<float> planes_m;
    double const step_m = (config.far_m - config.near_m) / config.count;
    for (std::uint32_t k = 0; k <= config.count; ++k)
        planes_m.push_back(static_cast<float>(k == config.count ? config.far_m : config.near_m + k * step_m));
    detail::end_with(planes_m, config.open_end);
    return detail::from_planes(std::move(planes_m));
}

inline SliceResult make_slices(UniformDepthSlices const& config) {
    if (auto range = detail::validate_range(config.near_m, config.far_m, {true, true}); !range)
        return std::move(range).failure();
    if (auto count = detail::validate_count(config.count, 1); !count) return std::move(count).failure();
    // depth t: 1 / distance is a line from 1 / near at t = 0 to 1 / far at t = 1.
    double const inverse_far = math::is_finite(config.far_m) ? config.near_m / config.far_m : 0.0;
    std::vector<float> planes_m;
    for (std::uint32_t k = 0; k < config.count; ++k) {
        double const t = static_cast<double>(k) / config.count;
        planes_m.push_back(static_cast<float>(config.near_m / (1.0 - t * (1.0 - inverse_far))));
    }
    planes_m.push_back(static_cast<float>(config.far_m));
    detail::end_with(planes_m, config.open_end);
    return detail::from_planes(std::move(planes_m));
}

inline SliceResult make_slices(FirstThenExponentialSlices const& config) {
    if (auto range = detail::validate_range(config.near_m, config.first_end_m, {}); !range)
        return std::move(range).failure();
    if (auto range = detail::validate_range(config.first_end_m, config.last_m, {}); !range)
        return std::move(range).failure();
    if (auto count = detail::validate_count(config.count, 2); !count) return std::move(count).failure();
    double const growth = detail::root_of(config.last_m / config.first_end_m, config.count - 1);
    std::vector<float> planes_m{static_cast<float>(config.near_m)};
    double plane_m = config.first_end_m;
    for (std::uint32_t k = 1; k < config.count; ++k, plane_m *= growth) planes_m.push_back(static_cast<float>(plane_m));
    planes_m.push_back(static_cast<float>(config.last_m));
    detail::end_with(planes_m, config.open_end);
    return detail::from_planes(std::move(planes_m));
}

}  // namespace gnomon::cluster
