#include "pass_scenes.hpp"
#include "test_host.hpp"
#include "test_kernels.hpp"

#include <gnomon/cascade.hpp>
#include <gnomon/check/check.hpp>
#include <gnomon/core/executor.hpp>
#include <gnomon/raster/cpu_backend.hpp>
#include <gnomon/vulkan/backend.hpp>

#include "shaders/depth_ramp_frag.hpp"

#include <algorithm>
#include <array>
#include <cstring>
#include <string>
#include <vector>

using namespace gnomon;
using namespace gnomon::vulkan::test;

namespace {

constexpr std::int32_t written_px = 64;

struct DepthRamp {
    std::uint32_t step;
    std::uint32_t layer;
    float per_code;
    float codes;
};

template <class T>
void write_ramp(backend::KernelData const& data, backend::DepthRow const& row) {
    auto const ramp = data.constant<DepthRamp>();
    auto const rows = data.buffers[0];
    T const* const from = data.targets[0].layer<T>(ramp.layer) + std::ptrdiff_t{row.y} * written_px;
    std::span<T> const out = row.depths<T>();
    std::uint32_t number = 0;
    std::memcpy(&number, rows.data() + std::size_t{4} * static_cast<std::size_t>(row.y), 4);
    for (std::int32_t i = 0; i < row.width; ++i) {
        std::int32_t const x = row.x + i;
        auto const held = static_cast<std::uint32_t>(sizeof(T) == 2 ? static_cast<float>(from[x])
                                                                    : static_cast<float>(from[x]) * ramp.codes + 0.5F);
        auto const code = static_cast<float>((held + number + static_cast<std::uint32_t>(x) * ramp.step) & 0xFFFFU);
        out[static_cast<std::size_t>(i)] = static_cast<T>(sizeof(T) == 2 ? code : code * ramp.per_code);
    }
}

void depth_ramp(backend::KernelData const& data, backend::DepthRow const& row) {
    row.format == backend::DepthFormat::unorm16 ? write_ramp<std::uint16_t>(data, row) : write_ramp<float>(data, row);
}

constinit backend::DepthKernel const depth_ramp_kernel{.name = "depth_ramp",
                                                       .cpu = &depth_ramp,
                                                       .spirv = vulkan::test::depth_ramp_frag,
                                                       .buffers = 1,
                                                       .targets = 1,
                                                       .constant_bytes = sizeof(DepthRamp)};
static_assert(sizeof(formula::GnScroll) == 32);

std::vector<std::byte> depth_bytes(backend::Backend& b, backend::TargetId target, std::uint32_t layer, backend::DepthFormat format) {
    std::vector<std::byte> bytes(std::size_t{written_px} * written_px * (format == backend::DepthFormat::unorm16 ? 2 : 4));
    REQUIRE(b.read({target, layer, backend::Plane::depth, {0, 0, written_px, written_px}}, bytes));
    REQUIRE(b.finish());
    return bytes;
}

/// Two maps of two layers, written from each other: what their layers hold in the end, and what calls were told.
struct RampRun {
    std::vector<std::vector<std::byte>> layers;
    std::vector<std::string> words;

