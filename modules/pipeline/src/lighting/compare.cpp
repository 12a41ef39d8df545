// Runs lighting techniques on a frame and turns them into reports.

#include <gnomon/pipeline/report.hpp>

#include "../detail.hpp"
#include "../repeats.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <span>
#include <utility>
#include <vector>

namespace gnomon::pipeline {

namespace {

/// A run's report and what its pictures are made of.
struct LightingResult {
    RunReport report;
    std::vector<math::vec3> radiance;
    std::vector<std::uint32_t> computations;
};

Result<LightingResult> run_lighting(Frame const& frame, std::span<Light const> lights, LightingRequest const& request, int repeats,
                                    core::ExecutorRef executor) {
    LightingResult result;
    RunReport& report = result.report;
    report.technique = std::string(request.technique->name);
    report.params = request.params.values;
    report.error.samples = frame.samples.size();
    Workspace own;
    Workspace& workspace = request.workspace != nullptr ? *request.workspace : own;
    backend::Backend& device = request.device != nullptr ? *request.device : workspace.own_backend(executor);
    report.backend = std::string(device.name());
    std::vector<std::vector<StageTime>> times;
    for (int i = 0; i < std::max(repeats, 1); ++i) {
        auto output = request.technique->run({frame, lights, request.params, workspace, device, executor});
        if (!output) return std::move(output).failure();
        times.push_back(output->stages);
        report.counts = std::move(output->counts);
        report.bytes = std::move(output->bytes);
        result.radiance = std::move(output->radiance);
        result.computations = std::move(output->computations);
    }
    summarize_repeats(times, report);
    return result;
}

/// returns: the image of every light on exactly the samples that it reaches, in order, and how many these are.
Result<LightingResult> true_lighting(Frame const& frame, std::span<Light const> lights, core::ExecutorRef executor) {
    auto const technique = find_lighting_technique("deferred-stencil");
    if (!technique) return technique.failure();
    auto params = make_params(**technique);
    if (!params) return std::move(params).failure();
    return run_lighting(frame, lights, {*technique, *std::move(params), nullptr, nullptr}, 1, executor);
}

double squared(math::vec3 const& v) noexcept {
    return static_cast<double>(v.x) * static_cast<double>(v.x) + static_cast<double>(v.y) * static_cast<double>(v.y) +
           static_cast<double>(v.z) * static_cast<double>(v.z);
}

/// Fills what of `Measures` says something.
void measure_radiance(std::span<math::vec3 const> radiance, std::span<math::vec3 const> truth, Measures& error) {
    double differences = 0.0;
    double all = 0.0;
    error.wrong = 0;
    for (std::size_t i = 0; i < truth.size(); ++i) {
        error.wrong += radiance[i] != truth[i] ? 1U : 0U;
        differences += squared(radiance[i] - truth[i]);
        all += squared(truth[i]);
    }
    error.wrong_fraction = truth.empty() ? 0.0 : static_cast<double>(error.wrong) / static_cast<double>(truth.size());
    error.radiance_error = all > 0.0 ? std::sqrt(differences / all) : (differences > 0.0 ? std::numeric_limits<double>::infinity() : 0.0);
}

/// What all but one sample in a hundred need at most, of the run that needs most; at least 1.
std::uint32_t pick_heat(std::span<LightingResult const> results) {
    std::uint32_t most = 1;
    for (LightingResult const& result : results) {
        if (result.computations.empty()) continue;
        std::vector<std::uint32_t> sorted = result.computations;
        auto const at = sorted.begin() + static_cast<std::ptrdiff_t>((sorted.size() - 1) * 99 / 100);
        std::nth_element(sorted.begin(), at, sorted.end());
        most = std::max(most, *at);
    }
    return most;
}

void add_pictures(Frame const& frame, CompareConfig const& config, std::span<math::vec3 const> truth,
                  std::span<LightingResult> results, Comparison& comparison) {
    if (comparison.exposure == 0.0F && !results.empty()) comparison.exposure = pick_exposure(results.front().radiance);
    if (comparison.heat_most == 0) comparison.heat_most = pick_heat(results);
    if (!config.images) return;
    if (config.truth) comparison.exact = lit_picture(frame, truth, comparison.exposure);
    for (LightingResult& result : results) {
        result.report.lit = lit_picture(frame, result.radiance, comparison.exposure);
        result.report.overlay = heat_map(frame, result.computations, comparison.heat_most);
    }
}

}  // namespace

Result<Comparison> compare(Frame const& frame, std::span<Light const> lights, std::span<LightingRequest const> requests,
                           CompareConfig const& config, core::ExecutorRef executor) {
    int const total = static_cast<int>(requests.size()) + 1;
    auto const progress = [&](int done, std::string_view what) {
        if (config.progress.report != nullptr) config.progress.report(config.progress.context, done, total, what);
    };
    Comparison comparison;
    comparison.samples = frame.samples.size();
    comparison.exposure = config.shading.exposure;
    comparison.heat_most = config.heat_most;
    progress(0, "evaluating each light where it reaches");
    std::vector<math::vec3> truth;
    if (config.truth) {
        auto found = true_lighting(frame, lights, executor);
        if (!found) return std::move(found).failure();
        truth = std::move(found->radiance);
        for (std::uint32_t const n : found->computations) comparison.reaching += n;
    }
    std::vector<LightingResult> results;
    for (std::size_t i = 0; i < requests.size(); ++i) {
        GNOMON_EXPECT(requests[i].technique != nullptr);
        progress(static_cast<int>(i) + 1, requests[i].technique->name);
        auto result = run_lighting(frame, lights, requests[i], config.repeats, executor);
        if (!result) return std::move(result).failure();
        result->report.measured = config.truth;
        if (config.truth) measure_radiance(result->radiance, truth, result->report.error);
        results.push_back(*std::move(result));
    }
    add_pictures(frame, config, truth, results, comparison);
    for (LightingResult& result : results) comparison.runs.push_back(std::move(result.report));
    progress(total, "done");
    return comparison;
}

}  // namespace gnomon::pipeline
