// Builds a frame: camera pass, view samples with their surfaces, and the truth.

#include "detail.hpp"
#include "frame_state.hpp"
#include "lighting/surface_table.hpp"

#include <gnomon/pipeline/image.hpp>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

namespace gnomon::pipeline {

namespace {

/// A vector of any length as a float direction: rounded as it is where that loses nothing but bits.
math::vec3 float_direction(math::dvec3 const& v) noexcept {
    double const largest = std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)});
    bool const ordinary = largest > 1e-12 && largest < 1e12;
    return math::to_float(ordinary ? v : v / largest);
}

Result<core::Done> validate_frame(scene::Geometry const& geometry, math::View const& view, Light const& light) {
    if (auto ok = validate(light); !ok) return ok;
    if (view.size_px.x < 1 || view.size_px.y < 1 || view.size_px.x > raster::max_size_px ||
        view.size_px.y > raster::max_size_px)
        return core::Failure{Error::bad_view,
                             "the image is " + std::to_string(view.size_px.x) + "x" + std::to_string(view.size_px.y) +
                                 " pixels; each side must be from 1 to " + std::to_string(raster::max_size_px)};
    if (!math::is_finite(view.eye_m) || !math::is_finite(math::to_float(view.eye_m - geometry.origin_m)))
        return core::Failure{Error::bad_view, "the camera's eye (" + std::to_string(view.eye_m.x) + ", " +
                                                  std::to_string(view.eye_m.y) + ", " + std::to_string(view.eye_m.z) +
                                                  ") m is not a finite float away from the scene"};
    if (geometry.indices.size() < 3 || math::is_empty(geometry.bounds))
        return core::Failure{Error::empty_scene, "the scene has no triangle to draw"};
    if (!math::is_finite(math::to_float(light.position_m - geometry.origin_m)) && light.kind != LightKind::directional)
        return core::Failure{Error::bad_light, "the light is too far away: its position is not a finite float"};
    return core::Done{};
}

/// Weights of a triangle's corners at a point of its plane, from areas; a triangle without area takes its first corner.
math::dvec3 corner_weights(math::dvec3 const& a, math::dvec3 const& b, math::dvec3 const& c, math::dvec3 const& p) {
    math::dvec3 const normal = glm::cross(b - a, c - a);
    double const area = glm::dot(normal, normal);
    if (!(area > 0.0)) return math::dvec3(1.0, 0.0, 0.0);
    double const wb = glm::dot(glm::cross(p - a, c - a), normal) / area;
    double const wc = glm::dot(glm::cross(b - a, p - a), normal) / area;
    return math::dvec3(1.0 - wb - wc, wb, wc);
}

math::vec3 unit_or(math::dvec3 const& v, math::dvec3 const& fallback) noexcept {
    double const length = glm::length(v);
    return math::to_float(length > 0.0 && std::isfinite(length) ? v / length : fallback);
}

/// Fills entry `i` of everything that a sample's surface has.
void describe(Frame& frame, predicates::Target const& eye, std::size_t i) {
    scene::Geometry const& g = *frame.geometry;
    std::uint32_t const* const corner = g.indices.data() + std::size_t{frame.samples.triangle[i]} * 3;
    math::dvec3 const a = math::to_double(g.positions[corner[0]]);
    math::dvec3 const b = math::to_double(g.positions[corner[1]]);
    math::dvec3 const c = math::to_double(g.positions[corner[2]]);
    math::dvec3 const p = math::to_double(frame.samples.position[i]);
    math::dvec3 const sight = eye.at_infinity ? math::to_double(eye.xyz) : math::to_double(eye.xyz) - a;
    math::dvec3 normal = glm::cross(b - a, c - a);
    if (glm::dot(normal, sight) < 0.0) normal = -normal;
    frame.samples.normal[i] = unit_or(normal, glm::normalize(sight));
    math::dvec3 const w = corner_weights(a, b, c, p);
    math::dvec3 shading(0.0);
    math::dvec2 uv(0.0);
    for (int k = 0; k < 3; ++k) {
        std::uint32_t const v = corner[k];
        if (v < g.normals.size()) shading += math::to_double(g.normals[v]) * w[k];
        if (v < g.uv.size()) uv += math::dvec2(static_cast<double>(g.uv[v].x), static_cast<double>(g.uv[v].y)) * w[k];
    }
    if (glm::dot(shading, math::to_double(frame.samples.normal[i])) < 0.0) shading = -shading;
    frame.samples.shading_normal[i] = unit_or(shading, math::to_double(frame.samples.normal[i]));
    frame.samples.uv[i] = math::vec2(static_cast<float>(uv.x), static_cast<float>(uv.y));
}

