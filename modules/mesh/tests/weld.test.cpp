#include <gnomon/check/check.hpp>
#include <gnomon/mesh/weld.hpp>

#include <limits>
#include <map>
#include <tuple>

using namespace gnomon;

namespace {

std::vector<std::uint32_t> welded(std::vector<math::vec3> const& positions, std::size_t& count) {
    std::vector<std::uint32_t> vertex_of(positions.size());
    std::vector<std::uint32_t> table;
    count = mesh::weld(positions, vertex_of, table);
    return vertex_of;
}

}  // namespace

TEST_CASE("weld joins both zeros, never a NaN, and no neighbours", "[mesh]") {
    float const nan = std::numeric_limits<float>::quiet_NaN();
    float const least = std::numeric_limits<float>::denorm_min();
    std::size_t count = 0;
    CHECK(welded({math::vec3(0.0F, -0.0F, 1.0F), math::vec3(-0.0F, 0.0F, 1.0F), math::vec3(nan, 0.0F, 0.0F),
                  math::vec3(nan, 0.0F, 0.0F), math::vec3(least, 0.0F, 1.0F), math::vec3(0.0F, 0.0F, 1.0F + 1e-7F)},
                 count) == std::vector<std::uint32_t>{0, 0, 2, 3, 4, 5});
    CHECK(count == 1);
    CHECK(welded({}, count).empty());
}

TEST_CASE("weld finds the first of each place among a hundred thousand", "[mesh]") {
    std::vector<math::vec3> positions;
    std::uint32_t state = 1;
    auto const number = [&] {
        state = state * 1664525U + 1013904223U;
        return static_cast<float>(state >> 27U) - 16.0F;
    };
    for (int i = 0; i < 100'000; ++i) {
        float const x = number();
        float const y = number();
        positions.emplace_back(x, y, number());
    }
    std::map<std::tuple<float, float, float>, std::uint32_t> first;
    std::vector<std::uint32_t> expected;
    for (std::uint32_t i = 0; i < positions.size(); ++i)
        expected.push_back(first.try_emplace({positions[i].x, positions[i].y, positions[i].z}, i).first->second);
    std::size_t count = 0;
    CHECK((welded(positions, count) == expected));
    CHECK(count == positions.size() - first.size());
}
