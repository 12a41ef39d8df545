#include <gnomon/scene/procedural.hpp>

#include "detail/generators.hpp"

#include <algorithm>
#include <array>

namespace gnomon::scene {

namespace {

using core::Failure;

constexpr std::array<ProceduralInfo, 4> infos{{
    {"city", "1260 buildings on a square kilometre, 8-78 m high; --triangles 52000, 254000, 1010000; --blocks up to 10M",
     254'000, true, true, false},
    {"cubes", "999 turned cubes floating over a slab under one lamp: many overlapping shadow edges; views A, B, C", 12'000,
     false, false, false},
    {"rayyard", "1024 boxes, 1-60 m high, under one high lamp, for exact shadow rays; --triangles 59000, 274000, 1040000",
     274'000, true, false, false},
    {"sheet", "a watertight sheet of 256x256 points with exact heights under one lamp; --offset 0, 8192, 131072", 130'050,
     false, false, true},
}};

std::string known_names() {
    std::string names;
    for (ProceduralInfo const& info : infos) names += (names.empty() ? "" : ", ") + std::string(info.name);
    return names;
}

Failure<SceneError> bad(std::string message) { return {SceneError::bad_config, std::move(message)}; }

ProceduralInfo const* find(std::string_view name) noexcept {
    auto const* const found =
        std::find_if(infos.begin(), infos.end(), [&](ProceduralInfo const& info) { return info.name == name; });
    return found == infos.end() ? nullptr : found;
}

}  // namespace

std::span<ProceduralInfo const> procedural_scenes() noexcept { return infos; }

bool is_procedural(std::string_view name) noexcept { return find(name) != nullptr; }

Result<Scene> make_procedural(ProceduralConfig const& config) {
    ProceduralInfo const* const info = find(config.name);
    if (info == nullptr)
        return bad("there is no built-in scene '" + config.name + "'; the built-in ones are " + known_names());
    if (config.triangles != 0 && !info->takes_triangles && config.triangles != info->default_triangles)
        return bad(config.name + " always has " + std::to_string(info->default_triangles) +
                   " triangles; leave out the budget of " + std::to_string(config.triangles));
    if (config.blocks != 1 && !info->takes_blocks)
        return bad(config.name + " comes in one block; leave out the " + std::to_string(config.blocks) + " blocks");
    if (!(config.offset_m == 0.0) && !info->takes_offset)
        return bad(config.name + " stands at the origin; leave out the offset of " + std::to_string(config.offset_m) + " m");
    ProceduralConfig full = config;
    if (full.triangles == 0) full.triangles = info->default_triangles;
    if (config.name == "city") return detail::make_city(full);
    if (config.name == "cubes") return detail::make_cubes(full);
    if (config.name == "rayyard") return detail::make_rayyard(full);
    return detail::make_sheet(full);
}

}  // namespace gnomon::scene
