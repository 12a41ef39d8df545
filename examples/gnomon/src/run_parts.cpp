#include "run_parts.hpp"

#include "table.hpp"
#include "verbs.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <map>
#include <string_view>

namespace gnomon::command {

namespace {

/// What was left out of the scene on the way in.
std::string left_out(Stage const& stage, pipeline::Frame const& frame) {
    scene::Notes const& notes = stage.loaded.scene.notes;
    std::string text;
    auto const add = [&](std::uint64_t count, char const* what) {
        if (count != 0) text += fmt::format("{}{} {}", text.empty() ? "" : ", ", grouped(count), what);
    };
    add(notes.non_finite_triangles + stage.geometry.non_finite_triangles + frame.bad_triangles, "unusable triangles");
    add(notes.points_and_lines, "primitives of points or lines");
    add(notes.failed_images, "images");
    add(notes.dropped_channels, "animation channels");
    return text;
}

/// "camera_pass" as "camera pass".
std::string words_of(std::string_view name) {
    std::string words(name);
    std::replace(words.begin(), words.end(), '_', ' ');
    return words;
}

/// What shines, and what kinds of lights there are.
std::string light_fact(scene::Scene const& scene, Lighting const& light) {
    if (light.one)
        return fmt::format("{} ({}{})", light.one->text, pipeline::name_of(light.one->value.kind),
                           light.one->of_scene != scene::none ? fmt::format(", the scene has {}", scene.lights.size()) : "");
    std::map<std::string_view, std::size_t> kinds;
    for (scene::Light const& l : light.many.values) ++kinds[pipeline::name_of(l.kind)];
    std::string text;
    for (auto const& [kind, count] : kinds) text += fmt::format("{}{} {}", text.empty() ? "" : ", ", grouped(count), kind);
    return fmt::format("{} ({})", light.many.text, text);
}

std::string lit_share(Report const& report) {
    if (!report.has_truth || report.samples == 0) return {};
    if (report.many_lights)
        return fmt::format("; {} lights reach one of them on average",
                           figures(static_cast<double>(report.reaching) / static_cast<double>(report.samples)));
    double const lit = static_cast<double>(report.truly_lit) / static_cast<double>(report.samples);
    return fmt::format("; {:.1f} % of them are truly lit", lit * 100.0);
}

}  // namespace

std::string out_folder(RunOptions const& options) {
    if (options.out) return *options.out;
    switch (options.verb) {
        case Verb::render: return "gnomon-render";
        case Verb::compare: return "gnomon-compare";
        case Verb::bench: return "gnomon-bench";
        case Verb::flythrough: break;
    }
    return "gnomon-flythrough";
}

Outcome<core::Done> check_outputs(RunOptions const& options) {
    if (auto folder = check_folder("--out", out_folder(options)); !folder) return folder;
    if (options.json && *options.json != "-") return check_file("--json", *options.json);
    return core::Done{};
}

core::Failure<Exit> exit_for(core::Failure<pipeline::Error> const& why) {
    switch (why.code) {
        case pipeline::Error::unknown_technique:
        case pipeline::Error::unknown_parameter:
        case pipeline::Error::bad_value:
        case pipeline::Error::bad_light:
        case pipeline::Error::bad_view: return usage_error(why.message);
        case pipeline::Error::empty_scene:
        case pipeline::Error::too_large:
        case pipeline::Error::backend_failed: break;
    }
    return failure(why.message);
}

Report start_report(RunOptions const& options, Stage const& stage) {
    Report report;
    report.command = options.command;
    report.scene = stage.loaded.text;
    report.size_px = options.view.size_px;
    report.triangles = stage.geometry.indices.size() / 3;
    report.threads = options.threads;
    report.repeats = options.repeats;
    report.has_truth = options.truth;
    report.machine = this_machine();
    return report;
}

void add_facts(Report& report, Stage const& stage, Lighting const& light, pipeline::Frame const& frame) {
    scene::Scene const& scene = stage.loaded.scene;
    std::uint64_t const pixels = pipeline::pixel_count(report.size_px) * report.frames;
    report.facts = {
        {"scene", report.scene},
        {"triangles",
         fmt::format("{} drawn, {} stored", grouped(report.triangles), grouped(scene::count_unique_triangles(scene)))},
        {"view", report.view},
        {light.one ? "light" : "lights", light_fact(scene, light)},
        {"samples", fmt::format("{} of {} pixels show a surface{}", grouped(report.samples), grouped(pixels),
                                lit_share(report))}};
    if (std::string const missing = left_out(stage, frame); !missing.empty())
        report.facts.push_back({"left out", missing});
    for (std::string const& warning : scene.notes.warnings) report.facts.push_back({"note", warning});
    std::string preparation;
    for (pipeline::StageTime const& time : frame.stages)
        preparation += fmt::format("{}{} {} ms", preparation.empty() ? "" : ", ", words_of(time.name), figures(time.ms));
    report.facts.push_back({report.frames > 1 ? "preparation of the last frame" : "preparation", preparation});
    for (Run const& run : report.runs)
        if (run.result.backend != "cpu") {
            report.facts.push_back({"Vulkan device", run.device});
            break;
        }
    Machine const& machine = report.machine;
    report.facts.push_back({"machine", fmt::format("{}, {} threads used of {}", machine.cpu, report.threads,
                                                   machine.logical_cores)});
    report.facts.push_back({"SIMD", machine.simd});
    report.facts.push_back({"build", fmt::format("{}, {}, {}", machine.compiler, machine.build, machine.system)});
}

scene::Light Lighting::for_frame() const { return one ? one->value : pipeline::sun({0.0, -1.0, 0.0}); }

void Lighting::move_to(Stage const& stage) {
    if (!one) move_lights(many, stage);
    if (one && one->of_scene != scene::none) one->value = scene::posed_light(stage.loaded.scene, stage.pose, one->of_scene);
}

Outcome<Lighting> choose_lighting(RunOptions const& options, std::vector<PlannedRun> const& plan, Stage const& stage,
                                  math::View const& view) {
    Lighting lighting;
    if (lights_many(plan)) {
        auto lights = choose_lights(options.light, stage, view);
        if (!lights) return std::move(lights).failure();
        lighting.many = *std::move(lights);
        return lighting;
    }
    auto light = choose_light(options.light, stage, view);
    if (!light) return std::move(light).failure();
    lighting.one = *std::move(light);
    return lighting;
}

Requests::Requests(std::vector<PlannedRun> const& plan, Backends const& backends,
                   std::span<std::unique_ptr<pipeline::Workspace> const> workspaces) {
    for (std::size_t i = 0; i < plan.size(); ++i) {
        pipeline::Workspace* const workspace = workspaces.empty() ? nullptr : workspaces[i].get();
        backend::Backend* const device = &backends.get(plan[i].backend);
        if (plan[i].technique != nullptr) shadows_.push_back({plan[i].technique, plan[i].params, workspace, device});
        if (plan[i].lighting != nullptr) lighting_.push_back({plan[i].lighting, plan[i].params, workspace, device});
    }
}

Outcome<pipeline::Comparison> Requests::compare(pipeline::Frame const& frame, Lighting const& light,
                                                pipeline::CompareConfig const& config, core::ExecutorRef executor) const {
    auto compared = light.one ? pipeline::compare(frame, shadows_, config, executor)
                              : pipeline::compare(frame, light.many.values, lighting_, config, executor);
    if (!compared) return exit_for(compared.failure());
    return *std::move(compared);
}

Run run_of(PlannedRun const& planned, Backends const& backends) {
    return {planned.label, planned.slug, backends.device_of(planned.backend), {}, {}};
}

Picture picture_of(pipeline::Image const& image) { return {image.size_px, 3, image.rgb}; }

Outcome<core::Done> conclude(RunOptions const& options, Bytes const& results, std::string const& text) {
    bool const json_to_stdout = options.json && *options.json == "-";
    if (!json_to_stdout) {
        if (options.json)
            if (auto written = write_file(*options.json, results); !written) return written;
        return print(text);
    }
    if (auto printed = print(std::string(results.begin(), results.end())); !printed) return printed;
    std::fputs(text.c_str(), stderr);
    return core::Done{};
}

}  // namespace gnomon::command
