#include <gnomon/check/check.hpp>

#include <gnomon/predicates/edge_plane.hpp>

#include "contracted.hpp"
#include "hard_floats.hpp"

using namespace gnomon;
using predicates::Sign;
using predicates::Target;

namespace {

math::vec3 to_vec(oracle::Point const& p) { return math::vec3(p[0], p[1], p[2]); }

}  // namespace

TEST_CASE("the planes of an edge from its two triangles are each other's negative, bit for bit", "[predicates]") {
    hard::Random random{5};
    for (int i = 0; i < 20'000; ++i) {
        auto const p = hard::four_points(random);
        auto const light = random.below(2) == 0 ? Target::point(to_vec(p[2])) : Target::direction(to_vec(p[2]));
        auto const plane = predicates::make_edge_plane(to_vec(p[0]), to_vec(p[1]), light);
        auto const other = predicates::make_edge_plane(to_vec(p[1]), to_vec(p[0]), light);
        auto const here = evaluate(plane, to_vec(p[3]));
        auto const there = evaluate(other, to_vec(p[3]));
        if (p[0] == p[1]) continue;
        REQUIRE(here.value == -there.value);
        REQUIRE(here.bound == there.bound);
        REQUIRE(side(plane, to_vec(p[3])) == -side(other, to_vec(p[3])));
    }
}

TEST_CASE("the side of an edge plane is the exact line_side, fused or not", "[predicates][property]") {
    hard::Random random{6};
    int differences = 0;
    for (int i = 0; i < 40'000; ++i) {
        auto const p = hard::four_points(random);
        for (bool const at_infinity : {false, true}) {
            int const truth = oracle::line_side(p[3], p[2], at_infinity, p[0], p[1]);
            auto const light = at_infinity ? Target::direction(to_vec(p[2])) : Target::point(to_vec(p[2]));
            auto const plane = predicates::make_edge_plane(to_vec(p[0]), to_vec(p[1]), light);
            differences += static_cast<int>(side(plane, to_vec(p[3]))) != truth ? 1 : 0;
            if (contracted::is_available())
                differences += contracted::edge_plane_side(p[3], p[2], at_infinity, p[0], p[1]) != truth ? 1 : 0;
        }
    }
    CHECK(differences == 0);
}

TEST_CASE("a sample behind a shared edge is never outside both triangles' volumes", "[predicates][leak]") {
    // numerics: 1e6 random edges, float evaluation leaks up to 247,430 with FMA. Here fused and not must give 0.
    hard::Random random{7};
    int outside_both = 0;
    for (int i = 0; i < 100'000; ++i) {
        auto const unit = [&] { return random.uniform(-1.0F, 1.0F); };
        oracle::Point const a{unit(), unit(), unit()};
        oracle::Point const b{unit(), unit(), unit()};
        oracle::Point const light{10.0F * unit(), 10.0F + unit(), 10.0F * unit()};
        float const s = random.uniform(0.0F, 1.0F);
        float const behind = random.uniform(1.0F, 2.0F);
        oracle::Point sample;
        for (std::size_t k = 0; k < 3; ++k)
            sample[k] = light[k] + ((a[k] + (b[k] - a[k]) * s) - light[k]) * behind;
        auto const lamp = Target::point(to_vec(light));
        auto const left = side(predicates::make_edge_plane(to_vec(a), to_vec(b), lamp), to_vec(sample));
        auto const right = side(predicates::make_edge_plane(to_vec(b), to_vec(a), lamp), to_vec(sample));
        outside_both += left == Sign::negative && right == Sign::negative ? 1 : 0;
        if (!contracted::is_available()) continue;
        outside_both += contracted::edge_plane_side(sample, light, false, a, b) < 0 &&
                                contracted::edge_plane_side(sample, light, false, b, a) < 0
                            ? 1
                            : 0;
    }
    CHECK(outside_both == 0);
}
