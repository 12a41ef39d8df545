#pragma once
// The scene at a time: what was loaded, how it is posed, and its triangles there.

#include "options.hpp"

#include <gnomon/scene/flatten.hpp>
#include <gnomon/scene/pose.hpp>
#include <gnomon/scene/scene.hpp>

#include <string>

namespace gnomon::command {

struct LoadedScene {
    scene::Scene scene;
    std::string text;  ///< "city --triangles 52000", "sponza/scene.glb".
    bool built_in = false;
};

/// A built-in scene by name, or a glTF file.
[[nodiscard]] Outcome<LoadedScene> load_scene(SceneOptions const& options);

struct Stage {
    LoadedScene loaded;
    scene::PoseConfig clip;  ///< Which animation plays, and the time that the stage is at.
    scene::Pose pose;
    scene::Geometry geometry;

    [[nodiscard]] bool moves() const noexcept { return clip.clip != scene::none; }
    /// The options that give the pose again: " --time 1.5", or nothing for a scene at rest.
    [[nodiscard]] std::string text() const;
};

/// Loads the scene and poses it at `motion.time_s`.
[[nodiscard]] Outcome<Stage> set_stage(SceneOptions const& options, MotionOptions const& motion);

/// Moves everything to another time, in the same memory.
void move_to(Stage& stage, double time_s);

}  // namespace gnomon::command
