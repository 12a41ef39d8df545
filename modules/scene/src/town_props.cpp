#include "detail/motion.hpp"
#include "detail/town.hpp"

#include <algorithm>
#include <cmath>

namespace gnomon::scene::detail {

namespace {

using math::dvec2;
using math::dvec3;

constexpr std::uint32_t lamps = 420;
constexpr std::uint32_t trees = 540;
constexpr std::uint32_t fences = 640;
constexpr std::uint32_t benches = 210;
constexpr std::uint32_t bins = 140;
constexpr std::uint32_t bollards = 450;
constexpr std::uint32_t people = 360;
constexpr std::uint32_t cars = 240;
static_assert(lamps + trees + fences + benches + bins + bollards + people + cars == town_props);

constexpr std::uint32_t variants = 6;

struct Paints {
    std::uint32_t metal;
    std::uint32_t bark;
    std::uint32_t wood;
    std::uint32_t light;
    std::uint32_t rubber;
    std::uint32_t skin;
    std::uint32_t glass;
    std::array<std::uint32_t, variants> colors;
};

Paints add_paints(Scene& scene) {
    Paints p{};
    p.metal = add_material(scene, "iron", {0.07F, 0.09F, 0.09F});
    p.bark = add_material(scene, "bark", {0.16F, 0.11F, 0.08F});
    p.wood = add_material(scene, "painted wood", {0.66F, 0.65F, 0.60F});
    p.light = add_material(scene, "lamp glass", {0.85F, 0.80F, 0.62F});
    p.rubber = add_material(scene, "rubber", {0.03F, 0.03F, 0.03F});
    p.skin = add_material(scene, "skin", {0.55F, 0.36F, 0.26F});
    p.glass = add_material(scene, "car glass", {0.04F, 0.05F, 0.07F});
    constexpr std::array<math::vec3, variants> colors{{{0.50F, 0.06F, 0.04F},
                                                       {0.06F, 0.14F, 0.36F},
                                                       {0.58F, 0.56F, 0.52F},
                                                       {0.08F, 0.24F, 0.12F},
                                                       {0.62F, 0.42F, 0.06F},
                                                       {0.10F, 0.11F, 0.13F}}};
    for (std::size_t i = 0; i < variants; ++i) p.colors[i] = add_material(scene, "color " + std::to_string(i), colors[i]);
    return p;
}

/// 3 m high; the arm reaches towards +z.
Mesh make_lamp(Paints const& p) {
    SolidBuilder out;
    out.lathe({0.0, -0.3, 0.0}, std::array<Outline, 4>{{{0.10, 0.0}, {0.09, 0.9}, {0.045, 1.0}, {0.035, 3.2}}}, 6, p.metal);
    out.tube({{0.0, 2.84, -0.02}, {0.0, 2.94, 0.75}, 0.03, 0.025, 4}, p.metal);
    out.tapered_box({-0.13, 2.86, 0.5}, {0.13, 3.0, 1.0}, 0.6, p.metal);
    out.box({-0.1, 2.82, 0.55}, {0.1, 2.875, 0.95}, p.light);
    return out.take();
}

/// A bare young tree, 3 m high: a trunk, four branches, ten twigs.
Mesh make_bare_tree(Paints const& p, Pcg32& random) {
    SolidBuilder out;
    out.tube({{0.0, -0.3, 0.0}, {0.04, 2.3, 0.0}, 0.085, 0.035, 5}, p.bark);
    double const first = random.uniform();
    for (int i = 0; i < 4; ++i) {
        dvec3 const way = level_direction(first + i * 0.25 + random.uniform(-0.05, 0.05));
        dvec3 const from(0.02, 1.15 + 0.24 * i, 0.0);
        double const rise = random.uniform(0.5, 0.75);
        double const reach = random.uniform(0.5, 0.75);
        dvec3 const to = from + way * reach + dvec3(0.0, rise, 0.0);
        out.tube({from, to, 0.035, 0.016, 4}, p.bark);
        for (int twig = 0; twig < 2; ++twig) {
            dvec3 const start = from + (to - from) * (0.5 + 0.4 * twig);
            dvec3 const bend = level_direction(first + i * 0.25 + (twig == 0 ? 0.17 : -0.14));
            out.tube({start, start + bend * 0.32 + dvec3(0.0, random.uniform(0.25, 0.5), 0.0), 0.016, 0.0, 3}, p.bark);
        }
    }
    out.tube({{0.04, 2.22, 0.0}, {0.16, 2.98, 0.1}, 0.036, 0.0, 3}, p.bark);
    out.tube({{0.04, 2.18, 0.0}, {-0.2, 2.8, -0.1}, 0.03, 0.0, 3}, p.bark);
    return out.take();
}

/// 2.9 m of picket fence along x, 1 m high.
Mesh make_fence(Paints const& p) {
    SolidBuilder out;
    out.box({-1.45, -0.3, -0.05}, {-1.35, 1.0, 0.05}, p.wood);
    for (double const y : {0.25, 0.7}) out.box({-1.4, y, -0.02}, {1.5, y + 0.09, 0.02}, p.wood);
    for (int i = 0; i < 4; ++i) {
        double const x = -0.9 + 0.62 * i;
        out.box({x - 0.09, 0.08, 0.01}, {x + 0.09, 0.92, 0.045}, p.wood);
    }
    return out.take();
}

Mesh make_bench(Paints const& p) {
    SolidBuilder out;
    for (double const x : {-0.7, 0.7}) out.box({x - 0.05, -0.2, -0.2}, {x + 0.05, 0.43, 0.2}, p.metal);
    out.box({-0.9, 0.42, -0.22}, {0.9, 0.47, 0.22}, p.wood);
    out.box({-0.9, 0.55, -0.26}, {0.9, 0.85, -0.21}, p.wood);
    for (double const x : {-0.7, 0.7}) out.box({x - 0.04, 0.35, -0.24}, {x + 0.04, 0.8, -0.17}, p.metal);
    return out.take();
}

Mesh make_bin(Paints const& p) {
    SolidBuilder out;
    out.lathe({0.0, -0.1, 0.0}, std::array<Outline, 4>{{{0.2, 0.0}, {0.25, 0.9}, {0.28, 0.92}, {0.2, 1.02}}}, 8, p.colors[3]);
    return out.take();
}

Mesh make_bollard(Paints const& p) {
    SolidBuilder out;
    out.lathe({0.0, -0.2, 0.0}, std::array<Outline, 3>{{{0.09, 0.0}, {0.07, 0.95}, {0.0, 1.05}}}, 6, p.colors[2]);
    return out.take();
}

/// 1.72 m tall, facing +x.
Mesh make_person(Paints const& p, std::uint32_t coat) {
    SolidBuilder out;
    std::uint32_t const trousers = p.colors[(coat + 5) % variants];
    out.box({-0.22, -0.02, -0.16}, {0.04, 0.88, -0.03}, trousers);
    out.box({-0.02, -0.02, 0.03}, {0.24, 0.88, 0.16}, trousers);
    out.tapered_box({-0.14, 0.8, -0.2}, {0.16, 1.45, 0.2}, 0.85, p.colors[coat]);
    for (double const side : {-1.0, 1.0}) {
        double const z = side * 0.235;
        out.box({side * 0.08 - 0.06, 0.8, z - 0.05}, {side * 0.08 + 0.06, 1.42, z + 0.05}, p.colors[coat]);
    }
    out.ball({0.02, 1.58, 0.0}, 0.14, 2, p.skin);
    return out.take();
}

/// A small car, 3 m long, driving towards +x.
Mesh make_car(Paints const& p, std::uint32_t color) {
    SolidBuilder out;
    std::array<dvec2, 8> const body{
        {{-1.48, 0.28}, {1.48, 0.28}, {1.5, 0.62}, {1.35, 0.78}, {0.7, 0.86}, {-1.2, 0.86}, {-1.45, 0.8}, {-1.5, 0.6}}};
    out.prism(Plane::xy, body, {-0.68, 0.68}, p.colors[color]);
    std::array<dvec2, 4> const cabin{{{-1.25, 0.8}, {0.85, 0.8}, {0.3, 1.36}, {-1.0, 1.36}}};
    out.prism(Plane::xy, cabin, {-0.6, 0.6}, p.glass);
    out.box({-1.02, 1.33, -0.62}, {0.33, 1.42, 0.62}, p.colors[color]);
    for (double const x : {-0.95, 0.95})
        for (double const z : {-0.72, 0.52})
            out.tube({{x, 0.28, z}, {x, 0.28, z + 0.2}, 0.28, 0.28, 6}, p.rubber);
    return out.take();
}

/// A block's corner and how far its cell reaches.
dvec2 block_point(std::uint32_t block, dvec2 const& inside) noexcept {
    int const column = static_cast<int>(block) % town_blocks_x;
    int const row = static_cast<int>(block) / town_blocks_x;
    return town_corner(column, row) + inside;
}

constexpr std::uint32_t blocks = town_blocks_x * town_blocks_z;

class Props {
public:
    Props(Scene& scene, TownGround const& ground, Pcg32& random)
        : scene_(scene), ground_(ground), random_(random), paints_(add_paints(scene)) {}

