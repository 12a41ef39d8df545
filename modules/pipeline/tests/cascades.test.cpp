// Cascades from frame to frame: what is kept gives the very maps that are drawn anew.

#include <gnomon/backend.hpp>
#include <gnomon/check/check.hpp>
#include <gnomon/pipeline.hpp>
#include <gnomon/raster/cpu_backend.hpp>
#include <gnomon/scene.hpp>

#include <array>
#include <cstdint>
#include <cstdio>
#include <string>
#include <vector>

namespace {

using namespace gnomon;

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

/// One technique on a backend of its own.
struct Runner {
    pipeline::Technique const* technique;
    pipeline::Params params;
    core::SerialExecutor executor;
    raster::CpuBackend cpu{executor};
    CascadeCapture device{cpu};
    pipeline::Workspace workspace;

    explicit Runner(std::string const& name, std::vector<pipeline::Setting> const& settings = {}) {
        technique = pipeline::find_technique(name).value();
        params = pipeline::make_params(*technique, settings).value();
    }
    ~Runner() { workspace.clear(); }

    pipeline::TechniqueOutput operator()(pipeline::Frame const& frame) {
        auto output = technique->run({frame, params, workspace, device, executor});
        REQUIRE(output.has_value());
        return std::move(output).value();
    }
};

std::uint64_t count_of(pipeline::TechniqueOutput const& output, std::string_view name) {
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
        return pipeline::make_frame(scene, geometry, {.view = view, .light = scene.lights.front(), .truth = false}, executor).value();
    }
};

struct Shares {
    std::array<double, 4> of_map{};
    std::uint64_t frames = 0;
    std::uint64_t redraws = 0;  ///< Whole ones, after the first frame.

    [[nodiscard]] double mean() const { return (of_map[0] + of_map[1] + of_map[2] + of_map[3]) / (4.0 * static_cast<double>(frames)); }
};

/// Flies along `path` and checks that both ways to keep maps give those that are drawn anew.
Shares fly(std::string const& path, double moving, std::size_t first, std::size_t end) {
    Town town(path, moving);
    Runner csm("csm"), cached("csm-cached"), scroll("csm-scroll");
    Shares shares;
    for (std::size_t i = first; i < end; ++i) {
        pipeline::Frame const frame = town.frame(i);
        auto const anew = csm(frame), kept = cached(frame), scrolled = scroll(frame);
        CHECK(cached.device.codes == csm.device.codes);
        CHECK(scroll.device.codes == csm.device.codes);
        CHECK(scrolled.visibility == anew.visibility);
        CHECK(kept.visibility == anew.visibility);
        if (i == first) continue;
        ++shares.frames;
        for (std::size_t k = 0; k < 4; ++k) {
            std::string const name = "triangles_map_" + std::to_string(k);
            shares.of_map[k] += static_cast<double>(count_of(scrolled, name)) / static_cast<double>(count_of(anew, name));
        }
        for (pipeline::Count const& reason : scrolled.redraw_reasons)
            shares.redraws += reason.name != "volume_moved" && reason.name != "member_joined" ? 1U : 0U;
    }
    std::printf("town %s, %g %% moving, %zu frames: triangles of csm-scroll over csm's %.3f (maps %.3f %.3f %.3f %.3f), %llu whole redraws\n",
                path.c_str(), moving, static_cast<std::size_t>(shares.frames), shares.mean(), shares.of_map[0] / static_cast<double>(shares.frames),
                shares.of_map[1] / static_cast<double>(shares.frames), shares.of_map[2] / static_cast<double>(shares.frames),
                shares.of_map[3] / static_cast<double>(shares.frames), static_cast<unsigned long long>(shares.redraws));
    return shares;
}

}  // namespace

TEST_CASE("maps that scroll are those drawn anew, along town's street with cars about", "[pipeline][cascade]") {
    CHECK(fly("street", 10, 40, 46).redraws == 0);
    CHECK(fly("spin", 0, 0, 5).redraws == 0);
}

TEST_CASE("at the paper's speeds maps that scroll draw few of the triangles", "[pipeline][cascade][.full]") {
    CHECK(fly("street", 0, 0, 150).mean() <= 0.12);
    CHECK(fly("spin", 0, 0, 150).mean() <= 0.18);
    CHECK(fly("street", 10, 0, 150).mean() < 0.5);
    CHECK(fly("both", 20, 0, 150).mean() < 0.6);
}
