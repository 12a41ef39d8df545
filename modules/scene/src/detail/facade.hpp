#pragma once
// The body of a building: four walls divided by floors and window axes, windows and doors as recesses. One closed solid:
// the walls share their corners and their heights, the caps take up every point of the walls' borders.

#include "solid_builder.hpp"

#include <array>
#include <cstdint>
#include <vector>

namespace gnomon::scene::detail {

enum class Top : std::uint8_t {
    flat,
    gable_along_x,  ///< The ridge runs along x: the walls at the ends of x end in a gable.
    gable_along_z,
};

/// Walls in this order, each from its left end seen from outside: front (+z), right (+x), back, left.
struct Facade {
    math::dvec3 lo;
    math::dvec3 hi;                                    ///< hi.y: the eaves.
    std::vector<double> heights;                       ///< Between lo.y and hi.y, rising.
    std::array<std::vector<double>, 4> axes;           ///< Per wall, between 0 and its length, rising.
    std::array<std::vector<std::uint32_t>, 4> recess;  ///< Per wall and cell, from the bottom left: a material, or `none`.
    double depth = 0.15;                               ///< Of the recesses.
    std::uint32_t material = 0;
    std::uint32_t top_material = 0;
    Top top = Top::flat;
    double ridge = 0.0;                                ///< Height of a gable's ridge.
};

/// A row of openings in one wall.
struct Openings {
    int count = 3;
    double width = 1.2;
};

/// Window axes: `count` openings of a width, evenly over `length`.
std::vector<double> window_axes(double length, Openings const& openings);

/// No recess anywhere; the lines must be there. `set_recess` then fills cells in.
void clear_recesses(Facade& facade);

/// Rows count from the bottom, columns from the left: openings are the odd columns of `window_axes`.
void set_recess(Facade& facade, std::size_t wall, math::ivec2 const& column_row, std::uint32_t material);

void add_facade(SolidBuilder& out, Facade const& facade);

}  // namespace gnomon::scene::detail
