#pragma once
// results.json. Its shape is results.schema.json beside this folder; a test holds the two together.

#include "report.hpp"

#include <string>
#include <vector>

namespace gnomon::command {

/// The document, two blanks an indent, a newline at the end. `files` are those written beside it.
///
/// A number that is infinite or not a number is written as null.
[[nodiscard]] std::string json_text(Report const& report, std::vector<std::string> const& files);
/// The same of the runs of several reports, by one command on one machine.
///
/// expects: at least one.
[[nodiscard]] std::string json_text(std::vector<Report const*> const& reports, std::vector<std::string> const& files);

/// The files that a results.json says were written with it; empty where `text` is not one of ours.
[[nodiscard]] std::vector<std::string> files_listed_in(std::string const& text);

}  // namespace gnomon::command
