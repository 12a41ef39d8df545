#pragma once
// Cascades from frame to frame through `town`, with the finished maps in sight: for the tests of every backend.

#include <gnomon/backend.hpp>
#include <gnomon/check/check.hpp>
#include <gnomon/pipeline.hpp>
#include <gnomon/scene.hpp>

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace gnomon::test {

/// Reads the finished maps just before they are looked up in.
class CascadeCapture final : public backend::Forward {
  public:
    using Forward::Forward;
    std::vector<std::uint16_t> codes;
    std::int32_t size_px = 512;
    std::uint32_t layers = 4;

    backend::Result<backend::Done> run(backend::Kernel const& kernel, backend::KernelCall const& call) override {
        if (kernel.name == "cascade_lookup") {
            std::size_t const texels = static_cast<std::size_t>(size_px) * static_cast<std::size_t>(size_px);
            codes.resize(layers * texels);
            for (std::uint32_t i = 0; i < layers; ++i)
                REQUIRE(target().read({call.targets[0].target, i, backend::Plane::depth, {0, 0, size_px, size_px}},
                                      std::as_writable_bytes(std::span(codes).subspan(i * texels, texels)))
                            .has_value());
        }
        return target().run(kernel, call);
    }
};

/// One technique, from frame to frame.
struct CascadeRunner {
    pipeline::Technique const* technique;
    pipeline::Params params;
    core::SerialExecutor executor;
    CascadeCapture device;
    pipeline::Workspace workspace;
    bool debug = false;

    CascadeRunner(backend::Backend& on, std::string const& name, std::vector<pipeline::Setting> const& settings = {}) : device(on) {
        technique = pipeline::find_technique(name).value();
        params = pipeline::make_params(*technique, settings).value();
    }
    ~CascadeRunner() { workspace.clear(); }

    pipeline::TechniqueOutput operator()(pipeline::Frame const& frame) {
        auto output = technique->run({frame, params, workspace, device, executor, debug});
        CAPTURE(output ? std::string() : output.failure().message);
        REQUIRE(output.has_value());
        return std::move(output).value();
    }
};

inline std::uint64_t count_of(pipeline::TechniqueOutput const& output, std::string_view name) {
    for (pipeline::Count const& count : output.counts)
        if (count.name == name) return count.value;
    return 0;
}

/// `town` along one of its paths, `moving` percent of its props under way.
struct Town {
    scene::Scene scene;
    scene::Geometry geometry;
    scene::Pose pose;
    scene::CameraPath path;
    core::SerialExecutor executor;
    bool truth = false;

    Town(std::string const& name, double moving) {
        scene::ProceduralConfig config;
        config.name = "town";
        config.moving_percent = moving;
        scene = scene::make_procedural(config).value();
        geometry = scene::flatten(scene);
        path = scene::make_path(config, name).value();
    }
    /// A small picture: what is looked at here is the maps.
    pipeline::Frame frame(std::size_t i) {
        scene::pose_at(scene, {static_cast<double>(i) / path.rate_hz}, pose);
        scene::update(geometry, scene, pose);
        math::View const view = scene::make_view(path.frames[i], math::ivec2(96, 54)).value();
        return pipeline::make_frame(scene, geometry, {.view = view, .light = scene.lights.front(), .truth = truth}, executor).value();
    }
};

}  // namespace gnomon::test
