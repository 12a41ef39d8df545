#include <gnomon/check/check.hpp>
#include <gnomon/math/generators.hpp>
#include <gnomon/math/morton.hpp>

#include <cstdint>
#include <limits>

namespace {

using namespace gnomon;
using math::Aabb;
using math::vec3;

/// Interleaving by moving one bit at a time.
std::uint64_t interleaved(std::uint64_t x, std::uint64_t y, std::uint64_t z, unsigned bits) {
    std::uint64_t code = 0;
    for (unsigned i = 0; i < bits; ++i)
        code |= (x >> i & 1U) << (3 * i) | (y >> i & 1U) << (3 * i + 1) | (z >> i & 1U) << (3 * i + 2);
    return code;
}

constexpr float not_a_number = std::numeric_limits<float>::quiet_NaN();
constexpr float inf = std::numeric_limits<float>::infinity();

}  // namespace

TEST_CASE("Morton codes interleave their coordinates bit by bit", "[math][morton][property]") {
    auto const number = check::integers<std::uint32_t>(0U, (1U << 21U) - 1U);
    check::for_all(number, number, number, [](std::uint32_t x, std::uint32_t y, std::uint32_t z) {
        CHECK(math::morton_63(x, y, z) == interleaved(x, y, z, 21));
        CHECK(math::morton_30(x & 1023U, y & 1023U, z & 1023U) == interleaved(x, y, z, 10));
    });
}

TEST_CASE("a grid cell is in range for any box and any point", "[math][morton][property]") {
    check::for_all(math::boxes(), check::any_float<float>().with_nan().with_inf(), [](Aabb const& box, float x) {
        math::uvec3 const cell = math::grid_cell(box, vec3(x, -x, x), 1024);
        CHECK((cell.x < 1024 && cell.y < 1024 && cell.z < 1024));
    });
}

TEST_CASE("a grid cell never decreases along an axis", "[math][morton][property]") {
    check::for_all(math::boxes(), check::any_float<float>(), check::any_float<float>(), [](Aabb const& box, float a, float b) {
        auto const lower = math::grid_cell(box, vec3(a < b ? a : b), 1024);
        auto const upper = math::grid_cell(box, vec3(a < b ? b : a), 1024);
        CHECK((lower.x <= upper.x && lower.y <= upper.y && lower.z <= upper.z));
    });
}

TEST_CASE("the border, no extent, NaN and infinity have a defined cell", "[math][morton]") {
    Aabb const unit{vec3(0.0F), vec3(1.0F)};
    CHECK(math::grid_cell(unit, vec3(1.0F), 1024) == math::uvec3(1023U));
    CHECK(math::grid_cell(unit, vec3(math::next_down(1.0F)), 1024) == math::uvec3(1023U));
    CHECK(math::grid_cell(unit, vec3(not_a_number, inf, -inf), 1024) == math::uvec3(0U, 1023U, 0U));
    CHECK(math::grid_cell(Aabb{vec3(2.0F), vec3(2.0F)}, vec3(2.0F), 1024) == math::uvec3(0U));
    CHECK(math::grid_cell(Aabb{}, vec3(2.0F), 1024) == math::uvec3(0U));
}
