#pragma once
// What `gnomon bench lights` measures: the comparisons of [Olsson 2014, Papers I and II].

#include "image_io.hpp"
#include "options.hpp"
#include "report.hpp"

#include <cstdint>
#include <string>
#include <vector>

namespace gnomon::command {

/// A path walked once.
struct PathResult {
    std::string name;  ///< "robots many".
    Report report;
};

/// One view under more and more lights.
struct ScalingResult {
    std::string name;
    std::vector<std::uint32_t> lights;  ///< Of each report, ascending.
    std::vector<Report> reports;        ///< Of one frame each.
};

/// A picture of the lights evaluated for each pixel.
struct HeatPicture {
    std::string name;
    math::ivec2 size_px{0, 0};
    Bytes png;
};

struct LightsBench {
    PathResult many;                      ///< Paper I: table 2, figures 2 and 3.
    PathResult few;                       ///< Paper I: table 3.
    ScalingResult growing;                ///< Paper I: figure 4.
    std::vector<PathResult> atrium;       ///< Paper II: figures 9 to 11, with and without trees.
    std::vector<ScalingResult> crossing;  ///< Paper II: figure 12, with and without trees.
    ScalingResult assignment;             ///< Paper II: table 2.
    std::vector<HeatPicture> heat;
    std::uint32_t heat_most = 0;

    /// For what is the same in all reports: the command, the machine, the size.
    [[nodiscard]] Report const& any() const noexcept { return many.report; }
};

/// The reports of a bench, in the order of the page.
[[nodiscard]] std::vector<Report const*> reports_of(LightsBench const& bench);

/// The whole page.
[[nodiscard]] std::string lights_bench_html(LightsBench const& bench);

/// The same as text, without plots.
[[nodiscard]] std::string lights_bench_text(LightsBench const& bench, bool styled);

}  // namespace gnomon::command
