#pragma once
// A spot's view: perspective, just wide enough for the outer cone.

#include <gnomon/projection/error.hpp>

#include <cmath>

namespace gnomon::projection {

struct SpotConfig {
    math::dvec3 position_m{0.0, 0.0, 0.0};
    math::dvec3 direction{0.0, -1.0, 0.0};  ///< The way the light travels, any length above 0.
    math::dvec3 up{0.0, 1.0, 0.0};
    double outer_cone_rad = 0.7853981633974483;  ///< Half angle, above 0 and below 89 degrees.
    double near_m = 0.05;                        ///< See `depth_range` for one that fits a scene.
    double far_m = std::numeric_limits<double>::infinity();
    math::ivec2 size_px{1024, 1024};
    double margin_px = 2.0;  ///< Texels left free round the cone.
    math::Depth depth = math::Depth::reversed;
};

/// The half angle that one perspective map can still hold: 89 degrees; wider spots need cube faces.
inline constexpr double widest_spot_rad = 1.5533430342749532;

/// The view whose window holds the cone with `margin_px` texels to spare.
///
///     window = +- tan(outer) * size / (size - 2 margin)
///
/// returns: a view, or the value that is wrong.
[[nodiscard]] inline core::Result<math::View, Error> spot_view(SpotConfig const& config) {
    if (auto ok = detail::validate_position(config.position_m); !ok) return std::move(ok).failure();
    if (auto ok = detail::validate_direction(config.direction); !ok) return std::move(ok).failure();
    if (auto ok = detail::validate_map(config.size_px); !ok) return std::move(ok).failure();
    if (auto ok = detail::validate_depth(config.near_m, config.far_m); !ok) return std::move(ok).failure();
    if (!(config.outer_cone_rad > 0.0 && config.outer_cone_rad < widest_spot_rad)) {
        constexpr double degrees = 57.295779513082323;
        return core::Failure{Error::bad_cone, "the spot's half angle is " +
                                                  math::text_of(config.outer_cone_rad * degrees) +
                                                  " degrees; a shadow map needs above 0 and below 89"};
    }
    math::View view;
    view.eye_m = config.position_m;
    view.near_m = config.near_m;
    view.far_m = config.far_m;
    view.size_px = config.size_px;
    view.depth = config.depth;
    // One part in 2^20 more, so that rounding the matrix to float leaves the cone's rim inside.
    double const half = std::tan(config.outer_cone_rad) * (1.0 + std::ldexp(1.0, -20));
    double const x = half * detail::widening(config.size_px.x, config.margin_px);
    double const y = half * detail::widening(config.size_px.y, config.margin_px);
    view.window = {-x, x, -y, y};
    return math::looking_along(view, config.direction, config.up);
}

}  // namespace gnomon::projection
