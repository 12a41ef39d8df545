// `atrium`: two storeys of arcades round a court that is open to the sky, 40 m long, 25 m wide, 20 m high inside.

#include "detail/atrium_lights.hpp"
#include "detail/atrium_parts.hpp"
#include "detail/branching.hpp"
#include "detail/generators.hpp"
#include "detail/rail.hpp"
#include "detail/turn.hpp"

#include <array>
#include <cmath>

namespace gnomon::scene::detail {

namespace {

using math::dvec3;

// The court reaches to the columns' axes: 7 bays by 3.
constexpr double court_x_m = 14.0;
constexpr double court_z_m = 6.0;
constexpr double hall_x_m = 20.0;
constexpr double hall_z_m = 12.5;
constexpr std::array<double, 2> floors_m{0.0, 8.2};
constexpr std::array<double, 2> column_m{5.2, 4.6};  ///< From the storey's floor to where its arches spring.

struct Paints {
    std::uint32_t stone;
    std::uint32_t pale;
    std::uint32_t wall;
    std::uint32_t dark;
    std::uint32_t light;
    std::uint32_t wood;
    std::uint32_t bronze;
    std::uint32_t red;
    std::uint32_t green;
    std::uint32_t bark;
};

Paints add_paints(Scene& scene) {
    return {add_material(scene, "sandstone", {0.44F, 0.35F, 0.24F}), add_material(scene, "limestone", {0.52F, 0.47F, 0.38F}),
            add_material(scene, "plaster", {0.46F, 0.33F, 0.22F}),   add_material(scene, "dark tile", {0.17F, 0.14F, 0.12F}),
            add_material(scene, "light tile", {0.42F, 0.38F, 0.31F}), add_material(scene, "wood", {0.20F, 0.11F, 0.06F}),
            add_material(scene, "bronze", {0.14F, 0.12F, 0.08F}),    add_material(scene, "red cloth", {0.42F, 0.06F, 0.05F}),
            add_material(scene, "green cloth", {0.07F, 0.22F, 0.13F}), add_material(scene, "bark", {0.22F, 0.15F, 0.10F})};
}

/// A bay of the arcade: the middle of its opening on the floor, and how its wall is turned; z' points out of the court.
struct Bay {
    dvec3 middle;
    double turns;
};

std::vector<Bay> bays() {
    std::vector<Bay> all;
    for (int i = -3; i <= 3; ++i)
        for (double const side : {-1.0, 1.0}) all.push_back({{i * bay_m, 0.0, side * court_z_m}, side < 0.0 ? 0.5 : 0.0});
    for (int i = -1; i <= 1; ++i)
        for (double const side : {-1.0, 1.0}) all.push_back({{side * court_x_m, 0.0, i * bay_m}, side < 0.0 ? 0.75 : 0.25});
    return all;
}

/// Columns at the bays' left ends but the corners, piers there, over the floor of each storey.
void add_columns(Scene& scene, Paints const& paint) {
    for (std::size_t storey = 0; storey < 2; ++storey) {
        std::uint32_t const column =
            add_solid_mesh(scene, "column", column_solid(column_m[storey], storey == 0 ? 0.36 : 0.3), paint.pale);
        std::uint32_t const pier = add_solid_mesh(scene, "pier", pier_solid(column_m[storey]), paint.stone);
        double const y = floors_m[storey];
        for (double const side : {-1.0, 1.0}) {
            for (int i = -2; i <= 3; ++i) add_instance(scene, "column", column, dvec3(1.0), {(i - 0.5) * bay_m, y, side * court_z_m});
            for (int i = 0; i <= 1; ++i) add_instance(scene, "column", column, dvec3(1.0), {side * court_x_m, y, (i - 0.5) * bay_m});
            for (double const end : {-1.0, 1.0}) add_instance(scene, "pier", pier, dvec3(1.0), {end * court_x_m, y, side * court_z_m});
        }
    }
}

/// Arches over the columns; a wall above them up to the cornice.
void add_arches(Scene& scene, Paints const& paint) {
    constexpr std::array<double, 2> wall_m{2.5, 2.4};
    for (std::size_t storey = 0; storey < 2; ++storey) {
        double const inner_m = storey == 0 ? 1.5 : 1.55;
        std::uint32_t const spandrel = add_solid_mesh(scene, "spandrel", spandrel_solid(inner_m, wall_m[storey]), paint.wall);
        std::uint32_t const archivolt = add_solid_mesh(scene, "archivolt", archivolt_solid(inner_m), paint.stone);
        for (Bay const& bay : bays()) {
            dvec3 const at = bay.middle + dvec3(0.0, floors_m[storey] + column_m[storey], 0.0);
            add_placed_instance(scene, "spandrel", spandrel, turned_by(bay.turns, at));
            add_placed_instance(scene, "archivolt", archivolt, turned_by(bay.turns, at));
        }
    }
}

/// A moulding round the court: how far out of the columns' axes, and height.
void add_cornice(Solid& out, std::span<std::array<double, 2> const> section, double y_m) {
    std::vector<Storey> storeys;
    for (auto const& [aside, up] : section) storeys.push_back({court_x_m + aside, court_z_m + aside, y_m + up});
    add_frame(out, dvec3(0.0), storeys, 20);
}

/// Everything that runs round: walls, floors, cornices, rails, the attic and the roof.
void add_frames(Scene& scene, Paints const& paint) {
    Solid walls;
    std::array<Storey, 4> const wall{
        {{hall_x_m, hall_z_m, -0.3}, {hall_x_m + 0.7, hall_z_m + 0.7, -0.3}, {hall_x_m + 0.7, hall_z_m + 0.7, 20.6}, {hall_x_m, hall_z_m, 20.6}}};
    add_frame(walls, dvec3(0.0), wall, 16);
    add_solid_object(scene, "walls", walls, paint.wall);
    Solid slabs;  // the gallery's floor, and the roof over it
    for (double const y : {7.72, 19.4}) {
        std::array<Storey, 4> const slab{{{court_x_m - 0.25, court_z_m - 0.25, y}, {hall_x_m + 0.3, hall_z_m + 0.3, y},
                                          {hall_x_m + 0.3, hall_z_m + 0.3, y + 0.5}, {court_x_m - 0.25, court_z_m - 0.25, y + 0.5}}};
        add_frame(slabs, dvec3(0.0), slab, 24);
    }
    add_solid_object(scene, "slabs", slabs, paint.light);
    Solid cornices;
    constexpr std::array<std::array<double, 2>, 8> big{{{-0.5, 0.42}, {-0.55, 0.5}, {-0.2, 0.55}, {0.34, 0.55}, {0.34, -0.1}, {-0.34, -0.1},
                                                       {-0.36, 0.1}, {-0.44, 0.3}}};
    std::array<std::array<double, 2>, 8> counter_clockwise = big;
    for (std::size_t i = 0; i < big.size(); ++i) counter_clockwise[i] = big[big.size() - 1 - i];
    for (double const y : {7.7, 15.15, 19.3}) add_cornice(cornices, counter_clockwise, y);
    add_solid_object(scene, "cornices", cornices, paint.stone);
    Solid rails;
    constexpr std::array<std::array<double, 2>, 6> rail{{{-0.12, 0.0}, {0.12, 0.0}, {0.16, 0.06}, {0.14, 0.14}, {-0.14, 0.14}, {-0.16, 0.06}}};
    add_cornice(rails, rail, 9.16);
    std::array<std::array<double, 2>, 4> const curb{{{-0.14, -0.1}, {0.14, -0.1}, {0.14, 0.14}, {-0.14, 0.14}}};
    add_cornice(rails, curb, 8.22);
    add_solid_object(scene, "rails", rails, paint.pale);
    Solid attic;
    constexpr std::array<std::array<double, 2>, 4> sill{{{-0.24, 0.0}, {0.24, 0.0}, {0.24, 0.9}, {-0.24, 0.9}}};
    add_cornice(attic, sill, 15.6);
    add_cornice(attic, sill, 18.5);
    add_solid_object(scene, "attic", attic, paint.wall);
}

/// Piers between the attic's windows, and frames of stone in these.
void add_windows(Scene& scene, Paints const& paint) {
    Solid pier;
    std::array<Storey, 2> const block{{{0.75, 0.235, 0.0}, {0.75, 0.235, 2.2}}};
    add_stack(pier, dvec3(0.0), block);
    std::array<Storey, 6> const pilaster{
        {{0.42, 0.3, 0.0}, {0.42, 0.3, 0.18}, {0.34, 0.28, 0.24}, {0.34, 0.28, 1.9}, {0.42, 0.32, 1.98}, {0.42, 0.32, 2.2}}};
    add_stack(pier, dvec3(0.0), pilaster);
    Solid frame;
    for (double const x : {-1.22, 0.0, 1.22}) add_box(frame, {x - 0.07, 0.0, -0.12}, {x + 0.07, 2.2, 0.12});
    for (double const y : {0.08, 1.1, 2.0}) add_box(frame, {-1.27, y, -0.09}, {1.27, y + 0.1, 0.09});
    std::uint32_t const pier_mesh = add_solid_mesh(scene, "attic pier", pier, paint.wall);
    std::uint32_t const frame_mesh = add_solid_mesh(scene, "window", frame, paint.pale);
    for (Bay const& bay : bays()) {
        Placement place = turned_by(bay.turns, bay.middle + dvec3(0.0, 16.4, 0.0));
        add_placed_instance(scene, "window", frame_mesh, place);
        place.origin = place.origin + place.right * (bay_m * 0.5);
        add_placed_instance(scene, "attic pier", pier_mesh, place);
    }
}

/// Balusters between the upper columns; beams under both ceilings of the gallery; doors in its walls.
void add_gallery(Scene& scene, Paints const& paint) {
    Solid row;
    Solid const baluster = baluster_solid(0.84);
    for (int i = -3; i <= 3; ++i) add_placed(row, baluster, turned_by(0.0, {i * 0.42, 8.34, 0.0}));
    std::uint32_t const row_mesh = add_solid_mesh(scene, "balusters", row, paint.pale);
    std::uint32_t const stone = add_solid_mesh(scene, "portal", portal_stone_solid(), paint.stone);
    std::uint32_t const door = add_solid_mesh(scene, "door", portal_door_solid(), paint.wood);
    for (Bay const& bay : bays()) {
        Placement const place = turned_by(bay.turns, bay.middle);
        add_placed_instance(scene, "balusters", row_mesh, place);
        bool const is_end = std::abs(bay.middle.x) == court_x_m;
        double const depth_m = is_end ? hall_x_m - court_x_m : hall_z_m - court_z_m;
        Solid beam;
        std::array<Storey, 3> const section{{{0.16, depth_m * 0.5, -0.55}, {0.2, depth_m * 0.5, -0.4}, {0.2, depth_m * 0.5, 0.06}}};
        add_stack(beam, {0.0, 0.0, depth_m * 0.5 + 0.1}, section);
        std::uint32_t const beam_mesh = add_solid_mesh(scene, "beam", beam, paint.wood);
        for (double const y : {7.74, 19.42})
            for (double const x : {-1.0, 1.0}) {
                Placement at = place;
                at.origin = place.origin + place.right * x + dvec3(0.0, y, 0.0);
                add_placed_instance(scene, "beam", beam_mesh, at);
            }
        for (double const y : floors_m) {
            Placement at = turned_by(bay.turns + 0.5, bay.middle);  // doors face the court
            at.origin = bay.middle + place.back * depth_m + dvec3(0.0, y, 0.0);
            add_placed_instance(scene, "portal", stone, at);
            add_placed_instance(scene, "door", door, at);
        }
    }
}

void add_lanterns(Scene& scene, Paints const& paint) {
    std::uint32_t const lantern = add_solid_mesh(scene, "lantern", lantern_solid(lantern_chain_m), paint.bronze);
    for (dvec3 const& at : lantern_places())
        add_instance(scene, "lantern", lantern, dvec3(1.0), at + dvec3(0.0, lantern_chain_m + lantern_drop_m, 0.0));
}

/// The checkered floor, and what stands on it.
void add_floor(Scene& scene, Paints const& paint) {
    Solid base;
    add_box(base, {-20.5, -0.6, -13.0}, {20.5, -0.05, 13.0});
    add_solid_object(scene, "base", base, paint.dark);
    std::array<std::uint32_t, 2> tiles{};
    for (std::size_t i = 0; i < 2; ++i) {
        Mesh mesh;
        add_solid(mesh, tiles_solid(i == 0), paint.light);
        add_solid(mesh, tiles_solid(i == 1), paint.dark);
        tiles[i] = add_mesh(scene, "tiles", std::move(mesh));
    }
    for (int z = 0; z < 5; ++z)
        for (int x = 0; x < 8; ++x)
            add_instance(scene, "tiles", tiles[static_cast<std::size_t>(x + z) % 2], dvec3(1.0), {x * 5.0 - 17.5, 0.0, z * 5.0 - 10.0});
    std::uint32_t const fountain = add_solid_mesh(scene, "fountain", fountain_solid(), paint.pale);
    add_instance(scene, "fountain", fountain, dvec3(1.0), {0.0, 0.03, 0.0});
    std::uint32_t const urn = add_solid_mesh(scene, "urn", urn_solid(), paint.stone);
    std::uint32_t const bench = add_solid_mesh(scene, "bench", bench_solid(), paint.pale);
    for (double const x : {-12.4, -4.4, 4.4, 12.4})
        for (double const z : {-4.6, 4.6}) {
            add_instance(scene, "urn", urn, dvec3(1.0), {x, 0.03, z});
            if (x * x > 50.0) add_instance(scene, "bench", bench, dvec3(1.0), {x * 0.66, 0.03, z * 1.02});
        }
}

/// Curtains in some of the upper arches, as if to keep the sun out.
void add_curtains(Scene& scene, Paints const& paint) {
    std::uint32_t const red = add_solid_mesh(scene, "red curtain", curtain_solid(3.1), paint.red);
    std::uint32_t const green = add_solid_mesh(scene, "green curtain", curtain_solid(3.1), paint.green);
    std::vector<Bay> const all = bays();
    for (std::size_t i = 0; i < all.size(); ++i) {
        if (i % 3 == 1) continue;
        dvec3 const at = all[i].middle + dvec3(0.0, floors_m[1] + column_m[1] + 0.35, 0.0);
        add_placed_instance(scene, i % 2 == 0 ? "red curtain" : "green curtain", i % 2 == 0 ? red : green, turned_by(all[i].turns, at));
    }
}

/// 178 + 1092 + 2520 + 4200 triangles: 7,990.
constexpr std::array<BranchLevel, 4> bare_levels{
    {{1, 10, 8, 0.72, 0.0, 0.06, 0.03}, {14, 8, 5, 0.62, 0.16, 0.12, 0.08}, {6, 4, 4, 0.5, 0.13, 0.17, 0.06}, {5, 3, 2, 0.5, 0.12, 0.2, 0.04}}};

/// Twelve bare trees in tubs, in two rows along the court.
void add_trees(Scene& scene, Paints const& paint, std::uint64_t seed) {
    Pcg32 random(seed);
    TreeShape const shape{7.0, 0.14, 0.3, 0.4, bare_levels};
    std::uint32_t const tub = add_solid_mesh(scene, "tub", tub_solid(), paint.stone);
    for (int i = 0; i < 12; ++i) {
        std::uint32_t const tree = add_solid_mesh(scene, "tree", grow_tree(shape, random).bark, paint.bark);
        dvec3 const at((i % 6 - 2.5) * 4.2, 0.03, i < 6 ? -2.9 : 2.9);
        add_instance(scene, "tub", tub, dvec3(1.0), at);
        add_instance(scene, "tree", tree, dvec3(1.0), at + dvec3(0.0, 0.54, 0.0));
    }
}

constexpr Lens atrium_lens{sixty_degrees_rad, 0.1, 100.0};

}  // namespace

Result<Scene> make_atrium(ProceduralConfig const& config) {
    Scene scene;
    scene.name = "atrium";
    Paints const paint = add_paints(scene);
    add_floor(scene, paint);
    add_frames(scene, paint);
    add_columns(scene, paint);
    add_arches(scene, paint);
    add_windows(scene, paint);
    add_gallery(scene, paint);
    add_lanterns(scene, paint);
    add_curtains(scene, paint);
    if (config.trees) add_trees(scene, paint, seed_of(config, 12345));
    add_atrium_lights(scene, config);
    scene.cameras.push_back(view_from("still", {{-12.6, 2.4, 3.4}, {10.0, 6.2, -2.6}}, atrium_lens));
    scene.cameras.push_back(view_from("gallery", {{-17.0, 10.0, 9.4}, {6.0, 9.3, 6.4}}, atrium_lens));
    scene.cameras.push_back(view_from("roof", {{-17.0, 47.0, 27.0}, {-0.5, 5.0, 0.0}}, atrium_lens));
    return scene;
}

/// Through the lower gallery, between two columns into the court, up past the fountain, and into the upper gallery.
Result<CameraPath> make_atrium_path(ProceduralConfig const&, PathInfo const& info) {
    constexpr std::array<Stop, 13> stops{{{{-17.0, 1.7, 9.2}, {-10.0, 2.2, 8.6}},
                                          {{-13.0, 1.7, 9.2}, {-6.0, 2.4, 7.0}},
                                          {{-9.6, 1.8, 8.6}, {-4.0, 2.6, 3.0}},
                                          {{-8.0, 2.0, 6.0}, {-1.0, 3.0, 0.0}},
                                          {{-6.3, 2.7, 2.3}, {2.0, 4.0, -2.0}},
                                          {{-4.2, 4.4, 0.0}, {6.0, 6.0, -3.0}},
                                          {{-1.0, 6.8, -0.8}, {9.0, 8.0, -3.0}},
                                          {{2.2, 9.2, -0.8}, {11.0, 9.8, -4.0}},
                                          {{5.6, 10.9, -1.6}, {10.0, 10.8, -8.0}},
                                          {{8.0, 11.1, -4.0}, {9.0, 10.6, -11.0}},
                                          {{8.2, 10.9, -6.9}, {13.0, 10.2, -10.4}},
                                          {{10.0, 10.4, -9.2}, {17.0, 10.0, -9.0}},
                                          {{14.0, 10.2, -9.4}, {18.0, 10.0, -3.0}}}};
    if (info.name == "fly") return path_along(info, stops, atrium_lens);
    constexpr std::array<Stop, 2> still{{{{-12.6, 2.4, 3.4}, {10.0, 6.2, -2.6}}, {{-12.6, 2.4, 3.4}, {10.0, 6.2, -2.6}}}};
    return path_along(info, still, atrium_lens);
}

}  // namespace gnomon::scene::detail
