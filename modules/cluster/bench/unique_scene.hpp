#pragma once
// Keys of a 1920x1080 picture: a ground with posts and balls, and leaves of a few pixels before half of it if asked for.

#include <gnomon/cluster.hpp>

#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

namespace scene {

using namespace gnomon;

inline std::uint32_t hashed(std::uint32_t x) {
    x = (x ^ x >> 16U) * 0x7FEB352DU;
    x = (x ^ x >> 15U) * 0x846CA68BU;
    return x ^ x >> 16U;
}

inline float part(std::uint32_t x) { return static_cast<float>(hashed(x) >> 8U) * 0x1p-24F; }

struct Sample {
    float depth_m = std::numeric_limits<float>::infinity();
    math::vec3 normal{0.0F};
};

/// What a ray from the origin, one metre deep per unit, meets first.
inline Sample trace(float x, float y) {
    Sample best;
    if (y > 0.0F) best = {1.7F / y, math::vec3(0.0F, 1.0F, 0.0F)};
    for (std::uint32_t i = 0; i < 60; ++i) {
        float const depth = 3.0F + 100.0F * part(7 * i) * part(7 * i + 1);
        math::vec3 const c(depth * 2.4F * (part(7 * i + 2) - 0.5F), 1.7F - 3.0F * part(7 * i + 3), depth);
        float const r = i % 2 == 0 ? 0.15F + 0.2F * part(7 * i + 4) : 0.4F + 1.5F * part(7 * i + 4);
        float const yy = i % 2 == 0 ? 0.0F : 1.0F;  // posts have no end
        float const a = x * x + yy * y * y + 1.0F;
        float const b = x * c.x + yy * y * c.y + c.z;
        float const d = b * b - a * (c.x * c.x + yy * c.y * c.y + c.z * c.z - r * r);
        if (d < 0.0F) continue;
        float const t = (b - std::sqrt(d)) / a;
        if (t < 0.1F || t >= best.depth_m) continue;
        math::vec3 const n((x * t - c.x) / r, -yy * (y * t - c.y) / r, (c.z - t) / r);
        best = {t, n};
    }
    return best;
}

inline Sample leaf(std::uint32_t x, std::uint32_t y, Sample behind) {
    std::uint32_t const id = x / 5 * 4096 + y / 4;
    if (x < 700 || part(id) > 0.4F) return behind;
    float const depth = 4.0F + 20.0F * part(id + 77);
    math::vec3 const n(part(id + 1) - 0.5F, part(id + 2) - 0.5F, part(id + 3));
    return depth < behind.depth_m ? Sample{depth, n} : behind;
}

struct Picture {
    cluster::KeyLayout<std::uint32_t> layout;
    std::vector<std::uint32_t> keys;
};

inline Picture picture(bool leaves, std::uint32_t normal_n) {
    math::PerspectiveConfig config;
    config.size_px = {1920, 1080};
    config.far_m = 1000.0;
    auto const view = math::make_perspective(config).value();
    auto const grid = cluster::make_grid(view, math::ivec2(32, 32), cluster::make_cubical_slices(view, 32, 1000.0).value()).value();
    Picture p{cluster::make_key_layout<std::uint32_t>(grid.view(), normal_n).value(), {}};
    for (std::uint32_t y = 0; y < 1080; ++y)
        for (std::uint32_t x = 0; x < 1920; ++x) {
            math::vec3 const at = position_at(grid, math::vec2(static_cast<float>(x) + 0.5F, static_cast<float>(y) + 0.5F), 1.0F);
            Sample s = trace(at.x, at.y);
            if (leaves) s = leaf(x, y, s);
            bool const none = !(s.depth_m < 1e30F);
            p.keys.push_back(none ? cluster::no_key<std::uint32_t> : key_at(grid, p.layout, math::uvec2(x, y), s.depth_m, s.normal));
        }
    return p;
}

/// One picture of each kind, made once.
inline Picture const& shared_picture(bool leaves, std::uint32_t normal_n) {
    static std::array<Picture, 4> pictures;
    Picture& p = pictures[(leaves ? 2U : 0U) + (normal_n == 0 ? 0U : 1U)];
    if (p.keys.empty()) p = picture(leaves, normal_n);
    return p;
}

}  // namespace scene
