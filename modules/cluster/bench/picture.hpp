#pragma once
// Samples and keys of a 1920x1080 picture: a ground with posts and balls, and leaves of a few pixels before half of it if asked for.

#include <gnomon/cluster.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <ctime>
#include <limits>
#include <memory>
#include <vector>

namespace scene {

using namespace gnomon;

inline std::uint32_t hashed(std::uint32_t x) {
    x = (x ^ x >> 16U) * 0x7FEB352DU;
    x = (x ^ x >> 15U) * 0x846CA68BU;
    return x ^ x >> 16U;
}

inline float part(std::uint32_t x) { return static_cast<float>(hashed(x) >> 8U) * 0x1p-24F; }

/// CPU time of this process: other processes' load does not count.
inline double cpu_seconds() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

/// Least times of a thing and of its peer, run in turn, so that both see the same machine as often.
struct Race {
    double ours_s = std::numeric_limits<double>::infinity();
    double peer_s = std::numeric_limits<double>::infinity();

    template <class Ours, class Peer>
    void run(Ours&& ours, Peer&& peer) {
        double const start = cpu_seconds();
        ours();
        double const middle = cpu_seconds();
        peer();
        ours_s = std::min(ours_s, middle - start);
        peer_s = std::min(peer_s, cpu_seconds() - middle);
    }
};

struct Sample {
    float depth_m = std::numeric_limits<float>::infinity();
    math::vec3 normal{0.0F};
};

/// What a ray from the origin, one metre deep per unit, meets first.
inline Sample trace(float x, float y) {
    Sample best;
    if (y > 0.0017F) best = {1.7F / y, math::vec3(0.0F, 1.0F, 0.0F)};
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
    cluster::Grid grid;
    cluster::KeyLayout<std::uint32_t> layout;
    std::vector<float> depth_m;
    std::vector<math::vec3> positions;
    std::vector<math::vec3> normals;
    std::vector<std::uint32_t> keys;
};

inline Picture picture(bool leaves, std::uint32_t normal_n) {
    math::PerspectiveConfig config;
    config.size_px = {1920, 1080};
    config.far_m = 1000.0;
    auto const view = math::make_perspective(config).value();
    Picture p{cluster::make_grid(view, math::ivec2(32, 32), cluster::make_cubical_slices(view, 32, 1000.0).value()).value(), {}, {}, {}, {}, {}};
    p.layout = cluster::make_key_layout<std::uint32_t>(p.grid.view(), normal_n).value();
    for (std::uint32_t y = 0; y < 1080; ++y)
        for (std::uint32_t x = 0; x < 1920; ++x) {
            math::vec2 const px(static_cast<float>(x) + 0.5F, static_cast<float>(y) + 0.5F);
            math::vec3 const at = position_at(p.grid, px, 1.0F);
            Sample s = trace(at.x, at.y);
            if (leaves) s = leaf(x, y, s);
            p.depth_m.push_back(s.depth_m);
            p.positions.push_back(position_at(p.grid, px, s.depth_m));
            p.normals.push_back(s.normal);
        }
    p.keys.resize(p.depth_m.size());
    cluster::make_keys(p.grid, p.layout, {p.depth_m, p.normals}, std::span<std::uint32_t>(p.keys));
    return p;
}

/// One picture of each kind, made once.
inline Picture const& shared_picture(bool leaves, std::uint32_t normal_n) {
    static std::array<std::unique_ptr<Picture>, 4> pictures;
    auto& p = pictures[(leaves ? 2U : 0U) + (normal_n == 0 ? 0U : 1U)];
    if (!p) p = std::make_unique<Picture>(picture(leaves, normal_n));
    return *p;
}

}  // namespace scene
