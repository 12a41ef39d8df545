#include "inputs.hpp"

#include "find_by_name.hpp"
#include "table.hpp"
#include "values.hpp"

#include <gnomon/scene/procedural.hpp>
#include <gnomon/scene/suggest.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace gnomon::command {

namespace {

constexpr double pi = 3.14159265358979323846;

/// The shortest text that reads back as the same numbers.
std::string text_of(math::dvec3 const& v) { return fmt::format("{},{},{}", v.x, v.y, v.z); }

/// Near and far as the user wants them, whatever gave the view.
Outcome<Described<math::View>> with_range(math::View view, std::string text, ViewOptions const& options) {
    if (options.near_m) view.near_m = *options.near_m;
    if (options.far_m) view.far_m = *options.far_m;
    if (!(view.near_m < view.far_m))
        return usage_error(
            fmt::format("--near {:g} and --far {:g} m: near must be less than far", view.near_m, view.far_m));
    if (options.near_m) text += fmt::format(" --near {}", view.near_m);
    if (options.far_m) text += fmt::format(" --far {}", view.far_m);
    return Described<math::View>{view, text + fmt::format(" --size {}x{}", view.size_px.x, view.size_px.y)};
}

Outcome<Described<math::View>> view_at(math::PerspectiveConfig const& config, ViewOptions const& options) {
    auto view = math::make_perspective(config);
    if (!view) return usage_error(view.failure().message);
    return with_range(*view,
                      fmt::format("--eye {} --look {} --fov {:.4g}", text_of(config.eye_m), text_of(config.target_m),
                                  config.fov_y_rad * 180.0 / pi),
                      options);
}

Outcome<math::View> view_of(scene::Camera camera, ViewOptions const& options, std::string const& name) {
    if (options.near_m) camera.near_m = *options.near_m;  // the user's range may mend the file's
    if (options.far_m) camera.far_m = *options.far_m;
    auto view = scene::make_view(camera, options.size_px);
    if (view) return *view;
    return failure(
        fmt::format("{}: {}; give --near and --far, or --eye and --look", name, view.failure().message));
}

Outcome<Described<math::View>> view_of_camera(Stage const& stage, std::size_t index, ViewOptions const& options) {
    std::string const name = name_of(stage.loaded.scene.cameras, index);
    scene::Camera const camera =
        scene::posed_camera(stage.loaded.scene, stage.pose, static_cast<std::uint32_t>(index));
    auto view = view_of(camera, options, "camera '" + name + "'");
    if (!view) return std::move(view).failure();
    return with_range(*view, "--camera " + name, options);
}

/// The same direction with its largest component 1, so that neither 1e-300 nor 1e300 is lost in a float.
math::dvec3 of_moderate_length(math::dvec3 const& direction) {
    return direction / std::max({std::abs(direction.x), std::abs(direction.y), std::abs(direction.z)});
}

/// Where the given --eye and --look leave the near plane open: close enough for what is looked at.
double near_for(math::dvec3 const& eye_m, math::dvec3 const& look_m) {
    constexpr double usual_m = 0.1;
    return std::min(usual_m, glm::length(look_m - eye_m) * 1e-3);
}

/// A view that shows the scene, in round numbers, so that its options give exactly the same view again.
Outcome<Described<math::View>> suggested_view(scene::Geometry const& geometry, ViewOptions options) {
    scene::SuggestedView const suggested = scene::auto_view(geometry);
    double const distance_m = glm::length(suggested.target_m - suggested.eye_m);
    // Steps of a power of ten, about a thousandth of the distance; as a quotient, which has a short decimal form.
    double const steps_per_m = std::pow(10.0, 3.0 - std::floor(std::log10(distance_m > 0.0 ? distance_m : 1.0)));
    auto const rounded = [](double value, double steps) { return std::round(value * steps) / steps; };
    math::PerspectiveConfig config;
    for (int axis = 0; axis < 3; ++axis) {
        config.eye_m[axis] = rounded(suggested.eye_m[axis], steps_per_m);
        config.target_m[axis] = rounded(suggested.target_m[axis], steps_per_m);
    }
    config.fov_y_rad = rounded(suggested.fov_y_rad * 180.0 / pi, 10.0) * pi / 180.0;
    config.size_px = options.size_px;
    double const near_steps = std::pow(10.0, 1.0 - std::floor(std::log10(suggested.near_m)));
    if (!options.near_m) options.near_m = std::floor(suggested.near_m * near_steps) / near_steps;
    config.near_m = *options.near_m;
    config.far_m = options.far_m.value_or(std::numeric_limits<double>::infinity());
    return view_at(config, options);
}

}  // namespace

