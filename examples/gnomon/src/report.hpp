#pragma once
// What one command found out: everything that the table, the page and results.json show.

#include <gnomon/pipeline/frame.hpp>
#include <gnomon/pipeline/image.hpp>
#include <gnomon/pipeline/report.hpp>

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace gnomon::command {

struct Machine {
    std::string cpu;
    int logical_cores = 1;
    std::string simd;      ///< What the processor has, of what the library could use.
    std::string system;    ///< "Linux 6.1.0 x86_64".
    std::string compiler;  ///< "GCC 12.2.0".
    std::string build;     ///< "Release".
};

[[nodiscard]] Machine this_machine();

/// One run on one frame of a path.
struct FrameRecord {
    std::uint32_t frame = 0;  ///< From 0.
    double time_s = 0.0;      ///< Of the animations.
    double ms = 0.0;          ///< Median of the repeats.
    std::vector<pipeline::StageTime> stages;
    pipeline::Measures error;
    std::vector<pipeline::Count> counts;
    std::vector<pipeline::Count> redraw_reasons;
};

/// One run with the names that people and files call it by.
struct Run {
    std::string label;  ///< "shadow-map resolution=512": the technique and what the user set.
    std::string slug;   ///< The same as a file name without extension; unique in its report.
    std::string device;  ///< What it ran on: the processor, or the Vulkan device.
    pipeline::RunReport result;       ///< Of a path: ms over its frames, errors and counts summed. See `total_of`.
    std::vector<FrameRecord> frames;  ///< Of a path; else empty.
};

/// One line of the page's facts.
struct Fact {
    std::string name;
    std::string value;
};

struct Report {
    bool many_lights = false;  ///< The runs shade under many lights; else each draws the shadows of one.
    std::string command;  ///< As typed, for whoever wants to repeat it.
    std::string scene;    ///< A built-in name with its options, or the file's name.
    std::string view;     ///< As options that give the same view again.
    std::string light;    ///< As options, or which of the file's lights, or how many.
    std::vector<Fact> facts;
    math::ivec2 size_px{0, 0};
    std::uint64_t triangles = 0;
    std::uint64_t samples = 0;  ///< Of all frames.
    std::uint64_t truly_lit = 0;
    std::uint64_t frames = 1;
    bool has_truth = true;
    int threads = 1;
    int repeats = 1;
    double truth_ms = 0.0;  ///< What tracing the truth took, for one frame: the same work as a `ray` run.
    Machine machine;
    std::vector<Run> runs;
    std::uint64_t reaching = 0;   ///< Pairs of a light and a sample that it reaches; of all frames.
    std::uint32_t heat_most = 0;  ///< Lights that are white in the heat maps.
    pipeline::Image exact;
};

/// A count of a run by name.
[[nodiscard]] std::optional<std::uint64_t> count_of(std::vector<pipeline::Count> const& counts, std::string_view name);

/// A path as one run: median, least and greatest time of its frames, sums of their errors and counts. Means weigh each
/// frame by its samples; a p99 or maximum is the greatest of any frame.
///
/// expects: all frames are of one run, `first` being the report of any of them; `frames` is not empty.
[[nodiscard]] pipeline::RunReport total_of(std::vector<FrameRecord> const& frames, pipeline::RunReport const& first);

/// Milliseconds of exact rays, the peer that every time is shown beside: the first `ray` run's, or else the truth's
/// own.
[[nodiscard]] std::optional<double> ray_ms(Report const& report);

/// How many times as fast as exact rays in the same command, on the same backend where they ran there; nothing where
/// either took no time.
[[nodiscard]] std::optional<double> speed_over_ray(Report const& report, Run const& run);

/// Of many lights: how many times as fast as `deferred-stencil` on the same backend in the same command.
[[nodiscard]] std::optional<double> speed_over_stencil(Report const& report, Run const& run);

/// Lighting computations of a run beside the fewest that do; nothing where no light reaches a sample.
[[nodiscard]] std::optional<double> computations_over_least(Report const& report, Run const& run);

}  // namespace gnomon::command
