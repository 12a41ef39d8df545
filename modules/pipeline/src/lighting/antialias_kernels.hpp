#pragma once
// The kernel `shade_samples`: pixels of four samples shaded, and their mean. The GLSL half (shaders/shade_samples.comp)
// declares the same, by std430.

#include <gnomon/backend/kernel.hpp>
#include <gnomon/math/vec.hpp>

#include <array>
#include <cstdint>

namespace gnomon::pipeline {

// buffers   0 VertexStd[]   1 TriangleStd[]   2 MaterialStd[]   3 uint texels[]   4 CameraRays[1]   5 lights::ShadedLight[]
//           6 lights::Cell cells[tiles]   7 uint indices[]   8 out vec4 colors[pixels]: mean, and lights evaluated
// targets   0 triangle ids: array layer s is sample s

struct ShadeSamplesStd {
    std::uint32_t width, height;
    std::uint32_t tile;
    std::uint32_t columns;
    std::uint32_t edges_only;  ///< 1: once where the four samples show one triangle, else each sample; 0: each triangle once.
};
static_assert(sizeof(ShadeSamplesStd) == 20);

inline constexpr std::uint32_t antialias_samples = 4;

/// Where the samples of a pixel are, from its top left: Vulkan's standard positions.
inline constexpr std::array<math::vec2, antialias_samples> sample_px{math::vec2(0.375F, 0.125F), math::vec2(0.875F, 0.375F),
                                                                     math::vec2(0.125F, 0.625F), math::vec2(0.625F, 0.875F)};

extern backend::Kernel const shade_samples_kernel;

}  // namespace gnomon::pipeline
