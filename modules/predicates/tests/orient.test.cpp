#include <gnomon/check/check.hpp>

#include <gnomon/predicates/orient.hpp>

#include "contracted.hpp"
#include "exact_oracle.hpp"
#include "hard_floats.hpp"

#include <cmath>
#include <cstdlib>
#include <limits>

using namespace gnomon;
using predicates::line_side;
using predicates::orient2d;
using predicates::orient3d;
using predicates::Sign;
using predicates::Target;

namespace {

math::vec3 to_vec(oracle::Point const& p) { return math::vec3(p[0], p[1], p[2]); }

Target to_target(oracle::Point const& p, bool at_infinity) {
    return at_infinity ? Target::direction(to_vec(p)) : Target::point(to_vec(p));
}

/// Counts where the library, its contracted build and the oracle disagree on `count` hard quadruples.
struct Differences {
    int plain = 0;
    int contracted = 0;
    int zeros = 0;
};

Differences compare_with_oracle(int count, std::uint64_t seed) {
    hard::Random random{seed};
    bool const both = contracted::is_available();
    Differences out;
    for (int i = 0; i < count; ++i) {
        auto const p = hard::four_points(random);
        for (bool const at_infinity : {false, true}) {
            int const plane = oracle::orient3d(p[0], p[1], p[2], p[3], at_infinity);
            int const line = oracle::line_side(p[0], p[3], at_infinity, p[1], p[2]);
            auto const end = to_target(p[3], at_infinity);
            out.zeros += plane == 0 ? 1 : 0;
            out.plain += static_cast<int>(orient3d(to_vec(p[0]), to_vec(p[1]), to_vec(p[2]), end)) != plane ? 1 : 0;
            out.plain += static_cast<int>(line_side(to_vec(p[0]), end, to_vec(p[1]), to_vec(p[2]))) != line ? 1 : 0;
            if (!both) continue;
            out.contracted += contracted::orient3d(p[0], p[1], p[2], p[3], at_infinity) != plane ? 1 : 0;
            out.contracted += contracted::line_side(p[0], p[3], at_infinity, p[1], p[2]) != line ? 1 : 0;
        }
    }
    return out;
}

}  // namespace

TEST_CASE("orient3d is positive on the side from which a triangle runs counter-clockwise", "[predicates]") {
    math::vec3 const a(0.0F, 0.0F, 0.0F);
    math::vec3 const b(1.0F, 0.0F, 0.0F);
    math::vec3 const c(0.0F, 1.0F, 0.0F);
    CHECK(orient3d(a, b, c, math::vec3(0.0F, 0.0F, 1.0F)) == Sign::positive);
    CHECK(orient3d(a, b, c, math::vec3(9.0F, 9.0F, -1e-45F)) == Sign::negative);
    CHECK(orient3d(a, b, c, math::vec3(9.0F, -9.0F, -0.0F)) == Sign::zero);
    CHECK(orient3d(a, b, c, Target::direction(math::vec3(0.0F, 0.0F, 1e-45F))) == Sign::positive);
    CHECK(orient3d(a, b, c, Target::direction(math::vec3(1.0F, 0.0F, 0.0F))) == Sign::zero);
    CHECK(orient3d(a, b, c, Target::direction(math::vec3(0.0F))) == Sign::zero);
    CHECK(orient2d(math::vec2(0.0F), math::vec2(1.0F, 0.0F), math::vec2(0.0F, 1.0F)) == Sign::positive);
}

TEST_CASE("a line through a triangle has it on one side of all three edges", "[predicates]") {
    math::vec3 const a(0.0F, 0.0F, 0.0F);
    math::vec3 const b(4.0F, 0.0F, 0.0F);
    math::vec3 const c(0.0F, 4.0F, 0.0F);
    auto const sides_agree = [&](math::vec3 const& from, Target const& to) {
        return none_opposite(line_side(from, to, a, b), line_side(from, to, b, c), line_side(from, to, c, a));
    };
    CHECK(sides_agree(math::vec3(1.0F, 1.0F, 1.0F), Target::point(math::vec3(1.0F, 1.0F, -1.0F))));
    CHECK(sides_agree(math::vec3(1.0F, 1.0F, 1.0F), Target::direction(math::vec3(0.0F, 0.0F, -1.0F))));
    CHECK(sides_agree(math::vec3(2.0F, 2.0F, 1.0F), Target::direction(math::vec3(0.0F, 0.0F, -1.0F))));
    CHECK_FALSE(sides_agree(math::vec3(2.0F, std::nextafter(2.0F, 3.0F), 1.0F),
                            Target::direction(math::vec3(0.0F, 0.0F, -1.0F))));
}

