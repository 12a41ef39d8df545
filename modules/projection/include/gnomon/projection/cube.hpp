#pragma once
// A point light's six views, and the rule that says which of them sees a direction.
//
// Faces are right-handed views like every other, so their images are not mirrored as a graphics API's cube maps are:
// to fill one of those, mirror the image in x.

#include <gnomon/projection/error.hpp>
#include <gnomon/projection/formula/cube.glsl>

#include <array>
#include <cmath>
#include <cstddef>

namespace gnomon::projection {

enum class Face : std::uint8_t {
    positive_x,
    negative_x,
    positive_y,
    negative_y,
    positive_z,
    negative_z,
};

inline constexpr std::size_t face_count = 6;

/// The face whose frustum holds `direction` (from the light).
///
/// The axis with the largest absolute component, x before y before z where they are equal; a zero of either sign
/// counts as positive. Only comparisons, so every machine agrees, and exactly: with no margin the faces' windows are
/// |x|, |y| <= |major axis|, closed, and this picks one of the windows that hold the direction.
///
/// returns: `positive_x` for the zero vector; some face for a NaN.
[[nodiscard]] constexpr Face face_of(math::vec3 const& direction) noexcept {
    return static_cast<Face>(gn_face_of(formula::Vec3<float>(direction)).v);
}

/// The way a face looks, and what is to the right and up in its image. All exact.
struct FaceFrame {
    math::dvec3 forward;
    math::dvec3 right;
    math::dvec3 up;
};

/// | face | forward | right | up |
/// |------|---------|-------|----|
/// | +x   | +x      | +z    | +y |
/// | -x   | -x      | -z    | +y |
/// | +y   | +y      | +x    | +z |
/// | -y   | -y      | +x    | -z |
/// | +z   | +z      | -x    | +y |
/// | -z   | -z      | +x    | +y |
[[nodiscard]] inline FaceFrame frame_of(Face face) noexcept {
    using math::dvec3;
    switch (face) {
        case Face::positive_x: return {dvec3(1.0, 0.0, 0.0), dvec3(0.0, 0.0, 1.0), dvec3(0.0, 1.0, 0.0)};
        case Face::negative_x: return {dvec3(-1.0, 0.0, 0.0), dvec3(0.0, 0.0, -1.0), dvec3(0.0, 1.0, 0.0)};
        case Face::positive_y: return {dvec3(0.0, 1.0, 0.0), dvec3(1.0, 0.0, 0.0), dvec3(0.0, 0.0, 1.0)};
        case Face::negative_y: return {dvec3(0.0, -1.0, 0.0), dvec3(1.0, 0.0, 0.0), dvec3(0.0, 0.0, -1.0)};
        case Face::positive_z: return {dvec3(0.0, 0.0, 1.0), dvec3(-1.0, 0.0, 0.0), dvec3(0.0, 1.0, 0.0)};
        case Face::negative_z: break;
    }
    return {dvec3(0.0, 0.0, -1.0), dvec3(1.0, 0.0, 0.0), dvec3(0.0, 1.0, 0.0)};
}

struct CubeConfig {
    math::dvec3 position_m{0.0, 0.0, 0.0};
    double near_m = 0.05;  ///< See `depth_range` for one that fits a scene.
    double far_m = std::numeric_limits<double>::infinity();
    std::int32_t size_px = 1024;  ///< Of a face, both ways.
    double margin_px = 0.0;       ///< Texels beyond the face's own 90 degrees on each side: the filter's radius.
    math::Depth depth = math::Depth::reversed;
};

/// The six faces in the order of `Face`. With a margin each also sees a strip of its neighbours, so that a filter at a
/// face's edge reads texels of one map.
///
///     window = +- size / (size - 2 margin)
///
/// returns: the views, or the value that is wrong.
[[nodiscard]] inline core::Result<std::array<math::View, face_count>, Error> cube_views(CubeConfig const& config) {
    if (auto ok = detail::validate_position(config.position_m); !ok) return std::move(ok).failure();
    if (auto ok = detail::validate_map(math::ivec2(config.size_px, config.size_px)); !ok)
        return std::move(ok).failure();
    if (auto ok = detail::validate_depth(config.near_m, config.far_m); !ok) return std::move(ok).failure();
    double const half = detail::widening(config.size_px, config.margin_px);
    std::array<math::View, face_count> views;
    for (std::size_t i = 0; i < face_count; ++i) {
        FaceFrame const frame = frame_of(static_cast<Face>(i));
        math::View& view = views[i];
        view.eye_m = config.position_m;
        view.right = frame.right;
        view.up = frame.up;
        view.back = -frame.forward;
        view.window = {-half, half, -half, half};
        view.near_m = config.near_m;
        view.far_m = config.far_m;
        view.size_px = math::ivec2(config.size_px, config.size_px);
        view.depth = config.depth;
    }
    return views;
}

}  // namespace gnomon::projection
