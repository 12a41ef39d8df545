#include "detail/facade.hpp"
#include "detail/town.hpp"

#include <algorithm>

namespace gnomon::scene::detail {

namespace {

using math::dvec2;
using math::dvec3;

constexpr double foundation_m = 2.0;
constexpr double eaves_m = 0.45;  ///< Overhang.

/// What all kinds of building are made from.
struct Site {
    SolidBuilder out;
    TownPaints const& paints;
    Pcg32& random;
    std::uint32_t wall = 0;
    std::uint32_t roof = 0;
    std::uint32_t door = 0;

    Site(TownPaints const& p, Pcg32& r) : paints(p), random(r) {
        wall = paints.walls[random.below(static_cast<std::uint32_t>(paints.walls.size()))];
        roof = paints.roofs[random.below(static_cast<std::uint32_t>(paints.roofs.size()))];
        door = paints.doors[random.below(static_cast<std::uint32_t>(paints.doors.size()))];
    }
};

/// Floors of equal height with a row of windows each, over a plinth.
struct Floors {
    dvec2 half;             ///< Half the width (x) and depth (z).
    int count = 2;
    double height = 2.9;
    double sill = 0.9;      ///< Above the floor.
    double head = 2.3;
    Openings front{3, 1.2};
    Openings side{2, 1.0};
    bool door = true;       ///< The front's middle opening on the ground floor.
};

Facade body_of(Site const& site, Floors const& floors) {
    Facade f;
    f.lo = dvec3(-floors.half.x, -foundation_m, -floors.half.y);
    f.hi = dvec3(floors.half.x, floors.count * floors.height + 0.25, floors.half.y);
    f.material = site.wall;
    f.top_material = site.paints.stone;
    f.heights.push_back(0.2);
    for (int floor = 0; floor < floors.count; ++floor) {
        f.heights.push_back(floor * floors.height + floors.sill);
        f.heights.push_back(floor * floors.height + floors.head);
    }
    for (std::size_t wall = 0; wall < 4; ++wall) {
        bool const front = wall % 2 == 0;
        Openings const& openings = front ? floors.front : floors.side;
        if (openings.count > 0) f.axes[wall] = window_axes(2.0 * (front ? floors.half.x : floors.half.y), openings);
    }
    clear_recesses(f);
    for (std::size_t wall = 0; wall < 4; ++wall)
        for (int floor = 0; floor < floors.count; ++floor)
            for (int i = 0; i < (wall % 2 == 0 ? floors.front.count : floors.side.count); ++i)
                set_recess(f, wall, {2 * i + 1, 2 * floor + 2}, site.paints.glass);
    if (floors.door)
        for (int row = 1; row <= 2; ++row) set_recess(f, 0, {2 * (floors.front.count / 2) + 1, row}, site.door);
    return f;
}

/// The middle of the front's opening `i`.
double opening_x(Floors const& floors, int i) noexcept {
    return ((i + 0.5) / floors.front.count * 2.0 - 1.0) * floors.half.x;
}

/// A roof of two slopes, as a bent plate over a body with a gable; the ridge runs along x or z.
void add_gable_roof(Site& site, dvec2 const& half, double eaves_y, double ridge_y, bool along_x) {
    double const across = along_x ? half.y : half.x;
    double const along = (along_x ? half.x : half.y) + eaves_m * 0.7;
    double const drop = (ridge_y - eaves_y) / across * eaves_m;
    constexpr double thick = 0.22;
    constexpr double sunk = 0.06;  // into the body below
    std::array<dvec2, 6> const plate{{{-across - eaves_m, eaves_y - drop - sunk},
                                      {0.0, ridge_y - sunk},
                                      {across + eaves_m, eaves_y - drop - sunk},
                                      {across + eaves_m, eaves_y - drop + thick},
                                      {0.0, ridge_y + thick},
                                      {-across - eaves_m, eaves_y - drop + thick}}};
    site.out.prism(along_x ? Plane::zy : Plane::xy, plate, {-along, along}, site.roof);
}

/// A roof of four slopes over a rectangle that overhangs.
void add_hip_roof(Site& site, dvec2 const& half, double eaves_y, double height) {
    dvec2 const h = half + dvec2(eaves_m);
    double const ridge = std::max(0.3, h.x - h.y);
    double const lo = eaves_y - 0.15;
    double const hi = eaves_y + 0.15;
    std::array<dvec3, 4> const low{{{-h.x, lo, h.y}, {h.x, lo, h.y}, {h.x, lo, -h.y}, {-h.x, lo, -h.y}}};
    std::array<dvec3, 4> const high{{{-h.x, hi, h.y}, {h.x, hi, h.y}, {h.x, hi, -h.y}, {-h.x, hi, -h.y}}};
    dvec3 const left(-ridge, eaves_y + height, 0.0);
    dvec3 const right(ridge, eaves_y + height, 0.0);
    for (std::size_t i = 0; i < 4; ++i) site.out.quad(low[i], low[(i + 1) % 4], high[(i + 1) % 4], high[i], site.paints.trim);
    site.out.quad(low[3], low[2], low[1], low[0], site.paints.trim);
    site.out.quad(high[0], high[1], right, left, site.roof);
    site.out.triangle(high[1], high[2], right, site.roof);
    site.out.quad(high[2], high[3], left, right, site.roof);
    site.out.triangle(high[3], high[0], left, site.roof);
}

void add_chimney(Site& site, dvec2 const& at, double from_y, double to_y) {
    site.out.box({at.x - 0.35, from_y, at.y - 0.35}, {at.x + 0.35, to_y, at.y + 0.35}, site.paints.walls[1]);
    site.out.box({at.x - 0.42, to_y - 0.18, at.y - 0.42}, {at.x + 0.42, to_y + 0.06, at.y + 0.42}, site.paints.stone);
}

/// Steps and a little roof before a door in the front.
void add_porch(Site& site, double x, double front_z) {
    site.out.box({x - 0.9, -1.0, front_z - 0.3}, {x + 0.9, 0.1, front_z + 1.1}, site.paints.stone);
    site.out.box({x - 1.1, -1.0, front_z - 0.4}, {x + 1.1, -0.08, front_z + 1.5}, site.paints.stone);
    std::array<dvec2, 3> const hood{{{-1.1, 2.45}, {1.1, 2.45}, {0.0, 3.0}}};
    std::array<dvec2, 3> moved = hood;
    for (dvec2& p : moved) p.x += x;
    site.out.prism(Plane::xy, moved, {front_z - 0.3, front_z + 1.0}, site.roof);
    for (double const side : {-0.95, 0.95})
        site.out.box({x + side - 0.07, 0.0, front_z + 0.75}, {x + side + 0.07, 2.6, front_z + 0.89}, site.paints.trim);
}

/// A shutter on each side of the upper front windows.
void add_shutters(Site& site, Floors const& floors, int floor) {
    double const z = floors.half.y;
    for (int i = 0; i < floors.front.count; ++i)
        for (double const side : {-1.0, 1.0}) {
            double const x = opening_x(floors, i) + side * (floors.front.width * 0.5 + 0.26);
            site.out.box({x - 0.22, floor * floors.height + floors.sill - 0.05, z - 0.05},
                         {x + 0.22, floor * floors.height + floors.head + 0.05, z + 0.06}, site.door);
        }
}

void add_dormer(Site& site, double x, double eaves_y, double front_z) {
    double const z = front_z - 1.6;
    site.out.box({x - 0.75, eaves_y - 0.3, z - 2.0}, {x + 0.75, eaves_y + 1.75, z + 0.6}, site.wall);
    site.out.box({x - 0.45, eaves_y + 0.75, z + 0.3}, {x + 0.45, eaves_y + 1.6, z + 0.66}, site.paints.glass);
    std::array<dvec2, 3> const cap{{{x - 1.0, eaves_y + 1.68}, {x + 1.0, eaves_y + 1.68}, {x, eaves_y + 2.45}}};
    site.out.prism(Plane::xy, cap, {z - 2.4, z + 0.85}, site.roof);
}

void make_cottage(Site& site) {
    Floors floors;
    floors.half.y = site.random.uniform(4.0, 4.8);
    floors.half.x = site.random.uniform(4.6, 6.2);
    floors.count = site.random.below(3) == 0 ? 1 : 2;
    floors.front = {3, 1.15};
    floors.side = {site.random.below(4) == 0 ? 2 : 1, 1.0};
    Facade body = body_of(site, floors);
    bool const along_x = site.random.below(4) != 0;
    body.top = along_x ? Top::gable_along_x : Top::gable_along_z;
    double const across = along_x ? floors.half.y : floors.half.x;
    body.ridge = body.hi.y + across * site.random.uniform(0.65, 0.85);
    // One floor still makes 6 m.
    if (body.ridge < 6.0) body.ridge = 6.0;
    add_facade(site.out, body);
    add_gable_roof(site, floors.half, body.hi.y, body.ridge, along_x);
    add_porch(site, opening_x(floors, 1), floors.half.y);
    dvec2 const chimney = along_x ? dvec2(site.random.uniform(-0.7, 0.7) * floors.half.x, -0.9) : dvec2(-0.9, -0.6 * floors.half.y);
    add_chimney(site, chimney, body.hi.y, body.ridge + 0.75);
    if (floors.count == 2 && site.random.below(2) == 0) add_shutters(site, floors, 1);
    if (along_x && site.random.below(3) == 0) add_dormer(site, opening_x(floors, 0), body.hi.y, floors.half.y);
    if (site.random.below(2) == 0) {
        // A garage at the side, with a lean roof.
        double const x = floors.half.x;
        std::array<dvec2, 4> const shed{{{x - 0.3, -foundation_m}, {x + 3.2, -foundation_m}, {x + 3.2, 2.3}, {x - 0.3, 3.1}}};
        site.out.prism(Plane::xy, shed, {-2.6, 3.0}, site.wall);
        std::array<dvec2, 4> const lid{{{x - 0.2, 3.0}, {x + 3.5, 2.15}, {x + 3.5, 2.35}, {x - 0.2, 3.25}}};
        site.out.prism(Plane::xy, lid, {-2.8, 3.3}, site.roof);
        site.out.box({x + 0.4, -0.9, 2.7}, {x + 2.8, 2.0, 3.05}, site.door);
    }
}

void make_terrace(Site& site) {
    Floors floors;
    floors.half.y = site.random.uniform(5.0, 6.0);
    floors.half.x = site.random.uniform(5.4, 7.2);
    floors.count = 3;
    floors.height = 3.2;
    floors.head = 2.6;
    floors.front = {3, 1.5};
    floors.side = {0, 1.0};
    Facade body = body_of(site, floors);
    double const z = floors.half.y;
    bool const gable = site.random.below(3) == 0;
    if (gable) body.top = Top::gable_along_x;
    body.ridge = body.hi.y + floors.half.y * 0.55;
    add_facade(site.out, body);
    if (gable)
        add_gable_roof(site, floors.half, body.hi.y, body.ridge, true);
    else
        add_hip_roof(site, floors.half, body.hi.y, site.random.uniform(2.2, 3.4));
    // A cornice over the shop, an awning, sills.
    site.out.box({-floors.half.x - 0.05, 2.95, z - 0.2}, {floors.half.x + 0.05, 3.2, z + 0.18}, site.paints.trim);
    std::array<dvec2, 4> const awning{{{z - 0.1, 2.75}, {z + 1.5, 2.3}, {z + 1.5, 2.4}, {z - 0.1, 2.95}}};
    site.out.prism(Plane::zy, awning, {-floors.half.x + 0.6, floors.half.x - 0.6}, site.door);
    for (int floor = 1; floor < 3; ++floor)
        for (int i = 0; i < 3; ++i) {
            double const x = opening_x(floors, i);
            double const y = floor * floors.height + floors.sill;
            site.out.box({x - 0.9, y - 0.16, z - 0.1}, {x + 0.9, y - 0.02, z + 0.14}, site.paints.trim);
        }
    add_chimney(site, {floors.half.x * 0.6, -0.8}, body.hi.y - 0.2, body.hi.y + 3.6);
    site.out.box({-0.8, -1.0, z - 0.3}, {0.8, 0.08, z + 0.7}, site.paints.stone);
}

void make_flats(Site& site) {
    Floors floors;
    floors.half.y = site.random.uniform(5.2, 6.2);
    floors.half.x = site.random.uniform(7.4, 8.6);
    floors.count = 4 + static_cast<int>(site.random.below(2));
    floors.height = 3.1;
    floors.sill = 0.7;
    floors.head = 2.4;
    floors.front = {3, 2.6};
    floors.side = {1, 1.6};
    Facade body = body_of(site, floors);
    body.top_material = site.paints.stone;
    add_facade(site.out, body);
    double const top = body.hi.y;
    dvec2 const h = floors.half + dvec2(0.15);
    // The parapet as four bars that cross at the corners.
    for (double const side : {-1.0, 1.0}) {
        site.out.box({-h.x, top - 0.3, side * h.y - 0.15}, {h.x, top + 0.7, side * h.y + 0.15}, site.paints.trim);
        site.out.box({side * h.x - 0.14, top - 0.25, -h.y + 0.1}, {side * h.x + 0.14, top + 0.66, h.y - 0.1}, site.paints.trim);
    }
    site.out.box({-2.0, top - 0.2, -2.6}, {1.4, top + 2.3, 0.6}, site.wall);
    site.out.box({-2.2, top + 2.2, -2.8}, {1.6, top + 2.45, 0.8}, site.paints.metal);
    for (int floor = 1; floor < floors.count; ++floor)
        for (int i = 0; i < 3; i += 2) {
            double const x = opening_x(floors, i);
            double const y = floor * floors.height;
            double const z = floors.half.y;
            site.out.box({x - 1.7, y + 0.06, z - 0.1}, {x + 1.7, y + 0.22, z + 1.25}, site.paints.stone);
            site.out.box({x - 1.66, y + 0.2, z + 1.12}, {x + 1.66, y + 1.12, z + 1.2}, site.door);
            for (double const side : {-1.0, 1.0})
                site.out.box({x + side * 1.62 - 0.03, y + 0.19, z - 0.05}, {x + side * 1.62 + 0.03, y + 1.1, z + 1.16},
                             site.paints.metal);
        }
    site.out.box({-2.2, 2.6, floors.half.y - 0.2}, {2.2, 2.8, floors.half.y + 1.7}, site.paints.stone);
    site.out.box({-1.8, -1.0, floors.half.y - 0.3}, {1.8, 0.1, floors.half.y + 1.4}, site.paints.stone);
}

void make_church(Site& site) {
    site.wall = site.paints.walls[0];
    site.roof = site.paints.roofs[3];
    Floors floors;
    floors.half = dvec2(6.0, 11.0);
    floors.count = 1;
    floors.height = 7.5;
    floors.sill = 2.2;
    floors.head = 6.0;
    floors.front = {3, 1.3};
    floors.side = {5, 1.3};
    Facade nave = body_of(site, floors);
    nave.top = Top::gable_along_z;
    nave.ridge = 13.0;
    add_facade(site.out, nave);
    add_gable_roof(site, floors.half, nave.hi.y, nave.ridge, false);
    for (int i = 0; i <= 5; ++i)
        for (double const side : {-1.0, 1.0}) {
            double const z = floors.half.y - 0.5 - i * 4.2 + (i == 5 ? 1.0 : 0.0);
            site.out.tapered_box({side * 6.3 - 0.7, -foundation_m, z - 0.45}, {side * 6.3 + 0.7, 6.2, z + 0.45}, 0.5,
                                 site.paints.stone);
        }
    site.out.box({-2.6, -foundation_m, 8.5}, {2.6, 14.0, 14.2}, site.wall);
    site.out.box({-2.8, 13.6, 8.3}, {2.8, 14.2, 14.4}, site.paints.trim);
    site.out.lathe({0.0, 14.1, 11.35}, std::array<Outline, 2>{{{3.2, 0.0}, {0.0, 5.9}}}, 8, site.roof);
    site.out.box({-1.1, -0.2, 13.9}, {1.1, 3.2, 14.32}, site.door);
    for (double const x : {-1.2, 1.2}) site.out.box({x - 0.5, 10.4, 8.4}, {x + 0.5, 12.8, 14.3}, site.paints.glass);
    site.out.box({-2.0, -foundation_m, 14.0}, {2.0, 0.0, 16.0}, site.paints.stone);
}

}  // namespace

TownPaints add_town_paints(Scene& scene) {
    TownPaints p;
    constexpr std::array<math::vec3, 8> walls{{{0.62F, 0.58F, 0.50F},
                                               {0.42F, 0.18F, 0.12F},
                                               {0.66F, 0.55F, 0.36F},
                                               {0.70F, 0.68F, 0.62F},
                                               {0.58F, 0.40F, 0.30F},
                                               {0.45F, 0.50F, 0.52F},
                                               {0.62F, 0.48F, 0.44F},
                                               {0.50F, 0.52F, 0.38F}}};
    constexpr std::array<math::vec3, 4> roofs{
        {{0.40F, 0.13F, 0.07F}, {0.33F, 0.17F, 0.10F}, {0.22F, 0.12F, 0.09F}, {0.15F, 0.16F, 0.19F}}};
    constexpr std::array<math::vec3, 4> doors{
        {{0.08F, 0.20F, 0.14F}, {0.10F, 0.16F, 0.32F}, {0.36F, 0.08F, 0.06F}, {0.24F, 0.14F, 0.07F}}};
    for (std::size_t i = 0; i < walls.size(); ++i) p.walls[i] = add_material(scene, "wall " + std::to_string(i), walls[i]);
    for (std::size_t i = 0; i < roofs.size(); ++i) p.roofs[i] = add_material(scene, "roof " + std::to_string(i), roofs[i]);
    for (std::size_t i = 0; i < doors.size(); ++i) p.doors[i] = add_material(scene, "door " + std::to_string(i), doors[i]);
    p.glass = add_material(scene, "glass", {0.05F, 0.07F, 0.10F});
    p.trim = add_material(scene, "trim", {0.72F, 0.71F, 0.67F});
    p.stone = add_material(scene, "stone", {0.38F, 0.37F, 0.35F});
    p.metal = add_material(scene, "metal", {0.16F, 0.17F, 0.18F});
    return p;
}

dvec2 half_plan(BuildingKind kind) noexcept {
    switch (kind) {
        case BuildingKind::cottage: return {6.2, 4.8};
        case BuildingKind::terrace: return {7.2, 6.0};
        case BuildingKind::flats: return {8.6, 6.2};
        case BuildingKind::church: return {6.0, 11.0};
    }
    return {};
}

Mesh make_building(BuildingKind kind, TownPaints const& paints, Pcg32& random) {
    Site site(paints, random);
    switch (kind) {
        case BuildingKind::cottage: make_cottage(site); break;
        case BuildingKind::terrace: make_terrace(site); break;
        case BuildingKind::flats: make_flats(site); break;
        case BuildingKind::church: make_church(site); break;
    }
    return site.out.take();
}

}  // namespace gnomon::scene::detail
