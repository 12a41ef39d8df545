#pragma once
// The command line as plain, checked values. Nothing here opens a file.

#include "outcome.hpp"

#include <gnomon/math/vec.hpp>
#include <gnomon/scene/procedural.hpp>

#include <cstdint>
#include <optional>
#include <string>
#include <variant>
#include <vector>

namespace gnomon::command {

struct SceneOptions {
    scene::ProceduralConfig config;       ///< `name` is the built-in scene or the path, as given.
    std::optional<std::string> tuned_by;  ///< The first option given that only a built-in scene can take.
    std::optional<std::string> file_scene;  ///< One of several scenes of a file.
};

/// How time passes.
struct MotionOptions {
    std::optional<std::string> path;   ///< Along which the eye flies.
    std::optional<int> frames;         ///< Of the path, from its first.
    double time_s = 0.0;               ///< Of the animations, at the first frame.
    std::optional<std::string> clip;   ///< The animation that plays.
};

struct ViewOptions {
    std::optional<math::dvec3> eye_m;  ///< Given together with `look_m`.
    std::optional<math::dvec3> look_m;
    std::optional<double> fov_deg;      ///< Vertical.
    std::optional<std::string> camera;  ///< Of the file, or a named view of a built-in scene.
    std::optional<double> near_m;
    std::optional<double> far_m;
    math::ivec2 size_px{1024, 1024};
};

struct PointOption {
    math::dvec3 position_m{0.0, 0.0, 0.0};
    std::optional<double> range_m;
};

/// At most one of them is given.
struct LightOptions {
    std::optional<math::dvec3> sun;
    std::optional<PointOption> point;
    std::optional<std::string> name;  ///< One of the scene's own lights.
};

struct ParamOption {
    std::string technique;
    std::string name;
    std::vector<std::string> values;  ///< Each makes a run.
};

enum class Verb {
    render,   ///< Pictures.
    compare,  ///< Pictures, a page, errors beside times.
    flythrough,  ///< A film, a page, a table of every frame.
    bench,       ///< A page of fixed experiments beside the papers' figures.
};

struct RunOptions {
    Verb verb = Verb::render;
    SceneOptions scene;
    ViewOptions view;
    MotionOptions motion;
    LightOptions light;
    std::vector<std::string> backends;  ///< Each technique runs on each; at least one, no two alike.
    std::optional<std::string> device;  ///< Of the backend vulkan.
    std::vector<std::string> techniques;
    std::vector<ParamOption> params;
    int threads = 1;
    int repeats = 1;
    bool truth = true;
    bool debug = false;               ///< Pictures of how each run got there.
    std::optional<std::string> json;  ///< "-" is standard output.
    std::optional<std::string> out;   ///< A folder.
    std::string command;              ///< As typed.
};

enum class Bench {
    lights,
    cascades,
};

/// `bench`.
struct BenchOptions {
    Bench which = Bench::lights;
    RunOptions run;             ///< Size, backends, threads, repeats and outputs; the experiments choose the rest.
    int frames = 12;            ///< Of each path: spread over it; of `cascades` one after the other, from the first.
    std::uint32_t most_lights = 1'048'576;
    std::vector<std::string> motions;  ///< Of `cascades`; none named: all of them.
};

struct ScenesOptions {
    std::optional<SceneOptions> scene;
    std::optional<std::string> write;
};

struct InfoOptions {
    bool devices = false;  ///< The Vulkan devices instead of everything else.
};

/// Text that was asked for: help or the version.
struct HelpText {
    std::string text;
};

using Command = std::variant<HelpText, RunOptions, BenchOptions, ScenesOptions, InfoOptions>;

/// returns: what to do; or a usage error whose sentence names the value and what to do.
[[nodiscard]] Outcome<Command> parse_command_line(int argc, char const* const* argv);

}  // namespace gnomon::command
