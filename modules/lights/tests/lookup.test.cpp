#include "../../cull/tests/light_scenes.hpp"

#include <gnomon/check/check.hpp>
#include <gnomon/lights/formula/lookup.glsl>
#include <gnomon/lights/planes.hpp>

#include "shaders/lookup_frag.hpp"

#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

using namespace gnomon;

namespace {

std::string text_of(std::filesystem::path const& path) {
    std::ifstream in(path);
    return {std::istreambuf_iterator<char>(in), {}};
}

}  // namespace

TEST_CASE("the file that shaders copy stands alone, and the README's shader is the one that is compiled", "[lights]") {
    std::filesystem::path const tests = std::filesystem::path(__FILE__).parent_path();
    std::filesystem::path const module = tests.parent_path();
    std::string const file = text_of(module / "include" / "gnomon" / "lights" / "formula" / "lookup.glsl");
    std::size_t const only = file.find("\n#include");
    REQUIRE(only != std::string::npos);
    CHECK(file.rfind("\n#ifdef __cplusplus", only) + std::string("\n#ifdef __cplusplus").size() == only);
    CHECK(file.find("\n#include", only + 1) == std::string::npos);
    std::string const shader = text_of(tests / "shaders" / "lookup.frag");
    CHECK(shader.find("lookup.glsl") != std::string::npos);
    CHECK(text_of(module / "README.md").find("```glsl\n" + shader + "```") != std::string::npos);
    // Empty where there is no glslc.
    CHECK((gnomon::lights::test::lookup_frag.empty() || gnomon::lights::test::lookup_frag[0] == 0x07230203U));
}

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