    void add_standing() {
        add_lamps();
        add_trees();
        add_fences();
        add_furniture();
    }

    /// People and cars by turns, the first `moving` of them on their way.
    void add_travellers(std::uint32_t moving) {
        std::array<std::uint32_t, variants> person{};
        std::array<std::uint32_t, variants> car{};
        for (std::uint32_t i = 0; i < variants; ++i) {
            person[i] = add_mesh(scene_, "person", make_person(paints_, i));
            car[i] = add_mesh(scene_, "car", make_car(paints_, i));
        }
        std::uint32_t cars_so_far = 0;
        for (std::uint32_t i = 0; i < people + cars; ++i) {
            bool const is_car = (i + 1) * cars / (people + cars) > cars_so_far;
            std::vector<Waypoint> const way = is_car ? drive(cars_so_far) : walk(i - cars_so_far);
            std::string const name = is_car ? "car" : "person";
            std::uint32_t const mesh = (is_car ? car : person)[random_.below(variants)];
            cars_so_far += is_car ? 1 : 0;
            if (i < moving)
                hang(scene_, name, mesh, add_mover(scene_, name, way));
            else
                scene_.instances.push_back(placed_instance(name, mesh, {way.front().at, way.front().turns}));
        }
    }

private:
    [[nodiscard]] dvec3 on_ground(dvec2 const& p) const { return {p.x, ground_.height(p.x, p.y), p.y}; }

