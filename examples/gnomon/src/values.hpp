#pragma once
// Values on the command line, read strictly: the whole text must be the value, and numbers must be finite.

#include "outcome.hpp"

#include <gnomon/math/vec.hpp>

#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace gnomon::command {

/// The parts of `text` between separators; an empty text has one empty part.
[[nodiscard]] std::vector<std::string> split(std::string_view text, char separator);

/// A number written in full, such as "-0.45" or "1e7"; no blanks, no trailing characters, never NaN or infinite.
[[nodiscard]] std::optional<double> real_from(std::string_view text);
[[nodiscard]] std::optional<std::int64_t> integer_from(std::string_view text);

// Each reads the value given to `option` and, where it cannot, says so in a sentence that names both.
struct RealRange {
    double low;
    double high;
    char const* unit;  ///< For the sentence: "degrees", "m".
};
[[nodiscard]] Outcome<double> read_real(std::string const& option, std::string const& text, RealRange const& range);

struct IntegerRange {
    std::int64_t low;
    std::int64_t high;
};
[[nodiscard]] Outcome<std::int64_t> read_integer(std::string const& option, std::string const& text,
                                                 IntegerRange range);

/// "x,y,z", all finite; `limit` bounds each of them.
[[nodiscard]] Outcome<math::dvec3> read_vector(std::string const& option, std::string const& text,
                                               double limit = std::numeric_limits<double>::max());

/// How far from the origin, in metres, something may stand.
inline constexpr double farthest_m = 1e9;

/// "WxH": each from 1 to 16384 pixels, and at most 2^26 pixels together.
[[nodiscard]] Outcome<math::ivec2> read_size(std::string const& option, std::string const& text);

/// The name in `known` that differs least from `name`, if one is close enough to be what was meant.
[[nodiscard]] std::optional<std::string> closest(std::string const& name, std::vector<std::string> const& known);

/// "a, b, c"; "none" where there are none.
[[nodiscard]] std::string join(std::vector<std::string> const& parts, std::string_view between = ", ");

/// " Did you mean 'x'?" or nothing, then the list of what there is.
[[nodiscard]] std::string suggestion(std::string const& name, std::vector<std::string> const& known);

}  // namespace gnomon::command
