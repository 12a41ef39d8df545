#pragma once
// Percentage-closer filtering as weights of whole texels: 1 tap is a point compare, n taps a box n - 1 texels wide.
//
// A box that slides with the receiver covers its first and last texel in part: those get its share of them, the others
// one each. Two taps are the bilinear weights of a hardware comparison sampler.

#include <gnomon/math/scalar.hpp>

#include <cstdint>

namespace gnomon::shadow {

inline constexpr int max_taps = 15;

/// The texels [first, first + taps) of one axis and their weights, which add up to 1.
struct TapRow {
    std::int32_t first = 0;
    int taps = 1;
    float fraction = 0.0F;  ///< How much of the first texel the box leaves out, and of the last it covers.
    float scale = 1.0F;

    /// Weight of texel `first + i`.
    [[nodiscard]] float weight(int i) const noexcept {
        if (taps == 1) return 1.0F;
        float const share = i == 0 ? 1.0F - fraction : (i == taps - 1 ? fraction : 1.0F);
        return share * scale;
    }
};

/// The taps round image coordinate `texel` (in texels, a texel's centre at +0.5).
///
///     box [texel - (taps - 1) / 2, texel + (taps - 1) / 2]
///
/// expects: 1 <= taps <= `max_taps`.
/// returns: a row beyond every map, where `texel` is not finite or beyond +-2^30.
[[nodiscard]] inline TapRow taps_at(float texel, int taps) noexcept {
    constexpr float limit = 1073741824.0F;
    float const start = texel - 0.5F * static_cast<float>(taps - 1);
    TapRow row;
    row.taps = taps;
    row.scale = taps == 1 ? 1.0F : 1.0F / static_cast<float>(taps - 1);
    if (!(start > -limit && start < limit)) {
        row.first = -static_cast<std::int32_t>(limit);
        return row;
    }
    row.first = static_cast<std::int32_t>(start);  // toward zero; floor would be a call
    if (start < static_cast<float>(row.first)) --row.first;
    row.fraction = start - static_cast<float>(row.first);
    return row;
}

}  // namespace gnomon::shadow
