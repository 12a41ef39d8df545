#pragma once
// The pieces that the atrium is put together from, each standing on y = 0 round the origin unless it says otherwise.

#include "solid.hpp"

#include <cstdint>

namespace gnomon::scene::detail {

/// Height of a column from floor to springing; the arcades' bays are 4 m.
inline constexpr double bay_m = 4.0;

/// A column with plinth, base, swelling shaft, capital and abacus.
[[nodiscard]] Solid column_solid(double height_m, double radius_m);

/// The pier at a corner: a square one with the same mouldings.
[[nodiscard]] Solid pier_solid(double height_m);

/// A bay's wall over its arch, between x = -2 and 2, springing at y = 0.
[[nodiscard]] Solid spandrel_solid(double inner_m, double top_m);

/// Two raised mouldings and a keystone round the same arch.
[[nodiscard]] Solid archivolt_solid(double inner_m);

[[nodiscard]] Solid baluster_solid(double height_m);

/// A lantern that hangs from y = 0 on a chain.
[[nodiscard]] Solid lantern_solid(double chain_m);

[[nodiscard]] Solid urn_solid();

/// Two basins over a wide one.
[[nodiscard]] Solid fountain_solid();

/// Stone round a doorway in a wall that faces +z at z = 0, and the leaves of its door.
[[nodiscard]] Solid portal_stone_solid();
[[nodiscard]] Solid portal_door_solid();

/// A cloth 3.2 m wide that hangs `drop_m` down from y = 0, in folds.
[[nodiscard]] Solid curtain_solid(double drop_m);

/// 13 or 12 of 5x5 tiles of 1 m, which make a checkerboard together; tops at y = 0.03.
[[nodiscard]] Solid tiles_solid(bool even);

[[nodiscard]] Solid bench_solid();

/// A round tub with a rim, for a tree.
[[nodiscard]] Solid tub_solid();

}  // namespace gnomon::scene::detail
