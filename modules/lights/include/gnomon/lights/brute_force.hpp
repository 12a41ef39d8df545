#pragma once
// Every light against every cluster, one pair at a time: the truth that the other ways are compared with.

#include <gnomon/core/contract.hpp>
#include <gnomon/cull/rows.hpp>
#include <gnomon/lights/admit.hpp>
#include <gnomon/lights/detail/shapes.hpp>
#include <gnomon/lights/light.hpp>

#include <cstdint>

namespace gnomon::lights {

/// Whether a light is assigned to a cluster: the predicate behind planes and lists.
///
/// expects: column, row and slice within the grid.
/// returns: false for a light that is not sound.
[[nodiscard]] inline bool may_touch(cull::RowGrid const& grid, Light const& light, std::uint32_t column, std::uint32_t row,
                                    std::uint32_t slice) {
    GNOMON_EXPECT(column < grid.columns && row < grid.rows && slice < grid.slices);
    if (!is_sound(light)) return false;
    cull::Span const span = detail::span_of(grid, light, row, slice);
    return formula::gn_touches(span, formula::Float<float>(grid.left[column]), formula::Float<float>(grid.right[column])).v;
}

}  // namespace gnomon::lights
