#include "stage.hpp"

#include "find_by_name.hpp"
#include "values.hpp"

#include <gnomon/scene/load.hpp>
#include <gnomon/scene/procedural.hpp>

#include <fmt/format.h>

#include <filesystem>

namespace gnomon::command {

namespace {

/// Whether the text can only mean a file.
bool looks_like_path(std::string const& text) {
    std::error_code ignored;
    return text.find('/') != std::string::npos || text.ends_with(".glb") || text.ends_with(".gltf") ||
           std::filesystem::exists(text, ignored);
}

Outcome<LoadedScene> load_built_in(SceneOptions const& options) {
    scene::ProceduralConfig const& config = options.config;
    if (options.file_scene)
        return usage_error(fmt::format("--file-scene {}: {} is a built-in scene, and only files hold several; leave it out",
                                       *options.file_scene, config.name));
    auto made = scene::make_procedural(config);
    if (!made) return usage_error(made.failure().message);
    std::string text = config.name;
    if (config.triangles != 0) text += fmt::format(" --triangles {}", config.triangles);
    if (config.blocks != 1) text += fmt::format(" --blocks {}", config.blocks);
    if (config.offset_m != 0.0) text += fmt::format(" --offset {:.10g}", config.offset_m);
    if (config.seed != 0) text += fmt::format(" --seed {}", config.seed);
    if (!config.lights.empty()) text += fmt::format(" --lights {}", config.lights);
    if (config.trees) text += " --trees";
    if (config.moving_percent != 0.0) text += fmt::format(" --moving {:.10g}", config.moving_percent);
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
    scene::LoadConfig config;
    std::string text = short_name(path);
    if (options.file_scene) {
        auto const number = integer_from(*options.file_scene);
        bool const counts = number && *number >= 1 && *number < scene::none;
        if (counts) config.scene_index = static_cast<std::uint32_t>(*number - 1);
        if (!counts) config.scene_name = *options.file_scene;
        text += " --file-scene " + *options.file_scene;
    }
    auto loaded = scene::load_gltf(path, config);
    if (!loaded) return failure(loaded.failure().message);
    return LoadedScene{*std::move(loaded), text, false};
}

/// returns: the clip that plays; `none` where the scene has none.
Outcome<std::uint32_t> choose_clip(scene::Scene const& scene, MotionOptions const& motion) {
    if (!motion.clip) return scene.animations.empty() ? scene::none : std::uint32_t{0};
    if (auto const found = find_by_name(scene.animations, *motion.clip)) return static_cast<std::uint32_t>(*found);
    return not_found("--clip", *motion.clip, scene.animations, scene.notes);
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

std::string Stage::text() const {
    std::string text;
    if (clip.time_s != 0.0) text += fmt::format(" --time {}", clip.time_s);
    if (moves() && clip.clip != 0) text += " --clip " + name_of(loaded.scene.animations, clip.clip);
    return text;
}

Outcome<Stage> set_stage(SceneOptions const& options, MotionOptions const& motion) {
    auto loaded = load_scene(options);
    if (!loaded) return std::move(loaded).failure();
    auto clip = choose_clip(loaded->scene, motion);
    if (!clip) return std::move(clip).failure();
    Stage stage;
    stage.loaded = *std::move(loaded);
    stage.clip.time_s = *clip == scene::none ? 0.0 : motion.time_s;  // What does not move is the same at any time.
    stage.clip.clip = *clip;
    scene::pose_at(stage.loaded.scene, stage.clip, stage.pose);
    stage.geometry = scene::flatten(stage.loaded.scene, stage.pose);
    return stage;
}

void move_to(Stage& stage, double time_s) {
    stage.clip.time_s = time_s;
    scene::pose_at(stage.loaded.scene, stage.clip, stage.pose);
    scene::update(stage.geometry, stage.loaded.scene, stage.pose);
}

}  // namespace gnomon::command
