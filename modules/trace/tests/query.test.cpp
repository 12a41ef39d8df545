#include <gnomon/check/check.hpp>

#include <gnomon/trace/build.hpp>
#include <gnomon/trace/query.hpp>
#include <gnomon/trace/validate.hpp>

#include "scenes.hpp"

#include <limits>
#include <optional>

using namespace gnomon;
using scenes::Light;
using scenes::Mesh;
using scenes::Random;
using scenes::Segment;
using scenes::TriangleId;
using trace::is_blocked;

namespace {

struct Tally {
    int segments = 0;
    int differences = 0;
    int blocked = 0;
    int asymmetric = 0;
    trace::Counts counts;
};

/// Random and aimed segments against 113-bit brute force, and against themselves reversed.
Tally compare_on_grids(int scene_count, int segments, std::uint64_t seed) {
    Random random{seed};
    Tally tally;
    for (int scene = 0; scene < scene_count; ++scene) {
        Mesh const mesh = scenes::soup(random, 20 + static_cast<std::size_t>(random.below(300)));
        trace::Bvh const bvh = trace::build_bvh(mesh.list());
        scenes::QuadOracle const truth(mesh);
        for (int i = 0; i < segments; ++i) {
            Segment const s = scenes::grid_segment(random, mesh);
            TriangleId const own = random.below(4) == 0 ? TriangleId(static_cast<std::uint32_t>(random.below(20)))
                                                        : TriangleId::none();
            bool const got = is_blocked(bvh, s, own, tally.counts);
            ++tally.segments;
            tally.differences += got != truth.is_blocked(s, own) ? 1 : 0;
            tally.blocked += got ? 1 : 0;
            if (!s.end.at_infinity)
                tally.asymmetric += got != is_blocked(bvh, {s.end.xyz, Light::point(s.start)}, own) ? 1 : 0;
        }
    }
    return tally;
}

int compare_on_hard_floats(int scene_count, int segments, std::uint64_t seed) {
    Random random{seed};
    int differences = 0;
    for (int scene = 0; scene < scene_count; ++scene) {
        Mesh mesh;
        int const kind = random.below(9);
        auto const point = [&] {
            oracle::Point const p = hard::point(random, kind < 8 ? kind : random.below(8));
            return math::vec3(p[0], p[1], p[2]);
        };
        for (int i = 0; i < 12; ++i) mesh.add(point(), point(), point());
        trace::Bvh const bvh = trace::build_bvh(mesh.list());
        REQUIRE(validate(bvh) == trace::BvhFault::none);
        for (int i = 0; i < segments; ++i) {
            bool const sun = random.below(2) == 0;
            Segment const s{point(), sun ? Light::direction(point()) : Light::point(point())};
            if (!is_valid(s)) continue;
            differences += is_blocked(bvh, s) != scenes::blocked_by_any(mesh, s, TriangleId::none()) ? 1 : 0;
        }
    }
    return differences;
}

/// A fan of six triangles round a hub, seen from the light; the line from light to sample passes the hub, but for
/// the rounding of the sample.
int count_fan_leaks(int fans, std::uint64_t seed) {
    Random random{seed};
    int leaks = 0;
    for (int i = 0; i < fans; ++i) {
        auto const unit = [&] { return random.uniform(-1.0F, 1.0F); };
        math::vec3 const hub{unit(), unit(), unit()};
        math::vec3 const light{hub.x + 4.0F * unit(), hub.y + 10.0F + unit(), hub.z + 4.0F * unit()};
        Mesh mesh;
        math::vec3 rim[6];
        for (int k = 0; k < 6; ++k) {
            float const angle = (static_cast<float>(k) + 0.3F * unit()) * 1.0471976F;
            rim[k] = hub + math::vec3(std::cos(angle), 0.2F * unit(), std::sin(angle));
        }
        for (int k = 0; k < 6; ++k) mesh.add(hub, rim[(k + 1) % 6], rim[k]);
        float const behind = random.uniform(1.1F, 2.0F);
        Segment const s{light + (hub - light) * behind, Light::point(light)};
        leaks += is_blocked(trace::build_bvh(mesh.list()), s) ? 0 : 1;
    }
    return leaks;
}

}  // namespace

