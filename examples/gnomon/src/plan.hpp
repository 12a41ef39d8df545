#pragma once
// Which runs a command line asks for: techniques times the lists of their parameters.

#include "options.hpp"

#include <gnomon/pipeline/technique.hpp>

#include <string>
#include <vector>

namespace gnomon::command {

struct PlannedRun {
    pipeline::Technique const* technique = nullptr;
    pipeline::Params params;
    std::string label;  ///< "shadow-map resolution=512".
    std::string slug;   ///< "shadow-map-resolution-512".
};

/// Every combination of the listed values, in the order given; the last list varies fastest.
///
/// returns: at least one run, no two alike; or what is unknown, out of range or given twice.
[[nodiscard]] Outcome<std::vector<PlannedRun>> plan_runs(std::vector<std::string> const& techniques,
                                                         std::vector<ParamOption> const& params);

}  // namespace gnomon::command
