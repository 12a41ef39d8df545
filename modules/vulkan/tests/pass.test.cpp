#include "pass_rig.hpp"
#include "pass_scenes.hpp"

#include <gnomon/check/check.hpp>

#include <algorithm>
#include <array>
#include <cmath>

using namespace gnomon;
using namespace gnomon::vulkan::test;

namespace {

using Passes = std::vector<std::vector<backend::PassLayer>>;

/// Both backends' images are the same: coverage, but for a pixel, or one in six layers, at an edge whose corner the two
/// round to different 1/256 (the order of the viewport's float operations is the device's own); depth within 2e-6 or one
/// code, but for a pixel of a sliver, whose plane is steep; ids, but for depths that tie within that.
void check_images(Pixels const& cpu, Pixels const& gpu, backend::TargetConfig const& config, math::Depth depth) {
    bool const is_f32 = config.depth == backend::DepthFormat::f32;
    bool const reversed = depth == math::Depth::reversed;
    Difference const d = is_f32 ? difference_of(cpu, gpu, reversed ? 0.0F : 1.0F)
                                : difference_of_codes(cpu, gpu, reversed ? 0.0F : 65535.0F);
    INFO(d.text());
    CHECK(d.covered > 0);
    CHECK(d.coverage + d.other_surface <= std::max(1U, config.layers / 6));
    CHECK(d.worst <= (is_f32 ? 2e-6 : 1.0));
    CHECK(d.beyond <= 1);
    CHECK(d.other_id <= d.covered / 5000);
}

void check_same(PassRig& rig, std::span<backend::Draw const> draws, backend::TargetConfig const& config,
                Passes const& passes) {
    check_images(draw_on_cpu(draws, config, passes), rig.draw_all(draws, config, passes), config,
                 passes.front().front().depth);
}

/// With all features, and without those of each fallback in turn.
std::vector<vulkan::Features> with_fallbacks(vulkan::Features const& all) {
    std::vector<vulkan::Features> list(8, all);
    list[1].multi_draw_indirect = false;
    list[2].draw_indirect_first_instance = false;
    list[3].layer_from_vertex_shader = false;
    list[4].geometry_shader = false;
    list[5].geometry_shader = list[5].layer_from_vertex_shader = false;
    list[6].depth_clamp = false;
    list[7] = vulkan::Features{};
    return list;
}

/// Six views round the soup, each in a layer of its own.
std::vector<backend::PassLayer> views_of_layers(math::ivec2 size_px) {
    std::vector<backend::PassLayer> layers;
    for (std::uint32_t i = 0; i < 6; ++i) {
        double const angle = 0.15 * i;
        backend::PassLayer layer = layer_of(camera(size_px, math::Depth::reversed, {angle * 3.0, 0.4 * i - 1.0, 1.0 + angle}));
        layer.layer = 5 - i;
        layers.push_back(layer);
    }
    return layers;
}

bool is_before_near(backend::PassLayer const& layer, math::vec3 const& position) {
    math::vec3 const p = position - layer.origin;
    math::mat4 const& m = layer.clip_from_relative;
    float const z = ((m[0].z * p.x + m[1].z * p.y) + m[2].z * p.z) + m[3].z;
    float const w = ((m[0].w * p.x + m[1].w * p.y) + m[2].w * p.z) + m[3].w;
    return z > w;
}

double determinant(double const (&m)[3][3]) {
    return m[0][0] * (m[1][1] * m[2][2] - m[1][2] * m[2][1]) - m[0][1] * (m[1][0] * m[2][2] - m[1][2] * m[2][0]) +
           m[0][2] * (m[1][0] * m[2][1] - m[1][1] * m[2][0]);
}

/// |dz/dx| + |dz/dy| a pixel, from the homogeneous corners, wherever they are: z = a x + b y + c w.
double slope_a_pixel(backend::PassLayer const& layer, Soup const& soup, std::uint32_t triangle, int size_px) {
    double corner[3][3];
    double z[3];
    math::mat4 const& m = layer.clip_from_relative;
    for (std::size_t k = 0; k < 3; ++k) {
        math::vec3 const p = soup.positions[soup.indices[3 * triangle + k]] - layer.origin;
        double clip[4];
        for (math::axis_t r = 0; r < 4; ++r)
            clip[r] = static_cast<double>(((m[0][r] * p.x + m[1][r] * p.y) + m[2][r] * p.z) + m[3][r]);
        corner[k][0] = clip[0];
        corner[k][1] = clip[1];
        corner[k][2] = clip[3];
        z[k] = clip[2];
    }
    double sum = 0.0;
    for (int axis = 0; axis < 2; ++axis) {
        double with_z[3][3];
        for (int k = 0; k < 3; ++k)
            for (int c = 0; c < 3; ++c) with_z[k][c] = c == axis ? z[k] : corner[k][c];
        sum += std::abs(determinant(with_z) / determinant(corner));
    }
    return sum * 2.0 / size_px;
}

}  // namespace

