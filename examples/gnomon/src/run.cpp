// `render` and `compare` of one view: inputs, frame, runs, report, files.

#include "verbs.hpp"

#include "json.hpp"
#include "page.hpp"
#include "progress.hpp"
#include "run_parts.hpp"
#include "table.hpp"

#include <gnomon/core/executor_tbb.hpp>

#include <utility>

namespace gnomon::command {

namespace {

/// Compresses every picture once, in parallel.
ReportPictures compress(Report const& report, bool overlays, core::ExecutorRef executor) {
    ReportPictures pictures;
    pictures.runs.resize(report.runs.size());
    std::vector<std::pair<pipeline::Image const*, Bytes*>> jobs;
    if (overlays) jobs.emplace_back(&report.exact, &pictures.exact);
    for (std::size_t i = 0; i < report.runs.size(); ++i) {
        jobs.emplace_back(&report.runs[i].result.lit, &pictures.runs[i].lit);
        if (overlays) jobs.emplace_back(&report.runs[i].result.overlay, &pictures.runs[i].overlay);
        auto& debug = pictures.runs[i].debug;
        for (pipeline::DebugPicture const& picture : report.runs[i].result.pictures)
            debug.push_back({std::string(picture.name), std::string(picture.caption), {}});
        for (std::size_t k = 0; k < debug.size(); ++k) jobs.emplace_back(&report.runs[i].result.pictures[k].image, &debug[k].file);
    }
    executor.parallel_for(jobs.size(), 1, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) *jobs[i].second = png_from(picture_of(*jobs[i].first));
    });
    if (overlays)
        executor.parallel_for(report.runs.size(), 1, [&](std::size_t begin, std::size_t end) {
            for (std::size_t i = begin; i < end; ++i)
                pictures.runs[i].marks = report.many_lights
                                             ? pictures.runs[i].overlay
                                             : png_from(thickened(picture_of(report.runs[i].result.overlay)));
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
        if (compares)
            files.push_back({slug + (report.many_lights ? ".lights.png" : ".wrong.png"), std::move(pictures.runs[i].overlay)});
        for (DebugFile& debug : pictures.runs[i].debug) files.push_back({slug + '.' + debug.name + ".png", std::move(debug.file)});
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

Outcome<Report> measure(RunOptions const& options, std::vector<PlannedRun> const& plan, ProgressBar& bar,
                        core::ExecutorRef executor) {
    auto backends = Backends::open(options, executor);
    if (!backends) return std::move(backends).failure();
    int const steps = StepsOfRuns::steps(plan.size());
    bar.show(0, steps, "reading " + options.scene.config.name);
    auto stage = set_stage(options.scene, options.motion);
    if (!stage) return std::move(stage).failure();
    auto view = choose_view(options.view, *stage);
    if (!view) return std::move(view).failure();
    auto light = choose_lighting(options, plan, *stage, view->value);
    if (!light) return std::move(light).failure();
    bool const shadows = !lights_many(plan);
    bar.show(1, steps, shadows && options.truth ? "tracing the exact shadows" : "drawing");
    auto frame = pipeline::make_frame(stage->loaded.scene, stage->geometry,
                                      pipeline::Shot{view->value, light->for_frame(), shadows && options.truth, nullptr, light->rule()}, executor);
    if (!frame) return exit_for(frame.failure());
    StepsOfRuns steps_of_runs{&bar, &plan};
    pipeline::CompareConfig config;
    config.repeats = options.repeats;
    config.truth = options.truth;
    config.debug = options.debug;
    config.progress = {&StepsOfRuns::report, &steps_of_runs};
    auto compared = Requests(plan, *backends).compare(*frame, *light, config, executor);
    if (!compared) return std::move(compared).failure();
    Report report = start_report(options, *stage);
    report.many_lights = !shadows;
    report.light = light->text();
    report.view = view->text + stage->text();
    report.samples = compared->samples;
    report.truly_lit = compared->truly_lit;
    report.reaching = compared->reaching;
    report.heat_most = compared->heat_most;
    report.exact = std::move(compared->exact);
    for (pipeline::StageTime const& time : frame->stages)
        if (time.name.starts_with("truth")) report.truth_ms += time.ms;
    for (std::size_t i = 0; i < plan.size(); ++i) {
        report.runs.push_back(run_of(plan[i], *backends));
        report.runs.back().result = std::move(compared->runs[i]);
    }
    add_facts(report, *stage, *light, *frame);
    return report;
}

}  // namespace

Outcome<core::Done> run(RunOptions const& options) {
    auto plan = plan_runs(options);
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
    std::string const where = out_folder(options) + (options.verb == Verb::compare ? "/index.html" : "/");
    bool const styled = is_terminal(options.json == "-" ? 2 : 1);
    return conclude(options, files.back().bytes, table_text(*report, styled) + "\nwritten: " + where + '\n');
}

}  // namespace gnomon::command
