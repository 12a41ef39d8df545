// `city` and `rayyard`: boxes on a plane.

#include "detail/generators.hpp"
#include "detail/grid_mesh.hpp"
#include "detail/pcg32.hpp"
#include "detail/turn.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace gnomon::scene::detail {

namespace {

using math::dvec3;
using math::ivec3;
using math::vec3;

/// Muted wall and roof colours, linear.
struct Paint {
    char const* name;
    vec3 walls;
    vec3 roof;
};
constexpr std::array<Paint, 10> paints{{
    {"sand", {0.62F, 0.53F, 0.40F}, {0.36F, 0.33F, 0.30F}},
    {"brick", {0.45F, 0.22F, 0.16F}, {0.28F, 0.25F, 0.24F}},
    {"chalk", {0.70F, 0.69F, 0.65F}, {0.42F, 0.41F, 0.40F}},
    {"slate", {0.24F, 0.29F, 0.34F}, {0.19F, 0.20F, 0.22F}},
    {"olive", {0.36F, 0.38F, 0.26F}, {0.27F, 0.27F, 0.24F}},
    {"rose", {0.58F, 0.40F, 0.36F}, {0.33F, 0.29F, 0.28F}},
    {"sea", {0.27F, 0.40F, 0.42F}, {0.25F, 0.27F, 0.28F}},
    {"ochre", {0.60F, 0.42F, 0.18F}, {0.34F, 0.30F, 0.26F}},
    {"ash", {0.42F, 0.41F, 0.42F}, {0.28F, 0.28F, 0.29F}},
    {"cream", {0.72F, 0.64F, 0.50F}, {0.47F, 0.26F, 0.18F}},
}};

constexpr int city_columns = 36;
constexpr int city_rows = 35;
constexpr double city_side_m = 1000.0;
constexpr int city_ground_quads = 32;
constexpr std::uint64_t city_max_triangles = 12'000'000;

/// How a box's five faces are divided: `across` quads in both level directions, `up` quads in height.
struct Division {
    int across = 1;
    int up = 1;
};

constexpr std::uint64_t box_triangles(Division d) noexcept {
    auto const across = static_cast<std::uint64_t>(d.across);
    return 2 * (4 * across * static_cast<std::uint64_t>(d.up) + across * across);
}

/// The division whose boxes come nearest to `target` triangles each, not too flat and not too tall; the squarer of two.
Division nearest_division(double target) noexcept {
    Division best;
    auto const miss = [&](Division d) { return std::abs(static_cast<double>(box_triangles(d)) - target); };
    for (int across = 1; across <= 64; ++across)
        for (int up = across; up <= 8 * across; ++up)
            if (Division const d{across, up}; miss(d) < miss(best)) best = d;
    return best;
}

/// A mesh of unit boxes for each paint.
std::array<std::uint32_t, paints.size()> add_painted_boxes(Scene& scene, Division division) {
    std::array<std::uint32_t, paints.size()> meshes{};
    Lattice lattice;
    lattice.cells = ivec3(division.across, division.up, division.across);
    for (std::size_t i = 0; i < paints.size(); ++i) {
        std::string const name = paints[i].name;
        std::uint32_t const walls = add_material(scene, name + " walls", paints[i].walls);
        std::uint32_t const roof = add_material(scene, name + " roof", paints[i].roof);
        meshes[i] = add_mesh(scene, name + " box", box_mesh(lattice, walls, roof, false));
    }
    return meshes;
}

/// A square of ground, in square parts so that no object is too large.
struct Ground {
    double side_m;
    int quads;
    int parts;
};

void add_ground(Scene& scene, Ground const& ground, std::uint32_t mesh, dvec3 const& middle_m) {
    double const part_m = ground.side_m / ground.parts;
    for (int z = 0; z < ground.parts; ++z)
        for (int x = 0; x < ground.parts; ++x) {
            dvec3 const at((x + 0.5) * part_m - ground.side_m * 0.5, 0.0, (z + 0.5) * part_m - ground.side_m * 0.5);
            add_instance(scene, "ground", mesh, dvec3(1.0), middle_m + at);
        }
}

std::uint32_t add_ground_mesh(Scene& scene, Ground const& ground, vec3 const& color) {
    double const half_m = ground.side_m / ground.parts * 0.5;
    Lattice lattice;
    lattice.cells = ivec3(ground.quads / ground.parts, 1, ground.quads / ground.parts);
    lattice.lo = dvec3(-half_m, 0.0, -half_m);
    lattice.hi = dvec3(half_m, 1.0, half_m);
    return add_mesh(scene, "ground", plane_mesh(lattice, add_material(scene, "ground", color)));
}

struct Building {
    dvec3 scale;
    dvec3 position_m;
    std::uint32_t paint;
};

std::vector<Building> plan_city(std::uint64_t seed) {
    Pcg32 random(seed);
    std::vector<Building> buildings;
    for (int row = 0; row < city_rows; ++row)
        for (int column = 0; column < city_columns; ++column) {
            Building b;
            b.scale.x = random.uniform(12.0, 20.0);
            b.scale.z = random.uniform(12.0, 20.0);
            b.scale.y = random.uniform(8.0, 78.0);
            b.paint = random.below(static_cast<std::uint32_t>(paints.size()));
            b.position_m = dvec3((column + 0.5) * (city_side_m / city_columns) - city_side_m * 0.5, 0.0,
                                 (row + 0.5) * (city_side_m / city_rows) - city_side_m * 0.5);
            buildings.push_back(b);
        }
    return buildings;
}

/// Place `i` of a square spiral round (0, 0): 0 in the middle, 1-8 round it, 9-24 round those.
math::ivec2 spiral(int i) noexcept {
    if (i == 0) return {0, 0};
    int ring = 1;
    while ((2 * ring + 1) * (2 * ring + 1) <= i) ++ring;
    int const along = i - (2 * ring - 1) * (2 * ring - 1);
    int const side = 2 * ring;
    int const step = along % side;
    switch (along / side) {
        case 0: return {ring, -ring + step};
        case 1: return {ring - step, ring};
        case 2: return {-ring, ring - step};
        default: return {-ring + step, -ring};
    }
}

constexpr double city_near_m = 0.5;
constexpr double city_far_m = 2000.0;

void add_city_views(Scene& scene) {
    scene.cameras.push_back(looking_at("air", {-222.2, 120.0, 420.0}, {-165.0, 0.0, 235.0}, sixty_degrees_rad));
    scene.cameras.push_back(
        looking_at("street", {-222.2, 1.7, -414.3}, dvec3(-222.2, 1.7, -414.3) + dvec3(0.35, 0.06, 1.0), sixty_degrees_rad));
    scene.cameras.push_back(looking_at("far", {-560.0, 420.0, 760.0}, {0.0, 0.0, 40.0}, sixty_degrees_rad * 0.75));
    for (Camera& camera : scene.cameras) {
        camera.near_m = city_near_m;
        camera.far_m = city_far_m;
    }
}

/// Along the middle of the street between two columns of buildings; none reaches within 3.8 m of it.
Camera street_frame(double time_s, double share) {
    dvec3 const eye(10.0 * (city_side_m / city_columns) - city_side_m * 0.5, 1.7, -414.3 + 10.0 * time_s);
    double const yaw = 30.0 * turns_per_degree * sin_cos(2.0 * share).sin;
    dvec3 const ahead = level_direction(-0.25 + yaw);
    return looking_at("", eye, eye + ahead + dvec3(0.0, 0.03, 0.0), sixty_degrees_rad);
}

/// From the view `air` on over the roofs, in a slow bend.
Camera air_frame(double share) {
    double const turn = 45.0 * turns_per_degree;
    double const heading = 0.204 - turn * share;
    // The chord of the bend so far: an arc of 300 m.
    double const radius_m = 300.0 / (turn * 2.0 * pi);
    dvec3 const centre = dvec3(-222.2, 120.0, 420.0) + level_direction(0.204 - 0.25) * radius_m;
    dvec3 const eye = centre - level_direction(heading - 0.25) * radius_m;
    return looking_at("", eye, eye + level_direction(heading) - dvec3(0.0, 0.62, 0.0), sixty_degrees_rad);
}

}  // namespace

