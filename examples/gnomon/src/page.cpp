#include "page.hpp"

#include "lights_parts.hpp"
#include "page_parts.hpp"
#include "plot.hpp"

#include <fmt/format.h>

#include <optional>
#include <vector>

namespace gnomon::command {

namespace {

std::optional<RayTime> ray_time(Report const& report) {
    auto const ms = ray_ms(report);
    if (!ms) return std::nullopt;
    for (Run const& run : report.runs)
        if (run.result.technique == "ray") return RayTime{*ms, run.label};
    return RayTime{*ms};
}

std::string plot_section(Report const& report) {
    std::vector<PlotPoint> points;
    for (Run const& run : report.runs)
        points.push_back({run.label, run.result.technique + " on " + run.result.backend, run.result.ms.median,
                          run.result.error.wrong_fraction * 100.0});
    return "<h2>Speed against error</h2>\n<p>Down is more exact, left is faster. Points of one technique are "
           "joined.</p>\n" +
           plot_svg(points, {}, ray_time(report));
}

/// The table, what its columns mean, and a plot.
std::string shadow_runs(Report const& report) {
    std::string html(explanation);
    html += table_html(report);
    html +=
        "<p class='soft'>Edge error: how far a wrong sample lies from the nearest one that truly has its state. Speed: "
        "the time of exact rays divided by the run's, measured in the same command on the same samples: the ray run's "
        "time, or that of tracing the truth where there is no ray run. With several backends each is compared with its "
        "own.</p>\n";
    return html + plot_section(report);
}

std::string shadow_legend() {
    return std::string(legend) +
           "<p class='soft'>Wrong pixels are drawn three pixels wide here; the files that end in .wrong.png show them "
           "as they are.</p>\n";
}

}  // namespace

std::string page_html(Report const& report, ReportPictures const& pictures) {
    bool const many = report.many_lights;
    std::string html = page_head(fmt::format("{} of {}, measured", many ? "Lights" : "Shadows", report.scene));
    html += verdict_html(report);
    char const* const caption = many ? "The scene under all lights, each evaluated exactly where it reaches: the reference that every run is measured against."
                                     : "The scene with exact shadows: the reference that every run is measured against.";
    html += fmt::format("<div class='top'><figure>{}<figcaption>{}</figcaption></figure>\n",
                        picture_html(pictures.exact, report.size_px, many ? "The scene under all lights" : "The scene with exact shadows"),
                        caption);
    html += facts_html(report) + "</div>\n<h2>The runs</h2>\n";
    html += many ? lights_explanation() + table_html(report) + lights_plot_html(report) : shadow_runs(report);
    html += "<h2>Pictures</h2>\n";
    html += many ? heat_legend_html(report) : shadow_legend();
    html += fmt::format("<p>All runs: {} Click a picture to see it pixel for pixel.</p>\n<div class='cards'>\n",
                        choice_html(report, "all", " data-all='show-lit'", " data-all='show-wrong'"));
    for (std::size_t i = 0; i < report.runs.size(); ++i) html += card_html(report, report.runs[i], pictures.runs[i], i);
    html += "</div>\n" + debug_html(report, pictures.runs) + page_foot(report);
    return html;
}

}  // namespace gnomon::command
