#include <gnomon/backend.hpp>
#include <gnomon/check/allocations.hpp>
#include <gnomon/check/check.hpp>
#include <gnomon/core/executor_threads.hpp>
#include <gnomon/raster.hpp>

#include "mixed.hpp"

#include <algorithm>
#include <array>
#include <string>
#include <vector>

GNOMON_COUNT_ALLOCATIONS;

namespace {

using namespace fixture;
using backend::PassLayer;
using backend::Plane;
using backend::TargetConfig;

template <class T>
std::vector<T> plane_of(backend::Backend& device, backend::TargetId target, TargetConfig const& config, Plane plane) {
    std::size_t const texels = static_cast<std::size_t>(config.size_px.x * config.size_px.y);
    std::vector<T> out(texels * config.layers);
    for (std::uint32_t layer = 0; layer < config.layers; ++layer)
        REQUIRE(device.read({target, layer, plane, {0, 0, config.size_px.x, config.size_px.y}},
                            std::as_writable_bytes(std::span(out).subspan(layer * texels, texels))));
    REQUIRE(device.finish());
    return out;
}

/// Layers of a pass that do not overlap: some columns of the target each, with a view and rules of its own.
std::vector<PassLayer> random_layers(Random& random, TargetConfig const& config) {
    int const count = random.in(0, 5);
    std::vector<PassLayer> layers;
    for (int i = 0; i < count; ++i) {
        PassLayer layer;
        layer.layer = static_cast<std::uint32_t>(random.in(0, static_cast<std::int32_t>(config.layers) - 1));
        layer.origin = math::vec3{random.unit() - 0.5F, random.unit() - 0.5F, random.unit()};
        layer.clip_from_relative = camera();
        layer.clip_from_relative[0][0] = 0.3F + random.unit();
        layer.clip_from_relative[2][1] = random.unit() - 0.5F;
        layer.groups = static_cast<std::uint64_t>(random.in(0, 3));
        layer.depth = random.in(0, 4) == 0 ? math::Depth::forward : math::Depth::reversed;
        layer.range = random.in(0, 1) == 0 ? DepthRange::clip : DepthRange::clamp;
        layer.load = random.in(0, 2) == 0 ? Load::keep : Load::clear;
        std::int32_t const step = config.size_px.x / count;
        Rect const strip{i * step, random.in(-20, 20), step, random.in(0, config.size_px.y + 30)};
        if (random.in(0, 1) == 0) {
            layer.viewport = strip;
        } else {
            layer.viewport = Rect{random.in(-90, 90), random.in(-90, 90), random.in(1, 400), random.in(1, 400)};
            layer.scissor = strip;
        }
        layers.push_back(layer);
    }
    return layers;
}

/// What the same pass is without a backend: `layered_pass` over images of one's own.
struct Direct {
    TargetConfig config;
    std::vector<float> depth;
    std::vector<std::uint16_t> code;
    std::vector<std::uint32_t> id;
    Workspace workspace;
    std::uint64_t triangles = 0;

    explicit Direct(TargetConfig const& c) : config(c) {
        std::size_t const texels = static_cast<std::size_t>(c.size_px.x * c.size_px.y) * c.layers;
        if (c.depth == backend::DepthFormat::f32) depth.resize(texels);
        if (c.depth == backend::DepthFormat::unorm16) code.resize(texels);
        if (c.triangle_ids) id.resize(texels);
    }

