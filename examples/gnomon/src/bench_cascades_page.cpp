// The page and the text of `bench cascades`: one set of tables, shown in two ways.

#include "bench_cascades.hpp"

#include "frame_plot.hpp"
#include "page_parts.hpp"
#include "plot.hpp"
#include "table.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace gnomon::command {

namespace {

using Rows = std::vector<std::vector<std::string>>;

double number_of(FrameRecord const& frame, std::string_view name) { return static_cast<double>(count_of(frame.counts, name).value_or(0)); }

/// Of the maps: not of the lookup.
double pass_ms(FrameRecord const& frame) {
    double ms = 0.0;
    for (pipeline::StageTime const& stage : frame.stages)
        if (stage.name != "lookup") ms += stage.ms;
    return ms;
}

template <class Number>
double mean_after_first(Run const& run, Number number) {
    double sum = 0.0;
    for (std::size_t i = 1; i < run.frames.size(); ++i) sum += number(run.frames[i]);
    return run.frames.size() > 1 ? sum / static_cast<double>(run.frames.size() - 1) : 0.0;
}

double over(double value, double base) { return base > 0.0 ? value / base : 0.0; }

double mean_of_maps(Run const& run, Run const& base) {
    double sum = 0.0;
    int terms = 0;
    for (std::size_t i = 1; i < run.frames.size() && i < base.frames.size(); ++i)
        for (int map = 0;; ++map) {
            std::string const name = fmt::format("triangles_map_{}", map);
            auto const drawn = count_of(run.frames[i].counts, name), all = count_of(base.frames[i].counts, name);
            if (!drawn || !all) break;
            sum += over(static_cast<double>(*drawn), static_cast<double>(*all));
            ++terms;
        }
    return terms == 0 ? 0.0 : sum / terms;
}

/// The run of `csm` on the same backend.
Run const& base_of(Report const& report, Run const& run) {
    auto const same = [&](Run const& other) { return other.result.technique == "csm" && other.result.backend == run.result.backend; };
    auto const found = std::find_if(report.runs.begin(), report.runs.end(), same);
    return found == report.runs.end() ? run : *found;
}

/// "volume_moved 116, first_use 4".
std::string reasons_text(Run const& run) {
    std::string text;
    for (pipeline::Count const& reason : run.result.redraw_reasons)
        text += fmt::format("{}{} {}", text.empty() ? "" : ", ", reason.name, grouped(reason.value));
    return text.empty() ? "-" : text;
}

/// The median of a stage; "-" for a run without it.
std::string stage_text(Run const& run, std::string_view name) {
    for (pipeline::StageTime const& stage : run.result.stages)
        if (stage.name == name) return figures(stage.ms);
    return "-";
}

/// "31, 60, 110, 200": the side of each map's texels in millimetres.
std::string texels_text(Run const& run) {
    std::string text;
    for (double const texel_m : run.result.map_texel_m) text += fmt::format("{}{}", text.empty() ? "" : ", ", figures(texel_m * 1e3));
    return text;
}

Rows rows_of(Report const& report) {
    Rows rows{{"run", "triangles", "/ csm, maps", "/ csm, sums", "batches", "k texels", "maps ms", "/ csm", "plan", "all", "scroll", "static", "active", "drawn to, maps"}};
    for (Run const& run : report.runs) {
        CascadeShare const share = share_of(run, base_of(report, run));
        rows.push_back({run.label, grouped(static_cast<std::uint64_t>(share.triangles)), figures(share.of_maps), figures(share.of_sums),
                        grouped(static_cast<std::uint64_t>(share.batches)), figures(share.texels_rewritten * 1e-3), figures(share.pass_ms),
                        figures(share.pass_share), stage_text(run, "plan"), stage_text(run, "depth_pass"), stage_text(run, "scroll"),
                        stage_text(run, "static"), stage_text(run, "active"), reasons_text(run)});
    }
    return rows;
}

/// Guard bands beside what they cost: coarser texels.
Rows guard_rows_of(Report const& report) {
    Rows rows = rows_of(report);
    rows[0].insert(rows[0].begin() + 1, "texels, mm");
    for (std::size_t i = 0; i < report.runs.size(); ++i) rows[i + 1].insert(rows[i + 1].begin() + 1, texels_text(report.runs[i]));
    return rows;
}

std::string lines_html(Report const& report) {
    std::vector<FrameSeries> series;
    std::string key = "<ul class='legend'>";
    for (std::size_t i = 0; i < report.runs.size(); ++i) {
        series.push_back({report.runs[i].label, {}});
        for (FrameRecord const& frame : report.runs[i].frames) series.back().values.push_back(number_of(frame, "triangles_drawn") * 1e-3);
        key += fmt::format("<li class='s{}'><span class='swatch' style='background: var(--c)'></span>{}</li>", i % 6, escaped(report.runs[i].label));
    }
    return key + "</ul>\n" + frame_plot_svg(series, "thousand triangles drawn");
}

constexpr std::string_view explanation_text =
    "Means over all frames but the first, which has nothing to keep. Triangles beside csm's: the mean over the maps of each map's own ratio, "
    "and of the sums. Texels: scrolled, copied and cleared. Times are of the maps alone, their stages medians.";

}  // namespace

CascadeShare share_of(Run const& run, Run const& base) {
    auto const triangles = [](FrameRecord const& frame) { return number_of(frame, "triangles_drawn"); };
    CascadeShare share;
    share.triangles = mean_after_first(run, triangles);
    share.batches = mean_after_first(run, [](FrameRecord const& frame) { return number_of(frame, "batches_drawn"); });
    share.texels_rewritten = mean_after_first(run, [](FrameRecord const& frame) { return number_of(frame, "texels_rewritten"); });
    share.of_sums = over(share.triangles, mean_after_first(base, triangles));
    share.of_maps = mean_of_maps(run, base);
    share.pass_ms = mean_after_first(run, pass_ms);
    share.pass_share = over(share.pass_ms, mean_after_first(base, pass_ms));
    return share;
}

std::string cascades_bench_html(CascadesBench const& bench) {
    Report const& any = bench.any();
    std::string html = page_head("Cascades that scroll, measured");
    html += fmt::format("<p class='lead'>Four maps of 512 texels and 16 bits through a town of 500,000 triangles, drawn anew (csm), kept while they stand "
                        "still (csm-cached), or scrolled (csm-scroll), on {} with {} thread{}. All three give the same maps. {}</p>\n",
                        escaped(any.machine.cpu), any.threads, any.threads == 1 ? "" : "s", explanation_text);
    for (MotionResult const& motion : bench.motions)
        html += fmt::format("<h2>{}</h2>\n", escaped(motion.name)) + rows_html(rows_of(motion.report)) + lines_html(motion.report);
    for (MotionResult const& guard : bench.guards)
        html += fmt::format("<h2>{}</h2>\n<p>The map proper moves within its band before anything scrolls: fewer scrolls, coarser texels.</p>\n",
                            escaped(guard.name)) +
                rows_html(guard_rows_of(guard.report));
    return html + page_foot(any);
}

std::string cascades_bench_text(CascadesBench const& bench, bool styled) {
    std::string text = std::string(explanation_text) + "\n\n";
    auto const section = [&](std::string const& title, Rows const& rows) { text += title + "\n\n" + aligned(rows, {.bold_head = styled}) + '\n'; };
    for (MotionResult const& motion : bench.motions) section(motion.name, rows_of(motion.report));
    for (MotionResult const& guard : bench.guards) section(guard.name, guard_rows_of(guard.report));
    return text;
}

}  // namespace gnomon::command
