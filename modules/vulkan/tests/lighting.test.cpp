// Many lights on the device: the CPU's image and the CPU's counts.

#include "test_host.hpp"

#include <gnomon/check/check.hpp>
#include <gnomon/pipeline.hpp>
#include <gnomon/raster/cpu_backend.hpp>
#include <gnomon/scene.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <string>
#include <vector>

using namespace gnomon;

namespace {

pipeline::LightingOutput lit(pipeline::LightingTechnique const& technique, pipeline::Frame const& frame,
                             std::vector<pipeline::Setting> const& settings, backend::Backend& device) {
    core::SerialExecutor serial;
    pipeline::Workspace workspace;
    auto const params = pipeline::make_params(technique, settings);
    REQUIRE(params.has_value());
    auto output = technique.run({frame, frame.scene->lights, *params, workspace, device, serial});
    INFO((output ? std::string() : output.failure().message));
    REQUIRE(output.has_value());
    return *std::move(output);
}

}  // namespace

TEST_CASE("lighting techniques give the CPU's image on a device, to the bit, and evaluate the same lights", "[vulkan][lighting]") {
    vulkan::test::DeviceBackend on;
    core::SerialExecutor serial;
    raster::CpuBackend cpu(serial);
    auto const scene = scene::make_procedural({.name = "atrium", .lights = "400"});
    REQUIRE(scene.has_value());
    scene::Geometry const geometry = scene::flatten(*scene);
    auto const view = scene::make_view(scene->cameras.front(), {160, 90});
    REQUIRE(view.has_value());
    auto const frame = pipeline::make_frame(*scene, geometry, {*view, pipeline::sun({0.3, -1.0, 0.2}), false, nullptr, pipeline::SampleRule::formula}, serial);
    REQUIRE(frame.has_value());
    for (std::string const format : {"f32", "f16"})
        for (pipeline::LightingTechnique const& technique : pipeline::lighting_techniques()) {
            CAPTURE(technique.name);
            std::vector<pipeline::Setting> settings{{"gbuffer", format}};
            if (technique.name.find("forward") != std::string_view::npos) settings.clear();  // no G-buffer
            if (settings.empty() && format == "f16") continue;
            auto const ours = lit(technique, *frame, settings, cpu);
            auto const theirs = lit(technique, *frame, settings, *on.gpu);
            REQUIRE(ours.computations.size() == theirs.computations.size());
            std::size_t otherwise = 0;
            for (std::size_t i = 0; i < ours.computations.size(); ++i) otherwise += ours.computations[i] != theirs.computations[i] ? 1U : 0U;
            // Where two surfaces have nearly one depth, which hides the other depends on the last bits: so does overdraw.
            bool const overdraws = technique.name == "forward" || technique.name == "tiled-forward";
            if (overdraws && otherwise > 0)
                std::printf("%s: %zu of %zu samples shaded more or less often\n", std::string(technique.name).c_str(), otherwise,
                            ours.computations.size());
            CHECK(otherwise <= (overdraws ? ours.computations.size() / 1000 : 0U));
            REQUIRE(ours.radiance.size() == theirs.radiance.size());
            std::size_t differ = 0;
            for (std::size_t i = 0; i < ours.radiance.size(); ++i) differ += ours.radiance[i] != theirs.radiance[i] ? 1U : 0U;
            CHECK(differ == 0);
        }
    CHECK(on.device->take_messages() == "");
}

TEST_CASE("more lights than a tile's list holds, or an invocation may loop over, give the CPU's image on a device too", "[vulkan][lighting]") {
    vulkan::test::DeviceBackend on;
    core::SerialExecutor serial;
    raster::CpuBackend cpu(serial);
    auto const scene = scene::make_procedural({.name = "atrium", .lights = "2500"});
    REQUIRE(scene.has_value());
    scene::Geometry const geometry = scene::flatten(*scene);
    auto const view = scene::make_view(scene->cameras.front(), {100, 60});
    REQUIRE(view.has_value());
    auto const frame = pipeline::make_frame(*scene, geometry, {*view, pipeline::sun({0.3, -1.0, 0.2}), false, nullptr, pipeline::SampleRule::formula}, serial);
    REQUIRE(frame.has_value());
    auto const least = lit(*pipeline::find_lighting_technique("deferred-stencil").value(), *frame, {}, cpu);
    for (std::string const name : {"tiled-deferred-single", "tiled-deferred-raster"}) {
        pipeline::LightingTechnique const& technique = *pipeline::find_lighting_technique(name).value();
        auto const ours = lit(technique, *frame, {{"tile", "128"}}, cpu);
        auto const theirs = lit(technique, *frame, {{"tile", "128"}}, *on.gpu);
        CHECK(*std::max_element(ours.computations.begin(), ours.computations.end()) > 1024);
        CHECK((ours.computations == theirs.computations));
        CHECK((ours.radiance == theirs.radiance));
        CHECK((ours.radiance == least.radiance));
    }
    CHECK(on.device->take_messages() == "");
}

namespace {

/// A corner of the atrium under so many bulbs that all reach it.
struct CrowdedCorner {
    scene::Scene scene;
    scene::Geometry geometry;

    explicit CrowdedCorner(std::size_t bulbs) {
        scene = scene::make_procedural({.name = "atrium", .lights = "1"}).value();
        geometry = scene::flatten(scene);
        scene.lights.clear();
        for (std::size_t i = 0; i < bulbs; ++i) {
            scene.lights.push_back(pipeline::bulb(math::dvec3(0.001 * static_cast<double>(i % 1000), 2.0, 0.0), 200.0F));
            scene.lights.back().intensity = 0.001F * static_cast<float>(1 + i % 7);
        }
    }
};

}  // namespace

TEST_CASE("lights beyond what an invocation may loop over are evaluated all the same, or refused", "[vulkan][lighting]") {
    vulkan::test::DeviceBackend on;
    core::SerialExecutor serial;
    raster::CpuBackend cpu(serial);
    constexpr std::uint32_t bulbs = 70'000;
    CrowdedCorner const corner(bulbs);
    auto const view = scene::make_view(corner.scene.cameras.front(), {8, 6}).value();
    auto const frame = pipeline::make_frame(corner.scene, corner.geometry, {view, pipeline::sun({0.3, -1.0, 0.2}), false, nullptr, pipeline::SampleRule::formula}, serial);
    REQUIRE(frame.has_value());
    std::size_t refused = 0;
    for (std::string const name : {"tiled-deferred", "clustered-deferred", "clustered-deferred-device", "tiled-deferred-single", "forward",
                                   "tiled-forward", "tiled-forward-prez", "clustered-forward"}) {
        pipeline::LightingTechnique const& technique = *pipeline::find_lighting_technique(name).value();
        CAPTURE(technique.name);
        auto const params = pipeline::make_params(technique, {}).value();
        pipeline::Workspace workspace;
        auto const theirs = technique.run({*frame, corner.scene.lights, params, workspace, *on.gpu, serial});
        if (!theirs) {
            CHECK(theirs.failure().message.find("70000 lights") != std::string::npos);
            ++refused;
            continue;
        }
        auto const ours = lit(technique, *frame, {}, cpu);
        CHECK(*std::max_element(ours.computations.begin(), ours.computations.end()) == bulbs);
        CHECK((ours.computations == theirs->computations));
        CHECK((ours.radiance == theirs->radiance));
    }
    CHECK(refused == (on.gpu->limits().loop_rounds < bulbs ? 4U : 0U));  // forward shading: one fragment, one loop
    CHECK(on.device->take_messages() == "");
}
