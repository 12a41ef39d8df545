#pragma once
// Culling by the depths that a tile really has [Olsson 2014, Paper I, section 6.3].
//
// Opaque geometry bounds a tile from both sides. Transparent geometry is in no depth buffer: the opaque one still hides
// what is behind it (far only), and a second pass over the transparent geometry with the depth test reversed finds its
// nearest depth, which bounds it from the near side. All depths are metres in front of the eye.

#include <gnomon/math/formula/touch.glsl>

#include <limits>

namespace gnomon::cull {

/// Depths of a tile's samples; empty where the first is above the second. Starts empty.
struct DepthRange {
    float near_m = std::numeric_limits<float>::infinity();
    float far_m = -std::numeric_limits<float>::infinity();

    /// NaN is left out.
    constexpr void add(float depth_m) noexcept {
        if (depth_m < near_m) near_m = depth_m;
        if (depth_m > far_m) far_m = depth_m;
    }
};

/// What transparent geometry may use where only the opaque range is known: everything before the farthest opaque depth.
/// A tile without opaque geometry hides nothing.
[[nodiscard]] constexpr DepthRange far_only(DepthRange const& opaque) noexcept {
    bool const none = !(opaque.near_m <= opaque.far_m);
    return {-std::numeric_limits<float>::infinity(), none ? std::numeric_limits<float>::infinity() : opaque.far_m};
}

/// The same with the nearest depth of the transparent geometry, from a pass with the depth test reversed; infinite where
/// there is none, and then nothing is touched.
[[nodiscard]] constexpr DepthRange transparent_range(DepthRange const& opaque, float nearest_transparent_m) noexcept {
    return {nearest_transparent_m, far_only(opaque).far_m};
}

/// Whether a ball of that depth and radius may reach a sample of the tile: its ends are rounded outward. A ball whose
/// numbers are none, or whose radius is negative, reaches nothing.
[[nodiscard]] inline bool may_touch(DepthRange const& range, float depth_m, float radius_m) noexcept {
    formula::Float<float> const depth(depth_m);
    formula::Float<float> const radius(radius_m);
    return gn_low_end(depth, radius).v <= range.far_m && -gn_low_end(-depth, radius).v >= range.near_m && radius_m >= 0.0F;
}

}  // namespace gnomon::cull
