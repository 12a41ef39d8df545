#pragma once
// What is drawn: triangles in the caller's own buffers, a matrix, and nothing copied.

#include <gnomon/backend/instances.hpp>
#include <gnomon/core/strided_span.hpp>
#include <gnomon/math/texel.hpp>
#include <gnomon/math/vec.hpp>

#include <cstddef>
#include <cstdint>
#include <span>

// A table that the CPU backend reads an alpha test faster with. Only named here: see `AlphaTest::map`.
namespace gnomon::raster {
class AlphaMap;
}

namespace gnomon::backend {

/// Which triangles are left out by the way they face. Front: counter-clockwise as seen in the image (y down, as looked
/// at), which is glTF's counter-clockwise from outside.
enum class Cull : std::uint8_t {
    none,
    back,
    front,
};

/// 16- or 32-bit indices, three for each triangle; without any, positions come in threes as they lie.
class IndexSpan {
  public:
    constexpr IndexSpan() noexcept = default;
    constexpr IndexSpan(std::span<std::uint32_t const> wide) noexcept  // NOLINT: converts as spans do
        : wide_(wide.data()), size_(wide.size()) {}
    constexpr IndexSpan(std::span<std::uint16_t const> narrow) noexcept  // NOLINT
        : narrow_(narrow.data()), size_(narrow.size()) {}

    [[nodiscard]] constexpr std::size_t size() const noexcept { return size_; }
    [[nodiscard]] constexpr bool empty() const noexcept { return size_ == 0; }
    /// The 32-bit indices, or null when they have 16 bits or there are none.
    [[nodiscard]] constexpr std::uint32_t const* wide() const noexcept { return wide_; }
    [[nodiscard]] constexpr std::uint16_t const* narrow() const noexcept { return narrow_; }
    [[nodiscard]] constexpr std::uint32_t operator[](std::size_t i) const noexcept {
        return wide_ != nullptr ? wide_[i] : narrow_[i];
    }

  private:
    std::uint32_t const* wide_ = nullptr;
    std::uint16_t const* narrow_ = nullptr;
    std::size_t size_ = 0;
};

/// Makes a draw's triangles holes where their alpha is below the cutoff: mip 0, bilinear, >= cutoff, in double.
struct AlphaTest {
    core::StridedSpan<math::vec2> uv;  ///< One for each position.
    math::AlphaTexture texture;
    double factor = 1.0;  ///< Multiplies the texture's alpha (glTF: baseColorFactor's).
    double cutoff = 0.5;
    /// Optional, for the CPU: `raster::make_alpha_map` of this test. Makes a pass faster and changes nothing; one of
    /// another test is not used.
    raster::AlphaMap const* map = nullptr;
};

/// Triangles to draw. Corner positions become `clip_from_relative * (position - origin, 1)`, both steps in float.
struct Draw {
    core::StridedSpan<math::vec3> positions;
    IndexSpan indices;
    math::vec3 origin{0.0F, 0.0F, 0.0F};
    math::mat4 clip_from_relative{1.0F};
    std::uint32_t first_triangle = 0;  ///< Id of the draw's first triangle in a visibility target.
    Cull cull = Cull::none;
    AlphaTest const* alpha_test = nullptr;  ///< Null draws solid triangles. Must outlive the pass.
    /// Copies: corners become `clip_from_instance(..) * (position, 1)`. Ids go on from instance to instance by
    /// `triangle_count(draw)`.
    InstanceSpan instances{};
    std::uint64_t groups = ~std::uint64_t{0};  ///< In a layered pass: drawn into the layers that share a bit.
};

/// Number of whole triangles of the draw, or of each of its instances.
[[nodiscard]] inline std::size_t triangle_count(Draw const& draw) noexcept {
    return (draw.indices.empty() ? draw.positions.size() : draw.indices.size()) / 3;
}

}  // namespace gnomon::backend
