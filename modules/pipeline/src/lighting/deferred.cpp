// The techniques `deferred` and `deferred-stencil`: each light in turn, on the pixels that its volume covers.
// [Olsson 2014, Paper I, 1.1, 8; Paper II, 4: its "Deferred" is the one with the stencil]

#include "../detail.hpp"
#include "light_kernels.hpp"
#include "lighting.hpp"
#include "../workspace.hpp"

#include <gnomon/cull/screen_bounds.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace gnomon::pipeline {

namespace {

std::array<ParamInfo, 1> const& deferred_params() noexcept {
    static std::array<ParamInfo, 1> const all{{gbuffer_param}};
    return all;
}

/// Pixels [x, x + width) x [y, y + height).
struct PixelRect {
    std::uint32_t x = 0, y = 0, width = 0, height = 0;
};

/// An axis of the image: the window's ends, and how many pixels lie between them.
struct ImageAxis {
    double low;
    double high;
    std::int32_t size;
};

struct PixelSpan {
    std::uint32_t first;
    std::uint32_t count;
};

/// Pixels whose centre may lie between two values of the window, and one more on each side.
PixelSpan span_of(ImageAxis const& axis, float from, float to) {
    double const scale = axis.size / (axis.high - axis.low);
    auto const size = static_cast<double>(axis.size);
    double const begin = std::clamp(std::floor((static_cast<double>(from) - axis.low) * scale - 1.0), 0.0, size);
    double const end = std::clamp(std::ceil((static_cast<double>(to) - axis.low) * scale + 1.0), begin, size);
    return {static_cast<std::uint32_t>(begin), static_cast<std::uint32_t>(end - begin)};
}

PixelRect rect_of(Frame const& frame, lights::Light const& light) {
    math::ivec2 const size = frame.view.size_px;
    if (light.kind == lights::Kind::directional)
        return {0, 0, static_cast<std::uint32_t>(size.x), static_cast<std::uint32_t>(size.y)};
    math::Sphere const ball{light.center, light.range_m};
    cull::ScreenBounds const bounds = frame.view.lens == math::Lens::orthographic
                                          ? cull::screen_bounds_orthographic(ball)
                                          : cull::screen_bounds(ball, static_cast<float>(frame.view.near_m));
    if (bounds.empty()) return {};
    math::Window const& w = frame.view.window;
    PixelSpan const x = span_of({w.left, w.right, size.x}, bounds.lo.x, bounds.hi.x);
    PixelSpan const y = span_of({-w.top, -w.bottom, size.y}, bounds.lo.y, bounds.hi.y);
    return {x.first, y.first, x.count, y.count};
}

Result<LightingOutput> run_deferred(LightingRun const& on, bool stencil) {
    Verbs verbs(on.device);
    Lighting& l = begin_lighting(on, verbs);
    Workspace::State& state = on.workspace.state();
    l.sample_of.fill<std::uint32_t>(verbs, on.frame.sample_of_pixel);
    l.list_of_sample.assign(on.frame.samples.size(), no_list);
    l.list_cells.clear();
    l.list_indices.clear();
    std::uint64_t volumes = 0;
    auto const add_lights = [&](ShadeListsStd const& base) {
        on.device.stage("lights");
        std::array const buffers{state.samples.samples.get(), l.gbuffer.get(),  l.lights.get(),
                                 l.sample_of.get(),           l.radiance.get(), l.computations.get()};
        for (std::size_t i = 0; i < l.prepared.culled.size(); ++i) {
            PixelRect const r = rect_of(on.frame, l.prepared.culled[i]);
            if (r.width == 0 || r.height == 0) continue;
            ShadeVolumeStd const c{r.x,         r.y,
                                   r.width,     r.height,
                                   static_cast<std::uint32_t>(on.frame.view.size_px.x), static_cast<std::uint32_t>(i),
                                   base.halves, base.orthographic,
                                   {base.eye[0], base.eye[1], base.eye[2]},             stencil ? 1U : 0U};
            verbs(on.device.run(shade_volume_kernel, {std::size_t{r.width} * r.height, buffers, {}, backend::bytes_of(c)}));
            ++volumes;
        }
    };
    auto output = shade_lists(on, verbs, {}, add_lights);
    if (output) output->counts.push_back({"draw_calls", volumes});
    return output;
}

}  // namespace

LightingTechnique deferred_technique() noexcept {
    return {"deferred", "each light on the pixels that its ball covers, as a rasterized light volume does", deferred_params(),
            [](LightingRun const& on) { return run_deferred(on, false); }};
}

LightingTechnique deferred_stencil_technique() noexcept {
    return {"deferred-stencil", "each light on exactly the samples in its ball: the least that any technique evaluates",
            deferred_params(), [](LightingRun const& on) { return run_deferred(on, true); }};
}

}  // namespace gnomon::pipeline