TEST_CASE("NaN and infinity anywhere give zero, not a wrong side", "[predicates]") {
    for (float const bad : {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity(),
                            -std::numeric_limits<float>::infinity()}) {
        for (int which = 0; which < 12; ++which) {
            math::vec3 p[4] = {math::vec3(0.0F), math::vec3(1.0F, 0.0F, 0.0F), math::vec3(0.0F, 1.0F, 0.0F),
                               math::vec3(0.1F, 0.2F, 1.0F)};
            p[which / 3][static_cast<math::axis_t>(which % 3)] = bad;
            CHECK(orient3d(p[0], p[1], p[2], p[3]) == Sign::zero);
            CHECK(line_side(p[0], Target::direction(p[1]), p[2], p[3]) == Sign::zero);
            if (which % 3 < 2 && which < 9)
                CHECK(orient2d(math::vec2(p[0].x, p[0].y), math::vec2(p[1].x, p[1].y), math::vec2(p[2].x, p[2].y)) ==
                      Sign::zero);
        }
    }
}

TEST_CASE("the second build really fuses products into sums", "[predicates]") {
    if (!contracted::is_available()) SKIP("no FMA build on this machine");
    double const a = 1.0 + 0x1p-30;
    int const fuses = contracted::fuses(a, a, -(1.0 + 0x1p-29));
#if !defined(__OPTIMIZE__)
    if (fuses == 0) SKIP("an unoptimized build fuses nothing");
#endif
    CHECK(fuses == 1);
}

TEST_CASE("orient3d and line_side have the exact sign for points of every magnitude, fused or not",
          "[predicates][property]") {
    auto const differences = compare_with_oracle(60'000, 1);
    CHECK(differences.plain == 0);
    CHECK(differences.contracted == 0);
    CHECK(differences.zeros > 5'000);
}

TEST_CASE("three million hard orientations have the exact sign", "[.long][predicates][property]") {
    auto const differences = compare_with_oracle(1'500'000, 2);
    CHECK(differences.plain == 0);
    CHECK(differences.contracted == 0);
}

TEST_CASE("orient2d has the exact sign for points of every magnitude, fused or not", "[predicates][property]") {
    hard::Random random{3};
    int differences = 0;
    for (int i = 0; i < 60'000; ++i) {
        auto const p = hard::four_points(random);
        int const truth = oracle::orient2d(p[0][0], p[0][1], p[1][0], p[1][1], p[3][0], p[3][1]);
        auto const vec = [](oracle::Point const& q) { return math::vec2(q[0], q[1]); };
        differences += static_cast<int>(orient2d(vec(p[0]), vec(p[1]), vec(p[3]))) != truth ? 1 : 0;
        if (contracted::is_available())
            differences +=
                contracted::orient2d(p[0][0], p[0][1], p[1][0], p[1][1], p[3][0], p[3][1]) != truth ? 1 : 0;
    }
    CHECK(differences == 0);
}

TEST_CASE("the filter's bound holds: no estimate is farther from the exact value than it says", "[predicates][property]") {
    // Integers of 21 bits: differences, products and sums are exact in 64-bit integers, so the error can be measured;
    // added to 2^24 they are still floats, and the rounding of the double products is real.
    hard::Random random{4};
    int certain = 0;
    for (int i = 0; i < 100'000; ++i) {
        std::int64_t m[9];
        for (auto& x : m) x = static_cast<std::int64_t>(random.bits() >> 43U) - (std::int64_t{1} << 20U);
        if (i % 2 == 0)  // nearly singular: the last row is the sum of the others, but for a little
            for (int k = 0; k < 3; ++k) m[6 + k] = m[k] + m[3 + k] + (random.below(3) - 1);
        std::int64_t const exact = m[0] * (m[4] * m[8] - m[5] * m[7]) + m[1] * (m[5] * m[6] - m[3] * m[8]) +
                                   m[2] * (m[3] * m[7] - m[4] * m[6]);
        auto const row = [&](int k) {
            return math::dvec3(static_cast<double>(m[k]), static_cast<double>(m[k + 1]), static_cast<double>(m[k + 2]));
        };
        auto const estimate = predicates::detail::det3_estimate(row(0), row(3), row(6));
        REQUIRE(std::abs(static_cast<long double>(estimate.value) - static_cast<long double>(exact)) <=
                static_cast<long double>(estimate.bound));
        certain += estimate.is_certain() ? 1 : 0;
    }
    CHECK(certain > 60'000);
}
