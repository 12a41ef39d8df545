#pragma once
// The parts of `necropolis`. The avenue runs along z from the gate at the front (+z) to the hall at the back.

#include "generators.hpp"
#include "solid_builder.hpp"

#include <cstdint>

namespace gnomon::scene::detail {

inline constexpr double yard_half_m = 95.0;     ///< From the middle to the wall at the front and the sides.
inline constexpr double yard_back_z = -112.0;   ///< The wall behind the hall.
inline constexpr double hall_front_z = -34.0;   ///< The hall's front; it reaches 70 m back from here.
inline constexpr double graves_from_m = 14.0;   ///< The nearest graves from the middle of the avenue.
inline constexpr int grave_columns = 46;        ///< On each side.
inline constexpr int grave_rows = 54;
inline constexpr double grave_side_m = 1.7;
inline constexpr double grave_row_m = 2.1;
inline constexpr std::uint32_t grave_kinds = 4;
inline constexpr std::uint32_t cannons = 24;    ///< On the wall.

struct NecropolisPaints {
    std::uint32_t sand = 0;
    std::uint32_t paving = 0;
    std::uint32_t stone = 0;
    std::uint32_t pale = 0;
    std::uint32_t dark = 0;
    std::uint32_t bronze = 0;
    std::uint32_t glow = 0;
};

NecropolisPaints add_necropolis_paints(Scene& scene);

/// Ground, wall, gate, hall with its columns, two halls beside the avenue, tombs, cannons.
void add_necropolis_buildings(Scene& scene, NecropolisPaints const& paints);

/// A slab with a stone at its head, of one of four forms.
Mesh make_grave(std::uint32_t kind, NecropolisPaints const& paints);

Mesh make_spirit(NecropolisPaints const& paints);

/// Where the shots of a cannon start.
math::dvec3 cannon_mouth(std::uint32_t cannon) noexcept;

}  // namespace gnomon::scene::detail
