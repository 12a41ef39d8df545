#pragma once
// The lights of a frame in a tree, 32 to a node [Olsson 2014, Paper II, 3.3]: what lists of few clusters are asked of.

#include <gnomon/bvh/build.hpp>
#include <gnomon/core/contract.hpp>
#include <gnomon/core/executor.hpp>
#include <gnomon/lights/admit.hpp>
#include <gnomon/lights/light.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

namespace gnomon::lights {

/// Of balls: of points, of spots and of boxes. Directional lights are beside it: they are everywhere. 20 bytes a light, and
/// 24 a node of 32.
struct LightTree {
    bvh::Tree<bvh::Spheres, 32> tree;        ///< Its ids are indices of the caller's list.
    std::vector<std::uint32_t> directional;  ///< Ascending.
    bool only_points = true;                 ///< No spot and no box is in the tree.
    Report report;
};

/// Memory of the build, kept from frame to frame: 48 bytes a light.
struct LightTreeWorkspace {
    std::vector<float> x, y, depth, radius;
    bvh::Workspace build;

    struct Block {
        Report report;
        std::uint32_t directional = 0;
        bool only_points = true;
    };
    std::vector<Block> blocks;
};

namespace detail {

inline constexpr std::size_t admit_block = 16384;

/// Balls of lights [begin, end); what takes no part, or is directional, gets a radius that the tree leaves out.
inline void admit_balls(std::span<Light const> lights, std::uint32_t layers, std::size_t begin, LightTreeWorkspace& work) noexcept {
    LightTreeWorkspace::Block block;
    std::size_t const end = std::min(lights.size(), begin + admit_block);
    for (std::size_t i = begin; i < end; ++i) {
        Light const& l = lights[i];
        bool const masked = (l.layers & layers) == 0, bad = !masked && !is_sound(l), directional = l.kind == Kind::directional;
        bool const in_tree = !masked && !bad && !directional;
        block.report.masked += masked ? 1U : 0U;
        block.report.bad += bad ? 1U : 0U;
        block.directional += !masked && !bad && directional ? 1U : 0U;
        block.only_points = block.only_points && (!in_tree || l.kind == Kind::point);
        work.x[i] = l.center.x;
        work.y[i] = l.center.y;
        work.depth[i] = l.center.z;
        work.radius[i] = in_tree ? bounding_radius_m(l) : -1.0F;
    }
    work.blocks[begin / admit_block] = block;
}

}  // namespace detail

/// Builds `tree` over the lights that take part; the same for any executor.
///
/// cost: O(n): 1,048,576 lights take some 10 ms. Allocates only what `work` and `tree` lack.
inline void build_light_tree(std::span<Light const> lights, std::uint32_t layers, LightTreeWorkspace& work, LightTree& tree,
                             core::ExecutorRef executor) {
    GNOMON_EXPECT(lights.size() <= std::size_t{1} << 31U);
    for (auto* list : {&work.x, &work.y, &work.depth, &work.radius}) list->resize(std::max(list->size(), lights.size()));
    work.blocks.assign((lights.size() + detail::admit_block - 1) / detail::admit_block, {});
    auto const admit = [&](std::size_t begin, std::size_t end) {
        for (std::size_t block = begin; block < end; ++block) detail::admit_balls(lights, layers, block * detail::admit_block, work);
    };
    if (work.blocks.size() <= 1) admit(0, work.blocks.size());
    else executor.parallel_for(work.blocks.size(), 1, admit);
    tree.report = {};
    tree.directional.clear();
    tree.only_points = true;
    for (std::size_t b = 0; b < work.blocks.size(); ++b) {
        LightTreeWorkspace::Block const& block = work.blocks[b];
        tree.report.masked += block.report.masked;
        tree.report.bad += block.report.bad;
        tree.only_points = tree.only_points && block.only_points;
        std::size_t const end = std::min(lights.size(), (b + 1) * detail::admit_block);
        for (std::size_t i = b * detail::admit_block; block.directional != 0 && i < end; ++i)
            if (lights[i].kind == Kind::directional && (lights[i].layers & layers) != 0)
                tree.directional.push_back(static_cast<std::uint32_t>(i));
    }
    tree.report.taken = static_cast<std::uint32_t>(lights.size()) - tree.report.masked - tree.report.bad;
    std::size_t const n = lights.size();
    bvh::Spheres const balls{{work.x.data(), n}, {work.y.data(), n}, {work.depth.data(), n}, {work.radius.data(), n}};
    bvh::build(balls, bvh::CodeBits::bits_30, work.build, tree.tree, executor);
}

/// A new tree, on the calling thread.
[[nodiscard]] inline LightTree build_light_tree(std::span<Light const> lights, std::uint32_t layers) {
    LightTreeWorkspace work;
    LightTree tree;
    core::SerialExecutor const serial;
    build_light_tree(lights, layers, work, tree, core::ExecutorRef(serial));
    return tree;
}

}  // namespace gnomon::lights
