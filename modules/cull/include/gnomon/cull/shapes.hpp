#pragma once
// Spheres, cones and boxes of any orientation against one cluster of a grid. Conservative, and nearly exact: a pair is
// rejected where a plane between the two is found, never where exact arithmetic on the same floats finds a common point.
//
// All in culling space: x to the right, y down the image, depth in front of the eye. For many clusters at once call the
// formulas (formula/cell.glsl) with math::Lanes; for frusta, planes and boxes see math/plane_set.hpp, touch.hpp, cone.hpp.

#include <gnomon/cluster/grid_view.hpp>
#include <gnomon/cull/formula/cell.glsl>
#include <gnomon/math/bounds.hpp>
#include <gnomon/math/cone.hpp>
#include <gnomon/math/plane_set.hpp>
#include <gnomon/math/touch.hpp>

#include <cstdint>

namespace gnomon::cull {

using math::may_touch;

/// One cluster: its six borders, and whether those of x and y are times depth.
struct Cell {
    formula::GnCell<float> borders;
    bool perspective = true;
};

/// expects: the cluster is in the grid.
[[nodiscard]] inline Cell cell_of(cluster::GridView const& grid, std::uint32_t column, std::uint32_t row, std::uint32_t slice) {
    GNOMON_EXPECT(column < grid.columns() && row < grid.rows() && slice < grid.slices());
    return {{grid.x[column], grid.x[column + 1], grid.y[row], grid.y[row + 1], grid.depth_m[slice], grid.depth_m[slice + 1]},
            grid.perspective};
}

/// Alternating projections that a cone's test takes; see the README's figures for what more of them would gain.
inline constexpr int cone_steps = 2;

/// A box of any orientation: its centre and the vectors to the middles of three faces.
[[nodiscard]] inline formula::GnCrate<float> make_crate(math::vec3 const& center, math::vec3 const& half_x,
                                                        math::vec3 const& half_y, math::vec3 const& half_z) noexcept {
    return {formula::Vec3<float>(center), formula::Vec3<float>(half_x), formula::Vec3<float>(half_y), formula::Vec3<float>(half_z)};
}

/// A sphere of negative or infinite radius, or with a centre that is not finite, touches nothing.
[[nodiscard]] inline bool may_touch(math::Sphere const& sphere, Cell const& cell) noexcept {
    return gn_touches_sphere_cell(math::formula_sphere(sphere), cell.borders, cell.perspective).v;
}

/// A cone that `formula_sector` found fault with touches nothing.
[[nodiscard]] inline bool may_touch(formula::GnSector<float> const& cone, Cell const& cell, int steps = cone_steps) noexcept {
    return gn_touches_sector_cell(cone, cell.borders, cell.perspective, steps).v;
}

/// A box along the axes of culling space; one without points, or not finite, touches nothing.
[[nodiscard]] inline bool may_touch(math::Aabb const& box, Cell const& cell) noexcept {
    return gn_touches_box_cell(math::formula_box(box), cell.borders, cell.perspective).v;
}

/// A box of any orientation; one that is not finite touches nothing.
[[nodiscard]] inline bool may_touch(formula::GnCrate<float> const& crate, Cell const& cell) noexcept {
    return gn_touches_crate_cell(crate, cell.borders, cell.perspective).v;
}

/// A box of any orientation and the bounds of a cluster's samples.
[[nodiscard]] inline bool may_touch(formula::GnCrate<float> const& crate, math::Aabb const& box) noexcept {
    return gn_touches_crate_box(crate, math::formula_box(box)).v && !math::is_empty(box);
}

}  // namespace gnomon::cull
