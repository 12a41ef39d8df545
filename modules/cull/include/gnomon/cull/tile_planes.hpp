#pragma once
// Balls against the six planes of a tile: what one kernel that finds the lights of its tile itself does.
//
// Conservative: no ball that reaches the tile's region is rejected, in exact arithmetic on the same floats. The planes and
// their bound are in formula/tile.glsl and math's formula/touch.glsl.
//
// source: [Olsson 2014, Paper I, 7], after [Lauritzen 2010]

#include <gnomon/cluster/grid_view.hpp>
#include <gnomon/core/contract.hpp>
#include <gnomon/cull/depth_range.hpp>
#include <gnomon/cull/formula/tile.glsl>
#include <gnomon/math/bounds.hpp>
#include <gnomon/math/scalar.hpp>
#include <gnomon/math/touch.hpp>

#include <cmath>
#include <cstdint>

namespace gnomon::cull {

using TileBorder = formula::GnTileBorder;
using TilePlanes = formula::GnTilePlanes;

static_assert(sizeof(TileBorder) == 8);

/// `at`: x / depth or y / depth of the border; x or y in an orthographic view.
[[nodiscard]] inline TileBorder make_tile_border(float at, bool perspective) noexcept {
    double const a = static_cast<double>(at);
    return {at, perspective ? math::next_up(static_cast<float>(std::sqrt(1.0 + a * a))) : 1.0F};
}

/// The planes of a tile of a grid between two depths; its slices are not looked at.
///
/// expects: column and row within the grid; finite borders and depths
[[nodiscard]] inline TilePlanes make_tile_planes(cluster::GridView const& grid, std::uint32_t column, std::uint32_t row,
                                                 DepthRange const& depths) {
    GNOMON_EXPECT(column < grid.columns() && row < grid.rows());
    auto const border = [&](float at) { return make_tile_border(at, grid.perspective); };
    return formula::gn_tile_planes({border(grid.x[column]), border(grid.x[column + 1]), border(grid.y[row]),
                                    border(grid.y[row + 1]), depths.near_m, depths.far_m},
                                   grid.perspective);
}

/// Whether a ball may reach the region within the planes. One of infinite radius does, one of negative radius does not.
[[nodiscard]] inline bool may_touch(TilePlanes const& planes, math::Sphere const& ball) noexcept {
    return gn_touches_tile(planes, math::formula_sphere(ball)).v;
}

}  // namespace gnomon::cull
