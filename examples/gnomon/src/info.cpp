// `info`: what this build is, where it runs, and what it can do.

#include "verbs.hpp"

#include "report.hpp"
#include "table.hpp"
#include "values.hpp"

#include <gnomon/math/vec.hpp>
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

std::string techniques_text() {
    std::string text;
    for (pipeline::Technique const& technique : pipeline::techniques()) {
        std::vector<std::vector<std::string>> rows;
        for (pipeline::ParamInfo const& param : technique.params)
            rows.push_back({fmt::format("  {}.{}={}", technique.name, param.name, param.default_text), range_of(param),
                            std::string(param.unit), std::string(param.doc)});
        text += fmt::format("\ntechnique {}: {}\n", technique.name, technique.summary);
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

}  // namespace

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
        "backends   cpu\n\n{}",
        GNOMON_VERSION, machine.cpu, machine.logical_cores, machine.simd, machine.system, machine.compiler,
        machine.build, packages_text(), techniques_text());
    return print(text);
}

Outcome<core::Done> print(std::string const& text) {
    bool const written = std::fwrite(text.data(), 1, text.size(), stdout) == text.size();
    if (written && std::fflush(stdout) == 0) return core::Done{};
    return failure("standard output: cannot be written; send it to a place that has room");
}

}  // namespace gnomon::command