    void draw(std::vector<Draw> const& draws, std::vector<PassLayer> const& passes) {
        std::vector<Layer> layers;
        for (PassLayer const& pass : passes) {
            std::int32_t const w = config.size_px.x;
            std::int32_t const h = config.size_px.y;
            std::size_t const first = pass.layer * static_cast<std::size_t>(w * h);
            bool const narrow = config.depth == backend::DepthFormat::unorm16;
            Layer layer{.target = narrow ? DepthTarget(make_image(code.data() + first, w, h))
                                         : DepthTarget(make_image(depth.data() + first, w, h))};
            if (config.triangle_ids) layer.triangle = make_image(id.data() + first, w, h);
            layer.origin = pass.origin;
            layer.clip_from_relative = pass.clip_from_relative;
            layer.groups = pass.groups;
            // Every pixel of viewport and scissor, found one by one.
            Rect area{0, 0, 0, 0};
            auto const holds = [](std::optional<Rect> const& r, std::int32_t x, std::int32_t y) {
                return !r || (x >= r->x && x - r->x < r->width && y >= r->y && y - r->y < r->height);
            };
            for (std::int32_t y = 0; y < h; ++y)
                for (std::int32_t x = 0; x < w; ++x) {
                    if (!holds(pass.viewport, x, y) || !holds(pass.scissor, x, y)) continue;
                    if (area.width == 0) area = {x, y, 1, 1};
                    area.width = std::max(area.width, x - area.x + 1);
                    area.height = std::max(area.height, y - area.y + 1);
                }
            layer.config = {.depth = pass.depth,
                            .range = pass.range,
                            .load = pass.load,
                            .viewport = pass.viewport,
                            .scissor = area};
            layers.push_back(layer);
        }
        core::SerialExecutor serial;
        for (PassStats const& stats : layered_pass(draws, layers, workspace, serial)) triangles += stats.triangles;
    }
};

std::vector<Draw> in_groups(std::vector<Draw> draws) {
    for (std::size_t i = 0; i < draws.size(); ++i) draws[i].groups = std::uint64_t{1} << (i % 2);
    return draws;
}

struct Add {
    std::uint32_t addend = 0;
};

/// Buffer 1 becomes buffer 0 plus the constant plus the depth bits of the first texel.
void add(backend::KernelData const& data, std::size_t begin, std::size_t end) {
    auto const from = data.buffer<std::uint32_t>(0);
    auto const to = data.buffer<std::uint32_t>(1);
    float const depth = data.targets[0].layer<float>(1)[0];
    for (std::size_t i = begin; i < end; ++i) to[i] = from[i] + data.constant<Add>().addend + (depth == 0.5F ? 1U : 0U);
}

constexpr backend::Kernel add_kernel{
    .name = "add", .cpu = &add, .spirv = {}, .buffers = 2, .targets = 1, .constant_bytes = sizeof(Add), .grain = 16};

}  // namespace

TEST_CASE("passes of the CPU backend are those of layered_pass, bit for bit", "[raster][cpu_backend]") {
    Random random{71};
    std::uint64_t triangles = 0;
    for (int round = 0; round < 30; ++round) {
        CAPTURE(round);
        Mixed const scene(200 + static_cast<std::uint64_t>(round), random.in(0, 300));
        std::vector<Draw> const draws = in_groups(scene.draws());
        core::ThreadExecutor executor(round % 3 + 1);
        CpuBackend device(executor);
        TargetConfig config{.size_px = math::ivec2{random.in(1, 200), random.in(1, 150)},
                            .layers = static_cast<std::uint32_t>(random.in(1, 3))};
        if (round % 3 == 1) config.depth = backend::DepthFormat::unorm16;
        if (round % 3 == 2) config.triangle_ids = true;
        backend::DrawListId const list = *device.keep(draws);
        backend::TargetId const target = *device.make_target(config);
        Direct direct(config);
        std::uint64_t counted = 0;
        for (int pass = 0; pass < 3; ++pass) {
            std::vector<PassLayer> const layers = random_layers(random, config);
            auto const counts = device.draw(list, target, layers);
            REQUIRE(counts);
            counted += counts->triangles;
            direct.draw(draws, layers);
        }
        CHECK(counted == direct.triangles);
        if (config.depth == backend::DepthFormat::unorm16)
            CHECK(plane_of<std::uint16_t>(device, target, config, Plane::depth) == direct.code);
        else
            CHECK(plane_of<float>(device, target, config, Plane::depth) == direct.depth);
        if (config.triangle_ids) CHECK(plane_of<std::uint32_t>(device, target, config, Plane::triangle) == direct.id);
        triangles += counted;
    }
    CHECK(triangles > 1000);
}

