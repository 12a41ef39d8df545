#pragma once
// Images with a frame that tells when something writes outside.

#include <gnomon/raster/target.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace fuzz {

namespace raster = gnomon::raster;

inline constexpr std::int32_t margin = 3;  // Rows and columns around the image that nothing may touch.

/// An image inside a larger one.
template <class T>
struct Framed {
    Framed(std::int32_t width, std::int32_t height, T fill, T frame)
        : width_(width), height_(height), fill_(fill), frame_(frame) {
        data_.assign(stride() * static_cast<std::size_t>(height + 2 * margin), frame);
        for (std::int32_t y = 0; y < height; ++y) std::fill_n(view().row(y), width, fill);
    }
    raster::ImageView<T> view() {
        return {data_.data() + stride() * margin + margin, width_, height_, static_cast<std::ptrdiff_t>(stride())};
    }
    /// What was there before is there still, in the frame and beyond `drawn`.
    bool kept_outside(raster::Rect const& drawn) const {
        for (std::size_t i = 0; i < data_.size(); ++i) {
            auto const x = static_cast<std::int32_t>(i % stride()) - margin;
            auto const y = static_cast<std::int32_t>(i / stride()) - margin;
            bool const image = x >= 0 && y >= 0 && x < width_ && y < height_;
            bool const in_drawn =
                x >= drawn.x && y >= drawn.y && x - drawn.x < drawn.width && y - drawn.y < drawn.height;
            if (!image && data_[i] != frame_) return false;
            if (image && !in_drawn && data_[i] != fill_) return false;
        }
        return true;
    }
    friend bool operator==(Framed const& a, Framed const& b) { return a.data_ == b.data_; }
    std::vector<T> const& data() const { return data_; }

  private:
    [[nodiscard]] std::size_t stride() const { return static_cast<std::size_t>(width_ + 2 * margin); }
    std::int32_t width_, height_;
    T fill_, frame_;
    std::vector<T> data_;
};

}  // namespace fuzz
