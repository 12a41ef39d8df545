#pragma once
// What an alpha test decides wherever it needs no texel: two bits for each cell between four texel centres.

#include <gnomon/raster/draw.hpp>

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace gnomon::raster {

/// Which bilinear cells of a texture pass or fail an alpha test whatever the weights.
///
/// An alpha-tested sample looks its cell up here first; most lie in cells that decide it, and touch no texel. The map
/// of a texture of 1024 x 1024 texels takes 256 KiB, which stays in a second-level cache where 4 MiB of texels do not.
/// Cell (k, l) holds the coordinates between the centres of texels k - 1 and k, l - 1 and l, as the texture wraps:
/// there is one cell more than texels each way.
class AlphaMap {
  public:
    enum class Cell : std::uint8_t {
        mixed = 0,  ///< The texels decide.
        clear = 1,  ///< Below the cutoff everywhere.
        solid = 2,  ///< At the cutoff or above everywhere.
    };

    AlphaMap() = default;

    /// expects: 0 <= column <= width, 0 <= row <= height of the texture.
    [[nodiscard]] Cell cell(std::int32_t column, std::int32_t row) const noexcept;
    /// Whether it was made of a test with this texture's address, size and wrapping, and these numbers.
    [[nodiscard]] bool is_of(AlphaTest const& test) const noexcept;

    /// 4 x 4 cells a word, row by row, the first cell in the lowest bits.
    [[nodiscard]] std::span<std::uint32_t const> words() const noexcept { return words_; }
    [[nodiscard]] std::int32_t words_across() const noexcept { return (size_px_.x + 4) / 4; }

  private:
    friend AlphaMap make_alpha_map(AlphaTest const& test);

    std::vector<std::uint32_t> words_;
    std::uint8_t const* texels_ = nullptr;
    math::ivec2 size_px_{0, 0};
    math::Wrap wrap_u_ = math::Wrap::repeat;
    math::Wrap wrap_v_ = math::Wrap::repeat;
    double factor_ = 1.0;
    double cutoff_ = 0.5;
};

/// Reads all texels of a test once. A pass uses it through `AlphaTest::map`; the image is the same without.
///
/// A cell is solid (clear) where its least (greatest) alpha times the factor is at the cutoff or above (below) by more
/// than 2^-40 of itself: the roundings of the test itself, at most twelve of 2^-53, cannot turn that over. Alphas,
/// weights and factor are not negative, so nothing cancels.
/// returns: the map; all mixed for factors out of [2^-100, 2^100]; empty for a texture that is not complete.
/// cost:    O(texels); about 1 ms for a million. Allocates a 16th of a byte for each byte of RGBA.
[[nodiscard]] AlphaMap make_alpha_map(AlphaTest const& test);

}  // namespace gnomon::raster
