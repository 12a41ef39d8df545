#pragma once
// A view: where an eye stands, how it is turned, and the window it looks through. Cameras and lights are views.
//
// Right-handed, looks down -z of its own frame; Vulkan clip space: depth in [0, 1], y down, pixel (0, 0) top left with
// its centre at (0.5, 0.5). Everything is double; the matrices that leave it are rounded to float once. Positions go in
// relative to the eye, so that a view 1e7 m from the world's origin is as exact as one that stands on it.

#include <gnomon/core/result.hpp>
#include <gnomon/math/formula/view.glsl>
#include <gnomon/math/scalar.hpp>
#include <gnomon/math/vec.hpp>

#include <cstdint>
#include <limits>

namespace gnomon::math {

enum class Lens : std::uint8_t {
    perspective,
    orthographic,
};

enum class Depth : std::uint8_t {
    forward,   ///< 0 at near, 1 at far; cleared to 1; a smaller depth is nearer.
    reversed,  ///< 1 at near, 0 at far; cleared to 0; a greater depth is nearer.
};

/// The image's borders on the plane one metre in front of the eye (perspective: tangents of the angles from the axis),
/// or in metres (orthographic). Off-centre and jittered windows are ordinary ones.
struct Window {
    double left = -1.0;
    double right = 1.0;
    double bottom = -1.0;
    double top = 1.0;
};

/// expects: made by a `make_` function, or left alone but for moves that keep `right`, `up`, `back` orthonormal.
struct View {
    dvec3 eye_m{0.0, 0.0, 0.0};
    dvec3 right{1.0, 0.0, 0.0};
    dvec3 up{0.0, 1.0, 0.0};
    dvec3 back{0.0, 0.0, 1.0};  ///< Against the direction of sight: the frame's +z.
    Window window;
    double near_m = 0.1;
    double far_m = std::numeric_limits<double>::infinity();  ///< Infinite only with perspective.
    ivec2 size_px{1, 1};
    Lens lens = Lens::perspective;
    Depth depth = Depth::reversed;
};

enum class ViewError : std::uint8_t {
    not_finite,       ///< A position, direction or length is NaN or infinite: give a finite one.
    no_direction,     ///< Eye and target coincide: move one of them.
    bad_field,        ///< The field of view is not in (0, 180) degrees, or the extent not above 0.
    bad_depth_range,  ///< Not 0 < near < far (orthographic: near < far, far finite).
    empty_image,      ///< A width or height below 1 pixel.
};

/// What a camera is given as: eye, target, field of view.
struct PerspectiveConfig {
    dvec3 eye_m{0.0, 0.0, 0.0};
    dvec3 target_m{0.0, 0.0, -1.0};
    dvec3 up{0.0, 1.0, 0.0};  ///< Replaced by a stable axis when it is parallel to the direction of sight.
    double fov_y_rad = 1.0471975511965976;
    double near_m = 0.1;
    double far_m = std::numeric_limits<double>::infinity();
    ivec2 size_px{1, 1};
    Depth depth = Depth::reversed;
};

struct OrthographicConfig {
    dvec3 eye_m{0.0, 0.0, 0.0};
    dvec3 target_m{0.0, 0.0, -1.0};
    dvec3 up{0.0, 1.0, 0.0};
    Window window_m;
    double near_m = 0.0;
    double far_m = 1.0;
    ivec2 size_px{1, 1};
    Depth depth = Depth::reversed;
};

/// Turns `view` to look along `direction` (any length above 0), as upright as `up` allows.
///
/// returns: the view with an orthonormal frame. Where `up` is parallel to `direction` (or not finite), the world axis
///          least aligned with the direction takes its place, so a light straight overhead has a frame too.
[[nodiscard]] View looking_along(View view, dvec3 const& direction, dvec3 const& up) noexcept;

[[nodiscard]] core::Result<View, ViewError> make_perspective(PerspectiveConfig const& config);
[[nodiscard]] core::Result<View, ViewError> make_orthographic(OrthographicConfig const& config);

/// The view with its window moved by a fraction of a pixel: +x moves the image's content left by that many pixels.
[[nodiscard]] inline View jittered(View view, dvec2 const& offset_px) noexcept {
    double const dx = (view.window.right - view.window.left) / view.size_px.x * offset_px.x;
    double const dy = (view.window.top - view.window.bottom) / view.size_px.y * offset_px.y;
    view.window.left += dx;
    view.window.right += dx;
    view.window.bottom -= dy;
    view.window.top -= dy;
    return view;
}

/// Clip-space depth as a line in the distance d along the axis: z_clip = scale * d + offset; w_clip = d (or 1).
struct DepthLine {
    double scale;
    double offset;
};

/// The four rows of the paper's projections, forward and reversed, with the limit far -> infinity taken exactly.
[[nodiscard]] inline DepthLine depth_line(View const& view) noexcept {
    double const n = view.near_m;
    double const f = view.far_m;
    bool const reversed = view.depth == Depth::reversed;
    if (view.lens == Lens::orthographic)
        return reversed ? DepthLine{-1.0 / (f - n), f / (f - n)} : DepthLine{1.0 / (f - n), -n / (f - n)};
    if (!is_finite(f)) return reversed ? DepthLine{0.0, n} : DepthLine{1.0, -n};
    double const offset = f * n / (f - n);
    return reversed ? DepthLine{-n / (f - n), offset} : DepthLine{f / (f - n), -offset};
}

/// Depth in [0, 1] of a point `distance_m` in front of the eye, along the axis of sight.
[[nodiscard]] inline double depth_from_distance(View const& view, double distance_m) noexcept {
    DepthLine const line = depth_line(view);
    return gn_depth_from_distance(formula::Float<double>(line.scale), formula::Float<double>(line.offset),
                                  view.lens == Lens::perspective, formula::Float<double>(distance_m))
        .v;
}

/// The distance along the axis of sight that has `depth`; infinite at an infinite far plane.
[[nodiscard]] inline double distance_from_depth(View const& view, double depth) noexcept {
    DepthLine const line = depth_line(view);
    return gn_distance_from_depth(formula::Float<double>(line.scale), formula::Float<double>(line.offset),
                                  view.lens == Lens::perspective, formula::Float<double>(depth))
        .v;
}

/// Clip coordinates from a position relative to the eye (world axes, metres).
[[nodiscard]] inline dmat4 clip_from_relative_exact(View const& view) noexcept {
    Window const& w = view.window;
    DepthLine const line = depth_line(view);
    double const sx = 2.0 / (w.right - w.left);
    double const sy = -2.0 / (w.top - w.bottom);
    double const ox = -(w.right + w.left) / (w.right - w.left);
    double const oy = (w.top + w.bottom) / (w.top - w.bottom);
    bool const ortho = view.lens == Lens::orthographic;
    dmat4 m(0.0);
    for (axis_t axis = 0; axis < 3; ++axis) {
        double const distance = -view.back[axis];
        m[axis][0] = sx * view.right[axis] + (ortho ? 0.0 : ox * distance);
        m[axis][1] = sy * view.up[axis] + (ortho ? 0.0 : oy * distance);
        m[axis][2] = line.scale * distance;
        m[axis][3] = ortho ? 0.0 : distance;
    }
    m[3] = ortho ? dvec4(ox, oy, line.offset, 1.0) : dvec4(0.0, 0.0, line.offset, 0.0);
    return m;
}

/// `clip_from_relative_exact`, each element rounded to float.
[[nodiscard]] inline mat4 clip_from_relative(View const& view) noexcept { return to_float(clip_from_relative_exact(view)); }

/// A ray in world axes: the points `start_m + d * step`, d metres along the axis of sight; start is relative to the eye.
struct PixelRay {
    dvec3 start_m;
    dvec3 step;
};

/// The ray through the image point `px` (pixels, y down; a pixel's centre is at +0.5).
[[nodiscard]] inline PixelRay pixel_ray(View const& view, dvec2 const& px) noexcept {
    Window const& w = view.window;
    double const x = w.left + (w.right - w.left) * (px.x / view.size_px.x);
    double const y = w.top - (w.top - w.bottom) * (px.y / view.size_px.y);
    dvec3 const across = view.right * x + view.up * y;
    if (view.lens == Lens::orthographic) return {across, -view.back};
    return {dvec3(0.0), across - view.back};
}

/// Image point and depth of a position relative to the eye.
///
/// returns: (x px, y px, depth). With perspective a point on the eye's own plane gives infinities or NaN.
[[nodiscard]] inline dvec3 project(View const& view, dvec3 const& relative_m) noexcept {
    double const x = glm::dot(view.right, relative_m);
    double const y = glm::dot(view.up, relative_m);
    double const distance = -glm::dot(view.back, relative_m);
    double const scale = view.lens == Lens::orthographic ? 1.0 : 1.0 / distance;
    Window const& w = view.window;
    return dvec3((x * scale - w.left) / (w.right - w.left) * view.size_px.x,
                 (w.top - y * scale) / (w.top - w.bottom) * view.size_px.y, depth_from_distance(view, distance));
}

/// Size of one pixel or texel in metres at `distance_m` along the axis of sight.
[[nodiscard]] inline dvec2 pixel_size_m(View const& view, double distance_m) noexcept {
    double const scale = view.lens == Lens::orthographic ? 1.0 : distance_m;
    return dvec2((view.window.right - view.window.left) / view.size_px.x * scale,
                 (view.window.top - view.window.bottom) / view.size_px.y * scale);
}

}  // namespace gnomon::math

#include <gnomon/math/detail/make_view.hpp>
