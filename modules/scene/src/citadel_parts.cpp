#include "detail/citadel_parts.hpp"

#include "detail/generators.hpp"
#include "detail/turn.hpp"

#include <algorithm>
#include <array>
#include <vector>

namespace gnomon::scene::detail {

using math::dvec3;

/// A merlon: a block with a sloped cap and no bottom.
void add_merlon(Solid& out, Placement const& at, double half_x_m, double half_z_m) {
    Solid part;
    std::array<Storey, 4> const block{{{half_x_m, half_z_m, -0.02}, {half_x_m, half_z_m, 0.85}, {half_x_m + 0.05, half_z_m + 0.05, 0.9},
                                       {half_x_m * 0.4, half_z_m * 0.3, 1.1}}};
    add_stack(part, dvec3(0.0), block, Ends::capped_above);
    add_placed(out, part, at);
}

namespace {

/// A stone that carries an overhang: a wedge that is open where it meets the wall, at z = 0.
void add_corbel(Solid& out, Placement const& at) {
    Solid part;
    std::array<Ring, 3> const rings{Ring{{-0.16, -1.0, 0.0}, {0.16, -1.0, 0.0}, {0.16, 0.0, 0.0}, {-0.16, 0.0, 0.0}},
                                    Ring{{-0.16, -0.75, 0.2}, {0.16, -0.75, 0.2}, {0.16, 0.0, 0.2}, {-0.16, 0.0, 0.2}},
                                    Ring{{-0.16, -0.3, 0.55}, {0.16, -0.3, 0.55}, {0.16, 0.0, 0.55}, {-0.16, 0.0, 0.55}}};
    add_loft(part, rings, Ends::capped_above);
    add_placed(out, part, at);
}

}  // namespace

/// A dark slot in a wall that faces z' at the placement's origin: its face, and four sides that go into the wall.
void add_slit(Solid& out, Placement const& at, double half_m, double height_m) {
    Solid part;
    std::array<Ring, 2> const rings{Ring{{-half_m, 0.0, -0.3}, {half_m, 0.0, -0.3}, {half_m, height_m, -0.3}, {-half_m, height_m, -0.3}},
                                    Ring{{-half_m, 0.0, 0.03}, {half_m, 0.0, 0.03}, {half_m, height_m, 0.03}, {-half_m, height_m, 0.03}}};
    add_loft(part, rings, Ends::capped_above);
    add_placed(out, part, at);
}

/// On a circle of this radius, facing out, at `turns`.
Placement on_circle(double turns, double radius_m, double y_m) {
    return turned_by(turns + 0.25, level_direction(turns) * radius_m + dvec3(0.0, y_m, 0.0));
}

/// A round tower whose foot goes down the hill, with slits, corbels and merlons; some have a cone for a roof.
std::uint32_t add_tower_mesh(Scene& scene, Stones const& stones, bool has_roof) {
    Solid shaft;
    std::array<Level, 9> const profile{{{4.9, -9.0}, {4.2, -2.0}, {3.9, 0.5}, {3.8, 4.0}, {3.75, 8.0}, {3.75, citadel_tower_m - 2.0},
                                        {4.3, citadel_tower_m - 1.9}, {4.3, citadel_tower_m - 0.9}, {4.3, citadel_tower_m}}};
    add_lathe(shaft, dvec3(0.0), profile, 56, Ends::capped_above);
    Solid details;
    for (int i = 0; i < 24; ++i) add_corbel(details, on_circle(i / 24.0, 3.72, citadel_tower_m - 1.85));
    for (int i = 0; i < 14; ++i) add_merlon(details, on_circle(i / 14.0, 4.0, citadel_tower_m), 0.58, 0.3);
    Solid slits;
    for (int i = 0; i < 6; ++i)
        for (double const y : {1.5, 6.0, 10.0}) add_slit(slits, on_circle(i / 6.0 + 0.02 * y, y < 4.0 ? 3.83 : 3.74, y), 0.13, 1.3);
    Mesh mesh;
    add_solid(mesh, shaft, stones.tower);
    add_solid(mesh, details, stones.wall);
    add_solid(mesh, slits, stones.shadow);
    if (has_roof) {
        Solid roof;
        std::array<Level, 5> const cone{{{3.2, citadel_tower_m - 0.02}, {3.2, citadel_tower_m + 1.6}, {3.9, citadel_tower_m + 1.5}, {2.0, citadel_tower_m + 4.6}, {0.0, citadel_tower_m + 7.4}}};
        add_lathe(roof, dvec3(0.0), cone, 32, Ends::open);
        add_solid(mesh, roof, stones.roof);
    }
    return add_mesh(scene, "tower", std::move(mesh));
}

/// The curtain wall between two towers, along x, outside to z': a section with a batter, a walk and two parapets.
std::uint32_t add_wall_mesh(Scene& scene, Stones const& stones, double length_m) {
    constexpr int stations = 12;
    double const half = length_m * 0.5;
    std::vector<Ring> rings;
    for (int i = 0; i <= stations; ++i) {
        double const x = half - length_m * i / stations;  // towards -x, so that the section runs counter-clockwise
        rings.push_back({{x, -9.0, -1.6}, {x, 0.0, -1.5}, {x, citadel_wall_m, -1.4}, {x, citadel_wall_m + 0.5, -1.4}, {x, citadel_wall_m + 0.5, -1.15},
                         {x, citadel_wall_m, -1.15}, {x, citadel_wall_m, 1.1}, {x, citadel_wall_m + 0.9, 1.1}, {x, citadel_wall_m + 0.9, 1.6}, {x, citadel_wall_m - 0.4, 1.6},
                         {x, citadel_wall_m - 0.5, 1.35}, {x, 3.0, 1.5}, {x, -2.0, 2.0}, {x, -9.0, 3.2}});
    }
    for (Ring& ring : rings) std::reverse(ring.begin(), ring.end());
    Solid wall;
    add_loft(wall, rings, Ends::open);
    Solid details;
    int const merlons = static_cast<int>(length_m / 1.5);
    for (int i = 0; i < merlons; ++i)
        add_merlon(details, turned_by(0.0, {(i + 0.5) * (length_m / merlons) - half, citadel_wall_m + 0.9, 1.35}), 0.45, 0.24);
    int const corbels = static_cast<int>(length_m / 1.2);
    for (int i = 0; i < corbels; ++i) {
        Placement at = turned_by(0.0, {(i + 0.5) * (length_m / corbels) - half, citadel_wall_m - 0.36, 1.3});
        at.up = dvec3(0.0, 0.8, 0.0);
        at.back = dvec3(0.0, 0.0, 0.5);
        add_corbel(details, at);
    }
    Solid slits;
    for (int i = -2; i <= 2; ++i) add_slit(slits, turned_by(0.0, {i * 5.0, 4.0, 1.46}), 0.12, 1.2);
    Mesh mesh;
    add_solid(mesh, wall, stones.wall);
    add_solid(mesh, details, stones.tower);
    add_solid(mesh, slits, stones.shadow);
    return add_mesh(scene, "wall", std::move(mesh));
}

/// Steps up to the walk along the inside of a wall: only their tops, fronts and one side; the wall hides the rest.
std::uint32_t add_stair_mesh(Scene& scene, std::uint32_t material) {
    Solid stairs;
    constexpr int steps = 36;
    for (int i = 0; i < steps; ++i) {
        double const x = -7.0 + 0.35 * i;
        double const y = citadel_wall_m * (i + 1) / steps;
        auto const base = static_cast<std::uint32_t>(stairs.points.size());
        for (double const z : {-2.8, -1.35})
            for (dvec3 const& p : {dvec3(x, y - citadel_wall_m / steps, z), dvec3(x, y, z), dvec3(x + 0.35, y, z), dvec3(x + 0.35, -0.5, z), dvec3(x, -0.5, z)})
                stairs.points.push_back(p);
        auto const quad = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d) {
            stairs.triangles.push_back({base + a, base + b, base + c});
            stairs.triangles.push_back({base + a, base + c, base + d});
        };
        quad(0, 5, 6, 1);  // front
        quad(1, 6, 7, 2);  // top
        quad(4, 1, 2, 3);  // the side towards the town
    }
    return add_solid_mesh(scene, "stairs", stairs, material);
}

