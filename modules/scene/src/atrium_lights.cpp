#include "detail/atrium_lights.hpp"

#include "detail/pcg32.hpp"

#include <array>

namespace gnomon::scene::detail {

namespace {

using math::dvec3;

/// Full colours round the wheel, the same brightness for all.
math::vec3 hue(double turns) noexcept {
    math::vec3 color;
    for (int channel = 0; channel < 3; ++channel) {
        double const x = turns * 6.0 + (channel == 0 ? 0.0 : channel == 1 ? 4.0 : 2.0);
        double const t = x - 6.0 * static_cast<double>(static_cast<int>(x / 6.0));
        double const distance = t < 3.0 ? 3.0 - t : t - 3.0;  // 0 opposite, 3 at the channel's own place
        color[channel] = static_cast<float>(distance < 1.0 ? 0.15 : distance > 2.0 ? 1.0 : 0.15 + 0.85 * (distance - 1.0));
    }
    return color;
}

Light ranged(std::string name, dvec3 const& at, double range_m, double intensity) {
    Light light;
    light.name = std::move(name);
    light.kind = LightKind::point;
    light.position_m = at;
    light.range_m = static_cast<float>(range_m);
    light.intensity = static_cast<float>(intensity);
    return light;
}

/// The lanterns, and 17 lamps over the court: rows at three heights along it.
void add_sponza_lights(Scene& scene) {
    constexpr math::vec3 warm{1.0F, 0.72F, 0.42F};
    std::vector<dvec3> places = lantern_places();
    for (int i = 0; i < 17; ++i) {
        double const z = i % 3 == 0 ? 0.0 : i % 3 == 1 ? 3.4 : -3.4;
        places.emplace_back((i - 8) * 1.6, 3.2 + 4.4 * (i % 4), z);
    }
    for (std::size_t i = 0; i < places.size(); ++i)
        scene.lights.push_back(ranged("light " + std::to_string(i + 1), places[i], 6.0, 6.0));
    for (Light& light : scene.lights) light.color = warm;
}

struct Swarm {
    std::uint32_t count;
    double range_m;
};

/// So that an occupied cluster of the view `still` meets 45 of the million on average; the README says which clusters.
constexpr double million_range_m = 0.178;

void add_swarm(Scene& scene, Swarm const& swarm, std::uint64_t seed) {
    Pcg32 random(seed);
    scene.lights.reserve(swarm.count);
    // A surface in the middle of the swarm gets about as much light from all of them, however many there are.
    double const others = swarm.count * (4.19 * swarm.range_m * swarm.range_m * swarm.range_m) / 20'000.0;
    double const intensity = 6.0 * swarm.range_m * swarm.range_m / (1.0 + others);
    for (std::uint32_t i = 0; i < swarm.count; ++i) {
        dvec3 at;
        at.x = random.uniform(-20.0, 20.0);
        at.y = random.uniform(0.0, 20.0);
        at.z = random.uniform(-12.5, 12.5);
        Light light = ranged("light " + std::to_string(i + 1), at, swarm.range_m, intensity);
        light.color = hue(random.uniform());
        scene.lights.push_back(std::move(light));
    }
}

}  // namespace

std::vector<dvec3> lantern_places() {
    std::vector<dvec3> places;
    for (double const y : {5.25, 17.0})
        for (double const side : {-1.0, 1.0}) {
            for (int i = -4; i <= 4; ++i) places.emplace_back(i * 4.0 + (i == 4 ? 1.0 : i == -4 ? -1.0 : 0.0), y, side * 9.25);
            for (int i = -1; i <= 1; ++i) places.emplace_back(side * 17.0, y, i * 4.0);
        }
    return places;
}

void add_atrium_lights(Scene& scene, ProceduralConfig const& config) {
    std::uint64_t const seed = seed_of(config, 1);
    if (config.lights == "sun") {
        scene.lights.push_back(sun_light());
        scene.lights.back().direction = glm::normalize(dvec3(0.36, -0.88, -0.3));  // high enough to reach the floor
    } else if (config.lights == "sponza65")
        add_sponza_lights(scene);
    else if (config.lights == "million")
        add_swarm(scene, {atrium_million, million_range_m}, seed);
    else
        add_swarm(scene, {static_cast<std::uint32_t>(std::stoul(config.lights)), 2.5}, seed);
}

}  // namespace gnomon::scene::detail
