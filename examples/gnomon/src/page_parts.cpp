#include "page_parts.hpp"

#include "lights_parts.hpp"
#include "page_style.hpp"
#include "plot.hpp"
#include "table.hpp"
#include "values.hpp"

#include <gnomon/pipeline/shade.hpp>

#include <fmt/format.h>

#include <iterator>

namespace gnomon::command {

namespace {

std::string params_text(pipeline::RunReport const& run) {
    std::string text;
    for (pipeline::Params::Value const& value : run.params)
        text += fmt::format("{}{} = {}", text.empty() ? "" : ", ", value.name, value.text);
    return text;
}

/// Each word on one line: an option must not be broken after its hyphens.
std::string unbroken(std::string const& text) {
    std::string html;
    for (std::string const& word : split(text, ' '))
        html += fmt::format("<span class='word'>{}</span> ", escaped(word));
    return html;
}

std::string error_html(pipeline::RunReport const& run) {
    std::string html;
    if (!run.measured) return html;
    auto out = std::back_inserter(html);
    pipeline::Measures const& error = run.error;
    fmt::format_to(out, "<dt>acne</dt><dd>{} of the false-shadow samples</dd>\n", grouped(error.acne));
    fmt::format_to(out, "<dt>detachment</dt><dd>{} of the false-lit samples</dd>\n", grouped(error.detachment));
    fmt::format_to(out, "<dt>edge error p99, px</dt><dd>{}</dd>\n", figures(error.edge_px.p99));
    fmt::format_to(out, "<dt>visibility error</dt><dd>mean {}, p99 {}</dd>\n", figures(error.visibility_error_mean),
                   figures(error.visibility_error_p99));
    fmt::format_to(out, "<dt>radiance error</dt><dd>{} % relative RMS</dd>\n", percent(error.radiance_error));
    return html;
}

}  // namespace

std::string picture_html(Bytes const& file, math::ivec2 size_px, std::string const& alt) {
    return fmt::format("<img width='{}' height='{}' alt='{}' src='{}'>", size_px.x, size_px.y, escaped(alt),
                       data_uri(file));
}

std::string facts_html(Report const& report) {
    std::string html = "<dl>\n";
    for (Fact const& fact : report.facts)
        fmt::format_to(std::back_inserter(html), "<dt>{}</dt><dd>{}</dd>\n", escaped(fact.name), unbroken(fact.value));
    return html + "</dl>\n";
}

std::string details_html(Run const& run) {
    std::string html = "<details><summary>times, counts and settings</summary><dl>\n";
    auto out = std::back_inserter(html);
    std::string const params = params_text(run.result);
    if (!params.empty()) fmt::format_to(out, "<dt>settings</dt><dd>{}</dd>\n", escaped(params));
    fmt::format_to(out, "<dt>total, ms</dt><dd>median {}, min {}, max {}</dd>\n", figures(run.result.ms.median),
                   figures(run.result.ms.min), figures(run.result.ms.max));
    for (pipeline::StageTime const& stage : run.result.stages)
        fmt::format_to(out, "<dt>{}, ms</dt><dd>{}</dd>\n", escaped(stage.name), figures(stage.ms));
    html += error_html(run.result);
    for (pipeline::Count const& count : run.result.counts)
        fmt::format_to(out, "<dt>{}</dt><dd>{}</dd>\n", escaped(count.name), grouped(count.value));
    for (pipeline::Count const& count : run.result.redraw_reasons)
        fmt::format_to(out, "<dt>drawn to, {}</dt><dd>{}</dd>\n", escaped(count.name), grouped(count.value));
    for (pipeline::Count const& count : run.result.bytes)
        fmt::format_to(out, "<dt>bytes, {}</dt><dd>{}</dd>\n", escaped(count.name), grouped(count.value));
    return html + "</dl></details>\n";
}

std::string choice_html(Report const& report, std::string const& group, std::string const& extra_lit,
                        std::string const& extra_wrong) {
    return fmt::format(
        "<span class='choice'><input type='radio' class='show-lit' name='{0}' id='{0}-lit' checked{1}>"
        "<label for='{0}-lit'>picture</label><input type='radio' class='show-wrong' name='{0}' id='{0}-wrong'{2}>"
        "<label for='{0}-wrong'>{3}</label></span>",
        group, extra_lit, extra_wrong, report.many_lights ? "lights per pixel" : "wrong pixels");
}

std::string verdict_html(Report const& report) {
    if (report.many_lights) return lights_verdict_html(report);
    if (!report.has_truth) return {};
    Run const* best = nullptr;
    for (Run const& run : report.runs) {
        bool const inexact = run.result.error.wrong > 0;
        if (inexact && (best == nullptr || run.result.error.wrong < best->result.error.wrong)) best = &run;
    }
    if (report.samples == 0) return "<p class='lead'>The view sees nothing of the scene.</p>\n";
    if (best == nullptr) return "<p class='lead'>Every run agrees with the exact shadows on every sample.</p>\n";
    auto const speed = speed_over_ray(report, *best);
    std::string const pace =
        !speed          ? ""
        : *speed >= 1.0 ? fmt::format(", and is {} times as fast as tracing exact rays", figures(*speed))
                        : fmt::format(", and takes {} times as long as tracing exact rays", figures(1.0 / *speed));
    return fmt::format(
        "<p class='lead'>The least wrong approximation here, {}, decides {} % of the visible samples "
        "wrongly{}.</p>\n",
        escaped(best->label), percent(best->result.error.wrong_fraction), pace);
}

std::string table_html(Report const& report) {
    if (report.many_lights) return lights_table_html(report);
    std::string html =
        "<div class='wide'><table>\n<thead><tr><th>run</th><th>wrong, %</th>"
        "<th><span class='swatch lit'></span>false-lit</th><th><span class='swatch shadow'></span>false-shadow</th>"
        "<th>edge error<br>mean, px</th><th>edge error<br>max, px</th><th>median<br>ms</th><th>speed<br>× "
        "ray</th></tr></thead>\n<tbody>\n";
    if (!report.has_truth) html = "<div class='wide'><table>\n<thead><tr><th>run</th><th>median<br>ms</th></tr></thead>\n<tbody>\n";
    for (Run const& run : report.runs) {
        if (!report.has_truth) {
            fmt::format_to(std::back_inserter(html), "<tr><td>{}</td><td>{}</td></tr>\n", escaped(run.label),
                           figures(run.result.ms.median));
            continue;
        }
        pipeline::Measures const& error = run.result.error;
        auto const speed = speed_over_ray(report, run);
        fmt::format_to(
            std::back_inserter(html),
            "<tr><td>{}</td><td>{}</td><td>{}</td><td>{}</td><td>{}</td><td>{}</td><td>{}</td><td>{}</td></tr>\n",
            escaped(run.label), percent(error.wrong_fraction), grouped(error.false_lit), grouped(error.false_shadow),
            figures(error.edge_px.mean), figures(error.edge_px.max), figures(run.result.ms.median),
            speed ? figures(*speed) : "-");
    }
    return html + "</tbody></table></div>\n";
}

std::string card_html(Report const& report, Run const& run, RunPictures const& pictures, std::size_t index) {
    pipeline::Measures const& error = run.result.error;
    auto const speed = speed_over_ray(report, run);
    std::string const pace = speed && run.result.technique != "ray" ? fmt::format(", {} × ray", figures(*speed)) : "";
    std::string const lit = picture_html(pictures.lit, report.size_px, "Lit picture of " + run.label);
    if (report.many_lights)
        return fmt::format("<article class='card'>\n<header><h3>{}</h3>{}</header>\n<div class='flip'>{}{}</div>\n"
                           "<p class='figures'>{}</p>\n{}</article>\n",
                           escaped(run.label), choice_html(report, fmt::format("run{}", index), "", ""), lit,
                           picture_html(pictures.marks, report.size_px, "Lights evaluated for each pixel by " + run.label),
                           lights_figures_html(report, run), details_html(run));
    if (!report.has_truth)
        return fmt::format("<article class='card'>\n<header><h3>{}</h3></header>\n<div class='flip'>{}</div>\n"
                           "<p class='figures'>{} ms.</p>\n{}</article>\n",
                           escaped(run.label), lit, figures(run.result.ms.median), details_html(run));
    return fmt::format(
        "<article class='card'>\n<header><h3>{}</h3>{}</header>\n<div class='flip'>{}{}</div>\n"
        "<p class='figures'>{} % wrong: <span class='swatch lit'></span>{} false-lit, "
        "<span class='swatch shadow'></span>{} false-shadow. {} ms{}.</p>\n{}</article>\n",
        escaped(run.label), choice_html(report, fmt::format("run{}", index), "", ""), lit,
        picture_html(pictures.marks, report.size_px, "Wrong pixels of " + run.label), percent(error.wrong_fraction),
        grouped(error.false_lit), grouped(error.false_shadow), figures(run.result.ms.median), pace, details_html(run));
}

std::string debug_html(Report const& report, std::vector<RunPictures> const& pictures) {
    std::string html;
    for (std::size_t i = 0; i < pictures.size(); ++i)
        for (DebugFile const& debug : pictures[i].debug)
            html += fmt::format("<figure class='debug'><img alt='{0}, {1}' src='{2}'><figcaption><b>{0}</b>, {1}. {3}</figcaption></figure>\n",
                                escaped(report.runs[i].label), escaped(debug.name), data_uri(debug.file), escaped(debug.caption));
    return html.empty() ? html : "<h2>How they got there</h2>\n" + html;
}

std::string rows_html(std::vector<std::vector<std::string>> const& rows) {
    std::string html = "<div class='wide'><table>\n<thead>";
    for (std::size_t r = 0; r < rows.size(); ++r) {
        char const* const cell = r == 0 ? "th" : "td";
        html += "<tr>";
        for (std::string const& text : rows[r]) html += fmt::format("<{0}>{1}</{0}>", cell, escaped(text));
        html += r == 0 ? "</tr></thead>\n<tbody>\n" : "</tr>\n";
    }
    return html + "</tbody></table></div>\n";
}

std::string page_head(std::string const& title) {
    return fmt::format(
        "<!doctype html>\n<html lang='en'><head><meta charset='utf-8'>"
        "<meta name='viewport' content='width=device-width, initial-scale=1'>\n<title>{0}</title>\n<style>{1}:root {{ "
        "--lit: {2}; --shadow: {3}; }}</style></head>\n<body><main>\n<h1>{0}</h1>\n",
        escaped(title), page_style, css_color(pipeline::false_lit_color), css_color(pipeline::false_shadow_color));
}

std::string page_foot(Report const& report) {
    return fmt::format(
        "<h2>Again</h2>\n<pre><code>{}</code></pre>\n<footer class='soft'>gnomon {}. The numbers are in results.json "
        "beside this page.</footer>\n<dialog><img alt='' src='data:,'></dialog>\n<script>{}</script>\n"
        "</main></body></html>\n",
        escaped(report.command), GNOMON_VERSION, page_script);
}

}  // namespace gnomon::command
