#include <gnomon/check/check.hpp>
#include <gnomon/projection.hpp>
#include <gnomon/shadow.hpp>

#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

namespace {

using namespace gnomon;

struct ManyScene {
    std::vector<shadow::MapView> maps;
    std::vector<float> f32;
    std::vector<std::uint16_t> unorm16;
    std::vector<shadow::Surface> surfaces;
};

ManyScene many_scene() {
    std::uint32_t state = 7;
    auto const random = [&](float lo, float hi) {
        state = state * 1664525U + 1013904223U;
        return lo + (hi - lo) * (static_cast<float>(state >> 8U) * 0x1p-24F);
    };
    ManyScene scene;
    for (math::Depth const depth : {math::Depth::forward, math::Depth::reversed}) {
        projection::DirectionalConfig sun;
        sun.size_px = math::ivec2(64, 64);
        sun.depth = depth;
        math::Aabb const box{math::vec3(-10.0F), math::vec3(10.0F)};
        auto const a = projection::directional_view(math::dvec3(-0.45, -0.8, -0.4), box, {}, sun).value();
        projection::CubeConfig cube;
        cube.position_m = math::dvec3(0.0, 4.0, 0.0);
        cube.size_px = 64;
        cube.depth = depth;
        auto const b = projection::cube_views(cube).value()[3];
        for (auto const& view : {a, b})
            for (shadow::Format const format : {shadow::Format::f32, shadow::Format::unorm16})
                scene.maps.push_back(shadow::make_map_view(view, math::dvec3(0.0), format));
    }
    for (int i = 0; i < 64 * 64; ++i) {
        scene.f32.push_back(random(0.0F, 1.0F));
        scene.unorm16.push_back(static_cast<std::uint16_t>(random(0.0F, 65535.0F)));
    }
    float const inf = std::numeric_limits<float>::infinity();
    for (float const x : {std::numeric_limits<float>::quiet_NaN(), inf, -inf, 3e38F, 0.0F})
        scene.surfaces.push_back({math::vec3(x, 0.0F, x), math::vec3(0.0F, 1.0F, 0.0F)});
    for (int i = 0; i < 1000; ++i) {
        math::vec3 const n{random(-1.0F, 1.0F), random(-0.2F, 1.0F), random(-1.0F, 1.0F)};
        math::vec3 const p{random(-12.0F, 12.0F), random(-12.0F, 12.0F), random(-12.0F, 12.0F)};
        scene.surfaces.push_back({p, glm::normalize(n)});
    }
    return scene;
}

bool is_same(shadow::Lookup const& a, shadow::Lookup const& b) {
    return std::bit_cast<std::uint32_t>(a.visibility) == std::bit_cast<std::uint32_t>(b.visibility) &&
           std::bit_cast<std::uint32_t>(a.bias_m) == std::bit_cast<std::uint32_t>(b.bias_m);
}

/// How many of the first `count` surfaces `look_up_many` and its widths see otherwise than `look_up`.
template <class Source>
int differing_lookups(ManyScene const& scene, shadow::MapView const& map, Source const& texels,
                      shadow::LookupConfig const& config, std::size_t count) {
    auto const surfaces = std::span(scene.surfaces).first(count);
    shadow::Lookup const untouched{-7.0F, -7.0F};
    std::vector<shadow::Lookup> many(count + 1, untouched);
    std::vector<shadow::Lookup> four(count + 1, untouched);
    std::vector<shadow::Lookup> eight(count + 1, untouched);
    shadow::look_up_many(map, texels, config, surfaces, std::span(many).first(count));
    auto const settings = shadow::formula_config(config);
    shadow::detail::look_up_lanes<4>(map, texels, settings, surfaces, std::span(four).first(count));
    shadow::detail::look_up_lanes<8>(map, texels, settings, surfaces, std::span(eight).first(count));
    int differing = is_same(many[count], untouched) && is_same(four[count], untouched) && is_same(eight[count], untouched) ? 0 : 1;
    for (std::size_t i = 0; i < count; ++i) {
        shadow::Lookup const one = shadow::look_up(map, texels, surfaces[i].position, surfaces[i].normal, config);
        differing += is_same(one, many[i]) && is_same(one, four[i]) && is_same(one, eight[i]) ? 0 : 1;
    }
    return differing;
}

}  // namespace

TEST_CASE("lookups of many surfaces at once have the bits of one at a time", "[shadow][lanes]") {
    ManyScene const scene = many_scene();
    for (std::size_t m = 0; m < scene.maps.size(); ++m)
        for (int i = 0; i < 12; ++i) {
            shadow::LookupConfig config;
            config.taps = 1 + i % 6;
            config.bias.automatic = i % 3 != 0;
            config.bias.receiver_plane = i % 4 != 0;
            config.bias.normal_offset = i % 5 == 0 ? 1.5F : 0.0F;
            config.bias.unit = i % 2 == 0 ? shadow::BiasUnit::texels : shadow::BiasUnit::metres;
            shadow::Texels<float> const f32{scene.f32.data(), 64};
            shadow::Texels<std::uint16_t> const unorm16{scene.unorm16.data(), 64};
            CAPTURE(m, i);
            CHECK(differing_lookups(scene, scene.maps[m], f32, config, scene.surfaces.size()) == 0);
            CHECK(differing_lookups(scene, scene.maps[m], unorm16, config, 1 + static_cast<std::size_t>(i)) == 0);
        }
}

TEST_CASE("no surfaces are no lookups", "[shadow][lanes]") {
    ManyScene const scene = many_scene();
    CHECK(differing_lookups(scene, scene.maps[0], shadow::Texels<float>{scene.f32.data(), 64}, {}, 0) == 0);
}
