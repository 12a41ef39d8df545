#pragma once
// The six planes of a view, built from its window rather than from its matrix: no row is ever of zero length, no far
// corner is needed, and the side planes are the same for finite, infinite, forward and reversed depth (numerics row 2).

#include <gnomon/math/plane.hpp>
#include <gnomon/math/view.hpp>

#include <array>

namespace gnomon::math {

/// What a view can see, relative to its eye (world axes). Plane order: left, right, bottom, top, near, far.
struct Frustum {
    std::array<Plane, 6> planes;  ///< An infinite far plane is the plane that everything is inside of.

    /// False only if no point of `relative_box` is inside: one-sided, it may keep a box near an edge.
    [[nodiscard]] bool may_touch(Aabb const& relative_box) const noexcept {
        for (Plane const& plane : planes)
            if (surely_outside(plane, relative_box)) return false;
        return !is_empty(relative_box);
    }

    /// Whether the point is inside all six half-spaces, as double arithmetic sees it.
    [[nodiscard]] bool contains(dvec3 const& relative) const noexcept {
        for (Plane const& plane : planes)
            if (!(evaluate(plane, relative) >= 0.0)) return false;
        return true;
    }
};

/// The planes of `view`. Perspective side planes pass through the eye.
[[nodiscard]] inline Frustum frustum_of(View const& view) noexcept {
    Window const& w = view.window;
    Frustum f;
    if (view.lens == Lens::perspective) {
        f.planes[0] = {view.right + view.back * w.left, 0.0};
        f.planes[1] = {-view.right - view.back * w.right, 0.0};
        f.planes[2] = {view.up + view.back * w.bottom, 0.0};
        f.planes[3] = {-view.up - view.back * w.top, 0.0};
    } else {
        f.planes[0] = {view.right, -w.left};
        f.planes[1] = {-view.right, w.right};
        f.planes[2] = {view.up, -w.bottom};
        f.planes[3] = {-view.up, w.top};
    }
    f.planes[4] = {-view.back, -view.near_m};
    if (is_finite(view.far_m)) f.planes[5] = {view.back, view.far_m};
    return f;
}

}  // namespace gnomon::math
