#pragma once
// Where to stand and which light to switch on when nobody said: decided from the geometry alone.

#include <gnomon/core/result.hpp>
#include <gnomon/math/view.hpp>
#include <gnomon/scene/flatten.hpp>
#include <gnomon/scene/scene.hpp>

namespace gnomon::scene {

struct SuggestedView {
    math::dvec3 eye_m{0.0, 0.0, 0.0};
    math::dvec3 target_m{0.0, 0.0, -1.0};
    double fov_y_rad = 1.0471975511965976;
    double near_m = 0.1;  ///< Well before the nearest thing that a thousand rays through the image meet.
    bool inside = false;  ///< The eye stands among the walls of an interior.
};

/// A view that shows `geometry` well: from above at three quarters where it is an object or a landscape, from inside
/// where it is a room. Rays cast from a few candidates decide.
///
/// returns: a usable view for any geometry, an empty one included; the same on every machine.
/// cost:    O(triangles) for a coarse grid, then some thousand rays.
[[nodiscard]] SuggestedView auto_view(Geometry const& geometry);

/// The same, for a scene that is not flattened yet.
[[nodiscard]] SuggestedView auto_view(Scene const& scene);

/// A sun from the upper left, behind the usual viewer: the direction the light goes.
[[nodiscard]] Light default_sun();

/// The default sun where it reaches at least one in twenty of the points that `view` shows; else, as in a closed room, a
/// lamp between the eye and what it sees, below the ceiling.
///
/// returns: the same on every machine. cost: O(triangles) for a coarse grid, then some hundred rays.
[[nodiscard]] Light auto_light(Geometry const& geometry, math::View const& view);

/// What `camera` sees, in an image of `size_px`. The vertical extent is the camera's; the image decides the horizontal.
[[nodiscard]] core::Result<math::View, math::ViewError> make_view(Camera const& camera, math::ivec2 const& size_px,
                                                                   math::Depth depth = math::Depth::reversed);

}  // namespace gnomon::scene
