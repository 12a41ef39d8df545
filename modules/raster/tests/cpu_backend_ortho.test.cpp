#include <gnomon/backend/null.hpp>
#include <gnomon/check/check.hpp>
#include <gnomon/raster/cpu_backend.hpp>
#include <gnomon/raster/ortho.hpp>

#include "oracle.hpp"

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace {

using namespace gnomon;
using backend::DepthFormat;

constexpr std::int32_t side = 40;

/// Three draws of loose triangles in the middle of the world.
struct Yard {
    std::vector<math::vec3> corners[3];
    std::vector<backend::Draw> draws;

    explicit Yard(std::uint32_t seed) {
        oracle::Random random(seed);
        auto const coordinate = [&] { return static_cast<float>(random.in(-600, 600)) / 1024.0F; };
        for (auto& list : corners) {
            for (int i = 0; i < 30; ++i) {
                float const x = coordinate(), y = coordinate(), z = coordinate();
                list.emplace_back(x, y, z);
            }
            draws.push_back({.positions = std::span<math::vec3 const>(list), .indices = {}});
        }
    }
};

backend::IntegerOrtho light_at(std::int64_t x, std::int64_t y, std::int64_t z) {
    return {.texel_m = 0x1p-6, .depth_unit_m = 0x1p-14, .origin_x = x, .origin_y = y, .origin_z = z};
}

std::vector<std::uint16_t> read_codes(backend::Backend& device, backend::TargetId map, std::uint32_t layer) {
    std::vector<std::uint16_t> codes(std::size_t{side} * side);
    REQUIRE(device.read({map, layer, backend::Plane::depth, {0, 0, side, side}}, std::as_writable_bytes(std::span(codes))).has_value());
    REQUIRE(device.finish().has_value());
    return codes;
}

struct Ramp {
    std::uint32_t step;
};

void ramp(backend::KernelData const& data, backend::DepthRow const& row) {
    std::uint16_t const* const from = data.targets[0].layer<std::uint16_t>(0);
    std::span<std::uint16_t> const codes = row.depths<std::uint16_t>();
    for (std::size_t i = 0; i < codes.size(); ++i) {
        auto const x = static_cast<std::uint32_t>(row.x) + static_cast<std::uint32_t>(i);
        codes[i] = static_cast<std::uint16_t>(x * data.constant<Ramp>().step + from[row.y * side]);
    }
}

constexpr backend::DepthKernel ramp_kernel{.name = "ramp", .cpu = &ramp, .spirv = {}, .targets = 1, .constant_bytes = sizeof(Ramp)};

}  // namespace

TEST_CASE("integer passes of the CPU backend are ortho_pass's, of the draws that a layer takes", "[raster][cpu_backend][ortho]") {
    Yard const yard(7);
    core::SerialExecutor executor;
    raster::CpuBackend device(executor);
    auto const list = device.keep(yard.draws);
    auto const map = device.make_target({.size_px = math::ivec2(side, side), .layers = 2, .depth = DepthFormat::unorm16});
    REQUIRE(list.has_value());
    REQUIRE(map.has_value());
    std::array const first_and_last{0U, 2U};
    math::dvec3 const origin(0.25, -0.125, 3.0);
    std::array<backend::OrthoLayer, 2> layers;
    layers[0] = {.light = light_at(-20, -15, -90000), .origin_m = origin, .draws = first_and_last};
    layers[1] = {.light = light_at(-3, -30, -70000), .origin_m = origin, .layer = 1, .scissor = backend::Rect{4, 5, 30, 20}};
    auto const counts = device.draw_ortho(*list, *map, layers);
    REQUIRE(counts.has_value());
    CHECK(counts->triangles == 20 + 30);
    CHECK(counts->draw_calls == 5);

    raster::TileWorkspace workspace;
    for (std::uint32_t i = 0; i < 2; ++i) {
        std::vector<raster::OrthoDraw> draws;
        for (std::size_t d = 0; d < 3; ++d)
            if (i == 1 || d != 1)
                draws.push_back({.positions = std::span<math::vec3 const>(yard.corners[d]), .indices = {}, .origin_m = origin});
        std::vector<std::uint16_t> wanted(std::size_t{side} * side, 0);
        auto const stats = raster::ortho_pass(draws, layers[i].light, raster::make_image(wanted.data(), side, side),
                                              {.scissor = layers[i].scissor}, workspace, executor);
        CHECK(stats.samples_written > 50);
        CHECK(read_codes(device, *map, i) == wanted);
    }
}

