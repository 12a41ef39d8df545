#pragma once
// Times of repeated runs as one report.

#include <gnomon/pipeline/report.hpp>

#include <algorithm>
#include <vector>

namespace gnomon::pipeline {

[[nodiscard]] inline double median(std::vector<double> values) {
    std::sort(values.begin(), values.end());
    std::size_t const n = values.size();
    return n % 2 == 1 ? values[n / 2] : 0.5 * (values[n / 2 - 1] + values[n / 2]);
}

/// Sums and medians of the repeats' stages; every repeat has the same stages.
inline void summarize_repeats(std::vector<std::vector<StageTime>> const& repeats, RunReport& report) {
    std::vector<double> totals;
    for (auto const& stages : repeats) {
        double total = 0.0;
        for (StageTime const& stage : stages) total += stage.ms;
        totals.push_back(total);
    }
    report.ms = {median(totals), *std::min_element(totals.begin(), totals.end()),
                 *std::max_element(totals.begin(), totals.end())};
    for (std::size_t s = 0; s < repeats.front().size(); ++s) {
        std::vector<double> times;
        for (auto const& stages : repeats) times.push_back(stages[s].ms);
        report.stages.push_back({repeats.front()[s].name, median(times)});
    }
}

}  // namespace gnomon::pipeline
