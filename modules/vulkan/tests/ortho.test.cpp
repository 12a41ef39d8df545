#include "ortho_rig.hpp"
#include "test_host.hpp"

#include <gnomon/check/check.hpp>
#include <gnomon/core/executor.hpp>
#include <gnomon/raster/cpu_backend.hpp>
#include <gnomon/vulkan/backend.hpp>

#include <cstdio>
#include <limits>
#include <string>
#include <vector>

using namespace gnomon;
using namespace gnomon::vulkan::test;

namespace {

constexpr std::uint32_t ortho_layers = 48;

backend::TargetConfig ortho_config(Random& random) {
    backend::TargetConfig config{.size_px = {96, 80}, .layers = ortho_layers};
    config.size_px.x -= static_cast<std::int32_t>(random.next() % 30);
    config.depth = random.next() % 2 == 0 ? backend::DepthFormat::f32 : backend::DepthFormat::unorm16;
    return config;
}

/// A draw and two passes of one layer each for every layer: clear all and draw, then keep and draw into a part.
struct OrthoFrame {
    OrthoScene scene;
    OrthoPasses passes{2};

    OrthoFrame(Random& random, backend::TargetConfig const& config, std::uint64_t kinds_from) {
        constexpr double distances[] = {0.0, 1e4, 1e7};
        for (std::uint32_t layer = 0; layer < config.layers; ++layer) {
            bool const plain = random.next() % 3 == 0;
            double const far_m = distances[random.next() % 3];
            OrthoView view = random_view(random, config, far_m, plain);
            view.layer.layer = layer;
            view.layer.depth = random.next() % 2 == 0 ? math::Depth::forward : math::Depth::reversed;
            view.layer.range = random.next() % 2 == 0 ? backend::DepthRange::clamp : backend::DepthRange::clip;
            for (std::size_t pass = 0; pass < 2; ++pass) {
                add_draw(random, view, kinds_from + layer + 5 * pass);
                view.layer.draws = std::span<std::uint32_t const>(&scene.places.back(), 1);
                passes[pass].push_back(view.layer);
                view.layer.load = backend::Load::keep;
                auto const x = static_cast<std::int32_t>(random.next() % 40);
                auto const y = static_cast<std::int32_t>(random.next() % 40);
                view.layer.scissor = backend::Rect{x - 5, y - 5, 50, 60};
                if (random.next() % 4 == 0) view.layer.light.origin_x += 3;
            }
        }
    }

  private:
    void add_draw(Random& random, OrthoView const& view, std::uint64_t kind) {
        Soup& soup = scene.soups.emplace_back();
        auto const count = 1 + random.next() % 6;
        for (std::uint64_t i = 0; i < count; ++i) add_triangle(soup, random, view, kind);
        backend::Draw draw = soup.draw();
        constexpr backend::Cull culls[] = {backend::Cull::none, backend::Cull::none, backend::Cull::back, backend::Cull::front};
        draw.cull = culls[random.next() % 4];
        if (random.next() % 3 == 0) draw.alpha_test = add_alpha_test(scene, random, soup);
        scene.places.push_back(static_cast<std::uint32_t>(scene.draws.size()));
        scene.draws.push_back(draw);
    }
};

OrthoDifference compare_frames(OrthoRig& rig, std::uint64_t seed, int frames) {
    OrthoDifference sum;
    for (int i = 0; i < frames; ++i) {
        Random random{seed + static_cast<std::uint64_t>(i)};
        backend::TargetConfig const config = ortho_config(random);
        OrthoFrame const frame(random, config, random.next());
        auto const cpu = draw_ortho_on_cpu(frame.scene.draws, config, frame.passes);
        auto const gpu = rig.draw(frame.scene.draws, config, frame.passes);
        OrthoDifference const d = ortho_difference(cpu, gpu, config.depth == backend::DepthFormat::f32 ? 1.0F : 65535.0F);
        if (d.differing != 0) std::printf("frame %d: %s\n", i, d.text().c_str());
        sum += d;
    }
    return sum;
}

}  // namespace

