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

namespace gnomon::command {

Bytes png_from(Picture const& picture) {
    Bytes png;
    if (picture.empty()) return png;
    auto const append = [](void* context, void* data, int size) {
        auto const* first = static_cast<unsigned char const*>(data);
        static_cast<Bytes*>(context)->insert(static_cast<Bytes*>(context)->end(), first, first + size);
    };
    stbi_write_png_to_func(append, &png, picture.size_px.x, picture.size_px.y, picture.channels, picture.pixels.data(), 0);
    return png;
}

std::string data_uri(std::span<unsigned char const> png) {
    static constexpr char digits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string text = "data:image/png;base64,";
    text.reserve(text.size() + (png.size() + 2) / 3 * 4);
    for (std::size_t i = 0; i < png.size(); i += 3) {
        std::size_t const have = png.size() - i;
        unsigned const a = png[i];
        unsigned const b = have > 1 ? png[i + 1] : 0u;
        unsigned const c = have > 2 ? png[i + 2] : 0u;
        unsigned const word = a << 16 | b << 8 | c;
        text += digits[word >> 18 & 63];
        text += digits[word >> 12 & 63];
        text += have > 1 ? digits[word >> 6 & 63] : '=';
        text += have > 2 ? digits[word & 63] : '=';
    }
    return text;
}

}  // namespace gnomon::command