TEST_CASE("a depth kernel writes its rectangle and nothing else", "[raster][cpu_backend]") {
    core::SerialExecutor executor;
    raster::CpuBackend device(executor);
    backend::TargetConfig const config{.size_px = math::ivec2(side, side), .depth = DepthFormat::unorm16};
    auto const from = device.make_target(config), to = device.make_target(config);
    REQUIRE(from.has_value());
    REQUIRE(to.has_value());
    Yard const yard(3);
    auto const list = device.keep(yard.draws);
    backend::OrthoLayer const whole{.light = light_at(-20, -20, -70000)};
    REQUIRE(device.draw_ortho(*list, *from, {&whole, 1}).has_value());
    std::vector<std::uint16_t> const source = read_codes(device, *from, 0);
    std::vector<std::uint16_t> wanted = read_codes(device, *to, 0);
    backend::Rect const rect{3, 7, 21, 30};
    for (std::int32_t y = rect.y; y < rect.y + rect.height; ++y)
        for (std::int32_t x = rect.x; x < rect.x + rect.width; ++x)
            wanted[static_cast<std::size_t>(y * side + x)] =
                static_cast<std::uint16_t>(static_cast<std::uint32_t>(x) * 5U + source[static_cast<std::size_t>(y * side)]);
    Ramp const constants{5};
    std::array const targets{backend::TargetBinding{*from, backend::Plane::depth}};
    REQUIRE(device.write_depth(ramp_kernel, {.to = *to, .rect = rect, .targets = targets, .constants = backend::bytes_of(constants)})
                .has_value());
    CHECK(read_codes(device, *to, 0) == wanted);
}

TEST_CASE("integer passes and depth kernels refuse what makes no sense, in the same words on the null backend",
          "[raster][cpu_backend][ortho]") {
    core::SerialExecutor executor;
    raster::CpuBackend cpu(executor);
    backend::NullBackend null;
    Yard const yard(1);
    std::array<math::mat4, 2> const matrices{math::mat4(1.0F), math::mat4(1.0F)};
    std::vector<backend::Draw> copies = yard.draws;
    copies[1].instances = core::StridedSpan<math::mat4>(std::span<math::mat4 const>(matrices));
    auto const said = [&](backend::Backend& device) {
        std::vector<std::string> words;
        auto const list = device.keep(yard.draws), instanced = device.keep(copies);
        auto const map = device.make_target({.size_px = math::ivec2(side, side), .layers = 2, .depth = DepthFormat::unorm16});
        auto const ids = device.make_target({.size_px = math::ivec2(side, side), .triangle_ids = true});
        auto const tell = [&](auto const& result) { words.push_back(result ? "" : result.failure().message); };
        auto const draw = [&](backend::OrthoLayer const& layer) { tell(device.draw_ortho(*list, *map, {&layer, 1})); };
        draw({.light = light_at(0, 0, 0)});
        draw({.light = light_at(0, 0, 0), .layer = 2});
        draw({.light = light_at(std::int64_t{1} << 43, 0, 0)});
        backend::IntegerOrtho none = light_at(0, 0, 0);
        none.texel_m = 0.0;
        draw({.light = none});
        none = light_at(0, 0, 0);
        none.down.y = std::numeric_limits<double>::quiet_NaN();
        draw({.light = none});
        std::array const beyond{0U, 3U}, backward{1U, 0U};
        draw({.light = light_at(0, 0, 0), .draws = beyond});
        draw({.light = light_at(0, 0, 0), .draws = backward});
        std::array<backend::OrthoLayer, 2> const twice{backend::OrthoLayer{.light = light_at(0, 0, 0)},
                                                       backend::OrthoLayer{.light = light_at(9, 0, 0)}};
        tell(device.draw_ortho(*list, *map, twice));
        tell(device.draw_ortho(*list, *ids, {twice.data(), 1}));
        tell(device.draw_ortho(*instanced, *map, {twice.data(), 1}));
        tell(device.draw_ortho({}, *map, {twice.data(), 1}));
        Ramp const constants{1};
        std::array const own{backend::TargetBinding{*map, backend::Plane::depth}};
        tell(device.write_depth(ramp_kernel, {.to = *map, .rect = {0, 0, 4, 4}, .targets = own, .constants = backend::bytes_of(constants)}));
        tell(device.write_depth(ramp_kernel, {.to = *map, .rect = {38, 0, 4, 4}, .targets = own, .constants = backend::bytes_of(constants)}));
        tell(device.write_depth(ramp_kernel, {.to = *map, .rect = {0, 0, 4, 4}}));
        return words;
    };
    std::vector<std::string> const words = said(cpu);
    CHECK(words == said(null));
    CHECK(words[0] == "");
    for (std::size_t i = 1; i < words.size(); ++i) CHECK(words[i] != "");
    CHECK(words[5] == "draw_ortho: draw 3 of a list of 3");
}
