#include "detail/image_codec.hpp"

#include <cstdint>
#include <limits>

// Static, so that a program with its own stb meets none of these names.
#define STB_IMAGE_STATIC
#define STB_IMAGE_IMPLEMENTATION
#define STBI_ONLY_PNG
#define STBI_ONLY_JPEG
#define STBI_NO_STDIO
#define STBI_NO_HDR
#define STBI_NO_LINEAR
#define STB_IMAGE_WRITE_STATIC
#define STB_IMAGE_WRITE_IMPLEMENTATION
#define STBI_WRITE_NO_STDIO
#if defined(__GNUC__)
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wunused-function"
#endif
#include <stb_image.h>
#include <stb_image_write.h>
#if defined(__GNUC__)
#pragma GCC diagnostic pop
#endif

namespace gnomon::scene::detail {

namespace {

core::Failure<SceneError> bad_image(std::string phrase) { return {SceneError::malformed, std::move(phrase)}; }

/// A progressive JPEG may come back to the whole image in every scan; a hostile one does so thousands of times.
bool has_too_many_scans(std::span<std::byte const> bytes) noexcept {
    constexpr int most = 256;
    int scans = 0;
    for (std::size_t i = 0; i + 1 < bytes.size(); ++i)
        scans += bytes[i] == std::byte{0xFF} && bytes[i + 1] == std::byte{0xDA} ? 1 : 0;
    bool const is_jpeg = bytes.size() > 2 && bytes[0] == std::byte{0xFF} && bytes[1] == std::byte{0xD8};
    return is_jpeg && scans > most;
}

/// No PNG or JPEG packs more bytes of pixels than this into one of its own: 1-bit PNG, all one colour, is the extreme.
constexpr std::uint64_t most_bytes_per_byte = 40'000;

void append(void* context, void* data, int size) {
    auto& out = *static_cast<Bytes*>(context);
    auto const* const bytes = static_cast<std::byte const*>(data);
    out.insert(out.end(), bytes, bytes + size);
}

}  // namespace

core::Result<Image, SceneError> decode_image(std::span<std::byte const> bytes, Limits const& limits, std::uint64_t max_bytes) {
    if (bytes.empty()) return bad_image("is empty");
    if (bytes.size() > static_cast<std::size_t>(std::numeric_limits<int>::max())) return bad_image("is above 2 GiB");
    auto const* const data = reinterpret_cast<stbi_uc const*>(bytes.data());
    auto const size = static_cast<int>(bytes.size());
    int width = 0;
    int height = 0;
    int channels = 0;
    if (stbi_info_from_memory(data, size, &width, &height, &channels) == 0) return bad_image("is neither PNG nor JPEG");
    std::string const dimensions = std::to_string(width) + "x" + std::to_string(height) + " pixels";
    if (width <= 0 || height <= 0) return bad_image("has " + dimensions);
    auto const side = static_cast<std::uint64_t>(limits.max_image_side_px);
    auto const w = static_cast<std::uint64_t>(width);
    auto const h = static_cast<std::uint64_t>(height);
    if (w > side || h > side) return bad_image("has " + dimensions + ", above max_image_side_px");
    if (4 * w * h > max_bytes) return bad_image("has " + dimensions + ", above what is left of max_image_bytes");
    if (4 * w * h / most_bytes_per_byte > bytes.size()) return bad_image("says it has " + dimensions + " and is cut off");
    if (has_too_many_scans(bytes)) return bad_image("passes over its pixels too often");
    stbi_uc* const pixels = stbi_load_from_memory(data, size, &width, &height, &channels, 4);
    if (pixels == nullptr) return bad_image("is damaged");
    Image image;
    image.size_px = math::ivec2(width, height);
    image.rgba.assign(pixels, pixels + 4 * w * h);
    stbi_image_free(pixels);
    return image;
}

std::optional<Bytes> encode_png(Image const& image) {
    Bytes png;
    int const stride = image.size_px.x * 4;
    if (stbi_write_png_to_func(&append, &png, image.size_px.x, image.size_px.y, 4, image.rgba.data(), stride) == 0)
        return std::nullopt;
    return png;
}

}  // namespace gnomon::scene::detail
