#include "values.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <numeric>

namespace gnomon::command {

namespace {

constexpr int largest_side_px = 16384;
constexpr std::int64_t most_pixels = std::int64_t{1} << 26;

/// The number of insertions, deletions and replacements that turn `a` into `b`.
std::size_t edit_distance(std::string_view a, std::string_view b) {
    std::vector<std::size_t> row(b.size() + 1);
    std::iota(row.begin(), row.end(), std::size_t{0});
    for (std::size_t i = 0; i < a.size(); ++i) {
        std::size_t diagonal = row[0];
        row[0] = i + 1;
        for (std::size_t j = 0; j < b.size(); ++j) {
            std::size_t const replaced = diagonal + (a[i] == b[j] ? 0 : 1);
            diagonal = row[j + 1];
            row[j + 1] = std::min({replaced, row[j] + 1, diagonal + 1});
        }
    }
    return row.back();
}

}  // namespace

std::vector<std::string> split(std::string_view text, char separator) {
    std::vector<std::string> parts(1);
    for (char const c : text) {
        if (c == separator)
            parts.emplace_back();
        else
            parts.back() += c;
    }
    return parts;
}

std::optional<double> real_from(std::string_view text) {
    double value = 0.0;
    auto const [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc{} || end != text.data() + text.size() || !std::isfinite(value)) return std::nullopt;
    return value;
}

std::optional<std::int64_t> integer_from(std::string_view text) {
    std::int64_t value = 0;
    auto const [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc{} || end != text.data() + text.size()) return std::nullopt;
    return value;
}

Outcome<double> read_real(std::string const& option, std::string const& text, RealRange const& range) {
    std::optional<double> const value = real_from(text);
    if (value && *value >= range.low && *value <= range.high) return *value;
    std::string const unit = *range.unit == '\0' ? "" : fmt::format(" ({})", range.unit);
    if (range.low <= std::numeric_limits<double>::lowest() && range.high >= std::numeric_limits<double>::max())
        return usage_error(fmt::format("{} {}: give a finite number{}", option, text, unit));
    return usage_error(
        fmt::format("{} {}: give a number from {:g} to {:g}{}", option, text, range.low, range.high, unit));
}

Outcome<std::int64_t> read_integer(std::string const& option, std::string const& text, IntegerRange range) {
    std::optional<std::int64_t> const value = integer_from(text);
    if (value && *value >= range.low && *value <= range.high) return *value;
    return usage_error(fmt::format("{} {}: give a whole number from {} to {}", option, text, range.low, range.high));
}

Outcome<math::dvec3> read_vector(std::string const& option, std::string const& text, double limit) {
    std::vector<std::string> const parts = split(text, ',');
    if (parts.size() != 3)
        return usage_error(fmt::format("{} {}: give three numbers with commas and no blanks, such as {} 1,2.5,-3",
                                       option, text, option));
    math::dvec3 v(0.0);
    for (int axis = 0; axis < 3; ++axis) {
        std::string const& part = parts[static_cast<std::size_t>(axis)];
        std::optional<double> const value = real_from(part);
        if (!value)
            return usage_error(fmt::format("{} {}: '{}' is not a finite number; give x,y,z", option, text, part));
        if (std::abs(*value) > limit)
            return usage_error(fmt::format("{} {}: '{}' is too far away; give numbers from {:g} to {:g}", option, text,
                                           part, -limit, limit));
        v[axis] = *value;
    }
    return v;
}

Outcome<math::ivec2> read_size(std::string const& option, std::string const& text) {
    std::vector<std::string> const parts = split(text, 'x');
    auto const width = parts.size() == 2 ? integer_from(parts[0]) : std::nullopt;
    auto const height = parts.size() == 2 ? integer_from(parts[1]) : std::nullopt;
    if (!width || !height)
        return usage_error(
            fmt::format("{} {}: give width x height in pixels, such as {} 1024x768", option, text, option));
    bool const in_range = *width >= 1 && *height >= 1 && *width <= largest_side_px && *height <= largest_side_px;
    if (!in_range || *width * *height > most_pixels)
        return usage_error(
            fmt::format("{} {}: each side must be from 1 to {} pixels, and the image at most {} million pixels", option,
                        text, largest_side_px, most_pixels / 1'000'000));
    return math::ivec2(static_cast<int>(*width), static_cast<int>(*height));
}

std::optional<std::string> closest(std::string const& name, std::vector<std::string> const& known) {
    std::optional<std::string> best;
    std::size_t best_distance = std::max<std::size_t>(1, name.size() / 3) + 1;
    for (std::string const& candidate : known) {
        std::size_t const distance = edit_distance(name, candidate);
        if (distance < best_distance) {
            best_distance = distance;
            best = candidate;
        }
    }
    return best;
}

std::string join(std::vector<std::string> const& parts, std::string_view between) {
    if (parts.empty()) return "none";
    return fmt::format("{}", fmt::join(parts, between));
}

std::string suggestion(std::string const& name, std::vector<std::string> const& known) {
    std::optional<std::string> const near = closest(name, known);
    std::string const meant = near ? fmt::format("did you mean '{}'? ", *near) : std::string{};
    return fmt::format("{}there is {}", meant, join(known));
}

}  // namespace gnomon::command
