#include "options.hpp"

#include "raw_options.hpp"
#include "values.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <thread>

namespace gnomon::command {

namespace {

constexpr RealRange any_metres{-farthest_m, farthest_m, "m"};
constexpr RealRange positive_metres{1e-9, 1e12, "m"};
constexpr IntegerRange thread_range{1, 1024};
constexpr IntegerRange repeat_range{1, 1000};
constexpr IntegerRange frame_range{1, 100'000};
constexpr IntegerRange triangle_range{1, 1 << 25};
constexpr IntegerRange block_range{1, 1 << 20};
constexpr IntegerRange seed_range{0, std::numeric_limits<std::uint32_t>::max()};

/// Reads `text`, if given, into `target`; the first failure stays in `error`.
template <class T, class Target, class Read>
void take(std::optional<std::string> const& text, Target& target, std::optional<core::Failure<Exit>>& error,
          Read read) {
    if (!text || error) return;
    Outcome<T> value = read(*text);
    if (value)
        target = static_cast<std::conditional_t<std::is_arithmetic_v<Target>, Target, T>>(value.value());
    else
        error = std::move(value).failure();
}

Outcome<SceneOptions> scene_options(RawOptions const& raw) {
    SceneOptions options;
    options.config.name = raw.scene;
    std::optional<core::Failure<Exit>> error;
    auto const integer = [&](char const* name, std::optional<std::string> const& text, auto& target,
                             IntegerRange range) {
        if (text && !options.tuned_by) options.tuned_by = name;
        take<std::int64_t>(text, target, error, [&](std::string const& t) { return read_integer(name, t, range); });
    };
    integer("--triangles", raw.triangles, options.config.triangles, triangle_range);
    integer("--blocks", raw.blocks, options.config.blocks, block_range);
    integer("--seed", raw.seed, options.config.seed, seed_range);
    if (raw.offset && !options.tuned_by) options.tuned_by = "--offset";
    take<double>(raw.offset, options.config.offset_m, error,
                 [](std::string const& t) { return read_real("--offset", t, any_metres); });
    if (raw.lights && !options.tuned_by) options.tuned_by = "--lights";
    if (raw.moving && !options.tuned_by) options.tuned_by = "--moving";
    if (raw.trees && !options.tuned_by) options.tuned_by = "--trees";
    options.config.trees = raw.trees;
    options.config.lights = raw.lights.value_or("");
    take<double>(raw.moving, options.config.moving_percent, error,
                 [](std::string const& t) { return read_real("--moving", t, {0.0, 100.0, "%"}); });
    if (error) return *error;
    options.file_scene = raw.file_scene;
    return options;
}

Outcome<ViewOptions> view_options(RawOptions const& raw) {
    ViewOptions view;
    std::optional<core::Failure<Exit>> error;
    auto const vector = [&](char const* name, auto const& text, auto& target) {
        take<math::dvec3>(text, target, error, [&](std::string const& t) { return read_vector(name, t, farthest_m); });
    };
    auto const real = [&](char const* name, auto const& text, auto& target, RealRange const& range) {
        take<double>(text, target, error, [&](std::string const& t) { return read_real(name, t, range); });
    };
    vector("--eye", raw.eye, view.eye_m);
    vector("--look", raw.look, view.look_m);
    real("--fov", raw.fov, view.fov_deg, {0.01, 179.0, "degrees"});
    real("--near", raw.near, view.near_m, positive_metres);
    real("--far", raw.far, view.far_m, positive_metres);
    take<math::ivec2>(raw.size, view.size_px, error, [](std::string const& t) { return read_size("--size", t); });
    if (error) return *error;
    view.camera = raw.camera;
    if (raw.eye.has_value() != raw.look.has_value())
        return usage_error(fmt::format("{} {}: give --eye and --look together", raw.eye ? "--eye" : "--look",
                                       raw.eye ? *raw.eye : *raw.look));
    if (raw.camera && raw.eye)
        return usage_error(fmt::format("--camera {} and --eye {}: give one of them", *raw.camera, *raw.eye));
    if (raw.fov && !raw.eye)
        return usage_error(fmt::format("--fov {}: it goes with --eye and --look; add them", *raw.fov));
    if (view.eye_m && *view.eye_m == *view.look_m)
        return usage_error(
            fmt::format("--eye {} and --look {}: they are the same point; move one of them", *raw.eye, *raw.look));
    if (view.near_m && view.far_m && *view.near_m >= *view.far_m)
        return usage_error(fmt::format("--near {} and --far {}: near must be less than far", *raw.near, *raw.far));
    return view;
}

Outcome<MotionOptions> motion_options(RawOptions const& raw, Verb verb) {
    MotionOptions motion;
    std::optional<core::Failure<Exit>> error;
    motion.path = raw.path;
    motion.clip = raw.clip;
    take<double>(raw.time, motion.time_s, error,
                 [](std::string const& t) { return read_real("--time", t, {0.0, 1e6, "s"}); });
    take<int>(raw.frames, motion.frames, error, [](std::string const& t) -> Outcome<int> {
        auto const count = read_integer("--frames", t, frame_range);
        if (!count) return count.failure();
        return static_cast<int>(count.value());
    });
    if (error) return *error;
    bool const flies = verb == Verb::flythrough || verb == Verb::bench || raw.path;
    if (raw.frames && !flies)
        return usage_error(fmt::format("--frames {}: it goes with --path; add one", *raw.frames));
    for (auto const& [name, text] : {std::pair{"--eye", &raw.eye}, {"--camera", &raw.camera}})
        if (raw.path && *text)
            return usage_error(fmt::format("{} {}: a path decides where the eye is; leave one of them out", name, **text));
    return motion;
}

Outcome<PointOption> read_point(std::string const& text) {
    std::vector<std::string> const parts = split(text, ',');
    if (parts.size() != 3 && parts.size() != 4)
        return usage_error(fmt::format("--point {}: give x,y,z or x,y,z,range in metres", text));
    PointOption point;
    auto position = read_vector("--point", parts[0] + ',' + parts[1] + ',' + parts[2], farthest_m);
    if (!position) return std::move(position).failure();
    point.position_m = *position;
    if (parts.size() == 3) return point;
    auto const range = real_from(parts[3]);
    if (!range || !(*range > 0.0))
        return usage_error(fmt::format("--point {}: the range {} must be a number of metres above 0", text, parts[3]));
    point.range_m = *range;
    return point;
}

Outcome<LightOptions> light_options(RawOptions const& raw) {
    LightOptions light;
    std::vector<std::string> given;
    for (auto const& [name, text] : {std::pair{"--sun", &raw.sun}, {"--point", &raw.point}, {"--light", &raw.light}})
        if (*text) given.push_back(fmt::format("{} {}", name, **text));
    if (given.size() > 1) return usage_error(join(given, " and ") + ": a run has one light; give one of them");
    std::optional<core::Failure<Exit>> error;
    take<math::dvec3>(raw.sun, light.sun, error, [](std::string const& t) { return read_vector("--sun", t); });
    take<PointOption>(raw.point, light.point, error, read_point);
    if (error) return *error;
    if (light.sun && *light.sun == math::dvec3(0.0))
        return usage_error(
            fmt::format("--sun {}: a direction of zero length points nowhere; give the way light travels, "
                        "such as --sun -0.45,-0.8,-0.4",
                        *raw.sun));
    light.name = raw.light;
    return light;
}

Outcome<ParamOption> read_param(std::string const& text) {
    std::size_t const equals = text.find('=');
    std::size_t const dot = text.find('.');
    bool const whole = equals != std::string::npos && dot != std::string::npos && dot > 0 && dot + 1 < equals;
    if (!whole)
        return usage_error(
            fmt::format("--param {}: give technique.name=value, such as --param shadow-map.resolution=2048", text));
    ParamOption param{text.substr(0, dot), text.substr(dot + 1, equals - dot - 1), split(text.substr(equals + 1), ',')};
    if (std::find(param.values.begin(), param.values.end(), "") != param.values.end())
        return usage_error(
            fmt::format("--param {}: a value is missing after '=' or ','; give one or leave the comma out", text));
    return param;
}

Outcome<core::Done> take_backends(RawOptions const& raw, RunOptions& run) {
    std::vector<std::string> const known = {"cpu", "vulkan"};
    run.backends = raw.backends.empty() ? std::vector<std::string>{"cpu"} : raw.backends;
    run.device = raw.device;
    for (auto at = run.backends.begin(); at != run.backends.end(); ++at) {
        if (std::find(known.begin(), known.end(), *at) == known.end())
            return usage_error(fmt::format("--backend {}: no such backend; {}", *at, suggestion(*at, known)));
        if (std::find(run.backends.begin(), at, *at) != at)
            return usage_error(fmt::format("--backend {}: given twice; name each backend once", *at));
    }
    bool const on_vulkan = std::find(run.backends.begin(), run.backends.end(), "vulkan") != run.backends.end();
    if (raw.device && !on_vulkan)
        return usage_error(fmt::format("--device {}: it goes with --backend vulkan; add it", *raw.device));
    return core::Done{};
}

/// How often, on how many threads, and where to.
Outcome<core::Done> take_running(RawOptions const& raw, RunOptions& run) {
    run.threads = static_cast<int>(std::clamp(std::thread::hardware_concurrency(), 1U, 1024U));
    run.repeats = run.verb == Verb::compare && !raw.path ? 3 : 1;
    run.truth = !raw.no_truth;
    run.debug = raw.debug;
    run.json = raw.json;
    run.out = raw.out;
    std::optional<core::Failure<Exit>> error;
    take<std::int64_t>(raw.threads, run.threads, error,
                       [](std::string const& t) { return read_integer("--threads", t, thread_range); });
    take<std::int64_t>(raw.repeats, run.repeats, error,
                       [](std::string const& t) { return read_integer("--repeats", t, repeat_range); });
    if (error) return *error;
    if (run.verb == Verb::compare && !run.truth)
        return usage_error(
            "--no-truth: compare measures errors, which need the truth; leave it out, or use gnomon render");
    for (auto const& [name, path] : {std::pair{"--json", &raw.json}, {"--out", &raw.out}})
        if (*path && (*path)->empty()) return usage_error(fmt::format("{} '': give a name that is not empty", name));
    return take_backends(raw, run);
}

/// Which techniques with which parameters.
Outcome<core::Done> take_techniques(RawOptions const& raw, RunOptions& run) {
    run.techniques = raw.techniques;
    if (run.techniques.empty())
        run.techniques = run.verb == Verb::compare ? std::vector<std::string>{"shadow-map", "ray"}
                                                   : std::vector<std::string>{"shadow-map"};
    for (std::string const& text : raw.params) {
        auto param = read_param(text);
        if (!param) return std::move(param).failure();
        run.params.push_back(*std::move(param));
    }
    return core::Done{};
}

Outcome<RunOptions> run_options(RawOptions const& raw, Verb verb) {
    RunOptions run;
    run.verb = verb;
    auto scene = scene_options(raw);
    if (!scene) return std::move(scene).failure();
    auto view = view_options(raw);
    if (!view) return std::move(view).failure();
    auto motion = motion_options(raw, verb);
    if (!motion) return std::move(motion).failure();
    auto light = light_options(raw);
    if (!light) return std::move(light).failure();
    run.scene = *std::move(scene);
    run.view = *std::move(view);
    run.motion = *std::move(motion);
    run.light = *std::move(light);
    if (verb == Verb::flythrough && !raw.size) run.view.size_px = math::ivec2(960, 540);
    if (auto taken = take_techniques(raw, run); !taken) return std::move(taken).failure();
    if (auto taken = take_running(raw, run); !taken) return std::move(taken).failure();
    return run;
}

Outcome<Command> run_command_of(RawOptions const& raw, Verb verb) {
    auto run = run_options(raw, verb);
    if (!run) return std::move(run).failure();
    return Command{*std::move(run)};
}

Outcome<Command> bench_options(RawOptions const& raw) {
    if (raw.bench != "lights" && raw.bench != "cascades")
        return usage_error(fmt::format("gnomon bench {}: there is no such benchmark; there are lights and cascades", raw.bench));
    if (raw.bench == "cascades" && raw.most_lights)
        return usage_error("--most-lights: only bench lights has so many; leave it out");
    if (raw.bench == "lights" && !raw.motions.empty())
        return usage_error(fmt::format("--motions {}: only bench cascades has motions; leave it out", raw.motions.front()));
    auto run = run_options(raw, Verb::bench);
    if (!run) return std::move(run).failure();
    BenchOptions bench;
    bench.run = *std::move(run);
    if (raw.bench == "cascades") {
        bench.which = Bench::cascades;
        bench.motions = raw.motions;
        bench.frames = 30;
    }
    if (!raw.size) bench.run.view.size_px = math::ivec2(960, 540);
    std::optional<core::Failure<Exit>> error;
    take<std::int64_t>(raw.frames, bench.frames, error,
                       [](std::string const& t) { return read_integer("--frames", t, frame_range); });
    take<std::int64_t>(raw.most_lights, bench.most_lights, error,
                       [](std::string const& t) { return read_integer("--most-lights", t, {1, 1'048'576}); });
    if (error) return *error;
    bench.run.motion.frames.reset();
    return Command{std::move(bench)};
}

Outcome<Command> scenes_options(RawOptions const& raw) {
    ScenesOptions options;
    auto scene = scene_options(raw);
    if (!scene) return std::move(scene).failure();
    if (raw.scene.empty() && scene->tuned_by)
        return usage_error(
            fmt::format("{}: name the scene that it is for, such as gnomon scenes city", *scene->tuned_by));
    if (!raw.scene.empty()) options.scene = *std::move(scene);
    options.write = raw.write;
    if (raw.write && !options.scene)
        return usage_error(fmt::format("--write {}: name the scene to write, such as gnomon scenes city --write {}",
                                       *raw.write, *raw.write));
    return Command{std::move(options)};
}

}  // namespace

Outcome<Command> parse_command_line(int argc, char const* const* argv) {
    auto raw = parse_raw(argc, argv);
    if (!raw) return std::move(raw).failure();
    switch (raw->verb) {
        case RawVerb::help: return Command{HelpText{raw->text}};
        case RawVerb::render: return run_command_of(raw->options, Verb::render);
        case RawVerb::compare: return run_command_of(raw->options, Verb::compare);
        case RawVerb::flythrough: return run_command_of(raw->options, Verb::flythrough);
        case RawVerb::bench: return bench_options(raw->options);
        case RawVerb::scenes: return scenes_options(raw->options);
        case RawVerb::info: return Command{InfoOptions{raw->options.devices}};
    }
    return usage_error("gnomon needs a verb; `gnomon --help` lists them");
}

}  // namespace gnomon::command
