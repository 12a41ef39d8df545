// Maps of local lights from frame to frame: those that are kept are those that are drawn anew.

#include "cached_light_runs.hpp"

#include <gnomon/raster/cpu_backend.hpp>

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>
#include <map>
#include <string>

namespace {

using namespace gnomon;
using test::Course;
using test::CourseEnd;
using test::LooseCubes;
using test::bulb_among_cubes;
using test::spot_among_cubes;

CourseEnd run(Course& course, std::size_t frames, bool forgets_to_clear = false) {
    core::SerialExecutor executor;
    raster::CpuBackend cpu(executor);
    return test::run(course, cpu, frames, forgets_to_clear);
}

std::vector<pipeline::Setting> small_maps() { return {{"resolution", "96"}}; }

}  // namespace

TEST_CASE("a local light's maps that are kept are those drawn anew, whatever moves, hides and changes", "[pipeline][cached]") {
    std::map<std::string, std::uint64_t> reasons;
    for (pipeline::Light const& light : {bulb_among_cubes(), spot_among_cubes()}) {
        LooseCubes cubes(9);
        Course course(cubes, light, small_maps());
        CourseEnd const seen = run(course, 250);
        CHECK(seen.wrong == 0);
        CHECK(seen.quiet_draws == 0);
        for (auto const& [name, count] : seen.reasons) reasons[name] += count;
    }
    for (char const* const name : {"first_use", "light_posed", "light_range", "light_cone", "projection_changed", "resolution_changed", "settings_changed",
                                   "member_moved", "member_joined"}) {
        CAPTURE(name);
        CHECK(reasons[name] > 0);
    }
}

TEST_CASE("under a light that stays few casters are drawn, and only into the faces that see a change", "[pipeline][cached]") {
    for (char const* const fit : {"tight", "steps"}) {
        LooseCubes cubes(9);
        Course course(cubes, bulb_among_cubes(), {{"resolution", "96"}, {"fit", fit}});
        course.changes_light = false;
        CourseEnd const seen = run(course, 60);
        CHECK(seen.wrong == 0);
        CHECK(seen.kept * 4 < seen.plain);
    }
}

TEST_CASE("a mover that comes nearest to the light, and another way to cull, reach casters that rest", "[pipeline][cached]") {
    LooseCubes cubes(9);
    core::SerialExecutor executor;
    raster::CpuBackend cpu(executor);
    test::MapRunner plain(cpu, "shadow-map"), cached(cpu, "shadow-map-cached");
    pipeline::Light const light = bulb_among_cubes();
    math::dmat4 const& at = cubes.rest.world_from_mesh[cubes.loose[0]];
    math::dvec3 const way = light.position_m - math::dvec3(at[3][0], at[3][1], at[3][2]);
    auto const same = [&](char const* cull) {
        std::vector<pipeline::Setting> const settings{{"resolution", "96"}, {"cull", cull}};
        auto with_rest = settings;
        with_rest.push_back({"rest", "2"});
        pipeline::Frame const frame = cubes.frame(light);
        (void)plain(frame, settings);
        (void)cached(frame, with_rest);
        return cached.device.texels == plain.device.texels;
    };
    for (int i = 0; i < 10; ++i) {
        if (i > 4) cubes.place(0, way + math::dvec3(0.9 - 0.05 * i, 0.0, 0.0), math::dvec3(0.2));  // the depth range goes with it
        CHECK(same("none"));
    }
    for (char const* const cull : {"none", "none", "none", "back", "front", "back", "none"}) CHECK(same(cull));
}

TEST_CASE("a map that is not drawn anew when it must be is found out", "[pipeline][cached]") {
    LooseCubes cubes(9);
    Course course(cubes, bulb_among_cubes(), small_maps());
    CHECK(run(course, 30, true).wrong > 0);
}

