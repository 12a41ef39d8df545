// Maps of local lights from frame to frame: those that are kept are those that are drawn anew.

#include "cached_light_runs.hpp"

#include <gnomon/raster/cpu_backend.hpp>

#include <cstdint>
#include <cstdio>
#include <map>
#include <string>

namespace {

using namespace gnomon;
using test::Course;
using test::LooseCubes;
using test::MapRunner;
using test::count_in;

pipeline::Light bulb_among_cubes() { return pipeline::bulb(math::dvec3(0.1, 10.3, -0.1), 25.0F); }
pipeline::Light spot_among_cubes() {
    pipeline::Light light = bulb_among_cubes();
    light.kind = pipeline::LightKind::spot;
    light.direction = math::dvec3(0.3, -0.8, -0.4);
    light.outer_cone_rad = 0.7F;
    return light;
}

struct Seen {
    std::uint64_t frames = 0, wrong = 0, quiet_draws = 0, plain = 0, kept = 0;
    std::map<std::string, std::uint64_t> reasons;
};

/// Runs both techniques along a course and compares all that they give.
Seen run(Course& course, std::size_t frames, bool forgets_to_clear = false) {
    core::SerialExecutor executor;
    raster::CpuBackend cpu(executor);
    MapRunner plain(cpu, "shadow-map"), cached(cpu, "shadow-map-cached");
    Seen seen;
    std::size_t still = 0;
    for (std::size_t i = 0; i < frames; ++i) {
        if (i > 0) course.step();
        pipeline::Frame const frame = course.cubes.frame(course.light);
        auto const anew = plain(frame, course.settings);
        auto with_rest = course.settings;
        with_rest.push_back({"rest", "3"});
        cached.device.forgets_to_clear = forgets_to_clear && i > 0;
        auto const kept = cached(frame, with_rest);
        bool const same = cached.device.texels == plain.device.texels && kept.visibility == anew.visibility && kept.bias_m == anew.bias_m;
        seen.wrong += same ? 0U : 1U;
        ++seen.frames;
        still = course.quiet && i > 0 ? still + 1 : 0;
        if (still > 3) seen.quiet_draws += count_in(kept.counts, "triangles_drawn") + count_in(kept.counts, "texels_rewritten");
        seen.plain += count_in(anew.counts, "triangles_drawn");
        seen.kept += count_in(kept.counts, "triangles_drawn");
        for (pipeline::Count const& reason : kept.redraw_reasons) seen.reasons[std::string(reason.name)] += reason.value;
    }
    std::printf("%llu frames, %llu wrong; triangles %llu of %llu;", static_cast<unsigned long long>(seen.frames), static_cast<unsigned long long>(seen.wrong),
                static_cast<unsigned long long>(seen.kept), static_cast<unsigned long long>(seen.plain));
    for (auto const& [name, count] : seen.reasons) std::printf(" %s %llu", name.c_str(), static_cast<unsigned long long>(count));
    std::printf("\n");
    return seen;
}

std::vector<pipeline::Setting> small_maps() { return {{"resolution", "96"}}; }

}  // namespace

TEST_CASE("a local light's maps that are kept are those drawn anew, whatever moves, hides and changes", "[pipeline][cached]") {
    std::map<std::string, std::uint64_t> reasons;
    for (pipeline::Light const& light : {bulb_among_cubes(), spot_among_cubes()}) {
        LooseCubes cubes(9);
        Course course(cubes, light, small_maps());
        Seen const seen = run(course, 250);
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
        Seen const seen = run(course, 60);
        CHECK(seen.wrong == 0);
        CHECK(seen.kept * 4 < seen.plain);
    }
}

TEST_CASE("a map that is not drawn anew when it must be is found out", "[pipeline][cached]") {
    LooseCubes cubes(9);
    Course course(cubes, bulb_among_cubes(), small_maps());
    CHECK(run(course, 30, true).wrong > 0);
}

TEST_CASE("maps that are kept are those drawn anew, in thousands of frames", "[pipeline][cached][.full]") {
    for (unsigned seed = 2; seed < 6; ++seed)
        for (pipeline::Light const& light : {bulb_among_cubes(), spot_among_cubes(), pipeline::sun(math::dvec3(-0.4, -1.0, -0.3))}) {
            LooseCubes cubes(seed * 2);
            Course course(cubes, light, small_maps());
            course.random.seed(seed);
            course.changes_light = light.kind != pipeline::LightKind::directional;
            Seen const seen = run(course, 500);
            CHECK(seen.wrong == 0);
            CHECK(seen.quiet_draws == 0);
        }
}
