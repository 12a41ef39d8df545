#pragma once
// A pass laid out on the stack: its layers in chunks of so many views, the views of a chunk in bundles that one call draws.

#include <gnomon/backend/pass.hpp>
#include <gnomon/vulkan/target.hpp>

#include "pass_layout.hpp"

#include <array>
#include <cstdint>
#include <span>

namespace gnomon::vulkan::detail {

/// Views that share viewport, area and rules, each in a layer of its own.
struct Bundle {
    backend::Rect viewport;
    backend::Rect area;
    math::ivec2 subpixel{0, 0};
    math::Depth depth = math::Depth::reversed;
    backend::DepthRange range = backend::DepthRange::clip;
    std::uint32_t first_view = 0;
    std::uint32_t count = 0;
};

struct Chunk {
    std::array<backend::PassLayer const*, max_views> views;  ///< Bundle by bundle.
    std::array<Bundle, max_views> bundles;
    std::uint32_t view_count = 0;
    std::uint32_t bundle_count = 0;
};

struct ChunkLimits {
    std::uint32_t views = max_views;  ///< Of the chunk.
    std::uint32_t bundle = 1;         ///< Views of a bundle.
};

/// Takes layers off the front of `layers` until the chunk is full. Layers without a pixel are dropped.
void next_chunk(Chunk& chunk, std::span<backend::PassLayer const>& layers, math::ivec2 const& size_px,
                ChunkLimits const& limits);

/// Whether the views clear all pixels of layers [first, first + count), all to the same depth.
[[nodiscard]] bool clears_all(std::span<backend::PassLayer const> layers, math::ivec2 const& size_px,
                              std::uint32_t first, std::uint32_t count) noexcept;

[[nodiscard]] ViewData view_data(backend::PassLayer const& layer) noexcept;

}  // namespace gnomon::vulkan::detail
