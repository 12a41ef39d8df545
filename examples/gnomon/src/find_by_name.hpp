#pragma once
// Cameras, lights, clips: things with names that a file may leave out.

#include "outcome.hpp"
#include "values.hpp"

#include <gnomon/scene/scene.hpp>

#include <fmt/format.h>

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace gnomon::command {

/// What to call the thing at `index`: its name, or its number from 1 where the file gives none.
std::string name_of(auto const& things, std::size_t index) {
    return things[index].name.empty() ? std::to_string(index + 1) : std::string(things[index].name);
}

std::vector<std::string> names_of(auto const& things) {
    std::vector<std::string> names;
    for (std::size_t i = 0; i < things.size(); ++i) names.push_back(name_of(things, i));
    return names;
}

/// Where the thing of this name stands, or of this number counted from 1; a name goes first.
std::optional<std::size_t> find_by_name(auto const& things, std::string const& wanted) {
    for (std::size_t i = 0; i < things.size(); ++i)
        if (things[i].name == wanted) return i;
    auto const number = integer_from(wanted);
    bool const in_range = number && *number >= 1 && static_cast<std::uint64_t>(*number) <= things.size();
    return in_range ? std::optional(static_cast<std::size_t>(*number - 1)) : std::nullopt;
}

/// Nothing of this name: because the file's was left out, or because there never was one.
core::Failure<Exit> not_found(std::string const& option, std::string const& wanted, auto const& things,
                              scene::Notes const& notes) {
    for (std::string const& warning : notes.warnings)
        if (warning.find('\'' + wanted + '\'') != std::string::npos)
            return failure(fmt::format("{} {}: {}; mend the file or choose another", option, wanted,
                                       warning.substr(0, warning.find_last_not_of('.') + 1)));
    return usage_error(fmt::format("{} {}: the scene has none of this name; {}", option, wanted,
                                   suggestion(wanted, names_of(things))));
}

}  // namespace gnomon::command
