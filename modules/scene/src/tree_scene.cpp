// `tree`: one large bare tree on a slab.

#include "detail/branching.hpp"
#include "detail/generators.hpp"
#include "detail/grid_mesh.hpp"
#include "detail/rail.hpp"

#include <array>

namespace gnomon::scene::detail {

namespace {

using math::dvec3;

constexpr std::array<BranchLevel, 4> tree_levels{{
    {1, 12, 14, 0.72, 0.0, 0.08, 0.02},
    {14, 9, 10, 0.78, 0.19, 0.13, 0.06},
    {8, 6, 6, 0.46, 0.14, 0.17, 0.05},
    {8, 4, 4, 0.44, 0.13, 0.2, 0.02},
}};

}  // namespace

Result<Scene> make_tree(ProceduralConfig const& config) {
    Scene scene;
    scene.name = "tree";
    Pcg32 random(seed_of(config, 12345));
    std::uint32_t const bark = add_material(scene, "bark", {0.24F, 0.16F, 0.10F});
    TreeShape const shape{14.0, 0.5, 0.22, 0.45, tree_levels};
    Mesh tree;
    add_solid(tree, grow_tree(shape, random).bark, bark);
    add_instance(scene, "tree", add_mesh(scene, "tree", std::move(tree)), dvec3(1.0), dvec3(0.0));
    Lattice slab;
    slab.cells = math::ivec3(24, 1, 24);
    slab.lo = dvec3(-14.0, -0.4, -14.0);
    slab.hi = dvec3(14.0, 0.0, 14.0);
    std::uint32_t const clay = add_material(scene, "slab", {0.42F, 0.39F, 0.32F});
    add_instance(scene, "slab", add_mesh(scene, "slab", box_mesh(slab, clay, clay, true)), dvec3(1.0), dvec3(0.0));
    scene.lights.push_back(lamp({-9.0, 25.0, 3.0}, 20.0));
    Lens const lens{sixty_degrees_rad * 0.75, 0.5, 200.0};
    scene.cameras.push_back(view_from("A", {{-7.0, 8.5, 19.0}, {1.4, 4.9, -1.0}}, lens));
    scene.cameras.push_back(view_from("B", {{15.0, 3.5, 13.0}, {0.5, 5.2, -1.0}}, lens));
    scene.cameras.push_back(view_from("C", {{17.5, 5.0, -9.0}, {0.6, 4.8, -0.6}}, lens));
    return scene;
}

}  // namespace gnomon::scene::detail
