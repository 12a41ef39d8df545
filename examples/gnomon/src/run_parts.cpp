#include "run_parts.hpp"

#include "table.hpp"
#include "verbs.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>

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

std::string lit_share(Report const& report) {
    if (!report.has_truth || report.samples == 0) return {};
    double const lit = static_cast<double>(report.truly_lit) / static_cast<double>(report.samples);
    return fmt::format("; {:.1f} % of them are truly lit", lit * 100.0);
}

}  // namespace

std::string out_folder(RunOptions const& options) {
    if (options.out) return *options.out;
    switch (options.verb) {
        case Verb::render: return "gnomon-render";
        case Verb::compare: return "gnomon-compare";
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

Report start_report(RunOptions const& options, Stage const& stage, ChosenLight const& light) {
    Report report;
    report.command = options.command;
    report.scene = stage.loaded.text;
    report.light = light.text;
    report.size_px = options.view.size_px;
    report.triangles = stage.geometry.indices.size() / 3;
    report.threads = options.threads;
    report.repeats = options.repeats;
    report.has_truth = options.truth;
    report.machine = this_machine();
    return report;
}

void add_facts(Report& report, Stage const& stage, ChosenLight const& light, pipeline::Frame const& frame) {
    scene::Scene const& scene = stage.loaded.scene;
    std::uint64_t const pixels = pipeline::pixel_count(report.size_px) * report.frames;
    report.facts = {
        {"scene", report.scene},
        {"triangles",
         fmt::format("{} drawn, {} stored", grouped(report.triangles), grouped(scene::count_unique_triangles(scene)))},
        {"view", report.view},
        {"light",
         fmt::format("{} ({}{})", report.light, pipeline::name_of(light.value.kind),
                     light.of_scene != scene::none ? fmt::format(", the scene has {}", scene.lights.size()) : "")},
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

std::vector<pipeline::RunRequest> requests_of(std::vector<PlannedRun> const& plan, Backends const& backends) {
    std::vector<pipeline::RunRequest> requests;
    for (PlannedRun const& planned : plan) {
        pipeline::RunRequest request{planned.technique, planned.params};
        request.device = &backends.get(planned.backend);
        requests.push_back(std::move(request));
    }
    return requests;
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
