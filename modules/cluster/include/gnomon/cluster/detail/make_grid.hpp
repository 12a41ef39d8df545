#pragma once
// The checked way to make a grid; see grid.hpp.

#include <gnomon/math/text.hpp>
#include <gnomon/cluster/grid.hpp>
#include <gnomon/math/scalar.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>

namespace gnomon::cluster {

namespace detail {

/// An axis of the image: a line from pixels to tangents or metres, cut into tiles.
struct GridAxis {
    double first;  ///< At pixel 0.
    double per_px;
    std::uint32_t tile_px;
    std::uint32_t tiles;

    [[nodiscard]] double border(std::uint32_t i) const noexcept { return first + per_px * (static_cast<double>(i) * tile_px); }

    /// Twice what planes and `gn_position_at` together may be off the exact line, in tangents or metres, e = 2^-24:
    /// first, twice the extent, the sum, its product with the depth, and the plane, each rounded once.
    [[nodiscard]] double error() const noexcept {
        double const last = border(tiles);
        double const largest = std::max(std::abs(first), std::abs(last));
        return 0x1p-23 * (std::abs(first) + 2.0 * (last - first) + 3.0 * largest);
    }
};

/// The planes of an axis, nearest floats inside, rounded outward at both ends.
[[nodiscard]] inline std::vector<float> borders_of(GridAxis const& axis) {
    std::vector<float> borders;
    for (std::uint32_t i = 0; i <= axis.tiles; ++i) borders.push_back(static_cast<float>(axis.border(i)));
    if (static_cast<double>(borders.front()) > axis.border(0)) borders.front() = math::next_down(borders.front());
    if (static_cast<double>(borders.back()) < axis.border(axis.tiles)) borders.back() = math::next_up(borders.back());
    return borders;
}

[[nodiscard]] inline GridAxis axis_of(double first, double last, std::int32_t size_px, std::int32_t tile_px) noexcept {
    std::int32_t const tiles = (size_px - 1) / tile_px + 1;
    return {first, (last - first) / size_px, static_cast<std::uint32_t>(tile_px), static_cast<std::uint32_t>(tiles)};
}

[[nodiscard]] inline core::Result<core::Done, GridError> validate_view(math::View const& view, math::ivec2 const& tile_px) {
    math::Window const& w = view.window;
    bool const finite = math::is_finite(w.left) && math::is_finite(w.right) && math::is_finite(w.bottom) && math::is_finite(w.top);
    if (!finite || !(w.left < w.right) || !(w.bottom < w.top))
        return core::Failure{GridError::bad_view,
                             core::sentence({"a window from ", math::text_of(w.left), " to ", math::text_of(w.right), " and from ",
                                       math::text_of(w.bottom), " to ", math::text_of(w.top), ": each must have an extent"})};
    auto const in_range = [](std::int32_t n) { return n >= 1 && n <= 65536; };
    if (!in_range(view.size_px.x) || !in_range(view.size_px.y))
        return core::Failure{GridError::bad_view,
                             core::sentence({"an image of ", std::to_string(view.size_px.x), "x", std::to_string(view.size_px.y),
                                       " pixels: need 1 to 65536 a side"})};
    if (!in_range(tile_px.x) || !in_range(tile_px.y))
        return core::Failure{GridError::bad_tile, core::sentence({"tiles of ", std::to_string(tile_px.x), "x",
                                                            std::to_string(tile_px.y), " pixels: need 1 to 65536 a side"})};
    return core::Done{};
}

[[nodiscard]] inline core::Result<core::Done, GridError> validate_depth(math::View const& view, DepthSlices const& slices) {
    auto const first = static_cast<double>(slices.planes_m().front());
    auto const last = static_cast<double>(slices.planes_m().back());
    if (view.lens == math::Lens::perspective && !(first >= 1e-12))
        return core::Failure{GridError::bad_depth, core::sentence({"the first plane is at ", math::text_of(first),
                                                             " m; with perspective it must be at 1e-12 m or beyond"})};
    // Planes are rounded to float, near and far are not.
    double const reach = math::is_finite(view.far_m) ? std::abs(view.far_m) : 0.0;
    double const tolerance = view.lens == math::Lens::perspective ? 0.0 : 1e-6 * std::max(std::abs(view.near_m), reach);
    bool const begins = first <= view.near_m + std::max(1e-6 * std::abs(view.near_m), tolerance);
    bool const ends = !math::is_finite(last) || last >= view.far_m - std::max(1e-6 * reach, tolerance);
    if (!begins || !ends)
        return core::Failure{GridError::uncovered,
                             core::sentence({"slices from ", math::text_of(first), " m to ", math::text_of(last), " m do not cover the view's ",
                                       math::text_of(view.near_m), " m to ", math::text_of(view.far_m),
                                       " m: change either, or say open_end"})};
    return core::Done{};
}

}  // namespace detail

/// Fills a grid whose configuration was checked.
struct GridMaker {
    math::View const& view;
    detail::GridAxis x;
    detail::GridAxis y;

