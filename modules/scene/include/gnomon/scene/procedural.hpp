#pragma once
// Scenes made by rule: fixed sizes, lights, seeds and views, so that figures can be compared over years and machines.
//
// Every generator is deterministic and uses exact arithmetic or correctly rounded operations only, so the same triangles
// come out everywhere. Named views are cameras of the scene (the first is the one to show), lights are its lights.

#include <gnomon/scene/scene.hpp>

#include <cstdint>
#include <span>
#include <string>
#include <string_view>

namespace gnomon::scene {

struct ProceduralConfig {
    std::string name;             ///< One of `procedural_scenes()`.
    std::uint64_t triangles = 0;  ///< Budget; the nearest size the scene comes in. 0: the scene's own default.
    std::uint32_t blocks = 1;     ///< `city`: copies of the whole city, the first in the middle, the rest round it.
    double offset_m = 0.0;        ///< `sheet`: moved by this along x, y and z.
    std::uint32_t seed = 0;       ///< 0: the scene's fixed seed.
    std::string lights{};         ///< A light set's name, or how many lights. Empty: the scene's first set.
    double moving_percent = 0.0;  ///< `town`: this share of the props moves.
    bool trees = false;           ///< `atrium`: with twelve bare trees of 8,000 triangles in its court.
};

/// Lights that are chosen together.
struct LightSetInfo {
    std::string_view name;
    std::uint32_t lights;
};

/// A flight of the camera that belongs to a scene; `make_path` makes it.
struct PathInfo {
    std::string_view name;
    std::string_view description;  ///< A few words.
    std::uint32_t frames;
    double rate_hz;
};

struct ProceduralInfo {
    std::string_view name;
    std::string_view description;  ///< One line.
    std::uint64_t default_triangles;
    bool takes_triangles = false;
    bool takes_blocks = false;
    bool takes_offset = false;
    bool takes_trees = false;
    double max_moving_percent = 0.0;           ///< 0: the scene does not take it.
    std::span<PathInfo const> paths{};         ///< The first is the one to show.
    std::span<LightSetInfo const> light_sets{};  ///< The first is the default. Empty: the lights are fixed.
    std::uint32_t max_lights = 0;              ///< Any number of lights up to this can be asked for. 0: sets only.
};

/// Every scene that `make_procedural` knows.
[[nodiscard]] std::span<ProceduralInfo const> procedural_scenes() noexcept;

[[nodiscard]] bool is_procedural(std::string_view name) noexcept;

/// returns: the scene, or which value is wrong: an unknown scene or light set (the known ones are listed), a budget or a
///          number of blocks that the scene cannot give, an option that it does not take.
[[nodiscard]] Result<Scene> make_procedural(ProceduralConfig const& config);

}  // namespace gnomon::scene
