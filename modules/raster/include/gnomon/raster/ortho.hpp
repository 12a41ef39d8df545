#pragma once
// Orthographic depth in whole units of an absolute light space (gnomon/backend/ortho.hpp).
//
// Corners are rounded once, in absolute light space, to 1/256 texel and 1/256 depth unit; everything after that is
// integer, or a function of differences of these integers. There is no float clipping and no guard band.

#include <gnomon/backend/ortho.hpp>
#include <gnomon/core/executor.hpp>
#include <gnomon/math/view.hpp>
#include <gnomon/raster/draw.hpp>
#include <gnomon/raster/pass.hpp>
#include <gnomon/raster/target.hpp>
#include <gnomon/raster/tile_workspace.hpp>

#include <cstdint>
#include <optional>
#include <span>

namespace gnomon::raster {

using backend::IntegerOrtho;

inline constexpr std::int64_t max_light_units = std::int64_t{1} << 50;  ///< Of an absolute coordinate.
inline constexpr std::int64_t max_ortho_extent = std::int64_t{1}
                                                 << 40;  ///< From the image's corner, in the same units.

/// A corner in absolute light space: 1/256 texel, 1/256 depth unit.
struct LightVertex {
    std::int64_t x;
    std::int64_t y;
    std::int64_t z;

    friend bool operator==(LightVertex const&, LightVertex const&) noexcept = default;
};

/// Rounds a world position to light units, ties to even.
///
///     x = rne(((right.x p.x + right.y p.y) + right.z p.z) * (256 / texel_m)), y and z alike
///
/// in double: off by at most 2^-51 of the position beside the rounding to 1/256; a position and a texel that are
/// multiples of powers of two lose nothing.
/// returns: nothing for NaN, infinities, and beyond `max_light_units`.
[[nodiscard]] std::optional<LightVertex> try_light_vertex(IntegerOrtho const& light,
                                                          math::dvec3 const& world_m) noexcept;

/// Triangles at `origin_m + position`, in double.
struct OrthoDraw {
    core::StridedSpan<math::vec3> positions;
    IndexSpan indices;
    math::dvec3 origin_m{0.0, 0.0, 0.0};
    Cull cull = Cull::none;
    AlphaTest const* alpha_test = nullptr;  ///< As in `Draw`.
};

struct OrthoConfig {
    math::Depth depth = math::Depth::forward;  ///< Reversed holds (last code - code): nearest is greatest.
    DepthRange range = DepthRange::clamp;      ///< Clamp: "pancaking". Clip leaves out samples before and behind.
    Load load = Load::clear;                   ///< Keep expects what such a pass has written.
    std::optional<Rect> scissor{};
};

/// Where the triangles went; the nine counts from `bad_index` to `drawn` add up to `triangles`.
struct OrthoStats {
    std::uint64_t triangles = 0;
    std::uint64_t bad_index = 0;
    std::uint64_t not_finite = 0;  ///< A corner that is NaN or infinite: left out.
    std::uint64_t overflow = 0;    ///< A corner beyond `max_light_units` or `max_ortho_extent`: left out.
    std::uint64_t outside = 0;
    std::uint64_t degenerate = 0;
    std::uint64_t culled = 0;
    std::uint64_t no_sample = 0;
    std::uint64_t drawn = 0;
    std::uint64_t samples_written = 0;

    friend bool operator==(OrthoStats const&, OrthoStats const&) noexcept = default;
};

/// Draws the nearest depths of `draws` in whole codes: into 16 bits as they are, into float as code * 2^-24.
///
/// Coverage is that of `covers`, exact however far the corners are. Depth is that of the plane through the corners,
///
///     sub = z_0 + rne(E_20 ((z_1 - z_0) / A) + E_01 ((z_2 - z_0) / A)),  code = floor((sub + 128) / 256) - origin_z
///
/// with E and A exact in integers, each rounded to double once, and z_0 the triangle's first corner: only differences
/// are ever rounded, so no shift changes them. Within 0.503 codes of the exact plane through the rounded corners:
///
///     |code - exact| <= 1/2 + (1/2 + 2^-50 (|z_1 - z_0| + |z_2 - z_0|)) / 256
///
/// expects: `texel_m`, `depth_unit_m` > 0, |origins| at most `backend::max_light_origin`, target sizes at most `max_size_px`.
/// returns: the counts. Allocates only what `workspace` lacks.
/// cost:    O(triangles + samples), triangles and tiles in parallel; the same for any executor.
OrthoStats ortho_pass(std::span<OrthoDraw const> draws, IntegerOrtho const& light, DepthTarget const& target,
                      OrthoConfig const& config, TileWorkspace& workspace, core::ExecutorRef executor);

}  // namespace gnomon::raster
