// `fuzzy`: a cloud of small triangles, each by itself, over a plane.

#include "detail/generators.hpp"
#include "detail/grid_mesh.hpp"
#include "detail/pcg32.hpp"
#include "detail/rail.hpp"

#include <array>
#include <cmath>

namespace gnomon::scene::detail {

namespace {

using math::dvec3;

constexpr math::ivec3 fuzzy_cells(10, 8, 10);
constexpr dvec3 cell_m(3.988, 2.485, 3.988);  // middles keep 6 cm off the sides, so that no corner leaves the 40x20x40 m
constexpr int triangles_per_color = 125;

dvec3 random_in_box(Pcg32& random) noexcept {
    dvec3 v;
    for (int axis = 0; axis < 3; ++axis) v[axis] = random.uniform(-1.0, 1.0);
    return v;
}

/// A direction drawn uniformly: a point of the ball, not too near its middle, made of length 1.
dvec3 random_direction(Pcg32& random) noexcept {
    dvec3 v;
    double length_sq = 0.0;
    do {
        v = random_in_box(random);
        length_sq = glm::dot(v, v);
    } while (length_sq > 1.0 || length_sq < 0.01);
    return v / glm::length(v);
}

/// An equilateral triangle of 0.1 m sides that hangs at `middle` and faces anywhere.
void add_fuzz(Primitive& out, Pcg32& random, dvec3 const& middle) {
    constexpr double side_m = 0.1;
    dvec3 const normal = random_direction(random);
    dvec3 aside = random_direction(random);
    while (std::abs(glm::dot(aside, normal)) > 0.9) aside = random_direction(random);
    dvec3 const u = glm::normalize(aside - normal * glm::dot(aside, normal));
    dvec3 const v = glm::cross(normal, u);
    constexpr double out_m = side_m * 0.57735026918962576;
    auto const base = static_cast<std::uint32_t>(out.positions.size());
    out.positions.push_back(math::to_float(middle + u * out_m));
    out.positions.push_back(math::to_float(middle - u * (out_m * 0.5) + v * (side_m * 0.5)));
    out.positions.push_back(math::to_float(middle - u * (out_m * 0.5) - v * (side_m * 0.5)));
    for (std::uint32_t i = 0; i < 3; ++i) {
        out.normals.push_back(math::to_float(normal));
        out.indices.push_back(base + i);
    }
}

}  // namespace

Result<Scene> make_fuzzy(ProceduralConfig const& config) {
    Scene scene;
    scene.name = "fuzzy";
    constexpr std::array<math::vec3, 4> colors{
        {{0.50F, 0.33F, 0.14F}, {0.58F, 0.46F, 0.20F}, {0.42F, 0.22F, 0.12F}, {0.36F, 0.36F, 0.18F}}};
    for (math::vec3 const& color : colors)
        scene.materials[add_material(scene, "fuzz", color)].double_sided = true;
    std::uint32_t const earth = add_material(scene, "plane", {0.52F, 0.51F, 0.48F});
    Lattice plane;
    plane.cells = math::ivec3(12, 1, 12);
    plane.lo = dvec3(-60.0, 0.0, -60.0);
    plane.hi = dvec3(60.0, 1.0, 60.0);
    add_instance(scene, "plane", add_mesh(scene, "plane", plane_mesh(plane, earth)), dvec3(1.0), dvec3(0.0));
    Pcg32 random(seed_of(config, 777));
    for (int z = 0; z < fuzzy_cells.z; ++z)
        for (int y = 0; y < fuzzy_cells.y; ++y)
            for (int x = 0; x < fuzzy_cells.x; ++x) {
                Mesh mesh;
                for (std::uint32_t color = 0; color < colors.size(); ++color) {
                    Primitive& out = mesh.primitives.emplace_back();
                    out.material = color;
                    for (int i = 0; i < triangles_per_color; ++i) add_fuzz(out, random, random_in_box(random) * 0.5 * cell_m);
                }
                dvec3 const middle = dvec3(x - 4.5, y + 0.5, z - 4.5) * cell_m + dvec3(0.0, 0.06, 0.0);
                add_instance(scene, "fuzz", add_mesh(scene, "fuzz", std::move(mesh)), dvec3(1.0), middle);
            }
    scene.lights.push_back(lamp({11.3, 40.7, -17.9}, 42.0));
    scene.cameras.push_back(view_from("eye", {{-3.1, 1.7, -52.3}, {0.0, 6.0, 0.0}}, {sixty_degrees_rad, 0.2, 400.0}));
    return scene;
}

/// From the eye's place along the front of the cloud and past its side.
Result<CameraPath> make_fuzzy_path(ProceduralConfig const&, PathInfo const& info) {
    constexpr std::array<Stop, 6> stops{{{{-3.1, 1.7, -52.3}, {0.0, 6.0, 0.0}},
                                         {{-1.0, 1.7, -44.0}, {-1.0, 7.0, 0.0}},
                                         {{-4.5, 1.7, -36.0}, {-6.0, 7.0, -4.0}},
                                         {{-12.5, 1.7, -30.0}, {-10.0, 6.0, -8.0}},
                                         {{-21.0, 1.7, -27.0}, {-10.0, 6.0, -4.0}},
                                         {{-27.0, 1.7, -20.0}, {-6.0, 7.0, 0.0}}}};
    return path_along(info, stops, {sixty_degrees_rad, 0.2, 400.0});
}

}  // namespace gnomon::scene::detail
