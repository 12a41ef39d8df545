#include <gnomon/check/check.hpp>
#include <gnomon/cluster/grid_view.hpp>

#include <array>

using namespace gnomon;

TEST_CASE("dense indices of clusters run through columns, then rows, then slices, without a gap", "[cluster]") {
    std::array<float, 4> const x{-1.0F, -0.3F, 0.3F, 1.0F};
    std::array<float, 3> const y{-1.0F, 0.0F, 1.0F};
    std::array<float, 3> const depth_m{0.1F, 5.0F, 100.0F};
    cluster::GridView const grid{x, y, depth_m};
    REQUIRE(grid.clusters() == 12);
    std::size_t next = 0;
    for (std::uint32_t slice = 0; slice < grid.slices(); ++slice)
        for (std::uint32_t row = 0; row < grid.rows(); ++row)
            for (std::uint32_t column = 0; column < grid.columns(); ++column) CHECK(grid.index(column, row, slice) == next++);
    CHECK(next == grid.clusters());
}
