#pragma once
// View samples: the points of surfaces that a picture's pixels show, as floats that every technique shares.
//
// A sample is computed from its triangle and the pixel centre, never from a depth buffer, and lies on the eye's side of
// its own plane, or in it, by an exact test. Work space: float positions relative to a frame's origin.
//
// The eye's convention: for the exact tests the eye is a float3 in work space, rounded once (`eye_of`); an orthographic
// view's eye is at infinity, in the direction `back` rounded once.

#include <gnomon/core/id.hpp>
#include <gnomon/math/vec.hpp>
#include <gnomon/math/view.hpp>
#include <gnomon/predicates/orient.hpp>
#include <gnomon/predicates/target.hpp>
#include <gnomon/sample/detail/place.hpp>

#include <array>
#include <type_traits>

namespace gnomon::sample {

using Triangle = std::array<math::vec3, 3>;

/// Which triangle a pixel shows, and where. Plain: 16 bytes. No triangle: the pixel shows none.
struct ViewSample {
    core::TriangleId triangle;
    math::vec3 position{0.0F, 0.0F, 0.0F};

    friend bool operator==(ViewSample const&, ViewSample const&) noexcept = default;
};

static_assert(sizeof(ViewSample) == 16 && std::is_trivially_copyable_v<ViewSample>);

/// The eye of `view` as the exact tests see it, in the work space whose origin is `origin_m`.
[[nodiscard]] inline predicates::Target eye_of(math::View const& view, math::dvec3 const& origin_m) noexcept {
    if (view.lens == math::Lens::orthographic) return predicates::Target::direction(math::to_float(view.back));
    return predicates::Target::point(math::to_float(view.eye_m - origin_m));
}

/// The ray through image point `px` of `view`, in work space, double.
[[nodiscard]] inline SampleRay sample_ray(math::View const& view, math::dvec3 const& origin_m,
                                          math::dvec2 const& px) noexcept {
    math::PixelRay const ray = math::pixel_ray(view, px);
    return {(view.eye_m - origin_m) + ray.start_m, ray.step, view.lens == math::Lens::perspective};
}

/// Where the plane of `t` is met by `ray`, on the eye's side.
///
/// The crossing is computed in double and rounded to float. A ray that misses the triangle (a rasterizer snaps corners,
/// so it can, slightly), or runs in its plane, takes the triangle's point nearest to the ray: extrapolating a grazing
/// plane would fly far away. If the float lies strictly behind the plane as seen from `eye`, it moves along the
/// dominant axis of the normal by the least number of floats that brings it into the plane or before it.
///
/// returns: a finite position; before the last step within the triangle's bounds. A triangle without area, and one whose
///          plane holds the eye, has no eye's side: the position is only rounded. NaN or infinity in the triangle, the
///          ray or the eye is harmless: a triangle that is not finite gives a sample without triangle, a ray that is not
///          finite some point of the triangle, an eye that is not finite no move.
[[nodiscard]] inline ViewSample make_view_sample(core::TriangleId id, Triangle const& t, SampleRay const& ray,
                                                 predicates::Target const& eye) noexcept {
    if (!(math::is_finite(t[0]) && math::is_finite(t[1]) && math::is_finite(t[2]))) return {};
    math::vec3 const rounded = math::to_float(detail::nearest_point(t, ray));
    predicates::Sign const eye_side = predicates::orient3d(t[0], t[1], t[2], eye);
    return {id, detail::moved_to_side(t, rounded, eye_side)};
}

/// The own plane of a sample on `t` strictly separates eye and light: the sample is in shadow, whatever else is there.
[[nodiscard]] inline bool faces_away(Triangle const& t, predicates::Target const& eye,
                                     predicates::Target const& light) noexcept {
    return predicates::separates(t[0], t[1], t[2], eye, light);
}

}  // namespace gnomon::sample
