// `forest`: a hundred trees in leaf on rolling ground, with a trail between them.

#include "detail/branching.hpp"
#include "detail/generators.hpp"
#include "detail/grid_mesh.hpp"
#include "detail/leaf_image.hpp"
#include "detail/rail.hpp"
#include "detail/turn.hpp"

#include <array>
#include <cmath>
#include <vector>

namespace gnomon::scene::detail {

namespace {

using math::dvec3;

constexpr int trees_per_side = 10;
constexpr double tree_pitch_m = 7.2;
constexpr int ground_quads = 64;
constexpr double ground_side_m = 96.0;
constexpr int ferns = 1400;

/// Triangles: 178 + 812 + 2100 of bark; 280 twigs with five sprays of leaves make 2800 more.
constexpr std::array<BranchLevel, 3> broad_levels{
    {{1, 10, 8, 0.85, 0.0, 0.06, 0.03}, {14, 6, 5, 0.6, 0.17, 0.13, 0.1}, {5, 4, 4, 0.55, 0.14, 0.2, 0.05}}};
constexpr std::array<BranchLevel, 3> slim_levels{
    {{1, 10, 8, 0.95, 0.0, 0.03, 0.03}, {14, 6, 5, 0.32, 0.16, 0.12, 0.02}, {5, 4, 4, 0.6, 0.13, 0.2, -0.08}}};
constexpr std::uint32_t sprays_per_twig = 5;

/// A material for bark and one for leaves, and a form.
struct Species {
    char const* name;
    TreeShape shape;
    math::vec3 bark;
    math::vec3 leaves;
};

constexpr std::array<Species, 3> species{{
    {"oak", {11.0, 0.34, 0.4, 0.35, broad_levels}, {0.27F, 0.20F, 0.14F}, {0.42F, 0.55F, 0.28F}},
    {"birch", {13.0, 0.2, 0.42, 0.6, slim_levels}, {0.52F, 0.50F, 0.45F}, {0.62F, 0.66F, 0.30F}},
    {"beech", {12.0, 0.3, 0.44, 0.25, broad_levels}, {0.36F, 0.35F, 0.32F}, {0.50F, 0.48F, 0.22F}},
}};

/// Where the trail runs at `z`.
double trail_x(double z) noexcept { return 5.0 * sin_cos(z / 60.0).sin + 1.5 * sin_cos(z / 23.0 + 0.2).sin; }

/// Rolling ground; level across the trail, and sunk there a little.
double ground_y(double x, double z) noexcept {
    double const hills = 0.8 * sin_cos(x / 37.0 + 0.1).sin * sin_cos(z / 41.0).cos + 0.35 * sin_cos((x + z) / 17.0).sin;
    double const aside = std::abs(x - trail_x(z));
    return hills - 0.12 * (1.0 - smooth_step((aside - 0.6) / 1.6));
}

dvec3 ground_normal(double x, double z) noexcept {
    constexpr double d = 0.25;
    return glm::normalize(dvec3(ground_y(x - d, z) - ground_y(x + d, z), 2.0 * d, ground_y(x, z - d) - ground_y(x, z + d)));
}

/// The ground in squares of 16x16 quads, those of the trail of another colour.
void add_forest_ground(Scene& scene) {
    std::uint32_t const moss = add_material(scene, "moss", {0.17F, 0.18F, 0.07F});
    std::uint32_t const trail = add_material(scene, "trail", {0.33F, 0.25F, 0.16F});
    constexpr int part_quads = 16;
    constexpr double quad_m = ground_side_m / ground_quads;
    auto const corner = [](int i) { return (i - ground_quads / 2) * quad_m; };
    // The columns bend with the trail, so that its borders do; the ground's own borders stay straight.
    auto const bent = [](double x, double z) {
        double const out = 2.0 * x / ground_side_m;
        return x + trail_x(z) * (1.0 - out * out);
    };
    auto const add_vertex = [](Primitive& out, double x, double z) {
        out.positions.push_back(math::to_float(dvec3(x, ground_y(x, z), z)));
        out.normals.push_back(math::to_float(ground_normal(x, z)));
    };
    for (int part = 0; part < (ground_quads / part_quads) * (ground_quads / part_quads); ++part) {
        int const x0 = part % (ground_quads / part_quads) * part_quads;
        int const z0 = part / (ground_quads / part_quads) * part_quads;
        std::array<Primitive, 2> kinds;
        for (int z = z0; z < z0 + part_quads; ++z)
            for (int x = x0; x < x0 + part_quads; ++x) {
                bool const on_trail = std::abs(corner(x) + quad_m * 0.5) < quad_m;
                Primitive& out = kinds[on_trail ? 1 : 0];
                auto const a = static_cast<std::uint32_t>(out.positions.size());
                for (int k = 0; k < 4; ++k) add_vertex(out, bent(corner(x + k % 2), corner(z + k / 2)), corner(z + k / 2));
                for (std::uint32_t index : {a, a + 2, a + 1, a + 1, a + 2, a + 3}) out.indices.push_back(index);
            }
        Mesh mesh;
        for (std::size_t k = 0; k < kinds.size(); ++k) {
            kinds[k].material = k == 1 ? trail : moss;
            if (!kinds[k].indices.empty()) mesh.primitives.push_back(std::move(kinds[k]));
        }
        add_instance(scene, "ground", add_mesh(scene, "ground", std::move(mesh)), dvec3(1.0), dvec3(0.0));
    }
}

std::uint32_t add_leaf_material(Scene& scene, std::string name, math::vec3 const& tint) {
    std::uint32_t const index = add_material(scene, std::move(name), tint);
    Material& leaves = scene.materials[index];
    leaves.base_color_texture.texture = 0;
    leaves.alpha_mode = AlphaMode::mask;
    leaves.double_sided = true;
    return index;
}

/// A square of leaves from `stalk` on along `up`, as wide as `side`, which is across.
void add_spray(Mesh& mesh, std::uint32_t material, dvec3 const& stalk, dvec3 const& up, dvec3 const& side) {
    bool const fits = !mesh.primitives.empty() && mesh.primitives.back().material == material &&
                      mesh.primitives.back().indices.size() < 3 * std::size_t{chunk_triangles};
    if (!fits) mesh.primitives.emplace_back().material = material;
    Primitive& out = mesh.primitives.back();
    auto const a = static_cast<std::uint32_t>(out.positions.size());
    math::vec3 const normal = math::to_float(glm::normalize(glm::cross(side, up)));
    for (int k = 0; k < 4; ++k) {
        out.positions.push_back(math::to_float(stalk + side * (k % 2 - 0.5) + up * static_cast<double>(k / 2)));
        out.normals.push_back(normal);
        out.uv0.emplace_back(static_cast<float>(k % 2), static_cast<float>(1 - k / 2));
    }
    for (std::uint32_t index : {a, a + 1, a + 2, a + 1, a + 3, a + 2}) out.indices.push_back(index);
}

dvec3 leaf_direction(Pcg32& random, dvec3 const& along, double spread) noexcept {
    dvec3 d;
    for (int axis = 0; axis < 3; ++axis) d[axis] = random.uniform(-spread, spread);
    return glm::normalize(d + along);
}

/// Bark, and sprays of leaves round the twigs; tops of leaves face up, more or less.
Mesh tree_mesh(TreeShape const& shape, std::array<std::uint32_t, 2> materials, Pcg32& random) {
    Tree const tree = grow_tree(shape, random);
    Mesh mesh;
    add_solid(mesh, tree.bark, materials[0]);
    for (Twig const& twig : tree.twigs)
        for (std::uint32_t i = 0; i < sprays_per_twig; ++i) {
            dvec3 const up = leaf_direction(random, twig.direction, 1.1);
            dvec3 const face = leaf_direction(random, dvec3(0.0, 1.0, 0.0), 0.9);
            dvec3 side = glm::cross(up, face);
            side = glm::length(side) > 0.05 ? glm::normalize(side) : dvec3(1.0, 0.0, 0.0);
            double const size_m = random.uniform(0.42, 0.72);
            add_spray(mesh, materials[1], twig.at_m - twig.direction * (0.12 * i), up * size_m, side * size_m);
        }
    return mesh;
}

void add_trees(Scene& scene, Pcg32& random) {
    constexpr std::size_t forms = 4;
    std::vector<std::uint32_t> meshes;
    for (Species const& s : species) {
        std::string const name = s.name;
        std::uint32_t const bark = add_material(scene, name + " bark", s.bark);
        std::uint32_t const leaves = add_leaf_material(scene, name + " leaves", s.leaves);
        for (std::size_t i = 0; i < forms; ++i)
            meshes.push_back(add_mesh(scene, name, tree_mesh(s.shape, {bark, leaves}, random)));
    }
    for (int i = 0; i < trees_per_side * trees_per_side; ++i) {
        double x = (i % trees_per_side - (trees_per_side - 1) * 0.5) * tree_pitch_m + random.uniform(-2.0, 2.0);
        double const z = (i / trees_per_side - (trees_per_side - 1) * 0.5) * tree_pitch_m + random.uniform(-2.0, 2.0);
        double const aside = x - trail_x(z);
        if (std::abs(aside) < 2.2) x += aside < 0.0 ? -2.2 - aside : 2.2 - aside;  // off the trail
        std::uint32_t const mesh = meshes[random.below(static_cast<std::uint32_t>(meshes.size()))];
        double const turns = random.uniform();
        double const scale = random.uniform(0.85, 1.2);
        add_placed_instance(scene, "tree", mesh, turned_by(turns, dvec3(x, ground_y(x, z), z), scale));
    }
}

/// Low leaves that stand on the ground, in tufts of four.
void add_ferns(Scene& scene, Pcg32& random) {
    std::uint32_t const material = add_leaf_material(scene, "fern", {0.36F, 0.60F, 0.22F});
    Mesh mesh;
    for (int i = 0; i < ferns / 4; ++i) {
        double x = random.uniform(-40.0, 40.0);
        double const z = random.uniform(-40.0, 40.0);
        double const aside = x - trail_x(z);
        if (std::abs(aside) < 1.9) x += aside < 0.0 ? -1.9 : 1.9;
        double const size_m = random.uniform(0.45, 0.85);
        double const turns = random.uniform();
        for (int k = 0; k < 4; ++k) {
            dvec3 const out = level_direction(turns + 0.25 * k);
            dvec3 const side = level_direction(turns + 0.25 * k + 0.25);
            dvec3 const up = glm::normalize(out * 0.8 + dvec3(0.0, 1.0, 0.0));
            add_spray(mesh, material, dvec3(x, ground_y(x, z) - 0.03, z), up * size_m, side * (size_m * 0.8));
        }
    }
    add_instance(scene, "ferns", add_mesh(scene, "ferns", std::move(mesh)), dvec3(1.0), dvec3(0.0));
}

Stop trail_stop(double z) noexcept {
    dvec3 const eye(trail_x(z), ground_y(trail_x(z), z) + 1.7, z);
    double const ahead = z - 7.0;
    return {eye, dvec3(trail_x(ahead), ground_y(trail_x(ahead), ahead) + 2.2, ahead)};
}

}  // namespace

Result<Scene> make_forest(ProceduralConfig const& config) {
    Scene scene;
    scene.name = "forest";
    scene.images.push_back(paint_leaves(128));
    Texture texture;
    texture.image = 0;
    texture.wrap_u = math::Wrap::clamp;
    texture.wrap_v = math::Wrap::clamp;
    scene.textures.push_back(texture);
    Pcg32 random(seed_of(config, 12345));
    add_forest_ground(scene);
    add_trees(scene, random);
    add_ferns(scene, random);
    scene.lights.push_back(sun_light());
    Lens const lens{sixty_degrees_rad, 0.1, 300.0};
    scene.cameras.push_back(view_from("trail", trail_stop(24.0), lens));
    scene.cameras.push_back(view_from("above", {{-46.0, 30.0, 58.0}, {-4.0, 2.0, 4.0}}, lens));
    return scene;
}

/// Along the trail at 1.5 m/s, the head turning a little.
Result<CameraPath> make_forest_path(ProceduralConfig const&, PathInfo const& info) {
    CameraPath path{std::string(info.name), info.rate_hz, {}};
    for (std::uint32_t i = 0; i < info.frames; ++i) {
        double const z = 24.0 - 1.5 * i / info.rate_hz;
        Stop stop = trail_stop(z);
        stop.target_m.x += 1.6 * sin_cos(2.0 * i / info.frames).sin;
        path.frames.push_back(view_from("", stop, {sixty_degrees_rad, 0.1, 300.0}));
    }
    return path;
}

}  // namespace gnomon::scene::detail
