#pragma once
// The pure pieces of the rasterizer: clip, snap, cover, depth. What the kernels do is defined here, one sample at a
// time.
//
// Fixed-point image coordinates: 256 units to a pixel, y down; the sample of pixel (x, y) is at (256x + 128, 256y +
// 128).

#include <gnomon/math/vec.hpp>
#include <gnomon/raster/target.hpp>

#include <array>
#include <cstdint>

namespace gnomon::raster {

inline constexpr std::int32_t subpixel_units = 256;
inline constexpr float max_clip_coordinate = 1.152921504606846976e18F;  ///< 2^60; a corner beyond is "not finite".
inline constexpr float min_w = 5.9604644775390625e-8F;  ///< 2^-24; w below is clipped in any depth range.

/// How clip space lands in the image.
struct ViewportTransform {
    float half_width_px;
    float half_height_px;
    std::int32_t offset_x;  ///< Of the viewport's top left, in units of 1/256 pixel.
    std::int32_t offset_y;
    float guard_x;  ///< |x| > guard_x * w is clipped: the guard band.
    float guard_y;
    bool clip_depth;  ///< Whether 0 <= z <= w is clipped too.
};

/// expects: sizes in [1, max_size_px], offsets within +-max_size_px.
/// returns: a guard band that keeps snapped coordinates within 2^24, three or more viewports wide.
[[nodiscard]] ViewportTransform make_viewport(Rect const& viewport, bool clip_depth) noexcept;

/// A convex polygon in clip space; empty when nothing is left.
struct ClipPolygon {
    std::array<math::vec4, 10> corner;
    int count = 0;
};

/// Bits of the planes that `clip` is outside of (0: inside all). Bit 7: not finite, or beyond `max_clip_coordinate`.
[[nodiscard]] std::uint32_t outcode(math::vec4 const& clip, ViewportTransform const& viewport) noexcept;

/// Cuts a triangle to w >= min_w, the depth range and the guard band, in homogeneous space.
///
/// A cut edge is interpolated from its inside to its outside corner, in double: the two triangles that share an edge
/// get the same corner whatever their order, so a clipped surface has no cracks.
///
/// expects: three finite corners (`outcode` without bit 7).
[[nodiscard]] ClipPolygon clip_triangle(std::array<math::vec4, 3> const& corners,
                                        ViewportTransform const& viewport) noexcept;

/// A corner in the image: fixed point, z / w, and what rounding took, for the depth: before it the corner was at
/// x + residue_x / 4096.
struct SnappedVertex {
    std::int32_t x;
    std::int32_t y;
    float z;
    std::int16_t residue_x = 0;  ///< In [-2048, 2047].
    std::int16_t residue_y = 0;

    friend bool operator==(SnappedVertex const&, SnappedVertex const&) noexcept = default;
};

/// Projects and rounds to the nearest 1/256 pixel, ties to even, as Vulkan's devices do.
///
///     r = 1 / w;  x = rne(256 * (x_clip * r * half_width + half_width)) + offset_x;  z = z_clip * r
///
/// expects: `outcode` 0. With `clip_depth`, z is clamped to [0, 1] (it may be one ulp beyond).
[[nodiscard]] SnappedVertex snap(math::vec4 const& clip, ViewportTransform const& viewport) noexcept;

using SnappedTriangle = std::array<SnappedVertex, 3>;

/// Twice the area in units of 1/65536 pixel; positive when clockwise as seen (y down): back-facing.
[[nodiscard]] constexpr std::int64_t doubled_area(SnappedTriangle const& t) noexcept {
    std::int64_t const ax = std::int64_t{t[1].x} - t[0].x;
    std::int64_t const ay = std::int64_t{t[1].y} - t[0].y;
    std::int64_t const bx = std::int64_t{t[2].x} - t[0].x;
    std::int64_t const by = std::int64_t{t[2].y} - t[0].y;
    return ax * by - bx * ay;
}

/// Whether the triangle covers the centre of pixel (x, y): exact, with the top-left rule, for either winding.
///
/// expects: coordinates within 2^24, pixels within 2^15.
[[nodiscard]] bool covers(SnappedTriangle const& triangle, std::int32_t x, std::int32_t y) noexcept;

/// Depth of the triangle at the centre of pixel (x, y), as every kernel computes it. Not clamped to [0, 1].
///
/// It is that of the plane through the corners before snapping, as on GPUs. First each corner's depth is moved along
/// that plane to where the corner was snapped to, in double, and rounded to float:
///
///     z_i' = z_i - gradient . residue_i, at most 1/8 of the depths' range beyond the range, and not across 0 or 1
///
/// The limit takes hold of slivers only: of those thinner, along the gradient, than 1/45 pixel. Where snapping more
/// than doubled a sliver's area, z_i' = z_i. So a sample's depth is never far outside the triangle's own.
///
///     z = z0 + E1 g1 + E2 g2,  g_i = (z_i' - z0) / doubled area,  corner 0 the one with the least z', which is z0
///
/// E are the exact integer edge functions, all terms but z0 are >= 0 inside: nothing cancels. With e = 2^-24 each of
/// E, g, E g, the sum of the two, z0 with the fractions of E, and the last sum is rounded once to float; so against the
/// plane through the z_i'
///
///     |z - exact| <= 4e (exact - z0) + 2e max(|z0|, |exact|)  (1 + 2^-20)  + 2^-140
///
/// which is at most 5e exact where no corner's z is negative, whatever the triangle's shape; the rounding of z_i' adds
/// e max |z_i'| + 2^-26 of the range. A triangle of more than 1024 pixels on a side is evaluated in double and rounded
/// once: e |exact|.
/// expects: an area that is not 0, and `covers(triangle, x, y)`.
[[nodiscard]] float depth_at(SnappedTriangle const& triangle, std::int32_t x, std::int32_t y) noexcept;

}  // namespace gnomon::raster
