// Whole frames on both backends: coverage, depth and ids of scenes from a camera and from a sun.

#include "pass_rig.hpp"

#include <gnomon/check/check.hpp>
#include <gnomon/projection/directional.hpp>
#include <gnomon/raster/triangle.hpp>
#include <gnomon/scene.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <deque>

using namespace gnomon;
using namespace gnomon::vulkan::test;

namespace {

/// A scene's triangles as draws: one for each primitive of each instance, in order.
struct SceneDraws {
    scene::Scene scene;
    scene::Geometry geometry;
    std::deque<backend::AlphaTest> tests;
    std::vector<backend::Draw> draws;
};

/// returns: whether the material draws anything.
bool set_alpha(SceneDraws& s, scene::Material const& material, backend::Draw& draw) {
    if (material.alpha_mode == scene::AlphaMode::opaque) return true;
    double const cutoff = material.alpha_mode == scene::AlphaMode::mask ? static_cast<double>(material.alpha_cutoff) : 0.5;
    std::uint32_t const texture = material.base_color_texture.texture;
    if (texture >= s.scene.textures.size() || s.scene.textures[texture].image >= s.scene.images.size() ||
        s.scene.images[s.scene.textures[texture].image].rgba.empty())
        return static_cast<double>(material.base_color.w) >= cutoff;
    scene::Texture const& t = s.scene.textures[texture];
    scene::Image const& image = s.scene.images[t.image];
    backend::AlphaTest test;
    test.uv = std::span<math::vec2 const>(s.geometry.uv);
    test.texture = {image.rgba, image.size_px, t.wrap_u, t.wrap_v};
    test.factor = static_cast<double>(material.base_color.w);
    test.cutoff = cutoff;
    s.tests.push_back(test);
    draw.alpha_test = &s.tests.back();
    return true;
}

void make_draws(SceneDraws& s) {
    s.geometry = scene::flatten(s.scene);
    for (scene::Range const& range : s.geometry.ranges) {
        backend::Draw draw;
        draw.positions = std::span<math::vec3 const>(s.geometry.positions);
        draw.indices = std::span<std::uint32_t const>(s.geometry.indices)
                           .subspan(std::size_t{range.first_triangle} * 3, std::size_t{range.triangle_count} * 3);
        draw.first_triangle = range.first_triangle;
        scene::Material const& material = s.scene.materials[range.material];
        draw.cull = material.double_sided ? backend::Cull::none : backend::Cull::back;
        if (set_alpha(s, material, draw)) s.draws.push_back(draw);
    }
}

/// What a frame's pixels tell, those of triangles apart that the clipper cut.
struct Frame {
    std::uint64_t covered = 0;
    std::uint64_t coverage = 0;  ///< Covered by one backend only.
    std::uint64_t edges = 0;     ///< Covered by both, but with another surface.
    std::uint64_t masked = 0;    ///< Of either kind, but at an alpha-tested triangle.
    std::uint64_t ties = 0;      ///< Other ids, depths within 2e-6.
    double worst = 0.0;          ///< Of one triangle's depths, where they change by less than 1/32 a pixel.
    std::uint64_t steep = 0;     ///< One triangle's depths, more than 2e-6 apart, where they change by more.
    double steep_px = 0.0;       ///< The most such depths are apart, in pixels along the surface.
    double steep_cpu = 0.0;      ///< The most that the CPU's are from the plane through the unsnapped corners,
    double steep_gpu = 0.0;      ///< and the device's.
    std::uint64_t slivers = 0;   ///< The same of triangles thinner than 1/45 pixel.
    std::uint64_t by_device = 0;  ///< Steep or sliver, the device alone more than 2e-6 from the plane.
    std::uint64_t clipped = 0;        ///< Covered by triangles that were cut.
    std::uint64_t clipped_apart = 0;  ///< Of these: any of the above, or depths more than 2e-6 apart.
};

/// How steep a triangle's depth is and how thin it is, in double, before it is snapped.
struct Shape {
    double slope;     ///< |dz/dx| + |dz/dy| a pixel.
    double height_px;  ///< Over its longest side.
    double gx, gy, constant;  ///< Depth at (x, y) is gx x + gy y + constant.
};

Shape shape_of(SceneDraws const& s, backend::PassLayer const& layer, int size_px, std::uint32_t triangle) {
    double x[3];
    double y[3];
    double z[3];
    math::mat4 const& m = layer.clip_from_relative;
    for (std::size_t k = 0; k < 3; ++k) {
        math::vec3 const p = s.geometry.positions[s.geometry.indices[3 * triangle + k]] - layer.origin;
        double c[4];
        for (math::axis_t r = 0; r < 4; ++r)
            c[r] = static_cast<double>(((m[0][r] * p.x + m[1][r] * p.y) + m[2][r] * p.z) + m[3][r]);
        x[k] = (c[0] / c[3] + 1.0) * size_px / 2.0;
        y[k] = (c[1] / c[3] + 1.0) * size_px / 2.0;
        z[k] = c[2] / c[3];
    }
    double const ax = x[1] - x[0], ay = y[1] - y[0], bx = x[2] - x[0], by = y[2] - y[0];
    double const area = ax * by - ay * bx;
    double const gx = ((z[1] - z[0]) * by - (z[2] - z[0]) * ay) / area;
    double const gy = ((z[2] - z[0]) * ax - (z[1] - z[0]) * bx) / area;
    double const longest = std::sqrt(std::max({ax * ax + ay * ay, bx * bx + by * by, std::pow(bx - ax, 2) + std::pow(by - ay, 2)}));
    return {std::abs(gx) + std::abs(gy), std::abs(area) / longest, gx, gy, z[0] - gx * x[0] - gy * y[0]};
}

/// Which triangles reach beyond the near or far plane or the guard band.
std::vector<bool> clipped_triangles(SceneDraws const& s, backend::PassLayer const& layer, int size_px) {
    raster::ViewportTransform const viewport = raster::make_viewport({0, 0, size_px, size_px}, true);
    std::vector<std::uint8_t> outside(s.geometry.positions.size());
    math::mat4 const& m = layer.clip_from_relative;
    for (std::size_t i = 0; i < outside.size(); ++i) {
        math::vec3 const p = s.geometry.positions[i] - layer.origin;
        math::vec4 clip(0.0F);
        for (math::axis_t r = 0; r < 4; ++r) clip[r] = ((m[0][r] * p.x + m[1][r] * p.y) + m[2][r] * p.z) + m[3][r];
        outside[i] = raster::outcode(clip, viewport) != 0 ? 1 : 0;
    }
    std::vector<bool> clipped(s.geometry.indices.size() / 3);
    for (std::size_t t = 0; t < clipped.size(); ++t)
        for (std::size_t k = 0; k < 3; ++k)
            if (outside[s.geometry.indices[3 * t + k]] != 0) clipped[t] = true;
    return clipped;
}

std::vector<bool> masked_triangles(SceneDraws const& s) {
    std::vector<bool> masked(s.geometry.indices.size() / 3);
    for (backend::Draw const& draw : s.draws)
        for (std::size_t t = 0; draw.alpha_test != nullptr && t < backend::triangle_count(draw); ++t)
            masked[draw.first_triangle + t] = true;
    return masked;
}

struct Compared {
    SceneDraws const& scene;
    backend::PassLayer const& layer;
    int size_px;
};

/// Adds what two depths of one triangle at pixel `i` say.
void add_depth(Frame& f, Compared const& of, std::size_t i, Pixels const& cpu, Pixels const& gpu) {
    std::uint32_t const triangle = cpu.triangle[i];
    auto const a = static_cast<double>(cpu.depth[i]);
    auto const b = static_cast<double>(gpu.depth[i]);
    double const apart = std::abs(a - b);
    if (apart <= f.worst) return;
    Shape const shape = shape_of(of.scene, of.layer, of.size_px, triangle);
    bool const sliver = shape.height_px < 1.0 / 45.0;
    if (!sliver && shape.slope <= 1.0 / 32.0) {
        f.worst = apart;
        return;
    }
    if (apart <= 2e-6) return;
    auto const size = static_cast<std::size_t>(of.size_px);
    double const exact = shape.gx * (static_cast<double>(i % size) + 0.5) +
                         shape.gy * (static_cast<double>(i / size) + 0.5) + shape.constant;
    ++(sliver ? f.slivers : f.steep);
    f.by_device += std::abs(b - exact) > 2e-6 ? 1U : 0U;
    if (sliver) return;
    f.steep_px = std::max(f.steep_px, apart / shape.slope);
    f.steep_cpu = std::max(f.steep_cpu, std::abs(a - exact));
    f.steep_gpu = std::max(f.steep_gpu, std::abs(b - exact));
}

Frame compare_frames(Compared const& of, Pixels const& cpu, Pixels const& gpu) {
    std::vector<bool> const masked = masked_triangles(of.scene);
    std::vector<bool> const clipped = clipped_triangles(of.scene, of.layer, of.size_px);
    auto const is = [](std::vector<bool> const& which, std::uint32_t triangle) {
        return triangle != backend::no_triangle && which[triangle];
    };
    Frame f;
    for (std::size_t i = 0; i < cpu.depth.size(); ++i) {
        std::uint32_t const a = cpu.triangle[i];
        std::uint32_t const b = gpu.triangle[i];
        double const apart = std::abs(static_cast<double>(cpu.depth[i]) - static_cast<double>(gpu.depth[i]));
        bool const one_only = (a == backend::no_triangle) != (b == backend::no_triangle);
        f.covered += a != backend::no_triangle ? 1U : 0U;
        if (is(clipped, a) || is(clipped, b)) {
            ++f.clipped;
            f.clipped_apart += one_only || apart > 2e-6 ? 1U : 0U;
        } else if (a == b) {
            if (a != backend::no_triangle) add_depth(f, of, i, cpu, gpu);
        } else if (!one_only && apart <= 2e-6) {
            ++f.ties;
        } else if (is(masked, a) || is(masked, b)) {
            ++f.masked;
        } else {
            ++(one_only ? f.coverage : f.edges);
        }
    }
    return f;
}

struct View {
    char const* name;
    math::View view;
};

std::array<View, 2> views_of(SceneDraws const& s, int size_px) {
    scene::SuggestedView const at = scene::auto_view(s.geometry);
    math::View const camera = math::make_perspective({.eye_m = at.eye_m,
                                                      .target_m = at.target_m,
                                                      .fov_y_rad = at.fov_y_rad,
                                                      .near_m = at.near_m,
                                                      .size_px = {size_px, size_px}})
                                  .value();
    projection::DirectionalConfig config;
    config.origin_m = s.geometry.origin_m;
    config.size_px = {size_px, size_px};
    math::View const sun =
        projection::directional_view({-0.45, -0.80, -0.40}, s.geometry.bounds, s.geometry.bounds, config).value();
    return {View{"camera", camera}, View{"sun", sun}};
}

void print_row(std::string const& name, View const& view, int size_px, Frame const& f) {
    auto const n = [](std::uint64_t value) { return std::to_string(value); };
    char numbers[96];
    std::snprintf(numbers, sizeof numbers, "%.2f | %llu | %.5f | %.2f | %.2f", f.worst * 1e6,
                  static_cast<unsigned long long>(f.steep), f.steep_px, f.steep_cpu * 1e6, f.steep_gpu * 1e6);
    std::puts(("| " + name + " | " + view.name + " | " + std::to_string(size_px) + " | " + n(f.covered) + " | " +
               n(f.coverage) + " | " + n(f.edges) + " | " + n(f.masked) + " | " + n(f.ties) + " | " + numbers + " | " +
               n(f.slivers) + " | " + n(f.by_device) + " | " + n(f.clipped) + " | " + n(f.clipped_apart) + " |")
                  .c_str());
}

void check_frames(PassRig& rig, SceneDraws const& s, std::string const& name, int size_px, bool prints) {
    for (View const& view : views_of(s, size_px)) {
        backend::PassLayer layer;
        layer.origin = scene::to_work_space(s.geometry, view.view.eye_m);
        layer.clip_from_relative = math::clip_from_relative(view.view);
        backend::TargetConfig const config{.size_px = {size_px, size_px}, .triangle_ids = true};
        std::vector<std::vector<backend::PassLayer>> const passes{{layer}};
        Pixels const cpu = draw_on_cpu(s.draws, config, passes);
        Pixels const gpu = rig.draw_all(s.draws, config, passes);
        Frame const f = compare_frames({s, layer, size_px}, cpu, gpu);
        if (prints) print_row(name, view, size_px, f);
        INFO(name + ", " + view.name + ", " + std::to_string(size_px) + " px");
        CHECK(f.covered > 1000);
        CHECK(f.coverage + f.edges + f.masked <= 5);
        CHECK(f.worst <= 2e-6);
        CHECK(f.steep <= f.covered / 4000);
        CHECK(f.steep_px <= 0x1p-13);
        CHECK(f.slivers <= f.covered / 4000);
        CHECK(f.clipped_apart <= 5 + f.clipped / 1000);
    }
}

constexpr char const* heading =
    "| scene | view | px | covered | coverage | edges | masked | ties | depth, e-6 | steep | steep, px | cpu, e-6 | gpu, e-6 | slivers | by the device "
    "| clipped | of these apart |\n|---|---|---|---|---|---|---|---|---|---|---|---|---|---|---|---|---|";

}  // namespace

