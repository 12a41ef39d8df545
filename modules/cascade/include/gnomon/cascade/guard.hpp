#pragma once
// What a guard band costs and saves.
//
// source: [CSM Scrolling, 5, side note]: less rendering on average, for larger maps or coarser shadows

#include <gnomon/cascade/fit.hpp>

namespace gnomon::cascade {

/// For a camera that moves steadily along one axis of the map.
struct GuardTradeOff {
    double texel_growth = 1.0;       ///< Texels are this much longer than without a band, in a map of the same size.
    double scrolls_per_frame = 0.0;  ///< Of the other frames nothing is scrolled, and only what changed is drawn.
    double texels_copied = 0.0;      ///< Per frame, on average.
    double texels_filled = 0.0;      ///< In the strips; per frame, on average.
    double draws_per_texel = 0.0;    ///< Strips drawn for each texel of depth of strip: 1 / (guard + 1) at low speeds.
};

/// A map scrolls when the map proper has moved by guard + 1 texels, at every frame if it moves farther than that.
///
///     growth = usable without / usable with,   v = speed / growth,   scrolls = min(1, v / (guard + 1))
///
/// `speed_px` is in texels per frame of the map without a band.
/// expects: a `config` that passes `validate`, a speed of 0 and above.
/// returns: averages; exact for whole texels per frame that divide guard + 1
[[nodiscard]] inline GuardTradeOff guard_trade_off(FitConfig const& config, double speed_px) noexcept {
    FitConfig without = config;
    without.guard_px = 0;
    GuardTradeOff out;
    double const size = static_cast<double>(config.size_px);
    double const band = static_cast<double>(config.guard_px + 1);
    out.texel_growth = static_cast<double>(usable_px(without)) / static_cast<double>(usable_px(config));
    double const speed = speed_px / out.texel_growth;
    out.scrolls_per_frame = speed < band ? speed / band : 1.0;
    out.texels_copied = out.scrolls_per_frame * size * size;
    out.texels_filled = (speed < size ? speed : size) * size;
    out.draws_per_texel = speed > 0.0 ? out.scrolls_per_frame / speed : 0.0;
    return out;
}

}  // namespace gnomon::cascade