TEST_CASE("integer passes are the CPU's, bit for bit", "[vulkan][ortho]") {
    auto const device = Device::make();
    REQUIRE(device != nullptr);
    OrthoRig rig(*device);
    CHECK(rig.pipelines().edges_by_device());
    OrthoDifference const d = compare_frames(rig, 100, 10);
    std::printf("ortho, edges by the device: %s\n", d.text().c_str());
    CHECK(d.differing == 0);
    CHECK(d.written > d.texels / 10);
    CHECK(device->take_messages() == "");
}

TEST_CASE("integer passes are the CPU's where the fragment shader finds what is covered", "[vulkan][ortho]") {
    auto const device = Device::make();
    REQUIRE(device != nullptr);
    OrthoRig rig(*device, {.edges_by_device = false});
    OrthoDifference const d = compare_frames(rig, 200, 6);
    std::printf("ortho, edges by the shader: %s\n", d.text().c_str());
    CHECK(d.differing == 0);
    CHECK(d.written > d.texels / 10);
    CHECK(device->take_messages() == "");
}

namespace {

/// A soup in the middle of a plain view's image and depths; corners are up to so much of all codes from their triangle's.
Soup ortho_soup(Random& random, OrthoView const& view, int count, double most_dz = 0.03) {
    Soup soup;
    for (int i = 0; i < count; ++i) {
        auto const at = [&](double low, double high) { return low + (high - low) * static_cast<double>(random.in(0.0F, 1.0F)); };
        double const x = at(-20.0, 116.0);
        double const y = at(-20.0, 100.0);
        double const code = at(0.3, 0.6) * view.last_code;
        for (int k = 0; k < 3; ++k) {
            double const dx = at(-30.0, 30.0);
            double const dy = at(-30.0, 30.0);
            double const dz = at(-most_dz, most_dz) * view.last_code;
            soup.indices.push_back(static_cast<std::uint32_t>(soup.positions.size()));
            soup.positions.push_back(view.position(x + dx, y + dy, code + dz));
        }
    }
    return soup;
}

/// Texels of the moved image that are not the first image's, moved; both images' texels that the other does not show
/// aside.
std::uint64_t not_moved(std::span<float const> from, std::span<float const> to, math::ivec2 size, math::ivec2 by, float codes,
                        float last) {
    std::uint64_t wrong = 0;
    for (std::int32_t y = 0; y < size.y; ++y)
        for (std::int32_t x = 0; x < size.x; ++x) {
            std::int32_t const ox = x - by.x;
            std::int32_t const oy = y - by.y;
            if (ox < 0 || oy < 0 || ox >= size.x || oy >= size.y) continue;
            float const code = from[static_cast<std::size_t>(y * size.x + x)];
            float const moved = to[static_cast<std::size_t>(oy * size.x + ox)];
            wrong += moved == (code == last ? last : code - codes) ? 0U : 1U;
        }
    return wrong;
}

}  // namespace

namespace {

/// Soups from gentle to steep, whose codes the device finds where it can, beside the CPU's.
OrthoDifference compare_soups(OrthoRig& rig, std::uint64_t seed, int soups) {
    OrthoDifference sum;
    for (int i = 0; i < soups; ++i) {
        Random random{seed + static_cast<std::uint64_t>(i)};
        backend::TargetConfig const config{.size_px = {96, 80}, .layers = 1, .depth = backend::DepthFormat::unorm16};
        OrthoView view = random_view(random, config, i % 3 == 0 ? 1e4 : 0.0, i % 2 == 0);
        view.layer.depth = i % 4 < 2 ? math::Depth::forward : math::Depth::reversed;
        view.layer.range = backend::DepthRange::clamp;
        constexpr double most_dz[] = {0.0001, 0.001, 0.003, 0.03};
        OrthoScene scene;
        for (double const dz : most_dz) scene.soups.push_back(ortho_soup(random, view, 12, dz));
        add_triangle(scene.soups.back(), random, view, random.next() % ortho_kinds);
        for (Soup const& soup : scene.soups) scene.draws.push_back(soup.draw());
        scene.draws[1].alpha_test = add_alpha_test(scene, random, scene.soups[1]);
        OrthoPasses const passes{{view.layer}};
        auto const cpu = draw_ortho_on_cpu(scene.draws, config, passes);
        sum += ortho_difference(cpu, rig.draw(scene.draws, config, passes), view.layer.depth == math::Depth::forward ? 65535.0F : 0.0F);
    }
    return sum;
}

}  // namespace

