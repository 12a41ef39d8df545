#pragma once
// Percentage-closer filtering as weights of whole texels: 1 tap is a point compare, n taps a box n - 1 texels wide.
//
// A box that slides with the receiver covers its first and last texel in part: those get its share of them, the others
// one each. Two taps are the bilinear weights of a hardware comparison sampler.

#include <gnomon/shadow/formula/pcf.glsl>

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
    [[nodiscard]] float weight(int i) const noexcept { return gn_tap_weight(as_formula(), taps, i).v; }

    [[nodiscard]] formula::GnTapRow<float> as_formula() const noexcept { return {first, fraction, scale}; }
};

/// The taps round image coordinate `texel` (in texels, a texel's centre at +0.5).
///
///     box [texel - (taps - 1) / 2, texel + (taps - 1) / 2]
///
/// expects: 1 <= taps <= `max_taps`.
/// returns: a row beyond every map, where `texel` is not finite or beyond +-2^30.
[[nodiscard]] inline TapRow taps_at(float texel, int taps) noexcept {
    formula::GnTapRow<float> const row = gn_taps_at(formula::Float<float>(texel), taps);
    return {row.first.v, taps, row.fraction.v, row.scale};
}

}  // namespace gnomon::shadow
