#pragma once
// Hollow solids out of cells: a lattice with uneven lines whose cells are full or empty. Where a full one meets an empty one
// there is a face, so walls, floors, doors and windows make one closed solid.

#include "solid_builder.hpp"

#include <array>
#include <cstdint>
#include <vector>

namespace gnomon::scene::detail {

struct CellSolid {
    std::array<std::vector<double>, 3> lines;  ///< Rising; one more than cells along each axis.
    std::vector<std::uint32_t> cells;          ///< A material, or `none`; x runs first, then y, then z.
};

/// All cells empty.
CellSolid make_cells(std::vector<double> x, std::vector<double> y, std::vector<double> z);

/// Fills the cells from `lo` to `hi`, both included; `none` empties them.
void fill_cells(CellSolid& solid, math::ivec3 const& lo, math::ivec3 const& hi, std::uint32_t material);

/// expects: no two full cells that meet in an edge or a corner alone.
void add_cells(SolidBuilder& out, CellSolid const& solid);

}  // namespace gnomon::scene::detail
