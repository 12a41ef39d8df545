// `info`: what this build is, where it runs, and what it can do.

#include "verbs.hpp"

#include "devices.hpp"
#include "report.hpp"
#include "table.hpp"
#include "values.hpp"

#include <gnomon/math/vec.hpp>
#include <gnomon/pipeline/lighting.hpp>
#include <gnomon/pipeline/technique.hpp>

#include <fmt/format.h>
#include <tbb/version.h>
#include <CLI/Version.hpp>
#include <nlohmann/json.hpp>

#include <cstdio>

namespace gnomon::command {

namespace {

std::string range_of(pipeline::ParamInfo const& param) {
    if (!param.choices.empty()) return join(std::vector<std::string>(param.choices.begin(), param.choices.end()), "|");
    return fmt::format("{:g} to {:g}", param.min, param.max);
}

/// `kind` is what comes before the name.
template <class Techniques>
std::string techniques_text(std::string_view kind, Techniques const& techniques) {
    std::string text;
    for (auto const& technique : techniques) {
        std::vector<std::vector<std::string>> rows;
        for (pipeline::ParamInfo const& param : technique.params)
            rows.push_back({fmt::format("  {}.{}={}", technique.name, param.name, param.default_text), range_of(param),
                            std::string(param.unit), std::string(param.doc)});
        text += fmt::format("\n{} {}: {}\n", kind, technique.name, technique.summary);
        text += rows.empty() ? "  no parameters\n" : aligned(rows, {.left = 4});
    }
    return text;
}

std::string packages_text() {
    std::string const json =
        fmt::format("{}.{}.{}", NLOHMANN_JSON_VERSION_MAJOR, NLOHMANN_JSON_VERSION_MINOR, NLOHMANN_JSON_VERSION_PATCH);
    std::string const format = fmt::format("{}.{}.{}", FMT_VERSION / 10000, FMT_VERSION / 100 % 100, FMT_VERSION % 100);
    std::string const glm =
        fmt::format("{}.{}.{}.{}", GLM_VERSION_MAJOR, GLM_VERSION_MINOR, GLM_VERSION_PATCH, GLM_VERSION_REVISION);
    return fmt::format("GLM {}, oneTBB {}, CLI11 {}, fmt {}, nlohmann-json {}", glm, TBB_VERSION_STRING, CLI11_VERSION,
                       format, json);
}

/// "vulkan (2 devices; `gnomon info --devices` lists them)", or why not.
std::string vulkan_text() {
    auto const devices = vulkan_devices();
    if (!devices) return "no vulkan: " + devices.failure().message;
    return fmt::format("vulkan ({} device{}; `gnomon info --devices` says which)", devices->size(),
                       devices->size() == 1 ? "" : "s");
}

std::string device_text(std::size_t number, DeviceInfo const& device) {
    std::string text = fmt::format("{}  {}\n   {}, Vulkan {}, {:.1f} GiB", number, device.name, device.kind, device.api,
                                   static_cast<double>(device.memory_bytes) / 1073741824.0);
    if (!device.driver.empty()) text += ", driver " + device.driver;
    if (!device.cannot.empty()) return text + "\n   cannot be used: " + device.cannot + '\n';
    return text + "\n   " + (device.lacks.empty() ? "has every optional feature" : "does without: " + join(device.lacks)) +
           '\n';
}

}  // namespace

Outcome<core::Done> show_devices() {
    auto const devices = vulkan_devices();
    if (!devices) return devices.failure();
    std::string text;
    for (std::size_t i = 0; i < devices->size(); ++i) text += device_text(i + 1, (*devices)[i]);
    return print(text + "`--device` takes a number or a part of a name.\n");
}

Outcome<core::Done> show_info() {
    Machine const machine = this_machine();
    std::string const text = fmt::format(
        "gnomon {}\n\n"
        "machine    {}\n"
        "threads    {}\n"
        "SIMD       {}\n"
        "system     {}\n"
        "compiler   {}, {}\n"
        "packages   {}\n"
        "backends   cpu, {}\n\n{}",
        GNOMON_VERSION, machine.cpu, machine.logical_cores, machine.simd, machine.system, machine.compiler,
        machine.build, packages_text(), vulkan_text(), techniques_text("technique", pipeline::techniques()) +
                           techniques_text("lighting technique", pipeline::lighting_techniques()));
    return print(text);
}

Outcome<core::Done> print(std::string const& text) {
    bool const written = std::fwrite(text.data(), 1, text.size(), stdout) == text.size();
    if (written && std::fflush(stdout) == 0) return core::Done{};
    return failure("standard output: cannot be written; send it to a place that has room");
}

}  // namespace gnomon::command
