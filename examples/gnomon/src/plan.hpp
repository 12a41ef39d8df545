#pragma once
// Which runs a command line asks for: techniques times the lists of their parameters times backends.

#include "options.hpp"

#include <gnomon/pipeline/lighting.hpp>
#include <gnomon/pipeline/technique.hpp>

#include <string>
#include <vector>

namespace gnomon::command {

/// One of the two is set: the shadows of one light, or the light of many.
struct PlannedRun {
    pipeline::Technique const* technique = nullptr;
    pipeline::LightingTechnique const* lighting = nullptr;
    pipeline::Params params;
    std::string backend;  ///< "cpu" or "vulkan".
    std::string label;    ///< "shadow-map resolution=512"; with several backends "... on vulkan".
    std::string slug;     ///< "shadow-map-resolution-512".
};

/// Every combination of the listed values, in the order given, on each backend; the backends vary fastest, then the
/// last list.
///
/// returns: at least one run, no two alike, all of shadows or all of lighting; or what is unknown, out of range, given
///          twice or does not go together.
[[nodiscard]] Outcome<std::vector<PlannedRun>> plan_runs(RunOptions const& options);

/// Whether the runs shade under many lights.
[[nodiscard]] bool lights_many(std::vector<PlannedRun> const& plan) noexcept;

}  // namespace gnomon::command
