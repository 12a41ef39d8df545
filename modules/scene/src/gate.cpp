// `gate`: a house seen through a gate, with an avenue of bare trees between them.

#include "detail/branching.hpp"
#include "detail/generators.hpp"
#include "detail/grid_mesh.hpp"
#include "detail/rail.hpp"
#include "detail/turn.hpp"

#include <array>
#include <vector>

namespace gnomon::scene::detail {

namespace {

using math::dvec3;

// The eye stands at (0, 1.7, 4), the gate at z = 0, the front of the house at z = -76.
constexpr double house_z_m = -76.0;
constexpr double leaf_m = 1.6;       ///< Half the opening between the pillars, which is a leaf's width too.
constexpr double leaf_turns = 0.19;  ///< How far the leaves stand open, towards the house.

/// 2,216 triangles.
constexpr std::array<BranchLevel, 3> avenue_levels{
    {{1, 8, 7, 0.78, 0.0, 0.05, 0.03}, {11, 6, 5, 0.66, 0.15, 0.12, 0.1}, {6, 4, 3, 0.48, 0.13, 0.2, 0.06}}};

void add_pillar(Solid& out, dvec3 const& foot) {
    std::array<Storey, 10> const stone{{{0.62, 0.62, -0.3}, {0.62, 0.62, 0.45}, {0.55, 0.55, 0.52}, {0.5, 0.5, 0.54}, {0.5, 0.5, 1.6},
                                        {0.5, 0.5, 2.7}, {0.64, 0.64, 2.8}, {0.68, 0.68, 2.95}, {0.5, 0.5, 3.1}, {0.3, 0.3, 3.22}}};
    add_stack(out, foot, stone);
    std::vector<Level> ball{{0.16, 3.18}, {0.14, 3.3}};
    for (int i = 0; i <= 8; ++i) {
        SinCos const a = sin_cos(-0.19 + 0.44 * i / 8);
        ball.push_back({i == 8 ? 0.0 : 0.34 * a.cos, 3.62 + 0.34 * a.sin});
    }
    add_lathe(out, foot, ball, 20);
}

/// An upright bar with a point like a spear's.
void add_spear(Solid& out, dvec3 const& foot, double height_m, double radius_m) {
    std::array<Level, 6> const profile{{{radius_m, 0.0}, {radius_m, height_m}, {radius_m * 2.2, height_m + 0.02},
                                        {radius_m * 1.1, height_m + 0.05}, {radius_m * 2.4, height_m + 0.1}, {0.0, height_m + 0.26}}};
    add_lathe(out, foot, profile, 6);
}

/// A spiral of iron in the leaf's plane, winding inwards from `centre` + radius.
void add_scroll(Solid& out, dvec3 const& centre, double radius_m, double start_turns, double winding) {
    constexpr int steps = 22;
    std::vector<dvec3> line;
    for (int i = 0; i <= steps; ++i) {
        double const t = static_cast<double>(i) / steps;
        SinCos const a = sin_cos(start_turns + winding * 1.6 * t);
        line.push_back(centre + dvec3(a.cos, a.sin, 0.0) * (radius_m * (1.0 - 0.75 * t)));
    }
    std::vector<double> const radii(line.size(), 0.012);
    add_tube(out, line, radii, 5);
}

/// A leaf of wrought iron that hangs at x = 0 and reaches to x = leaf_m, higher towards the middle of the gate.
Solid leaf_solid() {
    Solid out;
    constexpr int bars = 12;
    for (int i = 0; i <= bars; ++i) {
        double const t = static_cast<double>(i) / bars;
        double const top_m = 2.1 + 0.55 * t * t;
        add_spear(out, {0.05 + (leaf_m - 0.1) * t, 0.1, 0.0}, top_m, i == 0 || i == bars ? 0.028 : 0.014);
        if (i < bars) add_spear(out, {0.05 + (leaf_m - 0.1) * (t + 0.5 / bars), 0.13, 0.0}, 0.72, 0.01);
    }
    for (double const y : {0.16, 0.86, 1.3, 2.0}) add_box(out, {0.02, y, -0.02}, {leaf_m - 0.02, y + 0.045, 0.02});
    for (int i = 0; i < 4; ++i) {
        double const x = 0.24 + 0.375 * i;
        add_scroll(out, {x, 1.09, 0.0}, 0.17, 0.25, 1.0);
        add_scroll(out, {x, 1.09, 0.0}, 0.17, 0.75, -1.0);
    }
    return out;
}

/// Wall and railing to one side of the gate, from x = 0 to 16.
Solid fence_stone_solid() {
    Solid out;
    for (double const x : {0.0, 8.0}) {
        std::array<Storey, 4> const wall{{{3.9, 0.22, -0.4}, {3.9, 0.22, 0.6}, {3.9, 0.28, 0.66}, {3.88, 0.24, 0.8}}};
        add_stack(out, {x + 4.0, 0.0, 0.0}, wall);
        std::array<Storey, 5> const post{{{0.32, 0.32, -0.4}, {0.32, 0.32, 1.9}, {0.4, 0.4, 1.98}, {0.4, 0.4, 2.1}, {0.06, 0.06, 2.32}}};
        add_stack(out, {x + 8.0, 0.0, 0.0}, post);
    }
    return out;
}

Solid fence_iron_solid() {
    Solid out;
    for (int i = 1; i < 60; ++i)
        if (i % 30 > 1 && i % 30 < 29) add_spear(out, {i * 16.0 / 60.0, 0.75, 0.0}, 0.95, 0.013);
    for (double const y : {0.95, 1.5}) add_box(out, {0.1, y, -0.018}, {15.9, y + 0.04, 0.018});
    return out;
}

void add_gate(Scene& scene) {
    std::uint32_t const stone = add_material(scene, "pillar", {0.40F, 0.36F, 0.29F});
    std::uint32_t const iron = add_material(scene, "iron", {0.045F, 0.05F, 0.055F});
    Solid pillars;
    for (double const side : {-1.0, 1.0}) add_pillar(pillars, {side * (leaf_m + 0.55), 0.0, 0.0});
    add_solid_object(scene, "pillars", pillars, stone);
    std::uint32_t const leaf = add_solid_mesh(scene, "gate leaf", leaf_solid(), iron);
    add_placed_instance(scene, "gate leaf", leaf, turned_by(leaf_turns, {-leaf_m, 0.0, -0.1}));
    add_placed_instance(scene, "gate leaf", leaf, turned_by(0.5 - leaf_turns, {leaf_m, 0.0, -0.1}));
    std::uint32_t const wall = add_solid_mesh(scene, "fence wall", fence_stone_solid(), stone);
    std::uint32_t const rails = add_solid_mesh(scene, "fence", fence_iron_solid(), iron);
    for (double const turns : {0.0, 0.5}) {
        Placement const at = turned_by(turns, {turns == 0.0 ? leaf_m + 1.0 : -leaf_m - 1.0, 0.0, 0.0});
        add_placed_instance(scene, "fence wall", wall, at);
        add_placed_instance(scene, "fence", rails, at);
    }
}

/// A house 18 m wide that faces +z, its front at z = 0.
struct HouseParts {
    Solid walls;
    Solid roof;
    Solid trim;
    Solid glass;
};

void add_window(HouseParts& house, dvec3 const& sill, double width_m, double height_m) {
    double const half = width_m * 0.5;
    add_box(house.glass, sill + dvec3(-half, 0.0, -0.1), sill + dvec3(half, height_m, 0.03));
    for (double const side : {-1.0, 1.0})
        add_box(house.trim, sill + dvec3(side * half - 0.09, 0.0, -0.1), sill + dvec3(side * half + 0.09, height_m, 0.1));
    add_box(house.trim, sill + dvec3(-half - 0.2, -0.16, -0.1), sill + dvec3(half + 0.2, 0.02, 0.16));
    add_box(house.trim, sill + dvec3(-half - 0.15, height_m - 0.02, -0.1), sill + dvec3(half + 0.15, height_m + 0.2, 0.13));
    add_box(house.trim, sill + dvec3(-0.035, 0.02, -0.1), sill + dvec3(0.035, height_m - 0.02, 0.06));
    add_box(house.trim, sill + dvec3(-half, height_m * 0.6, -0.1), sill + dvec3(half, height_m * 0.6 + 0.06, 0.05));
}

/// Steps, columns and a gable before the door.
void add_portico(HouseParts& house) {
    for (int i = 0; i < 4; ++i)
        add_box(house.trim, {-2.9 + 0.02 * i, -0.2, -0.1 - 0.01 * i}, {2.9 - 0.02 * i, 0.15 * (i + 1), 3.0 - 0.3 * i});
    for (double const x : {-2.3, -0.9, 0.9, 2.3}) {
        std::array<Level, 9> const column{{{0.34, 0.58}, {0.34, 0.7}, {0.26, 0.76}, {0.25, 1.4}, {0.235, 2.4}, {0.2, 3.5}, {0.22, 3.56},
                                           {0.33, 3.72}, {0.33, 3.84}}};
        add_lathe(house.trim, {x, 0.0, 1.75}, column, 18);
    }
    add_box(house.trim, {-2.8, 3.82, -0.1}, {2.8, 4.3, 2.2});
    std::array<Ring, 2> const gable{Ring{{-3.0, 4.28, -0.1}, {3.0, 4.28, -0.1}, {0.0, 5.5, -0.1}},
                                    Ring{{-3.0, 4.28, 2.35}, {3.0, 4.28, 2.35}, {0.0, 5.5, 2.35}}};
    add_loft(house.roof, gable);
    add_box(house.glass, {-0.75, 0.58, -0.1}, {0.75, 3.1, 0.06});
    for (double const x : {-0.85, 0.85}) add_box(house.trim, {x - 0.12, 0.5, -0.1}, {x + 0.12, 3.2, 0.15});
    add_box(house.trim, {-1.1, 3.18, -0.1}, {1.1, 3.45, 0.2});
}

HouseParts house_parts() {
    HouseParts house;
    std::array<Storey, 3> const body{{{9.0, 5.5, -0.3}, {9.0, 5.5, 3.7}, {9.0, 5.5, 7.4}}};
    add_stack(house.walls, {0.0, 0.0, -5.5}, body);
    std::array<Storey, 5> const eaves{{{9.1, 5.6, 7.2}, {9.45, 5.95, 7.3}, {9.5, 6.0, 7.5}, {4.6, 0.3, 11.4}, {4.4, 0.12, 11.5}}};
    add_stack(house.roof, {0.0, 0.0, -5.5}, eaves);
    for (double const y : {0.5, 3.75}) {
        std::array<Storey, 2> const band{{{9.08, 5.58, y}, {9.08, 5.58, y + 0.22}}};
        add_stack(house.trim, {0.0, 0.0, -5.5}, band);
    }
    for (int i = -3; i <= 3; ++i) {
        if (i != 0) add_window(house, {i * 2.45, 1.25, 0.0}, 1.15, 1.9);
        if (i != 0) add_window(house, {i * 2.45, 4.7, 0.0}, 1.15, 1.75);
    }
    for (double const x : {-5.6, 5.6}) {  // dormers
        add_box(house.walls, {x - 0.8, 7.4, -2.6}, {x + 0.8, 9.3, -0.7});
        std::array<Ring, 2> const gable{Ring{{x - 1.0, 9.25, -4.4}, {x + 1.0, 9.25, -4.4}, {x, 10.2, -4.4}},
                                        Ring{{x - 1.0, 9.25, -0.5}, {x + 1.0, 9.25, -0.5}, {x, 10.2, -0.5}}};
        add_loft(house.roof, gable);
        add_window(house, {x, 7.95, -0.7}, 0.8, 1.1);
    }
    for (double const x : {-7.0, 7.0}) {  // chimneys
        std::array<Storey, 5> const chimney{{{0.5, 0.7, 7.5}, {0.5, 0.7, 12.2}, {0.6, 0.8, 12.3}, {0.6, 0.8, 12.5}, {0.4, 0.6, 12.55}}};
        add_stack(house.walls, {x, 0.0, -5.5}, chimney);
    }
    add_portico(house);
    return house;
}

void add_house(Scene& scene) {
    HouseParts const house = house_parts();
    std::array<std::uint32_t, 4> const paints{
        add_material(scene, "house walls", {0.50F, 0.38F, 0.24F}), add_material(scene, "house roof", {0.22F, 0.10F, 0.07F}),
        add_material(scene, "house trim", {0.55F, 0.52F, 0.45F}), add_material(scene, "house glass", {0.06F, 0.08F, 0.10F})};
    std::array<Solid const*, 4> const parts{&house.walls, &house.roof, &house.trim, &house.glass};
    for (std::size_t i = 0; i < parts.size(); ++i) {
        std::string const name = scene.materials[paints[i]].name;
        add_instance(scene, name, add_solid_mesh(scene, name, *parts[i], paints[i]), dvec3(1.0), {0.0, 0.0, house_z_m});
    }
}

/// Twelve on each side of the drive, and six more on the lawn, none before the house's front as it is seen from the gate.
void add_avenue(Scene& scene, std::uint64_t seed) {
    Pcg32 random(seed);
    std::uint32_t const bark = add_material(scene, "bark", {0.21F, 0.16F, 0.11F});
    constexpr std::size_t forms = 6;
    std::array<std::uint32_t, forms> trees{};
    for (std::uint32_t& mesh : trees)
        mesh = add_solid_mesh(scene, "tree", grow_tree({9.0, 0.22, 0.28, 0.4, avenue_levels}, random).bark, bark);
    for (int i = 0; i < 30; ++i) {
        double const side = i % 2 == 0 ? -1.0 : 1.0;
        dvec3 at(side * (i < 24 ? 6.2 : 15.0), 0.0, i < 24 ? -9.0 - 4.9 * (i / 2) : -16.0 - 17.0 * ((i - 24) / 2));
        at.x += random.uniform(-0.6, 0.6);
        at.z += random.uniform(-1.0, 1.0);
        double const turns = random.uniform();
        double const scale = random.uniform(0.85, 1.15);
        add_placed_instance(scene, "tree", trees[random.below(forms)], turned_by(turns, at, scale));
    }
}

void add_grounds(Scene& scene) {
    Lattice lawn;
    lawn.cells = math::ivec3(44, 1, 48);
    lawn.lo = dvec3(-60.0, -0.02, -110.0);
    lawn.hi = dvec3(60.0, 1.0, 40.0);
    std::uint32_t const grass = add_material(scene, "lawn", {0.16F, 0.21F, 0.07F});
    add_instance(scene, "lawn", add_mesh(scene, "lawn", plane_mesh(lawn, grass)), dvec3(1.0), dvec3(0.0));
    Lattice drive;
    drive.cells = math::ivec3(2, 1, 32);
    drive.lo = dvec3(-2.2, -0.3, house_z_m + 1.5);
    drive.hi = dvec3(2.2, 0.0, 30.0);
    std::uint32_t const gravel = add_material(scene, "drive", {0.36F, 0.31F, 0.24F});
    add_instance(scene, "drive", add_mesh(scene, "drive", box_mesh(drive, gravel, gravel, true)), dvec3(1.0), dvec3(0.0));
}

constexpr Lens gate_lens{sixty_degrees_rad * 0.75, 0.1, 400.0};

}  // namespace

Result<Scene> make_gate(ProceduralConfig const& config) {
    Scene scene;
    scene.name = "gate";
    add_grounds(scene);
    add_gate(scene);
    add_house(scene);
    add_avenue(scene, seed_of(config, 12345));
    scene.lights.push_back(lamp({46.0, 38.0, 24.0}, 74.0));
    Light sun = sun_light();
    sun.name = "low sun";
    sun.direction = glm::normalize(dvec3(-0.72, -0.25, -0.5));
    scene.lights.push_back(std::move(sun));
    scene.cameras.push_back(view_from("gate", {{0.0, 1.7, 4.0}, {0.0, 2.4, house_z_m}}, gate_lens));
    scene.cameras.push_back(view_from("lawn", {{-24.0, 9.0, 14.0}, {2.0, 2.0, -40.0}}, gate_lens));
    return scene;
}

/// Through the gate and up the drive at 2.4 m/s.
Result<CameraPath> make_gate_path(ProceduralConfig const&, PathInfo const& info) {
    constexpr std::array<Stop, 4> stops{{{{0.0, 1.7, 4.0}, {0.0, 2.4, house_z_m}},
                                         {{0.15, 1.7, -4.0}, {-0.5, 2.6, house_z_m}},
                                         {{-0.15, 1.7, -12.0}, {1.0, 3.0, house_z_m}},
                                         {{0.0, 1.7, -20.0}, {0.0, 3.4, house_z_m}}}};
    return path_along(info, stops, gate_lens);
}

}  // namespace gnomon::scene::detail
