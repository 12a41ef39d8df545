#include <gnomon/check/allocations.hpp>
#include <gnomon/check/check.hpp>
#include <gnomon/core/executor_threads.hpp>
#include <gnomon/raster/layers.hpp>

#include "mixed.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

namespace {

using namespace fixture;

/// An atlas of float depths and ids and one of 16-bit codes, cut into layers of odd sizes.
struct Atlas {
    static constexpr std::int32_t width = 700;
    static constexpr std::int32_t height = 300;
    std::vector<float> depth = std::vector<float>(std::size_t{width} * height, 0.25F);
    std::vector<std::uint32_t> id = std::vector<std::uint32_t>(depth.size(), 77);
    std::vector<std::uint16_t> code = std::vector<std::uint16_t>(depth.size(), 1234);

    [[nodiscard]] std::uint64_t hash() const {
        return oracle::hash(depth) * 31 + oracle::hash(id) * 17 + oracle::hash(code);
    }

    /// `count` layers in a row, every third into codes, some without ids, each with a view and rules of its own.
    std::vector<Layer> layers(Random& random, int count) {
        std::vector<Layer> made;
        ImageView<float> const depths = make_image(depth.data(), width, height);
        ImageView<std::uint32_t> const ids = make_image(id.data(), width, height);
        ImageView<std::uint16_t> const codes = make_image(code.data(), width, height);
        for (int i = 0; i < count; ++i) {
            std::int32_t const step = width / count;
            Rect const part{i * step, random.in(0, 60), random.in(1, step), random.in(1, 240)};
            Layer layer{.target = i % 3 == 2 ? DepthTarget(codes.sub(part)) : DepthTarget(depths.sub(part))};
            if (i % 3 == 1) layer.triangle = ids.sub(part);
            layer.origin = math::vec3{random.unit() - 0.5F, random.unit() - 0.5F, random.unit()};
            layer.clip_from_relative = camera();
            layer.clip_from_relative[0][0] = 0.3F + random.unit();
            layer.clip_from_relative[2][1] = random.unit() - 0.5F;
            layer.groups = i % 4 == 3 ? 0b10U : i % 4 == 2 ? 0b01U : 0b11U;
            PassConfig& config = layer.config;
            config.depth = i % 5 == 4 ? math::Depth::forward : math::Depth::reversed;
            config.range = i % 2 == 1 ? DepthRange::clamp : DepthRange::clip;
            config.load = random.in(0, 2) == 0 ? Load::keep : Load::clear;
            config.kernel = random.in(0, 2) == 0 ? Kernel::scalar : Kernel::automatic;
            if (random.in(0, 2) == 0)
                config.viewport = Rect{random.in(-40, 40), random.in(-40, 40), random.in(0, 200), random.in(1, 200)};
            if (random.in(0, 2) == 0)
                config.scissor = Rect{random.in(-20, 60), random.in(-20, 60), random.in(0, 60), random.in(0, 90)};
            made.push_back(layer);
        }
        return made;
    }
};

std::vector<Draw> grouped(std::vector<Draw> draws) {
    for (std::size_t i = 0; i < draws.size(); ++i) draws[i].groups = std::uint64_t{1} << (i % 2);
    return draws;
}

/// A pass per layer over the draws that it shares a bit with.
std::vector<PassStats> one_by_one(std::vector<Draw> const& draws, std::vector<Layer> const& layers) {
    std::vector<PassStats> stats;
    Workspace workspace;
    core::SerialExecutor serial;
    for (Layer const& layer : layers) {
        std::vector<Draw> own;
        for (Draw draw : draws) {
            if ((draw.groups & layer.groups) == 0) continue;
            draw.origin = layer.origin;
            draw.clip_from_relative = layer.clip_from_relative;
            own.push_back(draw);
        }
        stats.push_back(layer.triangle.data == nullptr
                            ? depth_pass(own, layer.target, layer.config, workspace, serial)
                            : camera_pass(own, {layer.target.f32(), layer.triangle}, layer.config, workspace, serial));
    }
    return stats;
}

}  // namespace

