#pragma once
// What a command looks at: the scene, where from, and in which light, each with the words that describe it.

#include "options.hpp"

#include <gnomon/math/view.hpp>
#include <gnomon/scene/flatten.hpp>
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

/// A view or a light, and the options that give it again.
template <class T>
struct Described {
    T value;
    std::string text;
};

/// The view asked for; else the first named view of a built-in scene; else one that shows the geometry.
[[nodiscard]] Outcome<Described<math::View>> choose_view(ViewOptions const& options, LoadedScene const& loaded,
                                                         scene::Geometry const& geometry);

/// The light asked for, else the scene's first, else a sun, or a lamp where no sun reaches.
[[nodiscard]] Outcome<Described<scene::Light>> choose_light(LightOptions const& options, scene::Scene const& scene,
                                                           scene::Geometry const& geometry, math::View const& view);

}  // namespace gnomon::command
