#pragma once
// Small kernels with both halves, for the tests of backends.

#include <gnomon/backend/depth_kernel.hpp>
#include <gnomon/backend/kernel.hpp>

#include "shaders/affine_comp.hpp"
#include "shaders/covered_comp.hpp"
#include "shaders/scroll_map_frag.hpp"

#include <cstddef>
#include <cstdint>
#include <span>

namespace gnomon::vulkan::test {

struct Affine {
    std::uint32_t count;
    std::uint32_t scale;
    std::uint32_t bias;
};

/// Buffer 1 [i] = buffer 0 [i] * scale + bias.
inline constexpr backend::Kernel affine_kernel{
    .name = "affine",
    .cpu =
        [](backend::KernelData const& data, std::size_t begin, std::size_t end) {
            auto const affine = data.constant<Affine>();
            std::span<std::uint32_t> const in = data.buffer<std::uint32_t>(0);
            std::span<std::uint32_t> const out = data.buffer<std::uint32_t>(1);
            for (std::size_t i = begin; i < end && i < affine.count; ++i) out[i] = in[i] * affine.scale + affine.bias;
        },
    .spirv = affine_comp,
    .buffers = 2,
    .targets = 0,
    .constant_bytes = sizeof(Affine),
};

struct Covered {
    std::uint32_t width;
    std::uint32_t height;
    std::uint32_t layer;
};

/// Buffer 0 [i] = whether pixel i of a layer of target 0 holds another depth than 0.
inline constexpr backend::Kernel covered_kernel{
    .name = "covered",
    .cpu =
        [](backend::KernelData const& data, std::size_t begin, std::size_t end) {
            auto const covered = data.constant<Covered>();
            std::span<std::uint32_t> const out = data.buffer<std::uint32_t>(0);
            float const* const depth = data.targets[0].layer<float>(covered.layer);
            for (std::size_t i = begin; i < end && i < std::size_t{covered.width} * covered.height; ++i)
                out[i] = depth[i] != 0.0F ? 1U : 0U;
        },
    .spirv = covered_comp,
    .buffers = 1,
    .targets = 1,
    .constant_bytes = sizeof(Covered),
};

/// cascade/formula/scroll.glsl over a map, of which there is no C++ half; its constants are a `GnScroll`.
inline constinit backend::DepthKernel const scroll_map_kernel{
    .name = "scroll_map", .cpu = nullptr, .spirv = scroll_map_frag, .targets = 1, .constant_bytes = 32};

}  // namespace gnomon::vulkan::test
