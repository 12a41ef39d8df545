#pragma once
// Small scenes for the passes: triangles at random, in front of a camera.

#include <gnomon/backend/draw.hpp>
#include <gnomon/backend/pass.hpp>
#include <gnomon/math/view.hpp>

#include <cstdint>
#include <vector>

namespace gnomon::vulkan::test {

/// splitmix64
struct Random {
    std::uint64_t state = 1;

    std::uint64_t next() {
        std::uint64_t z = (state += 0x9E3779B97F4A7C15U);
        z = (z ^ (z >> 30U)) * 0xBF58476D1CE4E5B9U;
        z = (z ^ (z >> 27U)) * 0x94D049BB133111EBU;
        return z ^ (z >> 31U);
    }
    float in(float low, float high) { return low + (high - low) * (static_cast<float>(next() >> 40U) * 0x1p-24F); }
};

struct Soup {
    std::vector<math::vec3> positions;
    std::vector<math::vec2> uv;
    std::vector<std::uint32_t> indices;

    [[nodiscard]] backend::Draw draw() const {
        return {.positions = std::span<math::vec3 const>(positions), .indices = std::span<std::uint32_t const>(indices)};
    }
};

/// `count` triangles within a ball around (0, 0, -6), sides about `size_m`; sharing corners, in no order.
inline Soup make_soup(std::uint64_t seed, int count, float size_m) {
    Random random{seed};
    Soup soup;
    for (int i = 0; i < count; ++i) {
        math::vec3 const middle{random.in(-3, 3), random.in(-3, 3), random.in(-8, -3)};
        for (int k = 0; k < 3; ++k) {
            soup.indices.push_back(static_cast<std::uint32_t>(soup.positions.size()));
            soup.positions.push_back(middle + math::vec3{random.in(-1, 1), random.in(-1, 1), random.in(-1, 1)} * size_m);
            soup.uv.push_back({random.in(-2, 2), random.in(-2, 2)});
        }
        if (i % 4 == 3) soup.indices[soup.indices.size() - 2] = soup.indices[soup.indices.size() - 7];
    }
    return soup;
}

inline math::View camera(math::ivec2 size_px, math::Depth depth = math::Depth::reversed, math::dvec3 eye_m = {0.3, 0.2, 1.0}) {
    return math::make_perspective({.eye_m = eye_m,
                                   .target_m = math::dvec3(0, 0, -5),
                                   .near_m = 0.5,
                                   .far_m = 100.0,
                                   .size_px = size_px,
                                   .depth = depth})
        .value();
}

inline backend::PassLayer layer_of(math::View const& view) {
    backend::PassLayer layer;
    layer.origin = math::to_float(view.eye_m);
    layer.clip_from_relative = math::clip_from_relative(view);
    layer.depth = view.depth;
    return layer;
}

}  // namespace gnomon::vulkan::test