TEST_CASE("a kept alpha test gets a map, and its holes stay where they were", "[raster][cpu_backend]") {
    std::vector<std::uint8_t> texels(64 * 64 * 4, 255);
    Random random{72};
    for (std::size_t i = 3; i < texels.size(); i += 4) texels[i] = static_cast<std::uint8_t>(random.in(0, 255));
    Positions const corners{{-1, -1, -2}, {1, -1, -2}, {0, 1, -3}};
    std::vector<math::vec2> const uv{{0, 0}, {1, 0}, {0, 1}};
    AlphaTest test;
    test.uv = std::span<math::vec2 const>(uv);
    test.texture = {texels, math::ivec2(64, 64)};
    Draw draw{.positions = std::span<math::vec3 const>(corners), .indices = {}};
    draw.alpha_test = &test;
    TargetConfig const config{.size_px = math::ivec2(100, 100)};
    PassLayer layer;
    layer.clip_from_relative = camera();
    core::SerialExecutor serial;
    CpuBackend device(serial);
    backend::DrawListId list;
    {
        AlphaTest const copy = test;  // gone before the list is drawn
        Draw of_copy = draw;
        of_copy.alpha_test = &copy;
        list = *device.keep({&of_copy, 1});
        for (int i = 0; i < 40; ++i) (void)*device.keep({});  // lists move when their table grows
    }
    backend::TargetId const target = *device.make_target(config);
    REQUIRE(device.draw(list, target, {&layer, 1}));
    Direct direct(config);
    direct.draw({draw}, {layer});
    CHECK(plane_of<float>(device, target, config, Plane::depth) == direct.depth);
    auto const solid = static_cast<std::size_t>(std::count(direct.depth.begin(), direct.depth.end(), 0.0F));
    CHECK((solid > 8000 && solid < 9900));
}

TEST_CASE("counts of boxes are count_samples_passing's, written where they are asked for", "[raster][cpu_backend]") {
    Mixed const scene(73, 200);
    std::vector<Draw> const draws = scene.draws();
    core::SerialExecutor serial;
    CpuBackend device(serial);
    TargetConfig const config{.size_px = math::ivec2(160, 90)};
    auto const list = *device.keep(draws);
    auto const target = *device.make_target(config);
    auto const buffer = *device.make_buffer(4 * 70);
    PassLayer view;
    view.clip_from_relative = camera();
    REQUIRE(device.draw(list, target, {&view, 1}));
    view.scissor = Rect{10, 10, 120, 70};
    Random random{74};
    std::vector<math::Aabb> boxes;
    for (int i = 0; i < 64; ++i) {
        math::vec3 const at{random.unit() * 4.0F - 2.0F, random.unit() * 4.0F - 2.0F, -random.unit() * 4.0F};
        boxes.push_back({at, at + math::vec3{random.unit(), random.unit(), random.unit()} * 0.5F});
    }
    REQUIRE(device.count_samples(boxes, target, view, buffer, 5));
    std::vector<std::uint32_t> got(70);
    REQUIRE(device.read(buffer, 0, std::as_writable_bytes(std::span(got))));
    REQUIRE(device.finish());
    Direct direct(config);
    PassLayer whole = view;
    whole.scissor = {};
    direct.draw(draws, {whole});
    Layer const layer{.target = make_image(direct.depth.data(), 160, 90),
                      .clip_from_relative = view.clip_from_relative,
                      .config = {.scissor = view.scissor}};
    QueryWorkspace queries;
    std::vector<std::uint64_t> expected(boxes.size());
    count_samples_passing(boxes, layer, expected, queries, serial);
    CHECK(std::equal(expected.begin(), expected.end(), got.begin() + 5));
    CHECK(std::count(expected.begin(), expected.end(), 0U) < 64);
    CHECK((got[4] == 0 && got[69] == 0));
}

TEST_CASE("kernels see buffers, targets and constants, over any ranges", "[raster][cpu_backend]") {
    core::ThreadExecutor executor(3);
    CpuBackend device(executor);
    std::vector<std::uint32_t> values(1000);
    for (std::size_t i = 0; i < values.size(); ++i) values[i] = static_cast<std::uint32_t>(i * i);
    std::array const buffers{*device.make_buffer(4000), *device.make_buffer(4000)};
    auto const target = *device.make_target({.size_px = math::ivec2(1, 2), .layers = 2});
    Positions const corners{{-9, -9, 0.5F}, {9, -9, 0.5F}, {0, 9, 0.5F}};
    Draw const draw{.positions = std::span<math::vec3 const>(corners), .indices = {}};
    PassLayer layer;
    layer.layer = 1;
    REQUIRE(device.draw(*device.keep({&draw, 1}), target, {&layer, 1}));
    std::array const targets{backend::TargetBinding{target, Plane::depth}};
    REQUIRE(device.write(buffers[0], 0, std::as_bytes(std::span(values))));
    Add const constants{7};
    REQUIRE(device.run(add_kernel, {999, buffers, targets, backend::bytes_of(constants)}));
    std::vector<std::uint32_t> got(1000);
    REQUIRE(device.read(buffers[1], 0, std::as_writable_bytes(std::span(got))));
    REQUIRE(device.finish());
    for (std::size_t i = 0; i < 999; ++i) CHECK(got[i] == values[i] + 8);
    CHECK(got[999] == 0);
    backend::Kernel gpu_only = add_kernel;
    gpu_only.cpu = nullptr;
    auto const refused = device.run(gpu_only, {999, buffers, targets, backend::bytes_of(constants)});
    CHECK(refused.failure().code == backend::Error::missing_feature);
}

