#pragma once
// Bit planes: a bit per light and cluster.
//
// Layout: lights in groups of 32; of each group a plane of one 32-bit word a cluster, in the clusters' dense order. Bit b
// of word `words[g * stride + cluster]` is light 32 g + b. A shader reads one word a group and walks its bits; a light's
// row of clusters is a run of words, so that writing it is a few wide ORs; and planes of several groups are independent.
// 4,096 lights on 6,480 clusters are 3.3 MB.

#include <gnomon/cull/rows.hpp>
#include <gnomon/lights/admit.hpp>
#include <gnomon/lights/detail/planes_rows.hpp>
#include <gnomon/lights/light.hpp>

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace gnomon::lights {

struct BitPlanes {
    std::uint32_t groups = 0;
    std::size_t stride = 0;            ///< words from plane to plane: the clusters, and at least 8 words that stay 0
    std::vector<std::uint32_t> words;  ///< groups * stride

    [[nodiscard]] bool has(std::size_t cluster, std::uint32_t light) const noexcept {
        return (words[light / 32 * stride + cluster] >> (light % 32) & 1U) != 0;
    }
};

struct PlanesConfig {
    std::uint32_t layers = ~0U;
    bool lanes = true;  ///< false: the scalar code, which gives the same bits
};

/// Sets in `out` the bit of every light and cluster that the predicate of `cull` (formula/rows.glsl) lets touch.
///
/// expects: the lights in the grid's culling space.
/// cost:    O(clusters lights / 32 + rows touched); allocates when `work` or `out` grow.
inline Report assign_planes(cull::RowGrid const& grid, std::span<Light const> lights, PlanesConfig const& config, Workspace& work,
                            BitPlanes& out) {
    Report const report = admit(lights, config.layers, work);
    out.groups = static_cast<std::uint32_t>((lights.size() + 31) / 32);
    out.stride = (grid.clusters() + 8 + 15) / 16 * 16;
    out.words.resize(out.groups * out.stride);
    detail::PlaneTarget const target{out.words.data(), out.stride, out.groups};
    detail::scatter_planes(grid, lights, work, target, config.lanes);
    return report;
}

}  // namespace gnomon::lights
