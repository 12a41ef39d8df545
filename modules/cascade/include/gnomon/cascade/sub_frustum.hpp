#pragma once
// The part of a camera's view that one cascade serves, and how large it is.
//
// Sizes are computed in the camera's own frame, so that turning or moving it changes no bit of them.

#include <gnomon/cascade/light_frame.hpp>
#include <gnomon/cascade/splits.hpp>
#include <gnomon/math/view.hpp>

#include <array>
#include <cmath>
#include <limits>

namespace gnomon::cascade {

/// The eight corners in the camera's frame (x right, y up, z depth in metres): four at `begin_m`, four at `end_m`.
[[nodiscard]] inline std::array<math::dvec3, 8> corners_in_view(math::View const& camera,
                                                                DepthInterval const& depths) noexcept {
    math::Window const& w = camera.window;
    std::array<math::dvec3, 8> corners;
    for (unsigned i = 0; i < 8; ++i) {
        double const depth_m = (i & 4U) != 0 ? depths.end_m : depths.begin_m;
        double const scale = camera.lens == math::Lens::orthographic ? 1.0 : depth_m;
        corners[i] = math::dvec3(((i & 1U) != 0 ? w.right : w.left) * scale, ((i & 2U) != 0 ? w.top : w.bottom) * scale,
                                 depth_m);
    }
    return corners;
}

/// A position of the camera's frame, relative to the camera's eye along the world's axes.
[[nodiscard]] inline math::dvec3 relative_from_view(math::View const& camera, math::dvec3 const& in_view) noexcept {
    return camera.right * in_view.x + camera.up * in_view.y - camera.back * in_view.z;
}

/// The greatest distance between two corners, which is that between any two points.
///
/// source:  [CSM Scrolling, 5]: a map of this size holds the sub-frustum however it is turned
[[nodiscard]] inline double diameter_m(std::array<math::dvec3, 8> const& corners) noexcept {
    double largest_sq = 0.0;
    for (unsigned i = 0; i < 8; ++i)
        for (unsigned j = i + 1; j < 8; ++j) {
            math::dvec3 const d = corners[i] - corners[j];
            double const distance_sq = along(d, d);
            largest_sq = distance_sq > largest_sq ? distance_sq : largest_sq;
        }
    return std::sqrt(largest_sq);
}

struct BoundingSphere {
    math::dvec3 center_in_view;
    double radius_m;
};

/// The smallest sphere about the corners whose middle lies on the line through the middles of the near and far window.
/// It is the smallest of all where the window is centred.
[[nodiscard]] inline BoundingSphere bounding_sphere(std::array<math::dvec3, 8> const& corners) noexcept {
    math::dvec3 const first = (corners[0] + corners[3]) * 0.5;
    math::dvec3 const way = (corners[4] + corners[7]) * 0.5 - first;
    auto const radius_sq_at = [&](double s) {
        double largest_sq = 0.0;
        for (math::dvec3 const& corner : corners) {
            math::dvec3 const d = corner - (first + way * s);
            double const distance_sq = along(d, d);
            largest_sq = distance_sq > largest_sq ? distance_sq : largest_sq;
        }
        return largest_sq;
    };
    double low = 0.0;  // the radius is convex in s
    double high = 1.0;
    for (int i = 0; i < 80; ++i) {
        double const a = low + (high - low) / 3.0;
        double const b = high - (high - low) / 3.0;
        if (radius_sq_at(a) <= radius_sq_at(b))
            high = b;
        else
            low = a;
    }
    double const s = low + (high - low) / 2.0;
    return {first + way * s, std::sqrt(radius_sq_at(s))};
}

}  // namespace gnomon::cascade
