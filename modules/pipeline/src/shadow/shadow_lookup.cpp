// The kernel `shadow_lookup`: its C++ half, and what stands in its buffers.

#include "shadow_map.hpp"

#include "look_up_blocks.hpp"

#include <gnomon/projection/cube.hpp>
#include <shaders/shadow_lookup_comp.hpp>

#include <cstdint>

namespace gnomon::pipeline {

namespace {

void look_up_lights(backend::KernelData const& data, std::size_t begin, std::size_t end) {
    auto const c = data.constant<ShadowLookupStd>();
    auto const samples = data.buffer<sample::ViewSample const>(0);
    math::vec3 const light(c.light[0], c.light[1], c.light[2]);
    look_up_blocks(data, {c.maps, c.unorm16 != 0, c.config}, begin, end,
                   [&](std::size_t i) { return MapChoice{static_cast<std::uint32_t>(map_of(samples[i].position, light, c.maps))}; });
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
                                                     .cpu = &look_up_lights,
                                                     .spirv = shadow_lookup_comp,
                                                     .buffers = 6,
                                                     .targets = 1,
                                                     .constant_bytes = sizeof(ShadowLookupStd),
                                                     .grain = sample_grain};

}  // namespace gnomon::pipeline
