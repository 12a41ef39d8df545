// Lights found by the kernel that shades: what it evaluates is what its own test says, light for light.

#include <gnomon/check/check.hpp>
#include <gnomon/cull/tile_planes.hpp>
#include <gnomon/lights/bounding_ball.hpp>
#include <gnomon/lights/brute_force.hpp>
#include <gnomon/lights/hull.hpp>
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

/// Lights of each tile with samples, counted one by one.
struct TileCounts {
    std::vector<std::uint32_t> lights;
    std::uint64_t pairs = 0;

    template <class Touches>
    TileCounts(LampRoom& room, std::uint32_t tile_px, Touches&& touches) {
        cluster::Grid const grid = room.tiles(std::to_string(tile_px));
        cluster::GridView const view = grid.view();
        auto const depths = room.depths(tile_px, view);
        pipeline::PreparedLights prepared;
        pipeline::prepare_lights(room.frame, room.scene.lights, prepared);
        lights.assign(depths.size(), 0);
        for (std::uint32_t tile = 0; tile < depths.size(); ++tile) {
            if (!(depths[tile].near_m <= depths[tile].far_m)) continue;
            for (lights::Light const& light : prepared.culled)
                lights[tile] += touches(view, tile % view.columns(), tile / view.columns(), depths[tile], light) ? 1U : 0U;
            pairs += lights[tile];
        }
    }
};

/// Whether the rows of the tile grid have the light in a tile.
bool rows_touch(cluster::GridView const& grid, std::uint32_t column, std::uint32_t row, lights::Light const& light) {
    return lights::may_touch(cull::make_row_grid(grid), light, column, row, 0);
}

void check_counts(LampRoom& room, std::string const& name, TileCounts const& expected, double most) {
    auto const output = room.run(name, {{"tile", "16"}});
    cluster::Grid const grid = room.tiles("16");
    std::size_t otherwise = 0;
    for (std::size_t i = 0; i < output.computations.size(); ++i)
        otherwise += output.computations[i] != expected.lights[room.tile_of(i, 16, grid.view())] ? 1U : 0U;
    CHECK(otherwise == 0);
    CHECK(count_in(output, "light_pairs") == expected.pairs);
    auto const rows = room.run("tiled-deferred", {{"tile", "16"}});
    CHECK((output.radiance == rows.radiance));
    auto const computations = static_cast<double>(count_in(output, "lighting_computations"));
    CHECK(computations < most * static_cast<double>(count_in(rows, "lighting_computations")));
}

}  // namespace

TEST_CASE("a tile's kernel evaluates the lights that reach its six planes, no more and no fewer", "[pipeline][lighting]") {
    for (bool const orthographic : {false, true}) {
        LampRoom room("300", {150, 85}, orthographic);
        REQUIRE(room.frame.samples.size() > 5000);
        TileCounts const expected(room, 16, [&](cluster::GridView const& grid, std::uint32_t column, std::uint32_t row, cull::DepthRange const& depths,
                                                lights::Light const& light) {
            return cull::may_touch(cull::make_tile_planes(grid, column, row, depths), lights::bounding_ball(light));
        });
        check_counts(room, "tiled-deferred-single", expected, 2.0);
    }
}

TEST_CASE("a tile's kernel evaluates the lights whose hulls were drawn into it, and that reach its depths", "[pipeline][lighting]") {
    for (bool const orthographic : {false, true}) {
        LampRoom room("300", {150, 85}, orthographic);
        std::uint64_t exact = 0, drawn = 0;
        TileCounts const expected(room, 16, [&](cluster::GridView const& grid, std::uint32_t column, std::uint32_t row, cull::DepthRange const& depths,
                                                lights::Light const& light) {
            math::Sphere const ball = lights::bounding_ball(light);
            lights::Hull const hull = lights::make_hull(light, grid.perspective);
            bool covered = light.kind == lights::Kind::directional;
            for (std::uint32_t f = 0; f < lights::hull_faces && hull.kind < 2; ++f)
                lights::for_each_tile(hull, f, {grid.x, grid.y, grid.perspective},
                                      [&](std::uint32_t i, std::uint32_t j) { covered = covered || (i == column && j == row); });
            bool const touches = rows_touch(grid, column, row, light);
            drawn += covered ? 1U : 0U;
            exact += touches ? 1U : 0U;
            if (touches && light.kind == lights::Kind::point) CHECK(covered);
            return covered && cull::may_touch(depths, ball.center.z, ball.radius);
        });
        CHECK(drawn < 2 * exact);  // spots wider than 45 degrees are drawn as balls
        check_counts(room, "tiled-deferred-raster", expected, 1.5);
    }
}

TEST_CASE("a tile may have more lights than its kernel lists at once", "[pipeline][lighting]") {
    LampRoom room("2500", {40, 22}, false);
    for (std::string const name : {"tiled-deferred-single", "tiled-deferred-raster"}) {
        auto const output = room.run(name, {{"tile", "40"}});
        CHECK(output.computations.front() > pipeline::tile_list_size);
        CHECK((output.radiance == room.run("deferred-stencil", {}).radiance));
    }
}

TEST_CASE("lights that are none are left out of a tile's lists, and counted", "[pipeline][lighting]") {
    LampRoom room("60", {96, 54}, false);
    auto const before = room.run("tiled-deferred-single", {});
    scene::Light bad = room.scene.lights[1];
    bad.position_m.y = std::numeric_limits<double>::quiet_NaN();
    room.scene.lights.push_back(bad);
    auto const after = room.run("tiled-deferred-single", {});
    CHECK((room.run("tiled-deferred-raster", {}).radiance == after.radiance));
    CHECK((before.radiance == after.radiance));
    CHECK((before.computations == after.computations));
    CHECK(count_in(before, "lights_left_out") == 0);
    CHECK(count_in(after, "lights_left_out") == 1);
    CHECK(count_in(after, "lights_left_out") == count_in(room.run("tiled-deferred", {}), "lights_left_out"));
}
