// `houses`: a thousand equal houses on a grid, each with rooms inside; a plainer one of sixty triangles for a small budget.

#include "detail/cell_solid.hpp"
#include "detail/generators.hpp"
#include "detail/grid_mesh.hpp"

#include <algorithm>
#include <array>

namespace gnomon::scene::detail {

namespace {

using math::dvec2;
using math::dvec3;

constexpr int house_columns = 40;
constexpr int house_rows = 25;
constexpr double house_pitch_x_m = 16.0;
constexpr double house_pitch_z_m = 15.0;
constexpr double field_x_m = house_columns * house_pitch_x_m;
constexpr double field_z_m = house_rows * house_pitch_z_m;
constexpr std::uint32_t house_lights = 256;
constexpr std::uint64_t few_triangles = 60'320;
constexpr std::uint64_t many_triangles = 1'010'000;

struct HousePaints {
    std::uint32_t wall;
    std::uint32_t floor;
    std::uint32_t ceiling;
    std::uint32_t roof;
    std::uint32_t brick;
};

HousePaints add_house_paints(Scene& scene) {
    return {add_material(scene, "plaster", {0.66F, 0.60F, 0.48F}), add_material(scene, "boards", {0.36F, 0.22F, 0.12F}),
            add_material(scene, "ceiling", {0.74F, 0.73F, 0.70F}), add_material(scene, "tiles", {0.42F, 0.14F, 0.08F}),
            add_material(scene, "brick", {0.36F, 0.16F, 0.11F})};
}

/// 10 x 8 m, two rooms, five windows, a front door that stands open and one between the rooms.
void add_rooms(SolidBuilder& out, HousePaints const& p) {
    CellSolid house = make_cells({-5.0, -4.7, -3.6, -2.2, -0.55, 0.55, 2.2, 3.6, 4.7, 5.0}, {-0.5, 0.0, 0.9, 2.1, 2.6, 2.8},
                                 {-4.0, -3.7, -0.6, -0.4, 0.8, 2.2, 3.7, 4.0});
    fill_cells(house, {0, 0, 0}, {8, 0, 6}, p.floor);
    fill_cells(house, {0, 1, 0}, {8, 3, 6}, p.wall);
    fill_cells(house, {0, 4, 0}, {8, 4, 6}, p.ceiling);
    fill_cells(house, {1, 1, 1}, {7, 3, 1}, none);  // the back room
    fill_cells(house, {1, 1, 3}, {7, 3, 5}, none);  // the front room
    fill_cells(house, {4, 1, 2}, {4, 2, 2}, none);  // the door between them
    fill_cells(house, {4, 1, 6}, {4, 2, 6}, none);  // the front door
    for (int const x : {2, 6})
        for (int const z : {0, 6}) fill_cells(house, {x, 2, z}, {x, 2, z}, none);
    fill_cells(house, {0, 2, 4}, {0, 2, 4}, none);
    add_cells(out, house);
}

Mesh make_house(HousePaints const& p) {
    SolidBuilder out;
    add_rooms(out, p);
    std::array<dvec2, 3> const attic{{{-3.96, 2.72}, {3.96, 2.72}, {0.0, 5.2}}};
    out.prism(Plane::zy, attic, {-4.9, 4.9}, p.wall);
    std::array<dvec2, 6> const roof{{{-4.6, 2.36}, {0.0, 5.14}, {4.6, 2.36}, {4.6, 2.62}, {0.0, 5.42}, {-4.6, 2.62}}};
    out.prism(Plane::zy, roof, {-5.4, 5.4}, p.roof);
    out.box({2.2, 3.4, -1.6}, {2.9, 6.0, -0.9}, p.brick);
    std::array<dvec2, 3> const hood{{{-1.0, 2.25}, {1.0, 2.25}, {0.0, 2.6}}};
    out.prism(Plane::xy, hood, {3.9, 4.9}, p.roof);
    out.box({2.0, 0.72, 1.2}, {3.4, 0.78, 2.2}, p.floor);   // a table
    out.box({2.6, -0.05, 1.6}, {2.8, 0.74, 1.8}, p.floor);
    out.box({-1.1, -0.6, 3.9}, {1.1, -0.04, 5.2}, p.brick);
    return out.take();
}

/// A rectangle with a rectangular hole, as four trapezia: `outer` and `hole` start at the bottom left and go round.
void add_framed_hole(SolidBuilder& out, std::array<dvec3, 4> const& outer, std::array<dvec3, 4> const& hole, std::uint32_t paint) {
    for (std::size_t i = 0; i < 4; ++i) out.quad(outer[i], outer[(i + 1) % 4], hole[(i + 1) % 4], hole[i], paint);
}

std::array<dvec3, 4> upright_rectangle(double half_x, double low, double high, double z) {
    return {{{-half_x, low, z}, {half_x, low, z}, {half_x, high, z}, {-half_x, high, z}}};
}

std::array<dvec3, 4> seen_from_behind(std::array<dvec3, 4> const& r) { return {r[1], r[0], r[3], r[2]}; }

/// Sixty triangles: the same walls, one room, the front door, a roof without eaves, a chimney.
Mesh make_plain_house(HousePaints const& p) {
    SolidBuilder out;
    auto const front = upright_rectangle(5.0, -0.5, 2.8, 4.0);
    auto const back = upright_rectangle(5.0, -0.5, 2.8, -4.0);
    auto const inner_front = upright_rectangle(4.7, 0.0, 2.6, 3.7);
    auto const inner_back = upright_rectangle(4.7, 0.0, 2.6, -3.7);
    auto const hole = upright_rectangle(0.55, 0.06, 2.1, 4.0);
    auto const inner_hole = upright_rectangle(0.55, 0.06, 2.1, 3.7);
    dvec3 const left(-5.0, 5.4, 0.0);
    dvec3 const right(5.0, 5.4, 0.0);
    add_framed_hole(out, front, hole, p.wall);
    add_framed_hole(out, seen_from_behind(inner_front), seen_from_behind(inner_hole), p.wall);
    for (std::size_t i = 0; i < 4; ++i) out.quad(hole[i], hole[(i + 1) % 4], inner_hole[(i + 1) % 4], inner_hole[i], p.wall);
    out.quad(back[1], back[0], back[3], back[2], p.wall);
    out.polygon(std::array{front[1], back[1], back[2], right, front[2]}, p.wall);
    out.polygon(std::array{back[0], front[0], front[3], left, back[3]}, p.wall);
    out.quad(front[3], front[2], right, left, p.roof);
    out.quad(back[2], back[3], left, right, p.roof);
    out.quad(back[0], back[1], front[1], front[0], p.wall);
    out.quad(inner_back[0], inner_back[1], inner_back[2], inner_back[3], p.wall);
    out.quad(inner_back[1], inner_front[1], inner_front[2], inner_back[2], p.wall);
    out.quad(inner_front[0], inner_back[0], inner_back[3], inner_front[3], p.wall);
    out.quad(inner_front[0], inner_front[1], inner_back[1], inner_back[0], p.floor);
    out.quad(inner_back[3], inner_back[2], inner_front[2], inner_front[3], p.ceiling);
    out.box({2.2, 3.4, -1.6}, {2.9, 6.0, -0.9}, p.brick);
    return out.take();
}

dvec3 house_place(int column, int row) noexcept {
    return {(column + 0.5) * house_pitch_x_m - field_x_m * 0.5, 0.0, (row + 0.5) * house_pitch_z_m - field_z_m * 0.5};
}

/// The one that the zoom goes into: in the middle of the front row, so that nothing stands before it.
dvec3 visited_house() noexcept { return house_place(house_columns / 2, house_rows - 1); }

void add_house_lights(Scene& scene, std::uint64_t seed) {
    Pcg32 random(seed);
    for (std::uint32_t i = 0; i < house_lights; ++i) {
        Light light;
        light.name = "light " + std::to_string(i + 1);
        light.kind = LightKind::point;
        light.position_m.x = random.uniform(-0.5, 0.5) * field_x_m;
        light.position_m.y = random.uniform(0.5, 7.0);
        light.position_m.z = random.uniform(-0.5, 0.5) * field_z_m;
        light.color = {1.0F, 0.82F, 0.58F};
        light.intensity = 30.0F;
        light.range_m = 8.0F;
        scene.lights.push_back(std::move(light));
    }
}

/// `share` 0 is 300 m before the front door, 1 in the front room.
Camera zoom_frame(double share) {
    dvec3 const house = visited_house();
    double const left = 1.0 - share;
    double const before_m = -1.7 + 301.7 * left * left * left;
    dvec3 const eye = house + dvec3(0.0, 1.6 + 0.25 * std::max(0.0, before_m - 8.0), 4.0 + before_m);
    dvec3 const target = house + dvec3(0.0, 1.5, std::min(-2.0, before_m - 2.0));
    Camera camera = looking_at("", eye, target, sixty_degrees_rad);
    camera.near_m = 0.1;
    camera.far_m = 2000.0;
    return camera;
}

}  // namespace

Result<Scene> make_houses(ProceduralConfig const& config) {
    if (config.triangles < 10'000 || config.triangles > 4'000'000)
        return core::Failure{SceneError::bad_config, "houses cannot have " + std::to_string(config.triangles) +
                                                         " triangles; give 60000 or 1010000"};
    Scene scene;
    scene.name = "houses";
    HousePaints const paints = add_house_paints(scene);
    bool const few = config.triangles < (few_triangles + many_triangles) / 2;
    std::uint32_t const house = add_mesh(scene, "house", few ? make_plain_house(paints) : make_house(paints));
    Lattice slab;
    slab.cells = math::ivec3(8, 1, 8);
    slab.lo = dvec3(-0.5 * field_x_m - 60.0, -2.0, -0.5 * field_z_m - 60.0);
    slab.hi = dvec3(0.5 * field_x_m + 60.0, -0.2, 0.5 * field_z_m + 60.0);
    std::uint32_t const grass = add_material(scene, "grass", {0.21F, 0.27F, 0.11F});
    add_instance(scene, "ground", add_mesh(scene, "ground", box_mesh(slab, grass, grass, true)), dvec3(1.0), dvec3(0.0));
    for (int row = 0; row < house_rows; ++row)
        for (int column = 0; column < house_columns; ++column)
            add_instance(scene, "house", house, dvec3(1.0), house_place(column, row));
    add_house_lights(scene, seed_of(config, 12345));
    Camera over = looking_at("over", {-70.0, 17.0, 216.0}, {-20.0, 0.0, 160.0}, sixty_degrees_rad);
    over.near_m = 0.5;
    over.far_m = 2000.0;
    scene.cameras.push_back(over);
    scene.cameras.push_back(zoom_frame(0.99));
    scene.cameras.back().name = "inside";
    return scene;
}

Result<CameraPath> make_houses_path(ProceduralConfig const& config, PathInfo const& info) {
    (void)config;  // the houses are where they are, whatever the lights' seed
    CameraPath path{std::string(info.name), info.rate_hz, {}};
    for (std::uint32_t i = 0; i < info.frames; ++i) path.frames.push_back(zoom_frame(static_cast<double>(i) / (info.frames - 1)));
    return path;
}

}  // namespace gnomon::scene::detail
