// The page and the text of `bench lights`: one set of tables, shown in two ways.

#include "bench_lights.hpp"

#include "frame_plot.hpp"
#include "lights_parts.hpp"
#include "page_parts.hpp"
#include "papers.hpp"
#include "plot.hpp"
#include "table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <span>

namespace gnomon::command {

namespace {

using Rows = std::vector<std::vector<std::string>>;

double computations_of(FrameRecord const& frame) {
    return static_cast<double>(count_of(frame.counts, "lighting_computations").value_or(0));
}

template <class Number>
double mean_of(Run const& run, Number number) {
    double sum = 0.0;
    for (FrameRecord const& frame : run.frames) sum += number(frame);
    return run.frames.empty() ? 0.0 : sum / static_cast<double>(run.frames.size());
}

double mean_ms(Run const& run) {
    return mean_of(run, [](FrameRecord const& frame) { return frame.ms; });
}

/// "f16", "f32", or nothing for forward shading.
std::string_view format_of(Run const& run) {
    for (pipeline::Params::Value const& value : run.result.params)
        if (value.name == "gbuffer") return value.text;
    return {};
}

/// The run of deferred-stencil that `run` is fairly compared with: the same G-buffer, or 16 bits for those without one.
Run const* stencil_of(Report const& report, Run const& run) {
    std::string_view const format = format_of(run).empty() ? "f16" : format_of(run);
    Run const* any = nullptr;
    for (Run const& other : report.runs) {
        if (other.result.technique != "deferred-stencil" || other.result.backend != run.result.backend) continue;
        if (any == nullptr || format_of(other) == format) any = &other;
    }
    return any;
}

std::string over(double value, double base) { return base > 0.0 ? figures(value / base) : "-"; }

papers::FrameTimes const* printed_of(std::span<papers::FrameTimes const> printed, std::string_view technique, std::string_view format) {
    for (papers::FrameTimes const& times : printed)
        if (times.technique == technique && times.gbuffer == format) return &times;
    return nullptr;
}

Rows frame_time_rows(Report const& report, std::span<papers::FrameTimes const> printed) {
    Rows rows{{"run", "ms mean", "min", "max", "/ stencil", "M computations", "/ least", "paper: ms mean", "min", "max", "/ stencil"}};
    for (Run const& run : report.runs) {
        Run const* const base = stencil_of(report, run);
        std::vector<std::string> row{run.label,
                                     figures(mean_ms(run)),
                                     figures(run.result.ms.min),
                                     figures(run.result.ms.max),
                                     base != nullptr ? over(mean_ms(run), mean_ms(*base)) : "-",
                                     figures(mean_of(run, computations_of) * 1e-6),
                                     figures(computations_over_least(report, run).value_or(0.0))};
        std::string_view const format = format_of(run);
        papers::FrameTimes const* const paper = printed_of(printed, run.result.technique, format);
        papers::FrameTimes const* const paper_base = printed_of(printed, "deferred-stencil", format.empty() ? "f16" : format);
        if (paper != nullptr && paper_base != nullptr)
            row.insert(row.end(), {figures(paper->mean), figures(paper->min), figures(paper->max), over(paper->mean, paper_base->mean)});
        else
            row.insert(row.end(), {"-", "-", "-", "-"});
        rows.push_back(std::move(row));
    }
    return rows;
}

/// Lighting computations of a run beside deferred-stencil's, frame by frame.
std::vector<double> normalized(Report const& report, Run const& run) {
    std::vector<double> ratios;
    Run const* const base = stencil_of(report, run);
    for (std::size_t i = 0; base != nullptr && i < run.frames.size(); ++i)
        ratios.push_back(computations_of(run.frames[i]) / std::max(1.0, computations_of(base->frames[i])));
    return ratios;
}

Rows efficiency_rows(Report const& report) {
    Rows rows{{"run", "M computations", "/ stencil, mean", "worst frame", "ms mean", "min", "max", "/ stencil"}};
    for (Run const& run : report.runs) {
        Run const* const base = stencil_of(report, run);
        auto const ratios = normalized(report, run);
        double sum = 0.0;
        for (double const r : ratios) sum += r;
        rows.push_back({run.label, figures(mean_of(run, computations_of) * 1e-6),
                        ratios.empty() ? "-" : figures(sum / static_cast<double>(ratios.size())),
                        ratios.empty() ? "-" : figures(*std::max_element(ratios.begin(), ratios.end())), figures(mean_ms(run)),
                        figures(run.result.ms.min), figures(run.result.ms.max),
                        base != nullptr ? over(mean_ms(run), mean_ms(*base)) : "-"});
    }
    return rows;
}

Rows scaling_rows(ScalingResult const& result) {
    Rows rows{{"ms of run \\ lights"}};
    for (std::uint32_t const n : result.lights) rows.front().push_back(grouped(n));
    for (std::size_t r = 0; !result.reports.empty() && r < result.reports.front().runs.size(); ++r) {
        rows.push_back({result.reports.front().runs[r].label});
        for (Report const& report : result.reports) rows.back().push_back(figures(report.runs[r].result.ms.median));
    }
    return rows;
}

/// The first run of a technique; null where there is none.
Run const* run_of(Report const& report, std::string_view technique) {
    for (Run const& run : report.runs)
        if (run.result.technique == technique) return &run;
    return nullptr;
}

/// Time that a run spends on finding lights: its hierarchy and its lists.
double assignment_ms(Run const& run) {
    double ms = 0.0;
    for (pipeline::StageTime const& stage : run.result.stages)
        for (std::string_view const name : {"lights", "tree", "bvh", "assign", "count", "scan", "fill"})
            if (stage.name == name) ms += stage.ms;
    return ms;
}

Rows assignment_rows(ScalingResult const& result) {
    Rows rows{{"lights", "clustered ms", "by kernels", "paper", "tiled ms", "paper", "tiled / clustered", "paper", "a cluster", "a tile", "MB of lists"}};
    for (std::size_t i = 0; i < result.lights.size(); ++i) {
        Report const& report = result.reports[i];
        Run const* const clustered = run_of(report, "clustered-deferred");
        Run const* const kernels = run_of(report, "clustered-deferred-device");
        Run const* const tiled = run_of(report, "tiled-deferred");
        if (clustered == nullptr || kernels == nullptr || tiled == nullptr) continue;
        auto const of_list = [](Run const& run) {
            auto const lists = static_cast<double>(count_of(run.result.counts, "lists").value_or(0));
            return over(static_cast<double>(count_of(run.result.counts, "light_pairs").value_or(0)), lists);
        };
        double const c = assignment_ms(*clustered);
        double const t = assignment_ms(*tiled);
        auto const paper = std::find_if(papers::assignment.begin(), papers::assignment.end(), [&](papers::Assignment const& a) {
            return static_cast<std::uint32_t>(a.lights) == result.lights[i];
        });
        bool const has_paper = paper != papers::assignment.end();
        rows.push_back({grouped(result.lights[i]), figures(c), figures(assignment_ms(*kernels)), has_paper ? figures(paper->clustered_ms) : "-", figures(t),
                        has_paper ? figures(paper->tiled_ms) : "-", over(t, c),
                        has_paper ? figures(paper->tiled_ms / paper->clustered_ms) : "-", of_list(*clustered), of_list(*tiled),
                        figures(static_cast<double>(count_of(clustered->result.bytes, "lists").value_or(0)) * 1e-6)});
    }
    return rows;
}

/// From how many lights on `clustered-deferred` takes less time than `tiled-deferred`.
std::string crossover_text(ScalingResult const& result) {
    for (std::size_t i = 0; i < result.lights.size(); ++i) {
        Run const* const clustered = run_of(result.reports[i], "clustered-deferred");
        Run const* const tiled = run_of(result.reports[i], "tiled-deferred");
        if (clustered != nullptr && tiled != nullptr && clustered->result.ms.median < tiled->result.ms.median) return fmt::format("clustered-deferred is the faster from {} lights on, of the numbers tried", grouped(result.lights[i]));
    }
    return "tiled-deferred is the faster with every number tried";
}

std::string key_html(std::span<FrameSeries const> series) {
    std::string html = "<ul class='legend'>";
    for (std::size_t i = 0; i < series.size(); ++i)
        html += fmt::format("<li class='s{}'><span class='swatch' style='background: var(--c)'></span>{}</li>", i % 6, escaped(series[i].label));
    return html + "</ul>\n";
}

/// Lines of a number of each frame. `number` gives a run's values.
template <class Number>
std::string lines_html(Report const& report, std::string const& what, Number number) {
    std::vector<FrameSeries> series;
    for (Run const& run : report.runs) series.push_back({run.label, number(run)});
    return key_html(series) + frame_plot_svg(series, what);
}

template <class Number>
auto of_frames(Number number) {
    return [number](Run const& run) {
        std::vector<double> values;
        for (FrameRecord const& frame : run.frames) values.push_back(number(frame));
        return values;
    };
}

std::string scaling_html(ScalingResult const& result) {
    std::vector<PlotPoint> points;
    for (std::size_t r = 0; !result.reports.empty() && r < result.reports.front().runs.size(); ++r)
        for (std::size_t i = 0; i < result.reports.size(); ++i) {
            Run const& run = result.reports[i].runs[r];
            if (result.lights[i] == 0) continue;  // A logarithm has no place for it; the table has.
            bool const last = i + 1 == result.reports.size();
            points.push_back({last ? run.label : std::string(), run.label, static_cast<double>(result.lights[i]), run.result.ms.median});
        }
    return rows_html(scaling_rows(result)) + plot_svg(points, {"lights", "ms", "0", "Time against the number of lights"}, std::nullopt);
}

std::string paper_one_html(LightsBench const& bench) {
    auto const millions = of_frames([](FrameRecord const& frame) { return computations_of(frame) * 1e-6; });
    auto const ms = of_frames([](FrameRecord const& frame) { return frame.ms; });
    std::string html = "<h2>Tiled shading: many static lights</h2>\n<p>A street of robots under 924 lights of 12.5 m, along its path. "
                       "[Olsson 2014, Paper I, table 2, figures 2 and 3]; the paper's card was a GTX 480. Compare ratios, not "
                       "milliseconds.</p>\n";
    html += rows_html(frame_time_rows(bench.many.report, papers::many_lights));
    html += lines_html(bench.many.report, "ms", ms) + lines_html(bench.many.report, "millions of lighting computations", millions);
    html += "<h2>Tiled shading: few moving lights</h2>\n<p>The same street under one light of 40 m on each of 11 robots. [Paper I, table "
            "3]</p>\n";
    html += rows_html(frame_time_rows(bench.few.report, papers::few_lights)) + lines_html(bench.few.report, "ms", ms);
    html += "<h2>More and more lights</h2>\n<p>One view of the street. [Paper I, figure 4]</p>\n";
    return html + scaling_html(bench.growing);
}

std::string paper_two_html(LightsBench const& bench) {
    std::string html;
    for (PathResult const& path : bench.atrium) {
        html += fmt::format("<h2>Clustered shading: {}</h2>\n<p>Lighting computations along the path, beside those of deferred shading "
                            "with the stencil. [Paper II, figures 9 to 11]</p>\n",
                            escaped(path.name));
        html += rows_html(efficiency_rows(path.report));
        html += lines_html(path.report, "lighting computations / deferred-stencil", [&](Run const& run) { return normalized(path.report, run); });
        html += lines_html(path.report, "ms", of_frames([](FrameRecord const& frame) { return frame.ms; }));
    }
    for (ScalingResult const& crossing : bench.crossing)
        html += fmt::format("<h2>Where tiled and clustered cross: {}</h2>\n<p>[Paper II, figure 12] Here {}; in the paper at most around "
                            "2,000.</p>\n",
                            escaped(crossing.name), crossover_text(crossing)) +
                scaling_html(crossing);
    html += "<h2>Up to a million lights</h2>\n<p>Time to find the lights of every cluster or tile, hierarchy included; shading is not in "
            "it. [Paper II, table 2], on a GTX 480.</p>\n";
    return html + rows_html(assignment_rows(bench.assignment));
}

std::string heat_html(LightsBench const& bench) {
    Report scale;
    scale.heat_most = bench.heat_most;
    std::string html = "<h2>Lights evaluated for each pixel</h2>\n" + heat_legend_html(scale) + "<div class='cards'>\n";
    for (HeatPicture const& picture : bench.heat)
        html += fmt::format("<article class='card'><header><h3>{}</h3></header>{}</article>\n", escaped(picture.name),
                            picture_html(picture.png, picture.size_px, picture.name));
    return html + "</div>\n";
}

}  // namespace

std::string lights_bench_html(LightsBench const& bench) {
    Report const& any = bench.any();
    std::string html = page_head("Many lights, measured");
    html += fmt::format("<p class='lead'>The comparisons of the papers on tiled and clustered shading, run here in {}x{} px on {} with {} "
                        "thread{}, beside the papers' own figures.</p>\n",
                        any.size_px.x, any.size_px.y, escaped(any.machine.cpu), any.threads, any.threads == 1 ? "" : "s");
    html += paper_one_html(bench) + paper_two_html(bench) + heat_html(bench);
    return html + page_foot(any);
}

std::string lights_bench_text(LightsBench const& bench, bool styled) {
    std::string text;
    auto const section = [&](std::string const& title, Rows const& rows) {
        text += title + "\n\n" + aligned(rows, {.bold_head = styled}) + '\n';
    };
    section("robots many [Paper I, table 2]", frame_time_rows(bench.many.report, papers::many_lights));
    section("robots few [Paper I, table 3]", frame_time_rows(bench.few.report, papers::few_lights));
    section("robots, more and more lights [Paper I, figure 4]", scaling_rows(bench.growing));
    for (PathResult const& path : bench.atrium) section(path.name + " [Paper II, figures 9 to 11]", efficiency_rows(path.report));
    for (ScalingResult const& crossing : bench.crossing)
        section(crossing.name + " [Paper II, figure 12]: " + crossover_text(crossing), scaling_rows(crossing));
    section("light assignment [Paper II, table 2]", assignment_rows(bench.assignment));
    return text;
}

}  // namespace gnomon::command