    void stand(char const* name, std::uint32_t mesh, dvec2 const& at, double turns) {
        scene_.instances.push_back(placed_instance(name, mesh, {on_ground(at), turns}));
    }

    /// Seven round each block, at the curb, arms over the road.
    void add_lamps() {
        std::uint32_t const mesh = add_mesh(scene_, "lamp", make_lamp(paints_));
        constexpr double out = street_half_m + 0.45;
        for (std::uint32_t i = 0; i < lamps; ++i) {
            std::uint32_t const place = i / blocks;
            std::uint32_t const block = i % blocks;
            double const x = 14.0 + 24.0 * (place % 4) + (place >= 4 ? 12.0 : 0.0);
            bool const far = place >= 4;
            stand("lamp", mesh, block_point(block, {x, far ? town_pitch_z_m - out : out}), far ? 0.0 : 0.5);
        }
    }

    /// In the parks in loose rows, on the market round its edge, in gardens behind the houses.
    void add_trees() {
        std::array<std::uint32_t, variants> meshes{};
        for (std::uint32_t& mesh : meshes) mesh = add_mesh(scene_, "tree", make_bare_tree(paints_, random_));
        std::uint32_t planted = 0;
        while (planted < trees) {
            std::uint32_t const block = random_.below(blocks);
            bool const park = kind_of(block) == Block::park;
            if (!park && random_.below(4) != 0) continue;
            double const x = random_.uniform(9.0, 91.0);
            double const z = park ? random_.uniform(9.0, 51.0) : random_.uniform(29.3, 30.7);
            if (kind_of(block) == Block::market) continue;
            double const turns = random_.uniform();
            stand("tree", meshes[random_.below(variants)], block_point(block, {x, z}), turns);
            ++planted;
        }
    }

    [[nodiscard]] static Block kind_of(std::uint32_t block) noexcept {
        return town_block(static_cast<int>(block) % town_blocks_x, static_cast<int>(block) / town_blocks_x);
    }

    /// Along the front gardens of whole blocks, with gaps for the doors.
    void add_fences() {
        std::uint32_t const mesh = add_mesh(scene_, "fence", make_fence(paints_));
        std::uint32_t built = 0;
        for (std::uint32_t block = 0; built < fences; block = (block + 7) % blocks) {
            if (kind_of(block) != Block::homes) continue;
            for (std::uint32_t i = 0; i < 24 && built < fences; ++i) {
                std::uint32_t const plot = i % 12 / 3;
                double const x = 6.0 + 22.0 * plot + (i % 3 == 0 ? 3.2 : i % 3 == 1 ? 6.1 : 17.4);
                stand("fence", mesh, block_point(block, {x, i < 12 ? 6.35 : town_pitch_z_m - 6.35}), i < 12 ? 0.5 : 0.0);
                ++built;
            }
        }
    }

