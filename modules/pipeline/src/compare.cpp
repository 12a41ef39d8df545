// Runs requests on a frame and turns them into reports.

#include "detail.hpp"
#include "repeats.hpp"

#include <gnomon/pipeline/report.hpp>

#include <algorithm>
#include <utility>

namespace gnomon::pipeline {

namespace {

Result<RunReport> run_one(Frame const& frame, RunRequest const& request, CompareConfig const& config,
                          Shading const& shading, core::ExecutorRef executor) {
    RunReport report;
    report.technique = std::string(request.technique->name);
    report.params = request.params.values;
    Workspace own;
    Workspace& workspace = request.workspace != nullptr ? *request.workspace : own;
    backend::Backend& device = request.device != nullptr ? *request.device : workspace.own_backend(executor);
    report.backend = std::string(device.name());
    TechniqueRun on{frame, request.params, workspace, device, executor};
    std::vector<std::vector<StageTime>> repeats;
    TechniqueOutput output;
    int const runs = request.technique->keeps_maps ? 1 : std::max(config.repeats, 1);
    for (int i = 0; i < runs; ++i) {
        on.debug = config.debug && i + 1 == runs;
        auto result = request.technique->run(on);
        if (!result) return std::move(result).failure();
        output = std::move(result).value();
        repeats.push_back(output.stages);
    }
    summarize_repeats(repeats, report);
    report.counts = output.counts;
    report.bytes = output.bytes;
    report.redraw_reasons = output.redraw_reasons;
    report.map_texel_m = output.map_texel_m;
    if (config.images) report.lit = picture(frame, shading, output.visibility);
    report.pictures = std::move(output.pictures);
    if (!output.tint.empty())
        report.pictures.push_back({"tint", "Each surface in the colour of the map that it looks into.",
                                   tinted_picture(frame, shading, output.visibility, output.tint)});
    report.measured = has_truth(frame);
    report.error.samples = frame.samples.size();
    if (!report.measured) return report;
    if (request.technique->examine != nullptr)
        if (auto ok = request.technique->examine(on, output); !ok) return std::move(ok).failure();
    report.error = measure(frame, output, executor);
    report.error.radiance_error = radiance_error(frame, shading, output.visibility);
    if (config.images) report.overlay = error_overlay(frame, shading, output.visibility);
    return report;
}

}  // namespace

Result<Comparison> compare(Frame const& frame, std::span<RunRequest const> requests, CompareConfig const& config,
                           core::ExecutorRef executor) {
    int const total = static_cast<int>(requests.size()) + 1;
    auto const progress = [&](int done, std::string_view what) {
        if (config.progress.report != nullptr) config.progress.report(config.progress.context, done, total, what);
    };
    Comparison comparison;
    comparison.samples = frame.samples.size();
    for (std::uint8_t const lit : frame.lit) comparison.truly_lit += lit;
    progress(0, "shading");
    Shading const shading = shade(frame, config.shading, executor);
    comparison.exposure = shading.exposure;
    if (config.images && has_truth(frame)) comparison.exact = picture(frame, shading, exact_visibility(frame));
    for (std::size_t i = 0; i < requests.size(); ++i) {
        GNOMON_EXPECT(requests[i].technique != nullptr);
        progress(static_cast<int>(i) + 1, requests[i].technique->name);
        auto report = run_one(frame, requests[i], config, shading, executor);
        if (!report) return std::move(report).failure();
        comparison.runs.push_back(std::move(report).value());
    }
    progress(total, "done");
    return comparison;
}

}  // namespace gnomon::pipeline
