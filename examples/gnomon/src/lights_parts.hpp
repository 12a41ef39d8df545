#pragma once
// What pages and tables say of runs under many lights, in place of what they say of shadows.

#include "report.hpp"

#include <string>
#include <vector>

namespace gnomon::command {

/// The head, then a row a run.
[[nodiscard]] std::vector<std::vector<std::string>> lights_rows(Report const& report);

/// What the numbers say, in words: who needs the fewest computations, and whether all images are the truth.
[[nodiscard]] std::string lights_verdict_html(Report const& report);

[[nodiscard]] std::string lights_table_html(Report const& report);

/// What the table's columns mean.
[[nodiscard]] std::string lights_explanation();

/// Time against lighting computations.
[[nodiscard]] std::string lights_plot_html(Report const& report);

/// The colours of the heat maps.
[[nodiscard]] std::string heat_legend_html(Report const& report);

/// A run's numbers in one sentence.
[[nodiscard]] std::string lights_figures_html(Report const& report, Run const& run);

}  // namespace gnomon::command
