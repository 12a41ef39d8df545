// `cage`: a bird cage on a table.

#include "detail/generators.hpp"
#include "detail/grid_mesh.hpp"
#include "detail/rail.hpp"
#include "detail/solid.hpp"
#include "detail/turn.hpp"

#include <array>
#include <vector>

namespace gnomon::scene::detail {

namespace {

using math::dvec3;

constexpr double cage_radius_m = 2.0;
constexpr double cage_wall_m = 3.6;  ///< Where the dome starts.
constexpr double bar_m = 0.035;

/// A closed hoop: a pipe whose end is its start.
void add_hoop(Solid& out, dvec3 const& centre, double radius_m, double pipe_m, std::uint32_t steps) {
    std::vector<Ring> rings;
    for (std::uint32_t i = 0; i < steps; ++i) {
        dvec3 const spoke = level_direction(static_cast<double>(i) / steps);
        rings.push_back(circle(centre + spoke * radius_m, spoke * -pipe_m, dvec3(0.0, pipe_m, 0.0), 6));
    }
    add_loft(out, rings, Ends::loop);
}

/// From the foot up the wall and along a quarter of an ellipse to the top; with every second one ending lower.
void add_bar(Solid& out, double turns, double reach) {
    dvec3 const spoke = level_direction(turns);
    std::vector<dvec3> line{spoke * cage_radius_m, spoke * cage_radius_m + dvec3(0.0, cage_wall_m * 0.5, 0.0)};
    constexpr int steps = 7;
    for (int i = 0; i <= steps; ++i) {
        SinCos const a = sin_cos(0.25 * reach * i / steps);
        line.push_back(spoke * (cage_radius_m * a.cos) + dvec3(0.0, cage_wall_m + 1.9 * a.sin, 0.0));
    }
    std::vector<double> const radii(line.size(), bar_m);
    add_tube(out, line, radii, 6);
}

/// The outer bars run from the floor to the knob and back to the hoops that hold them.
Solid bars() {
    Solid out;
    constexpr std::uint32_t count = 48;
    for (std::uint32_t i = 0; i < count; ++i) add_bar(out, static_cast<double>(i) / count, i % 2 == 0 ? 0.96 : 0.72);
    return out;
}

Solid hoops() {
    Solid out;
    for (double const y : {0.16, 1.3, 2.45, cage_wall_m}) add_hoop(out, dvec3(0.0, y, 0.0), cage_radius_m, bar_m * 1.5, 64);
    SinCos const half = sin_cos(0.25 * 0.72);
    add_hoop(out, dvec3(0.0, cage_wall_m + 1.9 * half.sin, 0.0), cage_radius_m * half.cos, bar_m * 1.5, 48);
    add_hoop(out, dvec3(0.0, 1.9, 0.0), 0.62, 0.04, 40);
    return out;
}

/// A swing with its ropes, and a bowl.
Solid furniture() {
    Solid out;
    std::array<dvec3, 2> const perch{{{-1.0, 1.5, 0.25}, {1.0, 1.62, -0.2}}};
    std::array<double, 2> const thick{0.05, 0.05};
    add_tube(out, perch, thick, 10);
    for (double const x : {-0.61, 0.61}) {
        std::array<dvec3, 3> const rope{{{x, 1.9, 0.0}, {x * 0.55, 3.6, 0.0}, {x * 0.05, 5.35, 0.0}}};
        std::array<double, 3> const thin{0.02, 0.02, 0.02};
        add_tube(out, rope, thin, 6);
    }
    std::array<Level, 8> const bowl{
        {{0.22, 0.1}, {0.3, 0.16}, {0.22, 0.24}, {0.5, 0.4}, {0.6, 0.62}, {0.54, 0.64}, {0.42, 0.46}, {0.0, 0.36}}};
    add_lathe(out, dvec3(0.85, 0.0, 0.75), bowl, 32);
    return out;
}

Solid base_and_knob() {
    Solid out;
    std::array<Level, 6> const base{{{2.05, -0.05}, {2.2, 0.0}, {2.2, 0.07}, {2.12, 0.13}, {1.9, 0.13}, {0.0, 0.125}}};
    add_lathe(out, dvec3(0.0), base, 64);
    std::array<Level, 8> const knob{{{0.0, 5.3}, {0.24, 5.36}, {0.28, 5.46}, {0.2, 5.56}, {0.1, 5.62}, {0.15, 5.74}, {0.1, 5.86}, {0.0, 5.9}}};
    add_lathe(out, dvec3(0.0), knob, 24);
    std::vector<Ring> rings;
    for (std::uint32_t i = 0; i < 24; ++i) {
        SinCos const a = sin_cos(i / 24.0);
        dvec3 const spoke(a.cos, a.sin, 0.0);
        rings.push_back(circle(dvec3(0.0, 6.13, 0.0) + spoke * 0.26, spoke * 0.035, dvec3(0.0, 0.0, -0.035), 8));
    }
    add_loft(out, rings, Ends::loop);
    return out;
}

}  // namespace

Result<Scene> make_cage(ProceduralConfig const&) {
    Scene scene;
    scene.name = "cage";
    std::uint32_t const brass = add_material(scene, "brass", {0.50F, 0.33F, 0.09F});
    std::uint32_t const iron = add_material(scene, "iron", {0.20F, 0.21F, 0.23F});
    std::uint32_t const wood = add_material(scene, "wood", {0.36F, 0.20F, 0.11F});
    std::uint32_t const cloth = add_material(scene, "table", {0.30F, 0.36F, 0.33F});
    auto const add = [&](char const* name, Solid const& solid, std::uint32_t material) {
        Mesh mesh;
        add_solid(mesh, solid, material);
        add_instance(scene, name, add_mesh(scene, name, std::move(mesh)), dvec3(1.0), dvec3(0.0));
    };
    add("bars", bars(), brass);
    add("hoops", hoops(), iron);
    add("furniture", furniture(), wood);
    add("base and knob", base_and_knob(), brass);
    Lattice table;
    table.cells = math::ivec3(8, 3, 8);  // so that there are 12,000 triangles
    table.lo = dvec3(-7.0, -0.6, -7.0);
    table.hi = dvec3(7.0, -0.02, 7.0);
    add_instance(scene, "table", add_mesh(scene, "table", box_mesh(table, cloth, cloth, true)), dvec3(1.0), dvec3(0.0));
    scene.lights.push_back(lamp({-5.4, 8.2, -0.6}, 7.0));
    Lens const lens{sixty_degrees_rad * 0.75, 0.2, 100.0};
    scene.cameras.push_back(view_from("A", {{-2.8, 5.8, 9.4}, {1.3, 2.6, -0.3}}, lens));
    scene.cameras.push_back(view_from("B", {{5.4, 3.4, 7.6}, {0.9, 2.4, -0.6}}, lens));
    scene.cameras.push_back(view_from("C", {{10.0, 4.6, -1.4}, {0.8, 2.2, 0.0}}, lens));
    return scene;
}

}  // namespace gnomon::scene::detail
