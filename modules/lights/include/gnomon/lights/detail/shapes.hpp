#pragma once
// The one predicate for every kind of light: the span of x / depth that it may cover of a row.

#include <gnomon/cull/box_rows.hpp>
#include <gnomon/cull/rows.hpp>
#include <gnomon/lights/admit.hpp>
#include <gnomon/lights/light.hpp>

#include <cstdint>

namespace gnomon::lights::detail {

[[nodiscard]] inline cull::Span everything() noexcept { return {-formula::gn_far(), formula::gn_far()}; }

/// A spot that is culled as one; wider spots are balls.
[[nodiscard]] inline bool is_cone(Light const& light) noexcept {
    return light.kind == Kind::spot && cull::is_narrow(light.cos_half, light.sin_half);
}

/// The rows that a ball's bounds reach.
template <class Visit>
void for_each_row(cull::RowGrid const& grid, cull::ReadyBall const& ready, Visit&& visit) {
    for (std::uint32_t k = 0; k < grid.slices; ++k) {
        auto const near = formula::gn_plane_cut(ready.ball, grid.plane(k));
        auto const far = formula::gn_plane_cut(ready.ball, grid.plane(k + 1));
        if (!gn_any(formula::gn_in_slice(ready.ball, near, far))) continue;
        for (std::uint32_t j = 0; j < grid.rows; ++j) {
            formula::GnRow<float> const row = grid.row(j, k);
            if (gn_any(formula::gn_in_row(ready, row.top.y, row.bottom.y))) visit(k * grid.rows + j, row);
        }
    }
}

/// What a sound light may cover of one row.
[[nodiscard]] inline cull::Span span_of(cull::RowGrid const& grid, Light const& light, std::uint32_t row, std::uint32_t slice) {
    if (light.kind == Kind::directional) return everything();
    cull::ReadyBall const ball = cull::ready_ball(light.center, bounding_radius_m(light), grid.perspective);
    formula::GnRow<float> const borders = grid.row(row, slice);
    if (is_cone(light)) {
        cull::ReadySpot const spot = cull::ready_spot(ball, light.axis, light.cos_half, light.sin_half, grid.perspective);
        return formula::gn_spot_row(spot, borders, grid.perspective);
    }
    cull::Span s = formula::gn_ball_row(ball, borders, grid.perspective);
    if (light.kind != Kind::box) return s;
    cull::Span const in_box = cull::box_row(grid, {light.center, light.axis, light.side, light.other}, row, slice);
    s.low = gn_max(s.low, in_box.low);
    s.high = gn_min(s.high, in_box.high);
    return s;
}

/// Calls `visit(row, span)` for every row that the light may touch; row = slice * rows + row of the slice.
template <class Visit>
void for_each_row(cull::RowGrid const& grid, Light const& light, float radius, Visit&& visit) {
    if (light.kind == Kind::directional) {
        for (std::uint32_t row = 0; row < grid.rows * grid.slices; ++row) visit(row, everything());
        return;
    }
    cull::ReadyBall const ball = cull::ready_ball(light.center, radius, grid.perspective);
    if (light.kind == Kind::box) {
        cull::Box const box{light.center, light.axis, light.side, light.other};
        for_each_row(grid, ball, [&](std::uint32_t row, formula::GnRow<float> const& borders) {
            cull::Span s = formula::gn_ball_row(ball, borders, grid.perspective);
            cull::Span const in_box = cull::box_row(grid, box, row % grid.rows, row / grid.rows);
            s.low = gn_max(s.low, in_box.low);
            s.high = gn_min(s.high, in_box.high);
            visit(row, s);
        });
        return;
    }
    if (is_cone(light)) {
        cull::ReadySpot const spot = cull::ready_spot(ball, light.axis, light.cos_half, light.sin_half, grid.perspective);
        for_each_row(grid, spot.ready, [&](std::uint32_t row, formula::GnRow<float> const& borders) {
            visit(row, formula::gn_spot_row(spot, borders, grid.perspective));
        });
        return;
    }
    for_each_row(grid, ball, [&](std::uint32_t row, formula::GnRow<float> const& borders) {
        visit(row, formula::gn_ball_row(ball, borders, grid.perspective));
    });
}

}  // namespace gnomon::lights::detail
