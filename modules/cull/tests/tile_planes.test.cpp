#include "hard_pairs.hpp"
#include "light_scenes.hpp"

#include <gnomon/check/check.hpp>
#include <gnomon/cull/rows.hpp>
#include <gnomon/cull/tile_planes.hpp>

#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

using namespace gnomon;

namespace {

__extension__ typedef __float128 TileQuad;

/// How far a ball is from reaching the inner side of the plane that it is farthest behind, exactly; at most 0: it reaches all.
double short_of_planes(cluster::GridView const& grid, test::Cell c, math::vec3 const& center, float radius) {
    auto const planes = test::halfspaces_of<TileQuad>(grid, c);
    TileQuad most = -1e30;
    for (std::size_t i = 0; i < planes.count; ++i) {
        auto const& h = planes.list[i];
        TileQuad const outside = h[0] * TileQuad{center.x} + h[1] * TileQuad{center.y} + h[2] * TileQuad{center.z} - h[3];
        TileQuad const gap = outside - TileQuad{radius};
        most = gap > most ? gap : most;
    }
    return static_cast<double>(most);
}

struct PlaneTally {
    std::size_t reach = 0, beyond = 0, close = 0;
};

/// expects: borders that are finite, which is what the planes of tiles are made of
void try_tile(test::Draw& draw, test::HardGrid const& hard, PlaneTally& tally) {
    test::Cell const c{draw.below(hard.view().columns()), draw.below(hard.view().rows()), draw.below(hard.view().slices())};
    test::HardLight const l = test::make_hard_light(draw, hard, c);
    cluster::GridView const view = hard.view();
    cull::TilePlanes const planes = cull::make_tile_planes(view, c.column, c.row, {view.depth_m[c.slice], view.depth_m[c.slice + 1]});
    bool const kept = cull::may_touch(planes, {l.center, l.range});
    double const gap = short_of_planes(view, c, l.center, l.range);
    double const far = std::isfinite(view.depth_m[c.slice + 1]) ? static_cast<double>(view.depth_m[c.slice + 1]) : 0.0;
    double const size = std::abs(static_cast<double>(l.center.x)) + std::abs(static_cast<double>(l.center.y)) +
                        3.6 * std::abs(static_cast<double>(l.center.z)) + static_cast<double>(l.range) + far;
    CAPTURE(gap, size, kept, hard.perspective);
    if (gap <= 0.0) CHECK(kept);                      // nothing that reaches all six is lost
    if (gap > 2e-6 * size + 1e-30) CHECK_FALSE(kept);  // nor is much else kept
    if (test::ball_touches(view, c, l.center, l.range) == test::Touch::yes) CHECK(kept);
    ++(gap <= 0.0 ? tally.reach : gap > 2e-6 * size ? tally.beyond : tally.close);
}

}  // namespace

TEST_CASE("a ball that reaches the inner sides of a tile's six planes is kept, one that misses a plane clearly is not", "[cull][property]") {
    test::Draw draw{11};
    PlaneTally tally;
    for (int n = 0; n < 700; ++n) {
        test::HardGrid hard = test::make_hard_grid(draw);
        for (std::vector<float>* list : {&hard.x, &hard.y})
            if (list->size() > 2) {  // open borders have no plane
                if (!math::is_finite(list->front())) list->erase(list->begin());
                if (!math::is_finite(list->back())) list->pop_back();
            }
        if (!math::is_finite(hard.x.front()) || !math::is_finite(hard.x.back()) || !math::is_finite(hard.y.front()) ||
            !math::is_finite(hard.y.back()) || hard.x.size() < 2 || hard.y.size() < 2)
            continue;
        for (int i = 0; i < 24; ++i) try_tile(draw, hard, tally);
    }
    CHECK(tally.reach > 3000);
    CHECK(tally.beyond > 1500);
    CHECK(tally.close > 20);
}

TEST_CASE("six planes keep what rows keep of a grid, and some balls beside its edges more", "[cull]") {
    std::vector<float> x, y;
    for (int i = 0; i <= 27; ++i) x.push_back(-1.03F + 0.077F * static_cast<float>(i));
    for (int j = 0; j <= 15; ++j) y.push_back(-0.577F + 0.077F * static_cast<float>(j));
    std::vector<float> const depth_m{5.0F, 40.0F};
    cluster::GridView const view{x, y, depth_m};
    cull::RowGrid const rows = cull::make_row_grid(view);
    std::size_t by_rows = 0, by_planes = 0;
    for (test::SceneLight const& l : test::make_lights(test::light_scenes[2], 256)) {
        cull::ReadyBall const ball = cull::ready_ball(l.center, l.range, true);
        for (std::uint32_t j = 0; j < 15; ++j) {
            cull::Columns const columns = cull::columns_of(rows, ball, j, 0);
            for (std::uint32_t i = 0; i < 27; ++i) {
                bool const in_row = columns.first <= i && i <= columns.last;
                bool const kept = cull::may_touch(cull::make_tile_planes(view, i, j, {5.0F, 40.0F}), {l.center, l.range});
                if (in_row) CHECK(kept);
                by_rows += in_row ? 1U : 0U;
                by_planes += kept ? 1U : 0U;
            }
        }
    }
    CAPTURE(by_rows, by_planes);
    CHECK(by_rows > 1000);
    CHECK(by_planes > by_rows);
    CHECK(by_planes < 2 * by_rows);
}

TEST_CASE("a ball of infinite radius is in every tile, one of negative radius or no number in none", "[cull]") {
    std::vector<float> const x{-0.5F, 0.5F}, y{-0.5F, 0.5F}, depth_m{1.0F, 2.0F};
    for (bool const perspective : {true, false}) {
        auto const planes = cull::make_tile_planes({x, y, depth_m, perspective}, 0, 0, {1.0F, 2.0F});
        CHECK(cull::may_touch(planes, {math::vec3(0.0F), std::numeric_limits<float>::infinity()}));
        CHECK(cull::may_touch(planes, {math::vec3(0.0F, 0.0F, 1.5F), 0.0F}));
        CHECK_FALSE(cull::may_touch(planes, {math::vec3(0.0F, 0.0F, 1.5F), -1.0F}));
        CHECK_FALSE(cull::may_touch(planes, {math::vec3(0.0F, 0.0F, 1.5F), std::numeric_limits<float>::quiet_NaN()}));
        CHECK_FALSE(cull::may_touch(planes, {math::vec3(9.0F, 0.0F, 1.5F), 1.0F}));
        CHECK_FALSE(cull::may_touch(planes, {math::vec3(0.0F, 0.0F, 4.5F), 1.0F}));
    }
}
