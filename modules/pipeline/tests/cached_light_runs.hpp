#pragma once
// Maps of local lights from frame to frame over floating cubes that move, hide and change, with the maps in sight: for the
// tests of every backend.

#include <gnomon/backend.hpp>
#include <gnomon/check/check.hpp>
#include <gnomon/pipeline.hpp>
#include <gnomon/scene.hpp>

#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <map>
#include <random>
#include <string>
#include <vector>

namespace gnomon::test {

/// Reads the maps just before they are looked up in.
class MapCapture final : public backend::Forward {
  public:
    using Forward::Forward;
    std::vector<std::byte> texels;
    std::int32_t size_px = 0;
    bool narrow = false;
    bool forgets_to_clear = false;  ///< A fault: maps that are there are never drawn anew.
    std::uint32_t maps = 0;

    backend::Result<backend::PassCounts> draw(backend::DrawListId list, backend::TargetId to, std::span<backend::PassLayer const> layers) override {
        if (forgets_to_clear && !layers.empty() && layers[0].load == backend::Load::clear) return backend::PassCounts{};
        return target().draw(list, to, layers);
    }
    backend::Result<backend::Done> run(backend::Kernel const& kernel, backend::KernelCall const& call) override {
        if (kernel.name == "shadow_lookup") {
            std::memcpy(&maps, call.constants.data() + 4, sizeof maps);
            std::size_t const each = static_cast<std::size_t>(size_px) * static_cast<std::size_t>(size_px) * (narrow ? 2U : 4U);
            texels.resize(maps * each);
            for (std::uint32_t i = 0; i < maps; ++i)
                REQUIRE(target().read({call.targets[0].target, i, backend::Plane::depth, {0, 0, size_px, size_px}}, std::span(texels).subspan(i * each, each))
                            .has_value());
        }
        return target().run(kernel, call);
    }
};

/// One technique, from frame to frame.
struct MapRunner {
    pipeline::Technique const* technique;
    core::SerialExecutor executor;
    MapCapture device;
    pipeline::Workspace workspace;

    MapRunner(backend::Backend& on, std::string const& name) : technique(pipeline::find_technique(name).value()), device(on) {}
    ~MapRunner() { workspace.clear(); }

    pipeline::TechniqueOutput operator()(pipeline::Frame const& frame, std::vector<pipeline::Setting> const& settings) {
        pipeline::Params const params = pipeline::make_params(*technique, settings).value();
        device.size_px = params.integer("resolution");
        device.narrow = params.word("format") == "unorm16";
        auto output = technique->run({frame, params, workspace, device, executor});
        CAPTURE(output ? std::string() : output.failure().message);
        REQUIRE(output.has_value());
        return std::move(output).value();
    }
};

/// `cubes`, of which each `step`-th floats on a node of its own, some of them with holes.
struct LooseCubes {
    scene::Scene scene;
    scene::Geometry geometry;
    scene::Pose pose;
    scene::Pose rest;
    std::vector<std::size_t> loose;
    core::SerialExecutor executor;

    explicit LooseCubes(std::size_t step) {
        scene = scene::make_procedural({"cubes"}).value();
        for (std::size_t i = 0; i < scene.instances.size(); i += step) {
            scene::Instance& cube = scene.instances[i];
            if (cube.name != "cube") continue;
            cube.node = static_cast<std::uint32_t>(scene.nodes.size());
            cube.node_from_mesh = cube.world_from_mesh;
            scene.nodes.emplace_back();
            loose.push_back(i);
        }
        perforate(scene.materials.front());
        scene::settle(scene);
        geometry = scene::flatten(scene);
        geometry.uv.clear();
        for (math::vec3 const& p : geometry.positions) geometry.uv.emplace_back(p.x * 0.7F, p.y + p.z);
        pose = rest = scene::rest_pose(scene);
    }
    /// Holes, by a texture.
    void perforate(scene::Material& material) {
        scene::Image image{"holes", math::ivec2(7, 5), {}};
        for (std::uint32_t i = 0; i < 7 * 5 * 4; ++i) image.rgba.push_back(static_cast<std::uint8_t>(i * 1664525U >> 7U));
        scene.images.push_back(std::move(image));
        scene.textures.push_back({static_cast<std::uint32_t>(scene.images.size() - 1)});
        material.base_color_texture.texture = static_cast<std::uint32_t>(scene.textures.size() - 1);
        material.alpha_mode = scene::AlphaMode::mask;
    }
    /// Moves a loose cube by metres and scales it about its own centre.
    void place(std::size_t cube, math::dvec3 const& by_m, math::dvec3 const& scale) {
        math::dmat4& at = pose.world_from_mesh[loose[cube]];
        at = rest.world_from_mesh[loose[cube]];
        for (math::axis_t row = 0; row < 3; ++row) {
            for (math::axis_t column = 0; column < 3; ++column) at[column][row] *= scale[column];
            at[3][row] += by_m[row];
        }
    }
    pipeline::Frame frame(pipeline::Light const& light) {
        scene::update(geometry, scene, pose);
        math::View const view = scene::make_view(scene.cameras.front(), math::ivec2(48, 32)).value();
        return pipeline::make_frame(scene, geometry, {.view = view, .light = light, .truth = false}, executor).value();
    }
};

inline std::uint64_t count_in(std::vector<pipeline::Count> const& counts, std::string_view name) {
    for (pipeline::Count const& count : counts)
        if (count.name == name) return count.value;
    return 0;
}

/// A course of events: cubes move, teleport, are hidden, shown and deformed, lights change, and so does how they are drawn.
struct Course {
    LooseCubes& cubes;
    pipeline::Light light;
    std::vector<pipeline::Setting> settings;
    std::mt19937 random{1};
    bool changes_light = true;
    bool changes_drawing = true;
    bool quiet = false;  ///< Nothing at all happened in the last step.