    [[nodiscard]] Grid make(DepthSlices slices) const {
        Grid grid(std::move(slices));
        grid.x_ = detail::borders_of(x);
        grid.y_ = detail::borders_of(y);
        grid.size_px_ = view.size_px;
        grid.border_px_ = border_px();
        grid.border_ = std::max(x.error(), y.error());
        grid.table_ = {x.tile_px,
                       y.tile_px,
                       1.0F / static_cast<float>(x.tile_px),
                       1.0F / static_cast<float>(y.tile_px),
                       x.tiles,
                       y.tiles,
                       view.lens == math::Lens::perspective ? 1U : 0U,
                       static_cast<float>(x.first),
                       static_cast<float>(x.per_px),
                       static_cast<float>(y.first),
                       static_cast<float>(y.per_px),
                       grid.slices_.table()};
        return grid;
    }
    [[nodiscard]] double border_px() const noexcept { return std::max(x.error() / x.per_px, y.error() / y.per_px); }
};

inline GridResult make_grid(math::View const& view, math::ivec2 const& tile_px, DepthSlices slices) {
    if (auto valid = detail::validate_view(view, tile_px); !valid) return std::move(valid).failure();
    if (auto valid = detail::validate_depth(view, slices); !valid) return std::move(valid).failure();
    math::Window const& w = view.window;
    GridMaker const maker{view, detail::axis_of(w.left, w.right, view.size_px.x, tile_px.x),
                          detail::axis_of(-w.top, -w.bottom, view.size_px.y, tile_px.y)};
    double const clusters = static_cast<double>(maker.x.tiles) * maker.y.tiles * slices.count();
    if (clusters > 4294967295.0)
        return core::Failure{GridError::too_many, core::sentence({math::text_of(clusters), " clusters: need less than 2^32"})};
    if (!(maker.border_px() <= 0.0625))
        return core::Failure{GridError::unresolved,
                             core::sentence({"floats err by ", math::text_of(maker.border_px()),
                                               " pixels in this window: need at most 1/16"})};
    return maker.make(std::move(slices));
}

inline SliceResult make_cubical_slices(math::View const& view, std::int32_t tile_y_px, double end_m) {
    if (view.size_px.y < 1 || tile_y_px < 1)
        return core::Failure{SliceError::bad_field,
                             core::sentence({"an image ", std::to_string(view.size_px.y), " pixels high in tiles of ",
                                               std::to_string(tile_y_px), ": need at least 1 each"})};
    double const extent = view.window.top - view.window.bottom;
    double const far_m = std::min(end_m, view.far_m);
    bool const open_end = far_m < view.far_m;
    auto const tiles = static_cast<std::uint32_t>((view.size_px.y - 1) / tile_y_px + 1);
    if (view.lens == math::Lens::perspective) return make_slices(ExponentialSlices{view.near_m, far_m, extent, tiles, open_end});
    double const count = std::ceil((far_m - view.near_m) / (extent * tile_y_px / view.size_px.y));
    bool const in_range = count >= 1.0 && count <= double{max_slices};
    return make_slices(UniformSlices{view.near_m, far_m, in_range ? static_cast<std::uint32_t>(count) : 0U, open_end});
}

}  // namespace gnomon::cluster
