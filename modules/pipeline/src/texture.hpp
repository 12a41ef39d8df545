#pragma once
// Base colour textures for pictures: mip chains in 8-bit sRGB, averaged in linear light, read trilinearly.

#include <gnomon/math/vec.hpp>
#include <gnomon/scene/scene.hpp>

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace gnomon::pipeline {

[[nodiscard]] float linear_from_srgb(std::uint8_t code) noexcept;
[[nodiscard]] std::uint8_t srgb_from_linear(float linear) noexcept;

/// expects: the image it was made of outlives it.
class MipChain {
  public:
    explicit MipChain(scene::Image const& image);

    /// Linear colour at `uv`, averaged over about `texels_per_pixel` texels each way.
    [[nodiscard]] math::vec3 at(math::vec2 const& uv, float texels_per_pixel, scene::Texture const& use) const noexcept;
    [[nodiscard]] math::ivec2 size_px() const noexcept { return levels_.front().size_px; }
    [[nodiscard]] std::size_t levels() const noexcept { return levels_.size(); }
    /// Texels of a level, packed rows.
    [[nodiscard]] std::span<std::uint8_t const> rgba(std::size_t level) const noexcept {
        Level const& l = levels_[level];
        return {l.rgba, static_cast<std::size_t>(l.size_px.x) * static_cast<std::size_t>(l.size_px.y) * 4};
    }

  private:
    struct Level {
        math::ivec2 size_px{0, 0};
        std::uint8_t const* rgba = nullptr;
    };
    [[nodiscard]] math::vec3 bilinear(Level const& level, math::vec2 const& uv,
                                      scene::Texture const& use) const noexcept;

    std::vector<std::vector<std::uint8_t>> storage_;
    std::vector<Level> levels_;
};

}  // namespace gnomon::pipeline
