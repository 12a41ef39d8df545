// The technique `shadow-map` on both backends, over the same samples: the bias is the same bit for bit, and the
// visibility differs only where a texel that the filter reads does.

#include "test_host.hpp"

#include <gnomon/backend/forward.hpp>
#include <gnomon/check/check.hpp>
#include <gnomon/core/executor_threads.hpp>
#include <gnomon/pipeline.hpp>
#include <gnomon/projection/cube.hpp>
#include <gnomon/raster/cpu_backend.hpp>
#include <gnomon/scene.hpp>
#include <gnomon/shadow.hpp>

#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <string>
#include <vector>

using namespace gnomon;

namespace {

/// Reads what the lookup reads: the maps' views and their texels.
class MapCapture final : public backend::Forward {
  public:
    using Forward::Forward;
    backend::TargetConfig config;
    std::vector<shadow::MapView> views;
    std::vector<std::byte> texels;

    backend::Result<backend::TargetId> make_target(backend::TargetConfig const& wanted) override {
        config = wanted;
        return target().make_target(wanted);
    }
    backend::Result<core::Done> run(backend::Kernel const& kernel, backend::KernelCall const& call) override {
        REQUIRE(kernel.name == "shadow_lookup");
        views.resize(config.layers);
        REQUIRE(target().read(call.buffers[3], 0, std::as_writable_bytes(std::span(views))));
        std::size_t const bytes = static_cast<std::size_t>(config.size_px.x * config.size_px.y) *
                                  bytes_per_pixel(config, backend::Plane::depth);
        texels.resize(bytes * config.layers);
        for (std::uint32_t layer = 0; layer < config.layers; ++layer)
            REQUIRE(target().read(
                {call.targets[0].target, layer, backend::Plane::depth, {0, 0, config.size_px.x, config.size_px.y}},
                std::span(texels).subspan(layer * bytes, bytes)));
        return target().run(kernel, call);
    }
};

struct Side {
    std::vector<shadow::MapView> views;
    backend::TargetConfig config;
    std::vector<std::byte> texels;
    pipeline::TechniqueOutput output;

