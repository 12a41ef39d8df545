#pragma once
// What `gnomon bench cascades` measures: how little cascades have to draw that are kept and scrolled. [CSM Scrolling, 6]

#include "options.hpp"
#include "report.hpp"

#include <cstdint>
#include <string>
#include <vector>

namespace gnomon::command {

/// One motion: the same frames for every run.
struct MotionResult {
    std::string name;  ///< "street, 10 % of the props move".
    Report report;
};

struct CascadesBench {
    std::vector<MotionResult> motions;
    std::vector<MotionResult> guards;  ///< `csm-scroll` with wider and wider guard bands, on one path.

    /// For what is the same in all reports: the command, the machine, the size.
    [[nodiscard]] Report const& any() const noexcept { return (motions.empty() ? guards : motions).front().report; }
};

/// What a run drew beside `csm`, without its first frame, which has nothing to keep.
struct CascadeShare {
    double triangles = 0.0;          ///< A frame's.
    double batches = 0.0;
    double texels_rewritten = 0.0;
    double of_sums = 0.0;            ///< Triangles over csm's.
    double of_maps = 0.0;            ///< The mean over the maps of each map's own ratio, over the frames.
    double pass_ms = 0.0;            ///< Of the shadow maps, lookups apart.
    double pass_share = 0.0;         ///< That over csm's.
};

/// expects: `base` walked the same frames as `run`, two at least.
[[nodiscard]] CascadeShare share_of(Run const& run, Run const& base);

/// The whole page.
[[nodiscard]] std::string cascades_bench_html(CascadesBench const& bench);

/// The same as text, without plots.
[[nodiscard]] std::string cascades_bench_text(CascadesBench const& bench, bool styled);

}  // namespace gnomon::command
