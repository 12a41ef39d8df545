#include <gnomon/raster/depth_pyramid.hpp>

#include "summary.hpp"

#include <algorithm>

namespace gnomon::raster {

namespace {

/// One row of blocks of a 16-bit image: least and greatest codes, which are exact in float.
void summarize_codes(ImageView<std::uint16_t> const& image, std::int32_t block_y, float* least, float* greatest) {
    std::int32_t const y0 = block_y * 8;
    std::int32_t const y1 = std::min(y0 + 8, image.height);
    for (std::int32_t x = 0; x < image.width; x += 8) {
        std::int32_t const width = std::min(8, image.width - x);
        std::uint16_t low[8];
        std::uint16_t high[8];
        std::fill_n(low, 8, std::uint16_t{65535});
        std::fill_n(high, 8, std::uint16_t{0});
        for (std::int32_t y = y0; y < y1; ++y) {
            std::uint16_t const* const row = image.row(y) + x;
            for (std::int32_t i = 0; i < width; ++i) {
                low[i] = std::min(low[i], row[i]);
                high[i] = std::max(high[i], row[i]);
            }
        }
        least[x / 8] = static_cast<float>(*std::min_element(low, low + width));
        greatest[x / 8] = static_cast<float>(*std::max_element(high, high + width));
    }
}

}  // namespace

void DepthPyramid::fit(DepthTarget const& image, math::Depth depth) {
    GNOMON_EXPECT(image.width() >= 0 && image.width() <= max_size_px);
    GNOMON_EXPECT(image.height() >= 0 && image.height() <= max_size_px);
    width_ = image.width();
    height_ = image.height();
    depth_ = depth;
    is_unorm16_ = image.is_unorm16();
    levels_ = 0;
    std::size_t total = 0;
    std::int32_t wide = (width_ + 7) >> block_shift;
    std::int32_t high = (height_ + 7) >> block_shift;
    while (wide > 0 && high > 0) {
        std::int32_t const stride = ((wide + 7) & ~7) + 8;
        level_[levels_++] = {total, wide, high, stride};
        total += 2 * static_cast<std::size_t>(stride) * static_cast<std::size_t>(high);
        if (wide == 1 && high == 1) break;
        wide = (wide + 1) >> 1;
        high = (high + 1) >> 1;
    }
    if (storage_.size() < total) storage_.resize(total);
}

void build_upper_levels(DepthPyramid& pyramid) noexcept {
    detail::SummaryTable const& kernel = detail::best_summary();
    for (int level = 1; level < pyramid.level_count(); ++level) {
        ImageView<float> const to[2] = {pyramid.least(level), pyramid.greatest(level)};
        ImageView<float> const from[2] = {pyramid.least(level - 1), pyramid.greatest(level - 1)};
        for (std::int32_t y = 0; y < to[0].height; ++y) {
            std::int32_t const lower = std::min(2 * y + 1, from[0].height - 1);
            kernel.halve_least(from[0].row(2 * y), from[0].row(lower), from[0].width, to[0].row(y));
            kernel.halve_greatest(from[1].row(2 * y), from[1].row(lower), from[1].width, to[1].row(y));
        }
    }
}

void build_pyramid(DepthTarget const& image, math::Depth depth, DepthPyramid& pyramid, core::ExecutorRef executor) {
    pyramid.fit(image, depth);
    if (pyramid.level_count() == 0) return;
    ImageView<float> const least = pyramid.least(0);
    ImageView<float> const greatest = pyramid.greatest(0);
    detail::SummaryTable const& kernel = detail::best_summary();
    executor.parallel_for(static_cast<std::size_t>(least.height), 8, [&](std::size_t begin, std::size_t end) {
        for (auto y = static_cast<std::int32_t>(begin); y < static_cast<std::int32_t>(end); ++y) {
            if (image.is_unorm16()) {
                summarize_codes(image.unorm16(), y, least.row(y), greatest.row(y));
                continue;
            }
            ImageView<float> const& from = image.f32();
            detail::SampleRows const rows{from.row(y * 8), from.stride, from.width, std::min(8, from.height - y * 8)};
            kernel.summarize(rows, least.row(y), greatest.row(y));
        }
    });
    build_upper_levels(pyramid);
}

}  // namespace gnomon::raster
