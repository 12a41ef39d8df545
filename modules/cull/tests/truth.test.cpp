#include "hard_pairs.hpp"

#include <gnomon/check/check.hpp>
#include <gnomon/cull.hpp>

using namespace gnomon;

namespace {

struct Tally {
    std::size_t touching = 0, missed = 0, undecided = 0, listed = 0;

    void add(test::Touch truth, bool is_listed) {
        touching += truth == test::Touch::yes ? 1 : 0;
        undecided += truth == test::Touch::undecided ? 1 : 0;
        missed += truth == test::Touch::yes && !is_listed ? 1 : 0;
        listed += is_listed ? 1 : 0;
    }
};

bool holds(cull::Columns const& columns, std::uint32_t column) { return columns.first <= column && column <= columns.last; }

double size_of(test::HardLight const& l, test::HardGrid const& g, test::Cell c) {
    double const d = std::isfinite(g.depth_m[c.slice + 1]) ? static_cast<double>(g.depth_m[c.slice + 1]) : 3 * static_cast<double>(g.depth_m[c.slice]) + 10;
    return test::norm(test::to_v3(l.center)) + static_cast<double>(l.range) + d;
}

struct Tallies {
    Tally balls, spots, boxes;
};

void try_pair(test::Draw& draw, test::HardGrid const& hard, cull::RowGrid const& grid, Tallies& tallies) {
    test::Cell const c{draw.below(grid.columns), draw.below(grid.rows), draw.below(grid.slices)};
    test::HardLight const l = test::make_hard_light(draw, hard, c);
    cluster::GridView const view = hard.view();
    cull::ReadyBall const ball = cull::ready_ball(l.center, l.range, grid.perspective);
    tallies.balls.add(test::ball_touches(view, c, l.center, l.range), holds(cull::columns_of(grid, ball, c.row, c.slice), c.column));
    double const size = size_of(l, hard, c);
    test::Solid const cell = test::solid_of_cell(view, c);
    cull::ReadySpot const spot = cull::ready_spot(ball, l.axis, l.cosine, l.sine, grid.perspective);
    auto const solid = test::solid_of_spot(l.center, l.range, l.axis, static_cast<double>(l.cosine), static_cast<double>(l.sine));
    tallies.spots.add(test::solids_touch(solid, cell, size), holds(cull::columns_of(grid, spot, c.row, c.slice), c.column));
    cull::Box const box{l.center, l.half[0], l.half[1], l.half[2]};
    cull::Columns const in_box = cull::columns_of(grid, cull::box_row(grid, box, c.row, c.slice));
    tallies.boxes.add(test::solids_touch(test::solid_of_box(l), cell, size), holds(in_box, c.column));
}

void try_pairs(std::size_t count) {
    test::Draw draw{7};
    Tallies all;
    for (std::size_t n = 0; n < count; n += 64) {
        test::HardGrid const hard = test::make_hard_grid(draw);
        cull::RowGrid const grid = cull::make_row_grid(hard.view());
        for (int i = 0; i < 64; ++i) {
            Tallies now;
            try_pair(draw, hard, grid, now);
            for (auto const part : {&Tallies::balls, &Tallies::spots, &Tallies::boxes}) {
                CAPTURE(n, i, hard.perspective);
                CHECK((now.*part).missed == 0);
                (all.*part).touching += (now.*part).touching;
                (all.*part).listed += (now.*part).listed;
                (all.*part).undecided += (now.*part).undecided;
            }
        }
    }
    CAPTURE(all.balls.touching, all.balls.listed, all.spots.touching, all.spots.listed, all.boxes.touching, all.boxes.listed,
            all.balls.undecided, all.spots.undecided, all.boxes.undecided);
    // Many touch, many do not, and few of those are listed; spots are bounded by lines, and these lights are aimed.
    CHECK(all.balls.touching > count / 4);
    CHECK(all.balls.touching < count * 9 / 10);
    CHECK(all.balls.listed <= all.balls.touching + all.balls.undecided + count / 100);
    CHECK(all.spots.listed <= all.spots.touching + all.spots.undecided + count / 8);
    CHECK(all.boxes.listed <= all.boxes.touching + all.boxes.undecided + count / 8);
    CHECK(all.balls.undecided < count / 200);
    CHECK(all.spots.undecided < count / 20);
    CHECK(all.boxes.undecided < count / 50);
}

}  // namespace

TEST_CASE("no cluster that a ball, a spot or a box touches is left out, however nearly it misses", "[cull][property]") { try_pairs(20000); }

TEST_CASE("no cluster that a ball, a spot or a box touches is left out, a million pairs", "[cull][.full]") { try_pairs(1000000); }
