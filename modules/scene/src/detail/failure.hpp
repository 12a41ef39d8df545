#pragma once
// How the loader and the writer give up: an exception that never leaves the module, turned into a Result at its border.

#include <gnomon/scene/scene.hpp>

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <utility>

namespace gnomon::scene::detail {

struct LoadFailure {
    core::Failure<SceneError> failure;
};

[[noreturn]] inline void fail(SceneError code, std::string message) {
    throw LoadFailure{core::Failure<SceneError>{code, std::move(message)}};
}

/// Text out of a file, fit for a message: short and without control characters.
inline std::string quoted(std::string_view text) {
    std::string out = "'";
    for (char c : text.substr(0, 80)) out += static_cast<unsigned char>(c) < 0x20 || c == 0x7F ? '?' : c;
    return out + (text.size() > 80 ? "...'" : "'");
}

/// "accessor 3"
inline std::string item(char const* what, std::uint64_t index) { return std::string(what) + " " + std::to_string(index); }

}  // namespace gnomon::scene::detail
