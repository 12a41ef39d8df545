#include "../../cull/tests/light_scenes.hpp"
#include "any_light.hpp"

#include <gnomon/check/check.hpp>
#include <gnomon/lights/brute_force.hpp>
#include <gnomon/lights/hull.hpp>

#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <limits>
#include <map>
#include <set>
#include <utility>
#include <vector>

using namespace gnomon;

namespace {

bool is_mesh(lights::Hull const& hull) { return hull.kind <= static_cast<std::uint32_t>(lights::HullKind::cone); }

std::array<std::uint32_t, 3> corners_of(lights::Hull const& hull, std::uint32_t face) {
    std::uint32_t const c = formula::gn_hull_face_corners(hull.kind, face);
    return {c & 15U, c >> 4U & 15U, c >> 8U};
}

std::set<std::pair<std::uint32_t, std::uint32_t>> marked(lights::Hull const& hull, cluster::GridView const& grid) {
    std::set<std::pair<std::uint32_t, std::uint32_t>> tiles;
    for (std::uint32_t f = 0; is_mesh(hull) && f < lights::hull_faces; ++f)
        lights::for_each_tile(hull, f, {grid.x, grid.y, grid.perspective}, [&](std::uint32_t i, std::uint32_t j) { tiles.insert({i, j}); });
    return tiles;
}

/// A point that the light reaches.
math::dvec3 point_of(test::Draw& draw, lights::Light const& l) {
    auto const range = static_cast<double>(l.range_m);
    test::V3 const to = test::direction(draw);
    math::dvec3 way(to.x, to.y, to.z);
    if (l.kind == lights::Kind::spot) {
        math::dvec3 const axis = glm::normalize(math::to_double(l.axis));
        math::dvec3 const aside = way - axis * glm::dot(way, axis);
        double const half = std::atan2(static_cast<double>(l.sin_half), static_cast<double>(l.cos_half));
        double const out = half * (draw.below(2) != 0 ? 1.0 : draw.unit());
        double const length = glm::length(aside);
        way = length > 1e-6 ? axis * std::cos(out) + aside * (std::sin(out) / length) : axis;
    }
    double const far = draw.below(2) != 0 ? 1.0 : draw.unit();
    return math::to_double(l.center) + way * (range * far);
}

}  // namespace

TEST_CASE("a hull is a closed mesh, wound outward, that holds its light", "[lights][property]") {
    test::Draw draw{5};
    std::array<int, 2> seen{0, 0};
    for (int n = 0; n < 4000; ++n) {
        test::HardGrid const hard = test::make_hard_grid(draw);
        lights::Light const l = test::make_any_light(draw, hard, cull::make_row_grid(hard.view()));
        lights::Hull const hull = lights::make_hull(l, hard.perspective);
        if (l.kind == lights::Kind::directional) CHECK(hull.kind == 2);
        if (!lights::is_sound(l)) CHECK(hull.kind == 3);
        if (!is_mesh(hull) || l.kind == lights::Kind::box) continue;
        ++seen[hull.kind];
        std::map<std::pair<std::uint32_t, std::uint32_t>, int> edges;
        for (std::uint32_t f = 0; f < lights::hull_faces; ++f) {
            auto const corner = corners_of(hull, f);
            for (std::size_t k = 0; k < 3; ++k) ++edges[{corner[k], corner[(k + 1) % 3]}];
            math::dvec3 const a = math::to_double(formula::gn_hull_corner(hull, corner[0]));
            math::dvec3 const b = math::to_double(formula::gn_hull_corner(hull, corner[1]));
            math::dvec3 const c = math::to_double(formula::gn_hull_corner(hull, corner[2]));
            math::dvec3 const normal = glm::cross(b - a, c - a);
            for (int i = 0; i < 4; ++i) {
                math::dvec3 const p = point_of(draw, l);
                CHECK(glm::dot(normal, p - a) < 0.0);
            }
        }
        CHECK(edges.size() == 60);
        for (auto const& [edge, times] : edges) CHECK((times == 1 && edges.count({edge.second, edge.first}) == 1));
    }
    CHECK(seen[0] > 1000);
    CHECK(seen[1] > 500);
}

