// `robots`: eleven robots roll up and down a street between facades, under many small lights or a few that they carry.

#include "detail/facade.hpp"
#include "detail/generators.hpp"
#include "detail/motion.hpp"

#include <array>

namespace gnomon::scene::detail {

namespace {

using math::dvec2;
using math::dvec3;

constexpr double robot_street_m = 29.1;
constexpr double robot_street_half_m = robot_street_m * 0.5;
constexpr double robot_street_length_m = 400.0;
constexpr int robot_houses = 20;  ///< On each side.
constexpr int robot_count = 11;
constexpr double robot_lane_m = 2.2;
constexpr double robot_turn_m = 0.35;  ///< Half of what lies between the way up and the way down.
constexpr double robot_loop_s = 120.0;
constexpr std::uint32_t lights_per_robot = 84;
using HalfWays = std::array<double, robot_count>;  ///< How far up and down the street each robot goes.
constexpr double kerb_m = robot_street_half_m - 2.2;

struct StreetPaints {
    std::array<std::uint32_t, 6> walls{};
    std::uint32_t glass = 0;
    std::uint32_t trim = 0;
    std::uint32_t roof = 0;
    std::uint32_t asphalt = 0;
    std::uint32_t pavement = 0;
    std::array<std::uint32_t, 4> steel{};
    std::uint32_t dark = 0;
    std::uint32_t eye = 0;
};

StreetPaints add_street_paints(Scene& scene) {
    StreetPaints p;
    constexpr std::array<math::vec3, 6> walls{{{0.58F, 0.52F, 0.42F},
                                               {0.45F, 0.22F, 0.16F},
                                               {0.62F, 0.60F, 0.56F},
                                               {0.50F, 0.42F, 0.30F},
                                               {0.40F, 0.42F, 0.44F},
                                               {0.60F, 0.48F, 0.40F}}};
    constexpr std::array<math::vec3, 4> steel{
        {{0.62F, 0.10F, 0.06F}, {0.10F, 0.24F, 0.48F}, {0.66F, 0.48F, 0.08F}, {0.45F, 0.47F, 0.50F}}};
    for (std::size_t i = 0; i < walls.size(); ++i) p.walls[i] = add_material(scene, "facade " + std::to_string(i), walls[i]);
    for (std::size_t i = 0; i < steel.size(); ++i) p.steel[i] = add_material(scene, "steel " + std::to_string(i), steel[i]);
    p.glass = add_material(scene, "glass", {0.06F, 0.08F, 0.11F});
    p.trim = add_material(scene, "trim", {0.70F, 0.68F, 0.62F});
    p.roof = add_material(scene, "roof", {0.20F, 0.20F, 0.22F});
    p.asphalt = add_material(scene, "asphalt", {0.20F, 0.20F, 0.21F});
    p.pavement = add_material(scene, "pavement", {0.42F, 0.41F, 0.39F});
    p.dark = add_material(scene, "rubber", {0.04F, 0.04F, 0.045F});
    p.eye = add_material(scene, "lens", {0.75F, 0.80F, 0.55F});
    return p;
}

/// A slab with bars round it, before a window whose floor is at `y`.
void add_balcony(SolidBuilder& out, StreetPaints const& p, double x, double y) {
    out.box({x - 1.3, y - 0.02, -0.2}, {x + 1.3, y + 0.14, 0.95}, p.trim);
    out.box({x - 1.27, y + 1.0, 0.84}, {x + 1.27, y + 1.07, 0.92}, p.dark);
    for (double const side : {-1.24, 1.24}) out.box({x + side - 0.03, y + 1.01, -0.1}, {x + side + 0.03, y + 1.06, 0.87}, p.dark);
    for (int i = 0; i < 6; ++i) {
        double const bar = x - 1.1 + 0.44 * i;
        out.box({bar - 0.02, y + 0.1, 0.86}, {bar + 0.02, y + 1.03, 0.90}, p.dark);
    }
}

/// A house of 20 m by 12 m whose front, towards +z, lies in the plane z = 0.
Mesh make_street_house(StreetPaints const& p, Pcg32& random) {
    SolidBuilder out;
    int const floors = 4 + static_cast<int>(random.below(3));
    int const axes = 5 + static_cast<int>(random.below(2));
    double const height = random.uniform(3.4, 3.8);
    Facade f;
    f.lo = dvec3(-10.0, -1.0, -12.0);
    f.hi = dvec3(10.0, floors * height + 0.6, 0.0);
    f.material = p.walls[random.below(static_cast<std::uint32_t>(p.walls.size()))];
    f.top_material = p.roof;
    f.depth = 0.3;
    f.heights.push_back(0.25);
    for (int floor = 0; floor < floors; ++floor) {
        f.heights.push_back(floor * height + (floor == 0 ? 0.6 : 0.9));
        f.heights.push_back(floor * height + 2.7);
    }
    f.axes[0] = window_axes(20.0, {axes, 1.7});
    clear_recesses(f);
    for (int floor = 0; floor < floors; ++floor)
        for (int i = 0; i < axes; ++i) set_recess(f, 0, {2 * i + 1, 2 * floor + 2}, p.glass);
    set_recess(f, 0, {2 * (axes / 2) + 1, 1}, p.glass);
    add_facade(out, f);
    for (int floor = 0; floor < floors; ++floor)
        for (int i = 0; i < axes; ++i) {
            double const x = (i + 0.5) * 20.0 / axes - 10.0;
            double const y = floor * height + (floor == 0 ? 0.6 : 0.9);
            bool const door = floor == 0 && i == axes / 2;
            if (!door) out.box({x - 1.05, y - 0.16, -0.2}, {x + 1.05, y - 0.02, 0.16}, p.trim);
            out.box({x - 1.0, floor * height + 2.72, -0.2}, {x + 1.0, floor * height + 2.95, 0.12}, p.trim);
            out.box({x - 0.04, y - 0.05, -0.35}, {x + 0.04, floor * height + 2.75, -0.22}, p.trim);
            if (floor > 0 && i % 2 == 0) add_balcony(out, p, x, floor * height + 0.2);
            if (!door) out.box({x - 0.9, y + 0.9, -0.34}, {x + 0.9, y + 0.98, -0.23}, p.trim);
        }
    out.box({-9.95, height - 0.3, -0.2}, {9.95, height, 0.2}, p.trim);
    out.box({-9.98, f.hi.y - 0.5, -0.5}, {9.98, f.hi.y - 0.1, 0.5}, p.trim);
    out.box({-9.9, f.hi.y - 0.2, -0.4}, {9.9, f.hi.y + 0.7, 0.1}, f.material);
    for (double const x : {-6.0, 5.0}) out.box({x, f.hi.y - 0.3, -7.0}, {x + 1.2, f.hi.y + 2.0, -5.5}, p.walls[1]);
    return out.take();
}

/// A wheeled robot, 3.3 m tall, that looks along +x; its arms are meshes of their own.
Mesh make_robot(StreetPaints const& p, std::uint32_t steel) {
    SolidBuilder out;
    out.lathe({0.0, 0.62, 0.0}, std::array<Outline, 6>{{{0.3, 0.0}, {0.42, 0.12}, {0.46, 0.7}, {0.52, 1.25}, {0.5, 1.45}, {0.2, 1.6}}}, 24, steel);
    out.lathe({0.0, 2.15, 0.0}, std::array<Outline, 2>{{{0.14, 0.0}, {0.14, 0.3}}}, 16, p.dark);
    out.lathe({0.0, 2.38, 0.0}, std::array<Outline, 5>{{{0.28, 0.0}, {0.36, 0.1}, {0.36, 0.38}, {0.24, 0.56}, {0.0, 0.62}}}, 24, p.steel[3]);
    for (double const z : {-0.14, 0.14}) out.tube({{0.28, 2.63, z}, {0.42, 2.63, z}, 0.09, 0.08, 16}, p.eye);
    out.tube({{0.0, 2.9, 0.2}, {0.0, 3.3, 0.24}, 0.02, 0.015, 8}, p.dark);
    out.ball({0.0, 3.28, 0.24}, 0.05, 5, p.eye);
    out.box({-0.4, 0.42, -0.36}, {0.4, 0.68, 0.36}, p.dark);
    for (double const z : {-0.5, 0.32})
        for (double const x : {-0.55, 0.0, 0.55}) {
            out.tube({{x, 0.3, z}, {x, 0.3, z + 0.18}, 0.3, 0.3, 20}, p.dark);
            out.tube({{x, 0.3, z - 0.02}, {x, 0.3, z + 0.2}, 0.16, 0.16, 12}, p.steel[3]);
        }
    for (double const z : {-0.3, 0.3}) out.box({-0.7, 0.3, z - 0.06}, {0.7, 0.46, z + 0.06}, steel);
    out.box({0.40, 1.3, -0.2}, {0.545, 1.65, 0.2}, p.dark);
    for (int i = 0; i < 3; ++i) out.ball({0.545, 1.38 + 0.09 * i, -0.1 + 0.1 * i}, 0.035, 3, p.eye);
    for (double const z : {-1.0, 1.0}) out.ball({0.0, 1.85, z * 0.52}, 0.17, 7, p.steel[3]);
    return out.take();
}

/// An arm that hangs from its shoulder at the origin.
Mesh make_arm(StreetPaints const& p, std::uint32_t steel) {
    SolidBuilder out;
    out.tube({{0.0, 0.0, 0.0}, {0.02, -0.55, 0.0}, 0.09, 0.07, 14}, steel);
    out.ball({0.02, -0.57, 0.0}, 0.1, 5, p.dark);
    out.tube({{0.02, -0.57, 0.0}, {0.3, -0.98, 0.0}, 0.065, 0.08, 14}, steel);
    for (double const z : {-0.05, 0.05}) out.box({0.26, -1.16, z - 0.025}, {0.34, -0.92, z + 0.025}, p.dark);
    return out.take();
}

dvec3 lane_middle(int robot) noexcept { return {(robot - robot_count / 2) * robot_lane_m, 0.02, 0.0}; }

/// Up the lane on its right side, round, and down again, begun somewhere on the way.
std::vector<Waypoint> roll(int robot, double half_way_m, double phase) {
    dvec3 const lane = lane_middle(robot);
    constexpr int keys = 24;
    constexpr double straight = 10.0 / keys;
    std::vector<Waypoint> way;
    for (int i = 0; i <= keys; ++i) {
        double part = phase + static_cast<double>(i % keys) / keys;
        part -= part >= 1.0 ? 1.0 : 0.0;
        // Ten keys up, two for the turn, ten down, two for the turn.
        double const half = part < 0.5 ? part : part - 0.5;
        double const gone = half < straight ? half / straight : 1.0;
        double const turned = half < straight ? 0.0 : (half - straight) / (0.5 - straight);
        double const sign = part < 0.5 ? 1.0 : -1.0;
        SinCos const arc = sin_cos(turned * 0.5);
        Waypoint point;
        point.time_s = robot_loop_s * i / keys;
        point.at = lane + dvec3(sign * robot_turn_m * arc.cos, 0.0, -sign * half_way_m * (2.0 * gone - 1.0) - sign * robot_turn_m * arc.sin);
        point.turns = 0.25 + (part < 0.5 ? 0.0 : 0.5) + 0.5 * turned;
        way.push_back(point);
    }
    return way;
}

/// The arms swing fore and aft, twenty times a loop.
void add_arms(Scene& scene, std::uint32_t robot_node, std::uint32_t mesh) {
    for (double const side : {-1.0, 1.0}) {
        auto const id = static_cast<std::uint32_t>(scene.nodes.size());
        Node shoulder;
        shoulder.name = "arm";
        shoulder.parent = robot_node;
        shoulder.translation = dvec3(0.0, 1.85, side * 0.66);
        scene.nodes.push_back(shoulder);
        AnimationChannel& swing = add_channel(scene, id, AnimationPath::rotation);
        for (int i = 0; i <= 80; ++i) {
            constexpr std::array<double, 4> turns{0.0, 0.08, 0.0, -0.08};
            SinCos const half = sin_cos(side * turns[static_cast<std::size_t>(i % 4)] * 0.5);
            add_key(swing, robot_loop_s * i / 80, {0.0, 0.0, half.sin, half.cos});
        }
        hang(scene, "arm", mesh, id);
    }
}

Light street_light(std::string name, dvec3 const& at, double range_m) {
    Light light;
    light.name = std::move(name);
    light.kind = LightKind::point;
    light.position_m = at;
    light.range_m = static_cast<float>(range_m);
    light.intensity = static_cast<float>(range_m * range_m * 0.15);
    return light;
}

/// Along each robot's way, shifted sideways at random.
void add_many_lights(Scene& scene, HalfWays const& half_ways_m, Pcg32& random) {
    for (int robot = 0; robot < robot_count; ++robot)
        for (std::uint32_t i = 0; i < lights_per_robot; ++i) {
            dvec3 at = lane_middle(robot);
            at.x += random.uniform(-1.5, 1.5);
            at.y = random.uniform(2.0, 4.5);
            at.z = half_ways_m[static_cast<std::size_t>(robot)] * (1.0 - 2.0 * (i + 0.5) / lights_per_robot);
            Light light = street_light("light " + std::to_string(scene.lights.size() + 1), at, 12.5);
            for (math::axis_t c = 0; c < 3; ++c) light.color[c] = static_cast<float>(random.uniform(0.4, 1.0));
            scene.lights.push_back(std::move(light));
        }
}

void add_carried_light(Scene& scene, std::uint32_t node) {
    Light light = street_light("lamp " + std::to_string(scene.lights.size() + 1), dvec3(0.0), 40.0);
    light.node = node;
    light.node_from_light[3][0] = 0.3;
    light.node_from_light[3][1] = 3.6;
    scene.lights.push_back(std::move(light));
}

void add_robots(Scene& scene, StreetPaints const& p, HalfWays const& half_ways_m, Pcg32& random, bool carry_lights) {
    std::array<std::uint32_t, 3> bodies{};
    std::array<std::uint32_t, 3> arms{};
    for (std::size_t i = 0; i < 3; ++i) {
        bodies[i] = add_mesh(scene, "robot", make_robot(p, p.steel[i]));
        arms[i] = add_mesh(scene, "arm", make_arm(p, p.steel[i]));
    }
    for (int i = 0; i < robot_count; ++i) {
        // Keys lie at whole 24ths, so the ends of the way are among them.
        double const phase = random.below(24) / 24.0;
        std::uint32_t const node = add_mover(scene, "robot", roll(i, half_ways_m[static_cast<std::size_t>(i)], phase));
        hang(scene, "robot", bodies[static_cast<std::size_t>(i % 3)], node);
        add_arms(scene, node, arms[static_cast<std::size_t>(i % 3)]);
        if (carry_lights) add_carried_light(scene, node);
    }
}

/// Roadway and pavements, in slabs of 8 m so that no triangle is very long.
Mesh make_roadway(StreetPaints const& p) {
    SolidBuilder out;
    constexpr double end = 0.5 * robot_street_length_m;
    for (int i = 0; i < 50; ++i) {
        double const z = -end + 8.0 * i;
        out.box({-kerb_m - 0.1, -1.0, z + 0.005}, {kerb_m + 0.1, 0.0, z + 7.995}, p.asphalt);
        for (double const side : {-1.0, 1.0}) {
            double const middle = side * (kerb_m + 1.35);
            out.box({middle - 1.35, -0.9, z + 0.01}, {middle + 1.35, 0.14, z + 7.99}, p.pavement);
        }
        if (i % 2 == 0) out.box({-0.08, -0.2, z + 2.0}, {0.08, 0.012, z + 6.0}, p.trim);
    }
    return out.take();
}

Mesh make_street_lamp(StreetPaints const& p) {
    SolidBuilder out;
    out.lathe({0.0, -0.2, 0.0}, std::array<Outline, 4>{{{0.16, 0.0}, {0.12, 1.2}, {0.07, 1.4}, {0.05, 5.4}}}, 6, p.dark);
    out.tube({{0.0, 5.0, 0.0}, {0.0, 5.3, 1.3}, 0.045, 0.035, 6}, p.dark);
    out.lathe({0.0, 5.0, 1.3}, std::array<Outline, 3>{{{0.22, 0.0}, {0.18, 0.2}, {0.05, 0.4}}}, 8, p.dark);
    out.ball({0.0, 4.98, 1.3}, 0.15, 3, p.eye);
    return out.take();
}

Camera bart_frame(double share) {
    double const z = 192.0 - 372.0 * share;
    SinCos const sway = sin_cos(2.0 * share);
    dvec3 const eye(5.0 * sin_cos(1.5 * share).sin, 6.5 + 1.5 * sin_cos(3.0 * share).cos, z);
    dvec3 const ahead = level_direction(0.25 + 0.07 * sway.sin) - dvec3(0.0, 0.16, 0.0);
    Camera camera = looking_at("", eye, eye + ahead, sixty_degrees_rad);
    camera.near_m = 0.2;
    camera.far_m = 1000.0;
    return camera;
}

}  // namespace

Result<Scene> make_robots(ProceduralConfig const& config) {
    Scene scene;
    scene.name = "robots";
    StreetPaints const paints = add_street_paints(scene);
    Pcg32 random(seed_of(config, 12345));
    scene.instances.push_back(placed_instance("street", add_mesh(scene, "street", make_roadway(paints)), {}));
    std::uint32_t const lamp_mesh = add_mesh(scene, "lamp", make_street_lamp(paints));
    for (int i = 0; i < 2 * robot_houses; ++i) {
        bool const right = i % 2 == 0;
        double const z = -0.5 * robot_street_length_m + 20.0 * (i / 2 + 0.5);
        double const side = right ? 1.0 : -1.0;
        double const turns = right ? -0.25 : 0.25;
        std::uint32_t const house = add_mesh(scene, "house", make_street_house(paints, random));
        scene.instances.push_back(placed_instance("house", house, {{side * robot_street_half_m, 0.0, z}, turns}));
        scene.instances.push_back(placed_instance("lamp", lamp_mesh, {{side * (kerb_m + 0.5), 0.14, z + side * 3.0}, turns}));
    }
    bool const few = config.lights == "few";
    HalfWays half_ways_m{};
    for (double& half_way : half_ways_m) half_way = random.uniform(80.0, 180.0);
    add_robots(scene, paints, half_ways_m, random, few);
    if (!few) add_many_lights(scene, half_ways_m, random);
    scene.cameras.push_back(looking_at("robots", {1.5, 3.4, -23.0}, {-0.8, 1.5, -42.0}, sixty_degrees_rad));
    scene.cameras.back().far_m = 1000.0;
    scene.cameras.push_back(bart_frame(0.18));
    scene.cameras.back().name = "street";
    settle(scene);
    return scene;
}

Result<CameraPath> make_robots_path(ProceduralConfig const& config, PathInfo const& info) {
    (void)config;  // the street is the same for every seed
    CameraPath path{std::string(info.name), info.rate_hz, {}};
    for (std::uint32_t i = 0; i < info.frames; ++i) path.frames.push_back(bart_frame(static_cast<double>(i) / info.frames));
    return path;
}

}  // namespace gnomon::scene::detail
