#include "lighting.hpp"

#include "../detail.hpp"
#include "light_kernels.hpp"
#include "../workspace.hpp"

#include <gnomon/math/half.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>

namespace gnomon::pipeline {

namespace {

constexpr std::array<std::string_view, 2> formats{"f32", "f16"};

/// Twice what a sample's position, its depth and a light's place in culling space may be off by rounding.
float rounding_m(Frame const& frame) noexcept {
    double largest = 0.0;
    math::dvec3 const eye = frame.view.eye_m - frame.geometry->origin_m;
    for (math::axis_t axis = 0; axis < 3; ++axis)
        largest = std::max({largest, std::abs(static_cast<double>(frame.bounds.lo[axis])),
                            std::abs(static_cast<double>(frame.bounds.hi[axis])), std::abs(eye[axis])});
    return static_cast<float>(largest * 0x1p-19);
}

lights::ShadedLight shaded_light(Light const& light, math::vec3 const& position) noexcept {
    math::vec3 const color = light.color * light.intensity;
    switch (light.kind) {
        case LightKind::directional: return lights::make_shaded_directional(math::to_float(light.direction), color);
        case LightKind::point: return lights::make_shaded_point(position, light.range_m, color);
        case LightKind::spot:
            return lights::make_shaded_spot(position, light.range_m, color, math::to_float(light.direction),
                                            {light.inner_cone_rad, light.outer_cone_rad});
    }
    return {};
}

float wide_half_angle(Light const& light) noexcept { return std::min(light.outer_cone_rad + 1e-3F, 3.14159274F); }

/// How far a spot's apex is moved back until its cone's sides are `rounding` farther out.
float moved_back(Light const& light, float rounding) noexcept {
    bool const is_cone = light.kind == LightKind::spot && math::is_finite(light.range_m);
    return is_cone ? 2.0F * rounding / std::max(std::sin(std::min(wide_half_angle(light), 1.5F)), 1e-3F) : 0.0F;
}

/// The light in culling space, larger by what rounding may hide: a ball by `rounding`; a spot's cone by a milliradian, its
/// apex moved back.
lights::Light culled_light(math::View const& view, Light const& light, float rounding) noexcept {
    if (light.kind == LightKind::directional || !math::is_finite(light.range_m)) return lights::make_directional();
    math::vec3 const nowhere(0.0F);  // `place` says where
    float const range = light.range_m * (1.0F + 0x1p-20F) + rounding;
    if (light.kind == LightKind::point) return lights::place({light.position_m, lights::make_point(nowhere, range)}, view);
    float const back = moved_back(light, rounding);
    lights::Light const spot = lights::make_spot(nowhere, range + back, math::to_float(light.direction), wide_half_angle(light));
    lights::Light placed = lights::place({light.position_m, spot}, view);
    placed.center = placed.center - placed.axis * back;
    return placed;
}

std::uint64_t sum_of(std::span<std::uint32_t const> numbers) noexcept {
    std::uint64_t sum = 0;
    for (std::uint32_t const n : numbers) sum += n;
    return sum;
}

}  // namespace

constinit ParamInfo const gbuffer_param{"gbuffer", ParamKind::choice, "f32", 0, 0, "", formats, "how a number of the G-buffer is stored"};
constinit ParamInfo const tile_param{"tile", ParamKind::integer, "32", 4, 256, "pixels", {}, "side of a tile"};

void Lighting::fit_gbuffer(Verbs& verbs, Frame const& frame, GBufferFormat wanted, core::ExecutorRef executor) {
    if (gbuffer_of == frame.state && format == wanted) return;
    gbuffer_of = nullptr;
    gbuffer.fill<std::uint32_t>(verbs, make_gbuffer(frame, wanted, executor));
    format = wanted;
    if (verbs.good()) gbuffer_of = frame.state;
}

void prepare_lights(Frame const& frame, std::span<Light const> lights, PreparedLights& out) {
    float const rounding = rounding_m(frame);
    out.shaded.clear();
    out.culled.clear();
    out.rounding_m = rounding;
    out.facing_slack_m = 0.0F;
    for (Light const& light : lights) {
        math::vec3 const position = math::to_float(light.position_m - frame.geometry->origin_m);
        out.shaded.push_back(shaded_light(light, position));
        out.culled.push_back(culled_light(frame.view, light, rounding));
        out.facing_slack_m = std::max(out.facing_slack_m, rounding + 1.001F * moved_back(light, rounding));
    }
}

void widen(std::span<cluster::NormalCone> cones) noexcept {
    for (cluster::NormalCone& cone : cones) cone.cos_half -= 1e-5F;
}

void turn_normals(LightingRun const& on, GBufferFormat format, std::vector<math::vec3>& out) {
    out.resize(on.frame.samples.size());
    math::View const& view = on.frame.view;
    on.executor.parallel_for(out.size(), sample_grain, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            math::vec3 n = on.frame.samples.shading_normal[i];
            for (math::axis_t k = 0; k < 3 && format == GBufferFormat::f16; ++k) n[k] = math::float_of_half(math::half_of_float(n[k]));
            math::dvec3 const d = math::to_double(n);
            out[i] = math::to_float(math::dvec3(glm::dot(d, view.right), -glm::dot(d, view.up), -glm::dot(d, view.back)));
        }
    });
}

