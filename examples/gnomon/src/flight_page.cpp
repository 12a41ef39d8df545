#include "flight_page.hpp"

#include "frame_plot.hpp"
#include "lights_parts.hpp"
#include "plot.hpp"
#include "table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <string_view>

namespace gnomon::command {

namespace {

/// One plot of a number of every frame, a line a run.
std::string plot_of(Report const& report, std::string const& what, double (*number)(FrameRecord const&)) {
    std::vector<FrameSeries> series;
    for (Run const& run : report.runs) {
        series.push_back({run.label, {}});
        for (FrameRecord const& frame : run.frames) series.back().values.push_back(number(frame));
    }
    return frame_plot_svg(series, what);
}

std::string key_html(Report const& report) {
    std::string html = "<ul class='legend'>";
    for (std::size_t i = 0; i < report.runs.size(); ++i)
        html += fmt::format("<li class='s{}'><span class='swatch' style='background: var(--c)'></span>{}</li>", i % 6,
                            escaped(report.runs[i].label));
    return html + "</ul>\n";
}

std::string plots_html(Report const& report) {
    std::string html = "<h2>Frame by frame</h2>\n" + key_html(report);
    html += plot_of(report, "ms", [](FrameRecord const& frame) { return frame.ms; });
    if (report.many_lights)
        html += plot_of(report, "millions of lighting computations", [](FrameRecord const& frame) {
            return static_cast<double>(count_of(frame.counts, "lighting_computations").value_or(0)) * 1e-6;
        });
    if (report.has_truth && !report.many_lights)
        html += plot_of(report, "wrong samples, %",
                        [](FrameRecord const& frame) { return frame.error.wrong_fraction * 100.0; });
    return html;
}

/// Whether there are errors of shadows to show.
bool shows_shadows(Report const& report) { return report.has_truth && !report.many_lights; }

std::string frames_table_html(Report const& report) {
    std::string html = "<details><summary>every frame as a table</summary>\n<div class='wide'><table>\n<thead><tr>"
                       "<th>frame</th><th>time, s</th>";
    for (Run const& run : report.runs) {
        html += fmt::format("<th>{}<br>ms</th>", escaped(run.label));
        if (report.many_lights) html += "<th>computations</th>";
        if (shows_shadows(report)) html += "<th>wrong, %</th><th>false-lit</th><th>false-shadow</th>";
    }
    html += "</tr></thead>\n<tbody>\n";
    auto out = std::back_inserter(html);
    for (std::size_t i = 0; i < report.runs.front().frames.size(); ++i) {
        FrameRecord const& any = report.runs.front().frames[i];
        fmt::format_to(out, "<tr><td>{}</td><td>{:.3f}</td>", any.frame, any.time_s);
        for (Run const& run : report.runs) {
            FrameRecord const& frame = run.frames[i];
            fmt::format_to(out, "<td>{}</td>", figures(frame.ms));
            if (report.many_lights)
                fmt::format_to(out, "<td>{}</td>", grouped(count_of(frame.counts, "lighting_computations").value_or(0)));
            if (shows_shadows(report))
                fmt::format_to(out, "<td>{}</td><td>{}</td><td>{}</td>", percent(frame.error.wrong_fraction),
                               grouped(frame.error.false_lit), grouped(frame.error.false_shadow));
        }
        html += "</tr>\n";
    }
    return html + "</tbody></table></div>\n</details>\n";
}

std::string films_html(Report const& report, FlightFilms const& films) {
    std::string html = "<h2>Films</h2>\n";
    if (report.many_lights) html += heat_legend_html(report);
    if (shows_shadows(report)) html += legend;
    html += "<div class='cards'>\n";
    for (std::size_t i = 0; i < report.runs.size(); ++i) html += card_html(report, report.runs[i], films.runs[i], i);
    return html + "</div>\n";
}

/// A value of a CSV file, quoted where it has to be.
std::string csv_value(std::string const& text) {
    if (text.find_first_of(",\"\n") == std::string::npos) return text;
    std::string quoted = "\"";
    for (char const c : text) quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
    return quoted + '"';
}

/// The names of all counts that any run has, in order of appearance.
std::vector<std::string_view> count_names(Report const& report) {
    std::vector<std::string_view> names;
    for (Run const& run : report.runs)
        for (FrameRecord const& frame : run.frames)
            for (pipeline::Count const& count : frame.counts)
                if (std::find(names.begin(), names.end(), count.name) == names.end()) names.push_back(count.name);
    return names;
}

}  // namespace

std::string flight_page_html(Report const& report, FlightFilms const& films) {
    std::string html = page_head(fmt::format("A flight through {}, measured", report.scene));
    html += verdict_html(report);
    html += "<div class='top'>";
    if (!films.exact.empty())
        html += fmt::format("<figure>{1}<figcaption>The path with exact {0}: the reference that every run is measured "
                            "against.</figcaption></figure>\n",
                            report.many_lights ? "light" : "shadows", picture_html(films.exact, report.size_px, "The reference"));
    html += facts_html(report) + "</div>\n<h2>The runs</h2>\n";
    if (report.many_lights) html += lights_explanation();
    if (shows_shadows(report)) html += explanation;
    html += table_html(report);
    html += fmt::format("<p class='soft'>Over {} frames: {}, the time is the median frame's{}. frames.csv beside this page has a "
                        "line for each frame.</p>\n",
                        grouped(report.frames), report.many_lights ? "counts are sums" : "errors are sums",
                        report.many_lights ? "" : ", an edge error's maximum is that of the worst frame");
    html += plots_html(report) + frames_table_html(report);
    if (films.has_runs) html += films_html(report, films);
    return html + debug_html(report, films.runs) + page_foot(report);
}

std::string frames_csv(Report const& report) {
    std::vector<std::string_view> const counts = count_names(report);
    std::string csv = "run,frame,time_s,ms,samples";
    if (report.has_truth) csv += ",wrong,false_lit,false_shadow,edge_px_mean,edge_px_max";
    for (std::string_view const name : counts) csv += fmt::format(",{}", name);
    csv += '\n';
    auto out = std::back_inserter(csv);
    for (Run const& run : report.runs)
        for (FrameRecord const& frame : run.frames) {
            pipeline::Measures const& error = frame.error;
            fmt::format_to(out, "{},{},{:.6g},{:.6g},{}", csv_value(run.label), frame.frame, frame.time_s, frame.ms,
                           error.samples);
            if (report.has_truth)
                fmt::format_to(out, ",{},{},{},{:.6g},{:.6g}", error.wrong, error.false_lit, error.false_shadow,
                               error.edge_px.mean, error.edge_px.max);
            for (std::string_view const name : counts) {
                auto const same = [&](pipeline::Count const& count) { return count.name == name; };
                auto const found = std::find_if(frame.counts.begin(), frame.counts.end(), same);
                csv += found == frame.counts.end() ? "," : fmt::format(",{}", found->value);
            }
            csv += '\n';
        }
    return csv;
}

}  // namespace gnomon::command
