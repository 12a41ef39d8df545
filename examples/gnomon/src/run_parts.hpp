#pragma once
// What a run of one view and a run along a path have in common.

#include "backends.hpp"
#include "inputs.hpp"
#include "output.hpp"
#include "plan.hpp"
#include "report.hpp"

#include <gnomon/pipeline.hpp>

#include <string>
#include <vector>

namespace gnomon::command {

[[nodiscard]] std::string out_folder(RunOptions const& options);

/// Whether what --out and --json name could be written now.
[[nodiscard]] Outcome<core::Done> check_outputs(RunOptions const& options);

/// What went wrong in the pipeline, as an exit: values that the command line gave are a matter of usage.
[[nodiscard]] core::Failure<Exit> exit_for(core::Failure<pipeline::Error> const& why);

/// The report's frame: what was run on what. No runs yet.
[[nodiscard]] Report start_report(RunOptions const& options, Stage const& stage, ChosenLight const& light);

/// A run without results yet.
[[nodiscard]] Run run_of(PlannedRun const& planned, Backends const& backends);

/// Adds the facts that the page lists. `frame` is the one looked at, or the last of a path.
void add_facts(Report& report, Stage const& stage, ChosenLight const& light, pipeline::Frame const& frame);

[[nodiscard]] std::vector<pipeline::RunRequest> requests_of(std::vector<PlannedRun> const& plan,
                                                            Backends const& backends);

[[nodiscard]] Picture picture_of(pipeline::Image const& image);

/// Writes results.json where --json says and prints `text`, each where it belongs.
[[nodiscard]] Outcome<core::Done> conclude(RunOptions const& options, Bytes const& results, std::string const& text);

}  // namespace gnomon::command
