#include "lights_parts.hpp"

#include "page_parts.hpp"
#include "plot.hpp"
#include "table.hpp"

#include <gnomon/pipeline/lighting.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <iterator>

namespace gnomon::command {

namespace {

constexpr std::string_view computations = "lighting_computations";

std::string per_sample(Report const& report, std::optional<std::uint64_t> count) {
    if (!count || report.samples == 0) return "-";
    return figures(static_cast<double>(*count) / static_cast<double>(report.samples));
}

std::string or_dash(std::optional<double> value) { return value ? figures(*value) : "-"; }

std::string count_text(Run const& run, std::string_view name) {
    auto const count = count_of(run.result.counts, name);
    return count ? grouped(*count) : "-";
}

std::vector<std::string> row_of(Report const& report, Run const& run) {
    std::vector<std::string> row{run.label, per_sample(report, count_of(run.result.counts, computations))};
    if (report.has_truth) row.push_back(or_dash(computations_over_least(report, run)));
    row.insert(row.end(), {count_text(run, "light_pairs"), count_text(run, "lists")});
    if (report.has_truth) row.push_back(percent(run.result.error.wrong_fraction));
    row.push_back(figures(run.result.ms.median));
    if (report.frames > 1) row.insert(row.end(), {figures(run.result.ms.min), figures(run.result.ms.max)});
    row.push_back(or_dash(speed_over_stencil(report, run)));
    return row;
}

}  // namespace

std::vector<std::vector<std::string>> lights_rows(Report const& report) {
    std::vector<std::string> head{"run", "lights / sample"};
    if (report.has_truth) head.emplace_back("/ least");
    head.insert(head.end(), {"light pairs", "lists"});
    if (report.has_truth) head.emplace_back("wrong %");
    head.emplace_back(report.frames > 1 ? "ms median" : "ms");
    if (report.frames > 1) head.insert(head.end(), {"min", "max"});
    head.emplace_back("speed / stencil");
    std::vector<std::vector<std::string>> rows{head};
    for (Run const& run : report.runs) rows.push_back(row_of(report, run));
    return rows;
}

std::string lights_verdict_html(Report const& report) {
    if (report.samples == 0) return "<p class='lead'>The view sees nothing of the scene.</p>\n";
    Run const* best = nullptr;
    std::uint64_t wrong = 0;
    for (Run const& run : report.runs) {
        wrong += run.result.error.wrong;
        if (best == nullptr || run.result.ms.median < best->result.ms.median) best = &run;
    }
    if (best == nullptr) return {};
    std::string text = fmt::format("The fastest run here, {}, takes {} ms and evaluates {} lights a sample", escaped(best->label),
                                   figures(best->result.ms.median),
                                   per_sample(report, count_of(best->result.counts, computations)));
    if (report.has_truth && report.reaching > 0)
        text += fmt::format("; {} reach one", per_sample(report, report.reaching));
    if (report.has_truth)
        text += wrong == 0 ? ". All images are the same to the last bit." : ". Not all images are the same to the last bit.";
    else
        text += '.';
    return "<p class='lead'>" + text + "</p>\n";
}

std::string lights_table_html(Report const& report) { return rows_html(lights_rows(report)); }

std::string lights_explanation() {
    return "<p>Every pixel that shows a surface is one sample, and every technique has to sum up the lights that reach it. "
           "They differ in how many others they evaluate in vain.</p>\n<p class='soft'>Lights / sample: how often the lighting "
           "function ran, for a sample on average. / least: the same beside the fewest that do, each light on exactly the samples "
           "in its range. Light pairs: entries of all light lists; lists: tiles or clusters that have one. Wrong: samples whose "
           "colour differs in any bit from that of the fewest. Speed: the time of deferred-stencil divided by the run's, on the same "
           "backend in the same command.</p>\n";
}

std::string lights_plot_html(Report const& report) {
    std::vector<PlotPoint> points;
    for (Run const& run : report.runs) {
        auto const count = count_of(run.result.counts, computations);
        double const samples = std::max(1.0, static_cast<double>(report.samples));
        points.push_back({run.label, run.result.technique + " on " + run.result.backend, run.result.ms.median,
                          static_cast<double>(count.value_or(0)) / samples});
    }
    PlotAxes const axes{"time, ms (median)", "lights evaluated for a sample", "none", "Time against lighting computations"};
    return "<h2>Time against work</h2>\n<p>Down is less work, left is faster. Points of one technique are joined.</p>\n" +
           plot_svg(points, axes, std::nullopt);
}

std::string heat_legend_html(Report const& report) {
    std::string html = "<ul class='legend'>";
    auto out = std::back_inserter(html);
    for (int step = 0; step <= 5; ++step) {
        math::vec3 const c = pipeline::heat_color(static_cast<float>(step) / 5.0F);
        fmt::format_to(out, "<li><span class='swatch' style='background: {}; outline: 1px solid var(--line)'></span>{}{}</li>", css_color(c),
                       figures(static_cast<double>(report.heat_most) * step / 5.0), step == 5 ? " lights or more" : "");
    }
    return html + "</ul>\n";
}

std::string lights_figures_html(Report const& report, Run const& run) {
    std::string text = fmt::format("{} lights a sample", per_sample(report, count_of(run.result.counts, computations)));
    if (auto const ratio = computations_over_least(report, run); ratio && report.has_truth)
        text += fmt::format(", {} × the least", figures(*ratio));
    text += fmt::format(". {} ms", figures(run.result.ms.median));
    if (auto const speed = speed_over_stencil(report, run); speed && run.result.technique != "deferred-stencil")
        text += fmt::format(", {} × deferred-stencil", figures(*speed));
    return text + '.';
}

}  // namespace gnomon::command
