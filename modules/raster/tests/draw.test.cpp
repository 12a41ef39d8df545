#include <gnomon/check/check.hpp>
#include <gnomon/raster/draw.hpp>

#include <vector>

namespace {

using namespace gnomon;
using namespace gnomon::raster;

}  // namespace

TEST_CASE("indices read the same whatever their width", "[raster][draw]") {
    std::vector<std::uint32_t> const wide{7, 0, 65535};
    std::vector<std::uint16_t> const narrow{7, 0, 65535};
    IndexSpan const a = std::span<std::uint32_t const>(wide);
    IndexSpan const b = std::span<std::uint16_t const>(narrow);
    REQUIRE((a.size() == 3 && b.size() == 3));
    for (std::size_t i = 0; i < 3; ++i) CHECK(a[i] == b[i]);
    CHECK((a.narrow() == nullptr && b.wide() == nullptr && IndexSpan{}.empty()));
}

TEST_CASE("a draw has as many triangles as whole threes of indices, or of positions without any", "[raster][draw]") {
    std::vector<math::vec3> const positions(11, math::vec3(0.0F));
    std::vector<std::uint32_t> const indices{0, 1, 2, 3, 4};
    Draw draw{.positions = std::span<math::vec3 const>(positions), .indices = {}};
    CHECK(triangle_count(draw) == 3);
    draw.indices = std::span<std::uint32_t const>(indices);
    CHECK(triangle_count(draw) == 1);
    CHECK(triangle_count(Draw{}) == 0);
}

TEST_CASE("validation finds nothing in a sound draw and a missing texture in an alpha test", "[raster][draw]") {
    std::vector<math::vec3> const positions(3, math::vec3(1.0F));
    std::vector<std::uint32_t> const indices{0, 1, 2};
    Draw draw{.positions = std::span<math::vec3 const>(positions), .indices = std::span<std::uint32_t const>(indices)};
    CHECK_FALSE(validate(draw).any());
    AlphaTest const test;
    draw.alpha_test = &test;
    CHECK(validate(draw).uv_missing);
}
