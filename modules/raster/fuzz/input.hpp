#pragma once
// Draws and pass settings from raw bytes, for the rasterizer's fuzz targets, and the seeds that write such bytes.

#include <gnomon/check/fuzz_input.hpp>
#include <gnomon/raster.hpp>

#include <array>
#include <deque>
#include <vector>

namespace fuzz {

using namespace gnomon;

/// What a draw's views look at.
struct DrawData {
    std::vector<unsigned char> positions;
    std::vector<std::uint32_t> index32;
    std::vector<std::uint16_t> index16;
    std::vector<math::vec2> uv;
    std::vector<std::uint8_t> texels;
    raster::AlphaTest test;
    raster::Draw draw;
};

struct Input {
    std::int32_t width = 1;
    std::int32_t height = 1;
    bool unorm16 = false;
    raster::PassConfig config;
    std::deque<DrawData> data;  // Does not move: draws hold pointers.
    std::vector<raster::Draw> draws;
};

inline constexpr int max_size = 150;
inline constexpr int max_draws = 3;
inline constexpr int max_vertices = 48;
inline constexpr int max_indices = 96;

inline raster::Rect take_rect(check::FuzzBytes& in) {
    bool const wild = in.flag();
    int const at = wild ? raster::max_size_px : 64;
    int const size = wild ? raster::max_size_px : 256;
    return {in.in(-at, at), in.in(-at, at), in.in(0, size), in.in(0, size)};
}

inline void take_config(check::FuzzBytes& in, raster::PassConfig& config) {
    config.depth = in.flag() ? math::Depth::reversed : math::Depth::forward;
    config.range = in.flag() ? raster::DepthRange::clamp : raster::DepthRange::clip;
    config.load = in.flag() ? raster::Load::keep : raster::Load::clear;
    if (in.flag()) config.viewport = take_rect(in);
    if (in.flag()) config.scissor = take_rect(in);
}

/// Raw floats, or a camera at the origin, or none.
inline math::mat4 take_matrix(check::FuzzBytes& in) {
    int const kind = in.in(0, 2);
    math::mat4 m(1.0F);
    if (kind == 1) {  // w = -z, near plane at 1/8, reversed
        m[2][2] = 0.0F;
        m[3][2] = 0.125F;
        m[2][3] = -1.0F;
        m[3][3] = 0.0F;
    }
    for (math::axis_t c = 0; kind == 2 && c < 4; ++c)
        for (math::axis_t r = 0; r < 4; ++r) m[c][r] = in.take<float>();
    return m;
}

/// Raw floats, or multiples of 1/4096 in [-8, 8).
inline float take_coordinate(check::FuzzBytes& in, bool raw) {
    return raw ? in.take<float>() : static_cast<float>(in.take<std::int16_t>()) / 4096.0F;
}

inline void take_positions(check::FuzzBytes& in, DrawData& data) {
    std::size_t const stride = in.flag() ? 20 : 12;
    auto const count = static_cast<std::size_t>(in.in(0, max_vertices));
    bool const raw = in.flag();
    data.positions.assign(count * stride, 0xA5);
    for (std::size_t i = 0; i < count; ++i) {
        std::array<float, 3> p{};
        for (float& x : p) x = take_coordinate(in, raw);
        std::memcpy(data.positions.data() + i * stride, p.data(), sizeof p);
    }
    data.draw.positions = {data.positions.data(), count, stride};
}

inline void take_indices(check::FuzzBytes& in, DrawData& data) {
    int const kind = in.in(0, 2);
    auto const count = static_cast<std::size_t>(in.in(0, max_indices));
    for (std::size_t i = 0; kind != 0 && i < count; ++i) {
        bool const wild = in.take<std::uint8_t>() == 255;
        std::uint32_t const index = wild ? in.take<std::uint32_t>() : in.take<std::uint8_t>() % (max_vertices + 2U);
        if (kind == 1)
            data.index32.push_back(index);
        else
            data.index16.push_back(static_cast<std::uint16_t>(index));
    }
    if (kind == 1) data.draw.indices = std::span<std::uint32_t const>(data.index32);
    if (kind == 2) data.draw.indices = std::span<std::uint16_t const>(data.index16);
}

inline void take_alpha_test(check::FuzzBytes& in, DrawData& data) {
    math::ivec2 const size(in.in(0, 4), in.in(0, 4));
    std::int32_t const channels = in.flag() ? 4 : 1;
    for (int i = 0; i < size.x * size.y * channels; ++i) data.texels.push_back(in.take<std::uint8_t>());
    bool const short_of_uv = in.flag();
    bool const raw = in.flag();
    for (std::size_t i = short_of_uv ? 1 : 0; i < data.draw.positions.size(); ++i) {
        float const u = take_coordinate(in, raw);
        data.uv.push_back(math::vec2(u, take_coordinate(in, raw)));
    }
    data.test.uv = std::span<math::vec2 const>(data.uv);
    data.test.texture = {.texels = data.texels,
                         .size_px = size,
                         .wrap_u = static_cast<math::Wrap>(in.in(0, 2)),
                         .wrap_v = static_cast<math::Wrap>(in.in(0, 2)),
                         .channels = channels};
    data.test.cutoff = in.flag() ? static_cast<double>(in.take<float>()) : 0.5;
    data.draw.alpha_test = &data.test;
}

inline void take_draw(check::FuzzBytes& in, DrawData& data) {
    data.draw.clip_from_relative = take_matrix(in);
    if (in.flag()) {
        float const x = in.take<float>();
        float const y = in.take<float>();
        data.draw.origin = math::vec3(x, y, in.take<float>());
    }
    data.draw.cull = static_cast<raster::Cull>(in.in(0, 2));
    data.draw.first_triangle = in.flag() ? in.take<std::uint32_t>() : 0;
    bool const masked = in.flag();
    take_positions(in, data);
    take_indices(in, data);
    if (masked) take_alpha_test(in, data);
}

inline void take_input(check::FuzzBytes& in, Input& input) {
    input.width = in.in(1, max_size);
    input.height = in.in(1, max_size);
    input.unorm16 = in.flag();
    take_config(in, input.config);
    int const draws = in.in(1, max_draws);
    for (int i = 0; i < draws; ++i) {
        take_draw(in, input.data.emplace_back());
        input.draws.push_back(input.data.back().draw);
    }
}

/// The only pixels that a pass may write.
inline raster::Rect drawn_rect(Input const& input) {
    return input.config.scissor.value_or(raster::Rect{0, 0, input.width, input.height});
}

/// What a seed says of its one draw.
struct Seed {
    int size = 100;
    bool unorm16 = false, reversed = true, clamp = false, keep = false, viewport = false, scissor = false;
    int matrix = 1;  // 0: identity, 1: camera, 2: raw
    bool raw_positions = false, masked = false;
    int index_kind = 0;
    int vertices = 24;
    float reach = 3.0F;
};

/// The bytes that `take_input` reads as the seed, with random corners.
inline std::vector<std::uint8_t> write_seed(Seed const& seed, std::uint64_t number) {
    check::FuzzRandom random{number};
    auto const unit = [&] { return static_cast<float>(random.next() >> 40U) * 0x1p-24F; };
    check::FuzzWriter out;
    out.in(1, seed.size).in(1, seed.size - 7).flag(seed.unorm16);
    out.flag(seed.reversed).flag(seed.clamp).flag(seed.keep);
    out.flag(seed.viewport);
    if (seed.viewport) out.flag(false).in(-64, -20).in(-64, 11).in(0, 170).in(0, 90);
    out.flag(seed.scissor);
    if (seed.scissor) out.flag(false).in(-64, 9).in(-64, -3).in(0, 77).in(0, 81);
    out.in(1, 1).in(0, seed.matrix);
    for (int i = 0; seed.matrix == 2 && i < 16; ++i) out.put(i % 5 == 0 ? 0.7F : unit() - 0.5F);
    out.flag(false).in(0, static_cast<int>(number % 3)).flag(false).flag(seed.masked);
    out.flag(seed.vertices % 2 == 0).in(0, seed.vertices).flag(seed.raw_positions);
    for (int i = 0; i < seed.vertices * 3; ++i) {
        float const x = seed.matrix == 0 && i % 3 == 2 ? unit() : (unit() - 0.5F) * seed.reach;
        if (seed.raw_positions)
            out.put(x);
        else
            out.put(static_cast<std::int16_t>(x * 4096.0F));
    }
    out.in(0, seed.index_kind).in(0, 60);
    for (int i = 0; seed.index_kind != 0 && i < 60; ++i)
        out.flag(false).put(static_cast<std::uint8_t>(random.below(static_cast<std::size_t>(seed.vertices))));
    if (!seed.masked) return out.bytes;
    out.in(0, 3).in(0, 3).flag(false);
    for (int i = 0; i < 9; ++i) out.put(static_cast<std::uint8_t>(random.next()));
    out.flag(false).flag(false);
    for (int i = 0; i < seed.vertices * 2; ++i) out.put(static_cast<std::int16_t>(random.next()));
    out.in(0, 0).in(0, 2).flag(false);
    return out.bytes;
}

inline void write_seeds(check::FuzzSeeds& out) {
    std::uint64_t n = 0;
    auto const add = [&](char const* name, Seed const& seed) { out.add(name, write_seed(seed, ++n)); };
    add("camera", {});
    add("clip_space", {.reversed = false, .matrix = 0, .reach = 2.5F});
    add("indexed32", {.index_kind = 1});
    add("indexed16", {.unorm16 = true, .index_kind = 2});
    add("clamped", {.reversed = false, .clamp = true, .matrix = 0, .reach = 6.0F});
    add("kept", {.keep = true, .scissor = true});
    add("viewport", {.viewport = true, .index_kind = 1});
    add("raw_matrix", {.matrix = 2, .raw_positions = true});
    add("far_corners", {.matrix = 0, .raw_positions = true, .reach = 4e4F});
    add("tiny", {.size = 130, .matrix = 0, .raw_positions = true, .vertices = 48, .reach = 0.05F});
    add("masked", {.masked = true});
    add("masked_raw", {.matrix = 0, .raw_positions = true, .masked = true, .index_kind = 1, .reach = 2.0F});
    add("one_pixel", {.size = 8, .raw_positions = true});
    out.add("empty", {});
}

}  // namespace fuzz
