#pragma once
// What a run of one view and a run along a path have in common.

#include "backends.hpp"
#include "inputs.hpp"
#include "output.hpp"
#include "plan.hpp"
#include "report.hpp"

#include <gnomon/pipeline.hpp>

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace gnomon::command {

[[nodiscard]] std::string out_folder(RunOptions const& options);

/// Whether what --out and --json name could be written now.
[[nodiscard]] Outcome<core::Done> check_outputs(RunOptions const& options);

/// What went wrong in the pipeline, as an exit: values that the command line gave are a matter of usage.
[[nodiscard]] core::Failure<Exit> exit_for(core::Failure<pipeline::Error> const& why);

/// The report's frame: what was run on what. No runs yet.
[[nodiscard]] Report start_report(RunOptions const& options, Stage const& stage);

/// A run without results yet.
[[nodiscard]] Run run_of(PlannedRun const& planned, Backends const& backends);

/// What the runs' light comes from: one light whose shadows they draw, or many.
struct Lighting {
    std::optional<ChosenLight> one;
    ChosenLights many;  ///< Where there is not one.

    [[nodiscard]] std::string const& text() const noexcept { return one ? one->text : many.text; }
    /// What a frame is made with: a lighting technique does not look at it.
    [[nodiscard]] scene::Light for_frame() const;
    /// Where a frame's samples lie: for lighting where a fragment shader finds them too, so that images can be compared.
    [[nodiscard]] pipeline::SampleRule rule() const noexcept { return one ? pipeline::SampleRule::exact : pipeline::SampleRule::formula; }
    /// Moves what is the scene's to the stage's pose.
    void move_to(Stage const& stage);
};

/// Adds the facts that the page lists. `frame` is the one looked at, or the last of a path.
void add_facts(Report& report, Stage const& stage, Lighting const& light, pipeline::Frame const& frame);

[[nodiscard]] Outcome<Lighting> choose_lighting(RunOptions const& options, std::vector<PlannedRun> const& plan, Stage const& stage,
                                                math::View const& view);

/// The plan as the pipeline takes it, on opened backends.
class Requests {
  public:
    /// expects: `backends` outlives it. `workspaces`: one a run, kept from frame to frame; or none.
    Requests(std::vector<PlannedRun> const& plan, Backends const& backends,
             std::span<std::unique_ptr<pipeline::Workspace> const> workspaces = {});

    [[nodiscard]] Outcome<pipeline::Comparison> compare(pipeline::Frame const& frame, Lighting const& light,
                                                        pipeline::CompareConfig const& config, core::ExecutorRef executor) const;

  private:
    std::vector<pipeline::RunRequest> shadows_;
    std::vector<pipeline::LightingRequest> lighting_;
};

[[nodiscard]] Picture picture_of(pipeline::Image const& image);

/// Writes results.json where --json says and prints `text`, each where it belongs.
[[nodiscard]] Outcome<core::Done> conclude(RunOptions const& options, Bytes const& results, std::string const& text);

}  // namespace gnomon::command
