// Many lights: every technique gives the image that evaluating every light for every sample gives.

#include <gnomon/check/check.hpp>
#include <gnomon/lights/shade.hpp>
#include <gnomon/pipeline/lighting.hpp>
#include <gnomon/scene.hpp>

#include "../src/lighting/lighting.hpp"
#include "../src/lighting/shade_lanes.hpp"

#include <cmath>
#include <cstdint>
#include <cstdio>
#include <limits>
#include <map>
#include <string>
#include <vector>

using namespace gnomon;

namespace {

/// A frame of a procedural scene from one of its cameras, without truth.
struct LitScene {
    scene::Scene scene;
    scene::Geometry geometry;
    pipeline::Frame frame;

    LitScene(scene::ProceduralConfig const& config, std::string const& camera, math::ivec2 size_px) {
        auto made_scene = scene::make_procedural(config);
        INFO((made_scene ? std::string() : made_scene.failure().message));
        REQUIRE(made_scene.has_value());
        scene = std::move(made_scene).value();
        geometry = scene::flatten(scene);
        scene::Camera const* at = &scene.cameras.front();
        for (scene::Camera const& c : scene.cameras)
            if (c.name == camera) at = &c;
        core::SerialExecutor serial;
        auto made = pipeline::make_frame(
            scene, geometry,
            {scene::make_view(*at, size_px).value(), pipeline::sun({0.3, -1.0, 0.2}), false, nullptr, pipeline::SampleRule::formula},
            serial);
        REQUIRE(made.has_value());
        frame = std::move(made).value();
    }
};

/// Every light evaluated for every sample, one after the other; and how many reach it.
struct Reference {
    std::vector<math::vec3> radiance;
    std::uint64_t reaching = 0;

