#include "plot.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <limits>

namespace gnomon::command {

namespace {

constexpr double width = 820.0;
constexpr double height = 460.0;
constexpr double left = 76.0;
constexpr double right = 24.0;
constexpr double top = 54.0;
constexpr double bottom = 58.0;
constexpr double strip = 40.0;  ///< Height of the lane for runs without an error, which a logarithm cannot show.
constexpr double floor_y = height - bottom;
constexpr double log_floor_y = floor_y - strip;
constexpr double letter_px = 6.6;  ///< A generous mean width of the page's 12 px sans-serif.

struct Box {
    double x0, y0, x1, y1;
    [[nodiscard]] bool overlaps(Box const& o) const { return x0 < o.x1 && o.x0 < x1 && y0 < o.y1 && o.y0 < y1; }
};

struct Placed {
    double x, y;
};

std::string tick_text(double value) { return fmt::format("{:.10g}", value); }

/// The greatest of {1, 2, 5} * 10^k at or below `value`.
double round_down(double value) {
    double const decade = std::pow(10.0, std::floor(std::log10(value)));
    double const lead = value / decade;
    return (lead >= 5.0 ? 5.0 : lead >= 2.0 ? 2.0 : 1.0) * decade;
}

double next_step(double value) {
    double const lead = value / std::pow(10.0, std::floor(std::log10(value * 1.0001)));
    return value * (lead > 4.5 ? 2.0 : lead > 1.8 ? 2.5 : 2.0);
}

void grid(std::string& svg, LogAxis const& x, LogAxis const& y, std::string_view zero) {
    auto out = std::back_inserter(svg);
    for (double const value : x.ticks()) {
        double const at = left + x.fraction(value) * (width - left - right);
        fmt::format_to(out, "<line class='grid' x1='{0:.1f}' x2='{0:.1f}' y1='{1}' y2='{2}'/>", at, top, floor_y);
        fmt::format_to(out, "<text class='tick' x='{:.1f}' y='{}' text-anchor='middle'>{}</text>\n", at, floor_y + 18.0,
                       tick_text(value));
    }
    for (double const value : y.ticks()) {
        double const at = log_floor_y - y.fraction(value) * (log_floor_y - top);
        fmt::format_to(out, "<line class='grid' x1='{0}' x2='{1}' y1='{2:.1f}' y2='{2:.1f}'/>", left, width - right,
                       at);
        fmt::format_to(out, "<text class='tick' x='{}' y='{:.1f}' text-anchor='end'>{}</text>\n", left - 8.0, at + 4.0,
                       tick_text(value));
    }
    fmt::format_to(out, "<rect class='strip' x='{}' y='{}' width='{}' height='{}'/>", left, log_floor_y,
                   width - left - right, strip);
    fmt::format_to(out, "<text class='tick' x='{}' y='{}' text-anchor='end'>{}</text>\n", left - 8.0,
                   log_floor_y + strip / 2 + 4.0, escaped(zero));
    fmt::format_to(out, "<rect class='frame' x='{}' y='{}' width='{}' height='{}'/>\n", left, top, width - left - right,
                   floor_y - top);
}

void axis_titles(std::string& svg, PlotAxes const& axes) {
    auto out = std::back_inserter(svg);
    fmt::format_to(out,
                   "<text class='axis' x='{}' y='{}' text-anchor='middle'>{}</text>",
                   (left + width - right) / 2, height - 14.0, escaped(axes.x));
    fmt::format_to(out,
                   "<text class='axis' transform='translate(18 {}) rotate(-90)' text-anchor='middle'>"
                   "{}</text>\n",
                   (top + floor_y) / 2, escaped(axes.y));
}

/// Marks on the upper edge: how many times as fast as `ray`.
void speed_axis(std::string& svg, LogAxis const& x, RayTime const& ray) {
    double const ray_ms = ray.ms;
    auto out = std::back_inserter(svg);
    fmt::format_to(out, "<text class='axis' x='{}' y='16' text-anchor='middle'>speed, as a multiple of {}</text>\n",
                   (left + width - right) / 2, escaped(ray.name));
    for (double value = round_down(ray_ms / x.high); value <= ray_ms / x.low * 1.0001; value = next_step(value)) {
        double const where = x.fraction(ray_ms / value);
        if (where < -0.001 || where > 1.001) continue;
        double const at = left + where * (width - left - right);
        fmt::format_to(out, "<line class='mark' x1='{0:.1f}' x2='{0:.1f}' y1='{1}' y2='{2}'/>", at, top - 5.0, top);
        fmt::format_to(out, "<text class='tick' x='{:.1f}' y='{}' text-anchor='middle'>{}×</text>\n", at, top - 10.0,
                       tick_text(value));
    }
    double const at = left + x.fraction(ray_ms) * (width - left - right);
    fmt::format_to(out, "<line class='ray' x1='{0:.1f}' x2='{0:.1f}' y1='{1}' y2='{2}'/>\n", at, top, floor_y);
}

void series_lines(std::string& svg, std::span<PlotPoint const> points, std::span<Placed const> at) {
    for (std::size_t i = 0; i < points.size(); ++i) {
        auto const of_series = [&](PlotPoint const& point) { return point.series == points[i].series; };
        auto const before = points.first(i);
        if (std::any_of(before.begin(), before.end(), of_series)) continue;
        std::string path;
        for (std::size_t j = i; j < points.size(); ++j)
            if (of_series(points[j]) && points[j].y > 0.0)
                path += fmt::format("{}{:.1f} {:.1f}", path.empty() ? "M" : " L", at[j].x, at[j].y);
        if (!path.empty())
            svg += fmt::format("<path class='line s{}' d='{}'/>\n", series_index(points, points[i].series) % 6, path);
    }
}

/// Puts the label where it hides nothing that is already there: right, left, above or below its point.
void label(std::string& svg, PlotPoint const& point, Placed const& at, std::vector<Box>& taken) {
    double const w = letter_px * static_cast<double>(point.label.size());
    struct Spot {
        double dx, dy;
        char const* anchor;
        double shift;
    };
    std::array<Spot, 6> const spots = {{{11, 4, "start", 0},
                                        {-11, 4, "end", -1},
                                        {0, -11, "middle", -0.5},
                                        {0, 19, "middle", -0.5},
                                        {9, -10, "start", 0},
                                        {9, 18, "start", 0}}};
    Spot best = spots[0];
    int fewest = std::numeric_limits<int>::max();
    Box best_box{};
    for (Spot const& spot : spots) {
        double const x0 = at.x + spot.dx + spot.shift * w;
        Box const box{x0, at.y + spot.dy - 11.0, x0 + w, at.y + spot.dy + 3.0};
        bool const inside = box.x0 >= left && box.x1 <= width - 4.0 && box.y0 >= top && box.y1 <= floor_y;
        int hits = inside ? 0 : 10;
        for (Box const& other : taken) hits += box.overlaps(other) ? 1 : 0;
        if (hits < fewest) {
            fewest = hits;
            best = spot;
            best_box = box;
        }
    }
    taken.push_back(best_box);
    fmt::format_to(std::back_inserter(svg), "<text class='label' x='{:.1f}' y='{:.1f}' text-anchor='{}'>{}</text>\n",
                   at.x + best.dx, at.y + best.dy, best.anchor, escaped(point.label));
}

}  // namespace

std::string escaped(std::string_view text) {
    std::string safe;
    for (char const c : text) {
        switch (c) {
            case '&': safe += "&amp;"; break;
            case '<': safe += "&lt;"; break;
            case '>': safe += "&gt;"; break;
            case '"': safe += "&quot;"; break;
            case '\'': safe += "&#39;"; break;
            default: safe += c;
        }
    }
    return safe;
}

std::string css_color(math::vec3 const& linear) {
    auto const encoded = [](float c) {
        return 255.0F * (c <= 0.0031308F ? 12.92F * c : 1.055F * std::pow(c, 1.0F / 2.4F) - 0.055F);
    };
    return fmt::format("rgb({:.0f} {:.0f} {:.0f})", encoded(linear.x), encoded(linear.y), encoded(linear.z));
}

std::size_t series_index(std::span<PlotPoint const> points, std::string_view series) {
    std::vector<std::string_view> seen;
    for (PlotPoint const& point : points) {
        if (point.series == series) break;
        if (std::find(seen.begin(), seen.end(), point.series) == seen.end()) seen.push_back(point.series);
    }
    return seen.size();
}

double LogAxis::fraction(double value) const { return std::log(value / low) / std::log(high / low); }

std::vector<double> LogAxis::ticks() const {
    std::vector<double> ticks;
    bool const many = high / low > 1e4;  // then only the decades
    for (double value = low; value <= high * 1.0001; value = next_step(value)) {
        double const lead = value / std::pow(10.0, std::floor(std::log10(value * 1.0001)));
        if (!many || lead < 1.5) ticks.push_back(value);
    }
    return ticks;
}

LogAxis axis_over(std::span<double const> values) {
    double least = std::numeric_limits<double>::infinity();
    double most = 0.0;
    for (double const value : values) {
        if (!(value > 0.0) || !std::isfinite(value)) continue;
        least = std::min(least, value);
        most = std::max(most, value);
    }
    if (most == 0.0) return {};
    LogAxis axis{round_down(least / 1.25), round_down(least / 1.25)};
    while (axis.high < most * 1.25 || axis.high < axis.low * 4.9) axis.high = next_step(axis.high);
    return axis;
}

std::string plot_svg(std::span<PlotPoint const> points, PlotAxes const& axes, std::optional<RayTime> const& ray) {
    std::vector<double> times;
    std::vector<double> errors;
    for (PlotPoint const& point : points) {
        times.push_back(point.ms);
        errors.push_back(point.y);
    }
    LogAxis const x = axis_over(times);
    LogAxis const y = axis_over(errors);
    std::string svg = fmt::format(
        "<svg class='plot' viewBox='0 0 {} {}' role='img' aria-label='{}'>\n", width, height, escaped(axes.title));
    grid(svg, x, y, axes.zero);
    axis_titles(svg, axes);
    if (ray && ray->ms > 0.0) speed_axis(svg, x, *ray);
    std::vector<Placed> at;
    std::vector<Box> taken;
    for (PlotPoint const& point : points) {
        double const across = point.ms > 0.0 ? std::clamp(x.fraction(point.ms), 0.0, 1.0) : 0.0;
        double const up = point.y > 0.0 ? y.fraction(point.y) : 0.0;
        at.push_back({left + across * (width - left - right),
                      point.y > 0.0 ? log_floor_y - up * (log_floor_y - top) : log_floor_y + strip / 2});
        taken.push_back({at.back().x - 7.0, at.back().y - 7.0, at.back().x + 7.0, at.back().y + 7.0});
    }
    series_lines(svg, points, at);
    for (std::size_t i = 0; i < points.size(); ++i)
        fmt::format_to(std::back_inserter(svg),
                       "<circle class='dot s{}' cx='{:.1f}' cy='{:.1f}' r='6'><title>{}: {:.4g} ms, "
                       "{}: {:.4g}</title></circle>\n",
                       series_index(points, points[i].series) % 6, at[i].x, at[i].y, escaped(points[i].label),
                       points[i].ms, escaped(axes.y), points[i].y);
    for (std::size_t i = 0; i < points.size(); ++i) label(svg, points[i], at[i], taken);
    return svg + "</svg>\n";
}

}  // namespace gnomon::command
