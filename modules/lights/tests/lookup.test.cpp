#include "../../cull/tests/light_scenes.hpp"

#include <gnomon/check/check.hpp>
#include <gnomon/lights/formula/lookup.glsl>
#include <gnomon/lights/planes.hpp>

using namespace gnomon;

TEST_CASE("a shader's lookup finds the words and indices that the assignment wrote", "[lights]") {
    test::YardGrid const yard;
    cluster::GridView const view = yard.view();
    cull::RowGrid const grid = cull::make_row_grid(view);
    std::vector<lights::Light> const list(40, lights::make_point({5.0F, 1.0F, 20.0F}, 3.0F));
    lights::Workspace work;
    lights::BitPlanes planes;
    lights::assign_planes(grid, list, {}, work, planes);
    formula::GnClusterCounts const shader{grid.columns, grid.rows, grid.slices};
    using U = formula::Uint<float>;
    for (std::uint32_t k = 0; k < grid.slices; ++k)
        for (std::uint32_t j = 0; j < grid.rows; ++j)
            for (std::uint32_t i = 0; i < grid.columns; ++i) {
                auto const cluster = formula::gn_cluster_index(shader, U(i), U(j), U(k));
                REQUIRE(cluster.v == view.index(i, j, k));
                auto const word = formula::gn_plane_word(U(1U), U(static_cast<std::uint32_t>(planes.stride)), cluster);
                REQUIRE((planes.words[word.v] & 1U) == (planes.has(cluster.v, 32) ? 1U : 0U));
            }
    CHECK(formula::gn_index_of_pair(U(0x1234ABCDU), U(6U)).v == 0xABCDU);
    CHECK(formula::gn_index_of_pair(U(0x1234ABCDU), U(7U)).v == 0x1234U);
}
