#pragma once
// One number of every frame of a path as an inline SVG: a line a run, both axes linear and from zero.

#include <span>
#include <string>
#include <vector>

namespace gnomon::command {

struct FrameSeries {
    std::string label;
    std::vector<double> values;  ///< One a frame, finite, not negative.
};

/// The least of {1, 2, 5} * 10^k that is at least `value`; 1 for what is not above 0.
[[nodiscard]] double round_up(double value);

/// `what`: the caption of the vertical axis, with its unit. Colours by CSS classes of the page, series by series.
[[nodiscard]] std::string frame_plot_svg(std::span<FrameSeries const> series, std::string const& what);

}  // namespace gnomon::command
