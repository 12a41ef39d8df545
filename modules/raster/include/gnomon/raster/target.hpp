#pragma once
// Images that a pass writes: views of the caller's memory, row by row, row 0 on top.

#include <gnomon/backend/pass.hpp>
#include <gnomon/core/contract.hpp>

#include <cstddef>
#include <cstdint>

namespace gnomon::raster {

inline constexpr std::int32_t max_size_px = 16384;  ///< Largest width and height of a target or viewport.

using backend::no_triangle;  ///< What a visibility target holds where nothing was drawn.
using backend::Rect;

/// A view of `height` rows of `width` elements, rows `stride` elements apart.
template <class T>
struct ImageView {
    T* data = nullptr;
    std::int32_t width = 0;
    std::int32_t height = 0;
    std::ptrdiff_t stride = 0;

    [[nodiscard]] T* row(std::int32_t y) const noexcept { return data + static_cast<std::ptrdiff_t>(y) * stride; }
    [[nodiscard]] T& at(std::int32_t x, std::int32_t y) const noexcept {
        GNOMON_EXPECT(x >= 0 && x < width && y >= 0 && y < height);
        return row(y)[x];
    }
    /// A part of the image as an image of its own: an atlas tile, a cube face.
    ///
    /// expects: the rectangle lies within the image.
    [[nodiscard]] ImageView sub(Rect const& part) const noexcept {
        GNOMON_EXPECT(part.x >= 0 && part.y >= 0 && part.width >= 0 && part.height >= 0);
        GNOMON_EXPECT(part.x <= width - part.width && part.y <= height - part.height);
        return {row(part.y) + part.x, part.width, part.height, stride};
    }
};

/// A packed image over `data`.
template <class T>
[[nodiscard]] ImageView<T> make_image(T* data, std::int32_t width, std::int32_t height) noexcept {
    return {data, width, height, width};
}

/// What a depth pass writes: float depth, or 16-bit codes c that stand for c / 65535.
///
/// A 16-bit target rounds each depth to the nearest code first and compares codes, as a GPU does.
class DepthTarget {
  public:
    DepthTarget(ImageView<float> image) noexcept : f32_(image) {}  // NOLINT: either image is a target
    DepthTarget(ImageView<std::uint16_t> image) noexcept : unorm16_(image), is_unorm16_(true) {}  // NOLINT

    [[nodiscard]] bool is_unorm16() const noexcept { return is_unorm16_; }
    [[nodiscard]] ImageView<float> const& f32() const noexcept { return f32_; }
    [[nodiscard]] ImageView<std::uint16_t> const& unorm16() const noexcept { return unorm16_; }
    [[nodiscard]] std::int32_t width() const noexcept { return is_unorm16_ ? unorm16_.width : f32_.width; }
    [[nodiscard]] std::int32_t height() const noexcept { return is_unorm16_ ? unorm16_.height : f32_.height; }

  private:
    ImageView<float> f32_;
    ImageView<std::uint16_t> unorm16_;
    bool is_unorm16_ = false;
};

/// What a camera pass writes: which triangle is nearest at each pixel's centre, and its depth.
///
/// expects: both images have the same size.
struct VisibilityTarget {
    ImageView<float> depth;
    ImageView<std::uint32_t> triangle;
};

}  // namespace gnomon::raster
