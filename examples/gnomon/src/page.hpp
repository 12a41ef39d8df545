#pragma once
// index.html: one file with everything in it, for someone who has never heard of the project.

#include "page_parts.hpp"

#include <string>
#include <vector>

namespace gnomon::command {

struct ReportPictures {
    Bytes exact;
    std::vector<RunPictures> runs;  ///< One for each run of the report.
};

/// The whole page: style, pictures as data URIs, plot, table; nothing is loaded from elsewhere.
///
/// expects: `pictures.runs` has one entry a run.
[[nodiscard]] std::string page_html(Report const& report, ReportPictures const& pictures);

}  // namespace gnomon::command
