#pragma once
// View samples in float, as a GPU reconstructs them, with the bound of what that costs. `make_view_sample` stays the
// definition: what must be the same on every backend is decided on its samples.

#include <gnomon/math/view.hpp>
#include <gnomon/sample/formula/reconstruct.glsl>
#include <gnomon/sample/view_sample.hpp>

#include <cstddef>

namespace gnomon::sample {

/// The rays of a camera's pixels; a shader gets the same bytes.
using RayCamera = formula::GnRayCamera;

static_assert(sizeof(RayCamera) == 80 && offsetof(RayCamera, eye) == 0 && offsetof(RayCamera, perspective) == 12 &&
              offsetof(RayCamera, corner) == 16 && offsetof(RayCamera, dx) == 32 && offsetof(RayCamera, dy) == 48 &&
              offsetof(RayCamera, forward) == 64);

/// The rays of `view`, for positions that are world minus `origin_m`. Each number is rounded once.
[[nodiscard]] inline RayCamera make_ray_camera(math::View const& view, math::dvec3 const& origin_m) noexcept {
    math::Window const& w = view.window;
    bool const perspective = view.lens == math::Lens::perspective;
    math::dvec3 const top_left = view.right * w.left + view.up * w.top;
    RayCamera camera{};
    camera.eye = math::to_float(view.eye_m - origin_m);
    camera.perspective = perspective ? 1U : 0U;
    camera.corner = math::to_float(perspective ? top_left - view.back : top_left);
    camera.dx = math::to_float(view.right * ((w.right - w.left) / view.size_px.x));
    camera.dy = math::to_float(view.up * ((w.bottom - w.top) / view.size_px.y));
    camera.forward = math::to_float(-view.back);
    return camera;
}

/// A point of a triangle's plane, and how far it may be off.
struct Reconstructed {
    math::vec3 position{0.0F};
    math::vec3 error{0.0F};  ///< Of each coordinate, metres, against the ray's exact crossing with the plane.
    math::vec3 normal{0.0F};
    float normal_error = 0.0F;
    bool usable = false;  ///< False: the plane is edge on as far as float can tell; nothing else means anything.
};

/// The float sample of image point `px`.
///
/// expects: a triangle whose differences of coordinates are zero or between 1e-9 and 1e9 metres.
/// returns: where the ray meets the triangle, the exact sample's position within `error` and 6 half units of the last
///          place of its largest coordinate (that is rounded, and may be moved to the eye's side).
[[nodiscard]] inline Reconstructed reconstruct(RayCamera const& camera, math::vec2 const& px,
                                               Triangle const& t) noexcept {
    using Vec3 = formula::Vec3<float>;
    formula::GnReconstructed<float> const made =
        gn_reconstruct(camera, formula::Vec2<float>(px), Vec3(t[0]), Vec3(t[1]), Vec3(t[2]));
    return {math::vec3(made.position), math::vec3(made.error), math::vec3(made.normal), made.normal_error.v,
            made.usable.v};
}

}  // namespace gnomon::sample
