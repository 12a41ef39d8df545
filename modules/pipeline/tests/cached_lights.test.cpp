// Maps of local lights from frame to frame: those that are kept are those that are drawn anew.

#include "cached_light_runs.hpp"

#include <gnomon/raster/cpu_backend.hpp>

#include <cstdint>
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
            CourseEnd const seen = run(course, 500);
            CHECK(seen.wrong == 0);
            CHECK(seen.quiet_draws == 0);
        }
}