    RampRun(backend::Backend& b, backend::DepthFormat format) {
        bool const is_float = format == backend::DepthFormat::f32;
        backend::TargetConfig const config{.size_px = {written_px, written_px}, .layers = 2, .depth = format};
        auto const one = b.make_target(config);
        auto const other = b.make_target(config);
        auto const rows = b.make_buffer(written_px * 4);
        Soup const soup = make_soup(4, 50, 1.5F);
        backend::Draw const draw = soup.draw();
        auto const list = b.keep({&draw, 1});
        REQUIRE((one && other && rows && list));
        std::array<backend::OrthoLayer, 2> flat;
        flat[1].layer = 1;
        for (auto const target : {*one, *other}) REQUIRE(b.draw_ortho(*list, target, flat));
        Random random{3};
        for (std::uint32_t i = 0; i < 12; ++i) {
            std::array<std::uint32_t, written_px> numbers;
            for (std::uint32_t& n : numbers) n = static_cast<std::uint32_t>(random.next() % 60'000);
            REQUIRE(b.write(*rows, 0, std::as_bytes(std::span(numbers))));
            auto const x = static_cast<std::int32_t>(random.next() % 30);
            auto const y = static_cast<std::int32_t>(random.next() % 30);
            DepthRamp const ramp{i * 7, i / 2 % 2, is_float ? 0x1p-24F : 1.0F / 65535.0F, is_float ? 0x1p24F : 65535.0F};
            std::array const from{backend::TargetBinding{i % 2 == 0 ? *one : *other}};
            backend::DepthCall call{.to = i % 2 == 0 ? *other : *one, .layer = i % 3 % 2, .rect = {x, y, 30, 33}, .buffers = {&*rows, 1},
                                    .targets = from, .constants = backend::bytes_of(ramp)};
            REQUIRE(b.write_depth(depth_ramp_kernel, call));
        }
        for (auto const target : {*one, *other})
            for (std::uint32_t layer = 0; layer < 2; ++layer) layers.push_back(depth_bytes(b, target, layer, format));
        auto const tell = [&](backend::Result<core::Done> const& result) { words.push_back(result ? "" : result.failure().message); };
        std::array const own{backend::TargetBinding{*one}};
        DepthRamp const ramp{};
        backend::DepthCall call{.to = *one, .rect = {0, 0, 4, 4}, .buffers = {&*rows, 1}, .targets = own, .constants = backend::bytes_of(ramp)};
        tell(b.write_depth(depth_ramp_kernel, call));
        call.to = *other;
        call.rect.x = 61;
        tell(b.write_depth(depth_ramp_kernel, call));
        call.rect = {};
        tell(b.write_depth(depth_ramp_kernel, call));
        call.to = {};
        tell(b.write_depth(depth_ramp_kernel, call));
        call = {.to = *other, .rect = {0, 0, 4, 4}};
        tell(b.write_depth(depth_ramp_kernel, call));
        REQUIRE(b.finish());
    }
};

}  // namespace

TEST_CASE("depth kernels write on the device what they write on the CPU", "[vulkan][backend][depth_kernel]") {
    DeviceBackend on;
    core::SerialExecutor serial;
    raster::CpuBackend cpu{core::ExecutorRef(serial)};
    for (auto const format : {backend::DepthFormat::f32, backend::DepthFormat::unorm16}) {
        RampRun const ours(cpu, format);
        RampRun const theirs(*on.gpu, format);
        CHECK(ours.layers == theirs.layers);
        CHECK(ours.layers[0] != ours.layers[2]);
        CHECK(ours.words == theirs.words);
        CHECK(ours.words[2] == "");
    }
    std::uint64_t const made = on.device->live().calls;
    auto const scroll = on.gpu->write_depth(scroll_map_kernel, {});
    CHECK_FALSE(scroll);  // no such target
    CHECK(on.device->live().calls == made);
    CHECK(on.device->take_messages() == "");
}

namespace {

template <class T>
std::uint64_t scroll_differences(backend::Backend& b, Random& random, backend::DepthFormat format, math::Depth depth) {
    backend::TargetConfig const config{.size_px = {written_px, written_px}, .depth = format};
    std::int32_t const codes = sizeof(T) == 2 ? cascade::unorm16_codes : cascade::float_codes;
    auto const from = b.make_target(config);
    auto const to = b.make_target(config);
    Soup soup;
    for (int i = 0; i < 300; ++i) soup.positions.emplace_back(random.in(-0.2F, 1.2F), random.in(-1.2F, 0.2F), random.in(-1.3F, 0.3F));
    backend::Draw const draw{.positions = std::span<math::vec3 const>(soup.positions), .indices = {}};
    auto const list = b.keep({&draw, 1});
    REQUIRE((from && to && list));
    backend::OrthoLayer layer;
    layer.light.depth_unit_m = 1.0 / codes;
    layer.depth = depth;
    REQUIRE(b.draw_ortho(*list, *from, {&layer, 1}));
    std::vector<T> old(std::size_t{written_px} * written_px);
    REQUIRE(b.read({*from, 0, backend::Plane::depth, {0, 0, written_px, written_px}}, std::as_writable_bytes(std::span(old))));
    std::uint64_t wrong = 0;
    for (int i = 0; i < 20; ++i) {
        auto const dx = static_cast<std::int64_t>(random.next() % 151) - 75;
        auto const dy = static_cast<std::int64_t>(random.next() % 151) - 75;
        auto const dz = (static_cast<std::int64_t>(random.next() % 2001) - 1000) * (codes / 3000);
        cascade::MapScroll const by{{dx / (i % 3 + 1), dy / (i % 4 + 1), i % 5 == 0 ? 0 : dz}, codes, depth};
        formula::GnScroll const words = cascade::shader_scroll(by, written_px, sizeof(T) == 2);
        std::array const source{backend::TargetBinding{*from}};
        REQUIRE(b.write_depth(scroll_map_kernel, {.to = *to, .rect = {0, 0, written_px, written_px}, .targets = source,
                                                  .constants = backend::bytes_of(words)}));
        std::vector<T> moved(old.size());
        std::vector<T> wanted(old.size());
        REQUIRE(b.read({*to, 0, backend::Plane::depth, {0, 0, written_px, written_px}}, std::as_writable_bytes(std::span(moved))));
        REQUIRE(b.finish());
        auto const stats = cascade::scroll(cascade::MapTexels<T const>{old.data(), written_px, written_px},
                                           cascade::MapTexels<T>{wanted.data(), written_px, written_px}, by);
        wrong += stats.moved + stats.clamped + stats.exposed + stats.unwritten == written_px * written_px ? 0U : 1U;
        for (std::size_t k = 0; k < moved.size(); ++k) wrong += moved[k] == wanted[k] ? 0U : 1U;
    }
    return wrong;
}

}  // namespace

TEST_CASE("a map scrolled by a depth kernel is the map scrolled on the CPU", "[vulkan][backend][depth_kernel]") {
    DeviceBackend on;
    Random random{21};
    for (math::Depth const depth : {math::Depth::forward, math::Depth::reversed}) {
        CHECK(scroll_differences<std::uint16_t>(*on.gpu, random, backend::DepthFormat::unorm16, depth) == 0);
        CHECK(scroll_differences<float>(*on.gpu, random, backend::DepthFormat::f32, depth) == 0);
    }
    CHECK(on.device->take_messages() == "");
}