Lighting& begin_lighting(LightingRun const& on, Verbs& verbs) {
    Workspace::State& state = on.workspace.state();
    state.move_to(on.device);
    state.samples.fit(verbs, on.frame);
    Lighting& lighting = state.lighting;
    auto const format = on.params.word("gbuffer") == "f16" ? GBufferFormat::f16 : GBufferFormat::f32;
    lighting.fit_gbuffer(verbs, on.frame, format, on.executor);
    prepare_lights(on.frame, on.lights, lighting.prepared);
    return lighting;
}

math::vec3 shading_eye(Frame const& frame) noexcept {
    bool const orthographic = frame.view.lens == math::Lens::orthographic;
    return math::to_float(orthographic ? frame.view.back : frame.view.eye_m - frame.geometry->origin_m);
}

Result<LightingOutput> read_image(LightingRun const& on, Verbs& verbs, std::vector<StageTime> stages) {
    Lighting& l = on.workspace.state().lighting;
    std::size_t const n = on.frame.samples.size();
    LightingOutput output;
    output.radiance.resize(n);
    output.computations.resize(n);
    on.device.stage("");
    verbs(on.device.read(l.radiance.get(), 0, std::as_writable_bytes(std::span(output.radiance))));
    verbs(on.device.read(l.computations.get(), 0, std::as_writable_bytes(std::span(output.computations))));
    auto const device_stages = verbs(on.device.finish());
    if (!verbs.good()) return verbs.failure();
    output.stages = std::move(stages);
    output.stages.insert(output.stages.end(), device_stages.begin(), device_stages.end());
    output.counts = {{"lighting_computations", sum_of(output.computations)}};
    output.bytes = {{"gbuffer", n * words_of(l.format) * sizeof(std::uint32_t)}};
    return output;
}

void run_shade_lists(Verbs& verbs, std::span<backend::BufferId const> buffers, ShadeListsStd constants, std::uint32_t longest) {
    constants.end = 0;
    do {
        constants.first = constants.end;
        constants.end = std::min(longest, constants.first + most_iterations);
        verbs(verbs.device().run(shade_lists_kernel, {constants.count, buffers, {}, backend::bytes_of(constants)}));
    } while (constants.end < longest);
}

Result<LightingOutput> shade_lists(LightingRun const& on, Verbs& verbs, std::vector<StageTime> stages,
                                   std::function<void(ShadeListsStd const&)> const& then) {
    Workspace::State& state = on.workspace.state();
    Lighting& l = state.lighting;
    std::size_t const n = on.frame.samples.size();
    l.radiance.fit(verbs, n * sizeof(math::vec3));
    l.computations.fit(verbs, n * sizeof(std::uint32_t));
    on.device.stage("upload");
    l.lights.fill<lights::ShadedLight>(verbs, l.prepared.shaded);
    l.list_of.fill<std::uint32_t>(verbs, l.list_of_sample);
    l.cells.fill<lights::Cell>(verbs, l.list_cells);
    l.indices.fill<std::uint32_t>(verbs, l.list_indices);
    on.device.stage("shade");
    std::array const buffers{state.samples.samples.get(), l.gbuffer.get(), l.lights.get(),   l.list_of.get(),
                             l.cells.get(),               l.indices.get(), l.radiance.get(), l.computations.get()};
    bool const orthographic = on.frame.view.lens == math::Lens::orthographic;
    math::vec3 const eye = shading_eye(on.frame);
    ShadeListsStd const constants{static_cast<std::uint32_t>(n), l.format == GBufferFormat::f16 ? 1U : 0U, orthographic ? 1U : 0U,
                                  {eye.x, eye.y, eye.z}, 0, 0};
    std::uint32_t longest = 0;
    for (lights::Cell const& cell : l.list_cells) longest = std::max(longest, cell.count);
    run_shade_lists(verbs, buffers, constants, longest);
    if (then) then(constants);
    auto output = read_image(on, verbs, std::move(stages));
    if (!output) return output;
    std::uint64_t pairs = 0;
    for (lights::Cell const& cell : l.list_cells) pairs += cell.count;
    output->counts.insert(output->counts.end(), {{"light_pairs", pairs}, {"lists", l.list_cells.size()}});
    output->bytes.push_back({"lists", l.list_cells.size() * sizeof(lights::Cell) + l.list_indices.size() * sizeof(std::uint32_t)});
    return output;
}

}  // namespace gnomon::pipeline
