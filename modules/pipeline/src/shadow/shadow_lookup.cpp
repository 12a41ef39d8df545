// The kernel `shadow_lookup`: its C++ half, and what stands in its buffers.

#include "shadow_map.hpp"

#include <gnomon/projection/cube.hpp>
#include <gnomon/shadow/look_up_many.hpp>
#include <shaders/shadow_lookup_comp.hpp>

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>
#include <span>

namespace gnomon::pipeline {

namespace {

/// Samples that are looked up together: by map, so that each group of lanes reads one.
constexpr std::size_t block_size = 256;

struct Block {
    std::array<shadow::Surface, block_size> surfaces;
    std::array<std::size_t, block_size> sample;
    std::array<shadow::Lookup, block_size> seen;
    std::array<std::uint8_t, block_size> map;
};

constexpr std::uint8_t not_reached = 255;

/// The block's samples that `map` sees, and how many.
std::size_t gather(backend::KernelData const& data, std::size_t begin, std::size_t end, std::uint8_t map, Block& block) {
    auto const samples = data.buffer<sample::ViewSample const>(0);
    auto const normals = data.buffer<math::vec3 const>(1);
    std::size_t count = 0;
    for (std::size_t i = begin; i < end; ++i) {
        if (block.map[i - begin] != map) continue;
        block.surfaces[count] = {samples[i].position, normals[i]};
        block.sample[count++] = i;
    }
    return count;
}

template <class Texel>
void look_up_block(backend::KernelData const& data, ShadowLookupStd const& constants, std::size_t begin,
                   std::size_t end) {
    auto const samples = data.buffer<sample::ViewSample const>(0);
    auto const reached = data.buffer<std::uint8_t const>(2);
    auto const visibility = data.buffer<float>(4);
    auto const bias_m = data.buffer<float>(5);
    auto const maps = data.buffer<shadow::MapView const>(3);
    math::vec3 const light(constants.light[0], constants.light[1], constants.light[2]);
    Block block;
    for (std::size_t i = begin; i < end; ++i) {
        std::size_t const map = map_of(samples[i].position, light, constants.maps);
        block.map[i - begin] = reached[i] != 0 ? static_cast<std::uint8_t>(map) : not_reached;
        visibility[i] = 0.0F;
        bias_m[i] = 0.0F;
    }
    for (std::uint32_t map = 0; map < constants.maps; ++map) {
        std::size_t const count = gather(data, begin, end, static_cast<std::uint8_t>(map), block);
        shadow::Texels<Texel> const texels{data.targets[0].layer<Texel>(map), data.targets[0].size_px.x};
        shadow::look_up_many(maps[map], texels, constants.config, std::span(block.surfaces).first(count), block.seen);
        for (std::size_t k = 0; k < count; ++k) {
            visibility[block.sample[k]] = block.seen[k].visibility;
            bias_m[block.sample[k]] = block.seen[k].bias_m;
        }
    }
}

template <class Texel>
void look_up_range(backend::KernelData const& data, ShadowLookupStd const& constants, std::size_t begin,
                   std::size_t end) {
    for (std::size_t i = begin; i < end; i += block_size)
        look_up_block<Texel>(data, constants, i, std::min(end, i + block_size));
}

void look_up(backend::KernelData const& data, std::size_t begin, std::size_t end) {
    auto const constants = data.constant<ShadowLookupStd>();
    if (constants.unorm16 != 0)
        look_up_range<std::uint16_t>(data, constants, begin, end);
    else
        look_up_range<float>(data, constants, begin, end);
}

}  // namespace

std::size_t map_of(math::vec3 const& position, math::vec3 const& light, std::size_t maps) noexcept {
    return maps == 1 ? 0 : static_cast<std::size_t>(projection::face_of(position - light));
}

ShadowLookupStd to_std(Frame const& frame, ShadowMaps const& shadow, ShadowMapOptions const& options) noexcept {
    math::vec3 const& light = shadow.at.position;
    return {.count = static_cast<std::uint32_t>(frame.samples.size()),
            .maps = static_cast<std::uint32_t>(shadow.maps.size()),
            .unorm16 = is_narrow(options) ? 1U : 0U,
            .light = {light.x, light.y, light.z},
            .config = shadow::formula_config(options.lookup)};
}

constinit backend::Kernel const shadow_lookup_kernel{.name = "shadow_lookup",
                                                     .cpu = &look_up,
                                                     .spirv = shadow_lookup_comp,
                                                     .buffers = 6,
                                                     .targets = 1,
                                                     .constant_bytes = sizeof(ShadowLookupStd),
                                                     .grain = sample_grain};

}  // namespace gnomon::pipeline
