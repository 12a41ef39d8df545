#pragma once
// A small kernel with both halves, for the tests of backends.

#include <gnomon/backend/kernel.hpp>

#include "shaders/affine_comp.hpp"

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

}  // namespace gnomon::vulkan::test
