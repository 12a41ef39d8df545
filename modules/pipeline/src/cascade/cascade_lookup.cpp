// The kernel `cascade_lookup`, its C++ half: by blocks of samples, map by map, so that each group of lanes reads one.

#include "cascade_lookup.hpp"

#include <gnomon/cascade/select.hpp>
#include <gnomon/shadow/look_up_many.hpp>
#include <shaders/cascade_lookup_comp.hpp>

#include <algorithm>
#include <array>

namespace gnomon::pipeline {

namespace {

constexpr std::size_t block_size = 256;

struct Block {
    std::array<cascade::CascadeChoice, block_size> choice;
    std::array<shadow::Surface, block_size> surfaces;
    std::array<std::size_t, block_size> sample;
    std::array<float, block_size> weight;
    std::array<shadow::Lookup, block_size> seen;
};

cascade::CascadeChoice choose(backend::KernelData const& data, CascadeLookupStd const& c, std::size_t i) {
    math::vec3 const way = data.buffer<sample::ViewSample const>(0)[i].position - math::vec3(c.eye[0], c.eye[1], c.eye[2]);
    float const depth_m = (way.x * c.sight[0] + way.y * c.sight[1]) + way.z * c.sight[2];
    return cascade::choose_by_depth(data.buffer<cascade::CascadeDepths const>(6)[0], depth_m);
}

/// The block's samples that look into `map`, and with which weight.
std::size_t gather(backend::KernelData const& data, std::size_t begin, std::size_t end, std::uint32_t map, Block& block) {
    auto const samples = data.buffer<sample::ViewSample const>(0);
    auto const normals = data.buffer<math::vec3 const>(1);
    std::size_t count = 0;
    for (std::size_t i = begin; i < end; ++i) {
        cascade::CascadeChoice const& choice = block.choice[i - begin];
        bool const second = choice.next == map && choice.blend > 0.0F;
        if (choice.cascade != map && !second) continue;
        block.surfaces[count] = {samples[i].position, normals[i]};
        block.weight[count] = second ? choice.blend : 1.0F - choice.blend;
        block.sample[count++] = i;
    }
    return count;
}

template <class Texel>
void look_up_block(backend::KernelData const& data, CascadeLookupStd const& constants, std::size_t begin, std::size_t end) {
    auto const reached = data.buffer<std::uint8_t const>(2);
    auto const maps = data.buffer<shadow::MapView const>(3);
    auto const visibility = data.buffer<float>(4);
    auto const bias_m = data.buffer<float>(5);
    std::uint32_t const count = data.buffer<cascade::CascadeDepths const>(6)[0].count;
    Block block;
    for (std::size_t i = begin; i < end; ++i) {
        cascade::CascadeChoice& choice = block.choice[i - begin];
        choice = choose(data, constants, i);
        if (reached[i] == 0) choice = {count, count, 0.0F};
        visibility[i] = reached[i] != 0 && choice.cascade == count ? 1.0F : 0.0F;
        bias_m[i] = 0.0F;
    }
    for (std::uint32_t map = 0; map < count; ++map) {
        std::size_t const found = gather(data, begin, end, map, block);
        shadow::Texels<Texel> const texels{data.targets[0].layer<Texel>(map), data.targets[0].size_px.x};
        shadow::look_up_many(maps[map], texels, constants.config, std::span(block.surfaces).first(found), block.seen);
        for (std::size_t k = 0; k < found; ++k) {
            visibility[block.sample[k]] += block.weight[k] * block.seen[k].visibility;
            bias_m[block.sample[k]] += block.weight[k] * block.seen[k].bias_m;
        }
    }
}

void look_up(backend::KernelData const& data, std::size_t begin, std::size_t end) {
    auto const constants = data.constant<CascadeLookupStd>();
    for (std::size_t i = begin; i < end; i += block_size) {
        std::size_t const last = std::min(end, i + block_size);
        if (constants.unorm16 != 0) look_up_block<std::uint16_t>(data, constants, i, last);
        else look_up_block<float>(data, constants, i, last);
    }
}

}  // namespace

constinit backend::Kernel const cascade_lookup_kernel{.name = "cascade_lookup",
                                                      .cpu = &look_up,
                                                      .spirv = cascade_lookup_comp,
                                                      .buffers = 7,
                                                      .targets = 1,
                                                      .constant_bytes = sizeof(CascadeLookupStd),
                                                      .grain = sample_grain};

}  // namespace gnomon::pipeline
