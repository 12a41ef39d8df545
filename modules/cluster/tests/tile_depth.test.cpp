#include <gnomon/check/check.hpp>
#include <gnomon/cluster/tile_depth.hpp>
#include <gnomon/core/executor_threads.hpp>

#include <cstdint>
#include <limits>
#include <vector>

namespace {

using namespace gnomon;
using cluster::DepthRange;
using cluster::TileDepth;

cluster::Grid depth_grid(int width, int height, int tile_x, int tile_y) {
    math::PerspectiveConfig config;
    config.size_px = {width, height};
    auto const view = math::make_perspective(config).value();
    return cluster::make_grid(view, math::ivec2(tile_x, tile_y), cluster::make_cubical_slices(view, tile_y, 100.0).value()).value();
}

}  // namespace

TEST_CASE("a tile's range is that of its pixels in the image, for any executor", "[cluster][property]") {
    auto const side = check::integers(1, 150);
    check::for_all(check::cases(200), side, side, check::integers(1, 40), check::integers(1, 40), check::integers(0U, 1000U),
                   [](int width, int height, int tile_x, int tile_y, std::uint32_t seed) {
                       auto const grid = depth_grid(width, height, tile_x, tile_y);
                       std::vector<float> depth;
                       for (int i = 0; i < width * height; ++i) {
                           seed = seed * 1664525U + 1013904223U;
                           std::uint32_t const kind = seed >> 28U;
                           depth.push_back(kind == 0 ? std::numeric_limits<float>::infinity()
                                           : kind == 1 ? std::numeric_limits<float>::quiet_NaN()
                                                       : static_cast<float>(seed >> 8U) * 1e-5F);
                       }
                       std::size_t const tiles = std::size_t{grid.table().columns} * grid.table().rows;
                       std::vector<TileDepth> expected(tiles);
                       for (int y = 0; y < height; ++y)
                           for (int x = 0; x < width; ++x) {
                               auto const t = static_cast<std::size_t>(y / tile_y) * grid.table().columns + static_cast<std::size_t>(x / tile_x);
                               float const d = depth[static_cast<std::size_t>(y * width + x)];
                               if (!math::is_finite(d)) ++expected[t].background;
                               else expected[t].range = {std::min(expected[t].range.near_m, d), std::max(expected[t].range.far_m, d)};
                           }
                       std::vector<TileDepth> got(tiles);
                       reduce_tile_depths(grid, depth, got);
                       CHECK(got == expected);
                       core::ThreadExecutor const threads(3);
                       reduce_tile_depths(grid, depth, got, threads);
                       CHECK(got == expected);
                   });
}

TEST_CASE("transparent geometry is culled by what hides it, and by its own nearest sample if that is known", "[cluster]") {
    float const inf = std::numeric_limits<float>::infinity();
    TileDepth const wall{{2.0F, 9.0F}, 0};
    TileDepth const window{{2.0F, 9.0F}, 3};
    TileDepth const glass{{4.0F, 6.0F}, 100};
    TileDepth const sky{{}, 1024};
    CHECK(opaque_range(wall) == DepthRange{2.0F, 9.0F});
    CHECK(opaque_range(sky).is_empty());
    CHECK(far_only_range(wall) == DepthRange{-inf, 9.0F});
    CHECK(far_only_range(window) == DepthRange{-inf, inf});
    CHECK(transparent_range(wall, glass) == DepthRange{4.0F, 9.0F});
    CHECK(transparent_range(window, glass) == DepthRange{4.0F, inf});
    CHECK(transparent_range({{1.0F, 3.0F}, 0}, glass).is_empty());
    CHECK(transparent_range(wall, sky).is_empty());
}
