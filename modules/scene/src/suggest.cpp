#include <gnomon/scene/suggest.hpp>

#include "detail/generators.hpp"

#include <algorithm>
#include <cmath>

namespace gnomon::scene {

Light default_sun() { return detail::sun_light(); }

core::Result<math::View, math::ViewError> make_view(Camera const& camera, math::ivec2 const& size_px, math::Depth depth) {
    bool const perspective = camera.kind == CameraKind::perspective;
    auto framed = [&] {
        math::dvec3 const target = camera.eye_m - camera.back;
        double const aspect = static_cast<double>(size_px.x) / std::max(size_px.y, 1);
        double const half = camera.half_height_m;
        if (perspective)
            return math::make_perspective({camera.eye_m, target, camera.up, camera.fov_y_rad, camera.near_m,
                                           camera.far_m, size_px, depth});
        return math::make_orthographic({camera.eye_m, target, camera.up, {-half * aspect, half * aspect, -half, half},
                                        camera.near_m, camera.far_m, size_px, depth});
    }();
    if (!framed) return framed;
    // The camera's own axes, rather than those that target and up give again, rounded.
    framed->right = camera.right;
    framed->up = camera.up;
    framed->back = camera.back;
    return framed;
}

SuggestedView auto_view(Geometry const& geometry) {
    SuggestedView view;
    if (math::is_empty(geometry.bounds)) return view;
    math::dvec3 const lo = math::to_double(geometry.bounds.lo);
    math::dvec3 const hi = math::to_double(geometry.bounds.hi);
    double const radius = std::max(glm::length(hi - lo) * 0.5, 1e-6);
    view.fov_y_rad = detail::sixty_degrees_rad * 0.75;
    view.target_m = geometry.origin_m + (lo + hi) * 0.5;
    math::dvec3 const away = glm::normalize(math::dvec3(-0.6, 0.5, 0.8));
    view.eye_m = view.target_m + away * (radius / std::sin(view.fov_y_rad * 0.5));
    view.near_m = radius * 1e-3;
    return view;
}

SuggestedView auto_view(Scene const& scene) { return auto_view(flatten(scene)); }

}  // namespace gnomon::scene