TEST_CASE("is_blocked equals brute force in 113 bits on random and aimed segments, and is symmetric", "[trace][property]") {
    Tally const tally = compare_on_grids(20, 1'000, 11);
    CHECK(tally.segments == 20'000);
    CHECK(tally.differences == 0);
    CHECK(tally.asymmetric == 0);
    CHECK(tally.blocked > 4'000);
    CHECK(tally.counts.exact > 4'000);  // the exact fallback was really asked
}

TEST_CASE("is_blocked equals brute force on 300,000 segments", "[.long][trace][property]") {
    Tally const tally = compare_on_grids(150, 2'000, 12);
    CHECK(tally.segments == 300'000);
    CHECK(tally.differences == 0);
    CHECK(tally.asymmetric == 0);
}

TEST_CASE("is_blocked is exact for denormals, the largest floats and every exponent", "[trace][property]") {
    CHECK(compare_on_hard_floats(200, 20, 13) == 0);
}

TEST_CASE("is_blocked is exact for every exponent, at length", "[.long][trace][property]") {
    CHECK(compare_on_hard_floats(5'000, 20, 14) == 0);
}

TEST_CASE("no line through the hub of a fan slips through", "[trace][leak]") { CHECK(count_fan_leaks(20'000, 15) == 0); }

TEST_CASE("no line through the hubs of a million fans slips through", "[.long][trace][leak]") {
    CHECK(count_fan_leaks(1'000'000, 16) == 0);
}

TEST_CASE("a scene scaled by a power of two from 1e-4 to 1e4 gives the same answers", "[trace][property]") {
    Random random{17};
    Mesh const mesh = scenes::soup(random, 200);
    std::vector<Segment> segments;
    for (int i = 0; i < 2'000; ++i) segments.push_back(scenes::grid_segment(random, mesh));
    trace::Bvh const unscaled = trace::build_bvh(mesh.list());
    for (int exponent = -14; exponent <= 14; exponent += 7) {
        float const scale = std::ldexp(1.0F, exponent);
        Mesh scaled = mesh;
        for (math::vec3& p : scaled.positions) p *= scale;
        trace::Bvh const bvh = trace::build_bvh(scaled.list());
        int differences = 0;
        for (Segment const& s : segments) {
            Segment const t{s.start * scale, {s.end.xyz * scale, s.end.at_infinity}};
            differences += is_blocked(bvh, t) != is_blocked(unscaled, s) ? 1 : 0;
        }
        CHECK(differences == 0);
    }
}

TEST_CASE("millimetre scenes in metres lose nothing: generic data scaled by 1e-4 to 1e4 gives the same mask", "[trace]") {
    Random random{18};
    scenes::Yard const yard(1, 4);
    std::vector<Segment> segments;
    for (int i = 0; i < 5'000; ++i)
        segments.push_back({math::vec3{random.uniform(-40.0F, 40.0F), random.uniform(0.1F, 30.0F), random.uniform(-40.0F, 40.0F)},
                            Light::point(math::vec3(12.3F, 90.7F, -30.1F))});
    trace::Bvh const unscaled = trace::build_bvh(yard.mesh.list());
    for (float const scale : {1e-4F, 1e-2F, 1e2F, 1e4F}) {
        Mesh scaled = yard.mesh;
        for (math::vec3& p : scaled.positions) p *= scale;
        trace::Bvh const bvh = trace::build_bvh(scaled.list());
        int differences = 0;
        for (Segment const& s : segments)
            differences += is_blocked(bvh, {s.start * scale, Light::point(s.end.xyz * scale)}) != is_blocked(unscaled, s) ? 1 : 0;
        CHECK(differences == 0);
    }
}

TEST_CASE("a point in a triangle's plane is not blocked by it, and nothing blocks itself", "[trace]") {
    Mesh mesh;
    mesh.add(math::vec3(0.0F, 0.0F, 0.0F), math::vec3(4.0F, 0.0F, 0.0F), math::vec3(0.0F, 0.0F, 4.0F));
    trace::Bvh const bvh = trace::build_bvh(mesh.list());
    auto const up = Light::direction(math::vec3(0.0F, 1.0F, 0.0F));
    CHECK_FALSE(is_blocked(bvh, {math::vec3(1.0F, 0.0F, 1.0F), up}));
    CHECK(is_blocked(bvh, {math::vec3(1.0F, -1e-45F, 1.0F), up}));
    CHECK_FALSE(is_blocked(bvh, {math::vec3(1.0F, -1.0F, 1.0F), Light::point(math::vec3(1.0F, 0.0F, 1.0F))}));
    CHECK(is_blocked(bvh, {math::vec3(1.0F, -1.0F, 1.0F), Light::point(math::vec3(1.0F, 1e-45F, 1.0F))}));
    CHECK_FALSE(is_blocked(bvh, {math::vec3(1.0F, -1.0F, 1.0F), up}, TriangleId(0)));
    CHECK_FALSE(is_blocked(bvh, {math::vec3(-1.0F, 0.0F, 1.0F), Light::point(math::vec3(3.0F, 0.0F, 1.0F))}));
}

TEST_CASE("NaN, infinite and zero segments are never blocked", "[trace]") {
    Mesh mesh;
    mesh.add(math::vec3(-4.0F, 1.0F, -4.0F), math::vec3(4.0F, 1.0F, -4.0F), math::vec3(0.0F, 1.0F, 4.0F));
    trace::Bvh const bvh = trace::build_bvh(mesh.list());
    math::vec3 const origin(0.0F);
    REQUIRE(is_blocked(bvh, {origin, Light::direction(math::vec3(0.0F, 1.0F, 0.0F))}));
    for (float const bad : {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity()})
        for (int axis = 0; axis < 3; ++axis) {
            math::vec3 p(0.1F, 0.2F, 0.3F);
            p[axis] = bad;
            CHECK_FALSE(is_blocked(bvh, {p, Light::direction(math::vec3(0.0F, 1.0F, 0.0F))}));
            CHECK_FALSE(is_blocked(bvh, {origin, Light::direction(p)}));
            CHECK_FALSE(is_blocked(bvh, {origin, Light::point(p)}));
            CHECK_FALSE(trace::nearest_blocker(bvh, {origin, Light::point(p)}).has_value());
        }
    CHECK_FALSE(is_blocked(bvh, {origin, Light::direction(math::vec3(0.0F, -0.0F, 0.0F))}));
    CHECK_FALSE(is_blocked(bvh, {origin, Light::point(origin)}));
}

TEST_CASE("the nearest blocker is the one of smallest t, then smallest id, whatever the hierarchy", "[trace][property]") {
    Random random{19};
    int differences = 0;
    for (int scene = 0; scene < 10; ++scene) {
        Mesh mesh = scenes::soup(random, 150);
        for (std::size_t i = 0; i < 20; ++i) mesh.corners.push_back(mesh.corners[i]);  // ties
        trace::Bvh const bvh = trace::build_bvh(mesh.list());
        for (int i = 0; i < 300; ++i) {
            Segment const s = scenes::grid_segment(random, mesh);
            if (!is_valid(s)) continue;
            trace::detail::Slabs const slabs = trace::detail::make_slabs(s);
            std::optional<trace::Crossing> best;
            for (std::uint32_t k = 0; k < mesh.corners.size(); ++k) {
                auto const t = mesh.list()[TriangleId(k)];
                if (!blocks(t, s)) continue;
                auto crossing = crossing_of(TriangleId(k), t, s);
                crossing.t = trace::detail::clamp_to_box(crossing.t, slabs, t);
                if (!best || crossing.t < best->t) best = crossing;
            }
            auto const got = nearest_blocker(bvh, s);
            bool const same = got.has_value() == best.has_value() &&
                              (!got || (got->triangle == best->triangle && got->t == best->t));
            differences += same ? 0 : 1;
        }
    }
    CHECK(differences == 0);
}

TEST_CASE("the nearest blocker's t and weights say where the segment passes it", "[trace]") {
    Mesh mesh;
    mesh.add(math::vec3(0.0F, 2.0F, 0.0F), math::vec3(4.0F, 2.0F, 0.0F), math::vec3(0.0F, 2.0F, 4.0F));
    mesh.add(math::vec3(0.0F, 3.0F, 0.0F), math::vec3(4.0F, 3.0F, 0.0F), math::vec3(0.0F, 3.0F, 4.0F));
    trace::Bvh const bvh = trace::build_bvh(mesh.list());
    auto const hit = nearest_blocker(bvh, {math::vec3(1.0F, 0.0F, 2.0F), Light::point(math::vec3(1.0F, 8.0F, 2.0F))});
    REQUIRE(hit.has_value());
    CHECK(hit->triangle == TriangleId(0));
    CHECK(hit->t == 0.25);
    CHECK(hit->weights == math::dvec3(0.25, 0.25, 0.5));
    auto const sun = nearest_blocker(bvh, {math::vec3(1.0F, 0.0F, 2.0F), Light::direction(math::vec3(0.0F, 0.5F, 0.0F))},
                                     TriangleId(0));
    REQUIRE(sun.has_value());
    CHECK(sun->triangle == TriangleId(1));
    CHECK(sun->t == 6.0);
}

TEST_CASE("an opacity lets the segment pass where it says so", "[trace]") {
    Mesh mesh;
    mesh.add(math::vec3(0.0F, 2.0F, 0.0F), math::vec3(4.0F, 2.0F, 0.0F), math::vec3(0.0F, 2.0F, 4.0F));
    mesh.add(math::vec3(0.0F, 3.0F, 0.0F), math::vec3(4.0F, 3.0F, 0.0F), math::vec3(0.0F, 3.0F, 4.0F));
    trace::Bvh const bvh = trace::build_bvh(mesh.list());
    auto const first_has_hole = [](trace::Crossing const& c) { return c.triangle != TriangleId(0) || c.weights.x < 0.5; };
    auto const up = Light::direction(math::vec3(0.0F, 1.0F, 0.0F));
    Segment const through_hole{math::vec3(0.5F, 0.0F, 0.5F), up};
    CHECK(nearest_blocker(bvh, through_hole, {}, first_has_hole)->triangle == TriangleId(1));
    CHECK(is_blocked(bvh, through_hole, TriangleId::none(), first_has_hole));
    CHECK_FALSE(is_blocked(bvh, through_hole, TriangleId(1), first_has_hole));
    CHECK(is_blocked(bvh, {math::vec3(1.5F, 0.0F, 1.5F), up}, TriangleId(1), first_has_hole));
}
