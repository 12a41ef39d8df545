#include <gnomon/backend.hpp>
#include <gnomon/cascade/select.hpp>
#include <gnomon/check/check.hpp>
#include <gnomon/pipeline.hpp>
#include <gnomon/raster/cpu_backend.hpp>
#include <gnomon/scene.hpp>
#include <gnomon/shadow/map_view.hpp>

#include <array>
#include <bit>
#include <string>
#include <utility>
#include <vector>

namespace {

using namespace gnomon;
using backend::Done;

/// Counts what is staged.
class Spy final : public backend::Forward {
  public:
    using Forward::Forward;
    std::uint64_t made = 0;
    std::uint64_t written_bytes = 0;
    std::uint64_t waits = 0;
    bool fails_to_finish = false;

    [[nodiscard]] std::string_view name() const noexcept override { return "spy"; }
    backend::Result<backend::DrawListId> keep(std::span<backend::Draw const> draws) override {
        ++made;
        return target().keep(draws);
    }
    backend::Result<backend::TargetId> make_target(backend::TargetConfig const& config) override {
        ++made;
        return target().make_target(config);
    }
    backend::Result<backend::BufferId> make_buffer(std::size_t bytes) override {
        ++made;
        return target().make_buffer(bytes);
    }
    backend::Result<Done> write(backend::BufferId buffer, std::size_t offset,
                                std::span<std::byte const> bytes) override {
        written_bytes += bytes.size();
        return target().write(buffer, offset, bytes);
    }
    backend::Result<std::span<backend::StageTime const>> finish() override {
        ++waits;
        if (fails_to_finish) return core::Failure{backend::Error::device_lost, "finish: the device stopped"};
        return target().finish();
    }
};

struct Built {
    scene::Scene scene;
    scene::Geometry geometry;

    explicit Built(std::string const& name) {
        scene::ProceduralConfig config;
        config.name = name;
        scene = scene::make_procedural(config).value();
        geometry = scene::flatten(scene);
    }
    /// Random holes in all that it is made of, through textures of odd sizes.
    void perforate() {
        std::uint32_t seed = 1;
        for (std::uint32_t i = 0; i < scene.materials.size(); ++i) {
            scene::Image image{"holes", math::ivec2(7 + static_cast<int>(i) * 4, 5), {}};
            image.rgba.resize(static_cast<std::size_t>(image.size_px.x * image.size_px.y) * 4);
            for (std::uint8_t& byte : image.rgba)
                byte = static_cast<std::uint8_t>((seed = seed * 1664525U + 1013904223U) >> 24U);
            scene.images.push_back(std::move(image));
            scene.textures.push_back({static_cast<std::uint32_t>(scene.images.size() - 1), math::Wrap::mirror,
                                      i % 2 == 0 ? math::Wrap::repeat : math::Wrap::clamp});
            scene::Material& material = scene.materials[i];
            material.base_color_texture.texture = static_cast<std::uint32_t>(scene.textures.size() - 1);
            material.alpha_mode = scene::AlphaMode::mask;
            material.base_color.w = 1.25F;
        }
        geometry.uv.clear();
        for (math::vec3 const& p : geometry.positions) geometry.uv.emplace_back(p.x * 0.7F, p.y + p.z);
    }
    [[nodiscard]] pipeline::Frame frame(pipeline::Light const& light, int height_px = 64) const {
        math::View const view = scene::make_view(scene.cameras.front(), math::ivec2(96, height_px)).value();
        core::SerialExecutor serial;
        return pipeline::make_frame(scene, geometry, view, light, serial).value();
    }
};

/// With holes, so that every buffer of every kernel is used.
Built const& tree() {
    static Built const made = [] {
        Built built("tree");
        built.perforate();
        return built;
    }();
    return made;
}

pipeline::Light test_sun_of_tree() { return pipeline::sun(math::dvec3(-0.4, -1.0, -0.3)); }
pipeline::Frame tree_frame() { return tree().frame(test_sun_of_tree()); }

pipeline::TechniqueOutput output_of(pipeline::Frame const& frame, std::string_view name, pipeline::Workspace& workspace,
                                    backend::Backend& device) {
    pipeline::Technique const& technique = **pipeline::find_technique(name);
    pipeline::Params const params = *pipeline::make_params(technique);
    core::SerialExecutor serial;
    pipeline::TechniqueRun const on{frame, params, workspace, device, serial};
    pipeline::TechniqueOutput output = technique.run(on).value();
    if (technique.examine != nullptr) REQUIRE(technique.examine(on, output));
    return output;
}

std::vector<pipeline::RunRequest> every_technique() {
    std::vector<pipeline::RunRequest> requests;
    for (pipeline::Technique const& technique : pipeline::techniques())
        requests.push_back({.technique = &technique, .params = *pipeline::make_params(technique)});
    return requests;
}

}  // namespace