Outcome<Described<math::View>> choose_view(ViewOptions const& options, Stage const& stage) {
    std::vector<scene::Camera> const& cameras = stage.loaded.scene.cameras;
    if (options.camera) {
        if (auto const found = find_by_name(cameras, *options.camera)) return view_of_camera(stage, *found, options);
        return not_found("--camera", *options.camera, cameras, stage.loaded.scene.notes);
    }
    math::PerspectiveConfig config;
    config.size_px = options.size_px;
    if (options.eye_m) {
        config.eye_m = *options.eye_m;
        config.target_m = *options.look_m;
        config.fov_y_rad = options.fov_deg.value_or(60.0) * pi / 180.0;
        config.near_m = options.near_m.value_or(near_for(config.eye_m, config.target_m));
        config.far_m = options.far_m.value_or(std::numeric_limits<double>::infinity());
        return view_at(config, options);
    }
    if (stage.loaded.built_in && !cameras.empty()) return view_of_camera(stage, 0, options);
    return suggested_view(stage.geometry, options);
}

namespace {

/// The path as asked for: of the scene, or `orbit`, which fits any.
Outcome<scene::CameraPath> path_of(RunOptions const& options, Stage const& stage) {
    constexpr int usual_frames = 120;
    MotionOptions const& motion = options.motion;
    scene::ProceduralConfig const& config = options.scene.config;
    auto const paths = scene::procedural_paths(stage.loaded.built_in ? config.name : std::string());
    std::string const name = motion.path.value_or(paths.empty() ? "orbit" : std::string(paths.front().name));
    if (name == "orbit")
        return scene::orbit(stage.geometry, static_cast<std::uint32_t>(motion.frames.value_or(usual_frames)));
    if (!find_by_name(paths, name)) {
        std::vector<std::string> known = names_of(paths);
        known.emplace_back("orbit");
        return usage_error(
            fmt::format("--path {}: {} has no path of this name; {}", name, stage.loaded.text, suggestion(name, known)));
    }
    auto path = scene::make_path(config, name);
    if (!path) return usage_error(path.failure().message);
    std::size_t const wanted = motion.frames ? static_cast<std::size_t>(*motion.frames) : path->frames.size();
    if (wanted > path->frames.size())
        return usage_error(fmt::format("--frames {}: the path {} of {} has {}; give at most as many", wanted, name,
                                       config.name, path->frames.size()));
    path->frames.resize(wanted);
    return *std::move(path);
}

/// The eye as --eye or --camera has it, while time passes.
Outcome<Journey> watch(RunOptions const& options, Stage& stage) {
    constexpr double rate_hz = 30.0;
    double const clip_s = stage.moves() ? scene::duration_s(stage.loaded.scene.animations[stage.clip.clip]) : 0.0;
    auto const whole = static_cast<int>(std::clamp(std::round(clip_s * rate_hz), 1.0, 100'000.0));
    Journey journey{{}, rate_hz, {}};
    for (int frame = 0; frame < options.motion.frames.value_or(whole); ++frame) {
        scene::PoseConfig at = stage.clip;
        at.time_s += frame / rate_hz;
        scene::pose_at(stage.loaded.scene, at, stage.pose);
        auto view = choose_view(options.view, stage);
        if (!view) return std::move(view).failure();
        journey.views.push_back(view->value);
        journey.text = view->text;
    }
    return journey;
}

}  // namespace

Outcome<Journey> choose_journey(RunOptions const& options, Stage& stage) {
    if (!options.motion.path && (options.view.camera || options.view.eye_m)) return watch(options, stage);
    auto path = path_of(options, stage);
    if (!path) return std::move(path).failure();
    Journey journey{{}, path->rate_hz, fmt::format("--path {} --frames {}", path->name, path->frames.size())};
    for (scene::Camera const& camera : path->frames) {
        auto view = view_of(camera, options.view, "path '" + path->name + "'");
        if (!view) return std::move(view).failure();
        auto ranged = with_range(*view, {}, options.view);
        if (!ranged) return std::move(ranged).failure();
        journey.views.push_back(ranged->value);
        if (journey.views.size() == path->frames.size()) journey.text += ranged->text;
    }
    return journey;
}

Outcome<ChosenLight> choose_light(LightOptions const& options, Stage const& stage, math::View const& view) {
    scene::Light light;
    if (options.sun) {
        light.direction = of_moderate_length(*options.sun);
        return ChosenLight{light, "--sun " + text_of(*options.sun)};
    }
    if (options.point) {
        light.kind = scene::LightKind::point;
        light.position_m = options.point->position_m;
        std::string text = "--point " + text_of(light.position_m);
        if (options.point->range_m) {
            light.range_m = static_cast<float>(*options.point->range_m);
            text += fmt::format(",{}", *options.point->range_m);
        }
        return ChosenLight{light, text};
    }
    std::vector<scene::Light> const& lights = stage.loaded.scene.lights;
    auto const own = [&](std::size_t index) {
        auto const at = static_cast<std::uint32_t>(index);
        return ChosenLight{scene::posed_light(stage.loaded.scene, stage.pose, at), "--light " + name_of(lights, index), at};
    };
    if (options.name) {
        if (auto const found = find_by_name(lights, *options.name)) return own(*found);
        return not_found("--light", *options.name, lights, stage.loaded.scene.notes);
    }
    if (!lights.empty()) return own(0);
    light = scene::auto_light(stage.geometry, view);
    if (light.kind == scene::LightKind::point) return ChosenLight{light, "--point " + text_of(light.position_m)};
    for (int axis = 0; axis < 3; ++axis) light.direction[axis] = std::round(light.direction[axis] * 1e3) / 1e3;
    return ChosenLight{light, "--sun " + text_of(light.direction)};
}

Outcome<ChosenLights> choose_lights(LightOptions const& options, Stage const& stage, math::View const& view) {
    bool const one = options.sun || options.point || options.name;
    ChosenLights lights;
    if (one || stage.loaded.scene.lights.empty()) {
        auto light = choose_light(options, stage, view);
        if (!light) return std::move(light).failure();
        lights.values.push_back(light->value);
        lights.text = light->text;
        if (light->of_scene != scene::none) lights.of_scene = light->of_scene;
        return lights;
    }
    lights.values.resize(stage.loaded.scene.lights.size());
    lights.all_of_scene = true;
    lights.text = fmt::format("all {} lights of the scene", grouped(lights.values.size()));
    move_lights(lights, stage);
    return lights;
}

void move_lights(ChosenLights& lights, Stage const& stage) {
    if (lights.of_scene) lights.values.front() = scene::posed_light(stage.loaded.scene, stage.pose, *lights.of_scene);
    if (!lights.all_of_scene) return;
    for (std::size_t i = 0; i < lights.values.size(); ++i)
        lights.values[i] = scene::posed_light(stage.loaded.scene, stage.pose, static_cast<std::uint32_t>(i));
}

}  // namespace gnomon::command
