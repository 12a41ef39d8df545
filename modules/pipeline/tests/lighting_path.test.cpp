// Lighting computations along the atrium's path: clusters against the least, frame by frame.

#include <gnomon/check/check.hpp>
#include <gnomon/core/executor_threads.hpp>
#include <gnomon/pipeline/lighting.hpp>
#include <gnomon/scene.hpp>

#include "../src/lighting/lighting.hpp"

#include <cstdint>
#include <cstdio>
#include <string>
#include <vector>

using namespace gnomon;

namespace {

/// The atrium with its trees in, and 10,000 lamps.
struct LampPath {
    scene::Scene scene;
    scene::Geometry geometry;
    scene::CameraPath path;
    core::ThreadExecutor threads{2};
    pipeline::Workspace workspace;

    LampPath() {
        scene::ProceduralConfig const config{.name = "atrium", .lights = "10000", .trees = true};
        scene = scene::make_procedural(config).value();
        geometry = scene::flatten(scene);
        path = scene::make_path(config, "fly").value();
    }
    [[nodiscard]] pipeline::Frame frame(std::size_t i, math::ivec2 const& size_px) {
        math::View const view = scene::make_view(path.frames[i], size_px).value();
        return pipeline::make_frame(scene, geometry, {view, pipeline::sun({0.3, -1.0, 0.2}), false, nullptr}, threads).value();
    }
    [[nodiscard]] pipeline::Params params(std::string const& technique, std::vector<pipeline::Setting> const& settings) {
        return pipeline::make_params(*pipeline::find_lighting_technique(technique).value(), settings).value();
    }
    [[nodiscard]] pipeline::ComputationCounts count(pipeline::Frame const& frame, std::vector<pipeline::Setting> const& settings) {
        auto const settled = params("clustered-deferred", settings);
        auto counts = pipeline::count_computations({frame, scene.lights, settled, workspace, workspace.own_backend(threads), threads});
        REQUIRE(counts.has_value());
        return counts.value();
    }
    [[nodiscard]] std::uint64_t shaded(pipeline::Frame const& frame, std::string const& name, std::vector<pipeline::Setting> const& settings) {
        auto const settled = params(name, settings);
        auto const* const technique = pipeline::find_lighting_technique(name).value();
        auto const output = technique->run({frame, scene.lights, settled, workspace, workspace.own_backend(threads), threads});
        REQUIRE(output.has_value());
        return output.value().counts.front().value;
    }
};

[[nodiscard]] double ratio(std::uint64_t a, std::uint64_t b) { return static_cast<double>(a) / static_cast<double>(b); }

}  // namespace

TEST_CASE("lighting computations are counted without shading as the techniques count them", "[pipeline][lighting]") {
    LampPath lamps;
    for (std::size_t const i : {0U, 140U, 299U}) {
        pipeline::Frame const frame = lamps.frame(i, {192, 108});
        std::vector<pipeline::Setting> const tiles{{"tile", "8"}};
        pipeline::ComputationCounts const counts = lamps.count(frame, tiles);
        CHECK(counts.stencil == lamps.shaded(frame, "deferred-stencil", {}));
        CHECK(counts.tiled == lamps.shaded(frame, "tiled-deferred", tiles));
        CHECK(counts.clustered == lamps.shaded(frame, "clustered-deferred", tiles));
        CHECK(counts.stencil > 0);
        CHECK(counts.clustered < counts.tiled);
    }
}

TEST_CASE("along the atrium's path clusters need little more than the least lighting computations, in a small image", "[pipeline][lighting]") {
    LampPath lamps;
    double worst = 0.0;
    for (std::size_t i = 0; i < lamps.path.frames.size(); i += 60) {
        pipeline::ComputationCounts const counts = lamps.count(lamps.frame(i, {240, 135}), {{"tile", "4"}});
        worst = std::max(worst, ratio(counts.clustered, counts.stencil));
    }
    CHECK(worst < 1.6);
    CHECK(worst > 1.0);
}

TEST_CASE("in every frame of the atrium's path clusters need at most 1.6 times the least lighting computations", "[pipeline][lighting][.full]") {
    LampPath lamps;
    double worst = 0.0, worst_tiled = 0.0;
    std::printf("| frame | `deferred-stencil` | `tiled-deferred` | `clustered-deferred` | tiled / least | clustered / least |\n");
    for (std::size_t i = 0; i < lamps.path.frames.size(); ++i) {
        pipeline::ComputationCounts const c = lamps.count(lamps.frame(i, {1920, 1080}), {});
        double const tiled = ratio(c.tiled, c.stencil), clustered = ratio(c.clustered, c.stencil);
        std::printf("| %zu | %llu | %llu | %llu | %.2f | %.3f |\n", i, static_cast<unsigned long long>(c.stencil),
                    static_cast<unsigned long long>(c.tiled), static_cast<unsigned long long>(c.clustered), tiled, clustered);
        std::fflush(stdout);
        CHECK(c.clustered * 10 <= c.stencil * 16);
        worst = std::max(worst, clustered);
        worst_tiled = std::max(worst_tiled, tiled);
    }
    std::printf("worst: clustered %.3f, tiled %.2f times the least\n", worst, worst_tiled);
}
