#include "report.hpp"

#include <fmt/format.h>

#include <sys/utsname.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <string_view>
#include <thread>

namespace gnomon::command {

namespace {

std::string cpu_name() {
    std::ifstream info("/proc/cpuinfo");
    for (std::string line; std::getline(info, line);) {
        bool const named = line.starts_with("model name") || line.starts_with("Model");
        std::size_t const colon = line.find(": ");
        if (named && colon != std::string::npos) return line.substr(colon + 2);
    }
    return "unknown processor";
}

std::string simd_names() {
#if defined(__x86_64__) || defined(__i386__)
    std::string names = "sse2";
    if (__builtin_cpu_supports("sse4.1")) names += " sse4.1";
    if (__builtin_cpu_supports("avx2")) names += " avx2";
    if (__builtin_cpu_supports("avx512f")) names += " avx512f";
    return names;
#elif defined(__ARM_NEON)
    return "neon";
#else
    return "none";
#endif
}

std::string system_name() {
    utsname names{};
    if (uname(&names) != 0) return "unknown system";
    return fmt::format("{} {} {}", names.sysname, names.release, names.machine);
}

std::string compiler_name() {
#if defined(__clang__)
    return fmt::format("Clang {}.{}.{}", __clang_major__, __clang_minor__, __clang_patchlevel__);
#elif defined(__GNUC__)
    return fmt::format("GCC {}.{}.{}", __GNUC__, __GNUC_MINOR__, __GNUC_PATCHLEVEL__);
#else
    return "unknown compiler";
#endif
}

}  // namespace

Machine this_machine() {
    unsigned const cores = std::thread::hardware_concurrency();
    return {cpu_name(),       cores == 0 ? 1 : static_cast<int>(cores), simd_names(), system_name(), compiler_name(),
            GNOMON_BUILD_TYPE};
}

namespace {

double median(std::vector<double> values) {
    std::sort(values.begin(), values.end());
    std::size_t const middle = values.size() / 2;
    return values.size() % 2 == 1 ? values[middle] : 0.5 * (values[middle - 1] + values[middle]);
}

void add(pipeline::Measures& sum, pipeline::Measures const& frame) {
    auto const samples = static_cast<double>(frame.samples);
    auto const wrong = static_cast<double>(frame.wrong);
    sum.samples += frame.samples;
    sum.wrong += frame.wrong;
    sum.false_lit += frame.false_lit;
    sum.false_shadow += frame.false_shadow;
    sum.acne += frame.acne;
    sum.detachment += frame.detachment;
    sum.edge_px.mean += frame.wrong == 0 ? 0.0 : frame.edge_px.mean * wrong;
    sum.edge_px.p99 = std::max(sum.edge_px.p99, frame.edge_px.p99);
    sum.edge_px.max = std::max(sum.edge_px.max, frame.edge_px.max);
    sum.visibility_error_mean += frame.visibility_error_mean * samples;
    sum.visibility_error_p99 = std::max(sum.visibility_error_p99, frame.visibility_error_p99);
    sum.radiance_error += frame.radiance_error * frame.radiance_error * samples;
}

void add(std::vector<pipeline::Count>& sums, std::vector<pipeline::Count> const& counts) {
    for (pipeline::Count const& count : counts) {
        auto const same = [&](pipeline::Count const& sum) { return sum.name == count.name; };
        auto const found = std::find_if(sums.begin(), sums.end(), same);
        if (found == sums.end())
            sums.push_back(count);
        else
            found->value += count.value;
    }
}

}  // namespace

pipeline::RunReport total_of(std::vector<FrameRecord> const& frames, pipeline::RunReport const& first) {
    pipeline::RunReport total;
    total.technique = first.technique;
    total.backend = first.backend;
    total.params = first.params;
    total.bytes = first.bytes;
    total.map_texel_m = first.map_texel_m;
    total.measured = first.measured;
    std::vector<double> ms;
    for (FrameRecord const& frame : frames) {
        add(total.error, frame.error);
        add(total.counts, frame.counts);
        add(total.redraw_reasons, frame.redraw_reasons);
        ms.push_back(frame.ms);
    }
    total.ms = {median(ms), *std::min_element(ms.begin(), ms.end()), *std::max_element(ms.begin(), ms.end())};
    for (std::size_t s = 0; s < frames.front().stages.size(); ++s) {
        std::vector<double> times;
        for (FrameRecord const& frame : frames) times.push_back(frame.stages[s].ms);
        total.stages.push_back({frames.front().stages[s].name, median(times)});
    }
    auto const samples = static_cast<double>(std::max<std::uint64_t>(total.error.samples, 1));
    total.error.wrong_fraction = static_cast<double>(total.error.wrong) / samples;
    total.error.visibility_error_mean /= samples;
    total.error.radiance_error = std::sqrt(total.error.radiance_error / samples);
    total.error.edge_px.mean /= static_cast<double>(std::max<std::uint64_t>(total.error.wrong, 1));
    return total;
}

std::optional<std::uint64_t> count_of(std::vector<pipeline::Count> const& counts, std::string_view name) {
    for (pipeline::Count const& count : counts)
        if (count.name == name) return count.value;
    return std::nullopt;
}

std::optional<double> ray_ms(Report const& report) {
    if (report.many_lights) return std::nullopt;
    for (Run const& run : report.runs)
        if (run.result.technique == "ray") return run.result.ms.median;
    return report.truth_ms > 0.0 ? std::optional(report.truth_ms) : std::nullopt;
}

std::optional<double> speed_over_ray(Report const& report, Run const& run) {
    std::optional<double> ray = ray_ms(report);
    for (Run const& other : report.runs)
        if (other.result.technique == "ray" && other.result.backend == run.result.backend) ray = other.result.ms.median;
    if (!ray || !(run.result.ms.median > 0.0)) return std::nullopt;
    return *ray / run.result.ms.median;
}

std::optional<double> speed_over_stencil(Report const& report, Run const& run) {
    for (Run const& other : report.runs)
        if (other.result.technique == "deferred-stencil" && other.result.backend == run.result.backend && run.result.ms.median > 0.0)
            return other.result.ms.median / run.result.ms.median;
    return std::nullopt;
}

std::optional<double> computations_over_least(Report const& report, Run const& run) {
    auto const computations = count_of(run.result.counts, "lighting_computations");
    if (!computations || report.reaching == 0) return std::nullopt;
    return static_cast<double>(*computations) / static_cast<double>(report.reaching);
}

}  // namespace gnomon::command