TEST_CASE("a map that scrolls by copy and redraws a strip is the map drawn anew", "[raster][cpu_backend]") {
    Mixed const scene(75, 300);
    std::vector<Draw> const draws = scene.draws();
    core::SerialExecutor serial;
    CpuBackend device(serial);
    TargetConfig const config{.size_px = math::ivec2(128, 64), .layers = 2};
    auto const list = *device.keep(draws);
    auto const target = *device.make_target(config);
    PassLayer layer;
    layer.clip_from_relative = camera();
    layer.viewport = Rect{0, 0, 256, 64};  // twice as wide as the target, so that whole pixels are a scroll
    REQUIRE(device.draw(list, target, {&layer, 1}));
    REQUIRE(device.copy({target, 0, Plane::depth, {30, 0, 98, 64}}, target, 1, math::ivec2(0, 0)));
    layer.layer = 1;
    layer.viewport = Rect{-30, 0, 256, 64};
    layer.scissor = Rect{98, 0, 30, 64};
    REQUIRE(device.draw(list, target, {&layer, 1}));
    Direct direct(config);
    layer.scissor = {};
    direct.draw(draws, {layer});
    std::vector<float> const got = plane_of<float>(device, target, config, Plane::depth);
    CHECK(std::equal(got.begin() + 128 * 64, got.end(), direct.depth.begin() + 128 * 64));
}

