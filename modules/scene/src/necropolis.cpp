// `necropolis`: a walled city of tombs in a desert, a large hall at the end of its avenue, spirits and cannons.

#include "detail/necropolis.hpp"

#include "detail/motion.hpp"
#include "detail/rail.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace gnomon::scene::detail {

namespace {

using math::dvec3;

constexpr std::uint64_t most_triangles = 4'000'000;
constexpr std::uint32_t static_lights = 275;
constexpr std::uint32_t cannon_lights = 101;
constexpr std::uint32_t spirits = 40;
constexpr double yard_loop_s = 20.0;

/// 2 to 60 m, log-uniform in 1024 steps, by square roots alone.
double light_range_m(Pcg32& random) {
    std::uint32_t const step = random.below(1024);
    double factor = 30.0;
    double range = 2.0;
    for (std::uint32_t bit = 512; bit > 0; bit /= 2) {
        factor = std::sqrt(factor);
        if ((step & bit) != 0) range *= factor;
    }
    return range;
}

Light fire(std::string name, dvec3 const& at, double range_m) {
    Light light;
    light.name = std::move(name);
    light.kind = LightKind::point;
    light.position_m = at;
    light.color = {1.0F, 0.72F, 0.42F};
    light.range_m = static_cast<float>(range_m);
    light.intensity = static_cast<float>(0.3 * range_m * range_m);
    return light;
}

/// A third in the hall, the others over the yard.
void add_static_lights(Scene& scene, Pcg32& random, std::uint32_t count) {
    for (std::uint32_t i = 0; i < count; ++i) {
        bool const in_hall = i % 3 == 1;
        dvec3 at;
        at.x = in_hall ? random.uniform(-15.0, 15.0) : random.uniform(-yard_half_m, yard_half_m);
        at.y = in_hall ? random.uniform(1.0, 13.0) : random.uniform(0.6, 9.0);
        at.z = in_hall ? random.uniform(hall_front_z - 66.0, hall_front_z - 4.0) : random.uniform(hall_front_z + 8.0, yard_half_m);
        if (i == 0) at = {6.0, 11.0, 12.0};
        scene.lights.push_back(fire("fire " + std::to_string(i + 1), at, i == 0 ? 60.0 : light_range_m(random)));
    }
}

/// A ball of fire from a cannon on the wall: up and over into the yard, then back below the ground to the barrel.
void add_cannon_light(Scene& scene, Pcg32& random, std::uint32_t index) {
    constexpr int flight = 16;
    constexpr double flight_s = 8.0;
    dvec3 const from = cannon_mouth(index % cannons);
    dvec3 to = from * random.uniform(-0.6, 0.4);
    to.y = 0.5;
    double const height_m = random.uniform(8.0, 25.0);
    double const start_s = random.uniform(0.5, yard_loop_s - flight_s - 3.0);
    dvec3 const waits = from - dvec3(0.0, 8.0, 0.0);
    std::vector<Waypoint> way{{0.0, waits, 0.0}, {start_s - 0.4, waits, 0.0}};
    for (int i = 0; i <= flight; ++i) {
        double const t = static_cast<double>(i) / flight;
        way.push_back({start_s + flight_s * t, from + (to - from) * t + dvec3(0.0, 4.0 * height_m * t * (1.0 - t), 0.0), 0.0});
    }
    way.push_back({start_s + flight_s + 0.3, to - dvec3(0.0, 4.0, 0.0), 0.0});
    way.push_back({start_s + flight_s + 2.5, waits, 0.0});
    way.push_back({yard_loop_s, waits, 0.0});
    Light light = fire("shot " + std::to_string(index + 1), waits, light_range_m(random));
    light.node = add_mover(scene, "shot", way);
    scene.lights.push_back(std::move(light));
}

/// Lanterns that float round columns and over graves.
void add_spirits(Scene& scene, NecropolisPaints const& paints, Pcg32& random) {
    std::uint32_t const mesh = add_mesh(scene, "spirit", make_spirit(paints));
    for (std::uint32_t i = 0; i < spirits; ++i) {
        bool const in_hall = i % 4 == 0;
        dvec3 middle;  // drawn one by one: the order in which arguments are evaluated is the compiler's
        middle.z = in_hall ? hall_front_z - random.uniform(12.0, 55.0) : random.uniform(hall_front_z + 20.0, 70.0);
        middle.y = random.uniform(6.0, 9.0);
        middle.x = random.uniform(in_hall ? -2.0 : -60.0, in_hall ? 2.0 : 60.0);
        double const radius = random.uniform(1.0, in_hall ? 2.5 : 8.0);
        double const phase = random.uniform();
        double const way_round = i % 2 == 0 ? 1.0 : -1.0;
        constexpr int keys = 32;
        std::vector<Waypoint> way;
        for (int k = 0; k <= keys; ++k) {
            double const turns = phase + way_round * (k % keys) / keys;
            dvec3 const out = level_direction(turns) * radius;
            way.push_back({yard_loop_s * k / keys, middle + out + dvec3(0.0, 0.6 * sin_cos(2.0 * turns).sin, 0.0), turns});
        }
        hang(scene, "spirit", mesh, add_mover(scene, "spirit", way));
    }
}

/// Graves in rows on both sides of the avenue: as many as the budget has room for, on places drawn in a fixed order, so that
/// a larger budget adds to a smaller one's.
void add_graves(Scene& scene, NecropolisPaints const& paints, Pcg32& random, std::uint64_t triangles) {
    std::array<std::uint32_t, grave_kinds> meshes{};
    std::array<std::uint64_t, grave_kinds> sizes{};
    for (std::uint32_t i = 0; i < grave_kinds; ++i) {
        Mesh grave = make_grave(i, paints);
        for (Primitive const& p : grave.primitives) sizes[i] += p.indices.size() / 3;
        meshes[i] = add_mesh(scene, "grave", std::move(grave));
    }
    std::vector<int> places(static_cast<std::size_t>(2 * grave_columns * grave_rows));
    for (std::size_t i = 0; i < places.size(); ++i) places[i] = static_cast<int>(i);
    for (std::size_t i = places.size() - 1; i > 0; --i)
        std::swap(places[i], places[random.below(static_cast<std::uint32_t>(i + 1))]);
    std::uint64_t left = triangles;
    for (int const place : places) {
        std::uint32_t const kind = random.below(grave_kinds);
        if (sizes[kind] > left) break;
        left -= sizes[kind];
        double const side = place % 2 == 0 ? 1.0 : -1.0;
        double const x = side * (graves_from_m + grave_side_m * (place / 2 % grave_columns)) + random.uniform(-0.1, 0.1);
        double const z = yard_half_m - 5.0 - grave_row_m * (place / 2 / grave_columns) + random.uniform(-0.12, 0.12);
        scene.instances.push_back(placed_instance("grave", meshes[kind], {{x, 0.0, z}, random.uniform(-0.008, 0.008)}));
    }
}

constexpr std::array<Stop, 8> map_stops{{{{60.0, 75.0, 260.0}, {0.0, 0.0, 0.0}},
                                         {{30.0, 40.0, 180.0}, {0.0, 4.0, 20.0}},
                                         {{0.0, 7.0, 125.0}, {0.0, 5.0, 40.0}},
                                         {{0.0, 3.2, 85.0}, {0.0, 5.0, 0.0}},
                                         {{0.0, 3.0, 25.0}, {0.0, 6.0, -40.0}},
                                         {{0.0, 2.8, -30.0}, {0.0, 5.0, -80.0}},
                                         {{0.0, 3.0, -62.0}, {2.0, 5.0, -105.0}},
                                         {{0.0, 3.6, -84.0}, {-4.0, 5.0, -115.0}}}};
constexpr Lens map_lens{sixty_degrees_rad, 0.1, 3000.0};

}  // namespace