/// A house of the town: half-timbered, with a gable roof that overhangs, open at its eaves.
std::uint32_t add_town_house_mesh(Scene& scene, Stones const& stones, double half_x_m, double half_z_m) {
    double const eaves_m = half_x_m > 2.6 ? 4.6 : 3.2;
    double const ridge_m = eaves_m + half_z_m * 1.1;
    Solid walls;
    std::array<Ring, 2> const shell{Ring{{-half_x_m, -1.0, half_z_m}, {-half_x_m, -1.0, -half_z_m}, {-half_x_m, eaves_m, -half_z_m}, {-half_x_m, ridge_m, 0.0}, {-half_x_m, eaves_m, half_z_m}},
                                    Ring{{half_x_m, -1.0, half_z_m}, {half_x_m, -1.0, -half_z_m}, {half_x_m, eaves_m, -half_z_m}, {half_x_m, ridge_m, 0.0}, {half_x_m, eaves_m, half_z_m}}};
    add_loft(walls, shell);
    Solid roof;
    for (double const side : {-1.0, 1.0}) {
        dvec3 const low(0.0, eaves_m - 0.45, side * (half_z_m + 0.45));
        dvec3 const high(0.0, ridge_m + 0.12, 0.0);
        dvec3 const along((half_x_m + 0.4) * side, 0.0, 0.0);
        dvec3 const thick(0.0, 0.16, 0.0);
        for (int row = 0; row < 8; ++row) {  // rows of tiles, each a little over the next lower one
            dvec3 const from = low + (high - low) * (row / 8.0);
            dvec3 const to = low + (high - low) * ((row + 1) / 8.0 + 0.02);
            dvec3 const tilt(0.0, 0.07, 0.0);
            std::array<Ring, 2> const slope{Ring{from + along + tilt, from - along + tilt, from - along + thick, from + along + thick},
                                            Ring{to + along, to - along, to - along + thick - tilt, to + along + thick - tilt}};
            add_loft(roof, slope, row == 0 ? Ends::capped : Ends::open);
        }
    }
    Solid timber;
    for (double const side : {-1.0, 1.0}) {
        double const z = side * half_z_m;
        for (int i = 0; i <= 4; ++i) {
            double const x = half_x_m * (i * 0.5 - 1.0);
            add_box(timber, {x - 0.09, -0.5, z - 0.06}, {x + 0.09, eaves_m, z + 0.06}, Ends::open);
        }
        for (double const y : {1.9, eaves_m - 0.25}) add_box(timber, {-half_x_m - 0.05, y, z - 0.07}, {half_x_m + 0.05, y + 0.18, z + 0.07}, Ends::open);
    }
    add_box(timber, {half_x_m * 0.4, ridge_m - 1.0, -0.3}, {half_x_m * 0.4 + 0.6, ridge_m + 0.9, 0.3}, Ends::capped_above);
    Solid openings;
    for (int side = 0; side < 4; side += 2)
        for (double const x : {-0.55, 0.0, 0.55}) {
            Placement at = turned_by(0.25 * side, dvec3(0.0));
            at.origin = at.right * (x * half_x_m) + at.back * half_z_m + dvec3(0.0, x == 0.0 ? 0.0 : 1.0, 0.0);
            add_slit(openings, at, x == 0.0 ? 0.42 : 0.32, x == 0.0 ? 1.8 : 0.75);
        }
    Mesh mesh;
    add_solid(mesh, walls, stones.plaster);
    add_solid(mesh, roof, stones.roof);
    add_solid(mesh, timber, stones.timber);
    add_solid(mesh, openings, stones.shadow);
    return add_mesh(scene, "house", std::move(mesh));
}

