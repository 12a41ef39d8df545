#pragma once
// The rows of lights one at a time: the reference for what the lanes do.

#include <gnomon/cull/detail/rows_avx2.hpp>
#include <gnomon/cull/rows.hpp>
#include <gnomon/lights/admit.hpp>
#include <gnomon/lights/detail/shapes.hpp>

#include <cstddef>
#include <cstdint>
#include <span>

namespace gnomon::lights::detail {

/// Every row of every slice that the lights of a list touch: `sink.light(index)`, then `sink.row(row, columns)`.
template <class Sink>
void scatter_scalar(cull::RowGrid const& grid, std::span<Light const> lights, std::span<std::uint32_t const> which, Sink& sink) {
    for (std::uint32_t const index : which) {
        sink.light(index);
        for_each_row(grid, lights[index], bounding_radius_m(lights[index]), [&](std::uint32_t row, cull::Span const& span) {
            cull::Columns const columns = cull::columns_of(grid, span);
            if (!columns.empty()) sink.row(row, columns);
        });
    }
}

#if GNOMON_CULL_AVX2
[[nodiscard]] inline cull::detail::Input input_of(Workspace const& w) noexcept {
    return {w.x.data(),       w.y.data(),
            w.depth.data(),   w.radius.data(),
            {w.axis[0].data(), w.axis[1].data(), w.axis[2].data()},
            w.cones ? w.cosine.data() : nullptr,
            w.sine.data()};
}
#endif

}  // namespace gnomon::lights::detail
