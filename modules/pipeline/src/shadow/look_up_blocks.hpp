#pragma once
// The C++ half of kernels that look samples up in maps: by blocks of samples, map by map, so that each group of lanes reads one.
//
// buffers   0 samples   1 float normals[n][3]   2 reached   3 shadow::MapView maps[]   4 out float visibility[n]
//           5 out float bias_m[n]; what comes behind is the kernel's own
// targets   0 the maps' depths: layer i is maps[i]

#include <gnomon/shadow/look_up_many.hpp>

#include "kernels.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

namespace gnomon::pipeline {

inline constexpr std::uint32_t no_map = ~std::uint32_t{0};

/// The maps that a sample looks into.
struct MapChoice {
    std::uint32_t map = no_map;
    std::uint32_t next = no_map;  ///< After `map`.
    float blend = 0.0F;           ///< How much of `next`.
    float unseen = 0.0F;          ///< The visibility of a sample that no map sees.
};

/// What a kernel has in its constants.
struct MapLookup {
    std::uint32_t maps = 0;
    bool unorm16 = false;
    formula::GnShadowConfig config;
};

namespace detail {

struct LookupBlock {
    static constexpr std::size_t size = 256;
    std::array<MapChoice, size> choice;
    std::array<shadow::Surface, size> surfaces;
    std::array<std::size_t, size> sample;
    std::array<float, size> weight;
    std::array<bool, size> adds;
    std::array<shadow::Lookup, size> seen;

    /// The block's samples that look into `map`, from sample `begin` on.
    std::size_t gather(backend::KernelData const& data, std::size_t begin, std::size_t end, std::uint32_t map) {
        auto const samples = data.buffer<sample::ViewSample const>(0);
        auto const normals = data.buffer<math::vec3 const>(1);
        std::size_t count = 0;
        for (std::size_t i = begin; i < end; ++i) {
            MapChoice const& c = choice[i - begin];
            bool const second = c.next == map && c.blend > 0.0F;
            if (c.map != map && !second) continue;
            surfaces[count] = {samples[i].position, normals[i]};
            weight[count] = second ? c.blend : 1.0F - c.blend;
            adds[count] = second;
            sample[count++] = i;
        }
        return count;
    }
};

template <class Texel, class Choose>
void look_up_block(backend::KernelData const& data, MapLookup const& lookup, std::size_t begin, std::size_t end, Choose const& choose) {
    auto const reached = data.buffer<std::uint8_t const>(2);
    auto const maps = data.buffer<shadow::MapView const>(3);
    auto const visibility = data.buffer<float>(4);
    auto const bias_m = data.buffer<float>(5);
    LookupBlock block;
    for (std::size_t i = begin; i < end; ++i) {
        block.choice[i - begin] = reached[i] != 0 ? choose(i) : MapChoice{};
        visibility[i] = block.choice[i - begin].unseen;
        bias_m[i] = 0.0F;
    }
    for (std::uint32_t map = 0; map < lookup.maps; ++map) {
        std::size_t const found = block.gather(data, begin, end, map);
        shadow::Texels<Texel> const texels{data.targets[0].layer<Texel>(map), data.targets[0].size_px.x};
        shadow::look_up_many(maps[map], texels, lookup.config, std::span(block.surfaces).first(found), block.seen);
        for (std::size_t k = 0; k < found; ++k) {
            std::size_t const i = block.sample[k];
            float const lit = block.weight[k] * block.seen[k].visibility;
            float const bias = block.weight[k] * block.seen[k].bias_m;
            visibility[i] = block.adds[k] ? visibility[i] + lit : lit;
            bias_m[i] = block.adds[k] ? bias_m[i] + bias : bias;
        }
    }
}

}  // namespace detail

/// Looks samples [begin, end) up; `choose(i)` is the MapChoice of sample i, if the light reaches it.
template <class Choose>
void look_up_blocks(backend::KernelData const& data, MapLookup const& lookup, std::size_t begin, std::size_t end, Choose const& choose) {
    for (std::size_t i = begin; i < end; i += detail::LookupBlock::size) {
        std::size_t const last = std::min(end, i + detail::LookupBlock::size);
        if (lookup.unorm16) detail::look_up_block<std::uint16_t>(data, lookup, i, last, choose);
        else detail::look_up_block<float>(data, lookup, i, last, choose);
    }
}

}  // namespace gnomon::pipeline
