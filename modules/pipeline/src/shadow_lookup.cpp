// The kernel `shadow_lookup`: its C++ half, and what stands in its buffers.

#include "shadow_map.hpp"

#include <gnomon/projection/cube.hpp>
#include <shaders/shadow_lookup_comp.hpp>

#include <array>
#include <cstring>
#include <span>

namespace gnomon::pipeline {

namespace {

template <class Texel>
void look_up_range(backend::KernelData const& data, ShadowLookupStd const& constants, std::size_t begin,
                   std::size_t end) {
    auto const samples = data.buffer<sample::ViewSample const>(0);
    auto const normals = data.buffer<math::vec3 const>(1);
    auto const reached = data.buffer<std::uint8_t const>(2);
    auto const visibility = data.buffer<float>(4);
    auto const bias_m = data.buffer<float>(5);
    auto const maps = data.buffer<shadow::MapView const>(3);
    math::vec3 const light(constants.light[0], constants.light[1], constants.light[2]);
    for (std::size_t i = begin; i < end; ++i) {
        formula::GnLookup<float> seen{0.0F, 0.0F};
        if (reached[i] != 0) {
            math::vec3 const& position = samples[i].position;
            std::size_t const map = map_of(position, light, constants.maps);
            shadow::Texels<Texel> const texels{data.targets[0].layer<Texel>(static_cast<std::uint32_t>(map)),
                                               data.targets[0].size_px.x};
            seen = gn_look_up(maps[map], texels, formula::Vec3<float>(position), formula::Vec3<float>(normals[i]),
                              constants.config);
        }
        visibility[i] = seen.visibility.v;
        bias_m[i] = seen.bias_m.v;
    }
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

ShadowLookupStd to_std(Frame const& frame, ShadowMapOptions const& options, std::size_t maps) noexcept {
    math::vec3 const& light = frame.light_position;
    return {.count = static_cast<std::uint32_t>(frame.samples.size()),
            .maps = static_cast<std::uint32_t>(maps),
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
