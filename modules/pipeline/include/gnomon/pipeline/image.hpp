#pragma once
// A picture in memory: 8-bit sRGB, rows from the top. Writing files is the caller's business.

#include <gnomon/math/vec.hpp>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace gnomon::pipeline {

/// `rgb` holds 3 bytes a pixel, row by row from the top left; `size_px.x * size_px.y * 3` in all.
struct Image {
    math::ivec2 size_px{0, 0};
    std::vector<std::uint8_t> rgb;
};

/// The size in pixels, as an index type.
[[nodiscard]] inline std::size_t pixel_count(math::ivec2 const& size_px) noexcept {
    return static_cast<std::size_t>(size_px.x) * static_cast<std::size_t>(size_px.y);
}

}  // namespace gnomon::pipeline
