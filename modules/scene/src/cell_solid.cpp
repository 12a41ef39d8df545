#include "detail/cell_solid.hpp"

namespace gnomon::scene::detail {

namespace {

math::ivec3 cell_counts(CellSolid const& solid) noexcept {
    return {static_cast<int>(solid.lines[0].size()) - 1, static_cast<int>(solid.lines[1].size()) - 1,
            static_cast<int>(solid.lines[2].size()) - 1};
}

std::size_t cell_place(math::ivec3 const& counts, math::ivec3 const& cell) noexcept {
    return static_cast<std::size_t>((cell.z * counts.y + cell.y) * counts.x + cell.x);
}

std::uint32_t cell_at(CellSolid const& solid, math::ivec3 const& counts, math::ivec3 const& cell) noexcept {
    for (math::axis_t axis = 0; axis < 3; ++axis)
        if (cell[axis] < 0 || cell[axis] >= counts[axis]) return none;
    return solid.cells[cell_place(counts, cell)];
}

/// The face of a cell towards +axis or -axis, counter-clockwise from outside.
void add_cell_face(SolidBuilder& out, CellSolid const& solid, math::ivec3 const& cell, math::axis_t axis, bool positive) {
    math::axis_t const u = (axis + 1) % 3;
    math::axis_t const v = (axis + 2) % 3;
    std::array<math::dvec3, 4> corners;
    for (std::size_t i = 0; i < 4; ++i) {
        math::ivec3 point = cell;
        point[axis] += positive ? 1 : 0;
        bool const far_u = i == 1 || i == 2;
        bool const far_v = i >= 2;
        point[u] += (positive ? far_u : far_v) ? 1 : 0;
        point[v] += (positive ? far_v : far_u) ? 1 : 0;
        for (math::axis_t a = 0; a < 3; ++a)
            corners[i][a] = solid.lines[static_cast<std::size_t>(a)][static_cast<std::size_t>(point[a])];
    }
    out.polygon(corners, solid.cells[cell_place(cell_counts(solid), cell)]);
}

}  // namespace

CellSolid make_cells(std::vector<double> x, std::vector<double> y, std::vector<double> z) {
    CellSolid solid;
    solid.lines = {std::move(x), std::move(y), std::move(z)};
    math::ivec3 const counts = cell_counts(solid);
    solid.cells.assign(static_cast<std::size_t>(counts.x) * static_cast<std::size_t>(counts.y) * static_cast<std::size_t>(counts.z),
                       none);
    return solid;
}

void fill_cells(CellSolid& solid, math::ivec3 const& lo, math::ivec3 const& hi, std::uint32_t material) {
    math::ivec3 const counts = cell_counts(solid);
    for (int z = lo.z; z <= hi.z; ++z)
        for (int y = lo.y; y <= hi.y; ++y)
            for (int x = lo.x; x <= hi.x; ++x) solid.cells[cell_place(counts, {x, y, z})] = material;
}

void add_cells(SolidBuilder& out, CellSolid const& solid) {
    math::ivec3 const counts = cell_counts(solid);
    for (int z = 0; z < counts.z; ++z)
        for (int y = 0; y < counts.y; ++y)
            for (int x = 0; x < counts.x; ++x) {
                math::ivec3 const cell(x, y, z);
                if (cell_at(solid, counts, cell) == none) continue;
                for (math::axis_t axis = 0; axis < 3; ++axis)
                    for (bool const positive : {false, true}) {
                        math::ivec3 next = cell;
                        next[axis] += positive ? 1 : -1;
                        if (cell_at(solid, counts, next) == none) add_cell_face(out, solid, cell, axis, positive);
                    }
            }
}

}  // namespace gnomon::scene::detail
