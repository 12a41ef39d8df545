#include "page.hpp"

#include "page_style.hpp"
#include "plot.hpp"
#include "table.hpp"
#include "values.hpp"

#include <fmt/format.h>

#include <cmath>
#include <iterator>

namespace gnomon::command {

namespace {

std::string params_text(pipeline::RunReport const& run) {
    std::string text;
    for (pipeline::Params::Value const& value : run.params)
        text += fmt::format("{}{} = {}", text.empty() ? "" : ", ", value.name, value.text);
    return text;
}

std::string picture_html(Bytes const& png, math::ivec2 size_px, std::string const& alt) {
    return fmt::format("<img width='{}' height='{}' alt='{}' src='{}'>", size_px.x, size_px.y, escaped(alt),
                       data_uri(png));
}

/// What the numbers say, in words: the least wrong of the inexact runs, beside ray.
std::string verdict_html(Report const& report) {
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

/// The overlays' own colours, so that the legend shows what the pictures show.
std::string css_color(math::vec3 const& linear) {
    auto const encoded = [](float c) {
        return 255.0F * (c <= 0.0031308F ? 12.92F * c : 1.055F * std::pow(c, 1.0F / 2.4F) - 0.055F);
    };
    return fmt::format("rgb({:.0f} {:.0f} {:.0f})", encoded(linear.x), encoded(linear.y), encoded(linear.z));
}

/// Each word on one line: an option must not be broken after its hyphens.
std::string unbroken(std::string const& text) {
    std::string html;
    for (std::string const& word : split(text, ' '))
        html += fmt::format("<span class='word'>{}</span> ", escaped(word));
    return html;
}

std::string facts_html(Report const& report) {
    std::string html = "<dl>\n";
    for (Fact const& fact : report.facts)
        fmt::format_to(std::back_inserter(html), "<dt>{}</dt><dd>{}</dd>\n", escaped(fact.name), unbroken(fact.value));
    return html + "</dl>\n";
}

std::string table_html(Report const& report) {
    std::string html =
        "<div class='wide'><table>\n<thead><tr><th>run</th><th>wrong, %</th>"
        "<th><span class='swatch lit'></span>false-lit</th><th><span class='swatch shadow'></span>false-shadow</th>"
        "<th>edge error<br>mean, px</th><th>edge error<br>max, px</th><th>median<br>ms</th><th>speed<br>× "
        "ray</th></tr></thead>\n<tbody>\n";
    for (Run const& run : report.runs) {
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

std::string details_html(Run const& run) {
    std::string html = "<details><summary>times, counts and settings</summary><dl>\n";
    auto out = std::back_inserter(html);
    std::string const params = params_text(run.result);
    if (!params.empty()) fmt::format_to(out, "<dt>settings</dt><dd>{}</dd>\n", escaped(params));
    fmt::format_to(out, "<dt>total, ms</dt><dd>median {}, min {}, max {}</dd>\n", figures(run.result.ms.median),
                   figures(run.result.ms.min), figures(run.result.ms.max));
    for (pipeline::StageTime const& stage : run.result.stages)
        fmt::format_to(out, "<dt>{}, ms</dt><dd>{}</dd>\n", escaped(stage.name), figures(stage.ms));
    pipeline::Measures const& error = run.result.error;
    fmt::format_to(out, "<dt>acne</dt><dd>{} of the false-shadow samples</dd>\n", grouped(error.acne));
    fmt::format_to(out, "<dt>detachment</dt><dd>{} of the false-lit samples</dd>\n", grouped(error.detachment));
    fmt::format_to(out, "<dt>edge error p99, px</dt><dd>{}</dd>\n", figures(error.edge_px.p99));
    fmt::format_to(out, "<dt>visibility error</dt><dd>mean {}, p99 {}</dd>\n", figures(error.visibility_error_mean),
                   figures(error.visibility_error_p99));
    fmt::format_to(out, "<dt>radiance error</dt><dd>{} % relative RMS</dd>\n", percent(error.radiance_error));
    for (pipeline::Count const& count : run.result.counts)
        fmt::format_to(out, "<dt>{}</dt><dd>{}</dd>\n", escaped(count.name), grouped(count.value));
    for (pipeline::Count const& count : run.result.bytes)
        fmt::format_to(out, "<dt>bytes, {}</dt><dd>{}</dd>\n", escaped(count.name), grouped(count.value));
    return html + "</dl></details>\n";
}

std::string choice_html(std::string const& group, std::string const& extra_lit, std::string const& extra_wrong) {
    return fmt::format(
        "<span class='choice'><input type='radio' class='show-lit' name='{0}' id='{0}-lit' checked{1}>"
        "<label for='{0}-lit'>picture</label><input type='radio' class='show-wrong' name='{0}' id='{0}-wrong'{2}>"
        "<label for='{0}-wrong'>wrong pixels</label></span>",
        group, extra_lit, extra_wrong);
}

std::string card_html(Report const& report, Run const& run, RunPictures const& pictures, std::size_t index) {
    pipeline::Measures const& error = run.result.error;
    auto const speed = speed_over_ray(report, run);
    std::string const pace = speed && run.result.technique != "ray" ? fmt::format(", {} × ray", figures(*speed)) : "";
    return fmt::format(
        "<article class='card'>\n<header><h3>{}</h3>{}</header>\n<div class='flip'>{}{}</div>\n"
        "<p class='figures'>{} % wrong: <span class='swatch lit'></span>{} false-lit, "
        "<span class='swatch shadow'></span>{} false-shadow. {} ms{}.</p>\n{}</article>\n",
        escaped(run.label), choice_html(fmt::format("run{}", index), "", ""),
        picture_html(pictures.lit, report.size_px, "Lit picture of " + run.label),
        picture_html(pictures.marks, report.size_px, "Wrong pixels of " + run.label), percent(error.wrong_fraction),
        grouped(error.false_lit), grouped(error.false_shadow), figures(run.result.ms.median), pace, details_html(run));
}

std::string plot_section(Report const& report) {
    std::vector<PlotPoint> points;
    for (Run const& run : report.runs)
        points.push_back({run.label, run.result.technique, run.result.ms.median, run.result.error.wrong_fraction});
    return "<h2>Speed against error</h2>\n<p>Down is more exact, left is faster. Points of one technique are "
           "joined.</p>\n" +
           plot_svg(points, ray_ms(report));
}

constexpr std::string_view explanation =
    "<p>Every pixel that shows a surface is one sample. For each, exact arithmetic decides whether anything stands "
    "between it and the light: that is the truth. A run is wrong where its answer differs.</p>\n";

constexpr std::string_view legend =
    "<ul class='legend'><li><span class='swatch lit'></span><b>false-lit</b>: shown lit, truly in shadow (a leak)</li>"
    "<li><span class='swatch shadow'></span><b>false-shadow</b>: shown in shadow, truly lit (acne, a blocky "
    "edge)</li></ul>\n"
    "<p class='soft'>Wrong pixels are drawn three pixels wide here; the files that end in .wrong.png show them as they "
    "are.</p>\n";

}  // namespace

std::string page_html(Report const& report, ReportPictures const& pictures) {
    std::string const title = fmt::format("Shadows of {}, measured", report.scene);
    std::string html = fmt::format(
        "<!doctype html>\n<html lang='en'><head><meta charset='utf-8'>"
        "<meta name='viewport' content='width=device-width, initial-scale=1'>\n<title>{0}</title>\n<style>{1}:root {{ "
        "--lit: {2}; "
        "--shadow: {3}; }}</style></head>\n<body><main>\n<h1>{0}</h1>\n",
        escaped(title), page_style, css_color(pipeline::false_lit_color), css_color(pipeline::false_shadow_color));
    html += verdict_html(report);
    html += fmt::format(
        "<div class='top'><figure>{}<figcaption>The scene with exact shadows: the reference that every run "
        "is measured against.</figcaption></figure>\n",
        picture_html(pictures.exact, report.size_px, "The scene with exact shadows"));
    html += facts_html(report) + "</div>\n<h2>The runs</h2>\n";
    html += explanation;
    html += table_html(report);
    html +=
        "<p class='soft'>Edge error: how far a wrong sample lies from the nearest one that truly has its state. Speed: "
        "the "
        "time of exact rays divided by the run's, measured in the same command on the same samples: the ray run's "
        "time, or that of "
        "tracing the truth where there is no ray run.</p>\n";
    html += plot_section(report);
    html += "<h2>Pictures</h2>\n";
    html += legend;
    html += fmt::format("<p>All runs: {} Click a picture to see it pixel for pixel.</p>\n<div class='cards'>\n",
                        choice_html("all", " data-all='show-lit'", " data-all='show-wrong'"));
    for (std::size_t i = 0; i < report.runs.size(); ++i) html += card_html(report, report.runs[i], pictures.runs[i], i);
    html += "</div>\n<h2>Again</h2>\n";
    html += fmt::format("<pre><code>{}</code></pre>\n", escaped(report.command));
    html += fmt::format("<footer class='soft'>gnomon {}. The numbers are in results.json beside this page.</footer>\n",
                        GNOMON_VERSION);
    html += fmt::format("<dialog><img alt='' src='data:,'></dialog>\n<script>{}</script>\n</main></body></html>\n",
                        page_script);
    return html;
}

}  // namespace gnomon::command
