#pragma once
// The kernels that find a tile's lights and shade it in one: what stands in their buffers and constants, laid out by std430.
// The GLSL halves (shaders/*.comp) declare the same.

#include <gnomon/backend/kernel.hpp>
#include <gnomon/lights/hull.hpp>

#include "light_kernels.hpp"

#include <cstdint>

namespace gnomon::pipeline {

// --- shade_tiles: a group of 64 for a tile ---------------------------------------------------------------------------
//
// buffers   0 samples: sample::ViewSample[n]   1 gbuffer: see GBufferTexel   2 lights::ShadedLight[]
//           3 uint sample_of[pixels]: `no_sample` for the background
//           4 float balls[4][lights]: x, y, depth, radius of a light in culling space; infinite: everywhere; below 0: nowhere
//           5 cull::TileBorder borders[columns + 1 + rows + 1]: of columns, then of rows
//           6 out float radiance[n][3]   7 out uint computations[n]   8 out uint lights_of[tiles]; 0 where a tile has no sample
//           9 uint marks[tiles][lights / 32], read if `marked`: the lights of a tile, a bit each
// Lights [first, end) of all, after those before, whose sums and counts 6, 7 and 8 then hold.
// The group finds the nearest and the farthest sample of its tile, tests every light, 64 at a time, against the six planes
// between them, or against the two depths alone if it is marked, and lists those that may reach, in ascending order, in memory that the group shares. Where that is full its samples are shaded and
// the list begins anew: it has no limit. The sum begins with what no light adds.

struct ShadeTilesStd {
    std::uint32_t tile;           ///< Pixels.
    std::uint32_t columns, rows;  ///< Of tiles.
    std::uint32_t width, height;  ///< Of the image.
    std::uint32_t lights;         ///< A multiple of 64: balls beyond the last have negative radii.
    std::uint32_t halves;         ///< 1: the G-buffer has 16 bits a number.
    std::uint32_t orthographic;   ///< 1: `eye` is the direction toward the eye.
    float eye[3];                 ///< Work space, as all of these.
    float from[3];                ///< Depths are along `forward`, from here on.
    float forward[3];
    std::uint32_t marked;
    std::uint32_t first, end;  ///< Multiples of 8.
};
static_assert(sizeof(ShadeTilesStd) == 80);

/// Lights of one run, so that an invocation, a 64th of a tile's pixels under each of them, stays below that; a multiple of 8.
[[nodiscard]] constexpr std::uint32_t lights_of_run(std::uint32_t tile_px) noexcept {
    std::uint32_t const pixels = (tile_px * tile_px + backend::kernel_local_size - 1) / backend::kernel_local_size;
    return most_iterations / pixels / 8 * 8;
}
static_assert(lights_of_run(4) == 40960 && lights_of_run(32) == 2560 && lights_of_run(256) == 40);

/// Lights that a group lists before it shades.
inline constexpr std::uint32_t tile_list_size = 1024;

extern backend::Kernel const shade_tiles_kernel;

// --- mark_tiles: the triangles of lights' hulls, rasterized into an image of one pixel a tile -------------------------
//
// buffers   0 lights::Hull[lights]   1 float borders[columns + 1 + rows + 1]   2 marks: bits are set, in any order
// An item is a triangle, 20 of a light, in a band of rows. Of a light that is everywhere the first marks all tiles.

struct MarkTilesStd {
    std::uint32_t count;  ///< Items.
    std::uint32_t columns, rows;
    std::uint32_t words;  ///< Of a tile's marks.
    std::uint32_t orthographic;
    std::uint32_t bands;
    std::uint32_t band_rows;
};

extern backend::Kernel const mark_tiles_kernel;

}  // namespace gnomon::pipeline
