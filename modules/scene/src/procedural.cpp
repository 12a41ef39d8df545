#include <gnomon/scene/procedural.hpp>

#include "detail/generators.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <optional>

namespace gnomon::scene {

namespace {

using core::Failure;
using detail::Generator;

/// In alphabetical order.
constexpr std::array generators{
    Generator{{.name = "atrium",
               .description = "two storeys of arcades round a court, 40x25x20 m; --trees; --lights sponza65, million or a number",
               .default_triangles = 250'000,
               .takes_trees = true,
               .paths = detail::atrium_paths,
               .light_sets = detail::atrium_lights,
               .max_lights = detail::atrium_million},
              detail::make_atrium,
              detail::make_atrium_path},
    Generator{{.name = "cage",
               .description = "a bird cage on a table under one lamp: thin bars that overlap; views A, B, C",
               .default_triangles = 12'000},
              detail::make_cage},
    Generator{{.name = "citadel",
               .description = "a walled hill town with towers, stairs and a keep; its closed-looking objects have open edges",
               .default_triangles = 60'000,
               .paths = detail::citadel_paths},
              detail::make_citadel,
              detail::make_citadel_path},
    Generator{{.name = "city",
               .description = "1260 buildings on a square kilometre, 8-78 m high; --triangles 52000, 254000, 1010000; "
                              "--blocks up to 10M",
               .default_triangles = 254'000,
               .takes_triangles = true,
               .takes_blocks = true,
               .paths = detail::city_paths},
              detail::make_city,
              detail::make_city_path},
    Generator{{.name = "cubes",
               .description = "999 turned cubes floating over a slab under one lamp: many overlapping shadow edges; views "
                              "A, B, C",
               .default_triangles = 12'000},
              detail::make_cubes},
    Generator{{.name = "forest",
               .description = "100 trees in leaf on both sides of a trail; the leaves are alpha-masked and double-sided",
               .default_triangles = 600'000,
               .paths = detail::forest_paths},
              detail::make_forest,
              detail::make_forest_path},
    Generator{{.name = "fuzzy",
               .description = "a cloud of 400,000 single triangles of 0.1 m, 40x20x40 m, over a plane under one lamp",
               .default_triangles = 400'000,
               .paths = detail::fuzzy_paths},
              detail::make_fuzzy,
              detail::make_fuzzy_path},
    Generator{{.name = "gate",
               .description = "a house 80 m away behind an avenue of bare trees, seen through a gate 4 m away; lamp, low sun",
               .default_triangles = 88'000,
               .paths = detail::gate_paths},
              detail::make_gate,
              detail::make_gate_path},
    Generator{{.name = "houses",
               .description = "1000 equal houses on a grid, with rooms inside, and 256 lights; --triangles 60000, 1010000",
               .default_triangles = 1'010'000,
               .takes_triangles = true,
               .paths = detail::houses_paths},
              detail::make_houses,
              detail::make_houses_path},
    Generator{{.name = "necropolis",
               .description = "a walled city of tombs with a large hall, 40 spirits and balls of fire; --triangles up to "
                              "2580000",
               .default_triangles = 600'000,
               .takes_triangles = true,
               .paths = detail::necropolis_paths,
               .light_sets = detail::necropolis_lights,
               .max_lights = 376},
              detail::make_necropolis,
              detail::make_necropolis_path},
    Generator{{.name = "poles",
               .description = "400 poles, 4-16 cm thick and 3-8 m high, with thin wires, in the sun",
               .default_triangles = 96'000,
               .paths = detail::poles_paths},
              detail::make_poles,
              detail::make_poles_path},
    Generator{{.name = "rayyard",
               .description = "1024 boxes, 1-60 m high, under one high lamp, for exact shadow rays; --triangles 59000, "
                              "274000, 1040000",
               .default_triangles = 274'000,
               .takes_triangles = true},
              detail::make_rayyard},
    Generator{{.name = "robots",
               .description = "eleven robots roll up and down a street of facades under 924 lights, or 11 that they carry",
               .default_triangles = 180'000,
               .paths = detail::robots_paths,
               .light_sets = detail::robots_lights},
              detail::make_robots,
              detail::make_robots_path},
    Generator{{.name = "sheet",
               .description = "a watertight sheet of 256x256 points with exact heights under one lamp; --offset 0, 8192, "
                              "131072",
               .default_triangles = 130'050,
               .takes_offset = true},
              detail::make_sheet},
    Generator{{.name = "town",
               .description = "400 buildings, a church among them, and 3000 lamps, fences, bare trees, people and cars on "
                              "gentle hills; --moving 0 to 20",
               .default_triangles = 500'000,
               .max_moving_percent = 20.0,
               .paths = detail::town_paths},
              detail::make_town,
              detail::make_town_path},
    Generator{{.name = "tree",
               .description = "a large bare tree on a slab under one lamp: branches that overlap; views A, B, C",
               .default_triangles = 40'000},
              detail::make_tree},
};

constexpr std::array<ProceduralInfo, generators.size()> infos = [] {
    std::array<ProceduralInfo, generators.size()> all{};
    for (std::size_t i = 0; i < all.size(); ++i) all[i] = generators[i].info;
    return all;
}();

template <class Named>
std::string names_of(Named const& things) {
    std::string names;
    for (auto const& thing : things) names += (names.empty() ? "" : ", ") + std::string(thing.name);
    return names;
}

Failure<SceneError> bad(std::string message) { return {SceneError::bad_config, std::move(message)}; }

Generator const* find(std::string_view name) noexcept {
    auto const* const found =
        std::find_if(generators.begin(), generators.end(), [&](Generator const& g) { return g.info.name == name; });
    return found == generators.end() ? nullptr : found;
}

Failure<SceneError> unknown(std::string const& name) {
    return bad("there is no built-in scene '" + name + "'; the built-in ones are " + names_of(infos));
}

/// A positive whole number and nothing else.
std::optional<std::uint32_t> count_from(std::string const& text) {
    std::uint32_t count = 0;
    auto const [end, error] = std::from_chars(text.data(), text.data() + text.size(), count);
    bool const whole = error == std::errc() && end == text.data() + text.size() && count > 0;
    return whole ? std::optional(count) : std::nullopt;
}

/// The name of the set that `lights` means, or a number of lights.
Result<std::string> choose_lights(ProceduralInfo const& info, std::string const& lights) {
    std::string const scene(info.name);
    if (lights.empty()) return info.light_sets.empty() ? std::string() : std::string(info.light_sets.front().name);
    if (info.light_sets.empty())
        return bad(scene + " has only the lights it has; leave out the lights '" + lights + "'");
    for (LightSetInfo const& set : info.light_sets)
        if (set.name == lights || std::to_string(set.lights) == lights) return std::string(set.name);
    auto const count = count_from(lights);
    if (count && *count <= info.max_lights) return std::to_string(*count);
    std::string const range = info.max_lights == 0 ? "" : " or a number from 1 to " + std::to_string(info.max_lights);
    return bad(scene + " has no lights '" + lights + "'; give " + names_of(info.light_sets) + range);
}

/// The configuration with its defaults filled in, or what is wrong with it.
Result<ProceduralConfig> complete(ProceduralConfig const& config, ProceduralInfo const& info) {
    if (config.triangles != 0 && !info.takes_triangles && config.triangles != info.default_triangles)
        return bad(config.name + " always has " + std::to_string(info.default_triangles) +
                   " triangles; leave out the budget of " + std::to_string(config.triangles));
    if (config.blocks != 1 && !info.takes_blocks)
        return bad(config.name + " comes in one block; leave out the " + std::to_string(config.blocks) + " blocks");
    if (!(config.offset_m == 0.0) && !info.takes_offset)
        return bad(config.name + " stands at the origin; leave out the offset of " + std::to_string(config.offset_m) + " m");
    if (!(config.moving_percent >= 0.0 && config.moving_percent <= info.max_moving_percent))
        return bad("in " + config.name + ' ' + std::to_string(config.moving_percent) + " % cannot move; give " +
                   (info.max_moving_percent > 0.0 ? "0 to " + std::to_string(info.max_moving_percent) : "0"));
    if (config.trees && !info.takes_trees) return bad(config.name + " has the trees it has; leave out the others");
    auto lights = choose_lights(info, config.lights);
    if (!lights) return std::move(lights).failure();
    ProceduralConfig full = config;
    full.lights = *std::move(lights);
    if (full.triangles == 0) full.triangles = info.default_triangles;
    return full;
}

}  // namespace

std::span<ProceduralInfo const> procedural_scenes() noexcept { return infos; }

bool is_procedural(std::string_view name) noexcept { return find(name) != nullptr; }

Result<Scene> make_procedural(ProceduralConfig const& config) {
    Generator const* const generator = find(config.name);
    if (generator == nullptr) return unknown(config.name);
    auto const full = complete(config, generator->info);
    if (!full) return full.failure();
    return generator->make(*full);
}

std::span<PathInfo const> procedural_paths(std::string_view scene) noexcept {
    Generator const* const generator = find(scene);
    return generator == nullptr ? std::span<PathInfo const>() : generator->info.paths;
}

Result<CameraPath> make_path(ProceduralConfig const& config, std::string_view path) {
    Generator const* const generator = find(config.name);
    if (generator == nullptr) return unknown(config.name);
    auto const full = complete(config, generator->info);
    if (!full) return full.failure();
    for (PathInfo const& info : generator->info.paths)
        if (info.name == path) return generator->path(*full, info);
    std::string const known = generator->info.paths.empty() ? "; it has none" : "; it has " + names_of(generator->info.paths);
    return bad(config.name + " has no path '" + std::string(path) + '\'' + known);
}

}  // namespace gnomon::scene