    Reference(pipeline::Frame const& frame, std::span<pipeline::Light const> lights, pipeline::GBufferFormat format) {
        core::SerialExecutor serial;
        auto const words = pipeline::make_gbuffer(frame, format, serial);
        pipeline::PreparedLights prepared;
        pipeline::prepare_lights(frame, lights, prepared);
        pipeline::ShadedSamples const from{frame.state->samples, words, format == pipeline::GBufferFormat::f16, false,
                                           math::to_float(frame.view.eye_m - frame.geometry->origin_m)};
        for (std::size_t i = 0; i < frame.samples.size(); ++i) {
            pipeline::GBufferTexel const t = from.texel(i);
            math::vec3 const position = frame.samples.position[i];
            formula::Vec3<float> const p(position);
            formula::Vec3<float> const to_eye = gn_unit_or_up(formula::Vec3<float>(from.eye) - p);
            formula::GnSurface<float> const surface{p,
                                                    {t.normal[0], t.normal[1], t.normal[2]},
                                                    to_eye,
                                                    {t.diffuse[0], t.diffuse[1], t.diffuse[2]},
                                                    {t.specular[0], t.specular[1], t.specular[2]},
                                                    t.shininess};
            formula::Vec3<float> sum(t.emissive[0], t.emissive[1], t.emissive[2]);
            for (lights::ShadedLight const& light : prepared.shaded) {
                sum = sum + gn_shade(light, surface);
                reaching += gn_see_light(light, p).within.v ? 1U : 0U;
            }
            radiance.push_back(math::vec3(sum));
        }
    }
};

std::uint64_t count_of(pipeline::LightingOutput const& output, std::string_view name) {
    for (pipeline::Count const& c : output.counts)
        if (c.name == name) return c.value;
    FAIL("no such count");
    return 0;
}

pipeline::LightingOutput run(LitScene const& s, std::string const& name, std::vector<pipeline::Setting> const& settings = {}) {
    auto const* const technique = pipeline::find_lighting_technique(name).value();
    auto const params = pipeline::make_params(*technique, settings).value();
    core::SerialExecutor serial;
    pipeline::Workspace workspace;
    auto output = technique->run({s.frame, s.scene.lights, params, workspace, workspace.own_backend(serial), serial});
    INFO((output ? std::string() : output.failure().message));
    REQUIRE(output.has_value());
    return std::move(output).value();
}

/// Every third light becomes a spot, some wider than a right angle; the first shines without an end, the second is a sun.
void mix(std::vector<scene::Light>& lights) {
    for (std::size_t i = 2; i < lights.size(); i += 3) {
        auto const turn = static_cast<double>(i);
        lights[i].kind = scene::LightKind::spot;
        lights[i].direction = math::dvec3(std::sin(turn), std::cos(2.0 * turn), std::sin(3.0 * turn + 1.0));
        lights[i].outer_cone_rad = 0.05F + 0.004F * static_cast<float>(i % 400);
        lights[i].inner_cone_rad = lights[i].outer_cone_rad * 0.5F;
    }
    lights[0].range_m = std::numeric_limits<float>::infinity();
    lights[0].intensity *= 0.1F;
    lights[1].kind = scene::LightKind::directional;
    lights[1].direction = math::dvec3(0.1, -1.0, 0.3);
    lights[1].intensity = 0.05F;
}

/// What more a technique knows of its clusters can only take lights away.
void check_order(std::map<std::string, std::uint64_t, std::less<>> const& computations) {
    auto const fewer = [&](char const* less, char const* more) {
        CAPTURE(less, more);
        CHECK(computations.at(less) < computations.at(more));
    };
    CHECK(computations.at("tiled-deferred-en") <= computations.at("tiled-deferred"));  // these tiles face every way
    for (char const* const name : {"clustered-deferred-eb", "clustered-deferred-en", "clustered-deferred-nk3"}) fewer(name, "clustered-deferred");
    for (char const* const name : {"clustered-deferred-eb", "clustered-deferred-en"}) fewer("clustered-deferred-eb-en", name);
    for (char const* const name : {"clustered-deferred-eb-en", "clustered-deferred-nk3"}) fewer("clustered-deferred-nk3-eb-en", name);
    CHECK(computations.at("clustered-deferred-pt") == computations.at("clustered-deferred"));
    CHECK(computations.at("clustered-deferred-nk3-pt") == computations.at("clustered-deferred-nk3"));
}

bool has_param(pipeline::LightingTechnique const& technique, std::string_view name) {
    for (pipeline::ParamInfo const& p : technique.params)
        if (p.name == name) return true;
    return false;
}

void check_techniques(LitScene const& s, pipeline::GBufferFormat format) {
    Reference const truth(s.frame, s.scene.lights, format);
    REQUIRE(truth.reaching > s.frame.samples.size());
    std::map<std::string, std::uint64_t, std::less<>> all;
    for (pipeline::LightingTechnique const& technique : pipeline::lighting_techniques()) {
        CAPTURE(technique.name);
        std::vector<pipeline::Setting> settings;
        if (has_param(technique, "gbuffer"))
            settings.push_back({"gbuffer", format == pipeline::GBufferFormat::f16 ? "f16" : "f32"});
        else if (format == pipeline::GBufferFormat::f16)
            continue;  // without a G-buffer, nothing is rounded
        if (has_param(technique, "tile")) settings.push_back({"tile", "16"});
        auto const output = run(s, std::string(technique.name), settings);
        REQUIRE(output.radiance.size() == truth.radiance.size());
        std::size_t differ = 0;
        for (std::size_t i = 0; i < truth.radiance.size(); ++i) differ += output.radiance[i] != truth.radiance[i] ? 1U : 0U;
        CHECK(differ == 0);
        std::uint64_t const computations = count_of(output, "lighting_computations");
        if (technique.name == "deferred-stencil") CHECK(computations == truth.reaching);
        bool const all_lights = technique.name == "forward";  // overdraw too
        if (all_lights) CHECK(computations >= s.frame.samples.size() * s.scene.lights.size());
        if (!all_lights) CHECK(computations < s.frame.samples.size() * s.scene.lights.size() / 4);
        all.emplace(technique.name, computations);
    }
    check_order(all);
}

}  // namespace

TEST_CASE("every lighting technique gives the image of all lights on all samples, to the bit", "[pipeline][lighting]") {
    LitScene s({.name = "atrium", .lights = "400"}, "still", {160, 90});
    REQUIRE(s.scene.lights.size() == 400);
    for (pipeline::GBufferFormat const format : {pipeline::GBufferFormat::f32, pipeline::GBufferFormat::f16}) check_techniques(s, format);
    mix(s.scene.lights);
    check_techniques(s, pipeline::GBufferFormat::f32);
}

