#pragma once
// The fragment kernel `forward`: a fragment's surface by triangle and pixel, shaded under the lights of its tile or cluster.
// The GLSL half (shaders/forward.frag) declares the same, by std430.

#include <gnomon/backend/fragment.hpp>

#include <cstdint>

namespace gnomon::pipeline {

// buffers   0 VertexStd[]   1 TriangleStd[]   2 MaterialStd[]   3 uint texels[]   4 CameraRaysStd
//           5 lights::ShadedLight[]   6 float slice_depth_m[slices + 1]   7 lights::Cell cells[clusters]: offset, count
//           8 uint indices[]: into the lights
// targets   0 the target's own triangle ids
// The colour's alpha is the number of lights evaluated, or the opacity where `blends`, with the colour times it.

struct ForwardStd {
    std::uint32_t tile = 32;  ///< Pixels.
    std::uint32_t columns = 1, rows = 1, slices = 1;
    std::uint32_t once = 0;    ///< 1: only the triangle that the target's ids name, so that a pixel is shaded once.
    std::uint32_t blends = 0;  ///< 1: transparent.
    std::uint32_t counts = 0;  ///< 1: no light is evaluated, only counted.
};
static_assert(sizeof(ForwardStd) == 28);

inline constexpr std::uint32_t forward_buffers = 9;

extern backend::FragmentKernel const forward_kernel;

}  // namespace gnomon::pipeline
