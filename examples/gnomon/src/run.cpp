// `render` and `compare`: inputs, frame, runs, report, files.

#include "verbs.hpp"

#include "inputs.hpp"
#include "json.hpp"
#include "output.hpp"
#include "page.hpp"
#include "plan.hpp"
#include "progress.hpp"
#include "table.hpp"

#include <gnomon/core/executor_tbb.hpp>
#include <gnomon/pipeline.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <utility>

namespace gnomon::command {

namespace {

/// Scene, view and light, ready for a frame.
struct Inputs {
    LoadedScene loaded;
    scene::Geometry geometry;
    Described<math::View> view;
    Described<scene::Light> light;
};

Outcome<Inputs> gather(RunOptions const& options) {
    auto loaded = load_scene(options.scene);
    if (!loaded) return std::move(loaded).failure();
    scene::Geometry geometry = scene::flatten(loaded->scene);
    auto view = choose_view(options.view, *loaded, geometry);
    if (!view) return std::move(view).failure();
    auto light = choose_light(options.light, loaded->scene, geometry, view->value);
    if (!light) return std::move(light).failure();
    return Inputs{*std::move(loaded), std::move(geometry), *std::move(view), *std::move(light)};
}

std::string out_folder(RunOptions const& options) {
    return options.out.value_or(options.verb == Verb::compare ? "gnomon-compare" : "gnomon-render");
}

Outcome<core::Done> check_outputs(RunOptions const& options) {
    if (auto folder = check_folder("--out", out_folder(options)); !folder) return folder;
    if (options.json && *options.json != "-") return check_file("--json", *options.json);
    return core::Done{};
}

/// What was left out of the scene on the way in, for the page.
std::string left_out(Inputs const& inputs, pipeline::Frame const& frame) {
    scene::Notes const& notes = inputs.loaded.scene.notes;
    std::string text;
    auto const add = [&](std::uint64_t count, char const* what) {
        if (count != 0) text += fmt::format("{}{} {}", text.empty() ? "" : ", ", grouped(count), what);
    };
    add(notes.non_finite_triangles + inputs.geometry.non_finite_triangles + frame.bad_triangles, "unusable triangles");
    add(notes.points_and_lines, "primitives of points or lines");
    add(notes.failed_images, "images");
    return text;
}

/// "camera_pass" as "camera pass".
std::string words_of(std::string_view name) {
    std::string words(name);
    std::replace(words.begin(), words.end(), '_', ' ');
    return words;
}

std::vector<Fact> facts_of(RunOptions const& options, Inputs const& inputs, pipeline::Frame const& frame,
                           Report const& report) {
    scene::Scene const& scene = inputs.loaded.scene;
    bool const from_scene = inputs.light.text.starts_with("--light");
    double const lit =
        report.samples == 0 ? 0.0 : static_cast<double>(report.truly_lit) / static_cast<double>(report.samples);
    std::vector<Fact> facts = {
        {"scene", report.scene},
        {"triangles",
         fmt::format("{} drawn, {} stored", grouped(report.triangles), grouped(scene::count_unique_triangles(scene)))},
        {"view", report.view},
        {"light", fmt::format("{} ({}{})", report.light, pipeline::name_of(inputs.light.value.kind),
                              from_scene ? fmt::format(", the scene has {}", scene.lights.size()) : "")},
        {"samples", fmt::format("{} of {} pixels show a surface; {:.1f} % of them are truly lit",
                                grouped(report.samples), grouped(pipeline::pixel_count(report.size_px)), lit * 100.0)}};
    if (std::string const missing = left_out(inputs, frame); !missing.empty()) facts.push_back({"left out", missing});
    for (std::string const& warning : scene.notes.warnings) facts.push_back({"note", warning});
    std::string truth;
    for (pipeline::StageTime const& stage : frame.stages)
        truth += fmt::format("{}{} {} ms", truth.empty() ? "" : ", ", words_of(stage.name), figures(stage.ms));
    facts.push_back({"preparation", truth});
    facts.push_back({"machine", fmt::format("{}, {} threads used of {}", report.machine.cpu, options.threads,
                                            report.machine.logical_cores)});
    facts.push_back({"SIMD", report.machine.simd});
    facts.push_back(
        {"build", fmt::format("{}, {}, {}", report.machine.compiler, report.machine.build, report.machine.system)});
    return facts;
}

Report make_report(RunOptions const& options, Inputs const& inputs, pipeline::Frame const& frame) {
    Report report;
    report.command = options.command;
    report.scene = inputs.loaded.text;
    report.view = inputs.view.text;
    report.light = inputs.light.text;
    report.size_px = inputs.view.value.size_px;
    report.triangles = inputs.geometry.indices.size() / 3;
    report.threads = options.threads;
    report.repeats = options.repeats;
    report.machine = this_machine();
    report.samples = frame.samples.size();
    for (pipeline::StageTime const& stage : frame.stages)
        if (stage.name.starts_with("truth")) report.truth_ms += stage.ms;
    return report;
}

Picture picture_of(pipeline::Image const& image) { return {image.size_px, 3, image.rgb}; }

/// Compresses every picture once, in parallel.
ReportPictures compress(Report const& report, bool overlays, core::ExecutorRef executor) {
    ReportPictures pictures;
    pictures.runs.resize(report.runs.size());
    std::vector<std::pair<pipeline::Image const*, Bytes*>> jobs;
    if (overlays) jobs.emplace_back(&report.exact, &pictures.exact);
    for (std::size_t i = 0; i < report.runs.size(); ++i) {
        jobs.emplace_back(&report.runs[i].result.lit, &pictures.runs[i].lit);
        if (overlays) jobs.emplace_back(&report.runs[i].result.overlay, &pictures.runs[i].overlay);
    }
    executor.parallel_for(jobs.size(), 1, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) *jobs[i].second = png_from(picture_of(*jobs[i].first));
    });
    if (overlays)
        executor.parallel_for(report.runs.size(), 1, [&](std::size_t begin, std::size_t end) {
            for (std::size_t i = begin; i < end; ++i)
                pictures.runs[i].marks = png_from(thickened(picture_of(report.runs[i].result.overlay)));
        });
    return pictures;
}

