#pragma once
// A forest for alpha-tested passes: 81 instances of one tree, 7,400 triangles each, of which 7,200 are leaf quads under
// a texture of 1024 x 1024 texels with a twig of eleven leaves. 599k triangles in all.

#include <gnomon/math/view.hpp>
#include <gnomon/raster.hpp>

#include <cmath>
#include <cstdint>
#include <vector>

namespace bench {

namespace math = gnomon::math;
namespace raster = gnomon::raster;

struct Forest {
    std::vector<math::vec3> positions;
    std::vector<math::vec2> uv;
    std::vector<std::uint32_t> leaves;
    std::vector<std::uint32_t> trunk;
    std::vector<math::mat4> trees;
    std::vector<std::uint8_t> rgba;
    raster::AlphaTest test;
    raster::AlphaMap map;
    std::uint64_t state = 4711;

    float random() {
        state = state * 6364136223846793005ULL + 1442695040888963407ULL;
        return static_cast<float>(state >> 40U) * 0x1p-24F;
    }

    Forest() {
        draw_texture();
        for (int i = 0; i < 3600; ++i) add_leaf();
        for (int i = 0; i < 100; ++i) add_trunk_quad(i);
        for (int i = 0; i < 81; ++i) {
            float const turn = random() * 6.2831853F;
            float const size = 0.7F + 0.6F * random();
            math::mat4 m(size);
            m[0][0] = m[2][2] = size * std::cos(turn);
            m[0][2] = size * std::sin(turn);
            m[2][0] = -m[0][2];
            m[3] = math::vec4{static_cast<float>(i % 9) * 30.0F - 120.0F + 12.0F * random(), 0.0F,
                              static_cast<float>(i / 9) * 30.0F - 120.0F + 12.0F * random(), 1.0F};
            trees.push_back(m);
        }
        test.uv = std::span<math::vec2 const>(uv);
        test.texture = {.texels = rgba, .size_px = {1024, 1024}};
        map = raster::make_alpha_map(test);
    }

    /// Leaves and trunks of all trees, as `view` sees them.
    [[nodiscard]] std::vector<raster::Draw> draws(math::View const& view) const {
        raster::Draw leaf{.positions = std::span<math::vec3 const>(positions),
                          .indices = std::span<std::uint32_t const>(leaves),
                          .origin = math::to_float(view.eye_m),
                          .clip_from_relative = math::clip_from_relative(view),
                          .alpha_test = &test,
                          .instances = gnomon::core::StridedSpan<math::mat4>(std::span<math::mat4 const>(trees))};
        raster::Draw bark = leaf;
        bark.indices = std::span<std::uint32_t const>(trunk);
        bark.alpha_test = nullptr;
        return {bark, leaf};
    }

    void add_quad(math::vec3 o, math::vec3 u, math::vec3 v, std::vector<std::uint32_t>& to) {
        auto const first = static_cast<std::uint32_t>(positions.size());
        positions.insert(positions.end(), {o, o + u, o + v, o + u + v});
        uv.insert(uv.end(), {math::vec2(0, 1), math::vec2(1, 1), math::vec2(0, 0), math::vec2(1, 0)});
        to.insert(to.end(), {first, first + 1, first + 2, first + 1, first + 3, first + 2});
    }

    void add_leaf() {
        float const height = 8.0F + 22.0F * random();
        float const reach = 2.0F + 8.0F * (1.0F - std::abs(height - 16.0F) / 16.0F);
        float const turn = random() * 6.2831853F;
        float const far = reach * std::sqrt(random());
        math::vec3 const at(far * std::cos(turn), height, far * std::sin(turn));
        auto const side = [&] { return math::vec3{random() - 0.5F, random() - 0.5F, random() - 0.5F} * 2.6F; };
        math::vec3 const u = side();
        add_quad(at, u, side(), leaves);
    }

    void add_trunk_quad(int i) {
        float const a = static_cast<float>(i % 10) * 0.62831853F;
        float const b = a + 0.62831853F;
        math::vec3 const o(0.5F * std::cos(a), static_cast<float>(i / 10) * 2.0F, 0.5F * std::sin(a));
        add_quad(o, math::vec3(0.5F * std::cos(b), o.y, 0.5F * std::sin(b)) - o, math::vec3(0, 2, 0), trunk);
    }

    /// Ellipses along a stem, antialiased over two texels.
    void draw_texture() {
        constexpr int size = 1024;
        rgba.assign(std::size_t{4} * size * size, 90);
        for (int y = 0; y < size; ++y)
            for (int x = 0; x < size; ++x) {
                float alpha = 0.0F;
                for (int leaf = 0; leaf < 11; ++leaf) {
                    auto const cx = static_cast<float>(leaf == 10 ? 512 : leaf % 2 == 0 ? 320 : 704);
                    float const cy = 150.0F + static_cast<float>(leaf / 2) * 165.0F;
                    float const tilt = leaf == 10 ? 0.0F : leaf % 2 == 0 ? 0.5F : -0.5F;
                    float const dx = static_cast<float>(x) - cx;
                    float const dy = static_cast<float>(y) - cy + tilt * dx;
                    float const r = std::sqrt(dx * dx / (190.0F * 190.0F) + dy * dy / (62.0F * 62.0F));
                    alpha = std::max(alpha, (1.0F - r) * 31.0F + 0.5F);
                }
                alpha = std::abs(x - 512) < 7 ? 1.0F : alpha;
                auto const at = static_cast<std::size_t>(y * size + x) * 4 + 3;
                rgba[at] = static_cast<std::uint8_t>(255.0F * std::min(1.0F, std::max(0.0F, alpha)));
            }
    }
};

/// The forest from the sun, all of it in the image.
inline math::View make_forest_view(int size_px) {
    math::View view;
    view = math::looking_along(view, math::dvec3(-0.45, -0.80, -0.40), math::dvec3(0, 1, 0));
    view.eye_m = {0.0, 15.0, 0.0};
    view.window = {-190.0, 190.0, -190.0, 190.0};
    view.near_m = -300.0;
    view.far_m = 300.0;
    view.size_px = {size_px, size_px};
    view.lens = math::Lens::orthographic;
    return view;
}

}  // namespace bench
