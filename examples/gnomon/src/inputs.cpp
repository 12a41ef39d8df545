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

/// The shortest text that reads back as the same numbers.
std::string text_of(math::dvec3 const& v) { return fmt::format("{},{},{}", v.x, v.y, v.z); }

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
        return usage_error(
            fmt::format("{}: {} is a file, and only built-in scenes take this; leave it out", *options.tuned_by, path));
    auto loaded = scene::load_gltf(path);
    if (!loaded) return failure(loaded.failure().message);
    return LoadedScene{*std::move(loaded), short_name(path), false};
}

/// What to call the thing at `index`: its name, or its number from 1 where the file gives none.
std::string name_of(auto const& things, std::size_t index) {
    return things[index].name.empty() ? std::to_string(index + 1) : things[index].name;
}

std::vector<std::string> names_of(auto const& things) {
    std::vector<std::string> names;
    for (std::size_t i = 0; i < things.size(); ++i) names.push_back(name_of(things, i));
    return names;
}

/// No camera or light of this name: because the file's was left out, or because there never was one.
core::Failure<Exit> not_found(std::string const& option, std::string const& wanted, auto const& things,
                              scene::Notes const& notes) {
    for (std::string const& warning : notes.warnings)
        if (warning.find('\'' + wanted + '\'') != std::string::npos)
            return failure(fmt::format("{} {}: {}; mend the file or choose another", option, wanted,
                                       warning.substr(0, warning.find_last_not_of('.') + 1)));
    return usage_error(fmt::format("{} {}: the scene has none of this name; {}", option, wanted,
                                   suggestion(wanted, names_of(things))));
}

/// Where the thing of this name stands, or of this number counted from 1; a name goes first.
std::optional<std::size_t> find_by_name(auto const& things, std::string const& wanted) {
    for (std::size_t i = 0; i < things.size(); ++i)
        if (things[i].name == wanted) return i;
    auto const number = integer_from(wanted);
    bool const in_range = number && *number >= 1 && static_cast<std::uint64_t>(*number) <= things.size();
    return in_range ? std::optional(static_cast<std::size_t>(*number - 1)) : std::nullopt;
}

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

Outcome<Described<math::View>> view_of_camera(std::vector<scene::Camera> const& cameras, std::size_t index,
                                              ViewOptions const& options) {
    scene::Camera ranged = cameras[index];  // the user's range may mend the file's
    if (options.near_m) ranged.near_m = *options.near_m;
    if (options.far_m) ranged.far_m = *options.far_m;
    auto view = scene::make_view(ranged, options.size_px);
    if (!view)
        return failure(fmt::format("camera '{}': {}; give --near and --far, or --eye and --look",
                                   name_of(cameras, index), view.failure().message));
    return with_range(*view, "--camera " + name_of(cameras, index), options);
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

Outcome<LoadedScene> load_scene(SceneOptions const& options) {
    std::string const& name = options.config.name;
    if (scene::is_procedural(name)) return load_built_in(options);
    if (looks_like_path(name)) return load_file(options);
    std::vector<std::string> known;
    for (scene::ProceduralInfo const& info : scene::procedural_scenes()) known.emplace_back(info.name);
    return usage_error(
        fmt::format("scene '{}': no file and no built-in scene of this name; {}", name, suggestion(name, known)));
}

Outcome<Described<math::View>> choose_view(ViewOptions const& options, LoadedScene const& loaded,
                                           scene::Geometry const& geometry) {
    std::vector<scene::Camera> const& cameras = loaded.scene.cameras;
    if (options.camera) {
        if (auto const found = find_by_name(cameras, *options.camera)) return view_of_camera(cameras, *found, options);
        return not_found("--camera", *options.camera, cameras, loaded.scene.notes);
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
    if (loaded.built_in && !cameras.empty()) return view_of_camera(cameras, 0, options);
    return suggested_view(geometry, options);
}

Outcome<Described<scene::Light>> choose_light(LightOptions const& options, scene::Scene const& scene,
                                             scene::Geometry const& geometry, math::View const& view) {
    scene::Light light;
    if (options.sun) {
        light.direction = of_moderate_length(*options.sun);
        return Described<scene::Light>{light, "--sun " + text_of(*options.sun)};
    }
    if (options.point) {
        light.kind = scene::LightKind::point;
        light.position_m = options.point->position_m;
        std::string text = "--point " + text_of(light.position_m);
        if (options.point->range_m) {
            light.range_m = static_cast<float>(*options.point->range_m);
            text += fmt::format(",{}", *options.point->range_m);
        }
        return Described<scene::Light>{light, text};
    }
    std::vector<scene::Light> const& lights = scene.lights;
    if (options.name) {
        if (auto const found = find_by_name(lights, *options.name))
            return Described<scene::Light>{lights[*found], "--light " + name_of(lights, *found)};
        return not_found("--light", *options.name, lights, scene.notes);
    }
    if (!lights.empty()) return Described<scene::Light>{lights.front(), "--light " + name_of(lights, 0)};
    light = scene::auto_light(geometry, view);
    if (light.kind == scene::LightKind::point)
        return Described<scene::Light>{light, "--point " + text_of(light.position_m)};
    for (int axis = 0; axis < 3; ++axis) light.direction[axis] = std::round(light.direction[axis] * 1e3) / 1e3;
    return Described<scene::Light>{light, "--sun " + text_of(light.direction)};
}

}  // namespace gnomon::command