TEST_CASE("every technique runs on a backend that does nothing, and finds nothing", "[pipeline][backend]") {
    pipeline::Frame const frame = tree_frame();
    core::SerialExecutor serial;
    backend::NullBackend null;
    {
        std::vector<pipeline::RunRequest> requests = every_technique();
        for (pipeline::RunRequest& request : requests) request.device = &null;
        auto const comparison = pipeline::compare(frame, requests, {}, serial);
        REQUIRE(comparison);
        for (pipeline::RunReport const& run : comparison->runs) {
            CAPTURE(run.technique);
            CHECK(run.backend == "null");
            CHECK(run.error.false_lit == 0);  // zeros are shadows
            CHECK(run.error.false_shadow == comparison->truly_lit);
        }
    }
    CHECK(null.live() == 0);
}

TEST_CASE("one comparison holds runs of several backends, and each reports its own", "[pipeline][backend]") {
    pipeline::Frame const frame = tree_frame();
    core::SerialExecutor serial;
    raster::CpuBackend cpu(serial);
    Spy spy(cpu);
    std::vector<pipeline::RunRequest> requests = every_technique();
    std::size_t const n = requests.size();
    for (std::size_t i = 0; i < n; ++i) requests.push_back(requests[i]);
    for (std::size_t i = n; i < 2 * n; ++i) requests[i].device = &spy;
    auto const comparison = pipeline::compare(frame, requests, {}, serial);
    REQUIRE(comparison);
    for (std::size_t i = 0; i < n; ++i) {
        pipeline::RunReport const& own = comparison->runs[i];
        pipeline::RunReport const& given = comparison->runs[n + i];
        CHECK(own.backend == "cpu");
        CHECK(given.backend == "spy");
        CHECK(own.lit.rgb == given.lit.rgb);
        CHECK(own.error.wrong == given.error.wrong);
        CHECK(own.error.acne == given.error.acne);
        CHECK(own.stages.size() == given.stages.size());
    }
    // The kernel's rays see the holes that the truth sees: a tree without them throws another shadow.
    CHECK(comparison->runs[n - 1].technique == "ray");
    CHECK(comparison->runs[n - 1].error.wrong == 0);
    CHECK(Built("tree").frame(test_sun_of_tree()).lit != frame.lit);
    CHECK(spy.waits > 0);
    CHECK(cpu.live() == 0);
}

TEST_CASE("what a frame does not change is staged once", "[pipeline][backend]") {
    pipeline::Frame const frame = tree_frame();
    core::SerialExecutor serial;
    raster::CpuBackend cpu(serial);
    for (pipeline::Technique const& technique : pipeline::techniques()) {
        CAPTURE(technique.name);
        Spy spy(cpu);
        pipeline::Workspace workspace;
        pipeline::Params const params = *pipeline::make_params(technique);
        pipeline::TechniqueRun const on{frame, params, workspace, spy, serial};
        auto const first = technique.run(on);
        REQUIRE(first);
        std::uint64_t const made = spy.made;
        std::uint64_t const written = spy.written_bytes;
        CHECK(spy.waits == 1);  // one wait for a run
        auto const again = technique.run(on);
        REQUIRE(again);
        CHECK(again->visibility == first->visibility);
        CHECK(spy.made == made);
        // A map's view, or the hierarchy that is built anew each time: never the samples or the triangles.
        bool const traces = technique.name == "ray";
        std::uint64_t const per_run = traces                ? first->bytes[0].value
                                      : technique.suns_only ? 4 * sizeof(shadow::MapView) + sizeof(cascade::CascadeDepths)
                                                            : sizeof(shadow::MapView);
        CHECK(spy.written_bytes - written == per_run);
        CHECK(written > per_run + frame.samples.size() * sizeof(float));
    }
    CHECK(cpu.live() == 0);
}

