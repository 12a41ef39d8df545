#pragma once
// Why a light has no view, and the checks that every kind of light shares.

#include <gnomon/core/result.hpp>
#include <gnomon/math/bounds.hpp>
#include <gnomon/math/scalar.hpp>
#include <gnomon/math/text.hpp>
#include <gnomon/math/vec.hpp>
#include <gnomon/math/view.hpp>

#include <cstdint>
#include <string>

namespace gnomon::projection {

enum class Error : std::uint8_t {
    no_direction,     ///< The light's direction has no length: give one, such as (0, -1, 0).
    not_finite,       ///< A position, direction, range or bound is NaN or infinite.
    empty_bounds,     ///< There is nothing to fit the map to.
    bad_cone,         ///< The cone's half angle is not above 0 and below 89 degrees.
    bad_depth_range,  ///< Not 0 < near < far.
    empty_map,        ///< The map has no texels.
};

namespace detail {

inline core::Result<core::Done, Error> validate_direction(math::dvec3 const& direction) {
    if (!math::is_finite(direction))
        return core::Failure{Error::not_finite, "the light's direction " + math::text_of(direction) + " is not finite"};
    if (direction == math::dvec3(0.0))
        return core::Failure{Error::no_direction, "the light's direction " + math::text_of(direction) +
                                                      " has no length: give one, such as (0, -1, 0)"};
    return core::Done{};
}

inline core::Result<core::Done, Error> validate_position(math::dvec3 const& position_m) {
    if (!math::is_finite(position_m))
        return core::Failure{Error::not_finite, "the light's position " + math::text_of(position_m) + " is not finite"};
    return core::Done{};
}

inline core::Result<core::Done, Error> validate_map(math::ivec2 const& size_px) {
    if (size_px.x < 1 || size_px.y < 1)
        return core::Failure{Error::empty_map, "the shadow map is " + std::to_string(size_px.x) + "x" +
                                                   std::to_string(size_px.y) + " texels; it needs at least 1x1"};
    return core::Done{};
}

inline core::Result<core::Done, Error> validate_depth(double near_m, double far_m) {
    if (!(near_m > 0.0 && near_m < far_m && math::is_finite(near_m)))
        return core::Failure{Error::bad_depth_range, core::sentence({"near ", math::text_of(near_m), " m and far ", math::text_of(far_m),
                                                                       " m: a light needs 0 < near < far"})};
    return core::Done{};
}

/// How many times wider a window of `size_px` texels is, if `margin_px` texels on each side surround the fitted part.
///
/// A margin that leaves no texel in the middle is cut to what leaves one.
inline double widening(std::int32_t size_px, double margin_px) noexcept {
    double const size = size_px;
    double const margin = margin_px > 0.0 ? margin_px : 0.0;
    double const inner = size - 2.0 * margin;
    return size / (inner > 1.0 ? inner : 1.0);
}

}  // namespace detail

}  // namespace gnomon::projection