/// The same, and the position, by the formula that fragment shaders use.
void describe_by_formula(Frame& frame, FrameState& state, CameraRays const& rays, std::size_t i) {
    auto const width = static_cast<std::uint32_t>(frame.view.size_px.x);
    std::uint32_t const pixel = frame.samples.pixel[i];
    math::vec2 const px(static_cast<float>(pixel % width) + 0.5F, static_cast<float>(pixel / width) + 0.5F);
    auto const t = triangle_of(*frame.geometry, frame.samples.triangle[i]);
    auto const at = gn_surface_point(rays.camera, formula::Vec2<float>(px), t);
    frame.samples.position[i] = state.samples[i].position = math::vec3(at.position);
    frame.samples.normal[i] = math::vec3(at.normal);
    frame.samples.shading_normal[i] = math::vec3(at.shading_normal);
    frame.samples.uv[i] = math::vec2(at.uv.x.v, at.uv.y.v);
}

/// Whether the light's range and cone hold the sample.
bool is_reached(Frame const& frame, std::size_t i) noexcept {
    if (frame.light.kind == LightKind::directional) return true;
    math::dvec3 const away = math::to_double(frame.samples.position[i]) - math::to_double(frame.light_position);
    double const distance = glm::length(away);
    if (distance > static_cast<double>(frame.light.range_m)) return false;
    if (frame.light.kind == LightKind::point) return true;
    double const cosine = glm::dot(away, glm::normalize(frame.light.direction));
    return cosine >= distance * std::cos(static_cast<double>(frame.light.outer_cone_rad));
}

/// Compacts the image's view samples into the frame's lists.
void gather(Frame& frame, FrameState& state, std::vector<sample::ViewSample> const& image, SampleRule rule,
            core::ExecutorRef executor) {
    Samples& s = frame.samples;
    frame.sample_of_pixel.assign(image.size(), no_sample);
    for (std::size_t pixel = 0; pixel < image.size(); ++pixel) {
        if (image[pixel].triangle.is_none()) continue;
        frame.sample_of_pixel[pixel] = static_cast<std::uint32_t>(s.pixel.size());
        s.pixel.push_back(static_cast<std::uint32_t>(pixel));
        s.triangle.push_back(image[pixel].triangle.value);
        s.position.push_back(image[pixel].position);
        state.samples.push_back(image[pixel]);
    }
    std::size_t const n = s.size();
    s.normal.resize(n);
    s.shading_normal.resize(n);
    s.uv.resize(n);
    frame.reached.resize(n);
    CameraRays const rays = make_camera_rays(frame.view, frame.geometry->origin_m);
    executor.parallel_for(n, sample_grain, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            if (rule == SampleRule::formula)
                describe_by_formula(frame, state, rays, i);
            else
                describe(frame, state.eye, i);
            frame.reached[i] = is_reached(frame, i) ? 1 : 0;
        }
    });
}

std::vector<std::uint32_t> draw_ids(Frame& frame, core::ExecutorRef executor) {
    math::ivec2 const size = frame.view.size_px;
    std::vector<std::uint32_t> ids(pixel_count(size));
    std::vector<float> depth(pixel_count(size));
    DrawList list = make_draws(*frame.scene, *frame.geometry, raster::Cull::none,
                               frame.leaves_out_blended ? Blended::left_out : Blended::as_masked);
    list.look_from(frame.view, frame.geometry->origin_m);
    raster::PassConfig config;
    config.depth = frame.view.depth;
    raster::Workspace workspace;
    raster::PassStats const stats = raster::camera_pass(
        list.draws, {raster::make_image(depth.data(), size.x, size.y), raster::make_image(ids.data(), size.x, size.y)},
        config, workspace, executor);
    frame.triangles_drawn = stats.triangles;
    frame.bad_triangles = stats.bad_index + stats.not_finite;
    return ids;
}

/// Which triangles have holes, and where.
void collect_alpha(scene::Scene const& scene, scene::Geometry const& geometry, Surfaces& surfaces) {
    for (scene::Material const& material : scene.materials) {
        AlphaRule const rule = alpha_rule(scene, material);
        trace::AlphaMaterial alpha;
        alpha.is_masked = rule.tested || rule.nothing;
        alpha.factor = material.base_color.w;
        alpha.cutoff = static_cast<float>(rule.cutoff);
        if (rule.tested) {
            scene::Image const& image = *base_image(scene, material);
            scene::Texture const& texture = *base_texture(scene, material);
            alpha.texture = static_cast<std::uint32_t>(surfaces.textures.size());
            surfaces.textures.push_back({image.rgba, image.size_px, texture.wrap_u, texture.wrap_v});
        }
        surfaces.masked = surfaces.masked || alpha.is_masked;
        surfaces.materials.push_back(alpha);
    }
    if (!surfaces.masked || geometry.uv.empty()) return;
    surfaces.corner_uv.reserve(geometry.indices.size());
    for (std::uint32_t const i : geometry.indices) surfaces.corner_uv.push_back(geometry.uv[i]);
}

