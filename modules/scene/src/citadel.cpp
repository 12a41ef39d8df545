// `citadel`: a walled hill town. Nothing here is closed: what stands on something has no bottom, walls end open inside the
// towers, and stairs have neither bottom nor back, as in many a game's level. From outside it looks solid.

#include "detail/citadel_parts.hpp"
#include "detail/generators.hpp"
#include "detail/pcg32.hpp"
#include "detail/rail.hpp"
#include "detail/turn.hpp"

#include <array>
#include <cmath>

namespace gnomon::scene::detail {

namespace {

using math::dvec3;

constexpr int towers = 8;
constexpr double wall_radius_m = 42.0;
constexpr int pines = 64;

void add_ring_wall(Scene& scene, Stones const& stones) {
    SinCos const half = sin_cos(0.5 / towers);
    double const length_m = 2.0 * wall_radius_m * half.sin - 5.0;
    std::uint32_t const wall = add_wall_mesh(scene, stones, length_m);
    std::uint32_t const plain = add_tower_mesh(scene, stones, false);
    std::uint32_t const roofed = add_tower_mesh(scene, stones, true);
    std::uint32_t const stairs = add_stair_mesh(scene, stones.wall);
    for (int i = 0; i < towers; ++i) {
        double const turns = static_cast<double>(i) / towers;
        add_placed_instance(scene, "tower", i % 2 == 0 ? plain : roofed, on_circle(turns, wall_radius_m, 0.0));
        Placement const middle = on_circle(turns + 0.5 / towers, wall_radius_m * half.cos, 0.0);
        add_placed_instance(scene, "wall", wall, middle);
        if (i % 2 == 1) add_placed_instance(scene, "stairs", stairs, middle);
    }
}

/// Before the wall between the seventh and the eighth tower.
void add_gatehouse(Scene& scene, Stones const& stones) {
    SinCos const half = sin_cos(0.5 / towers);
    add_placed_instance(scene, "gatehouse", add_gatehouse_mesh(scene, stones), on_circle(0.75 + 0.5 / towers, wall_radius_m * half.cos, 0.0));
}

/// A square keep on the hill's top: a great tower with buttresses, windows and four turrets.
void add_keep(Scene& scene, Stones const& stones) {
    Solid body;
    std::array<Storey, 7> const walls{{{8.6, 7.6, -1.0}, {8.2, 7.2, 1.5}, {8.0, 7.0, 2.0}, {8.0, 7.0, 17.0}, {8.5, 7.5, 17.6}, {8.5, 7.5, 19.0}, {8.4, 7.4, 19.1}}};
    add_stack(body, dvec3(0.0), walls, Ends::capped_above);
    for (double const x : {-1.0, 1.0})
        for (double const z : {-1.0, 1.0}) {
            std::array<Level, 7> const turret{{{2.6, -1.0}, {2.3, 2.0}, {2.2, 12.0}, {2.2, 21.0}, {2.6, 21.6}, {2.6, 23.0}, {2.6, 23.1}}};
            add_lathe(body, {x * 8.0, 0.0, z * 7.0}, turret, 28, Ends::capped_above);
        }
    Solid details;
    for (double const x : {-8.0, 8.0})
        for (double const z : {-7.0, 7.0})
            for (int i = 0; i < 9; ++i) {
                Placement at = on_circle(i / 9.0, 2.3, 23.1);
                at.origin += dvec3(x, 0.0, z);
                add_merlon(details, at, 0.5, 0.24);
            }
    Solid windows;
    for (int side = 0; side < 4; ++side) {
        Placement const face = turned_by(0.25 * side, dvec3(0.0));
        double const out_m = side % 2 == 0 ? 7.0 : 8.0;
        for (int i = -3; i <= 3; ++i) {
            Placement at = face;
            at.origin = face.right * (i * 1.5) + face.back * (out_m + 0.3) + dvec3(0.0, 19.05, 0.0);
            add_merlon(details, at, 0.45, 0.25);
        }
        for (double const y : {4.0, 8.5, 13.0})
            for (double const x : {-3.4, 0.0, 3.4}) {
                Placement at = face;
                at.origin = face.right * x + face.back * out_m + dvec3(0.0, y, 0.0);
                add_slit(windows, at, y > 8.0 ? 0.55 : 0.3, y > 8.0 ? 2.2 : 1.6);
                Solid arch;
                add_arch(arch, {{0.0, y > 8.0 ? 2.2 : 1.6, 0.05}, y > 8.0 ? 0.55 : 0.3, y > 8.0 ? 0.85 : 0.5, 0.3, 10});
                add_placed(details, arch, at);
            }
    }
    Mesh mesh;
    add_solid(mesh, body, stones.keep);
    add_solid(mesh, details, stones.wall);
    add_solid(mesh, windows, stones.shadow);
    add_instance(scene, "keep", add_mesh(scene, "keep", std::move(mesh)), dvec3(1.0), {-4.0, 2.0, -4.0});
    Solid roof;
    std::array<Storey, 3> const cap{{{6.6, 5.6, 18.9}, {6.6, 5.6, 20.4}, {2.0, 0.1, 25.0}}};
    add_stack(roof, {-4.0, 2.0, -4.0}, cap, Ends::capped_above);
    add_solid_object(scene, "keep roof", roof, stones.roof);
}

/// Two rings of houses round the keep, gables to the street.
void add_town(Scene& scene, Stones const& stones, std::uint64_t seed) {
    Pcg32 random(seed);
    std::array<std::uint32_t, 3> const houses{add_town_house_mesh(scene, stones, 3.0, 2.3), add_town_house_mesh(scene, stones, 2.4, 2.0),
                                              add_town_house_mesh(scene, stones, 3.6, 2.6)};
    for (int i = 0; i < 34; ++i) {
        bool const outer = i < 20;
        double const turns = outer ? (i + 0.5) / 20.0 : (i - 20 + 0.25) / 14.0;
        double const radius_m = (outer ? 30.5 : 20.5) + random.uniform(-0.8, 0.8);
        std::uint32_t const house = houses[random.below(3)];
        double const askew = random.uniform(-0.02, 0.02);
        if (outer && std::abs(turns - 0.8125) < 0.03) continue;  // the street behind the gate stays free
        add_placed_instance(scene, "house", house, turned_by(turns + 0.25 + askew, level_direction(turns) * radius_m));
    }
}

constexpr std::array<Level, 16> hill_profile{{{150.0, -26.0}, {132.0, -25.6}, {115.0, -25.0}, {100.0, -23.5}, {88.0, -20.5},
                                             {78.0, -16.5}, {69.0, -12.0}, {61.0, -8.0}, {54.0, -4.6}, {48.0, -2.2}, {43.0, -0.6},
                                             {38.0, 0.0}, {28.0, 0.05}, {18.0, 0.6}, {11.0, 1.7}, {0.0, 2.1}}};

/// Rough, but level inside the walls.
double roughness(double x, double z, double radius_m) {
    double const out = smooth_step((radius_m - 44.0) / 22.0);
    return out * (1.6 * sin_cos(x / 31.0).sin * sin_cos(z / 27.0 + 0.1).cos + 0.8 * sin_cos((x - z) / 14.0).sin);
}

double hill_y(double x, double z) {
    double const radius_m = std::sqrt(x * x + z * z);
    std::size_t i = 1;
    while (i + 1 < hill_profile.size() && hill_profile[i].radius_m > radius_m) ++i;
    Level const& out = hill_profile[i - 1];
    Level const& in = hill_profile[i];
    double const t = (out.radius_m - radius_m) / (out.radius_m - in.radius_m);
    return out.y_m + (in.y_m - out.y_m) * t + roughness(x, z, radius_m);
}

/// The hill, by rings round its top; a single sheet.
void add_hill(Scene& scene) {
    Solid hill;
    add_lathe(hill, dvec3(0.0), hill_profile, 128, Ends::open);
    for (dvec3& p : hill.points) p.y += roughness(p.x, p.z, std::sqrt(p.x * p.x + p.z * p.z));
    std::uint32_t const grass = add_material(scene, "hill", {0.22F, 0.24F, 0.11F});
    add_solid_object(scene, "hill", hill, grass);
}

/// Outside the walls, sunk a little into the hill wherever that is.
void add_pines(Scene& scene, std::uint32_t bark, std::uint64_t seed) {
    Pcg32 random(seed + 1);
    std::uint32_t const pine = add_pine_mesh(scene, add_material(scene, "needles", {0.08F, 0.15F, 0.07F}), bark);
    for (int i = 0; i < pines; ++i) {
        double const turns = random.uniform();
        double const radius_m = random.uniform(60.0, 112.0);
        double const scale = random.uniform(0.8, 1.4);
        if (std::abs(turns - 0.8125) < 0.05) continue;  // the way up to the gate stays free
        dvec3 at = level_direction(turns) * radius_m;
        at.y = hill_y(at.x, at.z) - 0.2;
        add_placed_instance(scene, "pine", pine, turned_by(turns, at, scale));
    }
}

constexpr Lens citadel_lens{sixty_degrees_rad * 0.75, 0.3, 800.0};

}  // namespace

Result<Scene> make_citadel(ProceduralConfig const& config) {
    Scene scene;
    scene.name = "citadel";
    Stones const stones{add_material(scene, "wall", {0.40F, 0.36F, 0.29F}),    add_material(scene, "tower", {0.45F, 0.40F, 0.31F}),
                        add_material(scene, "keep", {0.48F, 0.44F, 0.37F}),    add_material(scene, "tiles", {0.30F, 0.12F, 0.07F}),
                        add_material(scene, "plaster", {0.54F, 0.48F, 0.37F}), add_material(scene, "timber", {0.14F, 0.09F, 0.06F}),
                        add_material(scene, "shadow", {0.03F, 0.03F, 0.035F})};
    add_hill(scene);
    add_ring_wall(scene, stones);
    add_gatehouse(scene, stones);
    add_keep(scene, stones);
    add_town(scene, stones, seed_of(config, 12345));
    add_pines(scene, stones.timber, seed_of(config, 12345));
    scene.lights.push_back(lamp({-60.0, 85.0, 95.0}, 135.0));
    scene.lights.back().name = "point";
    scene.lights.push_back(sun_light());
    scene.cameras.push_back(view_from("hill", {{38.0, 34.0, 98.0}, {-1.0, 2.0, -2.0}}, citadel_lens));
    scene.cameras.push_back(view_from("street", {{21.0, 2.6, 24.5}, {-4.0, 10.0, -6.0}}, citadel_lens));
    scene.cameras.push_back(view_from("above", {{-52.0, 62.0, 58.0}, {0.0, 0.0, 0.0}}, citadel_lens));
    return scene;
}

/// A third of the way round the walls, then in over them to the keep.
Result<CameraPath> make_citadel_path(ProceduralConfig const&, PathInfo const& info) {
    std::array<Stop, 9> stops{};
    for (std::size_t i = 0; i < stops.size(); ++i) {
        double const t = static_cast<double>(i) / static_cast<double>(stops.size() - 1);
        double const radius_m = 104.0 - 72.0 * smooth_step(t);
        stops[i].eye_m = level_direction(0.81 + 0.36 * t) * radius_m + dvec3(0.0, 26.0 + 12.0 * t, 0.0);
        stops[i].target_m = dvec3(-4.0 * t, 4.0 + 8.0 * t, -4.0 * t);
    }
    return path_along(info, stops, citadel_lens);
}

}  // namespace gnomon::scene::detail
