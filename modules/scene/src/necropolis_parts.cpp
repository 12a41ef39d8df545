#include "detail/cell_solid.hpp"
#include "detail/necropolis.hpp"

#include <array>

namespace gnomon::scene::detail {

namespace {

using math::dvec2;
using math::dvec3;

/// A turned column with a square foot and head, standing at `foot`.
void add_column(SolidBuilder& out, NecropolisPaints const& p, dvec3 const& foot, Outline const& size) {
    double const r = size.radius;
    double const h = size.height;
    out.box(foot - dvec3(1.5 * r, 0.3, 1.5 * r), foot + dvec3(1.5 * r, 0.4, 1.5 * r), p.stone);
    std::array<Outline, 7> const shaft{{{1.3 * r, 0.35}, {1.35 * r, 0.55}, {1.05 * r, 0.8}, {r, h * 0.4}, {0.85 * r, h - 1.0}, {1.0 * r, h - 0.8}, {1.4 * r, h - 0.35}}};
    out.lathe(foot, shaft, 20, p.pale);
    out.box(foot + dvec3(-1.6 * r, h - 0.45, -1.6 * r), foot + dvec3(1.6 * r, h + 0.15, 1.6 * r), p.stone);
}

/// A hall with a door at its front and windows under its eaves; its roof slab is the top layer.
struct Hall {
    double half_x = 18.0;
    double length = 70.0;
    double height = 15.0;
    double door_half_x = 3.0;
    double door_height = 8.0;
    int bays = 9;
};

/// The front lies in the plane z = 0; the hall reaches back from it.
Mesh make_hall(Hall const& hall, NecropolisPaints const& p) {
    constexpr double wall = 1.2;
    double const x = hall.half_x;
    std::vector<double> xs{-x, -x + wall, -hall.door_half_x, hall.door_half_x, x - wall, x};
    std::vector<double> ys{-1.5, 0.05, hall.door_height, hall.height * 0.73, hall.height * 0.9, hall.height, hall.height + 1.2};
    std::vector<double> zs{-hall.length, -hall.length + wall};
    double const bay = (hall.length - 2.0 * wall) / hall.bays;
    for (int i = 0; i < hall.bays; ++i) {
        double const start = -hall.length + wall + bay * i;
        if (i > 0) zs.push_back(start);
        zs.push_back(start + bay * 0.3);
        zs.push_back(start + bay * 0.7);
    }
    zs.push_back(-wall);
    zs.push_back(0.0);
    int const nz = static_cast<int>(zs.size()) - 1;
    CellSolid cells = make_cells(std::move(xs), std::move(ys), std::move(zs));
    fill_cells(cells, {0, 0, 0}, {4, 4, nz - 1}, p.stone);
    fill_cells(cells, {0, 0, 0}, {4, 0, nz - 1}, p.paving);
    fill_cells(cells, {0, 5, 0}, {4, 5, nz - 1}, p.pale);
    fill_cells(cells, {1, 1, 1}, {3, 4, nz - 2}, none);
    fill_cells(cells, {2, 1, nz - 1}, {2, 1, nz - 1}, none);
    for (int i = 0; i < hall.bays; ++i)
        for (int const side : {0, 4}) fill_cells(cells, {side, 3, 3 * i + 2}, {side, 3, 3 * i + 2}, none);
    SolidBuilder out;
    add_cells(out, cells);
    return out.take();
}

/// What stands in and before the large hall: columns, tombs, an altar, a portico with a gable.
Mesh make_hall_furniture(NecropolisPaints const& p) {
    SolidBuilder out;
    for (int i = 0; i < 8; ++i)
        for (double const side : {-8.5, 8.5}) add_column(out, p, {side, 0.05, -7.5 - 8.0 * i}, {0.95, 14.9});
    for (int i = 0; i < 7; ++i)
        for (double const side : {-13.0, 13.0}) {
            double const z = -11.5 - 8.0 * i;
            out.tapered_box({side - 1.0, 0.0, z - 1.9}, {side + 1.0, 1.1, z + 1.9}, 0.92, p.pale);
            out.tapered_box({side - 1.1, 1.05, z - 2.0}, {side + 1.1, 1.55, z + 2.0}, 0.6, p.dark);
        }
    out.box({-3.5, -0.2, -67.5}, {3.5, 0.5, -61.5}, p.stone);
    out.box({-2.6, 0.4, -67.0}, {2.6, 0.9, -62.5}, p.stone);
    out.box({-1.8, 0.8, -65.5}, {1.8, 2.0, -64.0}, p.dark);
    std::array<Outline, 9> const statue{{{1.2, 0.8}, {1.0, 2.2}, {0.85, 3.4}, {1.15, 4.8}, {1.2, 5.6}, {0.4, 6.3}, {0.6, 6.9}, {0.5, 7.5}, {0.0, 7.8}}};
    out.lathe({0.0, 0.4, -66.9}, statue, 24, p.bronze);
    for (int i = 0; i < 6; ++i) add_column(out, p, {(i < 3 ? -15.0 + 5.0 * i : 5.0 + 5.0 * (i - 3)), 0.05, 5.0}, {0.9, 13.0});
    out.box({-18.5, -1.4, -0.6}, {18.5, 0.02, 8.0}, p.paving);
    for (int i = 0; i < 4; ++i)
        out.box({-10.0 - 0.1 * i, -1.6 - 0.01 * i, 7.5 - 0.05 * i}, {10.0 + 0.1 * i, -0.01 - 0.005 * i, 8.4 + 0.45 * i}, p.stone);
    out.box({-18.0, 12.9, -0.5}, {18.0, 14.6, 6.5}, p.stone);
    std::array<dvec2, 3> const gable{{{-18.6, 14.5}, {18.6, 14.5}, {0.0, 21.0}}};
    out.prism(Plane::xy, gable, {-0.7, 7.0}, p.pale);
    return out.take();
}

/// A tomb like a little temple, 7 m by 9 m, with its door towards +z; its form goes by `kind`.
Mesh make_tomb(std::uint32_t kind, NecropolisPaints const& p) {
    SolidBuilder out;
    Mesh const walls = make_hall({2.8, 6.6, 5.0, 0.8, 2.6, 2}, p);
    out.box({-3.6, -0.5, -7.4}, {3.6, 0.03, 2.4}, p.paving);
    for (double const x : {-2.4, 2.4}) add_column(out, p, {x, 0.0, 1.5}, {0.36, 5.1});
    out.box({-3.3, 5.05, -0.6}, {3.3, 5.7, 2.3}, p.stone);
    if (kind == 0) {
        std::array<dvec2, 3> const gable{{{-3.6, 5.6}, {3.6, 5.6}, {0.0, 7.8}}};
        out.prism(Plane::xy, gable, {-6.9, 2.6}, p.pale);
    } else if (kind == 1) {
        out.lathe({0.0, 6.0, -3.0}, std::array<Outline, 6>{{{2.7, 0.0}, {2.7, 0.6}, {2.4, 1.5}, {1.7, 2.4}, {0.8, 2.9}, {0.0, 3.1}}}, 24, p.bronze);
    } else {
        out.tapered_box({-3.0, 5.9, -6.4}, {3.0, 11.5, 1.0}, 0.04, p.sand);
    }
    out.tapered_box({-0.9, -0.1, -5.2}, {0.9, 1.0, -2.2}, 0.9, p.dark);
    Mesh tomb = out.take();
    for (Primitive const& part : walls.primitives) tomb.primitives.push_back(part);
    return tomb;
}

/// A bronze barrel that points up and inwards, on a block; the muzzle lies at 3 m along +x and 2.5 m up.
Mesh make_cannon(NecropolisPaints const& p) {
    SolidBuilder out;
    out.tapered_box({-1.2, -0.4, -0.9}, {1.0, 1.0, 0.9}, 0.7, p.dark);
    out.tube({{-1.0, 0.4, 0.0}, {2.4, 2.1, 0.0}, 0.5, 0.32, 16}, p.bronze);
    out.tube({{2.2, 2.0, 0.0}, {3.0, 2.4, 0.0}, 0.38, 0.42, 16}, p.bronze);
    return out.take();
}

constexpr double wall_height_m = 7.0;

/// A stretch of wall along x, 19 m, with battlements.
Mesh make_wall(NecropolisPaints const& p) {
    SolidBuilder out;
    out.tapered_box({-9.6, -1.0, -1.3}, {9.6, wall_height_m, 1.3}, 0.98, p.stone);
    for (int i = 0; i < 8; ++i) {
        double const x = -8.6 + 2.4 * i;
        out.box({x - 0.7, wall_height_m - 0.2, 0.4}, {x + 0.7, wall_height_m + 1.1, 1.15}, p.stone);
    }
    return out.take();
}

Mesh make_gate(NecropolisPaints const& p) {
    SolidBuilder out;
    for (double const side : {-1.0, 1.0}) {
        double const x = side * 8.5;
        out.tapered_box({x - 3.8, -1.0, -4.0}, {x + 3.8, 15.0, 4.0}, 0.82, p.stone);
        out.box({x - 3.5, 14.8, -3.7}, {x + 3.5, 15.8, 3.7}, p.pale);
        out.tapered_box({x - 2.6, 15.6, -2.6}, {x + 2.6, 19.5, 2.6}, 0.05, p.dark);
    }
    out.box({-6.5, 9.0, -1.8}, {6.5, 11.6, 1.8}, p.stone);
    out.box({-6.0, 11.4, -2.2}, {6.0, 12.2, 2.2}, p.pale);
    return out.take();
}

void add_walls(Scene& scene, NecropolisPaints const& p) {
    std::uint32_t const wall = add_mesh(scene, "wall", make_wall(p));
    auto const stand = [&](double x, double z, double turns) {
        scene.instances.push_back(placed_instance("wall", wall, {{x, 0.0, z}, turns}));
    };
    for (int i = 0; i < 10; ++i) {
        double const x = -85.5 + 19.0 * i;
        stand(x, yard_back_z, 0.5);
        if (i < 4 || i > 5) stand(i < 4 ? x - 1.5 : x + 1.5, yard_half_m, 0.0);
    }
    for (double const side : {-1.0, 1.0}) stand(side * 19.0, yard_half_m + 0.05, 0.0);
    for (int i = 0; i < 11; ++i)
        for (double const side : {-1.0, 1.0}) stand(side * yard_half_m, yard_back_z + 8.6 + 18.9 * i, side * 0.25);
    scene.instances.push_back(placed_instance("gate", add_mesh(scene, "gate", make_gate(p)), {{0.0, 0.0, yard_half_m}, 0.0}));
    std::uint32_t const cannon = add_mesh(scene, "cannon", make_cannon(p));
    for (std::uint32_t i = 0; i < cannons; ++i) {
        dvec3 const mouth = cannon_mouth(i);
        double const side = mouth.x < 0.0 ? -1.0 : 1.0;
        scene.instances.push_back(placed_instance("cannon", cannon, {{mouth.x + side * 3.1, mouth.y - 2.4, mouth.z}, side < 0.0 ? 0.0 : 0.5}));
    }
}

/// Sand to the horizon and the paved avenue, as slabs of squares.
Mesh make_desert(NecropolisPaints const& p) {
    SolidBuilder out;
    for (int j = 0; j < 12; ++j)
        for (int i = 0; i < 12; ++i) {
            dvec3 const lo(-300.0 + 50.0 * i, -3.0, -300.0 + 50.0 * j);
            out.box(lo + dvec3(0.002, 0.0, 0.002), lo + dvec3(49.998, 3.0, 49.998), p.sand);
        }
    for (int i = 0; i < 30; ++i) {
        double const z = -25.0 + 4.3 * i;
        for (int k = 0; k < 4; ++k) {
            double const x = -6.0 + 3.0 * k;
            out.box({x + 0.03, -0.4, z + 0.03}, {x + 2.97, 0.04, z + 4.25}, p.paving);
        }
    }
    return out.take();
}

}  // namespace

dvec3 cannon_mouth(std::uint32_t cannon) noexcept {
    double const side = cannon % 2 == 0 ? 1.0 : -1.0;
    return {side * (yard_half_m - 2.2), wall_height_m + 2.7, yard_back_z + 24.0 + 15.5 * (cannon / 2)};
}

NecropolisPaints add_necropolis_paints(Scene& scene) {
    return {add_material(scene, "sand", {0.52F, 0.42F, 0.27F}),   add_material(scene, "paving", {0.42F, 0.38F, 0.32F}),
            add_material(scene, "stone", {0.50F, 0.43F, 0.33F}),  add_material(scene, "limestone", {0.64F, 0.59F, 0.49F}),
            add_material(scene, "basalt", {0.14F, 0.14F, 0.16F}), add_material(scene, "bronze", {0.38F, 0.26F, 0.10F}),
            add_material(scene, "glow", {0.60F, 0.78F, 0.80F})};
}

void add_necropolis_buildings(Scene& scene, NecropolisPaints const& paints) {
    scene.instances.push_back(placed_instance("desert", add_mesh(scene, "desert", make_desert(paints)), {}));
    add_walls(scene, paints);
    std::uint32_t const hall = add_mesh(scene, "hall", make_hall(Hall{}, paints));
    scene.instances.push_back(placed_instance("hall", hall, {{0.0, 0.0, hall_front_z}, 0.0}));
    std::uint32_t const furniture = add_mesh(scene, "furniture", make_hall_furniture(paints));
    scene.instances.push_back(placed_instance("furniture", furniture, {{0.0, 0.0, hall_front_z}, 0.0}));
    std::uint32_t const side_hall = add_mesh(scene, "side hall", make_hall({10.0, 40.0, 9.0, 2.0, 4.6, 5}, paints));
    for (double const side : {-1.0, 1.0})
        scene.instances.push_back(placed_instance("side hall", side_hall, {{side * 44.0, 0.0, hall_front_z - 8.0}, 0.0}));
    std::array<std::uint32_t, 3> tombs{};
    for (std::uint32_t i = 0; i < 3; ++i) tombs[i] = add_mesh(scene, "tomb", make_tomb(i, paints));
    for (std::uint32_t i = 0; i < 16; ++i) {
        double const side = i % 2 == 0 ? -1.0 : 1.0;
        // 3 m back from the avenue, doors towards it; the graves begin behind.
        scene.instances.push_back(placed_instance("tomb", tombs[i / 2 * 5 % 3], {{side * 8.9, 0.0, 80.0 - 13.0 * (i / 2)}, side * -0.25}));
    }
}

Mesh make_grave(std::uint32_t kind, NecropolisPaints const& p) {
    SolidBuilder out;
    out.box({-0.45, -0.2, -0.85}, {0.45, 0.14, 0.75}, p.stone);
    std::array<Outline, 10> const urn{{{0.14, 0.0}, {0.16, 0.03}, {0.07, 0.1}, {0.1, 0.16}, {0.19, 0.3}, {0.2, 0.42}, {0.12, 0.52}, {0.15, 0.56}, {0.05, 0.66}, {0.0, 0.7}}};
    switch (kind) {
        case 0:  // an urn on a pedestal
            out.tapered_box({-0.26, 0.1, -0.72}, {0.26, 0.95, -0.24}, 0.85, p.pale);
            out.lathe({0.0, 0.93, -0.48}, urn, 26, p.bronze);
            break;
        case 1: {  // a round-headed stone
            std::vector<dvec2> outline{{-0.36, 0.08}, {0.36, 0.08}};
            for (int i = 0; i <= 40; ++i) {
                SinCos const t = sin_cos(0.5 * i / 40.0);
                outline.emplace_back(0.36 * t.cos, 0.8 + 0.36 * t.sin);
            }
            out.prism(Plane::xy, outline, {-0.7, -0.54}, p.pale);
            out.lathe({0.0, 0.13, 0.3}, urn, 16, p.dark);
            break;
        }
        case 2:  // a broken column
            out.box({-0.3, 0.1, -0.75}, {0.3, 0.3, -0.15}, p.pale);
            out.lathe({0.0, 0.28, -0.45}, std::array<Outline, 11>{{{0.25, 0.0}, {0.26, 0.06}, {0.2, 0.12}, {0.19, 0.4}, {0.185, 0.6}, {0.18, 0.8}, {0.178, 0.9}, {0.175, 1.0}, {0.172, 1.1}, {0.13, 1.16}, {0.1, 1.13}}}, 24, p.pale);
            break;
        default:  // an obelisk with a ball, and four small ones at its foot
            out.tapered_box({-0.2, 0.1, -0.68}, {0.2, 1.75, -0.28}, 0.55, p.dark);
            out.ball({0.0, 1.84, -0.48}, 0.14, 9, p.bronze);
            for (double const x : {-0.3, 0.3}) out.ball({x, 0.24, 0.45}, 0.12, 4, p.bronze);
            break;
    }
    return out.take();
}

Mesh make_spirit(NecropolisPaints const& p) {
    SolidBuilder out;
    out.lathe({0.0, -0.7, 0.0}, std::array<Outline, 8>{{{0.0, 0.0}, {0.12, 0.2}, {0.2, 0.5}, {0.36, 0.8}, {0.3, 1.0}, {0.36, 1.2}, {0.25, 1.45}, {0.0, 1.55}}}, 20, p.glow);
    return out.take();
}

}  // namespace gnomon::scene::detail
