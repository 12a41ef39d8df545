#pragma once
// HTML that the pages share.

#include "image_io.hpp"
#include "report.hpp"

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace gnomon::command {

/// From the doctype to the title on the page.
[[nodiscard]] std::string page_head(std::string const& title);

/// The command to repeat, and the end of the page.
[[nodiscard]] std::string page_foot(Report const& report);

/// A picture or film carried in the page itself.
[[nodiscard]] std::string picture_html(Bytes const& file, math::ivec2 size_px, std::string const& alt);

[[nodiscard]] std::string facts_html(Report const& report);

/// A run's times, errors, counts and settings, folded away.
[[nodiscard]] std::string details_html(Run const& run);

/// What the numbers say, in words: the least wrong of the inexact runs, beside ray.
[[nodiscard]] std::string verdict_html(Report const& report);

/// The first row is the head.
[[nodiscard]] std::string rows_html(std::vector<std::vector<std::string>> const& rows);

/// One row a run.
[[nodiscard]] std::string table_html(Report const& report);

/// A picture or film of how a run got there.
struct DebugFile {
    std::string name;  ///< Of the picture: "maps".
    std::string caption;
    Bytes file;
};

/// Pictures or films of one run, made once for the folder and the page.
struct RunPictures {
    Bytes lit;
    Bytes overlay;
    Bytes marks;  ///< The overlay for the page, where pictures are small: wrong pixels drawn larger.
    std::vector<DebugFile> debug;
};

/// A run with its pictures; `index` keeps the cards of a page apart.
[[nodiscard]] std::string card_html(Report const& report, Run const& run, RunPictures const& pictures,
                                    std::size_t index);

/// All runs' pictures of how they got there, with their captions; nothing where there are none.
[[nodiscard]] std::string debug_html(Report const& report, std::vector<RunPictures> const& pictures);

inline constexpr std::string_view explanation =
    "<p>Every pixel that shows a surface is one sample. For each, exact arithmetic decides whether anything stands "
    "between it and the light: that is the truth. A run is wrong where its answer differs.</p>\n";

inline constexpr std::string_view legend =
    "<ul class='legend'><li><span class='swatch lit'></span><b>false-lit</b>: shown lit, truly in shadow (a leak)</li>"
    "<li><span class='swatch shadow'></span><b>false-shadow</b>: shown in shadow, truly lit (acne, a blocky "
    "edge)</li></ul>\n";

/// The switch between a picture and its wrong pixels, or its lighting computations.
[[nodiscard]] std::string choice_html(Report const& report, std::string const& group, std::string const& extra_lit,
                                      std::string const& extra_wrong);

}  // namespace gnomon::command
