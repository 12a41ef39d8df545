// `cubes` and `sheet`.

#include "detail/generators.hpp"
#include "detail/grid_mesh.hpp"
#include "detail/pcg32.hpp"

#include <array>
#include <cmath>

namespace gnomon::scene::detail {

namespace {

using math::dvec3;


/// A rotation drawn uniformly: a point of the 4-ball as a quaternion. Only + - * / and sqrt, so the same everywhere.
std::array<dvec3, 3> random_axes(Pcg32& random) noexcept {
    double w = 0.0;
    double x = 0.0;
    double y = 0.0;
    double z = 0.0;
    double length_sq = 0.0;
    do {
        w = random.uniform(-1.0, 1.0);
        x = random.uniform(-1.0, 1.0);
        y = random.uniform(-1.0, 1.0);
        z = random.uniform(-1.0, 1.0);
        length_sq = ((w * w + x * x) + y * y) + z * z;
    } while (length_sq > 1.0 || length_sq < 0.01);
    double const s = 2.0 / length_sq;
    return {dvec3(1.0 - s * (y * y + z * z), s * (x * y + w * z), s * (x * z - w * y)),
            dvec3(s * (x * y - w * z), 1.0 - s * (x * x + z * z), s * (y * z + w * x)),
            dvec3(s * (x * z + w * y), s * (y * z - w * x), 1.0 - s * (x * x + y * y))};
}

constexpr int cubes_per_side = 10;

/// A turned cube somewhere in its own cell of the lattice, so that none touches another.
Instance floating_cube(Pcg32& random, std::uint32_t mesh, dvec3 const& cell_m) {
    constexpr double pitch_m = 1.6;
    double const edge_m = random.uniform(0.35, 0.65);
    double const room_m = (pitch_m - edge_m * 1.7320508075688772) * 0.5;
    dvec3 shift;  // drawn one by one: the order in which arguments are evaluated is the compiler's
    for (int axis = 0; axis < 3; ++axis) shift[axis] = random.uniform(-room_m, room_m);
    auto const axes = random_axes(random);
    Instance instance;
    instance.name = "cube";
    instance.mesh = mesh;
    dvec3 const at = cell_m * pitch_m + shift;
    for (int row = 0; row < 3; ++row) {
        for (int axis = 0; axis < 3; ++axis) instance.world_from_mesh[axis][row] = axes[static_cast<std::size_t>(axis)][row] * edge_m;
        instance.world_from_mesh[3][row] = at[row];
    }
    return instance;
}

}  // namespace

Result<Scene> make_cubes(ProceduralConfig const& config) {
    Scene scene;
    scene.name = "cubes";
    constexpr std::array<math::vec3, 5> colors{{{0.55F, 0.20F, 0.14F},
                                                {0.62F, 0.48F, 0.18F},
                                                {0.22F, 0.38F, 0.30F},
                                                {0.18F, 0.30F, 0.46F},
                                                {0.62F, 0.58F, 0.52F}}};
    std::array<std::uint32_t, colors.size()> meshes{};
    Lattice cube;
    cube.lo = dvec3(-0.5);
    cube.hi = dvec3(0.5);
    for (std::size_t i = 0; i < colors.size(); ++i) {
        std::uint32_t const paint = add_material(scene, "cube " + std::to_string(i), colors[i]);
        meshes[i] = add_mesh(scene, "cube " + std::to_string(i), box_mesh(cube, paint, paint, true));
    }
    std::uint32_t const stone = add_material(scene, "slab", {0.58F, 0.57F, 0.54F});
    std::uint32_t const slab = add_mesh(scene, "slab", box_mesh(cube, stone, stone, true));
    add_instance(scene, "slab", slab, dvec3(48.0, 0.5, 48.0), dvec3(0.0, -0.25, 0.0));
    Pcg32 random(seed_of(config, 12345));
    for (int i = 0; i < cubes_per_side * cubes_per_side * cubes_per_side - 1; ++i) {
        dvec3 const cell(i % cubes_per_side - 4.5, i / (cubes_per_side * cubes_per_side) + 2.0,
                         i / cubes_per_side % cubes_per_side - 4.5);
        std::uint32_t const mesh = meshes[random.below(static_cast<std::uint32_t>(meshes.size()))];
        scene.instances.push_back(floating_cube(random, mesh, cell));
    }
    scene.lights.push_back(lamp({-14.0, 30.0, 16.0}, 34.0));
    scene.cameras.push_back(looking_at("A", {-24.0, 20.0, 29.0}, {0.5, 6.5, -1.0}, sixty_degrees_rad * 0.75));
    scene.cameras.push_back(looking_at("B", {26.0, 9.0, 16.0}, {1.0, 5.5, -1.0}, sixty_degrees_rad * 0.75));
    scene.cameras.push_back(looking_at("C", {15.0, 1.7, -21.0}, {-1.5, 7.0, 2.0}, sixty_degrees_rad));
    return scene;
}

namespace {

constexpr int sheet_points = 256;

/// Heights in [0, 4) m, whole 1/32 m: every point and every edge's middle is a float even 131,072 m from the origin.
std::vector<float> sheet_heights(std::uint64_t seed) {
    Pcg32 random(seed);
    std::vector<float> heights;
    for (int i = 0; i < sheet_points * sheet_points; ++i) heights.push_back(static_cast<float>(random.below(128)) / 32.0F);
    return heights;
}

Primitive sheet_primitive(std::vector<float> const& heights, std::uint32_t material) {
    Primitive sheet;
    sheet.material = material;
    auto const height = [&](int x, int z) {
        int const cx = x < 0 ? 0 : x > sheet_points - 1 ? sheet_points - 1 : x;
        int const cz = z < 0 ? 0 : z > sheet_points - 1 ? sheet_points - 1 : z;
        return static_cast<double>(heights[static_cast<std::size_t>(cz * sheet_points + cx)]);
    };
    for (int z = 0; z < sheet_points; ++z)
        for (int x = 0; x < sheet_points; ++x) {
            sheet.positions.emplace_back(static_cast<float>(x - sheet_points / 2), static_cast<float>(height(x, z)),
                                         static_cast<float>(z - sheet_points / 2));
            dvec3 const slope(height(x - 1, z) - height(x + 1, z), 2.0, height(x, z - 1) - height(x, z + 1));
            sheet.normals.push_back(math::to_float(glm::normalize(slope)));
        }
    for (std::uint32_t z = 0; z + 1 < sheet_points; ++z)
        for (std::uint32_t x = 0; x + 1 < sheet_points; ++x) {
            std::uint32_t const a = z * sheet_points + x;
            std::uint32_t const below = a + sheet_points;
            for (std::uint32_t index : {a, below, a + 1, a + 1, below, below + 1}) sheet.indices.push_back(index);
        }
    return sheet;
}

}  // namespace

Result<Scene> make_sheet(ProceduralConfig const& config) {
    // Whole 1/32 m below 2^17 + 2^8 m are floats; farther out the heights would be rounded.
    double const steps = config.offset_m * 32.0;
    if (!(std::abs(config.offset_m) <= 131072.0) || steps != std::floor(steps))
        return core::Failure{SceneError::bad_config, "sheet cannot stand at an offset of " +
                                                         std::to_string(config.offset_m) +
                                                         " m; give whole 1/32 m from -131072 to 131072"};
    Scene scene;
    scene.name = "sheet";
    std::uint32_t const clay = add_material(scene, "clay", {0.60F, 0.50F, 0.38F});
    Mesh mesh;
    mesh.primitives.push_back(sheet_primitive(sheet_heights(seed_of(config, 12345)), clay));
    dvec3 const offset(config.offset_m);
    add_instance(scene, "sheet", add_mesh(scene, "sheet", std::move(mesh)), dvec3(1.0), offset);
    scene.lights.push_back(lamp(offset + dvec3(40.0, 96.0, -24.0), 110.0));
    scene.cameras.push_back(
        looking_at("above", offset + dvec3(-70.0, 46.0, 104.0), offset + dvec3(-6.0, 0.0, 12.0), sixty_degrees_rad * 0.75));
    return scene;
}

}  // namespace gnomon::scene::detail