TEST_CASE("clusters of the atrium with trees and 10,000 lights need at most 1.6 times the least lighting computations, tiles far more",
          "[pipeline][lighting][.full]") {
    LitScene const s({.name = "atrium", .lights = "10000", .trees = true}, "still", {1920, 1080});
    auto const least = count_of(run(s, "deferred-stencil"), "lighting_computations");
    std::map<std::string, std::uint64_t, std::less<>> all;
    for (pipeline::LightingTechnique const& technique : pipeline::lighting_techniques()) {
        if (technique.name == "forward") continue;  // every light, every fragment: 10^11 of them
        auto const output = run(s, std::string(technique.name));
        auto const computations = count_of(output, "lighting_computations");
        all.emplace(technique.name, computations);
        std::printf("| `%s` | %llu | %.2f | %llu | %llu |\n", std::string(technique.name).c_str(),
                    static_cast<unsigned long long>(computations), static_cast<double>(computations) / static_cast<double>(least),
                    static_cast<unsigned long long>(count_of(output, "lists")),
                    static_cast<unsigned long long>(count_of(output, "light_pairs")));
        if (technique.name == "clustered-deferred") CHECK(computations * 10 <= least * 16);
        if (technique.name == "tiled-deferred") CHECK(computations > least * 3);
    }
    check_order(all);
    CHECK(all.at("tiled-deferred-en") < all.at("tiled-deferred"));
}

TEST_CASE("three ways to find unique clusters shade with the same lists", "[pipeline][lighting]") {
    LitScene const s({.name = "atrium", .lights = "100"}, "still", {96, 54});
    auto const bitmap = run(s, "clustered-deferred");
    for (std::string const method : {"page-table", "sort"}) {
        auto const output = run(s, "clustered-deferred", {{"unique", method}});
        CHECK(output.radiance == bitmap.radiance);
        CHECK(output.computations == bitmap.computations);
        CHECK(count_of(output, "lists") == count_of(bitmap, "lists"));
    }
}

TEST_CASE("clusters too many for a key of 32 bits have one of 64, and the same image", "[pipeline][lighting]") {
    LitScene const s({.name = "atrium", .lights = "60"}, "still", {1040, 16});
    auto const least = run(s, "deferred-stencil");
    for (std::string const name : {"clustered-deferred", "clustered-deferred-pt", "clustered-deferred-nk3"}) {
        auto const output = run(s, name, {{"tile", "4"}});
        CHECK(output.radiance == least.radiance);
        CHECK(count_of(output, "lists") > 1000);
    }
}

TEST_CASE("pictures of lit frames have light where lights are, and heat where they are many", "[pipeline][lighting]") {
    LitScene const s({.name = "atrium", .lights = "200"}, "still", {96, 54});
    auto const output = run(s, "clustered-deferred");
    auto const picture = pipeline::lit_picture(s.frame, output.radiance, pipeline::pick_exposure(output.radiance));
    REQUIRE(picture.rgb.size() == 96 * 54 * 3);
    std::uint64_t sum = 0;
    for (std::uint8_t const c : picture.rgb) sum += c;
    CHECK(sum / picture.rgb.size() > 40);
    CHECK(sum / picture.rgb.size() < 220);
    auto const heat = pipeline::heat_map(s.frame, output.computations, 1);
    std::size_t white = 0;
    std::size_t lit = 0;
    for (std::size_t i = 0; i < output.computations.size(); ++i) {
        std::size_t const at = std::size_t{s.frame.samples.pixel[i]} * 3;
        white += heat.rgb[at] == 255 && heat.rgb[at + 1] == 255 && heat.rgb[at + 2] == 255 ? 1U : 0U;
        lit += output.computations[i] > 0 ? 1U : 0U;
    }
    CHECK(lit > 100);
    CHECK(white == lit);
}

TEST_CASE("no lights give what surfaces give themselves; an unknown technique is named", "[pipeline][lighting]") {
    LitScene s({.name = "atrium", .lights = "1"}, "still", {48, 27});
    s.scene.lights.clear();
    for (pipeline::LightingTechnique const& technique : pipeline::lighting_techniques()) {
        auto const output = run(s, std::string(technique.name));
        CHECK(count_of(output, "lighting_computations") == 0);
        CHECK(output.radiance.size() == s.frame.samples.size());
    }
    auto const none = pipeline::find_lighting_technique("clustered");
    REQUIRE_FALSE(none.has_value());
    CHECK(none.failure().message.find("'clustered'; there are deferred, deferred-stencil, tiled-deferred, ") != std::string::npos);
}
