// `town`: a small town of streets, gardens and a church, with people and cars in it.

#include "detail/town.hpp"

#include <cmath>

namespace gnomon::scene::detail {

namespace {

using math::dvec2;
using math::dvec3;

constexpr std::uint64_t town_seed = 20'240'601;
constexpr std::uint32_t town_buildings = 400;
constexpr int plots_per_row = 4;
constexpr double plot_m = 22.0;
constexpr double town_near_m = 0.2;
constexpr double town_far_m = 2000.0;

BuildingKind draw_kind(Pcg32& random, double from_middle_m) {
    std::uint32_t const draw = random.below(100);
    std::uint32_t const flats = from_middle_m < 180.0 ? 20 : 4;
    std::uint32_t const terraces = from_middle_m < 180.0 ? 55 : 12;
    if (draw < flats) return BuildingKind::flats;
    return draw < flats + terraces ? BuildingKind::terrace : BuildingKind::cottage;
}

/// Stands a building on the ground: its floor at the highest point below it. `plot` is x, z and the building's turns.
void add_building(Scene& scene, TownGround const& ground, Mesh mesh, BuildingKind kind, dvec3 const& plot) {
    dvec2 const at(plot.x, plot.y);
    dvec2 const half = half_plan(kind);
    double const floor = ground.heights(at - half, at + half)[1] + 0.12;
    std::uint32_t const id = add_mesh(scene, "building", std::move(mesh));
    scene.instances.push_back(placed_instance("building", id, {{at.x, floor, at.y}, plot.z}));
}

/// Which of all plots stay gardens, so that exactly the right number is built on: drawn without repetition.
std::vector<bool> choose_gardens(Pcg32& random, std::uint32_t plots, std::uint32_t gardens) {
    std::vector<bool> garden(plots, false);
    while (gardens > 0) {
        std::uint32_t const plot = random.below(plots);
        if (garden[plot]) continue;
        garden[plot] = true;
        --gardens;
    }
    return garden;
}

void add_buildings(Scene& scene, TownGround const& ground, Pcg32& random) {
    TownPaints const paints = add_town_paints(scene);
    std::vector<dvec3> plots;  // x, z, turns
    for (int row = 0; row < town_blocks_z; ++row)
        for (int column = 0; column < town_blocks_x; ++column) {
            if (town_block(column, row) != Block::homes) continue;
            for (int i = 0; i < 2 * plots_per_row; ++i) {
                bool const far = i >= plots_per_row;  // the row that faces +z
                double const x = pavement_end_m + plot_m * (i % plots_per_row + 0.5);
                dvec2 const at = town_corner(column, row) + dvec2(x, far ? town_pitch_z_m - 17.0 : 17.0);
                plots.emplace_back(at.x, at.y, far ? 0.0 : 0.5);
            }
        }
    auto const count = static_cast<std::uint32_t>(plots.size());
    std::vector<bool> const garden = choose_gardens(random, count, count - (town_buildings - 1));
    for (std::uint32_t i = 0; i < count; ++i) {
        if (garden[i]) continue;
        dvec2 const at(plots[i].x, plots[i].y);
        BuildingKind const kind = draw_kind(random, std::sqrt(at.x * at.x + at.y * at.y));
        double const shift = kind == BuildingKind::cottage ? random.uniform(-2.5, 0.5) : random.uniform(-0.8, 0.8);
        double const way = plots[i].z == 0.0 ? 1.0 : -1.0;
        add_building(scene, ground, make_building(kind, paints, random), kind, {at.x + shift * way, at.y, plots[i].z});
    }
    dvec2 const church = town_corner(3, 5) + dvec2(52.0, 27.0);
    add_building(scene, ground, make_building(BuildingKind::church, paints, random), BuildingKind::church,
                 {church.x, church.y, 0.0});
}

std::uint64_t seed_for(ProceduralConfig const& config) noexcept { return seed_of(config, town_seed); }

Camera ranged(Camera camera) {
    camera.near_m = town_near_m;
    camera.far_m = town_far_m;
    return camera;
}

/// On the line between the lanes of the middle street, which nothing drives on.
Camera town_frame(TownGround const& ground, double along_m, double turns) {
    double const z = 205.0 - along_m;
    dvec3 const eye(0.0, ground.height(0.0, z) + 1.7, z);
    return ranged(looking_at("", eye, eye + level_direction(0.25 + turns) + dvec3(0.0, 0.02, 0.0), sixty_degrees_rad));
}

}  // namespace

Result<Scene> make_town(ProceduralConfig const& config) {
    Scene scene;
    scene.name = "town";
    TownGround const ground(seed_for(config));
    ground.add_to(scene);
    Pcg32 random(seed_for(config) + 1);
    add_buildings(scene, ground, random);
    Pcg32 small(seed_for(config) + 2);
    add_town_props(scene, ground, small, static_cast<std::uint32_t>(town_props * config.moving_percent / 100.0 + 0.5));
    scene.lights.push_back(sun_light());
    scene.cameras.push_back(ranged(looking_at("above", {-70.0, 62.0, 190.0}, {22.0, 4.0, 55.0}, sixty_degrees_rad)));
    scene.cameras.push_back(town_frame(ground, 0.0, 0.0));
    scene.cameras.back().name = "street";
    scene.cameras.push_back(ranged(looking_at("market", {15.0, 9.0, 56.0}, {48.0, 10.0, 30.0}, sixty_degrees_rad)));
    settle(scene);
    return scene;
}

Result<CameraPath> make_town_path(ProceduralConfig const& config, PathInfo const& info) {
    TownGround const ground(seed_for(config));
    double const speed_m_s = info.name == "spin" ? 0.0 : 15.0;
    double const turns_s = info.name == "street" ? 0.0 : 210.0 / 360.0;
    CameraPath path{std::string(info.name), info.rate_hz, {}};
    for (std::uint32_t i = 0; i < info.frames; ++i) {
        double const time_s = i / info.rate_hz;
        path.frames.push_back(town_frame(ground, speed_m_s * time_s, turns_s * time_s));
    }
    return path;
}

}  // namespace gnomon::scene::detail
