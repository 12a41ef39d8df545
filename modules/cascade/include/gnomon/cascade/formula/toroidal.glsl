// Toroidal maps: light-space texel t of a row is kept at t modulo the map's size, so that a map that moves moves nothing.

#ifndef GNOMON_CASCADE_FORMULA_TOROIDAL_GLSL
#define GNOMON_CASCADE_FORMULA_TOROIDAL_GLSL

#include <gnomon/math/formula.glsl>

GN_BEGIN

/// Where column (row) `x` of the map is kept; `first` is where column 0 is.
///
/// expects: 0 <= x, first < size_px.
GN_FN GN_INT gn_toroidal(GN_INT x, int first, int size_px) {
    GN_INT kept = x + first;
    return GN_SELECT(kept >= size_px, kept - GN_INT(size_px), kept);
}

GN_END

#endif  // GNOMON_CASCADE_FORMULA_TOROIDAL_GLSL
