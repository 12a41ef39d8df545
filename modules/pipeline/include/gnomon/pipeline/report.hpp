#pragma once
// Runs techniques on one frame and gathers what a report needs. JSON and files are written by whoever calls.

#include <gnomon/core/executor.hpp>
#include <gnomon/pipeline/error.hpp>
#include <gnomon/pipeline/frame.hpp>
#include <gnomon/pipeline/image.hpp>
#include <gnomon/pipeline/lighting.hpp>
#include <gnomon/pipeline/measures.hpp>
#include <gnomon/pipeline/shade.hpp>
#include <gnomon/pipeline/technique.hpp>

#include <span>
#include <string>
#include <vector>

namespace gnomon::pipeline {

/// Of the repeats' total times.
struct Milliseconds {
    double median = 0.0;
    double min = 0.0;
    double max = 0.0;
};

/// One run of `results.json`: the fields that the pipeline knows. [design section 10]
struct RunReport {
    std::string technique;
    std::string backend;  ///< Its name.
    std::vector<Params::Value> params;
    Milliseconds ms;
    std::vector<StageTime> stages;  ///< Median over the repeats, stage by stage.
    bool measured = true;           ///< Off: the frame has no truth, and of `error` only `samples` says anything.
    Measures error;
    std::vector<Count> counts;
    std::vector<Count> bytes;
    std::vector<Count> redraw_reasons;
    std::vector<double> map_texel_m;
    Image lit;      ///< The picture with this technique's shadows.
    Image overlay;  ///< Wrong samples in two colours, empty without truth; of a lighting technique its `heat_map`.
    std::vector<DebugPicture> pictures;  ///< If they were asked for; "tint" is the picture in the technique's colours.
};

struct RunRequest {
    Technique const* technique = nullptr;
    Params params;
    Workspace* workspace = nullptr;      ///< Kept by the caller from frame to frame; null: one for the call.
    backend::Backend* device = nullptr;  ///< What it runs on, which outlives the workspace; null: the CPU.
};

/// The same of a lighting technique.
struct LightingRequest {
    LightingTechnique const* technique = nullptr;
    Params params;
    Workspace* workspace = nullptr;
    backend::Backend* device = nullptr;
};

/// Called between runs, from the calling thread.
///
/// `done` of `total` steps are finished; `what` is about to run.
struct Progress {
    void (*report)(void* context, int done, int total, std::string_view what) = nullptr;
    void* context = nullptr;
};

struct CompareConfig {
    int repeats = 1;     ///< Timed runs of each request; at least 1.
    bool images = true;  ///< Fill `lit` and `overlay`.
    ShadeConfig shading;
    bool truth = true;           ///< Of lighting techniques: find their truth. A shadow's is the frame's own.
    std::uint32_t heat_most = 0; ///< Lights that are white in a heat map; 0: what suits the runs.
    bool debug = false;          ///< Fill `pictures`, in the last of the repeats.
    Progress progress;
};

struct Comparison {
    std::vector<RunReport> runs;  ///< In the order of the requests.
    Image exact;                  ///< The picture with the true shadows, if images are asked for and there is truth.
    float exposure = 1.0F;        ///< Of the pictures; give it to the next frame of a film.
    std::uint32_t heat_most = 0;  ///< Of the heat maps; likewise.
    std::uint64_t samples = 0;
    std::uint64_t truly_lit = 0;
    std::uint64_t reaching = 0;  ///< Pairs of a light and a sample that it reaches: the fewest computations that do.
};

/// Runs every request on `frame` and measures it against the truth.
///
/// returns: the first failure of a technique, or a report for each request.
[[nodiscard]] Result<Comparison> compare(Frame const& frame, std::span<RunRequest const> requests,
                                         CompareConfig const& config, core::ExecutorRef executor);

/// Runs every request on `frame` under `lights`, and measures its image against the truth: each light evaluated in
/// order, in 32 bits, for exactly the samples that it reaches (`deferred-stencil` on the CPU).
///
/// A sample is wrong if any bit of its radiance differs; of `Measures` only `samples`, `wrong`, `wrong_fraction` and
/// `radiance_error` say anything.
[[nodiscard]] Result<Comparison> compare(Frame const& frame, std::span<Light const> lights,
                                         std::span<LightingRequest const> requests, CompareConfig const& config,
                                         core::ExecutorRef executor);

}  // namespace gnomon::pipeline
