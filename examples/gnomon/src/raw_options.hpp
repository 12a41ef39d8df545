#pragma once
// The command line as texts, straight from CLI11; options.cpp turns them into checked values.

#include "outcome.hpp"

#include <optional>
#include <string>
#include <vector>

namespace gnomon::command {

struct RawOptions {
    std::string scene;
    std::string bench;  ///< Which benchmark.
    std::optional<std::string> triangles, blocks, offset, seed, lights, moving;
    std::optional<std::string> eye, look, fov, camera, near, far;
    std::optional<std::string> path, frames, time, clip, file_scene;
    bool no_truth = false, trees = false, debug = false;
    std::optional<std::string> sun, point, light;
    std::vector<std::string> techniques, params, motions;
    std::optional<std::string> size, device, threads, repeats, json, out, write, most_lights;
    std::vector<std::string> backends;
    bool devices = false;
};

enum class RawVerb {
    help,  ///< `text` is what was asked for.
    render,
    compare,
    flythrough,
    bench,
    scenes,
    info,
};

struct RawCommand {
    RawVerb verb = RawVerb::help;
    RawOptions options;
    std::string text;
};

[[nodiscard]] Outcome<RawCommand> parse_raw(int argc, char const* const* argv);

}  // namespace gnomon::command