TEST_CASE("under a budget maps wait, none too long, and all are right soon after the world comes to rest", "[pipeline][cached]") {
    constexpr std::uint64_t budget = 2500, wait = 6;
    LooseCubes cubes(9);
    Course course(cubes, bulb_among_cubes(), small_maps());
    course.changes_drawing = false;
    core::SerialExecutor executor;
    raster::CpuBackend cpu(executor);
    test::MapRunner plain(cpu, "shadow-map"), cached(cpu, "shadow-map-cached");
    auto settings = small_maps();
    settings.insert(settings.end(), {{"rest", "3"}, {"budget", std::to_string(budget)}, {"wait", std::to_string(wait)}});
    std::array<std::uint64_t, 6> stale{};
    std::uint64_t most_wrong = 0, longest = 0, postponed = 0, over = 0;
    for (std::size_t i = 0; i < 120; ++i) {
        if (i > 0 && i < 100) course.step();
        pipeline::Frame const frame = cubes.frame(course.light);
        (void)plain(frame, small_maps());
        auto const kept = cached(frame, settings);
        std::size_t const each = plain.device.texels.size() / 6;
        std::uint64_t wrong = 0;
        for (std::size_t m = 0; m < 6; ++m) {
            bool const same = std::memcmp(&plain.device.texels[m * each], &cached.device.texels[m * each], each) == 0;
            stale[m] = same ? 0 : stale[m] + 1;
            longest = std::max(longest, stale[m]);
            wrong += same ? 0U : 1U;
        }
        std::uint64_t const waiting = test::count_in(kept.counts, "maps_postponed");
        CHECK(wrong <= waiting);
        most_wrong = std::max(most_wrong, wrong);
        postponed += waiting;
        over += i > 0 && test::count_in(kept.counts, "static_triangles") > budget ? 1U : 0U;
        if (i >= 100 + wait + 6) CHECK(wrong == 0);
    }
    CHECK(most_wrong >= 3);  // it was tight
    CHECK(longest <= wait);
    CHECK(postponed > 100);
    CHECK(over < 60);  // only where maps waited long enough
}

TEST_CASE("a light within its thresholds keeps its maps, and beyond them gets those drawn anew", "[pipeline][cached]") {
    LooseCubes cubes(9);
    core::SerialExecutor executor;
    raster::CpuBackend cpu(executor);
    for (bool const turns : {false, true}) {
        test::MapRunner plain(cpu, "shadow-map"), cached(cpu, "shadow-map-cached");
        auto settings = small_maps();
        settings.push_back({"rest", "0"});
        settings.push_back(turns ? pipeline::Setting{"turn", "2"} : pipeline::Setting{"move", "0.1"});
        pipeline::Light light = spot_among_cubes();
        light.direction = math::dvec3(0.0, -1.0, 0.0);
        auto const draws = [&](double by) {
            if (turns) light.direction.x = by * 0.35;  // 2 degrees are 0.0349
            else light.position_m.x = 0.1 + by;
            pipeline::Frame const frame = cubes.frame(light);
            auto const anew = plain(frame, small_maps()), kept = cached(frame, settings);
            bool const drawn = test::count_in(kept.counts, "triangles_drawn") > 0;
            bool const same_answers = kept.visibility == anew.visibility;
            CHECK((!drawn || same_answers));
            CHECK(drawn == (cached.device.texels == plain.device.texels));
            return drawn;
        };
        CHECK(draws(0.0));
        CHECK_FALSE(draws(0.05));
        CHECK_FALSE(draws(0.09));  // of where it was drawn, not of the last frame
        CHECK(draws(0.14));
        CHECK_FALSE(draws(0.06));
        light.range_m -= 1.0F;
        CHECK(draws(0.06));
    }
}

TEST_CASE("maps that are kept are those drawn anew, in thousands of frames", "[pipeline][cached][.full]") {
    for (unsigned seed = 2; seed < 6; ++seed)
        for (pipeline::Light const& light : {bulb_among_cubes(), spot_among_cubes(), pipeline::sun(math::dvec3(-0.4, -1.0, -0.3))}) {
            LooseCubes cubes(seed * 2);
            Course course(cubes, light, small_maps());
            course.random.seed(seed);
            course.changes_light = light.kind != pipeline::LightKind::directional;
            CourseEnd const seen = run(course, 500);
            CHECK(seen.wrong == 0);
            CHECK(seen.quiet_draws == 0);
        }
}
