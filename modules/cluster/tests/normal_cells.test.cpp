#include <gnomon/check/check.hpp>
#include <gnomon/cluster/normal_cells.hpp>
#include <gnomon/math/generators.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <set>

namespace {

using namespace gnomon;

/// The cosine of the angle between two float vectors, to 1e-18.
long double cosine(math::vec3 const& a, math::vec3 const& b) {
    auto const dot = [](math::vec3 const& p, math::vec3 const& q) {
        return static_cast<long double>(p.x) * static_cast<long double>(q.x) + static_cast<long double>(p.y) * static_cast<long double>(q.y) +
               static_cast<long double>(p.z) * static_cast<long double>(q.z);
    };
    return dot(a, b) / std::sqrt(dot(a, a) * dot(b, b));
}

/// Directions on and beside the borders of cells, of any length.
auto cell_directions(std::uint32_t n) {
    return [n](check::Choices& choices) {
        auto const part = [&] {
            auto const k = static_cast<int>(choices.draw(n));
            float const border = 2.0F * static_cast<float>(k) / static_cast<float>(n) - 1.0F;
            float const any = check::floats(-1.0F, 1.0F)(choices);
            auto const beside = static_cast<float>(check::integers(-8, 8)(choices)) * 0x1p-25F;
            return choices.draw(3) == 3 ? any : std::clamp(border + beside, -1.0F, 1.0F);
        };
        float const first = part();
        float const second = part();
        float const scale = check::element_of({1.0F, 0.577F, 3.0F, 1e-3F, 0.1F})(choices);
        math::vec3 d(first, second, choices.draw(1) != 0 ? -1.0F : 1.0F);
        if (auto const turn = choices.draw(2); turn != 0) std::swap(turn == 1 ? d.x : d.y, d.z);
        return d * scale;
    };
}

}  // namespace

TEST_CASE("the cone of a cell holds every direction that falls into it, and its corners touch it", "[cluster][property]") {
    for (std::uint32_t const n : {1U, 2U, 3U, 5U, 16U, 104U}) {
        auto const cones = cluster::make_cell_cones(n);
        REQUIRE(cones.size() == 6 * n * n);
        check::for_all(check::cases(8000), cell_directions(n), [&](math::vec3 const& d) {
            auto const cell = cluster::normal_cell(d, n);
            REQUIRE(cell < cones.size());
            CHECK(cosine(cones[cell].axis, d) >= static_cast<long double>(cones[cell].cos_half));
        });
        for (std::uint32_t cell = 0; cell < cones.size(); ++cell) {
            auto const corners = cluster::detail::cell_corners(cell, n);
            double const tight = cluster::detail::least_cosine(math::to_double(cones[cell].axis), corners);
            if (!(static_cast<double>(cones[cell].cos_half) > tight - 1.3e-6)) FAIL("a cone is wider than its cell");
        }
    }
}

TEST_CASE("cones are the narrowest: no axis beside theirs holds the corners more tightly", "[cluster]") {
    for (std::uint32_t const n : {1U, 3U, 8U})
        for (std::uint32_t cell = 0; cell < 6 * n * n; ++cell) {
            auto const corners = cluster::detail::cell_corners(cell, n);
            auto const axis = cluster::detail::narrowest_axis(corners);
            double const best = cluster::detail::least_cosine(axis, corners);
            for (math::axis_t a = 0; a < 3; ++a)
                for (double const step : {-1e-3, 1e-3}) {
                    math::dvec3 moved = axis;
                    moved[a] += step;
                    CHECK(cluster::detail::least_cosine(moved, corners) <= best + 1e-12);
                }
        }
    // 3 x 3 on a face: the middle cell's corners are at atan(sqrt(2) / 3).
    CHECK(std::abs(static_cast<double>(cluster::cone_of_cell(4, 3).cos_half) - std::cos(std::atan(std::sqrt(2.0) / 3.0))) < 5e-6);
}

TEST_CASE("a direction's face is its largest coordinate's, and all cells are reached", "[cluster]") {
    CHECK(cluster::normal_cell(math::vec3(1, 0, 0), 1) == 0);
    CHECK(cluster::normal_cell(math::vec3(-1, 0, 0), 1) == 1);
    CHECK(cluster::normal_cell(math::vec3(0, 1, 0), 1) == 2);
    CHECK(cluster::normal_cell(math::vec3(0, -1, 0), 1) == 3);
    CHECK(cluster::normal_cell(math::vec3(0, 0, 1), 1) == 4);
    CHECK(cluster::normal_cell(math::vec3(0, 0, -1), 1) == 5);
    std::set<std::uint32_t> seen;
    for (int i = 0; i < 60; ++i)
        for (int j = 0; j < 60; ++j)
            for (math::axis_t axis = 0; axis < 3; ++axis)
                for (float const sign : {-1.0F, 1.0F}) {
                    math::vec3 d(static_cast<float>(i) / 29.5F - 1.0F);
                    d[(axis + 1) % 3] = static_cast<float>(j) / 29.5F - 1.0F;
                    d[axis] = sign;
                    seen.insert(cluster::normal_cell(d, 3));
                }
    CHECK(seen.size() == 54);
    CHECK(*seen.rbegin() == 53);
}

TEST_CASE("no normal is without a cell, and lanes have the same ones", "[cluster][property]") {
    using Group = math::Lanes<float, 4>;
    auto const any = check::any_float<float>().with_nan().with_inf();
    check::for_all(any, any, any, check::integers(1U, 104U), [](float x, float y, float z, std::uint32_t n) {
        std::uint32_t const cell = cluster::normal_cell(math::vec3(x, y, z), n);
        CHECK(cell < 6 * n * n);
        formula::Vec3<Group> const d(Group::all(x), Group::all(y), Group::all(z));
        CHECK(gn_normal_cell(d, n).v[3] == cell);
    });
}