TEST_CASE("a city from the street and from the sun is the CPU's frame", "[vulkan][frames]") {
    auto const device = Device::make();
    REQUIRE(device != nullptr);
    SceneDraws s;
    auto city = scene::make_procedural({"city", 52'000, 1, 0.0, 0});
    REQUIRE(city);
    s.scene = *std::move(city);
    make_draws(s);
    PassRig rig(*device, device->gpu());
    check_frames(rig, s, "city", 512, false);
    CHECK(device->take_messages() == "");
}

TEST_CASE("frames of six scenes are the CPU's", "[vulkan][frames][.full]") {
    char const* const folder = std::getenv("GNOMON_SCENES_DIR");
    if (folder == nullptr) SKIP("GNOMON_SCENES_DIR names no folder of scenes");
    auto const device = Device::make();
    REQUIRE(device != nullptr);
    PassRig rig(*device, device->gpu());
    std::puts(heading);
    for (char const* name : {"sponza/scene.glb", "kaykit_city/scene.gltf", "eztree_forest/scene.gltf",
                             "classic_meshes/scene.gltf", "broken_house/scene.glb", "scanned_living_room/scene.gltf"}) {
        SceneDraws s;
        auto loaded = scene::load_gltf(std::string(folder) + "/" + name);
        INFO(std::string(name) + (loaded ? std::string() : ": " + loaded.failure().message));
        REQUIRE(loaded);
        s.scene = *std::move(loaded);
        make_draws(s);
        for (int size_px : {512, 1024}) check_frames(rig, s, std::string(name).substr(0, std::string(name).find('/')), size_px, true);
    }
    CHECK(device->take_messages() == "");
}