TEST_CASE("codes that the device interpolates are at most one from the CPU's", "[vulkan][ortho]") {
    auto const device = Device::make();
    REQUIRE(device != nullptr);
    OrthoRig rig(*device, {.codes_by_device = true});
    REQUIRE(rig.pipelines().codes_by_device());
    OrthoDifference const d = compare_soups(rig, 300, 24);
    std::printf("ortho, codes by the device: %s, by %.0f at most\n", d.text().c_str(), static_cast<double>(d.most));
    CHECK(d.most == 1.0F);
    CHECK(d.differing < d.written / 200);
    CHECK(d.written > d.texels / 10);
    CHECK(device->take_messages() == "");
}

TEST_CASE("codes that the device interpolates are at most one from the CPU's in many soups", "[vulkan][ortho][.full]") {
    auto const device = Device::make();
    REQUIRE(device != nullptr);
    OrthoRig rig(*device, {.codes_by_device = true});
    OrthoDifference const d = compare_soups(rig, 10'000, 2'000);
    std::printf("ortho, codes by the device, many soups: %s, by %.0f at most\n", d.text().c_str(), static_cast<double>(d.most));
    CHECK(d.most == 1.0F);
    CHECK(device->take_messages() == "");
}

TEST_CASE("on the device a view moved by whole units shows the moved image", "[vulkan][ortho]") {
    auto const device = Device::make();
    REQUIRE(device != nullptr);
    OrthoRig rig(*device);
    backend::TargetConfig const config{.size_px = {96, 80}, .layers = 40, .depth = backend::DepthFormat::unorm16};
    Random random{5};
    std::uint64_t wrong = 0;
    std::uint64_t written = 0;
    for (double const far_m : {0.0, 1e4, 1e7}) {
        OrthoView const view = random_view(random, config, far_m, false);
        Soup const soup = ortho_soup(random, view, 60);
        backend::Draw const draw = soup.draw();
        OrthoPasses passes{{view.layer}};
        std::vector<math::ivec2> moves{{0, 0}};
        std::vector<std::int32_t> codes{0};
        for (std::uint32_t i = 1; i < config.layers; ++i) {
            backend::OrthoLayer& moved = passes[0].emplace_back(view.layer);
            moved.layer = i;
            auto const x = static_cast<std::int32_t>(random.next() % 61) - 30;
            auto const y = static_cast<std::int32_t>(random.next() % 61) - 30;
            codes.push_back(static_cast<std::int32_t>(random.next() % 4001) - 2000);
            moves.emplace_back(x, y);
            moved.light.origin_x += x;
            moved.light.origin_y += y;
            moved.light.origin_z += codes.back();
        }
        auto const images = rig.draw({&draw, 1}, config, passes);
        std::size_t const texels = images.size() / config.layers;
        auto const image = [&](std::size_t i) { return std::span(images).subspan(i * texels, texels); };
        for (float const code : image(0)) written += code != 65535.0F ? 1U : 0U;
        for (std::size_t i = 1; i < config.layers; ++i)
            wrong += not_moved(image(0), image(i), config.size_px, moves[i], static_cast<float>(codes[i]), 65535.0F);
    }
    CHECK(wrong == 0);
    CHECK(written > 10'000);
    CHECK(device->take_messages() == "");
}

TEST_CASE("on the device an image is the same ten thousand kilometres away", "[vulkan][ortho]") {
    auto const device = Device::make();
    REQUIRE(device != nullptr);
    OrthoRig rig(*device);
    backend::TargetConfig const config{.size_px = {96, 80}, .layers = 3};
    Random random{6};
    OrthoView const view = random_view(random, config, 0.0, true);
    Soup const soup = ortho_soup(random, view, 60);
    backend::Draw const draw = soup.draw();
    OrthoPasses passes(1);
    for (std::uint32_t i = 0; i < 3; ++i) {
        passes[0].push_back(view.layer);
        std::int64_t const metres[] = {0, 10'000, 10'000'000};
        backend::OrthoLayer& layer = passes[0].back();
        layer.layer = i;
        auto const m = static_cast<double>(metres[i]);
        layer.origin_m = {m, -m, m};
        layer.light.origin_x += metres[i] * 64;
        layer.light.origin_y += metres[i] * 64;
        layer.light.origin_z -= metres[i] * 1024;
    }
    auto const images = rig.draw({&draw, 1}, config, passes);
    std::size_t const texels = images.size() / 3;
    auto const image = [&](std::size_t i) { return std::vector<float>(images.begin() + static_cast<std::ptrdiff_t>(i * texels), images.begin() + static_cast<std::ptrdiff_t>((i + 1) * texels)); };
    CHECK(image(0) == image(1));
    CHECK(image(0) == image(2));
    CHECK(ortho_difference(draw_ortho_on_cpu({&draw, 1}, config, passes), images, 1.0F).differing == 0);
}

TEST_CASE("integer passes leave out on the device what they leave out on the CPU", "[vulkan][ortho]") {
    auto const device = Device::make();
    REQUIRE(device != nullptr);
    PassRig rig(*device, device->gpu());
    auto pipelines = vulkan::OrthoPipelines::make(rig.pipelines());
    REQUIRE(pipelines);
    backend::TargetConfig const config{.size_px = {96, 80}, .layers = 2};
    Random random{8};
    OrthoView const view = random_view(random, config, 0.0, true);
    Soup soup = ortho_soup(random, view, 40);
    Soup const good = soup;
    soup.positions[1].y = 1e15F;   // beyond max_light_units
    soup.positions[4].z = 1e37F;
    soup.positions[7].x = 3e8F;    // beyond max_ortho_extent
    soup.positions[10] = soup.positions[9];
    soup.indices[30] = 1'000'000;
    std::vector<backend::Draw> draws{soup.draw(), Soup{}.draw()};
    OrthoPasses passes{{view.layer, view.layer}};
    passes[0][1].layer = 1;
    passes[0][1].load = backend::Load::clear;
    vulkan::DrawList list = rig.keep(draws);
    vulkan::Target target = rig.make(config);
    auto ring = vulkan::HostRing::make(rig.gpu(), {.bytes_per_frame = 4096, .frames = 2});
    REQUIRE(ring);
    raster::OrthoStats stats;
    for (std::uint64_t frame = 0; frame < 2; ++frame) {
        REQUIRE(ring->begin_frame({frame, frame}));
        VkCommandBuffer const commands = device->begin();
        if (frame == 1) {  // now some that no staging has seen
            soup.positions[13].x = std::numeric_limits<float>::quiet_NaN();
            soup.positions[16].y = std::numeric_limits<float>::infinity();
            auto const moved = vulkan::record_update(commands, list, 0, std::span<math::vec3 const>(soup.positions), *ring);
            REQUIRE(moved);
            CHECK(*moved == 2);
        }
        auto const counts = vulkan::record_ortho(commands, *pipelines, list, target, passes[0]);
        REQUIRE(counts);
        CHECK(counts->triangles == 80);
        CHECK(counts->draw_calls == 2);
        REQUIRE(ring->flush());
        device->submit_and_wait();
        stats = {};
        auto const cpu = draw_ortho_on_cpu(draws, config, passes, &stats);
        OrthoDifference const d = ortho_difference(cpu, rig.read(target).depth, 1.0F);
        CHECK(d.differing == 0);
        CHECK(d.written > 5'000);
    }
    CHECK(stats.not_finite == 4);
    CHECK(stats.overflow == 6);
    CHECK(stats.degenerate == 2);
    CHECK(device->take_messages() == "");
}

TEST_CASE("the verb draws on the device what it draws on the CPU, and refuses the same", "[vulkan][backend][ortho]") {
    DeviceBackend on;
    core::SerialExecutor serial;
    raster::CpuBackend cpu{core::ExecutorRef(serial)};
    backend::TargetConfig const config{.size_px = {96, 80}, .layers = 30, .depth = backend::DepthFormat::unorm16};
    Random random{12};
    OrthoFrame const frame(random, config, 3);
    std::vector<math::mat4> const none;
    std::vector<backend::Draw> copies = frame.scene.draws;
    copies[1].instances = core::StridedSpan<math::mat4>(std::span<math::mat4 const>(none));
    std::vector<std::uint16_t> images[2];
    std::vector<std::string> words[2];
    backend::Backend* const both[] = {&cpu, on.gpu.get()};
    for (std::size_t i = 0; i < 2; ++i) {
        backend::Backend& b = *both[i];
        auto const list = b.keep(frame.scene.draws);
        auto const instanced = b.keep(copies);
        auto const target = b.make_target(config);
        REQUIRE((list && instanced && target));
        for (auto const& layers : frame.passes) REQUIRE(b.draw_ortho(*list, *target, layers));
        std::size_t const texels = std::size_t{96} * 80;
        images[i].resize(texels * config.layers);
        for (std::uint32_t layer = 0; layer < config.layers; ++layer)
            REQUIRE(b.read({*target, layer, backend::Plane::depth, {0, 0, 96, 80}},
                           std::as_writable_bytes(std::span(images[i]).subspan(layer * texels, texels))));
        REQUIRE(b.finish());
        backend::OrthoLayer layer;
        auto const tell = [&](backend::DrawListId draws, backend::OrthoLayer const& asked) {
            auto const result = b.draw_ortho(draws, *target, {&asked, 1});
            words[i].push_back(result ? "" : result.failure().message);
        };
        tell(*list, layer);
        tell(*instanced, layer);
        tell({}, layer);
        layer.layer = 30;
        tell(*list, layer);
        layer.layer = 0;
        std::uint32_t const beyond = 1'000;
        layer.draws = std::span<std::uint32_t const>(&beyond, 1);
        tell(*list, layer);
        REQUIRE(b.finish());
    }
    CHECK(images[0] == images[1]);
    CHECK(words[0] == words[1]);
    CHECK(words[1][0] == "");
    CHECK(words[1][1] != "");
    CHECK(on.device->take_messages() == "");
}

TEST_CASE("without 64-bit floats or integers the verb says what is missing", "[vulkan][backend][ortho]") {
    auto const device = Device::make();
    REQUIRE(device != nullptr);
    for (bool vulkan::Features::*const flag : {&vulkan::Features::shader_float64, &vulkan::Features::shader_int64}) {
        vulkan::Features fewer = device->features();
        fewer.*flag = false;
        TestHost host(*device);
        auto const b = vulkan::Backend::make(device->gpu_with(fewer), host.host());
        REQUIRE(b);
        Soup const soup = make_soup(1, 2, 1.0F);
        backend::Draw const draw = soup.draw();
        auto const list = (*b)->keep({&draw, 1});
        auto const target = (*b)->make_target({.size_px = {8, 8}});
        REQUIRE((list && target));
        backend::OrthoLayer const layer;
        auto const result = (*b)->draw_ortho(*list, *target, {&layer, 1});
        REQUIRE_FALSE(result);
        CHECK(result.failure().code == backend::Error::missing_feature);
        CHECK(result.failure().message.find(flag == &vulkan::Features::shader_int64 ? "shader_int64" : "shader_float64") !=
              std::string::npos);
        REQUIRE((*b)->finish());
    }
}

TEST_CASE("integer passes are the CPU's in many frames", "[vulkan][ortho][.full]") {
    auto const device = Device::make();
    REQUIRE(device != nullptr);
    for (bool const by_device : {true, false}) {
        OrthoRig rig(*device, {.edges_by_device = by_device});
        OrthoDifference const d = compare_frames(rig, by_device ? 10'000 : 20'000, by_device ? 400 : 100);
        std::printf("ortho, many frames: %s\n", d.text().c_str());
        CHECK(d.differing == 0);
    }
    CHECK(device->take_messages() == "");
}
