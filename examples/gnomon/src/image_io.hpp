#pragma once
// Pictures in memory and as PNG.

#include <gnomon/math/vec.hpp>

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace gnomon::command {

using Bytes = std::vector<unsigned char>;

/// 8-bit sRGB, `channels` bytes a pixel (3, or 4 with alpha), rows from the top.
struct Picture {
    math::ivec2 size_px{0, 0};
    int channels = 3;
    Bytes pixels;

    [[nodiscard]] bool empty() const noexcept { return pixels.empty(); }
};

/// The picture with every pixel that is not grey drawn three pixels wide, so that it can be seen when scaled down.
[[nodiscard]] Picture thickened(Picture const& picture);

/// The picture as a PNG file's bytes; empty for an empty picture.
[[nodiscard]] Bytes png_from(Picture const& picture);

/// "data:image/png;base64,...", or image/webp by the file's first bytes, for pages that carry their pictures with them.
[[nodiscard]] std::string data_uri(std::span<unsigned char const> file);

}  // namespace gnomon::command
