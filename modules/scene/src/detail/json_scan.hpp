#pragma once
// A look at glTF's JSON before the parser sees it: the parser recurses, takes -4 for a missing number and wraps large
// ones, and reads buffers and images without a limit. Here the text is bounded and strict, and those two are cut out.

#include <gnomon/scene/load.hpp>

#include <string>
#include <string_view>
#include <vector>

namespace gnomon::scene::detail {

/// The text without root `buffers`, `images` and `extras`, and the elements of the first two, still as text.
struct ScannedJson {
    std::string text;
    std::vector<std::string_view> buffers;
    std::vector<std::string_view> images;
};

/// Throws LoadFailure where brackets or strings do not close, nest deeper than the limit, or are too many, and where an
/// index, offset, count or stride is not a whole number from 0 to 2^31 - 1.
ScannedJson scan_json(std::string_view json, Limits const& limits);

}  // namespace gnomon::scene::detail
