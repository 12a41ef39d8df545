#pragma once
// What a command wrote, read back and held against the schema.

#include "process.hpp"
#include "schema.hpp"

#include <gnomon/check/check.hpp>

#include <string>
#include <vector>

namespace gnomon::command {

inline bool has(std::string const& text, std::string const& part) { return text.find(part) != std::string::npos; }

inline nlohmann::json results_in(fs::path const& folder) { return nlohmann::json::parse(read_text(folder / "results.json")); }

/// The first way in which it is not what the schema says; empty: it is.
inline std::string first_error(nlohmann::json const& results) {
    auto const errors = schema::Validator(nlohmann::json::parse(read_text(GNOMON_SCHEMA))).errors(results);
    return errors.empty() ? "" : errors.front();
}

struct Written {
    Ended ended;
    nlohmann::json results;
};

/// Runs the command with `--out NAME`, which must end well and leave results that the schema allows.
inline Written written_by(TestFolder const& folder, std::vector<std::string> words, std::string const& name = "out") {
    words.insert(words.end(), {"--out", name});
    Written written{gnomon_in(folder.path(), words), {}};
    CAPTURE(written.ended.err, written.ended.out);
    REQUIRE(written.ended.exit_code == 0);
    written.results = results_in(folder / name);
    CHECK(first_error(written.results) == "");
    return written;
}

}  // namespace gnomon::command
