#pragma once
// What both forms of the box test read: plain data, shared by units that are compiled for different instruction sets.

#include <cstddef>
#include <cstdint>

namespace gnomon::raster::detail {

struct BoxJob {
    float const* boxes;  // Six floats each: lo, hi.
    float origin[3];
    float row[4][4];  // row[r][c]: clip component r from position component c.
    float half_width, half_height;
    std::int32_t offset_x, offset_y;
    float guard_x, guard_y;
    bool clip_depth;
    bool reversed;
    bool quantize;
    std::int32_t x0, y0, x1, y1;  // Pixels that can be seen: scissor and target, end exclusive.
    int levels;
    struct Level {
        float const* farthest;
        std::ptrdiff_t stride;
    } level[12];
    float const* depth;  // The image, in one of its forms, or neither.
    std::uint16_t const* codes;
    std::ptrdiff_t stride;
    std::int32_t width;
};

/// Writes the verdicts (the values of `BoxVerdict`) of boxes [begin, end).
using TestBoxesFn = void (*)(BoxJob const&, std::size_t begin, std::size_t end, std::uint8_t* out);

void scalar_test_boxes(BoxJob const&, std::size_t begin, std::size_t end, std::uint8_t* out);
/// Null where the machine or the build has none.
[[nodiscard]] TestBoxesFn simd_test_boxes() noexcept;

}  // namespace gnomon::raster::detail
