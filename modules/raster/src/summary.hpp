#pragma once
// The least and greatest depths of rows of samples, by blocks: what a pyramid's levels are made with.

#include <cstddef>
#include <cstdint>

namespace gnomon::raster::detail {

/// Rows of samples, at most eight: one row of blocks.
struct SampleRows {
    float const* first;
    std::ptrdiff_t pitch;
    std::int32_t width;
    std::int32_t height;
};

struct SummaryTable {
    /// Writes the least and greatest depths of the ceil(width / 8) blocks; NaN counts as no sample.
    void (*summarize)(SampleRows const&, float* least, float* greatest);
    /// The same of eight rows of a whole tile in blocks of 4 x 4 samples (`blocked_offset`): eight blocks.
    void (*summarize_blocked)(float const* first, float* least, float* greatest);
    /// Writes the least or the greatest of each two by two of `width` columns of two rows (the second may be the first
    /// again): ceil(width / 2) elements.
    void (*halve_least)(float const* upper, float const* lower, std::int32_t width, float* out);
    void (*halve_greatest)(float const* upper, float const* lower, std::int32_t width, float* out);
};

[[nodiscard]] SummaryTable const& scalar_summary() noexcept;
/// The fastest that the machine runs. All give the same bits.
[[nodiscard]] SummaryTable const& best_summary() noexcept;

}  // namespace gnomon::raster::detail
