// Four samples a pixel: where they are, what is shaded, and that the image comes nearer to one of 64.

#include <gnomon/check/check.hpp>
#include <gnomon/pipeline/lighting.hpp>
#include <gnomon/raster/cpu_backend.hpp>
#include <gnomon/scene.hpp>

#include "../src/lighting/antialias_kernels.hpp"
#include "../src/lighting/lighting.hpp"

#include <cmath>
#include <cstdint>
#include <cstdio>
#include <vector>

namespace {

using namespace gnomon;

struct AtriumViews {
    scene::Scene scene = scene::make_procedural({.name = "atrium", .lights = "60"}).value();
    scene::Geometry geometry = scene::flatten(scene);

    [[nodiscard]] math::View view(math::ivec2 const& size_px) const { return scene::make_view(scene.cameras.front(), size_px).value(); }
    [[nodiscard]] pipeline::Frame frame(math::View const& view) const {
        core::SerialExecutor serial;
        pipeline::Shot const shot{view, pipeline::sun({0.3, -1.0, 0.2}), false, nullptr, pipeline::SampleRule::formula};
        return pipeline::make_frame(scene, geometry, shot, serial).value();
    }
};

std::vector<math::vec3> lit_pixels(AtriumViews const& atrium, pipeline::Frame const& frame) {
    auto const* const technique = pipeline::find_lighting_technique("deferred-stencil").value();
    pipeline::Workspace workspace;
    core::SerialExecutor serial;
    auto const output = technique->run({frame, atrium.scene.lights, pipeline::make_params(*technique).value(), workspace,
                                        workspace.own_backend(serial), serial}).value();
    std::vector<math::vec3> image(frame.sample_of_pixel.size(), math::vec3(0.0F));
    for (std::size_t i = 0; i < frame.samples.size(); ++i) image[frame.samples.pixel[i]] = output.radiance[i];
    return image;
}

/// As an eye sees it: bright spots do not outweigh all edges.
double shown(float c) { return std::sqrt(static_cast<double>(c) / (1.0 + static_cast<double>(c))); }

double rms(std::vector<math::vec3> const& a, std::vector<math::vec3> const& b) {
    double sum = 0.0;
    for (std::size_t i = 0; i < a.size(); ++i)
        for (math::axis_t c = 0; c < 3; ++c) sum += (shown(a[i][c]) - shown(b[i][c])) * (shown(a[i][c]) - shown(b[i][c]));
    return std::sqrt(sum / (3.0 * static_cast<double>(a.size())));
}

}  // namespace

TEST_CASE("the layers of a pass moved by subpixels show what cameras moved by as much show", "[pipeline][antialias]") {
    AtriumViews const atrium;
    math::ivec2 const size(160, 90);
    math::View const view = atrium.view(size);
    auto const frame = atrium.frame(view);
    core::SerialExecutor serial;
    raster::CpuBackend device(serial);
    auto const draws = pipeline::make_draws(atrium.scene, atrium.geometry, raster::Cull::none);
    auto const list = *device.keep(draws.draws);
    auto const target = *device.make_target({.size_px = size, .layers = 4, .triangle_ids = true});
    std::vector<std::uint32_t> ids(std::size_t{160} * 90);
    for (std::uint32_t s = 0; s < 4; ++s) {
        backend::PassLayer layer = pipeline::layer_of(frame);
        math::vec2 const at = pipeline::sample_px[s];
        layer.layer = s;
        layer.subpixel = {static_cast<std::int32_t>((0.5F - at.x) * 256.0F), static_cast<std::int32_t>((0.5F - at.y) * 256.0F)};
        REQUIRE(device.draw(list, target, {&layer, 1}));
        REQUIRE(device.read({target, s, backend::Plane::triangle, {0, 0, 160, 90}}, std::as_writable_bytes(std::span(ids))));
        math::View moved = view;  // the window that has the sample at the pixels' centres
        double const dx = (static_cast<double>(at.x) - 0.5) * (view.window.right - view.window.left) / size.x;
        double const dy = (static_cast<double>(at.y) - 0.5) * (view.window.bottom - view.window.top) / size.y;
        moved.window = {.left = view.window.left + dx, .right = view.window.right + dx, .bottom = view.window.bottom + dy, .top = view.window.top + dy};
        auto const alone = atrium.frame(moved);
        std::size_t differ = 0, otherwise = 0;
        for (std::size_t i = 0; i < ids.size(); ++i) {
            std::uint32_t const sample = alone.sample_of_pixel[i];
            differ += ids[i] != (sample == pipeline::no_sample ? backend::no_triangle : alone.samples.triangle[sample]) ? 1U : 0U;
            std::uint32_t const still = frame.sample_of_pixel[i];
            otherwise += ids[i] != (still == pipeline::no_sample ? backend::no_triangle : frame.samples.triangle[still]) ? 1U : 0U;
        }
        CHECK(differ * 200 <= ids.size());  // corners are snapped at other places: 1/512 pixel
        CHECK(otherwise * 50 >= ids.size());  // than without moving
    }
}

TEST_CASE("four samples a pixel bring an image nearer to 64, shaded by fragments or at edges alone", "[pipeline][lighting][antialias]") {
    AtriumViews const atrium;
    math::ivec2 const size(120, 68);
    auto const frame = atrium.frame(atrium.view(size));
    auto const once = lit_pixels(atrium, frame);
    auto const fine = lit_pixels(atrium, atrium.frame(atrium.view(math::ivec2(size.x * 8, size.y * 8))));
    std::vector<math::vec3> truth(once.size(), math::vec3(0.0F));
    for (std::size_t i = 0; i < fine.size(); ++i) {
        std::size_t const width = static_cast<std::size_t>(size.x) * 8;
        truth[i / width / 8 * static_cast<std::size_t>(size.x) + i % width / 8] += fine[i] * (1.0F / 64.0F);
    }
    core::SerialExecutor serial;
    pipeline::Workspace workspace;
    pipeline::Params const none;
    pipeline::LightingRun const on{frame, atrium.scene.lights, none, workspace, workspace.own_backend(serial), serial};
    auto const fragments = pipeline::shade_antialiased(on, {32, false});
    auto const edges = pipeline::shade_antialiased(on, {32, true});
    REQUIRE(fragments.has_value());
    REQUIRE(edges.has_value());
    double const error_once = rms(once, truth);
    double const error_fragments = rms(fragments->image, truth);
    double const error_edges = rms(edges->image, truth);
    std::printf("RMS against 64 samples: %.4f with 1, %.4f with 4 by fragments, %.4f with 4 at edges; lights %llu, %llu\n", error_once,
                error_fragments, error_edges, static_cast<unsigned long long>(fragments->counts.front().value),
                static_cast<unsigned long long>(edges->counts.front().value));
    CHECK(error_fragments < 0.75 * error_once);
    CHECK(error_edges < 0.75 * error_once);
    // Pixels within one triangle are shaded as ever, to the bit, and no oftener.
    std::size_t same = 0;
    for (std::size_t i = 0; i < once.size(); ++i) same += edges->image[i] == once[i] ? 1U : 0U;
    CHECK(same * 2 > once.size());
    CHECK(fragments->counts.front().value < edges->counts.front().value);
}
