#pragma once
// Camera paths through a few stops, and other small things that scenes with solids share.

#include "generators.hpp"

#include <gnomon/scene/path.hpp>

#include <algorithm>
#include <span>

namespace gnomon::scene::detail {

/// Where the eye stands and what it looks at.
struct Stop {
    math::dvec3 eye_m;
    math::dvec3 target_m;
};

/// The curve of Catmull and Rom through four points, from b (t = 0) to c (t = 1).
inline math::dvec3 between(math::dvec3 const& a, math::dvec3 const& b, math::dvec3 const& c, math::dvec3 const& d,
                           double t) noexcept {
    math::dvec3 const bend = a * 2.0 - b * 5.0 + c * 4.0 - d;
    math::dvec3 const twist = b * 3.0 - a - c * 3.0 + d;
    return b + (c - a + (bend + twist * t) * t) * (0.5 * t);
}

/// The stop at `s` in [0, stops - 1].
inline Stop stop_at(std::span<Stop const> stops, double s) noexcept {
    std::size_t const last = stops.size() - 1;
    std::size_t const i = std::min(static_cast<std::size_t>(s), last - 1);
    Stop const& before = stops[i == 0 ? 0 : i - 1];
    Stop const& after = stops[std::min(i + 2, last)];
    double const t = s - static_cast<double>(i);
    return {between(before.eye_m, stops[i].eye_m, stops[i + 1].eye_m, after.eye_m, t),
            between(before.target_m, stops[i].target_m, stops[i + 1].target_m, after.target_m, t)};
}

/// How a path sees.
struct Lens {
    double fov_y_rad = sixty_degrees_rad;
    double near_m = 0.1;
    double far_m = 1000.0;
};

/// A path that takes as many frames from each stop to the next.
///
/// expects: two stops or more.
inline CameraPath path_along(PathInfo const& info, std::span<Stop const> stops, Lens const& lens) {
    CameraPath path{std::string(info.name), info.rate_hz, {}};
    for (std::uint32_t i = 0; i < info.frames; ++i) {
        Stop const stop = stop_at(stops, static_cast<double>(i) * static_cast<double>(stops.size() - 1) / (info.frames - 1));
        Camera& camera = path.frames.emplace_back(looking_at("", stop.eye_m, stop.target_m, lens.fov_y_rad));
        camera.near_m = lens.near_m;
        camera.far_m = lens.far_m;
    }
    return path;
}

inline Camera view_from(std::string name, Stop const& stop, Lens const& lens) {
    Camera camera = looking_at(std::move(name), stop.eye_m, stop.target_m, lens.fov_y_rad);
    camera.near_m = lens.near_m;
    camera.far_m = lens.far_m;
    return camera;
}

}  // namespace gnomon::scene::detail
