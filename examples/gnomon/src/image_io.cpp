#include "image_io.hpp"

// The writer is included here only, as system code: its warnings are not ours to fix.
#define STBI_WRITE_NO_STDIO
#define STB_IMAGE_WRITE_STATIC
#define STB_IMAGE_WRITE_IMPLEMENTATION
#if defined(__GNUC__)
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wunused-function"
#endif
#include <stb_image_write.h>
#if defined(__GNUC__)
#pragma GCC diagnostic pop
#endif

#include <algorithm>
#include <cstddef>

namespace gnomon::command {

Picture thickened(Picture const& picture) {
    Picture wide = picture;
    auto const channels = static_cast<std::size_t>(picture.channels);
    int const width = picture.size_px.x;
    auto const at = [&](int x, int y) {
        return (static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x)) * channels;
    };
    for (int y = 0; y < picture.size_px.y; ++y)
        for (int x = 0; x < width; ++x) {
            unsigned char const* const from = &picture.pixels[at(x, y)];
            if (from[0] == from[1] && from[1] == from[2]) continue;
            for (int v = std::max(y - 1, 0); v <= std::min(y + 1, picture.size_px.y - 1); ++v)
                for (int u = std::max(x - 1, 0); u <= std::min(x + 1, width - 1); ++u)
                    std::copy_n(from, channels, &wide.pixels[at(u, v)]);
        }
    return wide;
}

Bytes png_from(Picture const& picture) {
    Bytes png;
    if (picture.empty()) return png;
    auto const append = [](void* context, void* data, int size) {
        auto const* first = static_cast<unsigned char const*>(data);
        static_cast<Bytes*>(context)->insert(static_cast<Bytes*>(context)->end(), first, first + size);
    };
    stbi_write_png_to_func(append, &png, picture.size_px.x, picture.size_px.y, picture.channels, picture.pixels.data(),
                           0);
    return png;
}

std::string data_uri(std::span<unsigned char const> file) {
    static constexpr char digits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    bool const webp = file.size() > 4 && file[0] == 'R' && file[1] == 'I' && file[2] == 'F' && file[3] == 'F';
    std::string text = webp ? "data:image/webp;base64," : "data:image/png;base64,";
    text.reserve(text.size() + (file.size() + 2) / 3 * 4);
    for (std::size_t i = 0; i < file.size(); i += 3) {
        std::size_t const have = file.size() - i;
        unsigned const a = file[i];
        unsigned const b = have > 1 ? file[i + 1] : 0u;
        unsigned const c = have > 2 ? file[i + 2] : 0u;
        unsigned const word = a << 16 | b << 8 | c;
        text += digits[word >> 18 & 63];
        text += digits[word >> 12 & 63];
        text += have > 1 ? digits[word >> 6 & 63] : '=';
        text += have > 2 ? digits[word & 63] : '=';
    }
    return text;
}

}  // namespace gnomon::command