    /// The texel's bits.
    [[nodiscard]] std::uint32_t bits(std::size_t map, std::int32_t x, std::int32_t y) const {
        std::size_t const width = bytes_per_pixel(config, backend::Plane::depth);
        std::size_t const texel = (map * static_cast<std::size_t>(config.size_px.y) + static_cast<std::size_t>(y)) *
                                      static_cast<std::size_t>(config.size_px.x) +
                                  static_cast<std::size_t>(x);
        std::uint32_t value = 0;
        std::memcpy(&value, texels.data() + texel * width, width);
        return value;
    }
    /// The depth that they mean.
    [[nodiscard]] double depth(std::size_t map, std::int32_t x, std::int32_t y) const {
        std::uint32_t const b = bits(map, x, y);
        return config.depth == backend::DepthFormat::unorm16 ? b / 65535.0
                                                             : static_cast<double>(std::bit_cast<float>(b));
    }
};

using Settings = std::vector<pipeline::Setting>;

Side shadow_map_on(backend::Backend& device, pipeline::Frame const& frame, pipeline::Params const& params) {
    core::ThreadExecutor const executor(2);
    MapCapture capture(device);
    pipeline::Technique const* const technique = pipeline::find_technique("shadow-map").value();
    pipeline::Workspace workspace;
    pipeline::TechniqueRun const on{frame, params, workspace, capture, executor};
    auto output = technique->run(on);
    if (!output) FAIL(output.failure().message);
    REQUIRE(output->stages.size() == 3);
    for (pipeline::StageTime const& stage : output->stages) CHECK(stage.ms > 0.0);
    Side side{std::move(capture.views), capture.config, std::move(capture.texels), std::move(output).value()};
    REQUIRE(technique->examine(on, side.output));
    return side;
}

struct MapTally {
    std::uint64_t samples = 0, shadowed = 0;
    std::uint64_t texels = 0, other_texels = 0;  ///< Of the maps; with other bits.
    std::uint64_t other_coverage = 0;            ///< Drawn on one side, not on the other.
    std::uint64_t far_apart = 0;  ///< Depths: at an edge between surfaces, on triangles seen nearly edge on.
    std::uint64_t other_visibility = 0, other_bias = 0;
    std::uint64_t unexplained = 0;  ///< Other visibility, though all texels read are the same.
    std::uint64_t other_owner = 0;  ///< Of `own_hit`.
};

void compare_texels(Side const& cpu, Side const& gpu, bool reversed, MapTally& tally) {
    double const farthest = reversed ? 0.0 : 1.0;
    // A code, or twice the passes' 2e-6: a clipped triangle's depth has a second rounding.
    double const rounding = cpu.config.depth == backend::DepthFormat::unorm16 ? 1.001 / 65535.0 : 4e-6;
    for (std::size_t map = 0; map < cpu.views.size(); ++map)
        for (std::int32_t y = 0; y < cpu.config.size_px.y; ++y)
            for (std::int32_t x = 0; x < cpu.config.size_px.x; ++x) {
                ++tally.texels;
                if (cpu.bits(map, x, y) == gpu.bits(map, x, y)) continue;
                ++tally.other_texels;
                double const a = cpu.depth(map, x, y);
                double const b = gpu.depth(map, x, y);
                if ((a == farthest) != (b == farthest))
                    ++tally.other_coverage;
                else if (std::abs(a - b) > rounding)
                    ++tally.far_apart;
            }
}

/// Whether a texel that the lookup of sample `i` reads differs.
bool reads_other_texels(Side const& cpu, Side const& gpu, pipeline::Frame const& frame, pipeline::Params const& params,
                        std::size_t i) {
    math::vec3 const& position = frame.samples.position[i];
    std::size_t const map =
        cpu.views.size() == 1 ? 0 : static_cast<std::size_t>(projection::face_of(position - frame.light_position));
    int const taps = params.integer("pcf");
    shadow::LookupConfig config;  // Of the bias only the normal offset moves the texels.
    config.bias.normal_offset = static_cast<float>(params.number("normal"));
    config.bias.unit = params.word("unit") == "m" ? shadow::BiasUnit::metres : shadow::BiasUnit::texels;
    shadow::Prepared const ready = shadow::prepare(cpu.views[map], position, frame.samples.normal[i], config);
    shadow::TapRow const columns = shadow::taps_at(ready.receiver.texel.x, taps);
    shadow::TapRow const rows = shadow::taps_at(ready.receiver.texel.y, taps);
    for (std::int32_t y = rows.first; y < rows.first + taps; ++y)
        for (std::int32_t x = columns.first; x < columns.first + taps; ++x) {
            bool const inside = x >= 0 && y >= 0 && x < cpu.config.size_px.x && y < cpu.config.size_px.y;
            if (inside && cpu.bits(map, x, y) != gpu.bits(map, x, y)) return true;
        }
    return false;
}

bool same_views(Side const& cpu, Side const& gpu) {
    return cpu.views.size() == gpu.views.size() &&
           std::memcmp(cpu.views.data(), gpu.views.data(), cpu.views.size() * sizeof(shadow::MapView)) == 0;
}

MapTally compare_maps(backend::Backend& device, pipeline::Frame const& frame, Settings const& settings) {
    core::ThreadExecutor const executor(2);
    raster::CpuBackend host(executor);
    pipeline::Technique const* const technique = pipeline::find_technique("shadow-map").value();
    pipeline::Params const params = pipeline::make_params(*technique, settings).value();
    Side const cpu = shadow_map_on(host, frame, params);
    Side const gpu = shadow_map_on(device, frame, params);
    REQUIRE(same_views(cpu, gpu));
    MapTally tally;
    tally.samples = frame.samples.size();
    compare_texels(cpu, gpu, params.word("depth") == "reversed", tally);
    for (std::size_t i = 0; i < tally.samples; ++i) {
        float const a = cpu.output.visibility[i];
        float const b = gpu.output.visibility[i];
        tally.shadowed += a < 0.5F ? 1U : 0U;
        tally.other_owner += cpu.output.own_hit[i] != gpu.output.own_hit[i] ? 1U : 0U;
        if (std::bit_cast<std::uint32_t>(cpu.output.bias_m[i]) != std::bit_cast<std::uint32_t>(gpu.output.bias_m[i]))
            ++tally.other_bias;
        if (std::bit_cast<std::uint32_t>(a) == std::bit_cast<std::uint32_t>(b)) continue;
        ++tally.other_visibility;
        bool const by_map = reads_other_texels(cpu, gpu, frame, params, i);
        tally.unexplained += by_map ? 0U : 1U;
        math::vec3 const& p = frame.samples.position[i];
        std::printf("  sample %zu at (%.7g, %.7g, %.7g): %.4f on the CPU, %.4f on the device; %s\n", i,
                    static_cast<double>(p.x), static_cast<double>(p.y), static_cast<double>(p.z),
                    static_cast<double>(a), static_cast<double>(b), by_map ? "reads another texel" : "unexplained");
    }
    return tally;
}

void check_maps(backend::Backend& device, pipeline::Frame const& frame, std::string const& name,
                Settings const& settings) {
    std::string title = name;
    for (pipeline::Setting const& s : settings) title += " " + s.name + "=" + s.text;
    MapTally const t = compare_maps(device, frame, settings);
    std::printf(
        "%s: of %llu texels %llu have other bits, %llu other coverage, %llu far apart; of %llu samples (%llu in "
        "shadow) "
        "%llu have another visibility\n",
        title.c_str(), static_cast<unsigned long long>(t.texels), static_cast<unsigned long long>(t.other_texels),
        static_cast<unsigned long long>(t.other_coverage), static_cast<unsigned long long>(t.far_apart),
        static_cast<unsigned long long>(t.samples), static_cast<unsigned long long>(t.shadowed),
        static_cast<unsigned long long>(t.other_visibility));
    CAPTURE(title);
    CHECK(t.samples > 1'000);
    CHECK((t.shadowed > t.samples / 50 && t.shadowed < t.samples));
    CHECK(t.other_coverage <= 5);
    CHECK(t.far_apart <= 5 + t.texels / 5'000);
    CHECK(t.other_bias == 0);
    CHECK(t.unexplained == 0);
    CHECK(t.other_visibility <= t.samples / 200);
    CHECK(t.other_owner <= t.samples / 200);
}

struct TechniqueStage {
    scene::Scene scene;
    scene::Geometry geometry;
    math::View view;
};

TechniqueStage stage_of(scene::Scene made, int size_px) {
    TechniqueStage stage{std::move(made), {}, {}};
    stage.geometry = scene::flatten(stage.scene);
    scene::SuggestedView const suggested = scene::auto_view(stage.geometry);
    math::PerspectiveConfig config;
    config.eye_m = suggested.eye_m;
    config.target_m = suggested.target_m;
    config.fov_y_rad = suggested.fov_y_rad;
    config.near_m = suggested.near_m;
    config.size_px = math::ivec2(size_px, size_px);
    stage.view = math::make_perspective(config).value();
    return stage;
}

pipeline::Frame frame_of_stage(TechniqueStage const& stage, pipeline::Light const& light) {
    core::ThreadExecutor const executor(2);
    return pipeline::make_frame(stage.scene, stage.geometry, stage.view, light, executor).value();
}

std::array<pipeline::Light, 3> lights_of(TechniqueStage const& stage) {
    math::Aabb const& bounds = stage.geometry.bounds;
    math::vec3 const size = bounds.hi - bounds.lo;
    math::dvec3 const lamp =
        math::to_double(bounds.lo + size * math::vec3(0.4F, 1.4F, 0.45F)) + stage.geometry.origin_m;
    pipeline::Light spot = pipeline::bulb(lamp);
    spot.kind = pipeline::LightKind::spot;
    spot.direction = math::dvec3(0.1, -1.0, 0.2);
    spot.outer_cone_rad = 1.0F;
    return {pipeline::sun(math::dvec3(-0.45, -0.8, -0.4)), pipeline::bulb(lamp), spot};
}

/// Runs `use(device)` on a validated device, and looks for messages and leaks.
template <class Use>
void on_vulkan(Use&& use) {
    auto const device = vulkan::test::Device::make();
    REQUIRE(device != nullptr);
    {
        vulkan::test::TestHost host(*device);
        auto const backend = vulkan::Backend::make(device->gpu(), host.host());
        REQUIRE(backend);
        use(**backend);
    }
    CHECK(device->take_messages() == "");
    CHECK(device->live().total() == 0);
}

}  // namespace

TEST_CASE("shadow maps of both backends differ in few texels, and lookups only where texels do",
          "[vulkan][technique]") {
    scene::ProceduralConfig config;
    config.name = "city";
    config.triangles = 52'000;
    TechniqueStage const stage = stage_of(scene::make_procedural(config).value(), 96);
    auto const lights = lights_of(stage);
    on_vulkan([&](backend::Backend& device) {
        pipeline::Frame const sun = frame_of_stage(stage, lights[0]);
        check_maps(device, sun, "sun", {{"resolution", "512"}});
        check_maps(device, sun, "sun", {{"resolution", "512"}, {"format", "unorm16"}, {"pcf", "5"}});
        check_maps(device, sun, "sun",
                   {{"resolution", "333"},
                    {"depth", "forward"},
                    {"bias", "manual"},
                    {"constant", "1.5"},
                    {"slope", "2"},
                    {"pcf", "1"},
                    {"plane", "off"}});
        check_maps(device, sun, "sun", {{"resolution", "512"}, {"cull", "front"}, {"normal", "1"}, {"pcf", "4"}});
        check_maps(device, frame_of_stage(stage, lights[1]), "lamp", {{"resolution", "256"}});
        check_maps(device, frame_of_stage(stage, lights[2]), "spot", {{"resolution", "400"}, {"depth", "forward"}});
    });
}

TEST_CASE("shadow maps of both backends agree in six scenes", "[.full][vulkan][technique]") {
    char const* const folder = std::getenv("GNOMON_SCENES_DIR");
    if (folder == nullptr) SKIP("GNOMON_SCENES_DIR names no folder of scenes");
    for (char const* const name : {"sponza/scene.glb", "kaykit_city/scene.gltf", "eztree_forest/scene.gltf",
                                   "classic_meshes/scene.gltf", "broken_house/scene.glb", "scanned_living_room/scene.gltf"}) {
        auto loaded = scene::load_gltf(std::string(folder) + "/" + name);
        REQUIRE(loaded);
        TechniqueStage const stage = stage_of(std::move(loaded).value(), 512);
        on_vulkan([&](backend::Backend& device) {
            for (pipeline::Light const& light : lights_of(stage))
                check_maps(device, frame_of_stage(stage, light), name, {{"resolution", "1024"}});
        });
    }
}