TEST_CASE("the null backend takes and refuses what the CPU backend does, in the same words", "[raster][cpu_backend]") {
    Random random{76};
    core::SerialExecutor serial;
    Mixed const scene(77, 20);
    std::vector<Draw> const draws = in_groups(scene.draws());
    int refused = 0;
    int taken = 0;
    for (int round = 0; round < 300; ++round) {
        CpuBackend cpu(serial);
        backend::NullBackend null;
        std::array<std::byte, 256> bytes{};
        // Ids are drawn from few numbers, so most name something, and some do not.
        auto const id = [&] { return static_cast<std::uint32_t>(random.in(0, 2)); };
        auto const same = [&](auto const& a, auto const& b) {
            REQUIRE(a.has_value() == b.has_value());
            (a ? taken : refused) += 1;
            if (a) return;
            CHECK(a.failure().code == b.failure().code);
            CHECK(a.failure().message == b.failure().message);
        };
        for (int step = 0; step < 30; ++step) {
            std::int32_t const w = random.in(0, 40);
            TargetConfig const config{
                .size_px = math::ivec2(w, random.in(0, 20)),
                .layers = static_cast<std::uint32_t>(random.in(0, 3)),
                .depth = random.in(0, 1) == 0 ? backend::DepthFormat::f32 : backend::DepthFormat::unorm16,
                .triangle_ids = random.in(0, 1) == 0};
            auto const size = static_cast<std::size_t>(random.in(0, 200));
            std::span<std::byte> const part = std::span(bytes).first(static_cast<std::size_t>(random.in(0, 256)));
            auto const offset = static_cast<std::size_t>(random.in(0, 100));
            Plane const plane = random.in(0, 1) == 0 ? Plane::depth : Plane::triangle;
            backend::TargetPart const from{backend::TargetId(id()),
                                           id(),
                                           plane,
                                           {random.in(-1, 8), random.in(-1, 8), random.in(0, 8), random.in(0, 8)}};
            switch (random.in(0, 9)) {
                case 0: same(cpu.make_target(config), null.make_target(config)); break;
                case 1: same(cpu.make_buffer(size), null.make_buffer(size)); break;
                case 2: same(cpu.keep(draws), null.keep(draws)); break;
                case 3: {
                    backend::BufferId const buffer(id());
                    same(cpu.write(buffer, offset, part), null.write(buffer, offset, part));
                    same(cpu.read(buffer, offset, part), null.read(buffer, offset, part));
                    break;
                }
                case 4: {
                    auto layers = random_layers(random, {.size_px = math::ivec2(30, 20), .layers = 2});
                    backend::DrawListId const list(id());
                    auto const a = cpu.draw(list, from.target, layers);
                    auto const b = null.draw(list, from.target, layers);
                    same(a, b);
                    if (a) CHECK(a->triangles == b->triangles);
                    break;
                }
                case 5: same(cpu.read(from, part), null.read(from, part)); break;
                case 6: {
                    backend::TargetId const to(id());
                    std::uint32_t const layer = id();
                    math::ivec2 const at{random.in(-1, 8), random.in(-1, 8)};
                    same(cpu.copy(from, to, layer, at), null.copy(from, to, layer, at));
                    break;
                }
                case 7: {
                    std::array<math::Aabb, 3> const boxes{};
                    PassLayer view;
                    view.layer = from.layer;
                    backend::BufferId const counts(id());
                    same(cpu.count_samples(boxes, from.target, view, counts, offset),
                         null.count_samples(boxes, from.target, view, counts, offset));
                    break;
                }
                case 8: {
                    std::array const buffers{backend::BufferId(id()), backend::BufferId(id())};
                    std::array const targets{backend::TargetBinding{from.target, plane}};
                    backend::KernelCall const call{0, buffers, targets, part};
                    same(cpu.run(add_kernel, call), null.run(add_kernel, call));
                    break;
                }
                default:
                    if (random.in(0, 4) != 0) break;
                    same(cpu.release(from.target), null.release(from.target));
                    same(cpu.release(backend::BufferId(from.layer)), null.release(backend::BufferId(from.layer)));
            }
        }
        CHECK(cpu.live() == null.live());
    }
    CHECK((refused > 1000 && taken > 1000));
}

TEST_CASE("a frame on the CPU backend allocates nothing once it was there before", "[raster][cpu_backend][memory]") {
    Mixed const scene(78, 2000);
    std::vector<Draw> const draws = in_groups(scene.draws());
    core::SerialExecutor serial;
    CpuBackend device(serial);
    auto const list = *device.keep(draws);
    TargetConfig const config{.size_px = math::ivec2(256, 256), .layers = 3};
    auto const target = *device.make_target(config);
    std::array const buffers{*device.make_buffer(4096), *device.make_buffer(4096)};
    std::array const targets{backend::TargetBinding{target, Plane::depth}};
    std::vector<math::Aabb> const boxes(50, math::Aabb{math::vec3(-1, -1, -3), math::vec3(1, 1, -2)});
    std::vector<std::uint32_t> out(1024);
    std::array<PassLayer, 3> layers;
    for (std::uint32_t i = 0; i < 3; ++i) {
        layers[i].clip_from_relative = camera();
        layers[i].layer = i;
    }
    Add const constants{1};
    auto const frame = [&] {
        bool good = true;
        device.stage("draw");
        good = device.draw(list, target, layers).has_value() && good;
        device.stage("query");
        good = device.count_samples(boxes, target, layers[1], buffers[0], 3).has_value() && good;
        good = device.write(buffers[1], 8, std::as_bytes(std::span(out).first(9))).has_value() && good;
        device.stage("");  // times nothing
        device.stage("kernel");
        good = device.run(add_kernel, {900, buffers, targets, backend::bytes_of(constants)}).has_value() && good;
        good = device.copy({target, 0, Plane::depth, {0, 0, 64, 64}}, target, 2, math::ivec2(9, 9)).has_value() && good;
        good = device.read(buffers[1], 0, std::as_writable_bytes(std::span(out))).has_value() && good;
        auto const times = device.finish();
        return good && times && times->size() == 3 && times->back().ms > 0.0;
    };
    CHECK(frame());
    CHECK(frame());
    std::uint64_t const before = check::allocations_made();
    bool const good = frame();
    CHECK(check::allocations_made() == before);
    CHECK(good);
}
