#pragma once
// The light scenes of the yardsticks: splitmix64, seven draws a light, in culling space (y down, depth in front).

#include <gnomon/cluster/grid_view.hpp>
#include <gnomon/math/vec.hpp>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace gnomon::test {

struct SceneLight {
    math::vec3 center;
    float range;
    math::vec3 axis;
    float half_angle_rad;
};

struct LightScene {
    char const* name;
    bool by_volume;  ///< V: uniform in the volume; D: uniform in depth
    double r0, r1;
};

inline constexpr LightScene light_scenes[] = {{"V 1-3", true, 1, 3}, {"V 10", true, 10, 10}, {"D 1-3", false, 1, 3}, {"D 10", false, 10, 10}};

inline std::vector<SceneLight> make_lights(LightScene const& scene, std::size_t count) {
    std::uint64_t state = 0xC0FFEE;
    auto const draw = [&state] {
        state += 0x9E3779B97F4A7C15U;
        std::uint64_t z = state;
        z = (z ^ (z >> 30U)) * 0xBF58476D1CE4E5B9U;
        z = (z ^ (z >> 27U)) * 0x94D049BB133111EBU;
        return static_cast<double>((z ^ (z >> 31U)) >> 11U) / 9007199254740992.0;
    };
    double const pi = 3.14159265358979323846;
    double const tan30 = std::tan(pi / 6);
    std::vector<SceneLight> lights;
    for (std::size_t i = 0; i < count; ++i) {
        double v[7];
        for (double& x : v) x = draw();
        double const d = scene.by_volume ? std::cbrt(0.001 + v[0] * (1e6 - 0.001)) : 0.1 + 99.9 * v[0];
        double const x = (2 * v[1] - 1) * d * tan30 * 16 / 9;
        double const y = (2 * v[2] - 1) * d * tan30;
        double const cz = 2 * v[4] - 1;
        double const s = std::sqrt(1 - cz * cz);
        double const phi = 2 * pi * v[5];
        lights.push_back({math::to_float(math::dvec3(x, -y, d)), static_cast<float>(scene.r0 + v[3] * (scene.r1 - scene.r0)),
                          math::to_float(math::dvec3(s * std::cos(phi), -s * std::sin(phi), -cz)),
                          static_cast<float>((15 + 30 * v[6]) * pi / 180)});
    }
    return lights;
}

/// 27 x 15 x 16 clusters of 72 pixels; the last column reaches to pixel 1,944.
struct YardGrid {
    std::vector<float> x, y, depth_m;

    YardGrid() {
        double const tan30 = std::tan(3.14159265358979323846 / 6);
        for (int i = 0; i <= 27; ++i) x.push_back(static_cast<float>((i * 72 / 960.0 - 1) * tan30 * 16 / 9));
        for (int j = 0; j <= 15; ++j) y.push_back(static_cast<float>((j * 72 / 540.0 - 1) * tan30));
        depth_m.push_back(0.1F);
        for (int k = 1; k <= 16; ++k) depth_m.push_back(static_cast<float>(100 * std::pow(20.0, (k - 16) / 15.0)));
    }
    [[nodiscard]] cluster::GridView view() const { return {x, y, depth_m}; }
};

}  // namespace gnomon::test
