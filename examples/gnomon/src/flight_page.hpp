#pragma once
// The page and the table of a path: films, and every frame's numbers.

#include "page_parts.hpp"

#include <string>
#include <vector>

namespace gnomon::command {

/// Films of a flight as files, ready to be carried in a page. Without truth there is only `RunPictures::lit`.
struct FlightFilms {
    Bytes exact;
    std::vector<RunPictures> runs;  ///< One for each run of the report; `marks` are the wrong pixels, as in the files.
    bool has_runs = false;          ///< Else of `runs` only `debug` is there.
};

/// The whole page: style, films as data URIs, plots over the frames, a table of them; nothing is loaded from elsewhere.
///
/// expects: `films.runs` is empty or has one entry a run.
[[nodiscard]] std::string flight_page_html(Report const& report, FlightFilms const& films);

/// Every frame of every run as comma-separated values under a line of names; counts are in columns of their own.
[[nodiscard]] std::string frames_csv(Report const& report);

}  // namespace gnomon::command
