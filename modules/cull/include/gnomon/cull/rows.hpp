#pragma once
// The separable refinement of a ball against a grid of clusters: per slice and row the interval of columns it touches.
//
// Exact but for a widening of the radius by 2^-19 (|x| + |y| + |depth| + r), that covers all rounding: see
// formula/rows.glsl, which the CPU, its lanes and shaders share bit for bit. Culling space: x right, y down, depth in
// front of the eye.

#include <gnomon/cluster/grid_view.hpp>
#include <gnomon/core/contract.hpp>
#include <gnomon/cull/formula/spot_rows.glsl>
#include <gnomon/math/vec.hpp>

#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

namespace gnomon::cull {

using ReadyBall = formula::GnReadyBall<float>;
using ReadySpot = formula::GnReadySpot<float>;
using Span = formula::GnSpan<float>;

/// Columns `first` to `last`, both touched; none where `first > last`.
struct Columns {
    std::uint32_t first = 1;
    std::uint32_t last = 0;

    [[nodiscard]] constexpr bool empty() const noexcept { return first > last; }
    [[nodiscard]] constexpr std::uint32_t count() const noexcept { return empty() ? 0 : last - first + 1; }
    friend constexpr bool operator==(Columns const&, Columns const&) noexcept = default;
};

/// A grid's tables, with what the refinement needs of each plane beside it. Made once a grid, not once a frame.
///
/// Lists are padded, so that 16 elements may be read from any of theirs.
struct RowGrid {
    static constexpr std::size_t padding = 16;

    std::uint32_t columns = 0;
    std::uint32_t rows = 0;
    std::uint32_t slices = 0;
    bool perspective = true;
    std::vector<float> left;     ///< columns; beyond: NaN, which nothing touches
    std::vector<float> right;    ///< columns
    std::vector<float> y;        ///< rows + 1 borders; beyond: NaN
    std::vector<float> secant;   ///< sqrt(1 + y^2), or 1
    std::vector<float> cosine;   ///< its reciprocal
    std::vector<float> depth_m;  ///< slices + 1 planes; beyond: NaN
    std::vector<float> scale;    ///< the depth, or 1
    std::vector<float> inverse;  ///< its reciprocal

    [[nodiscard]] formula::GnRowBorder<float> border(std::uint32_t j) const noexcept { return {y[j], secant[j], cosine[j]}; }
    [[nodiscard]] formula::GnSlicePlane<float> plane(std::uint32_t k) const noexcept {
        return {depth_m[k], scale[k], inverse[k]};
    }
    [[nodiscard]] formula::GnRow<float> row(std::uint32_t row, std::uint32_t slice) const noexcept {
        return {border(row), border(row + 1), plane(slice), plane(slice + 1)};
    }
    [[nodiscard]] std::size_t clusters() const noexcept { return std::size_t{columns} * rows * slices; }
};

/// expects: `view` as GridView says.
/// cost:    O(columns + rows + slices); allocates.
[[nodiscard]] inline RowGrid make_row_grid(cluster::GridView const& view) {
    GNOMON_EXPECT(view.x.size() >= 2 && view.y.size() >= 2 && view.depth_m.size() >= 2);
    RowGrid g;
    g.columns = view.columns();
    g.rows = view.rows();
    g.slices = view.slices();
    g.perspective = view.perspective;
    for (std::uint32_t i = 0; i < g.columns; ++i) {
        g.left.push_back(view.x[i]);
        g.right.push_back(view.x[i + 1]);
    }
    for (float const y : view.y) {
        auto const border = formula::gn_row_border(formula::Float<float>(y), view.perspective);
        g.y.push_back(y);
        g.secant.push_back(border.secant.v);
        g.cosine.push_back(border.cosine.v);
    }
    for (float const depth : view.depth_m) {
        auto const plane = formula::gn_slice_plane(formula::Float<float>(depth), view.perspective);
        g.depth_m.push_back(depth);
        g.scale.push_back(plane.scale.v);
        g.inverse.push_back(plane.inverse.v);
    }
    for (auto* list : {&g.left, &g.right, &g.y, &g.secant, &g.cosine, &g.depth_m, &g.scale, &g.inverse})
        list->resize(list->size() + RowGrid::padding, std::numeric_limits<float>::quiet_NaN());
    return g;
}

/// expects: finite coordinates of at most 2^60 in size, a radius above 0 and at most that.
[[nodiscard]] inline ReadyBall ready_ball(math::vec3 const& center, float radius, bool perspective) noexcept {
    return formula::gn_ready_ball(formula::Vec3<float>(center), formula::Float<float>(radius), perspective);
}

/// Whether a cone is narrow enough for `ready_spot`: wider ones are culled as their ball.
[[nodiscard]] inline bool is_narrow(float cosine, float sine) noexcept { return cosine >= 0.015625F * sine; }

/// expects: as `ready_ball`; `is_narrow(cosine, sine)`; an axis whose length is between 2^-20 and 2^30.
[[nodiscard]] inline ReadySpot ready_spot(ReadyBall const& ball, math::vec3 const& axis, float cosine, float sine,
                                          bool perspective) noexcept {
    return formula::gn_ready_spot(ball, formula::Vec3<float>(axis), formula::Float<float>(cosine), formula::Float<float>(sine),
                                  perspective);
}

/// The columns whose closed interval of x a span touches.
///
/// cost: O(log columns)
[[nodiscard]] inline Columns columns_of(RowGrid const& grid, Span const& span) noexcept {
    if (!(span.low.v <= span.high.v)) return {};
    std::uint32_t first = 0;  // right borders ascend: the first that is not before the span
    for (std::uint32_t count = grid.columns; count > 0;) {
        std::uint32_t const half = count / 2;
        bool const before = !(grid.right[first + half] >= span.low.v);
        first = before ? first + half + 1 : first;
        count = before ? count - half - 1 : half;
    }
    std::uint32_t end = 0;  // the first left border past the span
    for (std::uint32_t count = grid.columns; count > 0;) {
        std::uint32_t const half = count / 2;
        bool const within = grid.left[end + half] <= span.high.v;
        end = within ? end + half + 1 : end;
        count = within ? count - half - 1 : half;
    }
    if (first >= end) return {};
    return {first, end - 1};
}

/// The columns of a row that a ball touches.
///
/// expects: row and slice within the grid.
[[nodiscard]] inline Columns columns_of(RowGrid const& grid, ReadyBall const& ball, std::uint32_t row, std::uint32_t slice) {
    GNOMON_EXPECT(row < grid.rows && slice < grid.slices);
    return columns_of(grid, formula::gn_ball_row(ball, grid.row(row, slice), grid.perspective));
}

[[nodiscard]] inline Columns columns_of(RowGrid const& grid, ReadySpot const& spot, std::uint32_t row, std::uint32_t slice) {
    GNOMON_EXPECT(row < grid.rows && slice < grid.slices);
    return columns_of(grid, formula::gn_spot_row(spot, grid.row(row, slice), grid.perspective));
}

}  // namespace gnomon::cull
