// `bench cascades`: the paper's motions through `town`, moving casters, a moving sun, guard bands.

#include "bench_cascades.hpp"

#include "json.hpp"
#include "progress.hpp"
#include "table.hpp"
#include "verbs.hpp"
#include "walk.hpp"

#include <gnomon/core/executor_tbb.hpp>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace gnomon::command {

namespace {

/// How a camera, props and the sun move.
struct MotionChoice {
    std::string key;  ///< As `--motions` names it.
    std::string name;
    std::string path;
    double moving_percent = 0.0;
    bool camera_stands = false;
    double sun_turns_deg = 0.0;  ///< A frame.
};

RunOptions options_for(BenchOptions const& bench, MotionChoice const& choice, std::vector<std::string> const& techniques) {
    RunOptions run = bench.run;
    run.scene.config.name = "town";
    run.scene.config.moving_percent = choice.moving_percent;
    run.motion.path = choice.path;
    run.techniques = techniques;
    run.truth = false;
    run.repeats = 1;
    return run;
}

/// The sun after a turn about the vertical.
math::dvec3 turned(math::dvec3 const& way, double degrees) {
    double const angle = degrees * 0.017453292519943295;
    double const c = std::cos(angle), s = std::sin(angle);
    return {c * way.x + s * way.z, way.y, c * way.z - s * way.x};
}

Outcome<MotionResult> fly_through(RunOptions const& run, MotionChoice const& choice, int frames, core::ExecutorRef executor, ProgressBar& bar) {
    auto plan = plan_runs(run);
    if (!plan) return std::move(plan).failure();
    Walk walk(run, *plan, executor);
    if (auto ready = walk.prepare(); !ready) return std::move(ready).failure();
    if (choice.camera_stands) walk.stand();
    for (int i = 0; i < std::min(frames, walk.frames()); ++i) {
        bar.show(i, frames, choice.name);
        if (auto compared = walk.step(i, false); !compared) return std::move(compared).failure();
        if (choice.sun_turns_deg == 0.0) continue;
        ChosenLight& sun = *walk.lighting().one;
        sun.of_scene = scene::none;  // ours to move
        sun.value.direction = turned(sun.value.direction, choice.sun_turns_deg);
    }
    walk.finish();
    return MotionResult{choice.name, walk.report()};
}

std::vector<MotionChoice> const& motions() {
    static std::vector<MotionChoice> const all{
        {"still", "the camera stands", "street", 0.0, true, 0.0},
        {"still-20", "the camera stands, 20 % of the props move", "street", 20.0, true, 0.0},
        {"street", "street: 15 m/s", "street", 0.0, false, 0.0},
        {"street-10", "street, 10 % of the props move", "street", 10.0, false, 0.0},
        {"street-20", "street, 20 % of the props move", "street", 20.0, false, 0.0},
        {"spin", "spin: 210 degrees a second", "spin", 0.0, false, 0.0},
        {"both-20", "both, 20 % of the props move", "both", 20.0, false, 0.0},
        {"sun", "street, and the sun turns by 0.1 degrees a frame", "street", 0.0, false, 0.1},
    };
    return all;
}

std::vector<MotionChoice> const& guards() {
    static std::vector<MotionChoice> const all{
        {"guard-street", "guard bands, street", "street", 0.0, false, 0.0},
        {"guard-spin", "guard bands, spin", "spin", 0.0, false, 0.0},
    };
    return all;
}

/// Those that `--motions` names; all where it names none.
bool is_wanted(BenchOptions const& options, MotionChoice const& choice) {
    return options.motions.empty() || std::find(options.motions.begin(), options.motions.end(), choice.key) != options.motions.end();
}

Outcome<core::Done> check_motions(BenchOptions const& options) {
    std::vector<std::string> known;
    for (auto const* list : {&motions(), &guards()})
        for (MotionChoice const& choice : *list) known.push_back(choice.key);
    for (std::string const& wanted : options.motions)
        if (std::find(known.begin(), known.end(), wanted) == known.end())
            return usage_error(fmt::format("--motions {}: there is no such motion; there are {}", wanted, fmt::join(known, ", ")));
    return core::Done{};
}

Outcome<CascadesBench> measure(BenchOptions const& options, core::ExecutorRef executor, ProgressBar& bar) {
    CascadesBench bench;
    for (MotionChoice const& choice : motions()) {
        if (!is_wanted(options, choice)) continue;
        auto walked = fly_through(options_for(options, choice, {"csm", "csm-cached", "csm-scroll"}), choice, options.frames, executor, bar);
        if (!walked) return std::move(walked).failure();
        bench.motions.push_back(*std::move(walked));
    }
    for (MotionChoice const& choice : guards()) {
        if (!is_wanted(options, choice)) continue;
        RunOptions run = options_for(options, choice, {"csm", "csm-scroll"});
        run.params.push_back({"csm-scroll", "guard", {"0", "4", "8", "16", "32", "64"}});
        auto walked = fly_through(run, choice, options.frames, executor, bar);
        if (!walked) return std::move(walked).failure();
        bench.guards.push_back(*std::move(walked));
    }
    return bench;
}

}  // namespace

Outcome<core::Done> bench_cascades(BenchOptions const& options) {
    if (auto known = check_motions(options); !known) return known;
    if (auto outputs = check_outputs(options.run); !outputs) return outputs;
    core::TbbExecutor executor(options.run.threads);
    ProgressBar bar(is_terminal(2));
    auto bench = measure(options, executor, bar);
    if (!bench) return std::move(bench).failure();
    std::vector<OutputFile> files{{"index.html", bytes_of(cascades_bench_html(*bench))}};
    std::vector<Report const*> reports;
    for (MotionResult const& motion : bench->motions) reports.push_back(&motion.report);
    for (MotionResult const& guard : bench->guards) reports.push_back(&guard.report);
    Bytes const results = bytes_of(json_text(reports, {"index.html", "results.json"}));
    files.push_back({"results.json", results});
    std::string const folder = out_folder(options.run);
    if (auto written = write_folder(folder, files); !written) return written;
    bar.clear();
    bool const styled = is_terminal(options.run.json == "-" ? 2 : 1);
    return conclude(options.run, results, cascades_bench_text(*bench, styled) + "\nwritten: " + folder + "/index.html\n");
}

}  // namespace gnomon::command