TEST_CASE("a workspace follows frames, geometry and backends", "[pipeline][backend]") {
    core::SerialExecutor serial;
    Built const cubes("cubes");
    pipeline::Frame const a = cubes.frame(test_sun_of_tree());
    pipeline::Frame const b = cubes.frame(test_sun_of_tree(), 48);
    Built const cage("cage");
    pipeline::Frame const c = cage.frame(pipeline::bulb(math::dvec3(0.5, 4.0, 0.5)));
    raster::CpuBackend one(serial);
    raster::CpuBackend two(serial);
    pipeline::Workspace kept;
    for (pipeline::Technique const& technique : pipeline::techniques())
        for (auto const& [frame, device] :
             {std::pair{&a, &one}, {&b, &one}, {&a, &one}, {&c, &one}, {&c, &two}, {&a, &one}}) {
            if (technique.suns_only && frame->light.kind != pipeline::LightKind::directional) continue;
            pipeline::Workspace fresh;
            backend::Backend& own = fresh.own_backend(serial);
            CHECK(output_of(*frame, technique.name, kept, *device).visibility ==
                  output_of(*frame, technique.name, fresh, own).visibility);
        }
    CHECK(one.live() > 0);
    CHECK(two.live() == 0);
    kept.clear();
    CHECK(one.live() == 0);
}

TEST_CASE("a backend's failure comes back with its name and its sentence", "[pipeline][backend]") {
    pipeline::Frame const frame = tree_frame();
    core::SerialExecutor serial;
    raster::CpuBackend cpu(serial);
    Spy spy(cpu);
    spy.fails_to_finish = true;
    std::vector<pipeline::RunRequest> requests = every_technique();
    for (pipeline::RunRequest& request : requests) {
        request.device = &spy;
        auto const comparison = pipeline::compare(frame, {&request, 1}, {}, serial);
        REQUIRE_FALSE(comparison);
        CHECK(comparison.failure().code == pipeline::Error::backend_failed);
        CHECK(comparison.failure().message == "backend spy: device_lost: finish: the device stopped");
    }
    backend::NullBackend small({.target_px = 1024});
    requests[0].device = &small;
    auto const comparison = pipeline::compare(frame, requests, {}, serial);
    REQUIRE_FALSE(comparison);
    CHECK(comparison.failure().code == pipeline::Error::too_large);
    CHECK(comparison.failure().message.find("2048 x 2048") != std::string::npos);
    CHECK(cpu.live() == 0);
}

TEST_CASE("visibilities and biases are these, on every machine", "[pipeline][backend][golden]") {
    core::SerialExecutor serial;
    std::uint64_t hash = 1469598103934665603U;
    auto const eat = [&](float value) { hash = (hash ^ std::bit_cast<std::uint32_t>(value)) * 1099511628211U; };
    for (pipeline::Light const& light : {test_sun_of_tree(), pipeline::bulb(math::dvec3(3.0, 12.0, 2.0))}) {
        pipeline::Frame const frame = tree().frame(light);
        pipeline::Workspace workspace;
        for (pipeline::Technique const& technique : pipeline::techniques()) {
            if (technique.suns_only && light.kind != pipeline::LightKind::directional) continue;
            auto const output = output_of(frame, technique.name, workspace, workspace.own_backend(serial));
            for (float const v : output.visibility) eat(v);
            for (float const b : output.bias_m) eat(b);
        }
    }
    CHECK(hash == 17'100'851'737'734'024'822U);
}
