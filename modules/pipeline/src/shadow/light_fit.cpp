// Where a light's maps look, and how near its nearest caster is.

#include "light_fit.hpp"

#include <gnomon/projection.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace gnomon::pipeline {

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

core::Failure<Error> bad_light(core::Failure<projection::Error> const& why) { return {Error::bad_light, why.message}; }

/// Of the triangles [begin, end).
double nearest_of(scene::Geometry const& g, math::dvec3 const& light, std::size_t begin, std::size_t end) {
    double nearest = infinity;
    for (std::size_t t = begin; t < end; ++t) {
        math::Aabb box;
        for (std::size_t c = 0; c < 3; ++c) box = math::extended(box, g.positions[g.indices[t * 3 + c]]);
        nearest = std::min(nearest, projection::distances_to(box, light).near_m);
    }
    return nearest;
}

/// A distance, or the next step of a fourth of an octave: no farther, or no nearer.
double stepped(double distance_m, RangeFit fit, bool up) noexcept {
    if (fit == RangeFit::tight || !(distance_m > 0.0) || !std::isfinite(distance_m)) return distance_m;
    constexpr std::array<double, 5> steps{0.5, 0.5946035575013605, 0.7071067811865476, 0.8408964152537145, 1.0};
    int exponent = 0;
    double const part = std::frexp(distance_m, &exponent);  // [0.5, 1)
    std::size_t at = 3;
    while (steps[at] > part) --at;
    if (up && steps[at] < part) ++at;
    return std::ldexp(steps[at], exponent);
}

}  // namespace

double NearestCaster::operator()(scene::Geometry const& g, LightPlace const& at, core::ExecutorRef executor) {
    if (at.light.kind == LightKind::directional) return 0.0;
    math::vec3 const& light = at.position;
    bool const other = identity_ != g.identity || light != light_ || of_range_.size() != g.ranges.size() || g.instance_revision.size() != revisions_.size();
    if (other) of_range_.assign(g.ranges.size(), infinity);
    executor.parallel_for(g.ranges.size(), 8, [&](std::size_t begin, std::size_t end) {
        for (std::size_t r = begin; r < end; ++r) {
            scene::Range const& range = g.ranges[r];
            if (!other && revisions_[range.instance] == g.instance_revision[range.instance]) continue;
            of_range_[r] = nearest_of(g, math::to_double(light), range.first_triangle, std::size_t{range.first_triangle} + range.triangle_count);
        }
    });
    identity_ = g.identity;
    light_ = light;
    revisions_ = g.instance_revision;
    return of_range_.empty() ? infinity : *std::min_element(of_range_.begin(), of_range_.end());
}

Result<std::vector<math::View>> light_views(Frame const& frame, LightPlace const& at, ShadowMapOptions const& options, double nearest_m) {
    double const margin = 0.5 * options.lookup.taps + 1.0;
    math::dvec3 const origin = frame.geometry->origin_m;
    if (at.light.kind == LightKind::directional) {
        projection::DirectionalConfig config;
        config.origin_m = origin;
        config.size_px = math::ivec2(options.resolution, options.resolution);
        config.margin_px = margin;
        config.depth = options.depth;
        math::dvec3 const way = -math::to_double(at.to_light);
        auto view = projection::directional_view(way, frame.bounds, {}, config);
        if (!view) return bad_light(view.failure());
        return std::vector<math::View>{*view};
    }
    math::dvec3 const position = math::to_double(at.position);
    double const farthest = stepped(projection::distances_to(frame.bounds, position).far_m, options.fit, true);
    double const nearest = stepped(nearest_m, options.fit, false);
    auto const range_m = static_cast<double>(at.light.range_m);
    auto const outer = static_cast<double>(at.light.outer_cone_rad);
    if (at.light.kind == LightKind::spot && outer < projection::widest_spot_rad) {
        projection::SpotConfig config;
        double const corner = std::sqrt(2.0) * std::tan(outer) * 1.1;
        projection::DepthRange const range =
            projection::depth_range(nearest, farthest, range_m, 1.0 / std::sqrt(1.0 + corner * corner));
        config.position_m = origin + position;
        config.direction = at.light.direction;
        config.outer_cone_rad = outer;
        config.near_m = range.near_m;
        config.far_m = range.far_m;
        config.size_px = math::ivec2(options.resolution, options.resolution);
        config.margin_px = margin;
        config.depth = options.depth;
        auto view = projection::spot_view(config);
        if (!view) return bad_light(view.failure());
        return std::vector<math::View>{*view};
    }
    projection::DepthRange const range = projection::depth_range(nearest, farthest, range_m, 0.5);
    auto views = projection::cube_views(
        {origin + position, range.near_m, range.far_m, options.resolution, margin, options.depth});
    if (!views) return bad_light(views.failure());
    return std::vector<math::View>(views->begin(), views->end());
}

}  // namespace gnomon::pipeline
