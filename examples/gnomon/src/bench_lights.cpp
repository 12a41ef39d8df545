// `bench lights`: walks, views under more and more lights, and the files that show them.

#include "bench_lights.hpp"

#include "json.hpp"
#include "progress.hpp"
#include "table.hpp"
#include "verbs.hpp"
#include "walk.hpp"

#include <gnomon/core/executor_tbb.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace gnomon::command {

namespace {

/// What stays the same in all experiments, and how far they have come.
struct Setting {
    BenchOptions const& options;
    core::ExecutorRef executor;
    ProgressBar& bar;
    int done = 0;
    int total = 1;

    void next(std::string const& what) { bar.show(done++, total, what); }
};

struct SceneChoice {
    std::string name;
    std::string lights;
    bool trees = false;
    std::optional<std::string> path;
    std::optional<std::string> camera;

    [[nodiscard]] std::string text() const { return name + ' ' + lights + (trees ? ", trees" : ""); }
};

RunOptions options_for(BenchOptions const& bench, SceneChoice const& choice, std::vector<std::string> const& techniques) {
    RunOptions run = bench.run;
    run.scene.config.name = choice.name;
    run.scene.config.lights = choice.lights;
    run.scene.config.trees = choice.trees;
    run.motion.path = choice.path;
    run.view.camera = choice.camera;
    if (choice.camera) run.motion.frames = 1;
    run.techniques = techniques;
    return run;
}

/// Both formats of the G-buffer, for those techniques that have one.
void add_formats(RunOptions& run) {
    for (std::string const& name : run.techniques) {
        auto const technique = pipeline::find_lighting_technique(name);
        if (!technique) continue;
        for (pipeline::ParamInfo const& param : (*technique)->params)
            if (param.name == "gbuffer") run.params.push_back({name, "gbuffer", {"f16", "f32"}});
    }
}

/// Frame i of n, spread evenly over a path from its first frame to its last.
int spread(int i, int n, int frames) { return n > 1 ? static_cast<int>(std::int64_t{i} * (frames - 1) / (n - 1)) : frames / 2; }

Outcome<PathResult> walk_path(Setting& setting, SceneChoice const& choice, RunOptions const& run) {
    setting.next(choice.text());
    auto plan = plan_runs(run);
    if (!plan) return std::move(plan).failure();
    Walk walk(run, *plan, setting.executor);
    if (auto ready = walk.prepare(); !ready) return std::move(ready).failure();
    int const frames = std::min(setting.options.frames, walk.frames());
    for (int i = 0; i < frames; ++i) {
        if (i > 0) setting.next(choice.text());
        if (auto compared = walk.step(spread(i, frames, walk.frames()), false); !compared) return std::move(compared).failure();
    }
    walk.finish();
    return PathResult{choice.text(), walk.report()};
}

/// Which of `count` lights shine when only `wanted` do: spread evenly over the list.
std::vector<scene::Light> some_of(std::vector<scene::Light> const& lights, std::uint32_t wanted) {
    std::vector<scene::Light> some;
    some.reserve(wanted);
    for (std::uint64_t i = 0; i < wanted; ++i) some.push_back(lights[i * lights.size() / wanted]);
    return some;
}

/// expects: `numbers` ascend.
Outcome<ScalingResult> grow(Setting& setting, SceneChoice const& choice, RunOptions const& run, std::vector<std::uint32_t> const& numbers,
                            int frame) {
    ScalingResult result{choice.text(), {}, {}};
    setting.next(choice.text());
    auto plan = plan_runs(run);
    if (!plan) return std::move(plan).failure();
    Walk walk(run, *plan, setting.executor);
    if (auto ready = walk.prepare(); !ready) return std::move(ready).failure();
    std::vector<scene::Light> const all = walk.lighting().many.values;
    for (std::uint32_t const number : numbers) {
        auto const wanted = std::min<std::uint32_t>(number, static_cast<std::uint32_t>(all.size()));
        if (!result.lights.empty() && result.lights.back() == wanted) break;
        if (!result.lights.empty()) setting.next(fmt::format("{}, {} lights", choice.text(), wanted));
        walk.lighting().many.values = some_of(all, wanted);
        walk.restart(fmt::format("{} of {} lights of the scene", grouped(wanted), grouped(all.size())));
        if (auto compared = walk.step(std::min(frame, walk.frames() - 1), false); !compared) return std::move(compared).failure();
        walk.finish();
        result.lights.push_back(wanted);
        result.reports.push_back(walk.report());
    }
    return result;
}

std::vector<std::string> const& paper_one() {
    static std::vector<std::string> const names{"deferred",              "deferred-stencil", "tiled-deferred", "tiled-deferred-single",
                                                "tiled-deferred-raster", "tiled-forward",    "tiled-forward-prez"};
    return names;
}

std::vector<std::string> const& paper_two() {
    static std::vector<std::string> const names{"deferred-stencil",        "tiled-deferred",        "tiled-deferred-en",
                                                "tiled-forward-prez",      "clustered-deferred",    "clustered-deferred-pt",
                                                "clustered-deferred-eb",   "clustered-deferred-en", "clustered-deferred-nk3",
                                                "clustered-deferred-nk3-eb-en", "clustered-deferred-device", "clustered-forward"};
    return names;
}

std::vector<std::uint32_t> limited(std::vector<std::uint32_t> numbers, std::uint32_t most) {
    for (std::uint32_t& n : numbers) n = std::min(n, most);
    return numbers;
}

Outcome<core::Done> measure_paper_one(Setting& setting, LightsBench& bench) {
    for (auto const& [set, result] : {std::pair{"many", &bench.many}, {"few", &bench.few}}) {
        SceneChoice const robots{"robots", set, false, "bart", {}};
        RunOptions run = options_for(setting.options, robots, paper_one());
        add_formats(run);
        auto walked = walk_path(setting, robots, run);
        if (!walked) return std::move(walked).failure();
        *result = *std::move(walked);
    }
    SceneChoice const robots{"robots", "many", false, "bart", {}};
    RunOptions const run = options_for(setting.options, robots, paper_one());
    auto grown = grow(setting, robots, run, limited({0, 10, 30, 100, 300, 924}, setting.options.most_lights), 186);
    if (!grown) return std::move(grown).failure();
    bench.growing = *std::move(grown);
    return core::Done{};
}

Outcome<core::Done> measure_paper_two(Setting& setting, LightsBench& bench) {
    std::string const lights = std::to_string(std::min(10'000U, setting.options.most_lights));
    for (bool const trees : {true, false}) {
        SceneChoice const path{"atrium", lights, trees, {}, {}};
        auto walked = walk_path(setting, path, options_for(setting.options, path, paper_two()));
        if (!walked) return std::move(walked).failure();
        bench.atrium.push_back(*std::move(walked));
    }
    for (bool const trees : {true, false}) {
        SceneChoice const still{"atrium", lights, trees, {}, "still"};
        auto const run = options_for(setting.options, still, {"tiled-deferred", "clustered-deferred", "clustered-deferred-pt"});
        auto grown = grow(setting, still, run, limited({10, 30, 100, 300, 1000, 3000, 10'000}, setting.options.most_lights), 0);
        if (!grown) return std::move(grown).failure();
        bench.crossing.push_back(*std::move(grown));
    }
    bool const whole = setting.options.most_lights >= 1'048'576;
    SceneChoice const swarm{"atrium", whole ? "million" : std::to_string(setting.options.most_lights), false, {}, "still"};
    RunOptions run = options_for(setting.options, swarm, {"clustered-deferred", "clustered-deferred-device", "tiled-deferred"});
    run.truth = false;
    auto grown = grow(setting, swarm, run, limited({32, 1024, 32'768, 1'048'576}, setting.options.most_lights), 0);
    if (!grown) return std::move(grown).failure();
    bench.assignment = *std::move(grown);
    return core::Done{};
}

/// Heat maps of the view `still` with trees.
Outcome<core::Done> paint(Setting& setting, LightsBench& bench) {
    setting.next("heat maps");
    SceneChoice const still{"atrium", std::to_string(std::min(10'000U, setting.options.most_lights)), true, {}, "still"};
    RunOptions run = options_for(setting.options, still, {"deferred-stencil", "tiled-deferred", "clustered-deferred"});
    run.truth = false;
    auto plan = plan_runs(run);
    if (!plan) return std::move(plan).failure();
    Walk walk(run, *plan, setting.executor);
    if (auto ready = walk.prepare(); !ready) return ready;
    auto compared = walk.step(0, true);
    if (!compared) return std::move(compared).failure();
    if (!compared->runs.empty())
        bench.heat.push_back({"the picture", run.view.size_px, png_from(picture_of(compared->runs.front().lit))});
    for (std::size_t i = 0; i < plan->size(); ++i)
        bench.heat.push_back({(*plan)[i].label, run.view.size_px, png_from(picture_of(compared->runs[i].overlay))});
    bench.heat_most = compared->heat_most;
    return core::Done{};
}

Outcome<core::Done> measure(Setting& setting, LightsBench& bench) {
    if (auto one = measure_paper_one(setting, bench); !one) return one;
    if (auto two = measure_paper_two(setting, bench); !two) return two;
    return paint(setting, bench);
}

}  // namespace

std::vector<Report const*> reports_of(LightsBench const& bench) {
    std::vector<Report const*> reports{&bench.many.report, &bench.few.report};
    auto const add = [&](ScalingResult const& result) {
        for (Report const& report : result.reports) reports.push_back(&report);
    };
    add(bench.growing);
    for (PathResult const& path : bench.atrium) reports.push_back(&path.report);
    for (ScalingResult const& result : bench.crossing) add(result);
    add(bench.assignment);
    return reports;
}

Outcome<core::Done> bench_lights(BenchOptions const& options) {
    if (auto outputs = check_outputs(options.run); !outputs) return outputs;
    core::TbbExecutor executor(options.run.threads);
    ProgressBar bar(is_terminal(2));
    // Four walks, and steps of a growing number of lights: one view of robots, two of the atrium, one of the million.
    Setting setting{options, executor, bar, 0, 4 * options.frames + 6 + 2 * 7 + 4 + 1};
    LightsBench bench;
    if (auto measured = measure(setting, bench); !measured) return measured;
    std::vector<OutputFile> files;
    files.push_back({"index.html", bytes_of(lights_bench_html(bench))});
    for (HeatPicture& picture : bench.heat) {
        std::string name = "heat " + picture.name + ".png";
        std::replace(name.begin(), name.end(), ' ', '-');
        files.push_back({name, picture.png});
    }
    std::vector<std::string> names;
    for (OutputFile const& file : files) names.push_back(file.name);
    names.emplace_back("results.json");
    Bytes const results = bytes_of(json_text(reports_of(bench), names));
    files.push_back({"results.json", results});
    std::string const folder = out_folder(options.run);
    if (auto written = write_folder(folder, files); !written) return written;
    bar.clear();
    bool const styled = is_terminal(options.run.json == "-" ? 2 : 1);
    return conclude(options.run, results, lights_bench_text(bench, styled) + "\nwritten: " + folder + "/index.html\n");
}

}  // namespace gnomon::command