Result<Scene> make_necropolis(ProceduralConfig const& config) {
    Scene scene;
    scene.name = "necropolis";
    NecropolisPaints const paints = add_necropolis_paints(scene);
    Pcg32 random(seed_of(config, 12345));
    add_necropolis_buildings(scene, paints);
    add_spirits(scene, paints, random);
    std::uint64_t const fixed = count_triangles(scene);
    if (config.triangles < fixed || config.triangles > most_triangles)
        return core::Failure{SceneError::bad_config, "necropolis cannot have " + std::to_string(config.triangles) +
                                                         " triangles; give a budget from " + std::to_string(fixed) + " to " +
                                                         std::to_string(most_triangles)};
    Pcg32 graves(seed_of(config, 12345) + 1);
    add_graves(scene, paints, graves, config.triangles - fixed);
    Pcg32 lights(seed_of(config, 12345) + 2);
    std::uint32_t wanted = 0;
    for (char const digit : config.lights) wanted = digit >= '0' && digit <= '9' ? wanted * 10 + static_cast<std::uint32_t>(digit - '0') : wanted;
    if (config.lights == "all") wanted = static_lights + cannon_lights;
    if (config.lights == "static") wanted = static_lights;
    add_static_lights(scene, lights, std::min(wanted, static_lights));
    for (std::uint32_t i = static_lights; i < wanted; ++i) add_cannon_light(scene, lights, i - static_lights);
    scene.cameras.push_back(view_from("yard", {{34.0, 26.0, 128.0}, {-6.0, 2.0, 10.0}}, map_lens));
    scene.cameras.push_back(view_from("hall", map_stops[6], map_lens));
    scene.cameras.push_back(view_from("far", map_stops[0], map_lens));
    settle(scene);
    return scene;
}

Result<CameraPath> make_necropolis_path(ProceduralConfig const& config, PathInfo const& info) {
    (void)config;  // the avenue and the hall are where they are
    return path_along(info, map_stops, map_lens);
}

}  // namespace gnomon::scene::detail
