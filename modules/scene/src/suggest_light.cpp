// Which light to switch on when nobody said.

#include <gnomon/scene/suggest.hpp>

#include "detail/coarse_grid.hpp"
#include "detail/generators.hpp"

#include <cmath>

namespace gnomon::scene {

namespace {

using detail::CoarseGrid;
using detail::GridHit;
using math::dvec3;

/// What an even grid of pixels shows, in work space.
struct Seen {
    int points = 0;
    int sunny = 0;  ///< From which nothing stands before the sun.
    dvec3 mean{0.0, 0.0, 0.0};
};

Seen look(CoarseGrid const& grid, math::View const& view, dvec3 const& eye, dvec3 const& to_sun) {
    constexpr int side = 16;
    Seen seen;
    for (int row = 0; row < side; ++row)
        for (int column = 0; column < side; ++column) {
            math::dvec2 const px(view.size_px.x * (column + 0.5) / side, view.size_px.y * (row + 0.5) / side);
            math::PixelRay const ray = math::pixel_ray(view, px);
            GridHit const hit = grid.cast(eye + ray.start_m, ray.step);
            if (hit.triangle == none) continue;
            dvec3 const point = eye + ray.start_m + ray.step * (hit.distance * 0.999);
            ++seen.points;
            seen.mean += point;
            if (grid.cast(point, to_sun).triangle == none) ++seen.sunny;
        }
    if (seen.points > 0) seen.mean /= seen.points;
    return seen;
}

/// To three digits of `scale`, so that a place can be read and typed again.
double rounded_to(double x, double scale) {
    double const steps = std::pow(10.0, 2.0 - std::floor(std::log10(scale)));
    return std::round(x * steps) / steps;
}

Light lamp_between(CoarseGrid const& grid, dvec3 const& eye, dvec3 const& seen, dvec3 const& origin_m) {
    dvec3 const middle = (eye + seen) * 0.5;
    double const reach = glm::length(seen - eye);
    GridHit const ceiling = grid.cast(middle, dvec3(0.013, 1.0, 0.011));
    double const height = ceiling.triangle == none ? 0.5 * reach : 0.6 * ceiling.distance;
    Light lamp;
    lamp.name = "lamp";
    lamp.kind = LightKind::point;
    lamp.position_m = origin_m + middle + dvec3(0.0, height, 0.0);
    for (math::axis_t axis = 0; axis < 3; ++axis) lamp.position_m[axis] = rounded_to(lamp.position_m[axis], reach);
    return lamp;
}

}  // namespace

Light default_sun() { return detail::sun_light(); }

Light auto_light(Geometry const& geometry, math::View const& view) {
    Light const sun = default_sun();
    if (math::is_empty(geometry.bounds)) return sun;
    CoarseGrid const grid(geometry);
    dvec3 const eye = view.eye_m - geometry.origin_m;
    Seen const seen = look(grid, view, eye, -sun.direction);
    if (seen.sunny * 20 >= seen.points) return sun;
    return lamp_between(grid, eye, seen.mean, geometry.origin_m);
}

}  // namespace gnomon::scene
