#pragma once
// The checked ways to make a view; see view.hpp.

#include <gnomon/math/text.hpp>
#include <gnomon/math/view.hpp>

#include <cmath>
#include <string>
#include <string_view>
#include <utility>

namespace gnomon::math {

namespace detail {

/// The first thing wrong with what both kinds of view share, or success.
inline core::Result<core::Done, ViewError> validate_pose(dvec3 const& eye_m, dvec3 const& target_m, ivec2 const& size_px) {
    if (!is_finite(eye_m) || !is_finite(target_m))
        return core::Failure{ViewError::not_finite, core::sentence({"eye ", text_of(eye_m), " and target ", text_of(target_m),
                                                              " must be finite numbers of metres"})};
    if (eye_m == target_m)
        return core::Failure{ViewError::no_direction,
                             core::sentence({"eye and target are the same point ", text_of(eye_m), ": move one of them"})};
    if (size_px.x < 1 || size_px.y < 1)
        return core::Failure{ViewError::empty_image,
                             core::sentence({"the image is ", std::to_string(size_px.x), "x", std::to_string(size_px.y),
                                       " pixels; it needs at least 1x1"})};
    return core::Done{};
}

inline core::Failure<ViewError> bad_depth_range(double near_m, double far_m, std::string_view rule) {
    return {ViewError::bad_depth_range, core::sentence({"near ", text_of(near_m), " m and far ", text_of(far_m), " m: ", rule})};
}

}  // namespace detail

inline View looking_along(View view, dvec3 const& direction, dvec3 const& up) noexcept {
    // Scaled by the largest component first, so that neither huge nor tiny directions lose their length.
    auto const unit = [](dvec3 const& v) {
        double const largest = glm::max(glm::max(std::abs(v.x), std::abs(v.y)), std::abs(v.z));
        return glm::normalize(v / largest);
    };
    view.back = -unit(direction);
    dvec3 side = is_finite(up) && up != dvec3(0.0) ? glm::cross(unit(up), view.back) : dvec3(0.0);
    // Below this the cross product is mostly rounding: any axis gives a better frame than `up` does.
    constexpr double parallel = 1e-9;
    if (!(glm::dot(side, side) > parallel * parallel)) {
        dvec3 const size(std::abs(view.back.x), std::abs(view.back.y), std::abs(view.back.z));
        dvec3 const axis = size.x <= size.y && size.x <= size.z   ? dvec3(1.0, 0.0, 0.0)
                           : size.y <= size.x && size.y <= size.z ? dvec3(0.0, 1.0, 0.0)
                                                                  : dvec3(0.0, 0.0, 1.0);
        side = glm::cross(axis, view.back);
    }
    view.right = glm::normalize(side);
    view.up = glm::cross(view.back, view.right);
    return view;
}

inline core::Result<View, ViewError> make_perspective(PerspectiveConfig const& config) {
    if (auto pose = detail::validate_pose(config.eye_m, config.target_m, config.size_px); !pose)
        return std::move(pose).failure();
    constexpr double pi = 3.14159265358979323846;
    if (!(config.fov_y_rad > 0.0 && config.fov_y_rad < pi))
        return core::Failure{ViewError::bad_field,
                             core::sentence({"a vertical field of view of ", text_of(config.fov_y_rad * 180.0 / pi),
                                               " degrees; it must be above 0 and below 180"})};
    if (!(config.near_m > 0.0 && config.near_m < config.far_m && is_finite(config.near_m)))
        return detail::bad_depth_range(config.near_m, config.far_m, "a perspective view needs 0 < near < far");
    View view;
    view.eye_m = config.eye_m;
    double const half_height = std::tan(config.fov_y_rad * 0.5);
    double const half_width = half_height * config.size_px.x / config.size_px.y;
    view.window = {-half_width, half_width, -half_height, half_height};
    view.near_m = config.near_m;
    view.far_m = config.far_m;
    view.size_px = config.size_px;
    view.depth = config.depth;
    return looking_along(view, config.target_m - config.eye_m, config.up);
}

inline core::Result<View, ViewError> make_orthographic(OrthographicConfig const& config) {
    if (auto pose = detail::validate_pose(config.eye_m, config.target_m, config.size_px); !pose)
        return std::move(pose).failure();
    Window const& w = config.window_m;
    bool const finite = is_finite(w.left) && is_finite(w.right) && is_finite(w.bottom) && is_finite(w.top);
    if (!finite || !(w.left < w.right && w.bottom < w.top))
        return core::Failure{ViewError::bad_field,
                             core::sentence({"an orthographic window from (", text_of(w.left), ", ",
                                               text_of(w.bottom), ") to (", text_of(w.right), ", ",
                                               text_of(w.top), ") m; it needs an area above 0"})};
    if (!(config.near_m < config.far_m && is_finite(config.near_m) && is_finite(config.far_m)))
        return detail::bad_depth_range(config.near_m, config.far_m,
                                       "an orthographic view needs near < far, both finite");
    View view;
    view.eye_m = config.eye_m;
    view.window = w;
    view.near_m = config.near_m;
    view.far_m = config.far_m;
    view.size_px = config.size_px;
    view.lens = Lens::orthographic;
    view.depth = config.depth;
    return looking_along(view, config.target_m - config.eye_m, config.up);
}

}  // namespace gnomon::math
