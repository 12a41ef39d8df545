#pragma once
// A grid of clusters over a view: tiles of pixels times depth slices, and the planes that culling sees.
//
// What keys and planes promise each other, for a pixel's column and row and a depth's slice k:
//   - depth: any float in [first plane, last plane] lies in the closed range of its slice, exactly.
//   - x and y: `position_at` of any image point of the pixel, at least `border_px()` inside of its tile, lies in the
//     cluster's hexahedron, exactly: pixel centres and a multisample's points do. Of all points of the closed pixel,
//     none is farther outside than `border_slack_m`. (A plane is one float for both of its sides, so it cannot be
//     rounded outward for both.)
//   - a sample that was computed another way adds its own error, of which the grid knows nothing.

#include <gnomon/cluster/formula/grid.glsl>
#include <gnomon/cluster/grid_view.hpp>
#include <gnomon/cluster/slices.hpp>
#include <gnomon/core/contract.hpp>
#include <gnomon/core/result.hpp>
#include <gnomon/math/view.hpp>

#include <cstdint>
#include <type_traits>
#include <utility>
#include <vector>

namespace gnomon::cluster {

enum class GridError : std::uint8_t {
    bad_view,    ///< A window without extent, an image without pixels or beyond 65536 a side: give another view.
    bad_tile,    ///< Tiles of less than 1 or more than 65536 pixels a side.
    bad_depth,   ///< A perspective grid whose first plane is below 1e-12 m: move it.
    uncovered,   ///< The view reaches before the first or beyond the last plane: change the slices, or say open_end.
    unresolved,  ///< A window so small and far from the axis that floats cannot tell pixels apart: a wider one.
    too_many,    ///< More than 2^32 - 1 clusters: larger tiles or fewer slices.
};

/// What a shader gets, beside the words of the slices.
using GridTable = formula::GnGrid;

static_assert(sizeof(GridTable) == 68 && std::is_trivially_copyable_v<GridTable>);

/// Owns the planes that `GridView` shows. Made by `make_grid`; moves freely.
class Grid {
public:
    /// expects: the grid lives as long as the view of it, and is not assigned to.
    [[nodiscard]] GridView view() const noexcept { return {x_, y_, slices_.planes_m(), table_.perspective != 0}; }
    [[nodiscard]] DepthSlices const& slices() const noexcept { return slices_; }
    [[nodiscard]] GridTable const& table() const noexcept { return table_; }
    [[nodiscard]] math::ivec2 size_px() const noexcept { return size_px_; }
    [[nodiscard]] std::uint32_t clusters() const noexcept { return table_.columns * table_.rows * slices_.count(); }

    /// How far inside of its tile a point must lie to be inside of the hexahedron for certain: at most 1/16 pixel.
    [[nodiscard]] double border_px() const noexcept { return border_px_; }
    /// How far outside of the hexahedron, along x or y, a point of the tile's closed pixels may be at `depth_m`.
    [[nodiscard]] double border_slack_m(float depth_m) const noexcept {
        return table_.perspective != 0 ? border_ * static_cast<double>(depth_m) : border_;
    }

private:
    friend struct GridMaker;
    explicit Grid(DepthSlices slices) noexcept : slices_(std::move(slices)) {}

    std::vector<float> x_;
    std::vector<float> y_;
    DepthSlices slices_;
    GridTable table_{};
    math::ivec2 size_px_{1, 1};
    double border_px_ = 0.0;
    double border_ = 0.0;
};

using GridResult = core::Result<Grid, GridError>;

/// The grid of `view` in tiles of `tile_px` and the given slices. The last column and row have their tile's full border,
/// outside of the image where the image is no multiple of the tile.
///
/// cost: allocates the planes
[[nodiscard]] GridResult make_grid(math::View const& view, math::ivec2 const& tile_px, DepthSlices slices);

/// Slices as deep as the view's tiles are high, to `end_m` and no farther than the view: exponential with perspective,
/// uniform without. The last is open where the view goes on.
[[nodiscard]] SliceResult make_cubical_slices(math::View const& view, std::int32_t tile_y_px, double end_m);

/// Column, row and slice of a cluster.
struct ClusterCoordinates {
    std::uint32_t column = 0;
    std::uint32_t row = 0;
    std::uint32_t slice = 0;

