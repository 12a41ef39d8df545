#include "light_scenes.hpp"
#include "oracle.hpp"
#include "spot_oracle.hpp"

#include <gnomon/check/check.hpp>
#include <gnomon/cull/rows.hpp>

#include <algorithm>
#include <array>
#include <cstdio>

using namespace gnomon;

namespace {

struct RowCount {
    std::size_t listed = 0, exact = 0, missed = 0, undecided = 0;
};

/// Is the ball surely clear of the cluster, by bounds of its own?
bool surely_clear(cluster::GridView const& g, test::Cell c, test::SceneLight const& light) {
    auto const d = static_cast<double>(light.center.z), r = static_cast<double>(light.range) * 1.001 + 1e-3;
    double const near = std::max(static_cast<double>(g.depth_m[c.slice]), d - r);
    double const far = std::min(static_cast<double>(g.depth_m[c.slice + 1]), d + r);
    if (near > far) return true;
    auto const apart = [&](float low, float high, float at) {
        double const l = std::min(static_cast<double>(low) * near, static_cast<double>(low) * far);
        double const h = std::max(static_cast<double>(high) * near, static_cast<double>(high) * far);
        return static_cast<double>(at) + r < l || static_cast<double>(at) - r > h;
    };
    return apart(g.x[c.column], g.x[c.column + 1], light.center.x) || apart(g.y[c.row], g.y[c.row + 1], light.center.y);
}

RowCount count_pairs(cluster::GridView const& view, cull::RowGrid const& grid, std::vector<test::SceneLight> const& lights) {
    RowCount n;
    for (test::SceneLight const& light : lights) {
        cull::ReadyBall const ball = cull::ready_ball(light.center, light.range, grid.perspective);
        for (std::uint32_t k = 0; k < grid.slices; ++k)
            for (std::uint32_t j = 0; j < grid.rows; ++j) {
                cull::Columns const got = cull::columns_of(grid, ball, j, k);
                n.listed += got.count();
                for (std::uint32_t i = 0; i < grid.columns; ++i) {
                    bool const listed = got.first <= i && i <= got.last;
                    if (!listed && surely_clear(view, {i, j, k}, light)) continue;
                    test::Touch const truth = test::ball_touches(view, {i, j, k}, light.center, light.range);
                    n.exact += truth == test::Touch::yes ? 1 : 0;
                    n.undecided += truth == test::Touch::undecided ? 1 : 0;
                    n.missed += truth != test::Touch::no && !listed ? 1 : 0;
                }
            }
    }
    return n;
}

RowCount count_spot_pairs(cluster::GridView const& view, cull::RowGrid const& grid, std::vector<test::SceneLight> const& lights) {
    RowCount n;
    for (test::SceneLight const& light : lights) {
        cull::ReadyBall const ball = cull::ready_ball(light.center, light.range, grid.perspective);
        float const cosine = std::cos(light.half_angle_rad), sine = std::sin(light.half_angle_rad);
        cull::ReadySpot const spot = cull::ready_spot(ball, light.axis, cosine, sine, grid.perspective);
        test::Solid const solid = test::solid_of_spot(light.center, light.range, light.axis, static_cast<double>(cosine), static_cast<double>(sine));
        for (std::uint32_t k = 0; k < grid.slices; ++k)
            for (std::uint32_t j = 0; j < grid.rows; ++j) {
                cull::Columns const got = cull::columns_of(grid, spot, j, k);
                n.listed += got.count();
                for (std::uint32_t i = 0; i < grid.columns; ++i) {
                    bool const listed = got.first <= i && i <= got.last;
                    if (!listed && surely_clear(view, {i, j, k}, light)) continue;
                    test::Touch const truth = test::solids_touch(solid, test::solid_of_cell(view, {i, j, k}), 100);
                    n.exact += truth == test::Touch::yes ? 1 : 0;
                    n.undecided += truth == test::Touch::undecided ? 1 : 0;
                    n.missed += truth == test::Touch::yes && !listed ? 1 : 0;
                }
            }
    }
    return n;
}

}  // namespace

TEST_CASE("the scenes of the yardsticks begin as printed", "[cull]") {
    auto const v = test::make_lights(test::light_scenes[0], 1), d = test::make_lights(test::light_scenes[2], 1);
    CHECK(v[0].center == math::vec3(80.755195F, -3.230628F, 92.484195F));
    CHECK(std::abs(v[0].range - 1.706596F) < 1e-6F);
    CHECK(std::abs(d[0].center.x - 69.090799F) < 1e-5F);
    CHECK(std::abs(d[0].center.z - 79.125646F) < 1e-5F);
}

TEST_CASE("a ball's rows hold every cluster that it touches, and nearly nothing else", "[cull]") {
    test::YardGrid const yard;
    cluster::GridView const view = yard.view();
    cull::RowGrid const grid = cull::make_row_grid(view);
    std::array<std::size_t, 4> const printed_64{259, 2682, 2493, 32756}, printed_256{1081, 13248, 7921, 99265};
    for (std::size_t s = 0; s < 4; ++s) {
        RowCount const few = count_pairs(view, grid, test::make_lights(test::light_scenes[s], 64));
        RowCount const many = count_pairs(view, grid, test::make_lights(test::light_scenes[s], 256));
        CAPTURE(test::light_scenes[s].name, few.listed, many.listed, many.exact, many.undecided);
        CHECK(few.exact == printed_64[s]);
        CHECK(many.exact == printed_256[s]);
        CHECK(few.missed + many.missed == 0);
        CHECK(many.listed <= many.exact + many.exact / 1000);
    }
}

TEST_CASE("a spot's rows hold every cluster that it touches, and at most a quarter more", "[cull]") {
    test::YardGrid const yard;
    cluster::GridView const view = yard.view();
    cull::RowGrid const grid = cull::make_row_grid(view);
    for (auto const& scene : test::light_scenes) {
        RowCount const n = count_spot_pairs(view, grid, test::make_lights(scene, 64));
        CAPTURE(scene.name, n.listed, n.exact, n.undecided);
        CHECK(n.missed == 0);
        CHECK(n.undecided <= n.exact / 1000);
        CHECK(n.listed * 4 <= n.exact * 5);
    }
}

TEST_CASE("rows of 4096 balls and spots of the yardsticks' scenes", "[cull][.full]") {
    test::YardGrid const yard;
    cluster::GridView const view = yard.view();
    cull::RowGrid const grid = cull::make_row_grid(view);
    for (auto const& scene : test::light_scenes) {
        auto const lights = test::make_lights(scene, 4096);
        RowCount const balls = count_pairs(view, grid, lights), spots = count_spot_pairs(view, grid, lights);
        std::printf("%s: balls %zu listed, %zu exact, %zu undecided; spots %zu listed, %zu exact, %zu undecided\n", scene.name, balls.listed,
                    balls.exact, balls.undecided, spots.listed, spots.exact, spots.undecided);
        CHECK(balls.missed + spots.missed == 0);
        CHECK(balls.listed <= balls.exact + balls.exact / 1000);
        CHECK(spots.listed * 4 <= spots.exact * 5);
        if (!scene.by_volume && scene.r0 > 9) CHECK(balls.exact == 1683500);
    }
}
