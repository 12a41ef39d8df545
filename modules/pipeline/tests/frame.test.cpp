#include <gnomon/check/check.hpp>
#include <gnomon/core/executor_threads.hpp>
#include <gnomon/pipeline.hpp>
#include <gnomon/scene/procedural.hpp>
#include <gnomon/scene/suggest.hpp>

#include <array>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

namespace {

using namespace gnomon;
using math::dvec3;
using math::vec3;
using pipeline::Error;
using pipeline::Setting;

struct Stage {
    scene::Scene scene;
    scene::Geometry geometry;
};

Stage stage_of(std::string const& name, std::uint64_t triangles = 0) {
    scene::ProceduralConfig config;
    config.name = name;
    config.triangles = triangles;
    Stage stage{scene::make_procedural(config).value(), {}};
    stage.geometry = scene::flatten(stage.scene);
    return stage;
}

Stage const& city() {
    static Stage const stage = stage_of("city", 52'000);
    return stage;
}

math::View street_view(int size, math::Depth depth = math::Depth::reversed) {
    math::PerspectiveConfig config;
    config.eye_m = dvec3(-150.0, 110.0, -260.0);
    config.target_m = dvec3(20.0, 0.0, -60.0);
    config.size_px = math::ivec2(size, size);
    config.near_m = 0.5;
    config.depth = depth;
    return math::make_perspective(config).value();
}

pipeline::Light test_sun() { return pipeline::sun(dvec3(-0.45, -0.8, -0.4)); }

pipeline::Frame frame_with(core::ExecutorRef executor, pipeline::Light const& light, int size = 256) {
    return pipeline::make_frame(city().scene, city().geometry, street_view(size), light, executor).value();
}

pipeline::RunRequest request(std::string_view name, std::vector<Setting> const& settings = {}) {
    pipeline::Technique const* const technique = pipeline::find_technique(name).value();
    return {technique, pipeline::make_params(*technique, settings).value()};
}

pipeline::Measures errors(pipeline::Frame const& frame, pipeline::RunRequest const& wanted,
                          core::ExecutorRef executor) {
    pipeline::CompareConfig config;
    config.images = false;
    return pipeline::compare(frame, std::array{wanted}, config, executor).value().runs[0].error;
}

std::vector<pipeline::Light> test_lights() {
    pipeline::Light spot = pipeline::bulb(dvec3(-40.0, 160.0, -120.0), 900.0F);
    spot.kind = pipeline::LightKind::spot;
    spot.direction = dvec3(0.2, -1.0, 0.1);
    spot.outer_cone_rad = 0.7F;
    return {test_sun(), pipeline::bulb(dvec3(-40.0, 120.0, -120.0)), spot};
}

std::uint64_t counted(std::vector<pipeline::Count> const& counts, std::string_view name) {
    for (pipeline::Count const& count : counts)
        if (count.name == name) return count.value;
    return 0;
}

}  // namespace

TEST_CASE("rays are never wrong, whatever the light", "[pipeline][frame]") {
    core::SerialExecutor const serial;
    for (pipeline::Light const& light : test_lights()) {
        CAPTURE(std::string(pipeline::name_of(light.kind)));
        pipeline::Frame const frame = frame_with(serial, light);
        REQUIRE(frame.samples.size() > 10'000);
        std::uint64_t lit = 0;
        for (std::uint8_t const l : frame.lit) lit += l;
        CHECK(lit > frame.samples.size() / 20);
        CHECK(lit < frame.samples.size());
        pipeline::Measures const m = errors(frame, request("ray"), serial);
        CHECK(m.wrong == 0);
        CHECK(m.samples == frame.samples.size());
        CHECK(m.radiance_error == 0.0);
    }
}

TEST_CASE("a shadow map's error falls as its resolution grows", "[pipeline][shadow-map]") {
    core::ThreadExecutor const threads(2);
    for (pipeline::Light const& light : test_lights()) {
        pipeline::Frame const frame = frame_with(threads, light);
        double before = 1.0;
        for (char const* const resolution : {"64", "256", "1024", "4096"}) {
            // Six faces of 4096 take long in a debug build and prove nothing more.
            if (light.kind == pipeline::LightKind::point && std::string(resolution) == "4096") continue;
            pipeline::Measures const m = errors(frame, request("shadow-map", {{"resolution", resolution}}), threads);
            CAPTURE(std::string(pipeline::name_of(light.kind)), std::string(resolution), m.wrong_fraction);
            // At the end a handful of samples are left, whose number only jitters.
            CHECK((m.wrong_fraction < 0.75 * before || m.wrong < 8));
            CHECK(m.acne <= m.false_shadow);
            CHECK(m.detachment <= m.false_lit);
            before = m.wrong_fraction;
        }
        CHECK(before < 0.01);
    }
}

TEST_CASE("automatic bias leaves boxes and ground without acne", "[pipeline][shadow-map]") {
    core::ThreadExecutor const threads(2);
    pipeline::Frame const frame = frame_with(threads, test_sun());
    for (char const* const pcf : {"1", "2", "3", "5"})
        for (char const* const format : {"f32", "unorm16"}) {
            CAPTURE(std::string(pcf), std::string(format));
            CHECK(errors(frame, request("shadow-map", {{"pcf", pcf}, {"format", format}}), threads).acne == 0);
        }
    pipeline::Measures const bare =
        errors(frame, request("shadow-map", {{"bias", "manual"}, {"plane", "off"}, {"pcf", "1"}}), threads);
    CHECK(bare.acne > frame.samples.size() / 100);  // so that the zeros above mean something
    pipeline::Measures const heavy =
        errors(frame, request("shadow-map", {{"bias", "manual"}, {"constant", "40"}, {"unit", "m"}}), threads);
    CHECK(heavy.detachment > 100);
    CHECK(heavy.false_lit > bare.false_lit);
}

TEST_CASE("forward and reversed maps give the same errors", "[pipeline][shadow-map]") {
    core::ThreadExecutor const threads(2);
    for (pipeline::Light const& light : test_lights()) {
        pipeline::Frame const frame = frame_with(threads, light);
        auto const forward = errors(frame, request("shadow-map", {{"depth", "forward"}}), threads);
        auto const reversed = errors(frame, request("shadow-map", {{"depth", "reversed"}}), threads);
        CHECK(std::abs(forward.wrong_fraction - reversed.wrong_fraction) < 2e-4);
        CHECK(std::abs(forward.visibility_error_mean - reversed.visibility_error_mean) < 2e-4);
    }
}

TEST_CASE("visibilities and pictures are the same for any number of threads", "[pipeline][threads]") {
    std::vector<Setting> const small{{"resolution", "512"}};
    for (pipeline::Light const& light : test_lights()) {
        core::SerialExecutor const serial;
        pipeline::Frame const one = frame_with(serial, light, 128);
        auto const reference =
            pipeline::compare(one, std::array{request("shadow-map", small), request("ray")}, {}, serial).value();
        for (int const count : {2, 7}) {
            core::ThreadExecutor const threads(count);
            pipeline::Frame const many = frame_with(threads, light, 128);
            CHECK(many.lit == one.lit);
            CHECK(many.samples.position == one.samples.position);
            auto const again =
                pipeline::compare(many, std::array{request("shadow-map", small), request("ray")}, {}, threads).value();
            CHECK(again.exact.rgb == reference.exact.rgb);
            for (std::size_t i = 0; i < 2; ++i) {
                CHECK(again.runs[i].lit.rgb == reference.runs[i].lit.rgb);
                CHECK(again.runs[i].overlay.rgb == reference.runs[i].overlay.rgb);
                CHECK(again.runs[i].error.wrong == reference.runs[i].error.wrong);
                CHECK(again.runs[i].error.visibility_error_mean == reference.runs[i].error.visibility_error_mean);
            }
        }
    }
}

TEST_CASE("counts say what was drawn and allocated", "[pipeline][counts]") {
    core::SerialExecutor const serial;
    std::uint64_t const triangles = city().geometry.indices.size() / 3;
    for (pipeline::Light const& light : test_lights()) {
        pipeline::Frame const frame = frame_with(serial, light, 64);
        std::uint64_t const maps = light.kind == pipeline::LightKind::point ? 6 : 1;
        std::vector<Setting> const settings{{"resolution", "128"}, {"format", "unorm16"}};
        auto const result = pipeline::compare(frame, std::array{request("shadow-map", settings)}, {}, serial).value();
        pipeline::RunReport const& run = result.runs[0];
        CHECK(counted(run.counts, "triangles_drawn") == triangles * maps);
        CHECK(counted(run.counts, "draw_calls") == maps);
        CHECK(counted(run.counts, "texels_allocated") == 128 * 128 * maps);
        CHECK(counted(run.counts, "texels_rewritten") == 128 * 128 * maps);
        CHECK(counted(run.counts, "lighting_computations") == frame.samples.size());
        CHECK(counted(run.bytes, "shadow_maps") == 128 * 128 * maps * 2);
        CHECK(run.stages.size() == 3);
        CHECK(run.lit.rgb.size() == 64 * 64 * 3);
    }
}

TEST_CASE("a light beyond its range and outside of its cone lights nothing, for truth and techniques alike",
          "[pipeline][frame]") {
    core::SerialExecutor const serial;
    pipeline::Frame const frame = frame_with(serial, pipeline::bulb(dvec3(0.0, 900.0, 0.0), 1.0F), 64);
    for (std::uint8_t const l : frame.lit) CHECK(l == 0);
    CHECK(errors(frame, request("shadow-map", {{"resolution", "64"}}), serial).wrong == 0);
}

TEST_CASE("a frame's samples and truth are these, on every machine", "[pipeline][golden]") {
    core::SerialExecutor const serial;
    std::vector<std::uint64_t> lit_counts;
    std::uint64_t hash = 1469598103934665603U;
    for (pipeline::Light const& light : test_lights()) {
        pipeline::Frame const frame = frame_with(serial, light);
        CHECK(frame.samples.size() == 52'808);
        std::uint64_t lit = 0;
        for (std::size_t i = 0; i < frame.lit.size(); ++i) {
            lit += frame.lit[i];
            hash = (hash ^ (std::uint64_t{frame.samples.triangle[i]} * 2 + frame.lit[i])) * 1099511628211U;
        }
        lit_counts.push_back(lit);
    }
    CHECK(lit_counts == std::vector<std::uint64_t>{10'795, 23'320, 6'012});
    CHECK(hash == 5'120'184'050'175'069'416U);
}

TEST_CASE("a light in a house, on the ground and on a corner is decided like any other", "[pipeline][frame]") {
    core::SerialExecutor const serial;
    for (dvec3 const& place : {dvec3(0.0, 0.0, 0.0), dvec3(-13.9, 4.0, -13.9), dvec3(-500.0, 0.0, -500.0),
                               dvec3(-150.0, 110.0, -260.0), dvec3(20.0, -3.0, -60.0)}) {
        pipeline::Frame const frame = frame_with(serial, pipeline::bulb(place), 96);
        CHECK(errors(frame, request("ray"), serial).wrong == 0);
        pipeline::Measures const m = errors(frame, request("shadow-map", {{"resolution", "512"}}), serial);
        CAPTURE(place.x, place.y, place.z, m.wrong_fraction, m.false_lit, m.false_shadow);
        CHECK(m.wrong_fraction < 0.05);
    }
}

TEST_CASE("a city of ten centimetres has the shadows of one of a kilometre", "[pipeline][frame]") {
    core::ThreadExecutor const threads(2);
    Stage small = {city().scene, {}};
    constexpr double scale = 1.0 / 8192.0;
    for (scene::Instance& instance : small.scene.instances)
        for (int column = 0; column < 4; ++column)
            for (int row = 0; row < 3; ++row) instance.world_from_mesh[column][row] *= scale;
    small.geometry = scene::flatten(small.scene);
    math::View view = street_view(128);
    pipeline::Frame const here = pipeline::make_frame(city().scene, city().geometry, view, test_sun(), threads).value();
    view.eye_m *= scale;
    view.near_m *= scale;
    pipeline::Frame const there = pipeline::make_frame(small.scene, small.geometry, view, test_sun(), threads).value();
    CHECK(there.lit == here.lit);
    auto const a = errors(here, request("shadow-map"), threads);
    auto const b = errors(there, request("shadow-map"), threads);
    CHECK(std::abs(a.wrong_fraction - b.wrong_fraction) < 5e-4);
}

TEST_CASE("a view of nothing is a frame without samples", "[pipeline][frame]") {
    core::SerialExecutor const serial;
    math::PerspectiveConfig away;
    away.eye_m = dvec3(0.0, 500.0, 0.0);
    away.target_m = dvec3(0.0, 600.0, 0.0);
    away.size_px = math::ivec2(16, 8);
    auto const frame =
        pipeline::make_frame(city().scene, city().geometry, math::make_perspective(away).value(), test_sun(), serial);
    REQUIRE(frame);
    CHECK(frame->samples.size() == 0);
    auto const result = pipeline::compare(*frame, std::array{request("shadow-map"), request("ray")}, {}, serial);
    REQUIRE(result);
    CHECK(result->runs[0].lit.rgb.size() == 16 * 8 * 3);
    CHECK(result->runs[0].error.wrong_fraction == 0.0);
}

TEST_CASE("senseless lights and views are refused by name", "[pipeline][frame]") {
    core::SerialExecutor const serial;
    auto const code_of = [&](math::View const& view, pipeline::Light const& light) {
        auto const frame = pipeline::make_frame(city().scene, city().geometry, view, light, serial);
        REQUIRE_FALSE(frame);
        CHECK_FALSE(frame.failure().message.empty());
        return frame.failure().code;
    };
    double const nan = std::numeric_limits<double>::quiet_NaN();
    math::View const view = street_view(8);
    CHECK(code_of(view, pipeline::sun(dvec3(0.0))) == Error::bad_light);
    CHECK(code_of(view, pipeline::sun(dvec3(0.0, nan, 0.0))) == Error::bad_light);
    CHECK(code_of(view, pipeline::bulb(dvec3(nan, 0.0, 0.0))) == Error::bad_light);
    CHECK(code_of(view, pipeline::bulb(dvec3(1e300, 0.0, 0.0))) == Error::bad_light);
    CHECK(code_of(view, pipeline::bulb(dvec3(0.0), -1.0F)) == Error::bad_light);
    pipeline::Light spot = pipeline::bulb(dvec3(0.0));
    spot.kind = pipeline::LightKind::spot;
    spot.outer_cone_rad = 2.0F;
    CHECK(code_of(view, spot) == Error::bad_light);
    pipeline::Light dark = test_sun();
    dark.intensity = -1.0F;
    CHECK(code_of(view, dark) == Error::bad_light);
    math::View bad = view;
    bad.size_px = math::ivec2(0, 8);
    CHECK(code_of(bad, test_sun()) == Error::bad_view);
    bad.size_px = math::ivec2(20'000, 8);
    CHECK(code_of(bad, test_sun()) == Error::bad_view);
    bad = view;
    bad.eye_m.x = nan;
    CHECK(code_of(bad, test_sun()) == Error::bad_view);
    scene::Scene const no_scene;
    scene::Geometry const nothing;
    auto const empty = pipeline::make_frame(no_scene, nothing, view, test_sun(), serial);
    REQUIRE_FALSE(empty);
    CHECK(empty.failure().code == Error::empty_scene);
}

TEST_CASE("a map that would not fit in memory is refused with what it needs", "[pipeline][shadow-map]") {
    core::SerialExecutor const serial;
    pipeline::Frame const frame = frame_with(serial, pipeline::bulb(dvec3(0.0, 200.0, 0.0)), 8);
    auto const result =
        pipeline::compare(frame, std::array{request("shadow-map", {{"resolution", "16384"}})}, {}, serial);
    REQUIRE_FALSE(result);
    CHECK(result.failure().code == Error::too_large);
    CHECK(result.failure().message.find("6144 MiB") != std::string::npos);
}

TEST_CASE("the same city 1e7 m away has the same shadows", "[pipeline][frame]") {
    core::ThreadExecutor const threads(2);
    Stage far = {city().scene, {}};
    dvec3 const offset(10'000'384.0, -1024.0, -9'999'360.0);
    for (scene::Instance& instance : far.scene.instances)
        for (int axis = 0; axis < 3; ++axis) instance.world_from_mesh[3][axis] += offset[axis];
    far.geometry = scene::flatten(far.scene, {offset});
    math::View view = street_view(128);
    pipeline::Frame const here = pipeline::make_frame(city().scene, city().geometry, view, test_sun(), threads).value();
    view.eye_m += offset;
    pipeline::Frame const there = pipeline::make_frame(far.scene, far.geometry, view, test_sun(), threads).value();
    CHECK(there.lit == here.lit);
    CHECK(there.samples.position == here.samples.position);
    auto const a = errors(here, request("shadow-map"), threads);
    auto const b = errors(there, request("shadow-map"), threads);
    CHECK(a.wrong == b.wrong);
}

TEST_CASE("both depth conventions and an orthographic camera make the same frame's kind", "[pipeline][frame]") {
    core::ThreadExecutor const threads(2);
    auto const forward = pipeline::make_frame(city().scene, city().geometry, street_view(128, math::Depth::forward),
                                              test_sun(), threads);
    auto const reversed = pipeline::make_frame(city().scene, city().geometry, street_view(128), test_sun(), threads);
    REQUIRE(forward);
    REQUIRE(reversed);
    std::size_t differing = 0;
    for (std::size_t i = 0; i < reversed->sample_of_pixel.size(); ++i) {
        std::uint32_t const a = forward->sample_of_pixel[i];
        std::uint32_t const b = reversed->sample_of_pixel[i];
        bool const same = (a == pipeline::no_sample) == (b == pipeline::no_sample) &&
                          (a == pipeline::no_sample || forward->samples.triangle[a] == reversed->samples.triangle[b]);
        differing += same ? 0 : 1;
    }
    CHECK(differing < 8);  // forward float depth resolves distant edges less finely
    math::OrthographicConfig config;
    config.eye_m = dvec3(0.0, 300.0, 200.0);
    config.window_m = {-200.0, 200.0, -200.0, 200.0};
    config.far_m = 1200.0;
    config.size_px = math::ivec2(128, 128);
    auto const ortho = pipeline::make_frame(city().scene, city().geometry, math::make_orthographic(config).value(),
                                            test_sun(), threads);
    REQUIRE(ortho);
    CHECK(ortho->samples.size() > 8'000);
    CHECK(errors(*ortho, request("ray"), threads).wrong == 0);
    CHECK(errors(*ortho, request("shadow-map"), threads).wrong_fraction < 0.03);
}

TEST_CASE("pictures show false-lit and false-shadow samples in their colours", "[pipeline][picture]") {
    core::ThreadExecutor const threads(2);
    pipeline::Frame const frame = frame_with(threads, test_sun(), 128);
    pipeline::Shading const shading = pipeline::shade(frame, {}, threads);
    std::vector<float> visibility = pipeline::exact_visibility(frame);
    CHECK(pipeline::radiance_error(frame, shading, visibility) == 0.0);
    for (float& v : visibility) v = 1.0F - v;
    CHECK(pipeline::radiance_error(frame, shading, visibility) > 0.1);
    pipeline::Image const overlay = pipeline::error_overlay(frame, shading, visibility);
    for (std::size_t i = 0; i < frame.samples.size(); ++i) {
        std::uint8_t const* const rgb = overlay.rgb.data() + std::size_t{frame.samples.pixel[i]} * 3;
        bool const orange = rgb[0] > 200 && rgb[2] < 100;
        bool const blue = rgb[2] > 200 && rgb[0] < 110;
        CHECK(orange == (frame.lit[i] == 0));
        CHECK(blue == (frame.lit[i] != 0));
    }
}

TEST_CASE("a frame after another takes its hierarchy over and finds the same truth", "[pipeline][frame]") {
    core::SerialExecutor const serial;
    Stage const& stage = city();
    auto shot = [&](int size, bool truth, pipeline::Frame const* before) {
        return pipeline::make_frame(stage.scene, stage.geometry,
                                    pipeline::Shot{street_view(size), test_sun(), truth, before}, serial)
            .value();
    };
    pipeline::Frame const whole = shot(96, true, nullptr);
    pipeline::Frame const drawn = shot(64, false, nullptr);
    CHECK(shot(96, true, &whole).lit == whole.lit);
    CHECK(shot(96, true, &drawn).lit == whole.lit);  // one that has no hierarchy to give
    pipeline::Frame const no_truth = shot(96, false, &whole);
    CHECK(no_truth.samples.position == whole.samples.position);
    CHECK_FALSE(pipeline::has_truth(no_truth));
    CHECK(pipeline::has_truth(whole));
}

TEST_CASE("a frame of other geometry makes its own hierarchy", "[pipeline][frame]") {
    core::SerialExecutor const serial;
    Stage moved = stage_of("cubes");
    pipeline::Shot shot{scene::make_view(moved.scene.cameras.front(), math::ivec2(64, 64)).value(), test_sun()};
    pipeline::Frame const other = frame_with(serial, test_sun(), 32);
    shot.before = &other;
    pipeline::Frame const frame = pipeline::make_frame(moved.scene, moved.geometry, shot, serial).value();
    shot.before = nullptr;
    CHECK(frame.lit == pipeline::make_frame(moved.scene, moved.geometry, shot, serial).value().lit);
}

TEST_CASE("without truth a technique draws the same picture, and no error is known", "[pipeline][frame]") {
    core::SerialExecutor const serial;
    Stage const& stage = city();
    pipeline::Shot shot{street_view(96), test_sun()};
    pipeline::Frame const known = pipeline::make_frame(stage.scene, stage.geometry, shot, serial).value();
    shot.truth = false;
    pipeline::Frame const unknown = pipeline::make_frame(stage.scene, stage.geometry, shot, serial).value();
    pipeline::CompareConfig config;
    config.shading.exposure = 0.5F;
    pipeline::Workspace kept;
    pipeline::RunRequest wanted = request("shadow-map");
    auto const with = pipeline::compare(known, std::array{wanted}, config, serial).value();
    wanted.workspace = &kept;
    auto const without = pipeline::compare(unknown, std::array{wanted}, config, serial).value();
    CHECK(without.runs[0].lit.rgb == with.runs[0].lit.rgb);
    CHECK(without.exposure == 0.5F);
    CHECK_FALSE(without.runs[0].measured);
    CHECK(without.runs[0].error.samples == with.runs[0].error.samples);
    CHECK(without.runs[0].overlay.rgb.empty());
    CHECK(without.exact.rgb.empty());
}
