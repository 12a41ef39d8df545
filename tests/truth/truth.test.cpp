// The truth of whole frames against Embree in ROBUST mode, on the same floats. Every sample where they differ is listed
// and decided by big-integer brute force, which must side with the truth.

#include "embree_peer.hpp"
#include "exact_oracle_lit.hpp"

#include <gnomon/check/check.hpp>
#include <gnomon/core/executor_tbb.hpp>
#include <gnomon/pipeline/frame.hpp>
#include <gnomon/scene.hpp>

#include <cstdio>
#include <cstdlib>
#include <string>

namespace {

using namespace gnomon;

pipeline::Light light_of(scene::Scene const& scene) {
    if (scene.lights.empty()) return pipeline::sun({-0.45, -0.8, -0.4});
    scene::Light const& first = scene.lights.front();
    return first.kind == scene::LightKind::directional ? pipeline::sun(first.direction) : pipeline::bulb(first.position_m);
}

struct Agreement {
    std::size_t samples = 0;
    std::size_t in_shadow = 0;
    std::size_t differ = 0;
    std::size_t ties = 0;         ///< Of those that differ: the sample lies exactly in the plane of Embree's blocker.
    std::size_t truth_wrong = 0;  ///< Of those that differ: big integers side with Embree.
};

/// Prints one sample where the two differ, and adds it up.
void decide(pipeline::Frame const& frame, std::size_t i, std::uint32_t blocker, Agreement& result) {
    bool const lit = truth::oracle_lit(frame, i);
    bool tie = false;
    if (blocker != truth::no_blocker) {
        auto const t = truth::corners_of(*frame.geometry, blocker);
        tie = oracle::orient3d(t[0], t[1], t[2], truth::as_point(frame.samples.position[i])) == 0;
    }
    ++result.differ;
    if (tie) ++result.ties;
    if (lit != (frame.lit[i] != 0)) ++result.truth_wrong;
    math::vec3 const& p = frame.samples.position[i];
    std::printf("  sample %zu of triangle %u at (%.9g, %.9g, %.9g): truth %s, Embree %s%s, exact %s\n", i,
                frame.samples.triangle[i], static_cast<double>(p.x), static_cast<double>(p.y), static_cast<double>(p.z),
                frame.lit[i] != 0 ? "lit" : "dark", blocker == truth::no_blocker ? "lit" : "dark",
                tie ? " by a triangle whose plane holds the sample" : "", lit ? "lit" : "dark");
}

Agreement compare_with_embree(pipeline::Frame const& frame, char const* name) {
    std::vector<std::uint32_t> const blockers = truth::embree_blockers(frame);
    Agreement result;
    result.samples = frame.samples.size();
    for (std::size_t i = 0; i < result.samples; ++i) {
        if (frame.lit[i] == 0) ++result.in_shadow;
        bool const embree_lit = blockers[i] == truth::no_blocker;
        if ((frame.lit[i] != 0) == embree_lit || frame.reached[i] == 0 || truth::oracle_faces_away(frame, i)) continue;
        decide(frame, i, blockers[i], result);
    }
    std::printf("%s: %zu samples, %zu in shadow, %zu differ from Embree, %zu of them ties, %zu decided against the truth\n",
                name, result.samples, result.in_shadow, result.differ, result.ties, result.truth_wrong);
    return result;
}

void check_scene(scene::Scene const& scene, int size_px, char const* name) {
    scene::Geometry const geometry = scene::flatten(scene);
    core::TbbExecutor executor(0);
    REQUIRE_FALSE(scene.cameras.empty());
    auto const frame =
        pipeline::make_frame(scene, geometry, scene::make_view(scene.cameras.front(), {size_px, size_px}).value(),
                                            light_of(scene), executor);
    REQUIRE(frame);
    Agreement const agreement = compare_with_embree(*frame, name);
    CHECK(agreement.samples > static_cast<std::size_t>(size_px) * static_cast<std::size_t>(size_px) / 4);
    CHECK(agreement.in_shadow > agreement.samples / 50);
    CHECK(agreement.truth_wrong == 0);
    // Many differences would mean that the two were not given the same floats.
    CHECK(agreement.differ <= agreement.samples / 1000);
}

scene::Scene built_in(char const* name) {
    scene::ProceduralConfig config;
    config.name = name;
    return scene::make_procedural(config).value();
}

}  // namespace

TEST_CASE("the truth of city and rayyard is Embree's but for ties, at 256 x 256", "[truth]") {
    check_scene(built_in("city"), 256, "city");
    check_scene(built_in("rayyard"), 256, "rayyard");
}

TEST_CASE("the truth of city and rayyard is Embree's but for ties, at 1024 x 1024", "[.][full]") {
    check_scene(built_in("city"), 1024, "city");
    check_scene(built_in("rayyard"), 1024, "rayyard");
}

TEST_CASE("the truth of a glTF scene is Embree's but for ties", "[.][full]") {
    // GNOMON_SCENE names an opaque scene, sponza's file for one.
    char const* const path = std::getenv("GNOMON_SCENE");
    if (path == nullptr) SKIP("set GNOMON_SCENE to a glTF file");
    auto loaded = scene::load_gltf(path);
    REQUIRE(loaded);
    scene::Scene scene = std::move(*loaded);
    scene::SuggestedView const view = scene::auto_view(scene);
    scene.cameras.insert(scene.cameras.begin(), scene::looking_at("auto", view.eye_m, view.target_m, view.fov_y_rad));
    check_scene(scene, 1024, path);
}
