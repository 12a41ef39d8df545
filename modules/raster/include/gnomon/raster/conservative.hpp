#pragma once
// Conservative rasterization: every pixel that a triangle touches, or only those that it covers whole, with bounds of
// its depth there.
//
// A pixel is its closed square, [256x, 256x + 256] x [256y, 256y + 256] in fixed point. Coverage is exact for the
// snapped triangle. For the triangle before snapping, give a slack: each square is taken that much larger on each side,
// which makes "touched" a superset and "covered" a subset of the truth.

#include <gnomon/core/executor.hpp>
#include <gnomon/math/view.hpp>
#include <gnomon/raster/draw.hpp>
#include <gnomon/raster/pass.hpp>
#include <gnomon/raster/target.hpp>
#include <gnomon/raster/tile_workspace.hpp>
#include <gnomon/raster/triangle.hpp>

#include <cstdint>
#include <optional>
#include <span>

namespace gnomon::raster {

/// The slack, in 1/256 pixel, that makes up for projecting and snapping in float: with it, results hold for the exact
/// image of the float clip coordinates.
///
///     1/2 (snapping) + 1.1 (x / w * half_width, three roundings of at most 24,000 px) + 1/4 (the sum) < 2
///
/// and as much again for a corner cut by the clipper, which is rounded to float before it is projected, where no clip
/// coordinate of the triangle is beyond 2^24 times the w of the cut.
inline constexpr std::int32_t snap_slack = 4;
inline constexpr std::int32_t max_slack = 4096;

/// Whether the closed triangle and the closed pixel have a point in common. Exact; a triangle without area is the
/// segment or the point that its corners make.
///
/// expects: coordinates within 2^24, pixels within 2^15, slack in [0, max_slack]. So do the next two.
[[nodiscard]] bool touches(SnappedTriangle const& triangle, std::int32_t x, std::int32_t y,
                           std::int32_t slack = 0) noexcept;

/// Whether the closed pixel lies in the closed triangle. Exact; false for a triangle without area.
[[nodiscard]] bool covers_fully(SnappedTriangle const& triangle, std::int32_t x, std::int32_t y,
                                std::int32_t slack = 0) noexcept;

/// Bounds of a depth, whatever is near: least <= z <= greatest.
struct DepthBounds {
    float least;
    float greatest;

    friend bool operator==(DepthBounds const&, DepthBounds const&) noexcept = default;
};

/// Bounds of the triangle's depth over the part of it that lies in the pixel; with slack, in the larger square.
///
/// The depth is the linear one that has the corners' z, residues left aside: every point of the triangle has the depth
/// of its own mixture of corners, before snapping and after. Extremes of a linear function over a convex polygon lie at
/// its corners: the square's inside the triangle, and the ends of the triangle's edges cut to the square. With
/// Z = max |z|, each is found in double with an error below 2^-46 Z, moved outwards by that, and rounded outwards, so
///
///     exact - least and greatest - exact are in [0, 1.0001 * 2^-23 |exact| + 2^-44 Z + 2^-148]
///
/// and never beyond the corners' own least and greatest z, which a flat triangle's bounds therefore equal.
/// expects: `touches(triangle, x, y, slack)`.
[[nodiscard]] DepthBounds depth_bounds(SnappedTriangle const& triangle, std::int32_t x, std::int32_t y,
                                       std::int32_t slack = 0) noexcept;

enum class Coverage : std::uint8_t {
    outer,  ///< Every pixel that the triangle touches; triangles without area too.
    inner,  ///< Pixels that the triangle covers whole.
};

/// Of two depths, by the pass's convention: seen from the eye.
enum class Bound : std::uint8_t { nearest, farthest };

struct ConservativeConfig {
    Coverage coverage = Coverage::outer;
    Bound bound = Bound::nearest;  ///< Which end of a triangle's depths over a pixel.
    Bound keep = Bound::nearest;   ///< Which of several triangles' bounds the image keeps.
    std::int32_t slack = 0;        ///< See `snap_slack`.
    math::Depth depth = math::Depth::reversed;
    DepthRange range = DepthRange::clip;
    Load load = Load::clear;  ///< Clears to the farthest depth, or to the nearest where `keep` is farthest.
    std::optional<Rect> viewport{};
    std::optional<Rect> scissor{};
};

/// Where the triangles of a conservative pass went; they add up to `triangles`, `clipped` and `pixels_written` apart.
struct ConservativeStats {
    std::uint64_t triangles = 0;
    std::uint64_t bad_index = 0;   ///< Left out, as in the other passes.
    std::uint64_t not_finite = 0;  ///< Left out.
    std::uint64_t outside = 0;     ///< Wholly outside the clip volume or the scissor rectangle.
    std::uint64_t culled = 0;      ///< By the way it faces; with slack, only where every triangle within it faces so.
    std::uint64_t no_pixel = 0;    ///< Inner: too small to cover one, without area, or alpha-tested.
    std::uint64_t drawn = 0;
    std::uint64_t clipped = 0;
    std::uint64_t pixels_written = 0;

    friend bool operator==(ConservativeStats const&, ConservativeStats const&) noexcept = default;
};

/// Draws, for each pixel, a bound of the depths of the triangles that touch it or cover it.
///
/// Outer: alpha-tested draws count as solid, triangles without area touch pixels, and are never culled: they face
/// nowhere. Inner: alpha-tested draws cover nothing. Clipping: the polygon that the clipper leaves, snapped; outer
/// coverage is that of the fan of it, which contains it even where snapping dented it; inner coverage is what lies to
/// the inner side of all its edges, which it contains. The image is the same for any executor.
///
/// A 16-bit target rounds bounds outwards: a `nearest` code is not behind its depth, a `farthest` one not in front.
/// expects: what `depth_pass` does.
/// cost:    O(vertices + triangles + pixels); row by row in double, five to fifteen times `depth_pass`.
ConservativeStats conservative_pass(std::span<Draw const> draws, DepthTarget const& target,
                                    ConservativeConfig const& config, TileWorkspace& workspace,
                                    core::ExecutorRef executor);

}  // namespace gnomon::raster
