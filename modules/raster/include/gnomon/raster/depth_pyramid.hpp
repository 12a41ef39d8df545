#pragma once
// The least and the greatest depth of a depth image by blocks: 8 x 8 samples on level 0, then twice as wide with each
// level, up to a level of one block. It answers "can anything here be nearer than that?" without a look at the samples.

#include <gnomon/core/executor.hpp>
#include <gnomon/math/view.hpp>
#include <gnomon/raster/target.hpp>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace gnomon::raster {

/// Block (x, y) of level k holds the image's samples [x << (3 + k), (x + 1) << (3 + k)) x likewise for y, as far as the
/// image has them. A 16-bit image is held as its codes, 0 to 65535.
///
/// Memory is kept between frames: a second build for an image of at most the same size allocates nothing. 8 bytes a
/// block and level: 1/6 byte a sample.
class DepthPyramid {
  public:
    static constexpr std::int32_t block_shift = 3;
    static constexpr int max_levels = 12;  ///< 8 samples to 16,384.

    /// Makes room for an image of this size. Blocks keep no meaning until they are written.
    void fit(DepthTarget const& image, math::Depth depth);

    [[nodiscard]] int level_count() const noexcept { return levels_; }
    [[nodiscard]] std::int32_t width_px() const noexcept { return width_; }
    [[nodiscard]] std::int32_t height_px() const noexcept { return height_; }
    [[nodiscard]] math::Depth depth() const noexcept { return depth_; }
    [[nodiscard]] bool is_unorm16() const noexcept { return is_unorm16_; }
    [[nodiscard]] std::size_t size_bytes() const noexcept { return storage_.capacity() * sizeof(float); }

    /// The blocks' least depths. Eight elements may be read from any block on: a row has room for them.
    ///
    /// expects: `level` below `level_count()`.
    [[nodiscard]] ImageView<float> least(int level) noexcept { return plane(storage_.data(), level, 0); }
    [[nodiscard]] ImageView<float const> least(int level) const noexcept { return plane(storage_.data(), level, 0); }
    [[nodiscard]] ImageView<float> greatest(int level) noexcept { return plane(storage_.data(), level, 1); }
    [[nodiscard]] ImageView<float const> greatest(int level) const noexcept {
        return plane(storage_.data(), level, 1);
    }
    /// The depths that no sample of a block is farther than: what a nearer thing must beat to be seen.
    [[nodiscard]] ImageView<float const> farthest(int level) const noexcept {
        return depth_ == math::Depth::reversed ? least(level) : greatest(level);
    }
    [[nodiscard]] ImageView<float const> nearest(int level) const noexcept {
        return depth_ == math::Depth::reversed ? greatest(level) : least(level);
    }

  private:
    struct Level {
        std::size_t offset = 0;  // Of the least depths; the greatest follow.
        std::int32_t width = 0;
        std::int32_t height = 0;
        std::int32_t stride = 0;
    };

    template <class T>
    [[nodiscard]] ImageView<T> plane(T* data, int level, int which) const noexcept {
        GNOMON_EXPECT(level >= 0 && level < levels_);
        Level const& l = level_[level];
        std::size_t const size = static_cast<std::size_t>(l.stride) * static_cast<std::size_t>(l.height);
        return {data + l.offset + (which != 0 ? size : 0), l.width, l.height, l.stride};
    }

    std::vector<float> storage_;
    Level level_[max_levels];
    int levels_ = 0;
    std::int32_t width_ = 0;
    std::int32_t height_ = 0;
    math::Depth depth_ = math::Depth::reversed;
    bool is_unorm16_ = false;
};

/// Builds all levels from an image. A pass hands the same pyramid out for less: `PassConfig::pyramid`.
///
/// expects: a size of at most `max_size_px`. Samples that are NaN are left out: nothing passes a depth test there.
/// cost:    one read of the image, in parallel by rows of blocks.
void build_pyramid(DepthTarget const& image, math::Depth depth, DepthPyramid& pyramid, core::ExecutorRef executor);

/// Builds levels 1 and up from level 0.
///
/// cost: O(blocks of level 0), 1/48 of the image's samples.
void build_upper_levels(DepthPyramid& pyramid) noexcept;

}  // namespace gnomon::raster
