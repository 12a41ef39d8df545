#pragma once
// The kernels that shade under many lights: what stands in their buffers and constants, laid out by std430. The GLSL halves
// (shaders/*.comp) declare the same.

#include <gnomon/backend/kernel.hpp>
#include <gnomon/lights/shade.hpp>
#include <gnomon/sample/view_sample.hpp>

#include "gbuffer.hpp"

#include <cstdint>

namespace gnomon::pipeline {

/// What loops of one invocation may add up to: lavapipe ends them after 65,535 iterations and says nothing, and a device that
/// takes too long over one is reset. Work is split by it: on the CPU too, for the same calls on every backend.
inline constexpr std::uint32_t most_iterations = 40960;

// --- shade_lists: each sample under the lights of its list ------------------------------------------------------------
//
// buffers   0 samples: sample::ViewSample[n]   1 uint gbuffer[n][16 or 8]: see GBufferTexel   2 lights::ShadedLight[]
//           3 uint list_of[n]: which list is a sample's; `no_list`: none   4 lights::Cell cells[]: offset, count
//           5 uint indices[]: into the lights   6 out float radiance[n][3]   7 out uint computations[n]
// The sum begins with what no light adds, and takes the list's lights in its order: those from `first` to `end` in a run,
// after those before, whose sum 6 then holds.

inline constexpr std::uint32_t no_list = 0xFFFFFFFFU;

struct ShadeListsStd {
    std::uint32_t count;         ///< Samples.
    std::uint32_t halves;        ///< 1: the G-buffer has 16 bits a number.
    std::uint32_t orthographic;  ///< 1: `eye` is the direction toward the eye.
    float eye[3];                ///< Work space.
    std::uint32_t first, end;    ///< Places in lists.
};
static_assert(sizeof(ShadeListsStd) == 32);

extern backend::Kernel const shade_lists_kernel;

// --- shade_volume: one light added to the pixels of a rectangle ------------------------------------------------------
//
// buffers   0 samples   1 gbuffer   2 lights::ShadedLight[]   3 uint sample_of[pixels]: `no_sample` for the background
//           4 float radiance[n][3], read and written   5 uint computations[n], read and written
// An item is a pixel of the rectangle. The light is evaluated where its ball's far side is not in front of the sample,
// as back faces drawn with the depth test reversed would have it; with the stencil, where the sample is in the ball.

struct ShadeVolumeStd {
    std::uint32_t x, y, width, height;  ///< Pixels.
    std::uint32_t image_width;
    std::uint32_t light;
    std::uint32_t halves;
    std::uint32_t orthographic;
    float eye[3];
    std::uint32_t stencil;
};
static_assert(sizeof(ShadeVolumeStd) == 48);

extern backend::Kernel const shade_volume_kernel;

}  // namespace gnomon::pipeline
