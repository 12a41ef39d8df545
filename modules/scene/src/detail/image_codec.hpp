#pragma once
// PNG and JPEG in, PNG out.

#include "file_bytes.hpp"

#include <gnomon/scene/load.hpp>

#include <cstddef>
#include <optional>
#include <span>
#include <string>

namespace gnomon::scene::detail {

/// The image as 8-bit RGBA, at most `max_bytes` of it.
///
/// returns: on failure a phrase that follows the image's name.
core::Result<Image, SceneError> decode_image(std::span<std::byte const> bytes, Limits const& limits, std::uint64_t max_bytes);

/// The image as a PNG file; nothing where memory runs out.
///
/// expects: four bytes per pixel and at least one pixel.
std::optional<Bytes> encode_png(Image const& image);

}  // namespace gnomon::scene::detail
