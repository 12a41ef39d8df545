#pragma once
// The generators behind `make_procedural`, and what they share.

#include <gnomon/scene/path.hpp>

#include <array>
#include <cstdint>
#include <string>

namespace gnomon::scene::detail {

/// A procedural scene: what it is, and who makes it and its paths. procedural.cpp has the table.
struct Generator {
    ProceduralInfo info;
    Result<Scene> (*make)(ProceduralConfig const& config);
    Result<CameraPath> (*path)(ProceduralConfig const& config, PathInfo const& path) = nullptr;
};

inline constexpr double path_rate_hz = 30.0;
inline constexpr std::array<PathInfo, 2> city_paths{{
    {"street", "at 10 m/s along a street, looking left and right", 300, path_rate_hz},
    {"air", "at 30 m/s over the roofs, 120 m up", 300, path_rate_hz},
}};
inline constexpr std::array<PathInfo, 3> town_paths{{
    {"street", "at 15 m/s along a street", 150, path_rate_hz},
    {"spin", "on the spot, 210 degrees a second", 150, path_rate_hz},
    {"both", "along the street, spinning", 150, path_rate_hz},
}};

inline constexpr std::array<PathInfo, 2> atrium_paths{{
    {"fly", "through the galleries and up across the court", 300, path_rate_hz},
    {"still", "the view `still`, without moving", 300, path_rate_hz},
}};
inline constexpr std::uint32_t atrium_million = 1'048'576;
inline constexpr std::array<LightSetInfo, 3> atrium_lights{{{"sun", 1}, {"sponza65", 65}, {"million", atrium_million}}};
inline constexpr std::array<PathInfo, 1> citadel_paths{{{"fly", "round the walls and in over them to the keep", 300, path_rate_hz}}};
inline constexpr std::array<PathInfo, 1> forest_paths{{{"walk", "along the trail at 1.5 m/s", 300, path_rate_hz}}};
inline constexpr std::array<PathInfo, 1> fuzzy_paths{{{"walk", "up to the cloud and along its front", 300, path_rate_hz}}};
inline constexpr std::array<PathInfo, 1> gate_paths{{{"pass", "through the gate and up the drive at 2.4 m/s", 300, path_rate_hz}}};
inline constexpr std::array<PathInfo, 1> poles_paths{{{"walk", "between two rows at 1.6 m/s", 300, path_rate_hz}}};
inline constexpr std::array<PathInfo, 1> houses_paths{{{"zoom", "from 300 m away through a front door", 300, path_rate_hz}}};
inline constexpr std::array<PathInfo, 1> robots_paths{{{"bart", "down the street over the robots' heads", 300, 5.0}}};
inline constexpr std::array<PathInfo, 1> necropolis_paths{{{"map", "from far off through the gate into the hall", 600, path_rate_hz}}};
inline constexpr std::array<LightSetInfo, 2> robots_lights{{{"many", 924}, {"few", 11}}};
inline constexpr std::array<LightSetInfo, 2> necropolis_lights{{{"all", 376}, {"static", 275}}};

/// expects: the name fits, the budget is not 0, `lights` is empty only where there are no sets to choose from, options
///          that the scene does not take are at their defaults.
Result<Scene> make_atrium(ProceduralConfig const& config);
Result<CameraPath> make_atrium_path(ProceduralConfig const& config, PathInfo const& path);
Result<Scene> make_city(ProceduralConfig const& config);
Result<CameraPath> make_city_path(ProceduralConfig const& config, PathInfo const& path);
Result<Scene> make_cage(ProceduralConfig const& config);
Result<Scene> make_citadel(ProceduralConfig const& config);
Result<CameraPath> make_citadel_path(ProceduralConfig const& config, PathInfo const& path);
Result<Scene> make_cubes(ProceduralConfig const& config);
Result<Scene> make_forest(ProceduralConfig const& config);
Result<CameraPath> make_forest_path(ProceduralConfig const& config, PathInfo const& path);
Result<Scene> make_fuzzy(ProceduralConfig const& config);
Result<CameraPath> make_fuzzy_path(ProceduralConfig const& config, PathInfo const& path);
Result<Scene> make_gate(ProceduralConfig const& config);
Result<CameraPath> make_gate_path(ProceduralConfig const& config, PathInfo const& path);
Result<Scene> make_houses(ProceduralConfig const& config);
Result<CameraPath> make_houses_path(ProceduralConfig const& config, PathInfo const& path);
Result<Scene> make_necropolis(ProceduralConfig const& config);
Result<CameraPath> make_necropolis_path(ProceduralConfig const& config, PathInfo const& path);
Result<Scene> make_poles(ProceduralConfig const& config);
Result<CameraPath> make_poles_path(ProceduralConfig const& config, PathInfo const& path);
Result<Scene> make_rayyard(ProceduralConfig const& config);
Result<Scene> make_robots(ProceduralConfig const& config);
Result<CameraPath> make_robots_path(ProceduralConfig const& config, PathInfo const& path);
Result<Scene> make_sheet(ProceduralConfig const& config);
Result<Scene> make_tree(ProceduralConfig const& config);
Result<Scene> make_town(ProceduralConfig const& config);
Result<CameraPath> make_town_path(ProceduralConfig const& config, PathInfo const& path);

inline constexpr double pi = 3.14159265358979323846;
inline constexpr double sixty_degrees_rad = pi / 3.0;

/// A plain, rough, non-metallic material of a linear colour.
inline std::uint32_t add_material(Scene& scene, std::string name, math::vec3 const& color) {
    Material material;
    material.name = std::move(name);
    material.base_color = math::vec4(color.x, color.y, color.z, 1.0F);
    material.metallic = 0.0F;
    material.roughness = 0.9F;
    scene.materials.push_back(std::move(material));
    return static_cast<std::uint32_t>(scene.materials.size() - 1);
}

inline std::uint32_t add_mesh(Scene& scene, std::string name, Mesh mesh) {
    mesh.name = std::move(name);
    scene.meshes.push_back(std::move(mesh));
    return static_cast<std::uint32_t>(scene.meshes.size() - 1);
}

inline void add_instance(Scene& scene, std::string name, std::uint32_t mesh, math::dvec3 const& scale,
                         math::dvec3 const& position_m) {
    Instance instance;
    instance.name = std::move(name);
    instance.mesh = mesh;
    for (int axis = 0; axis < 3; ++axis) {
        instance.world_from_mesh[axis][axis] = scale[axis];
        instance.world_from_mesh[3][axis] = position_m[axis];
    }
    scene.instances.push_back(std::move(instance));
}

inline Light sun_light() {
    Light sun;
    sun.name = "sun";
    sun.kind = LightKind::directional;
    sun.direction = glm::normalize(math::dvec3(-0.45, -0.8, -0.4));
    sun.intensity = 3.0F;
    return sun;
}

/// A lamp without range that lights a facing surface `reach_m` away about as the sun does.
inline Light lamp(math::dvec3 const& position_m, double reach_m) {
    Light light;
    light.name = "lamp";
    light.kind = LightKind::point;
    light.position_m = position_m;
    light.intensity = static_cast<float>(3.0 * reach_m * reach_m);
    return light;
}

inline std::uint64_t seed_of(ProceduralConfig const& config, std::uint64_t fixed) noexcept {
    return config.seed == 0 ? fixed : config.seed;
}

}  // namespace gnomon::scene::detail
