#pragma once
// Which runs a command line asks for: techniques times the lists of their parameters times backends.

#include "options.hpp"

#include <gnomon/pipeline/technique.hpp>

#include <string>
#include <vector>

namespace gnomon::command {

struct PlannedRun {
    pipeline::Technique const* technique = nullptr;
    pipeline::Params params;
    std::string backend;  ///< "cpu" or "vulkan".
    std::string label;    ///< "shadow-map resolution=512"; with several backends "... on vulkan".
    std::string slug;     ///< "shadow-map-resolution-512".
};

/// Every combination of the listed values, in the order given, on each backend; the backends vary fastest, then the
/// last list.
///
/// returns: at least one run, no two alike; or what is unknown, out of range or given twice.
[[nodiscard]] Outcome<std::vector<PlannedRun>> plan_runs(RunOptions const& options);

}  // namespace gnomon::command
