#include "table.hpp"

#include "lights_parts.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace gnomon::command {

std::string grouped(std::uint64_t value) {
    std::string text = std::to_string(value);
    for (std::size_t at = text.size(); at > 3; at -= 3) text.insert(at - 3, 1, ',');
    return text;
}

std::string figures(double value) {
    if (std::isnan(value)) return "-";
    if (std::isinf(value)) return "inf";
    double const size = std::abs(value);
    if (size == 0.0) return "0";
    if (size >= 99.95) return fmt::format("{:.0f}", value);
    // Digits after the point that leave three figures.
    int const digits = 2 - static_cast<int>(std::floor(std::log10(size)));
    return fmt::format("{:.{}f}", value, std::clamp(digits, 0, 12));
}

std::string percent(double fraction) { return figures(fraction * 100.0); }

std::string aligned(std::vector<std::vector<std::string>> const& rows, TableLook look) {
    std::vector<std::size_t> widths;
    for (auto const& row : rows) {
        widths.resize(std::max(widths.size(), row.size()));
        for (std::size_t i = 0; i < row.size(); ++i) widths[i] = std::max(widths[i], row[i].size());
    }
    std::string text;
    for (std::size_t r = 0; r < rows.size(); ++r) {
        std::string line;
        for (std::size_t i = 0; i < rows[r].size(); ++i)
            line += (i == 0 ? "" : "  ") + (i < look.left ? fmt::format("{:<{}}", rows[r][i], widths[i])
                                                          : fmt::format("{:>{}}", rows[r][i], widths[i]));
        line.erase(line.find_last_not_of(' ') + 1);
        text += look.bold_head && r == 0 ? "\x1b[1m" + line + "\x1b[0m\n" : line + '\n';
    }
    return text;
}

namespace {

/// What was looked at, in two lines.
std::string heading(Report const& report) {
    double const lit =
        report.samples == 0 ? 0.0 : static_cast<double>(report.truly_lit) / static_cast<double>(report.samples);
    std::string const frames = report.frames > 1 ? fmt::format("{} frames, ", grouped(report.frames)) : "";
    std::string const truth = report.has_truth && !report.many_lights ? fmt::format(", {:.1f} % truly lit", lit * 100.0) : "";
    return fmt::format("{}: {} triangles, {}{} samples in {}x{} px{}, {} threads\n{}   {}\n\n", report.scene,
                       grouped(report.triangles), frames, grouped(report.samples), report.size_px.x, report.size_px.y,
                       truth, report.threads, report.view, report.light);
}

/// The frame with the most wrong samples.
FrameRecord const& worst_of(std::vector<FrameRecord> const& frames) {
    return *std::max_element(frames.begin(), frames.end(), [](FrameRecord const& a, FrameRecord const& b) {
        return a.error.wrong < b.error.wrong;
    });
}

}  // namespace

std::string table_text(Report const& report, bool styled) {
    if (report.many_lights) return heading(report) + aligned(lights_rows(report), {.bold_head = styled});
    bool const flies = report.frames > 1;
    std::vector<std::string> head = {"run"};
    if (report.has_truth) head.insert(head.end(), {"wrong %", "false-lit", "false-shadow", "edge px mean", "max"});
    if (report.has_truth && flies) head.emplace_back("worst frame");
    head.emplace_back(flies ? "ms median" : "ms");
    if (flies) head.insert(head.end(), {"min", "max"});
    if (ray_ms(report)) head.emplace_back("speed / ray");
    std::vector<std::vector<std::string>> rows = {head};
    for (Run const& run : report.runs) {
        pipeline::Measures const& error = run.result.error;
        std::vector<std::string> row = {run.label};
        if (report.has_truth)
            row.insert(row.end(), {percent(error.wrong_fraction), grouped(error.false_lit), grouped(error.false_shadow),
                                   figures(error.edge_px.mean), figures(error.edge_px.max)});
        if (report.has_truth && flies) row.push_back(std::to_string(worst_of(run.frames).frame));
        row.push_back(figures(run.result.ms.median));
        if (flies) row.insert(row.end(), {figures(run.result.ms.min), figures(run.result.ms.max)});
        if (auto const speed = speed_over_ray(report, run)) row.push_back(figures(*speed));
        else if (ray_ms(report)) row.emplace_back("-");
        rows.push_back(std::move(row));
    }
    return heading(report) + aligned(rows, {.bold_head = styled});
}

}  // namespace gnomon::command