    friend constexpr bool operator==(ClusterCoordinates const&, ClusterCoordinates const&) noexcept = default;
};

/// The cluster of a pixel at a depth.
///
/// expects: a pixel of the image. Any float is a legal depth, see `slice_at`.
/// source:  [Olsson 2014, Paper II, 3.1]: (i, j) = (floor(x / t_x), floor(y / t_y))
[[nodiscard]] inline ClusterCoordinates coordinates_at(Grid const& grid, math::uvec2 const& pixel, float depth_m) noexcept {
    GNOMON_EXPECT(pixel.x < static_cast<std::uint32_t>(grid.size_px().x) && pixel.y < static_cast<std::uint32_t>(grid.size_px().y));
    using Uint = formula::Uint<float>;
    return {gn_column_of(grid.table(), Uint(pixel.x)).v, gn_row_of(grid.table(), Uint(pixel.y)).v,
            slice_at(grid.slices(), depth_m)};
}

/// The dense index of the cluster of a pixel at a depth: that of `GridView::index`.
[[nodiscard]] inline std::uint32_t cluster_at(Grid const& grid, math::uvec2 const& pixel, float depth_m) noexcept {
    ClusterCoordinates const c = coordinates_at(grid, pixel, depth_m);
    return (c.slice * grid.table().rows + c.row) * grid.table().columns + c.column;
}

/// Column, row and slice of a dense index.
///
/// expects: an index of the grid.
[[nodiscard]] constexpr ClusterCoordinates coordinates_of(GridView const& grid, std::size_t index) noexcept {
    GNOMON_EXPECT(index < grid.clusters());
    std::size_t const tiles = index / grid.columns();
    return {static_cast<std::uint32_t>(index % grid.columns()), static_cast<std::uint32_t>(tiles % grid.rows()),
            static_cast<std::uint32_t>(tiles / grid.rows())};
}

/// Where the image point `px` lies at a depth, in the view space of the culling: x right, y down, depth.
[[nodiscard]] inline math::vec3 position_at(Grid const& grid, math::vec2 const& px, float depth_m) noexcept {
    using Float = formula::Float<float>;
    return math::vec3(gn_position_at(grid.table(), Float(px.x), Float(px.y), Float(depth_m)));
}

/// A position of the world in the view space of the culling, taken in double and rounded once.
///
/// returns: (x right, y down, depth in front of the eye), metres
[[nodiscard]] inline math::vec3 culling_position(math::View const& view, math::dvec3 const& world_m) noexcept {
    math::dvec3 const relative = world_m - view.eye_m;
    return math::to_float(math::dvec3(glm::dot(view.right, relative), -glm::dot(view.up, relative),
                                      -glm::dot(view.back, relative)));
}

/// Whether a point lies in the closed hexahedron of a cluster, in exact arithmetic (a product of floats is a double).
///
/// returns: false for NaN
[[nodiscard]] inline bool contains(GridView const& grid, ClusterCoordinates const& c, math::vec3 const& p) noexcept {
    double const scale = grid.perspective ? static_cast<double>(p.z) : 1.0;
    auto const within = [&](std::span<float const> borders, std::uint32_t i, float at) {
        double const x = static_cast<double>(at);
        return static_cast<double>(borders[i]) * scale <= x && x <= static_cast<double>(borders[i + 1]) * scale;
    };
    return grid.depth_m[c.slice] <= p.z && p.z <= grid.depth_m[c.slice + 1] && within(grid.x, c.column, p.x) &&
           within(grid.y, c.row, p.y);
}

}  // namespace gnomon::cluster

#include <gnomon/cluster/detail/make_grid.hpp>