    void add_furniture() {
        std::array<std::uint32_t, 3> const meshes{add_mesh(scene_, "bench", make_bench(paints_)),
                                                  add_mesh(scene_, "bin", make_bin(paints_)),
                                                  add_mesh(scene_, "bollard", make_bollard(paints_))};
        for (std::uint32_t i = 0; i < benches; ++i) {
            bool const far = i % 2 == 0;
            double const x = 20.0 + 11.0 * (i / blocks) + 9.0 * far;
            stand("bench", meshes[0], block_point(i * 7 % blocks, {x, far ? 54.4 : 5.6}), far ? 0.0 : 0.5);
        }
        for (std::uint32_t i = 0; i < bins; ++i)
            stand("bin", meshes[1], block_point(i * 11 % blocks, {4.5, 12.0 + 13.0 * (i / blocks)}), 0.0);
        for (std::uint32_t i = 0; i < bollards; ++i)
            stand("bollard", meshes[2], block_point(i * 13 % blocks, {95.6, 7.0 + 2.3 * (i / blocks)}), 0.0);
    }

    /// Up and down the pavement along one side of a block.
    std::vector<Waypoint> walk(std::uint32_t index) {
        bool const far = index % 2 == 0;
        double const side = (far ? town_pitch_z_m - 5.0 : 5.0) + random_.uniform(-0.25, 0.25);
        double const from = random_.uniform(7.0, 66.0);
        std::uint32_t const block = index * 17 % blocks;
        constexpr double walk_s = town_loop_s * 0.5 - 1.0;
        constexpr int steps = 4;
        constexpr double length_m = 22.0;
        std::vector<Waypoint> stops;
        for (int i = 0; i <= steps; ++i)
            stops.push_back({walk_s * i / steps, on_ground(block_point(block, {from + length_m * i / steps, side})), 0.0});
        stops.push_back({walk_s + 0.5, stops.back().at, 0.25});
        for (int i = 0; i <= steps; ++i)
            stops.push_back({walk_s + 1.0 + walk_s * i / steps, stops[static_cast<std::size_t>(steps - i)].at, 0.5});
        stops.push_back({town_loop_s - 0.5, stops.front().at, 0.75});
        stops.push_back({town_loop_s, stops.front().at, 1.0});
        return stops;
    }

    /// Once round a block in its own lane, the block on the right, at 8 m/s; no lane is shared between blocks.
    std::vector<Waypoint> drive(std::uint32_t index) {
        constexpr std::uint32_t per_block = cars / blocks;
        constexpr int pieces = 40;
        double const start = static_cast<double>(index % per_block) / per_block + 0.02 * (index / per_block % 7);
        std::vector<Waypoint> stops;
        for (int i = 0; i <= pieces; ++i) {
            double const part = i == pieces ? start : start + static_cast<double>(i) / pieces;
            Waypoint stop = on_lane(index / per_block, part - std::floor(part));
            stop.time_s = town_loop_s * i / pieces;
            stops.push_back(stop);
        }
        return stops;
    }

    /// A place on a block's lane, 0 to 1 once round, corners cut by quarter circles of 4 m.
    [[nodiscard]] Waypoint on_lane(std::uint32_t block, double part) const {
        constexpr double radius = 4.0;
        dvec2 const lo(lane_m);
        dvec2 const hi(town_pitch_x_m - lane_m, town_pitch_z_m - lane_m);
        double const arc = radius * 0.5 * pi;
        double const long_m = hi.x - lo.x - 2.0 * radius;
        double const short_m = hi.y - lo.y - 2.0 * radius;
        double at = part * 2.0 * (long_m + short_m + 2.0 * arc);
        // Clockwise seen from above: east along the far side (least z), south, west, north.
        std::array<dvec2, 4> const corners{{{lo.x, lo.y}, {hi.x, lo.y}, {hi.x, hi.y}, {lo.x, hi.y}}};
        for (std::size_t side = 0; side < 4; ++side) {
            double const straight = side % 2 == 0 ? long_m : short_m;
            double const heading = -0.25 * static_cast<double>(side);
            dvec3 const way = level_direction(heading);
            dvec2 const along(way.x, way.z);
            dvec2 const right(-way.z, way.x);
            if (at <= straight) {
                dvec2 const p = corners[side] + along * (radius + at);
                return {0.0, on_ground(block_point(block, p)), heading};
            }
            at -= straight;
            if (at <= arc || side == 3) {
                double const turned = 0.25 * std::min(at / arc, 1.0);
                dvec2 const middle = corners[(side + 1) % 4] - along * radius + right * radius;
                dvec3 const out = level_direction(heading + 0.25 - turned);
                return {0.0, on_ground(block_point(block, middle + dvec2(out.x, out.z) * radius)), heading - turned};
            }
            at -= arc;
        }
        return {};
    }

    Scene& scene_;
    TownGround const& ground_;
    Pcg32& random_;
    Paints paints_;
};

}  // namespace

void add_town_props(Scene& scene, TownGround const& ground, Pcg32& random, std::uint32_t moving) {
    Props props(scene, ground, random);
    props.add_standing();
    props.add_travellers(moving);
}

}  // namespace gnomon::scene::detail
