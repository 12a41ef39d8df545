#include <gnomon/scene/path.hpp>

#include <gnomon/scene/suggest.hpp>

#include "detail/generators.hpp"
#include "detail/turn.hpp"

#include <algorithm>
#include <cmath>

namespace gnomon::scene {

namespace {

using math::dvec3;

/// Looks along `forward` from `eye_m`, with the range that suits something of this size.
Camera orbit_frame(dvec3 const& eye_m, dvec3 const& forward, SuggestedView const& view) {
    Camera camera = looking_at("", eye_m, eye_m + forward, view.fov_y_rad);
    camera.near_m = view.near_m;
    return camera;
}

/// `v` turned about the vertical axis.
dvec3 turned(dvec3 const& v, detail::SinCos const& by) noexcept {
    return {v.x * by.cos + v.z * by.sin, v.y, v.z * by.cos - v.x * by.sin};
}

/// A view that stays outside the upright cylinder round the bounds wherever it is turned about their middle.
SuggestedView moved_out(SuggestedView view, Geometry const& geometry, dvec3 const& middle) {
    constexpr double clear = 1.05;
    dvec3 const half = (math::to_double(geometry.bounds.hi) - math::to_double(geometry.bounds.lo)) * 0.5;
    double const cylinder = std::sqrt(half.x * half.x + half.z * half.z);
    dvec3 away = view.eye_m - middle;
    double const level = std::sqrt(away.x * away.x + away.z * away.z);
    double const scale = level > 0.0 ? std::max(1.0, clear * cylinder / level) : 1.0;
    view.eye_m = middle + dvec3(away.x * scale, away.y, away.z * scale);
    view.target_m = middle;
    view.fov_y_rad = detail::pi * 0.25;
    double const gap = level * scale - cylinder;
    view.near_m = gap > 0.0 ? std::min(view.near_m, gap) : view.near_m;
    return view;
}

}  // namespace

CameraPath orbit(Geometry const& geometry, std::uint32_t frames) {
    GNOMON_EXPECT(frames > 0);
    bool const empty = math::is_empty(geometry.bounds);
    SuggestedView view = auto_view(geometry);
    dvec3 const lo = empty ? dvec3(-1.0) : math::to_double(geometry.bounds.lo);
    dvec3 const hi = empty ? dvec3(1.0) : math::to_double(geometry.bounds.hi);
    dvec3 middle = geometry.origin_m + (lo + hi) * 0.5;
    if (empty) view.eye_m = middle + dvec3(0.0, 1.0, 3.0);
    if (!view.inside && !empty) view = moved_out(view, geometry, middle);
    if (view.inside) middle = view.eye_m;
    // Turning on the spot shows what is nearer than anything that the one view saw.
    if (view.inside) view.near_m *= 0.25;
    dvec3 const eye = view.eye_m - middle;
    dvec3 const forward = (view.inside ? view.target_m : middle) - view.eye_m;
    CameraPath path{view.inside ? "turn" : "orbit", 30.0, {}};
    for (std::uint32_t i = 0; i < frames; ++i) {
        detail::SinCos const by = detail::sin_cos(static_cast<double>(i) / frames);
        path.frames.push_back(orbit_frame(middle + turned(eye, by), turned(forward, by), view));
    }
    return path;
}

}  // namespace gnomon::scene
