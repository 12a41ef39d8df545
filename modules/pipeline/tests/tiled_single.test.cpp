// Lights found by the kernel that shades: what it evaluates is what its own test says, light for light.

#include <gnomon/check/check.hpp>
#include <gnomon/cull/tile_planes.hpp>
#include <gnomon/lights/bounding_ball.hpp>
#include <gnomon/pipeline/lighting.hpp>
#include <gnomon/scene.hpp>

#include "../src/lighting/lighting.hpp"

#include <cstdint>
#include <limits>
#include <string>
#include <vector>

using namespace gnomon;

namespace {

/// A frame of the atrium and its lamps, a third of them spots, and one without an end.
struct LampRoom {
    scene::Scene scene;
    scene::Geometry geometry;
    pipeline::Frame frame;
    pipeline::Workspace workspace;

    LampRoom(char const* lights, math::ivec2 const& size_px, bool orthographic) {
        scene = scene::make_procedural({.name = "atrium", .lights = lights}).value();
        for (std::size_t i = 2; i < scene.lights.size(); i += 3) {
            scene.lights[i].kind = scene::LightKind::spot;
            scene.lights[i].direction = math::dvec3(0.3, -1.0, 0.1 * static_cast<double>(i % 20) - 1.0);
            scene.lights[i].outer_cone_rad = 0.1F + 0.003F * static_cast<float>(i % 500);
        }
        scene.lights[0].range_m = std::numeric_limits<float>::infinity();
        geometry = scene::flatten(scene);
        math::View view = scene::make_view(scene.cameras.front(), size_px).value();
        if (orthographic)
            view = math::make_orthographic({.eye_m = view.eye_m, .target_m = view.eye_m - view.back,
                                            .window_m = {.left = -8.0, .right = 8.0, .bottom = -4.5, .top = 4.5}, .near_m = 0.1,
                                            .far_m = 200.0, .size_px = size_px})
                       .value();
        core::SerialExecutor serial;
        frame = pipeline::make_frame(scene, geometry, {view, pipeline::sun({0.3, -1.0, 0.2}), false, nullptr, pipeline::SampleRule::formula}, serial).value();
    }
    [[nodiscard]] pipeline::LightingOutput run(std::string const& name, std::vector<pipeline::Setting> const& settings) {
        auto const* const technique = pipeline::find_lighting_technique(name).value();
        auto const params = pipeline::make_params(*technique, settings).value();
        core::SerialExecutor serial;
        auto output = technique->run({frame, scene.lights, params, workspace, workspace.own_backend(serial), serial});
        INFO((output ? std::string() : output.failure().message));
        REQUIRE(output.has_value());
        return std::move(output).value();
    }
    [[nodiscard]] cluster::Grid tiles(std::string const& tile) {
        auto const params = pipeline::make_params(*pipeline::find_lighting_technique("tiled-deferred").value(), std::vector<pipeline::Setting>{{"tile", tile}}).value();
        core::SerialExecutor serial;
        return pipeline::make_tile_grid({frame, scene.lights, params, workspace, workspace.own_backend(serial), serial}).value();
    }
    [[nodiscard]] std::uint32_t tile_of(std::size_t sample, std::uint32_t tile_px, cluster::GridView const& grid) const {
        auto const width = static_cast<std::uint32_t>(frame.view.size_px.x);
        std::uint32_t const pixel = frame.samples.pixel[sample];
        return pixel / width / tile_px * grid.columns() + pixel % width / tile_px;
    }
    [[nodiscard]] std::vector<cull::DepthRange> depths(std::uint32_t tile_px, cluster::GridView const& grid) const {
        std::vector<cull::DepthRange> ranges(grid.clusters());
        pipeline::SampleDepth const depth_of(frame);
        for (std::size_t i = 0; i < frame.samples.size(); ++i) ranges[tile_of(i, tile_px, grid)].add(depth_of(frame.samples.position[i]));
        return ranges;
    }
};

std::uint64_t count_in(pipeline::LightingOutput const& output, std::string_view name) {
    for (pipeline::Count const& c : output.counts)
        if (c.name == name) return c.value;
    FAIL("no such count");
    return 0;
}

}  // namespace

TEST_CASE("a tile's kernel evaluates the lights that reach its six planes, no more and no fewer", "[pipeline][lighting]") {
    for (bool const orthographic : {false, true}) {
        LampRoom room("300", {150, 85}, orthographic);
        REQUIRE(room.frame.samples.size() > 5000);
        auto const output = room.run("tiled-deferred-single", {{"tile", "16"}});
        cluster::Grid const grid = room.tiles("16");
        auto const depths = room.depths(16, grid.view());
        pipeline::PreparedLights prepared;
        pipeline::prepare_lights(room.frame, room.scene.lights, prepared);
        std::vector<std::uint32_t> expected(depths.size(), 0);
        std::uint64_t pairs = 0;
        for (std::uint32_t tile = 0; tile < depths.size(); ++tile) {
            if (!(depths[tile].near_m <= depths[tile].far_m)) continue;
            auto const planes = cull::make_tile_planes(grid.view(), tile % grid.view().columns(), tile / grid.view().columns(), depths[tile]);
            for (lights::Light const& light : prepared.culled) expected[tile] += cull::may_touch(planes, lights::bounding_ball(light)) ? 1U : 0U;
            pairs += expected[tile];
        }
        std::size_t otherwise = 0;
        for (std::size_t i = 0; i < output.computations.size(); ++i)
            otherwise += output.computations[i] != expected[room.tile_of(i, 16, grid.view())] ? 1U : 0U;
        CHECK(otherwise == 0);
        CHECK(count_in(output, "light_pairs") == pairs);
        auto const rows = room.run("tiled-deferred", {{"tile", "16"}});
        CHECK((output.radiance == rows.radiance));
        CHECK(count_in(output, "lighting_computations") < 2 * count_in(rows, "lighting_computations"));
    }
}

TEST_CASE("a tile may have more lights than its kernel lists at once", "[pipeline][lighting]") {
    LampRoom room("2500", {40, 22}, false);
    auto const output = room.run("tiled-deferred-single", {{"tile", "40"}});
    CHECK(output.computations.front() > pipeline::tile_list_size);
    CHECK((output.radiance == room.run("deferred-stencil", {}).radiance));
}

TEST_CASE("lights that are none are left out of a tile's lists, and counted", "[pipeline][lighting]") {
    LampRoom room("60", {96, 54}, false);
    auto const before = room.run("tiled-deferred-single", {});
    scene::Light bad = room.scene.lights[1];
    bad.position_m.y = std::numeric_limits<double>::quiet_NaN();
    room.scene.lights.push_back(bad);
    auto const after = room.run("tiled-deferred-single", {});
    CHECK((before.radiance == after.radiance));
    CHECK((before.computations == after.computations));
    CHECK(count_in(before, "lights_left_out") == 0);
    CHECK(count_in(after, "lights_left_out") == 1);
    CHECK(count_in(after, "lights_left_out") == count_in(room.run("tiled-deferred", {}), "lights_left_out"));
}
