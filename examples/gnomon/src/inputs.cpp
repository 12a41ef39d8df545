#include "inputs.hpp"

#include "values.hpp"

#include <gnomon/scene/load.hpp>
#include <gnomon/scene/procedural.hpp>
#include <gnomon/scene/suggest.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>

namespace gnomon::command {

namespace {

constexpr double pi = 3.14159265358979323846;

std::string text_of(math::dvec3 const& v) { return fmt::format("{:.7g},{:.7g},{:.7g}", v.x, v.y, v.z); }

/// Whether the text can only mean a file.
bool looks_like_path(std::string const& text) {
    std::error_code ignored;
    return text.find('/') != std::string::npos || text.ends_with(".glb") || text.ends_with(".gltf") ||
           std::filesystem::exists(text, ignored);
}

Outcome<LoadedScene> load_built_in(SceneOptions const& options) {
    scene::ProceduralConfig const& config = options.config;
    auto made = scene::make_procedural(config);
    if (!made) return usage_error(made.failure().message);
    std::string text = config.name;
    if (config.triangles != 0) text += fmt::format(" --triangles {}", config.triangles);
    if (config.blocks != 1) text += fmt::format(" --blocks {}", config.blocks);
    if (config.offset_m != 0.0) text += fmt::format(" --offset {:.10g}", config.offset_m);
    if (config.seed != 0) text += fmt::format(" --seed {}", config.seed);
    return LoadedScene{*std::move(made), text, true};
}

/// "scene.glb" alone says little: the folder's name goes with it.
std::string short_name(std::string const& path) {
    std::filesystem::path const file(path);
    std::string const folder = file.parent_path().filename().string();
    return folder.empty() || folder == "." || folder == ".." ? file.filename().string()
                                                             : folder + '/' + file.filename().string();
}

Outcome<LoadedScene> load_file(SceneOptions const& options) {
    std::string const& path = options.config.name;
    if (options.tuned_by)
        return usage_error(fmt::format("{}: {} is a file, and only built-in scenes take this; leave it out",
                                       *options.tuned_by, path));
    auto loaded = scene::load_gltf(path);
    if (!loaded) return failure(loaded.failure().message);
    return LoadedScene{*std::move(loaded), short_name(path), false};
}

std::vector<std::string> names_of(auto const& things) {
    std::vector<std::string> names;
    for (auto const& thing : things) names.push_back(thing.name);
    return names;
}

/// Near and far as the user wants them, whatever gave the view.
Outcome<Described<math::View>> with_range(math::View view, std::string text, ViewOptions const& options) {
    if (options.near_m) view.near_m = *options.near_m;
    if (options.far_m) view.far_m = *options.far_m;
    if (!(view.near_m < view.far_m))
        return usage_error(fmt::format("--near {:g} and --far {:g} m: near must be less than far", view.near_m, view.far_m));
    if (options.near_m) text += fmt::format(" --near {:g}", view.near_m);
    if (options.far_m) text += fmt::format(" --far {:g}", view.far_m);
    return Described<math::View>{view, text + fmt::format(" --size {}x{}", view.size_px.x, view.size_px.y)};
}

Outcome<Described<math::View>> view_at(math::PerspectiveConfig const& config, ViewOptions const& options) {
    auto view = math::make_perspective(config);
    if (!view) return usage_error(view.failure().message);
    return with_range(*view, fmt::format("--eye {} --look {} --fov {:.4g}", text_of(config.eye_m), text_of(config.target_m),
                                         config.fov_y_rad * 180.0 / pi), options);
}

Outcome<Described<math::View>> view_of_camera(scene::Camera const& camera, ViewOptions const& options) {
    scene::Camera ranged = camera;  // the user's range may mend the file's
    if (options.near_m) ranged.near_m = *options.near_m;
    if (options.far_m) ranged.far_m = *options.far_m;
    auto view = scene::make_view(ranged, options.size_px);
    if (!view) return failure(fmt::format("camera '{}': {}; give --near and --far, or --eye and --look", camera.name,
                                          view.failure().message));
    return with_range(*view, "--camera " + camera.name, options);
}

/// Where the given --eye and --look leave the near plane open: close enough for what is looked at.
double near_for(math::dvec3 const& eye_m, math::dvec3 const& look_m) {
    constexpr double usual_m = 0.1;
    return std::min(usual_m, glm::length(look_m - eye_m) * 1e-3);
}

}  // namespace

Outcome<LoadedScene> load_scene(SceneOptions const& options) {
    std::string const& name = options.config.name;
    if (scene::is_procedural(name)) return load_built_in(options);
    if (looks_like_path(name)) return load_file(options);
    std::vector<std::string> known;
    for (scene::ProceduralInfo const& info : scene::procedural_scenes()) known.emplace_back(info.name);
    return usage_error(fmt::format("scene '{}': no file and no built-in scene of this name; {}", name, suggestion(name, known)));
}

Outcome<Described<math::View>> choose_view(ViewOptions const& options, LoadedScene const& loaded,
                                           scene::Geometry const& geometry) {
    std::vector<scene::Camera> const& cameras = loaded.scene.cameras;
    if (options.camera) {
        auto const found = std::find_if(cameras.begin(), cameras.end(),
                                        [&](scene::Camera const& camera) { return camera.name == *options.camera; });
        if (found != cameras.end()) return view_of_camera(*found, options);
        return usage_error(fmt::format("--camera {}: the scene has no such camera; {}", *options.camera,
                                       suggestion(*options.camera, names_of(cameras))));
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
    if (loaded.built_in && !cameras.empty()) return view_of_camera(cameras.front(), options);
    scene::SuggestedView const suggested = scene::auto_view(geometry);
    config.eye_m = suggested.eye_m;
    config.target_m = suggested.target_m;
    config.fov_y_rad = suggested.fov_y_rad;
    config.near_m = suggested.near_m;
    return view_at(config, options);
}

Outcome<Described<scene::Light>> choose_light(LightOptions const& options, scene::Scene const& scene) {
    scene::Light light;
    if (options.sun) {
        light.direction = *options.sun;
        return Described<scene::Light>{light, "--sun " + text_of(*options.sun)};
    }
    if (options.point) {
        light.kind = scene::LightKind::point;
        light.position_m = options.point->position_m;
        std::string text = "--point " + text_of(light.position_m);
        if (options.point->range_m) {
            light.range_m = static_cast<float>(*options.point->range_m);
            text += fmt::format(",{:g}", *options.point->range_m);
        }
        return Described<scene::Light>{light, text};
    }
    std::vector<scene::Light> const& lights = scene.lights;
    if (options.name) {
        auto const found = std::find_if(lights.begin(), lights.end(),
                                        [&](scene::Light const& candidate) { return candidate.name == *options.name; });
        if (found != lights.end()) return Described<scene::Light>{*found, "--light " + found->name};
        return usage_error(fmt::format("--light {}: the scene has no such light; {}", *options.name,
                                       suggestion(*options.name, names_of(lights))));
    }
    if (!lights.empty()) return Described<scene::Light>{lights.front(), "--light " + lights.front().name};
    light = scene::default_sun();
    return Described<scene::Light>{light, "--sun " + text_of(light.direction)};
}

}  // namespace gnomon::command