/// A gatehouse before the wall that faces +x +z: two half towers and a passage with an arch, without floor or back.
std::uint32_t add_gatehouse_mesh(Scene& scene, Stones const& stones) {
    Solid body;
    for (double const x : {-4.6, 4.6}) {
        std::array<Level, 6> const profile{{{3.2, -9.0}, {2.7, -1.0}, {2.5, 1.0}, {2.45, 11.0}, {2.8, 11.3}, {2.8, 12.6}}};
        add_lathe(body, {x, 0.0, 2.4}, profile, 28, Ends::capped_above);
    }
    add_spandrel(body, {{0.0, 3.2, 2.6}, 2.0, 2.4, 3.0, 24}, 2.8, 11.4);
    Solid stone;
    add_arch(stone, {{0.0, 3.2, 4.1}, 1.95, 2.4, 0.4, 24});
    for (double const x : {-2.17, 2.17}) add_box(stone, {x - 0.2, -0.4, 3.9}, {x + 0.2, 3.25, 4.3}, Ends::open);
    for (double const x : {-4.6, 4.6})
        for (int i = 0; i < 9; ++i) {
            Placement at = on_circle(i / 9.0, 2.55, 12.6);
            at.origin += dvec3(x, 0.0, 2.4);
            add_merlon(stone, at, 0.5, 0.25);
        }
    for (int i = -1; i <= 1; ++i) add_merlon(stone, turned_by(0.0, {i * 1.4, 11.4, 3.8}), 0.45, 0.25);
    Solid gate;
    for (int i = -4; i <= 4; ++i) add_box(gate, {i * 0.44 - 0.06, 0.0, 3.0}, {i * 0.44 + 0.06, 5.2, 3.12}, Ends::open);
    for (int i = 0; i < 9; ++i) add_box(gate, {-2.0, 0.5 + 0.52 * i, 2.98}, {2.0, 0.6 + 0.52 * i, 3.14}, Ends::open);
    Mesh mesh;
    add_solid(mesh, body, stones.tower);
    add_solid(mesh, stone, stones.wall);
    add_solid(mesh, gate, stones.timber);
    return add_mesh(scene, "gatehouse", std::move(mesh));
}

/// A pine: four tiers of needles, open below, on a trunk without ends.
std::uint32_t add_pine_mesh(Scene& scene, std::uint32_t needles, std::uint32_t bark) {
    Solid crown;
    std::array<Level, 8> const tiers{{{1.9, 1.3}, {0.6, 3.2}, {1.6, 3.0}, {0.5, 4.9}, {1.25, 4.7}, {0.4, 6.3}, {0.85, 6.1}, {0.0, 8.2}}};
    add_lathe(crown, dvec3(0.0), tiers, 12, Ends::open);
    Solid trunk;
    std::array<Level, 2> const stem{{{0.26, -1.5}, {0.2, 2.6}}};
    add_lathe(trunk, dvec3(0.0), stem, 8, Ends::open);
    Mesh mesh;
    add_solid(mesh, crown, needles);
    add_solid(mesh, trunk, bark);
    return add_mesh(scene, "pine", std::move(mesh));
}

}  // namespace gnomon::scene::detail
