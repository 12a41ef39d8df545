#pragma once
// Techniques on frame after frame of a path, and one report over all of them. Pictures are the caller's.

#include "run_parts.hpp"

#include <gnomon/pipeline.hpp>

#include <memory>
#include <optional>
#include <vector>

namespace gnomon::command {

class Walk {
  public:
    /// expects: options, plan and executor outlive it.
    Walk(RunOptions const& options, std::vector<PlannedRun> const& plan, core::ExecutorRef executor)
        : options_(options), plan_(plan), executor_(executor) {}
    Walk(Walk const&) = delete;
    Walk& operator=(Walk const&) = delete;

    /// Opens backends, reads the scene, finds path and lights.
    [[nodiscard]] Outcome<core::Done> prepare();

    [[nodiscard]] int frames() const noexcept { return static_cast<int>(journey_.views.size()); }
    [[nodiscard]] double rate_hz() const noexcept { return journey_.rate_hz; }

    /// Runs all techniques on a frame of the path and notes their numbers; frames in ascending order, any of them.
    [[nodiscard]] Outcome<pipeline::Comparison> step(int frame, bool images);

    /// From here on the camera of the first frame serves every frame, while time passes.
    void stand();
    /// Forgets the numbers, so that the next step begins a report of its own under `light`.
    void restart(std::string light);

    /// Makes the report's totals.
    ///
    /// expects: at least one step.
    void finish();

    [[nodiscard]] Report const& report() const noexcept { return report_; }
    [[nodiscard]] pipeline::Frame const& last_frame() const noexcept { return *frame_; }
    /// Which lights shine; a caller may take some out before a step.
    [[nodiscard]] Lighting& lighting() noexcept { return light_; }

  private:
    void record(int frame, double time_s, pipeline::Comparison const& compared);

    RunOptions const& options_;
    std::vector<PlannedRun> const& plan_;
    core::ExecutorRef executor_;
    Backends backends_;
    Stage stage_;
    Journey journey_;
    Lighting light_;
    std::optional<pipeline::Frame> frame_;
    std::vector<std::unique_ptr<pipeline::Workspace>> workspaces_;
    std::optional<Requests> requests_;
    float exposure_ = 0.0F;
    double time_s_ = 0.0;  ///< Of the animations, where the stage is.
    double truth_build_ms_ = 0.0;
    std::vector<double> truth_ms_;
    Report report_;
};

}  // namespace gnomon::command
