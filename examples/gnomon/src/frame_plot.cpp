#include "frame_plot.hpp"

#include "plot.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>

namespace gnomon::command {

namespace {

constexpr double width = 920.0;
constexpr double height = 220.0;
constexpr double left = 58.0;
constexpr double right = 12.0;
constexpr double top = 24.0;
constexpr double bottom = 34.0;
constexpr int horizontal_lines = 4;
constexpr std::size_t colors = 6;

/// Where frames and values stand in the picture.
struct Frame {
    double frames;
    double highest;

    [[nodiscard]] double x(double frame) const {
        return left + (width - left - right) * (frames > 1.0 ? frame / (frames - 1.0) : 0.5);
    }
    [[nodiscard]] double y(double value) const { return height - bottom - (height - top - bottom) * value / highest; }
};

std::string grid_svg(Frame const& frame) {
    std::string svg;
    auto out = std::back_inserter(svg);
    for (int i = 0; i <= horizontal_lines; ++i) {
        double const value = frame.highest * i / horizontal_lines;
        fmt::format_to(out,
                       "<line class='grid' x1='{0:.1f}' x2='{1:.1f}' y1='{2:.1f}' y2='{2:.1f}'/>"
                       "<text class='tick' x='{3:.1f}' y='{4:.1f}' text-anchor='end'>{5:.4g}</text>\n",
                       left, width - right, frame.y(value), left - 8.0, frame.y(value) + 4.0, value);
    }
    double const step = std::max(1.0, round_up(frame.frames / 10.0));
    for (double at = 0.0; at < frame.frames; at += step)
        fmt::format_to(out, "<text class='tick' x='{:.1f}' y='{:.1f}' text-anchor='middle'>{:.0f}</text>\n",
                       frame.x(at), height - bottom + 18.0, at);
    fmt::format_to(out, "<text class='axis' x='{:.1f}' y='{:.1f}' text-anchor='end'>frame</text>\n", width - right,
                   height - 3.0);
    return svg;
}

}  // namespace

double round_up(double value) {
    if (!(value > 0.0)) return 1.0;
    double const power = std::pow(10.0, std::floor(std::log10(value)));
    for (double const digit : {1.0, 2.0, 5.0, 10.0})
        if (digit * power >= value) return digit * power;
    return value;
}

std::string frame_plot_svg(std::span<FrameSeries const> series, std::string const& what) {
    std::size_t frames = 1;
    double highest = 0.0;
    for (FrameSeries const& s : series) {
        frames = std::max(frames, s.values.size());
        for (double const value : s.values) highest = std::max(highest, value);
    }
    Frame const frame{static_cast<double>(frames), round_up(highest)};
    std::string svg = fmt::format("<svg class='plot' viewBox='0 0 {} {}' role='img' aria-label='{}'>\n", width, height,
                                  escaped(what));
    svg += grid_svg(frame);
    fmt::format_to(std::back_inserter(svg), "<text class='axis' x='{:.1f}' y='14'>{}</text>\n", left, escaped(what));
    for (std::size_t s = 0; s < series.size(); ++s) {
        std::string points;
        for (std::size_t i = 0; i < series[s].values.size(); ++i)
            fmt::format_to(std::back_inserter(points), "{:.1f},{:.1f} ", frame.x(static_cast<double>(i)),
                           frame.y(series[s].values[i]));
        fmt::format_to(std::back_inserter(svg), "<polyline class='line s{}' points='{}'><title>{}</title></polyline>\n",
                       s % colors, points, escaped(series[s].label));
    }
    return svg + "</svg>\n";
}

}  // namespace gnomon::command