TEST_CASE("a layered pass is the passes one by one, bit for bit, for any number of threads", "[raster][layers]") {
    Random random{51};
    Workspace workspace;
    std::uint64_t drawn = 0;
    for (int round = 0; round < 40; ++round) {
        Mixed const scene(100 + static_cast<std::uint64_t>(round), random.in(0, 400));
        std::vector<Draw> const draws = grouped(scene.draws());
        int const count = random.in(1, 13);
        Random same = random;
        Atlas expected;
        std::vector<PassStats> const stats = one_by_one(draws, expected.layers(random, count));
        Atlas together;
        std::vector<Layer> const layers = together.layers(same, count);
        core::ThreadExecutor executor(round % 4 + 1);
        std::span<PassStats const> const got = layered_pass(draws, layers, workspace, executor);
        CAPTURE(round);
        REQUIRE(got.size() == stats.size());
        CHECK(std::equal(got.begin(), got.end(), stats.begin()));
        CHECK(together.hash() == expected.hash());
        for (PassStats const& s : got) drawn += s.drawn;
    }
    CHECK(drawn > 1000);
}

TEST_CASE("layers whose triangles fill several batches equal the passes one by one", "[raster][layers][batch]") {
    // 131,072 triangles are a batch here: draws that begin, end and go on in the middle of one.
    Mixed const scene(61, 30'000);
    std::vector<Draw> draws;
    for (int copy = 0; copy < 9; ++copy) {
        Draw draw = draw_of(scene.positions, scene.indices);
        draw.first_triangle = static_cast<std::uint32_t>(copy) * 40'000;
        draw.groups = copy % 3 == 0 ? 1 : ~std::uint64_t{0};
        draws.push_back(draw);
    }
    // One draw of more triangles than two batches.
    Indices many;
    for (int copy = 0; copy < 9; ++copy) many.insert(many.end(), scene.indices.begin(), scene.indices.end());
    draws.insert(draws.begin() + 4, draw_of(scene.positions, many));
    Random random{62};
    Random same = random;
    Atlas expected;
    std::vector<PassStats> const stats = one_by_one(draws, expected.layers(random, 5));
    Atlas together;
    std::vector<Layer> const layers = together.layers(same, 5);
    Workspace workspace;
    core::ThreadExecutor executor(3);
    std::span<PassStats const> const got = layered_pass(draws, layers, workspace, executor);
    CHECK(std::equal(got.begin(), got.end(), stats.begin()));
    CHECK(stats[0].triangles > 600'000);
    CHECK(together.hash() == expected.hash());
}

TEST_CASE("no layers, empty layers and layers without draws are legal, and clear what they should",
          "[raster][layers][empty]") {
    Workspace workspace;
    core::SerialExecutor serial;
    Mixed const scene(63, 50);
    std::vector<Draw> const draws = scene.draws();
    CHECK(layered_pass(draws, {}, workspace, serial).empty());
    std::vector<float> depth(64, -1.0F);
    ImageView<float> const image = make_image(depth.data(), 8, 8);
    std::vector<Layer> layers{{.target = image.sub({0, 0, 0, 8})},
                              {.target = image.sub({0, 0, 4, 8}), .groups = 0},
                              {.target = image.sub({4, 0, 4, 4}), .groups = 0},
                              {.target = image.sub({4, 4, 4, 4}), .groups = 0, .config = {.load = Load::keep}}};
    std::span<PassStats const> const stats = layered_pass(draws, layers, workspace, serial);
    CHECK(stats[0].outside == stats[0].triangles);
    CHECK(stats[0].triangles == 2 * (scene.indices.size() / 3));
    CHECK(stats[1] == PassStats{});
    CHECK(std::count(depth.begin(), depth.end(), 0.0F) == 48);
    CHECK(std::count(depth.begin(), depth.end(), -1.0F) == 16);
}

TEST_CASE("a second layered pass allocates nothing", "[raster][layers][memory]") {
    Mixed const scene(64, 3000);
    std::vector<Draw> const draws = grouped(scene.draws());
    Random random{65};
    Atlas atlas;
    std::vector<Layer> const layers = atlas.layers(random, 6);
    Workspace workspace;
    core::SerialExecutor serial;
    (void)layered_pass(draws, layers, workspace, serial);
    std::uint64_t const before = check::allocations_made();
    (void)layered_pass(draws, layers, workspace, serial);
    CHECK(check::allocations_made() == before);
}
