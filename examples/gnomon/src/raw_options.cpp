#include "raw_options.hpp"

#include "values.hpp"

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <algorithm>
#include <sstream>

namespace gnomon::command {

namespace {

std::vector<std::string> const verbs = {"render", "compare", "flythrough", "bench", "scenes", "info"};

void add_scene(CLI::App& app, RawOptions& raw, bool required) {
    app.add_option("scene", raw.scene, "a built-in scene (`gnomon scenes` lists them) or a .gltf/.glb file")
        ->required(required)
        ->type_name("");
    auto const add = [&](char const* name, std::optional<std::string>& value, char const* text, char const* type) {
        app.add_option(name, value, text)->type_name(type)->group("Built-in scenes");
    };
    add("--triangles", raw.triangles, "budget; the nearest size the scene comes in", "N");
    add("--blocks", raw.blocks, "city: copies of the whole city, the first in the middle", "N");
    add("--offset", raw.offset, "sheet: moved by this many metres along x, y and z", "M");
    add("--lights", raw.lights, "a light set of the scene, or how many lights", "NAME|N");
    add("--moving", raw.moving, "town: this share of the props moves, percent", "P");
    app.add_flag("--trees", raw.trees, "atrium: twelve bare trees in the court")->group("Built-in scenes");
    add("--seed", raw.seed, "random seed; left out: the scene's fixed one", "N");
    app.add_option("--file-scene", raw.file_scene, "one of several scenes of a glTF file, by name or number from 1; left out: its default")
        ->type_name("NAME");
}

void add_view_and_light(CLI::App& app, RawOptions& raw) {
    auto const view = [&](char const* name, std::optional<std::string>& value, char const* text, char const* type) {
        app.add_option(name, value, text)->type_name(type)->group("View (left out: one that shows the scene)");
    };
    view("--eye", raw.eye, "where the eye stands, metres", "X,Y,Z");
    view("--look", raw.look, "the point it looks at, metres", "X,Y,Z");
    view("--fov", raw.fov, "vertical field of view, degrees; 60", "DEG");
    view("--camera,--view", raw.camera, "a camera of the file, or a named view of a built-in scene", "NAME");
    view("--near", raw.near, "near plane, metres", "M");
    view("--far", raw.far, "far plane, metres; left out: infinitely far", "M");
    view("--size", raw.size, "picture size in pixels; 1024x1024 (flythrough: 960x540)", "WxH");
    auto const motion = [&](char const* name, std::optional<std::string>& value, char const* text, char const* type) {
        app.add_option(name, value, text)->type_name(type)->group("Motion");
    };
    motion("--path", raw.path, "fly along one of the scene's paths, or `orbit`", "NAME");
    motion("--frames", raw.frames, "how many frames of the path; left out: all of them", "N");
    motion("--time", raw.time, "seconds into the animations; on a path, of its first frame; 0", "S");
    motion("--clip", raw.clip, "one animation of the file; left out: its first", "NAME");
    auto const light = [&](char const* name, std::optional<std::string>& value, char const* text, char const* type) {
        app.add_option(name, value, text)->type_name(type)->group("Light (left out: the scene's first, else a sun)");
    };
    light("--sun", raw.sun, "the way sunlight travels", "DX,DY,DZ");
    light("--point", raw.point, "a lamp: position and range in metres", "X,Y,Z[,RANGE]");
    light("--light", raw.light, "one of the scene's own lights", "NAME");
}

/// On what, how often, and where to.
void add_running(CLI::App& app, RawOptions& raw) {
    app.add_option("--backend,--backends", raw.backends, "what draws: cpu or vulkan, or both, a run of each; cpu")
        ->delimiter(',')
        ->allow_extra_args(false)
        ->type_name("A,B")
        ->group("Runs");
    auto const add = [&](char const* name, std::optional<std::string>& value, char const* text, char const* type,
                         char const* group) { app.add_option(name, value, text)->type_name(type)->group(group); };
    add("--device", raw.device, "vulkan: a part of the device's name or its number; `gnomon info --devices`", "NAME", "Runs");
    add("--threads", raw.threads, "left out: as many as the machine has", "N", "Runs");
    add("--repeats", raw.repeats, "timed runs of each; the median counts; 1 (compare: 3)", "N", "Runs");
    add("--out", raw.out, "folder to write; left out: gnomon- and the verb", "DIR", "Output");
    add("--json", raw.json, "also write results.json here; - for standard output", "FILE", "Output");
}

void add_run(CLI::App& app, RawOptions& raw) {
    std::string const runs = "Runs";
    app.add_option("--techniques,--technique", raw.techniques, "which to run; shadow-map; compare: shadow-map,ray")
        ->delimiter(',')
        ->allow_extra_args(false)
        ->type_name("A,B")
        ->group(runs);
    app.add_option("--param", raw.params, "a technique's parameter; a list makes a run of each value; repeatable")
        ->allow_extra_args(false)
        ->type_name("TECHNIQUE.NAME=V[,V]")
        ->group(runs);
    app.add_flag("--no-truth", raw.no_truth, "pictures and times only: trace no exact shadows, so know no errors")
        ->group(runs);
    app.add_flag("--debug", raw.debug, "pictures of how each run got there too, where its technique has any: those with cascades, shadow-map-cached")
        ->group("Output");
    add_running(app, raw);
}

/// Every option name of `app`, for suggestions.
std::vector<std::string> option_names(CLI::App const& app) {
    std::vector<std::string> names;
    for (CLI::Option const* option : app.get_options())
        for (std::string const& name : option->get_lnames()) names.push_back("--" + name);
    return names;
}

/// CLI11's complaint as one sentence that names the value and what to do.
std::string sentence_for(CLI::ParseError const& error, CLI::App const& app, std::string const& verb) {
    std::string what = error.what();
    std::string const see = fmt::format("`gnomon {}{}--help` lists what it takes", verb, verb.empty() ? "" : " ");
    if (dynamic_cast<CLI::ExtrasError const*>(&error) != nullptr) {
        std::size_t const colon = what.find(": ");
        std::vector<std::string> const words = split(colon == std::string::npos ? what : what.substr(colon + 2), ' ');
        auto const option =
            std::find_if(words.begin(), words.end(), [](std::string const& w) { return w.starts_with("-"); });
        std::string const first = option != words.end() ? *option : words.front();
        auto const near = closest(split(first, '=').front(), option_names(app));
        return fmt::format("{}: gnomon {} does not take this; {}{}", first, verb,
                           near ? fmt::format("did you mean {}? ", *near) : "", see);
    }
    if (dynamic_cast<CLI::RequiredError const*>(&error) != nullptr)
        return fmt::format("gnomon {} needs a scene: a built-in name (`gnomon scenes` lists them) or a .gltf/.glb file",
                           verb);
    if (dynamic_cast<CLI::ArgumentMismatch const*>(&error) != nullptr)
        return fmt::format("{}: give it once, with one value; {}", split(what, ':').front(), see);
    std::replace(what.begin(), what.end(), '\n', ' ');
    return fmt::format("{}; {}", what, see);
}

Outcome<RawCommand> unknown_verb(std::string const& verb) {
    return usage_error(fmt::format("gnomon {}: no such verb; {}", verb, suggestion(verb, verbs)));
}

}  // namespace

Outcome<RawCommand> parse_raw(int argc, char const* const* argv) {
    CLI::App app("Shadows of a scene, drawn, measured against exact truth, and timed.", "gnomon");
    app.set_version_flag("--version", "gnomon " GNOMON_VERSION);
    app.footer(
        "Exit codes: 0 done, 1 failed, 2 bad usage.\nExample: gnomon compare city --param "
        "shadow-map.resolution=512,2048 --out city");
    RawCommand raw;
    auto* render = app.add_subcommand("render", "Draw pictures of a scene with shadows");
    auto* compare = app.add_subcommand("compare", "Measure techniques against exact shadows: a page, pictures, JSON");
    auto* flythrough = app.add_subcommand("flythrough", "Fly along a path: a film, a table of every frame, pictures");
    auto* bench = app.add_subcommand("bench", "Repeat the papers' experiments, their figures beside ours");
    auto* scenes = app.add_subcommand("scenes", "List the built-in scenes, or write one as glTF");
    auto* info = app.add_subcommand("info", "Version, machine, backends, techniques and their parameters");
    for (CLI::App* verb : {render, compare, flythrough}) {
        add_scene(*verb, raw.options, true);
        add_view_and_light(*verb, raw.options);
        add_run(*verb, raw.options);
    }
    bench->add_option("which", raw.options.bench, "lights: tiled and clustered shading, few lights to a million; cascades: maps that are kept and scrolled")->required()->type_name("");
    bench->add_option("--size", raw.options.size, "picture size in pixels; 960x540 (the papers': 1920x1080)")->type_name("WxH");
    bench->add_option("--frames", raw.options.frames, "of each path; lights: spread over it, 12; cascades: from the first, 30")->type_name("N");
    bench->add_option("--most-lights", raw.options.most_lights, "no experiment has more; 1048576")->type_name("N");
    bench->add_option("--motions", raw.options.motions, "of cascades, some only: still, street, spin, ...; all of them")
        ->delimiter(',')
        ->allow_extra_args(false)
        ->type_name("A,B");
    add_running(*bench, raw.options);
    add_scene(*scenes, raw.options, false);
    scenes->add_option("--write", raw.options.write, "write the scene as glTF 2.0")->type_name("FILE.glb");
    info->add_flag("--devices", raw.options.devices, "list the Vulkan devices of this machine");
    std::string const first = argc > 1 ? argv[1] : "";
    if (argc > 1 && !first.starts_with("-") && std::find(verbs.begin(), verbs.end(), first) == verbs.end())
        return unknown_verb(first);
    if (argc <= 1)
        return usage_error("gnomon needs a verb: render, compare, flythrough, bench, scenes or info; `gnomon --help` says more");
    try {
        app.parse(argc, argv);
    } catch (CLI::ParseError const& error) {
        std::ostringstream out;
        if (error.get_exit_code() != 0) {
            bool const has_verb = !app.get_subcommands().empty();
            CLI::App const& where = has_verb ? *app.get_subcommands().front() : app;
            return usage_error(sentence_for(error, where, has_verb ? where.get_name() : ""));
        }
        app.exit(error, out, out);
        raw.text = out.str();
        return raw;
    }
    raw.verb = render->parsed()       ? RawVerb::render
               : compare->parsed()    ? RawVerb::compare
               : flythrough->parsed() ? RawVerb::flythrough
               : bench->parsed()      ? RawVerb::bench
               : scenes->parsed()     ? RawVerb::scenes
               : info->parsed()       ? RawVerb::info
                                      : RawVerb::help;
    if (raw.verb == RawVerb::help) raw.text = app.help();
    return raw;
}

}  // namespace gnomon::command