std::shared_ptr<Surfaces> make_surfaces(scene::Scene const& scene, scene::Geometry const& geometry) {
    auto surfaces = std::make_shared<Surfaces>();
    surfaces->corners.reserve(geometry.indices.size() / 3);
    for (std::size_t i = 0; i + 2 < geometry.indices.size(); i += 3)
        surfaces->corners.emplace_back(geometry.indices[i], geometry.indices[i + 1], geometry.indices[i + 2]);
    collect_alpha(scene, geometry, *surfaces);
    return surfaces;
}

/// Those of the frame before if they will do, else new ones.
std::shared_ptr<Surfaces const> surfaces_for(Frame const& frame, Shot const& shot, core::ExecutorRef executor) {
    Frame const* const before = shot.before;
    bool const same = before != nullptr && before->scene == frame.scene && before->geometry == frame.geometry;
    if (same && (!shot.truth || !before->state->surfaces->bvh.nodes.empty())) return before->state->surfaces;
    std::shared_ptr<Surfaces> surfaces = make_surfaces(*frame.scene, *frame.geometry);
    if (shot.truth) surfaces->bvh = trace::build_bvh({frame.geometry->positions, surfaces->corners}, executor);
    return surfaces;
}

}  // namespace

std::vector<std::uint8_t> trace_lit(Frame const& frame, FrameState const& state, trace::Bvh const& bvh,
                                    core::ExecutorRef executor) {
    std::size_t const n = state.samples.size();
    std::vector<std::uint64_t> shadow(trace::visibility_words(n));
    with_opacity(frame, state, [&](auto const& opacity) {
        (void)trace::visibility(bvh, std::span<sample::ViewSample const>(state.samples),
                                std::span<std::uint64_t>(shadow), executor, config_of(frame, state, opacity));
    });
    std::vector<std::uint8_t> lit(n);
    for (std::size_t i = 0; i < n; ++i) lit[i] = !trace::is_in_shadow(shadow, i) && frame.reached[i] != 0 ? 1 : 0;
    return lit;
}

Result<Frame> make_frame(scene::Scene const& scene, scene::Geometry const& geometry, Shot const& shot,
                         core::ExecutorRef executor) {
    Light const& light = shot.light;
    if (auto ok = validate_frame(geometry, shot.view, light); !ok) return std::move(ok).failure();
    Frame frame;
    auto state = std::make_shared<FrameState>();
    frame.scene = &scene;
    frame.geometry = &geometry;
    frame.view = shot.view;
    frame.light = light;
    frame.bounds = geometry.bounds;
    frame.leaves_out_blended = shot.leaves_out_blended;
    frame.light_position = math::to_float(light.position_m - geometry.origin_m);
    frame.to_light = float_direction(-light.direction);
    state->eye = sample::eye_of(shot.view, geometry.origin_m);
    state->light = light.kind == LightKind::directional ? predicates::Target::direction(frame.to_light)
                                                        : predicates::Target::point(frame.light_position);
    Stopwatch watch;
    std::vector<std::uint32_t> const ids = draw_ids(frame, executor);
    frame.stages.push_back({"camera_pass", watch.lap_ms()});
    state->surfaces = surfaces_for(frame, shot, executor);
    double const build_ms = watch.lap_ms();
    std::vector<sample::ViewSample> image(ids.size());
    sample::make_view_samples({shot.view, geometry.origin_m, triangles_of(frame, *state)}, ids,
                              std::span<sample::ViewSample>(image), executor);
    gather(frame, *state, image, shot.samples, executor);
    frame.stages.push_back({"samples", watch.lap_ms()});
    if (shot.truth) {
        frame.lit = trace_lit(frame, *state, state->surfaces->bvh, executor);
        frame.stages.push_back({"truth_build", build_ms});
        frame.stages.push_back({"truth_trace", watch.lap_ms()});
    }
    frame.state = std::move(state);
    return frame;
}

Result<Frame> make_frame(scene::Scene const& scene, scene::Geometry const& geometry, math::View const& view,
                         Light const& light, core::ExecutorRef executor) {
    return make_frame(scene, geometry, Shot{view, light}, executor);
}

}  // namespace gnomon::pipeline
