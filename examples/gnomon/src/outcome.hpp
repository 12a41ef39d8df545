#pragma once
// How the command ends: a value, or an exit code with one sentence for the person at the terminal.

#include <gnomon/core/result.hpp>

#include <string>
#include <utility>

namespace gnomon::command {

enum class Exit {
    done = 0,
    failed = 1,  ///< The input was understood, but a file, scene or device did not allow it.
    usage = 2,   ///< The command line asks for something that does not exist.
};

template <class T>
using Outcome = core::Result<T, Exit>;

[[nodiscard]] inline core::Failure<Exit> usage_error(std::string sentence) {
    return {Exit::usage, std::move(sentence)};
}
[[nodiscard]] inline core::Failure<Exit> failure(std::string sentence) { return {Exit::failed, std::move(sentence)}; }

}  // namespace gnomon::command