    Course(LooseCubes& of, pipeline::Light const& under, std::vector<pipeline::Setting> const& with) : cubes(of), light(under), settings(with) {}

    std::uint32_t below(std::uint32_t n) { return static_cast<std::uint32_t>(random()) % n; }
    double within(double reach) { return (static_cast<double>(below(2001)) / 1000.0 - 1.0) * reach; }
    math::dvec3 vector_within(double reach) {
        math::dvec3 v;
        for (math::axis_t axis = 0; axis < 3; ++axis) v[axis] = within(reach);
        return v;
    }
    void set(std::string const& name, std::string const& text) { settings.push_back({name, text}); }

    void step() {
        quiet = true;
        std::uint32_t const events = below(4) == 0 ? 0 : below(4);
        for (std::uint32_t e = 0; e < events; ++e) move_cube();
        if (changes_light && below(5) == 0) change_light();
        if (changes_light && changes_drawing && below(16) == 0) change_drawing();
    }

  private:
    void move_cube() {
        quiet = false;
        // Few of them, so that the others come to rest.
        std::uint32_t const cube = below(4) == 0 ? below(static_cast<std::uint32_t>(cubes.loose.size())) : below(3);
        switch (below(5)) {
            case 0: return cubes.place(cube, {}, math::dvec3(0.0));  // hidden
            case 1: return cubes.place(cube, {}, math::dvec3(1.0));  // shown where it was
            case 2: return cubes.place(cube, vector_within(20.0), math::dvec3(1.0));
            case 3: return cubes.place(cube, {}, vector_within(2.0));  // deformed, mirrored at times
            default: return cubes.place(cube, vector_within(0.05), math::dvec3(1.0));
        }
    }
    void change_light() {
        quiet = false;
        bool const spot = light.kind == pipeline::LightKind::spot;
        switch (below(spot ? 4 : 2)) {
            case 0: light.position_m = light.position_m + vector_within(0.3); break;
            case 1: light.range_m = static_cast<float>(8 + below(20)); break;
            case 2: light.outer_cone_rad = 0.3F + 0.1F * static_cast<float>(below(8)); break;
            default: light.direction = light.direction + vector_within(0.2); break;
        }
    }
    void change_drawing() {
        quiet = false;
        switch (below(5)) {
            case 0: return set("format", below(2) == 0 ? "f32" : "unorm16");
            case 1: return set("depth", below(2) == 0 ? "forward" : "reversed");
            case 2: return set("resolution", below(2) == 0 ? "96" : "128");
            case 3: return set("cull", below(2) == 0 ? "back" : "none");
            default: light.kind = light.kind == pipeline::LightKind::spot ? pipeline::LightKind::point : pipeline::LightKind::spot; return;
        }
    }
};

inline pipeline::Light bulb_among_cubes() { return pipeline::bulb(math::dvec3(0.1, 10.3, -0.1), 25.0F); }
inline pipeline::Light spot_among_cubes() {
    pipeline::Light light = bulb_among_cubes();
    light.kind = pipeline::LightKind::spot;
    light.direction = math::dvec3(0.3, -0.8, -0.4);
    light.outer_cone_rad = 0.7F;
    return light;
}

/// What a course came to.
struct CourseEnd {
    std::uint64_t frames = 0, wrong = 0, quiet_draws = 0, plain = 0, kept = 0;
    std::map<std::string, std::uint64_t> reasons;
};

/// Runs both techniques along a course and compares all that they give.
inline CourseEnd run(Course& course, backend::Backend& device, std::size_t frames, bool forgets_to_clear = false) {
    MapRunner plain(device, "shadow-map"), cached(device, "shadow-map-cached");
    CourseEnd seen;
    std::size_t still = 0;
    for (std::size_t i = 0; i < frames; ++i) {
        if (i > 0) course.step();
        pipeline::Frame const frame = course.cubes.frame(course.light);
        auto const anew = plain(frame, course.settings);
        auto with_rest = course.settings;
        with_rest.push_back({"rest", "3"});
        cached.device.forgets_to_clear = forgets_to_clear && i > 0;
        auto const kept = cached(frame, with_rest);
        bool const same = cached.device.texels == plain.device.texels && kept.visibility == anew.visibility && kept.bias_m == anew.bias_m;
        seen.wrong += same ? 0U : 1U;
        ++seen.frames;
        still = course.quiet && i > 0 ? still + 1 : 0;
        if (still > 3) seen.quiet_draws += count_in(kept.counts, "triangles_drawn") + count_in(kept.counts, "texels_rewritten");
        seen.plain += count_in(anew.counts, "triangles_drawn");
        seen.kept += count_in(kept.counts, "triangles_drawn");
        for (pipeline::Count const& reason : kept.redraw_reasons) seen.reasons[std::string(reason.name)] += reason.value;
    }
    std::printf("%llu frames, %llu wrong; triangles %llu of %llu;", static_cast<unsigned long long>(seen.frames), static_cast<unsigned long long>(seen.wrong),
                static_cast<unsigned long long>(seen.kept), static_cast<unsigned long long>(seen.plain));
    for (auto const& [name, count] : seen.reasons) std::printf(" %s %llu", name.c_str(), static_cast<unsigned long long>(count));
    std::printf("\n");
    return seen;
}

}  // namespace gnomon::test