Result<CameraPath> make_city_path(ProceduralConfig const& config, PathInfo const& info) {
    (void)config;  // no seed puts a building into a street or above 78 m
    CameraPath path{std::string(info.name), info.rate_hz, {}};
    for (std::uint32_t i = 0; i < info.frames; ++i) {
        double const share = static_cast<double>(i) / info.frames;
        Camera& camera = path.frames.emplace_back(info.name == "street" ? street_frame(i / info.rate_hz, share) : air_frame(share));
        camera.near_m = info.name == "street" ? 0.2 : city_near_m;
        camera.far_m = city_far_m;
    }
    return path;
}

Result<Scene> make_city(ProceduralConfig const& config) {
    constexpr std::uint64_t boxes = city_columns * city_rows;
    constexpr std::uint64_t ground_triangles = 2 * city_ground_quads * city_ground_quads;
    double const per_box =
        (static_cast<double>(config.triangles) - static_cast<double>(ground_triangles)) / static_cast<double>(boxes);
    Division const division = nearest_division(per_box);
    std::uint64_t const block_triangles = ground_triangles + boxes * box_triangles(division);
    if (per_box < 5.0 || config.triangles > city_max_triangles)
        return core::Failure{SceneError::bad_config, "city cannot have " + std::to_string(config.triangles) +
                                                         " triangles; give a budget from 9000 to " +
                                                         std::to_string(city_max_triangles)};
    if (config.blocks < 1 || config.blocks > city_max_triangles / block_triangles)
        return core::Failure{SceneError::bad_config,
                             "city cannot have " + std::to_string(config.blocks) + " blocks of " +
                                 std::to_string(block_triangles) + " triangles; give 1 to " +
                                 std::to_string(city_max_triangles / block_triangles)};
    Scene scene;
    scene.name = "city";
    Ground const ground{city_side_m, city_ground_quads, 2};
    std::uint32_t const ground_mesh = add_ground_mesh(scene, ground, {0.30F, 0.30F, 0.29F});
    auto const meshes = add_painted_boxes(scene, division);
    std::vector<Building> const plan = plan_city(seed_of(config, 12345));
    for (int block = 0; block < static_cast<int>(config.blocks); ++block) {
        math::ivec2 const place = spiral(block);
        dvec3 const middle_m(place.x * city_side_m, 0.0, place.y * city_side_m);
        add_ground(scene, ground, ground_mesh, middle_m);
        for (Building const& b : plan) add_instance(scene, "building", meshes[b.paint], b.scale, middle_m + b.position_m);
    }
    scene.lights.push_back(sun_light());
    add_city_views(scene);
    return scene;
}

