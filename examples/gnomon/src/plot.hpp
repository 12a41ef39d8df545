#pragma once
// Speed against error, or another number, as one inline SVG: both axes logarithmic, zeros on a strip of their own below.

#include <gnomon/math/vec.hpp>

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace gnomon::command {

struct PlotPoint {
    std::string label;
    std::string series;  ///< Points of one series share a colour and are joined in order.
    double ms = 0.0;
    double y = 0.0;  ///< In the unit of the axis; 0 stands on a strip of its own.
};

/// What the axes say.
struct PlotAxes {
    std::string_view x = "time for the shadows, ms (median)";
    std::string_view y = "wrong samples, %";
    std::string_view zero = "exact";  ///< What a y of 0 is.
    std::string_view title = "Speed against error";
};

/// A colour of linear components as CSS has it.
[[nodiscard]] std::string css_color(math::vec3 const& linear);

/// Text made safe between tags and inside attribute quotes.
[[nodiscard]] std::string escaped(std::string_view text);

/// Which of the six colour classes (`s0`..`s5`) a series has, by order of appearance.
[[nodiscard]] std::size_t series_index(std::span<PlotPoint const> points, std::string_view series);

/// A logarithmic axis from `low` to `high`, both of the form {1, 2, 5} * 10^k, with at least a factor 5 between.
struct LogAxis {
    double low = 1.0;
    double high = 10.0;
    [[nodiscard]] double fraction(double value) const;
    [[nodiscard]] std::vector<double> ticks() const;
};

/// The narrowest axis that has every positive value of `values` well inside; 1 to 10 for none.
[[nodiscard]] LogAxis axis_over(std::span<double const> values);

/// What an axis of speeds counts in.
struct RayTime {
    double ms = 0.0;
    std::string name = "ray";
};

/// The SVG element, colours by CSS classes of the page. `ray`: adds an axis on top in multiples of it.
[[nodiscard]] std::string plot_svg(std::span<PlotPoint const> points, PlotAxes const& axes, std::optional<RayTime> const& ray);

}  // namespace gnomon::command
