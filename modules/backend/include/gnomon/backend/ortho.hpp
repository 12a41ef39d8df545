#pragma once
// Passes in whole units of an absolute light space: the image of a scene that is moved by whole texels and depth units
// is the moved image, bit for bit. Scrolling shadow maps stand on this.

#include <gnomon/backend/draw.hpp>
#include <gnomon/backend/pass.hpp>
#include <gnomon/math/vec.hpp>
#include <gnomon/math/view.hpp>

#include <cstdint>
#include <optional>
#include <span>

namespace gnomon::backend {

/// A light's axes, its units, and where the image begins, in whole units.
struct IntegerOrtho {
    math::dvec3 right{1.0, 0.0, 0.0};  ///< Columns go this way. The three axes are unit vectors, at right angles.
    math::dvec3 down{0.0, -1.0, 0.0};  ///< Rows go this way.
    math::dvec3 away{0.0, 0.0, -1.0};  ///< Depth grows this way, from the light.
    double texel_m = 0.015625;
    double depth_unit_m = 0.001;  ///< One code of the image: 1/65535 of a 16-bit one, 2^-24 of a float one.
    std::int64_t origin_x = 0;    ///< Texels from the world's origin to the image's left side.
    std::int64_t origin_y = 0;    ///< To its top.
    std::int64_t origin_z = 0;    ///< Depth units to code 0.
};

inline constexpr std::int64_t max_light_origin = std::int64_t{1} << 42;  ///< Of an image, in texels or depth units.

/// One image of such a pass. It fills its whole array layer; what `scissor` cuts off stays as it is.
struct OrthoLayer {
    IntegerOrtho light;
    math::dvec3 origin_m{0.0, 0.0, 0.0};  ///< In place of `Draw::origin`: corners lie at origin_m + position, in double.
    std::optional<std::span<std::uint32_t const>> draws{};  ///< Places in the list, ascending; none: all of it.
    std::uint32_t layer = 0;
    std::optional<Rect> scissor{};
    math::Depth depth = math::Depth::forward;  ///< Reversed holds (last code - code): nearest is greatest.
    DepthRange range = DepthRange::clamp;      ///< Clamp: "pancaking". Clip leaves out samples before and behind.
    Load load = Load::clear;                   ///< Keep expects what such a pass has written.
};

}  // namespace gnomon::backend
