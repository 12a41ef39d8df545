#pragma once
// The pieces that the citadel is put together from. None is closed: what stands on something has no bottom, and what ends
// inside something else has no end.

#include "solid.hpp"

#include <cstdint>

namespace gnomon::scene::detail {

inline constexpr double citadel_wall_m = 9.0;    ///< The walk's height over the town's ground, which is at y = 0.
inline constexpr double citadel_tower_m = 14.0;

/// The citadel's materials.
struct Stones {
    std::uint32_t wall;
    std::uint32_t tower;
    std::uint32_t keep;
    std::uint32_t roof;
    std::uint32_t plaster;
    std::uint32_t timber;
    std::uint32_t shadow;  ///< Slits and windows.
};

/// A block on a battlement with a sloped cap, 1.1 m high.
void add_merlon(Solid& out, Placement const& at, double half_x_m, double half_z_m);

/// A dark slot in a wall that faces z' at the placement's origin: its face, and four sides that go into the wall.
void add_slit(Solid& out, Placement const& at, double half_m, double height_m);

/// On a circle of this radius, facing out, at `turns`.
[[nodiscard]] Placement on_circle(double turns, double radius_m, double y_m);

// Each adds a mesh and returns its index.
std::uint32_t add_tower_mesh(Scene& scene, Stones const& stones, bool has_roof);
std::uint32_t add_wall_mesh(Scene& scene, Stones const& stones, double length_m);
std::uint32_t add_stair_mesh(Scene& scene, std::uint32_t material);
std::uint32_t add_town_house_mesh(Scene& scene, Stones const& stones, double half_x_m, double half_z_m);
std::uint32_t add_gatehouse_mesh(Scene& scene, Stones const& stones);
std::uint32_t add_pine_mesh(Scene& scene, std::uint32_t needles, std::uint32_t bark);

}  // namespace gnomon::scene::detail
