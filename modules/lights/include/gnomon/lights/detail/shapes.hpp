#pragma once
// The one predicate for every kind of light: the span of x / depth that it may cover of a row.

#include <gnomon/cull/rows.hpp>
#include <gnomon/lights/light.hpp>

#include <cstdint>

namespace gnomon::lights::detail {

[[nodiscard]] inline cull::Span everything() noexcept { return {-formula::gn_far(), formula::gn_far()}; }

/// Calls `visit(row, span)` for every row that the light may touch; row = slice * rows + row of the slice.
template <class Visit>
void for_each_row(cull::RowGrid const& grid, Light const& light, float radius, Visit&& visit) {
    if (light.kind == Kind::directional) {
        for (std::uint32_t row = 0; row < grid.rows * grid.slices; ++row) visit(row, everything());
        return;
    }
    cull::ReadyBall const ready = cull::ready_ball(light.center, radius, grid.perspective);
    for (std::uint32_t k = 0; k < grid.slices; ++k) {
        auto const near = formula::gn_plane_cut(ready.ball, grid.plane(k));
        auto const far = formula::gn_plane_cut(ready.ball, grid.plane(k + 1));
        if (!gn_any(formula::gn_in_slice(ready.ball, near, far))) continue;
        for (std::uint32_t j = 0; j < grid.rows; ++j) {
            formula::GnRow<float> const row = grid.row(j, k);
            if (!gn_any(formula::gn_in_row(ready, row.top.y, row.bottom.y))) continue;
            visit(k * grid.rows + j, formula::gn_ball_row(ready, row, grid.perspective));
        }
    }
}

}  // namespace gnomon::lights::detail
