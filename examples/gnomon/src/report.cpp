#include "report.hpp"

#include <fmt/format.h>

#include <sys/utsname.h>

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

std::optional<double> ray_ms(Report const& report) {
    for (Run const& run : report.runs)
        if (run.result.technique == "ray") return run.result.ms.median;
    return report.truth_ms > 0.0 ? std::optional(report.truth_ms) : std::nullopt;
}

std::optional<double> speed_over_ray(Report const& report, Run const& run) {
    std::optional<double> const ray = ray_ms(report);
    if (!ray || !(run.result.ms.median > 0.0)) return std::nullopt;
    return *ray / run.result.ms.median;
}

}  // namespace gnomon::command