TEST_CASE("a pass on the device draws what the CPU draws, in both depth directions and formats", "[vulkan][pass]") {
    auto const device = Device::make();
    REQUIRE(device != nullptr);
    {
        PassRig rig(*device, device->gpu());
        for (math::Depth depth : {math::Depth::reversed, math::Depth::forward})
            for (bool ids : {false, true}) {
                Soup const soup = make_soup(7, 300, 0.7F);
                backend::Draw const draw = soup.draw();
                backend::TargetConfig config{.size_px = {200, 150}, .triangle_ids = ids};
                check_same(rig, {&draw, 1}, config, {{layer_of(camera(config.size_px, depth))}});
                if (ids) continue;
                config.depth = backend::DepthFormat::unorm16;
                check_same(rig, {&draw, 1}, config, {{layer_of(camera(config.size_px, depth))}});
            }
    }
    CHECK(device->live().total() == 0);
    CHECK(device->take_messages() == "");
}

TEST_CASE("layers, groups, culling, instances and clamped depth are the CPU's with every fallback", "[vulkan][pass]") {
    auto const device = Device::make();
    REQUIRE(device != nullptr);
    Soup const soups[3] = {make_soup(1, 90, 0.8F), make_soup(2, 70, 0.6F), make_soup(3, 20, 0.4F)};
    std::vector<math::mat4> places(5, math::mat4(1.0F));
    for (std::size_t i = 0; i < places.size(); ++i) {
        places[i][3] = math::vec4(static_cast<float>(i) * 0.7F - 1.4F, 0.3F, -0.2F * static_cast<float>(i), 1.0F);
        places[i][0][1] = 0.3F;
    }
    std::vector<backend::Draw> draws;
    for (std::size_t i = 0; i < 6; ++i) {
        backend::Draw draw = soups[i % 3].draw();
        draw.cull = static_cast<backend::Cull>(i % 3);
        draw.first_triangle = static_cast<std::uint32_t>(1000 * i);
        draw.groups = i == 4 ? 2 : 1;
        draws.push_back(draw);
    }
    draws[2].instances = core::StridedSpan<math::mat4>(std::span<math::mat4 const>(places));
    for (vulkan::Features const& features : with_fallbacks(device->features())) {
        PassRig rig(*device, device->gpu_with(features));
        for (bool ids : {false, true}) {
            backend::TargetConfig const config{.size_px = {96, 80}, .layers = 6, .triangle_ids = ids};
            Passes passes{views_of_layers(config.size_px)};
            passes[0][1].groups = 2;
            passes[0][2].groups = 3;
            passes[0][3].range = backend::DepthRange::clamp;
            check_same(rig, draws, config, passes);
        }
    }
    CHECK(device->live().total() == 0);
    CHECK(device->take_messages() == "");
}

TEST_CASE("of equal depths the first drawn stays, whatever its culling; ids change no depth", "[vulkan][pass]") {
    auto const device = Device::make();
    REQUIRE(device != nullptr);
    Soup const soup = make_soup(21, 60, 1.0F);
    std::vector<backend::Draw> draws(6, soup.draw());
    for (std::size_t i = 0; i < draws.size(); ++i) {
        draws[i].first_triangle = static_cast<std::uint32_t>(100 * i);
        draws[i].cull = static_cast<backend::Cull>((i + 1) % 3);
    }
    vulkan::Features none;
    for (vulkan::Features const& features : {device->features(), none}) {
        PassRig rig(*device, device->gpu_with(features));
        Passes const passes{{layer_of(camera({128, 128}))}};
        Pixels const cpu = draw_on_cpu(draws, {.size_px = {128, 128}, .triangle_ids = true}, passes);
        Pixels const gpu = rig.draw_all(draws, {.size_px = {128, 128}, .triangle_ids = true}, passes);
        Pixels const plain = rig.draw_all(draws, {.size_px = {128, 128}}, passes);
        CHECK(gpu.depth == plain.depth);
        std::size_t others = 0;
        for (std::size_t i = 0; i < gpu.triangle.size(); ++i) others += gpu.triangle[i] != cpu.triangle[i] ? 1U : 0U;
        CHECK(others <= 2);  // Of 16,384: an edge, or two soups' triangles that meet.
    }
    CHECK(device->take_messages() == "");
}