Result<Scene> make_rayyard(ProceduralConfig const& config) {
    constexpr int side = 32;
    constexpr double pitch_m = 20.0;
    Ground const ground{660.0, 96, 6};
    double const per_face = (static_cast<double>(config.triangles) - 2.0 * ground.quads * ground.quads) / (side * side * 10);
    if (per_face < 0.5 || per_face > 1024.0)
        return core::Failure{SceneError::bad_config, "rayyard cannot have " + std::to_string(config.triangles) +
                                                         " triangles; give a budget from 25000 to 10000000"};
    int division = 1;
    while (std::abs((division + 1) * (division + 1) - per_face) < std::abs(division * division - per_face)) ++division;
    Scene scene;
    scene.name = "rayyard";
    std::uint32_t const ground_mesh = add_ground_mesh(scene, ground, {0.34F, 0.33F, 0.30F});
    auto const meshes = add_painted_boxes(scene, {division, division});
    add_ground(scene, ground, ground_mesh, dvec3(0.0));
    Pcg32 random(seed_of(config, 12345));
    for (int z = 0; z < side; ++z)
        for (int x = 0; x < side; ++x) {
            dvec3 scale;
            scale.x = random.uniform(6.0, 14.0);
            scale.z = random.uniform(6.0, 14.0);
            scale.y = random.uniform(1.0, 60.0);
            std::uint32_t const paint = random.below(static_cast<std::uint32_t>(paints.size()));
            dvec3 const at((x + 0.5 - side / 2) * pitch_m, 0.0, (z + 0.5 - side / 2) * pitch_m);
            add_instance(scene, "box", meshes[paint], scale, at);
        }
    scene.lights.push_back(lamp({12.3, 220.7, -120.1}, 220.0));
    scene.cameras.push_back(looking_at("yard", {0.7, 1.7, -200.3}, {12.0, 5.0, 0.0}, sixty_degrees_rad));
    return scene;
}

}  // namespace gnomon::scene::detail