TEST_CASE("no tile that a light touches is left out by its hull's triangles, however nearly it misses", "[lights][property]") {
    test::Draw draw{23};
    std::size_t touching = 0, covered = 0, undecided = 0;
    for (int n = 0; n < 500; ++n) {
        test::HardGrid hard = test::make_hard_grid(draw);
        hard.depth_m = {hard.depth_m[0], std::numeric_limits<float>::infinity()};
        cluster::GridView const view = hard.view();
        cull::RowGrid const rows = cull::make_row_grid(view);
        for (int k = 0; k < 12; ++k) {
            lights::Light const l = test::make_any_light(draw, hard, rows);
            lights::Hull const hull = lights::make_hull(l, hard.perspective);
            if (!is_mesh(hull) || l.kind == lights::Kind::box) continue;
            auto const tiles = marked(hull, view);
            bool const is_cone = l.kind == lights::Kind::spot && l.cos_half > 0.0F;
            auto const solid = test::solid_of_spot(l.center, l.range_m, l.axis, static_cast<double>(l.cos_half), static_cast<double>(l.sin_half));
            for (int i = 0; i < 6; ++i) {
                test::Cell const c{draw.below(view.columns()), draw.below(view.rows()), 0};
                double const size = test::norm(test::to_v3(l.center)) + static_cast<double>(l.range_m) + 3 * static_cast<double>(view.depth_m[0]) + 10;
                test::Touch const truth = is_cone ? test::solids_touch(solid, test::solid_of_cell(view, c), size) : test::ball_touches(view, c, l.center, l.range_m);
                bool const is_marked = tiles.count({c.column, c.row}) != 0;
                CAPTURE(n, k, i, c.column, c.row, hard.perspective, hull.kind);
                if (truth == test::Touch::yes) CHECK(is_marked);
                touching += truth == test::Touch::yes ? 1U : 0U;
                undecided += truth == test::Touch::undecided ? 1U : 0U;
                covered += is_marked ? 1U : 0U;
            }
            math::dvec3 const p = point_of(draw, l);
            double const scale = hard.perspective ? p.z : 1.0;
            if (!(p.z > 0.0)) continue;
            for (std::uint32_t i = 0; i < view.columns(); ++i)
                for (std::uint32_t j = 0; j < view.rows(); ++j) {
                    bool const in = p.x >= static_cast<double>(view.x[i]) * scale && p.x <= static_cast<double>(view.x[i + 1]) * scale &&
                                    p.y >= static_cast<double>(view.y[j]) * scale && p.y <= static_cast<double>(view.y[j + 1]) * scale;
                    if (in) CHECK(tiles.count({i, j}) != 0);
                }
        }
    }
    CAPTURE(touching, covered, undecided);
    CHECK(touching > 2000);
    CHECK(covered < 3 * touching);
    CHECK(undecided < 3000);
}

TEST_CASE("hulls cover little more tiles than their lights touch", "[lights]") {
    test::YardGrid yard;
    yard.depth_m = {0.1F, std::numeric_limits<float>::infinity()};
    cull::RowGrid const rows = cull::make_row_grid(yard.view());
    for (test::LightScene const& scene : test::light_scenes)
        for (bool const spots : {false, true}) {
            std::size_t touch = 0, covered = 0, missed = 0;
            for (test::SceneLight const& s : test::make_lights(scene, 256)) {
                lights::Light const l = spots ? lights::make_spot(s.center, s.range, s.axis, s.half_angle_rad) : lights::make_point(s.center, s.range);
                auto const tiles = marked(lights::make_hull(l, true), yard.view());
                covered += tiles.size();
                for (std::uint32_t j = 0; j < rows.rows; ++j)
                    for (std::uint32_t i = 0; i < rows.columns; ++i) {
                        bool const touches = lights::may_touch(rows, l, i, j, 0);
                        touch += touches ? 1U : 0U;
                        missed += touches && tiles.count({i, j}) == 0 ? 1U : 0U;
                    }
            }
            std::printf("%s, %s: %zu tiles touched, %zu covered\n", scene.name, spots ? "spots" : "balls", touch, covered);
            CAPTURE(scene.name, spots, touch, covered, missed);
            if (!spots) CHECK(missed == 0);
            CHECK(missed * 10 <= touch);  // the rows of spots keep tiles that the spots miss: see above for the truth
            CHECK(covered <= 2 * touch);
        }
}