TEST_CASE("of triangles cut by the near plane coverage differs by less than a pixel in eight cut edges, depth by less "
          "than 1/16 pixel's change",
          "[vulkan][pass]") {
    auto const device = Device::make();
    REQUIRE(device != nullptr);
    PassRig rig(*device, device->gpu());
    std::uint64_t cut_edges = 0;
    std::uint64_t apart = 0;
    std::uint64_t too_far = 0;
    for (std::uint64_t seed = 0; seed < 12; ++seed) {
        Random random{seed + 900};
        Soup soup;
        for (int i = 0; i < 60; ++i)
            for (int k = 0; k < 3; ++k) {
                float const far = i % 6 == 0 ? 3000.0F : 3.0F;
                soup.indices.push_back(static_cast<std::uint32_t>(soup.positions.size()));
                soup.positions.push_back({random.in(-far, far), random.in(-far, far), random.in(-8, 3)});
            }
        backend::Draw const draw = soup.draw();
        backend::PassLayer const layer = layer_of(camera({160, 160}));
        for (std::size_t i = 0; i < soup.positions.size(); ++i) {
            std::size_t const next = i % 3 == 2 ? i - 2 : i + 1;
            cut_edges += is_before_near(layer, soup.positions[i]) != is_before_near(layer, soup.positions[next]) ? 1U : 0U;
        }
        Passes const passes{{layer}};
        backend::TargetConfig const config{.size_px = {160, 160}, .triangle_ids = true};
        Pixels const cpu = draw_on_cpu({&draw, 1}, config, passes);
        Pixels const gpu = rig.draw_all({&draw, 1}, config, passes);
        for (std::size_t i = 0; i < cpu.depth.size(); ++i) {
            std::uint32_t const triangle = cpu.triangle[i];
            double const between = std::abs(static_cast<double>(cpu.depth[i]) - static_cast<double>(gpu.depth[i]));
            if (triangle != gpu.triangle[i]) apart += between > 2e-6 ? 1U : 0U;
            else if (between > 2e-6) too_far += between > 4e-6 + slope_a_pixel(layer, soup, triangle, 160) * 0x1p-4 ? 1U : 0U;
        }
    }
    INFO(std::to_string(apart) + " px apart, " + std::to_string(cut_edges) + " edges cut");
    CHECK(cut_edges > 300);
    CHECK(apart * 8 <= cut_edges);
    CHECK(too_far == 0);
    CHECK(device->take_messages() == "");
}

TEST_CASE("a pass of more layers than a call takes, and of views without a pixel, is whole", "[vulkan][pass]") {
    auto const device = Device::make();
    REQUIRE(device != nullptr);
    Soup const soup = make_soup(31, 40, 0.8F);
    std::vector<math::mat4> places(3, math::mat4(1.0F));
    places[0][3].z = -0.5F;
    places[1][3].x = 0.8F;
    places[2][3].y = -0.7F;
    std::array<backend::Draw, 2> draws{soup.draw(), soup.draw()};
    draws[1].first_triangle = 500;
    vulkan::Features no_doubles = device->features();
    no_doubles.shader_float64 = false;
    for (vulkan::Features const& features : {device->features(), no_doubles, vulkan::Features{}})
        for (bool instanced : {false, true}) {
            if (!instanced && !features.multi_draw_indirect) continue;
            draws[1].instances = {};
            if (instanced) draws[1].instances = core::StridedSpan<math::mat4>(std::span<math::mat4 const>(places));
            PassRig rig(*device, device->gpu_with(features));
            backend::TargetConfig const config{.size_px = {48, 40}, .layers = instanced ? 20U : 70U, .triangle_ids = true};
            Passes passes(1);
            for (std::uint32_t i = 0; i < config.layers; ++i) {
                backend::PassLayer layer = layer_of(camera(config.size_px, math::Depth::reversed, {0.02 * i, 0.3, 1.0}));
                layer.layer = i;
                passes[0].push_back(layer);
            }
            passes[0].push_back(passes[0][3]);
            passes[0].back().scissor = backend::Rect{4, 4, 0, 10};
            check_same(rig, draws, config, passes);
        }
    CHECK(device->live().total() == 0);
    CHECK(device->take_messages() == "");
}

TEST_CASE("areas of an atlas, strips and what is kept leave all other pixels alone", "[vulkan][pass]") {
    auto const device = Device::make();
    REQUIRE(device != nullptr);
    Soup const soup = make_soup(11, 120, 0.8F);
    backend::Draw const draw = soup.draw();
    for (vulkan::Features const& features : {device->features(), vulkan::Features{}}) {
        PassRig rig(*device, device->gpu_with(features));
        for (backend::DepthFormat format : {backend::DepthFormat::f32, backend::DepthFormat::unorm16}) {
            backend::TargetConfig const config{.size_px = {160, 120}, .layers = 2, .depth = format};
            Passes passes(3);
            auto const views = views_of_layers({80, 60});
            for (std::size_t i = 0; i < 5; ++i) {
                passes[0].push_back(views[i]);
                passes[0][i].layer = i == 4 ? 1 : 0;
                passes[0][i].viewport = backend::Rect{static_cast<int>(i % 2) * 80, static_cast<int>(i / 2 % 2) * 60, 80, 60};
            }
            passes[1] = {views[3]};  // A strip of one tile anew, by another view.
            passes[1][0].layer = 0;
            passes[1][0].viewport = backend::Rect{80, 60, 80, 60};
            passes[1][0].scissor = backend::Rect{0, 70, 200, 11};
            passes[2] = {views[5]};  // On top of what there is, sticking out of the target.
            passes[2][0].layer = 1;
            passes[2][0].viewport = backend::Rect{-40, 30, 130, 200};
            passes[2][0].load = backend::Load::keep;
            check_same(rig, {&draw, 1}, config, passes);
        }
    }
    CHECK(device->live().total() == 0);
    CHECK(device->take_messages() == "");
}
