// `poles`: a field of thin poles with wires between them.

#include "detail/generators.hpp"
#include "detail/grid_mesh.hpp"
#include "detail/pcg32.hpp"
#include "detail/rail.hpp"
#include "detail/solid.hpp"

#include <array>
#include <cmath>
#include <vector>

namespace gnomon::scene::detail {

namespace {

using math::dvec3;

constexpr int rows = 20;
constexpr double pitch_m = 6.0;
constexpr double wire_m = 0.006;

struct Pole {
    dvec3 foot_m;
    double height_m;
    double radius_m;
    std::uint32_t wood;
};

std::vector<Pole> plan_poles(std::uint64_t seed) {
    Pcg32 random(seed);
    std::vector<Pole> poles;
    for (int z = 0; z < rows; ++z)
        for (int x = 0; x < rows; ++x) {
            Pole p;
            p.foot_m.x = (x - (rows - 1) * 0.5) * pitch_m + random.uniform(-1.2, 1.2);
            p.foot_m.z = (z - (rows - 1) * 0.5) * pitch_m + random.uniform(-1.2, 1.2);
            p.foot_m.y = 0.0;
            p.height_m = random.uniform(3.0, 8.0);
            p.radius_m = random.uniform(0.02, 0.08);
            p.wood = random.below(3);
            poles.push_back(p);
        }
    return poles;
}

/// The pole, round and hardly tapered, with a pointed cap; and where a wire is to be held, a cross-arm with insulators.
Mesh pole_mesh(Pole const& p, std::array<std::uint32_t, 2> materials, bool has_arm) {
    Mesh mesh;
    Solid shaft;
    double const r = p.radius_m;
    std::array<Level, 7> const profile{{{r, -0.4}, {r, 0.0}, {r * 0.97, p.height_m * 0.33}, {r * 0.94, p.height_m * 0.67},
                                        {r * 0.9, p.height_m - 0.12}, {r * 0.7, p.height_m - 0.04}, {0.0, p.height_m}}};
    add_lathe(shaft, dvec3(0.0), profile, 10);
    double const y = p.height_m - 0.45;
    if (has_arm) add_box(shaft, {-0.5, y, -0.035}, {0.5, y + 0.08, 0.035});
    add_solid(mesh, shaft, materials[0]);
    Solid glass;
    std::array<Level, 5> const bell{{{0.02, 0.0}, {0.05, 0.03}, {0.045, 0.08}, {0.02, 0.11}, {0.0, 0.125}}};
    for (double const x : {-0.42, 0.42})
        if (has_arm) add_lathe(glass, {x, y + 0.075, 0.0}, bell, 8);
    if (has_arm) add_solid(mesh, glass, materials[1]);
    return mesh;
}

/// A wire that hangs from `a` to `b`: a parabola, 3 % of the span deep.
void add_wire(Solid& out, dvec3 const& a, dvec3 const& b) {
    constexpr int steps = 9;
    double const sag_m = 0.03 * glm::length(b - a);
    std::vector<dvec3> line;
    for (int i = 0; i <= steps; ++i) {
        double const t = static_cast<double>(i) / steps;
        line.push_back(a + (b - a) * t - dvec3(0.0, 4.0 * sag_m * t * (1.0 - t), 0.0));
    }
    std::vector<double> const radii(line.size(), wire_m);
    add_tube(out, line, radii, 3);
}

/// Both wires of a row go from arm to arm; every second row has some.
bool has_wires(int row) noexcept { return row % 2 == 0; }

void add_wires(Scene& scene, std::vector<Pole> const& poles, std::uint32_t material) {
    for (int z = 0; z < rows; ++z)
        for (int x = 0; x + 1 < rows && has_wires(z); ++x) {
            Pole const& p = poles[static_cast<std::size_t>(z * rows + x)];
            Pole const& q = poles[static_cast<std::size_t>(z * rows + x + 1)];
            Solid wires;
            for (double const side : {-0.42, 0.42}) {
                // Arms stand along z, across the row.
                dvec3 const from = p.foot_m + dvec3(0.0, p.height_m - 0.26, side);
                dvec3 const to = q.foot_m + dvec3(0.0, q.height_m - 0.26, side);
                add_wire(wires, from, to);
            }
            Mesh mesh;
            add_solid(mesh, wires, material);
            add_instance(scene, "wires", add_mesh(scene, "wires", std::move(mesh)), dvec3(1.0), dvec3(0.0));
        }
}

}  // namespace

Result<Scene> make_poles(ProceduralConfig const& config) {
    Scene scene;
    scene.name = "poles";
    std::uint32_t const meadow = add_material(scene, "meadow", {0.26F, 0.29F, 0.13F});
    constexpr std::array<math::vec3, 3> woods{{{0.38F, 0.27F, 0.17F}, {0.46F, 0.38F, 0.28F}, {0.30F, 0.29F, 0.28F}}};
    std::array<std::uint32_t, 3> wood{};
    for (std::size_t i = 0; i < wood.size(); ++i) wood[i] = add_material(scene, "wood " + std::to_string(i), woods[i]);
    std::uint32_t const glass = add_material(scene, "insulator", {0.62F, 0.64F, 0.60F});
    std::uint32_t const copper = add_material(scene, "wire", {0.16F, 0.12F, 0.10F});
    Lattice plane;
    plane.cells = math::ivec3(16, 1, 16);
    plane.lo = dvec3(-80.0, 0.0, -80.0);
    plane.hi = dvec3(80.0, 1.0, 80.0);
    add_instance(scene, "plane", add_mesh(scene, "plane", plane_mesh(plane, meadow)), dvec3(1.0), dvec3(0.0));
    std::vector<Pole> const poles = plan_poles(seed_of(config, 12345));
    for (std::size_t i = 0; i < poles.size(); ++i) {
        Pole const& p = poles[i];
        Mesh mesh = pole_mesh(p, {wood[p.wood], glass}, has_wires(static_cast<int>(i) / rows));
        add_placed_instance(scene, "pole", add_mesh(scene, "pole", std::move(mesh)), turned_by(0.25, p.foot_m));
    }
    add_wires(scene, poles, copper);
    scene.lights.push_back(sun_light());
    Lens const lens{sixty_degrees_rad, 0.1, 500.0};
    scene.cameras.push_back(view_from("row", {{-36.0, 4.2, 33.5}, {-20.0, 3.0, 12.0}}, lens));
    scene.cameras.push_back(view_from("field", {{-40.0, 18.0, 74.0}, {-4.0, 0.0, 10.0}}, lens));
    return scene;
}

/// Between two rows of poles, 1.8 m away from where either may stand.
Result<CameraPath> make_poles_path(ProceduralConfig const&, PathInfo const& info) {
    double const z = pitch_m * 3.0;
    constexpr double speed_m = 1.6;
    double const length_m = speed_m * info.frames / info.rate_hz;
    std::array<Stop, 2> const stops{{{{-30.0, 1.7, z}, {-14.0, 2.6, z - 5.0}},
                                     {{-30.0 + length_m, 1.7, z}, {-14.0 + length_m, 2.6, z + 5.0}}}};
    return path_along(info, stops, {sixty_degrees_rad, 0.1, 500.0});
}

}  // namespace gnomon::scene::detail