std::vector<OutputFile> files_of(Report const& report, Verb verb, core::ExecutorRef executor) {
    bool const compares = verb == Verb::compare;
    ReportPictures pictures = compress(report, compares, executor);
    std::vector<OutputFile> files;
    if (compares) files.push_back({"index.html", bytes_of(page_html(report, pictures))});
    if (compares) files.push_back({"reference.png", std::move(pictures.exact)});
    for (std::size_t i = 0; i < report.runs.size(); ++i) {
        std::string const& slug = report.runs[i].slug;
        files.push_back({slug + (compares ? ".lit.png" : ".png"), std::move(pictures.runs[i].lit)});
        if (compares) files.push_back({slug + ".wrong.png", std::move(pictures.runs[i].overlay)});
    }
    std::vector<std::string> names;
    for (OutputFile const& file : files) names.push_back(file.name);
    names.emplace_back("results.json");
    files.push_back({"results.json", bytes_of(json_text(report, names))});
    return files;
}

/// The pipeline's own reports of progress, after the two steps that come first here.
struct StepsOfRuns {
    ProgressBar* bar;
    std::vector<PlannedRun> const* plan;
    static constexpr int before = 2;
    static constexpr int after = 1;

    /// The pipeline shades the frame before the runs.
    static int steps(std::size_t runs) { return before + 1 + static_cast<int>(runs) + after; }

    static void report(void* context, int done, int total, std::string_view what) {
        auto const& self = *static_cast<StepsOfRuns*>(context);
        bool const is_run = done >= 1 && static_cast<std::size_t>(done) <= self.plan->size();
        self.bar->show(before + done, before + total + after,
                       is_run ? std::string_view((*self.plan)[static_cast<std::size_t>(done) - 1].label) : what);
    }
};

/// What went wrong in the pipeline, as an exit: values that the command line gave are a matter of usage.
core::Failure<Exit> exit_for(core::Failure<pipeline::Error> const& why) {
    switch (why.code) {
        case pipeline::Error::unknown_technique:
        case pipeline::Error::unknown_parameter:
        case pipeline::Error::bad_value:
        case pipeline::Error::bad_light:
        case pipeline::Error::bad_view: return usage_error(why.message);
        case pipeline::Error::empty_scene:
        case pipeline::Error::too_large: break;
    }
    return failure(why.message);
}

Outcome<Report> measure(RunOptions const& options, std::vector<PlannedRun> const& plan, ProgressBar& bar,
                        core::ExecutorRef executor) {
    int const steps = StepsOfRuns::steps(plan.size());
    bar.show(0, steps, "reading " + options.scene.config.name);
    auto inputs = gather(options);
    if (!inputs) return std::move(inputs).failure();
    bar.show(1, steps, "tracing the exact shadows");
    auto frame =
        pipeline::make_frame(inputs->loaded.scene, inputs->geometry, inputs->view.value, inputs->light.value, executor);
    if (!frame) return exit_for(frame.failure());
    std::vector<pipeline::RunRequest> requests;
    for (PlannedRun const& planned : plan) requests.push_back({planned.technique, planned.params});
    StepsOfRuns steps_of_runs{&bar, &plan};
    pipeline::CompareConfig config;
    config.repeats = options.repeats;
    config.progress = {&StepsOfRuns::report, &steps_of_runs};
    auto compared = pipeline::compare(*frame, requests, config, executor);
    if (!compared) return exit_for(compared.failure());
    Report report = make_report(options, *inputs, *frame);
    report.truly_lit = compared->truly_lit;
    report.exact = std::move(compared->exact);
    for (std::size_t i = 0; i < plan.size(); ++i)
        report.runs.push_back({plan[i].label, plan[i].slug, std::move(compared->runs[i])});
    report.facts = facts_of(options, *inputs, *frame, report);
    return report;
}

}  // namespace

Outcome<core::Done> run(RunOptions const& options) {
    auto plan = plan_runs(options.techniques, options.params);
    if (!plan) return std::move(plan).failure();
    if (auto outputs = check_outputs(options); !outputs) return outputs;
    core::TbbExecutor executor(options.threads);
    ProgressBar bar(is_terminal(2));
    auto report = measure(options, *plan, bar, executor);
    if (!report) return std::move(report).failure();
    int const steps = StepsOfRuns::steps(plan->size());
    bar.show(steps - 1, steps, "writing " + out_folder(options));
    std::vector<OutputFile> const files = files_of(*report, options.verb, executor);
    if (auto written = write_folder(out_folder(options), files); !written) return written;
    bar.clear();
    bool const json_to_stdout = options.json && *options.json == "-";
    if (json_to_stdout) {
        if (auto printed = print(std::string(files.back().bytes.begin(), files.back().bytes.end())); !printed)
            return printed;
    } else if (options.json) {
        if (auto written = write_file(*options.json, files.back().bytes); !written) return written;
    }
    std::string const where = out_folder(options) + (options.verb == Verb::compare ? "/index.html" : "/");
    std::string const text = table_text(*report, is_terminal(json_to_stdout ? 2 : 1)) + "\nwritten: " + where + '\n';
    if (!json_to_stdout) return print(text);
    std::fputs(text.c_str(), stderr);
    return core::Done{};
}

}  // namespace gnomon::command
