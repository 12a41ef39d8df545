#pragma once
// What a command looks at: where from, along which path, and in which light, each with the words that describe it.

#include "options.hpp"
#include "stage.hpp"

#include <gnomon/math/view.hpp>
#include <gnomon/scene/path.hpp>
#include <gnomon/scene/scene.hpp>

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace gnomon::command {

/// A value and the options that give it again.
template <class T>
struct Described {
    T value;
    std::string text;
};

/// The view asked for; else the first named view of a built-in scene; else one that shows the geometry.
[[nodiscard]] Outcome<Described<math::View>> choose_view(ViewOptions const& options, Stage const& stage);

/// The views of a film.
struct Journey {
    std::vector<math::View> views;
    double rate_hz = 30.0;
    std::string text;
};

/// The path asked for; else, with --eye or --camera, that view while time passes; else the scene's first path, or an
/// orbit round it. Changes the stage's pose, and nothing else of it.
[[nodiscard]] Outcome<Journey> choose_journey(RunOptions const& options, Stage& stage);

struct ChosenLight {
    scene::Light value;
    std::string text;
    std::uint32_t of_scene = scene::none;  ///< Which of the scene's lights; it may move.
};

/// The light asked for, else the scene's first, else a sun, or a lamp where no sun reaches.
[[nodiscard]] Outcome<ChosenLight> choose_light(LightOptions const& options, Stage const& stage,
                                                math::View const& view);

/// What a lighting technique shades under.
struct ChosenLights {
    std::vector<scene::Light> values;
    std::string text;
    std::optional<std::uint32_t> of_scene;  ///< Which of the scene's lights is the only one.
    bool all_of_scene = false;
};

/// All of the scene's lights; else, where one is asked for or the scene has none, that of `choose_light`.
[[nodiscard]] Outcome<ChosenLights> choose_lights(LightOptions const& options, Stage const& stage, math::View const& view);

/// Moves the lights that are the scene's to where the stage's pose has them.
void move_lights(ChosenLights& lights, Stage const& stage);

}  // namespace gnomon::command
