// Cluster keys: column, row, slice and normal cell in one number, 8 + 8 + 10 + 6 bits or 16 of each.
//
// source: [Olsson 2014, Paper II, 4.1, figure 4]. Tiles are the high bits, so that sorted keys run tile by tile.

#ifndef GNOMON_CLUSTER_FORMULA_KEY_GLSL
#define GNOMON_CLUSTER_FORMULA_KEY_GLSL

#include <gnomon/math/formula.glsl>

GN_BEGIN

/// row 31-24, column 23-16, slice 15-6, cell 5-0.
GN_FN GN_UINT gn_pack_key(GN_UINT column, GN_UINT row, GN_UINT slice, GN_UINT cell) {
    return row << 24 | column << 16 | slice << 6 | cell;
}

GN_FN GN_UINT gn_key_row(GN_UINT key) { return key >> 24; }
GN_FN GN_UINT gn_key_column(GN_UINT key) { return (key >> 16) & 0xFFu; }
GN_FN GN_UINT gn_key_slice(GN_UINT key) { return (key >> 6) & 0x3FFu; }
GN_FN GN_UINT gn_key_cell(GN_UINT key) { return key & 0x3Fu; }

/// The wide key's upper word: row 31-16, column 15-0.
GN_FN GN_UINT gn_wide_key_tile(GN_UINT column, GN_UINT row) { return row << 16 | column; }
/// The wide key's lower word: slice 31-16, cell 15-0.
GN_FN GN_UINT gn_wide_key_inner(GN_UINT slice, GN_UINT cell) { return slice << 16 | cell; }

/// A ratio in [-1, 1] as one of n equal parts; what is no such number (NaN) is in the middle.
GN_FN GN_UINT gn_cell_part(GN_FLOAT ratio, uint n) {
    GN_FLOAT r = GN_SELECT(ratio >= -1.0 && ratio <= 1.0, ratio, GN_FLOAT(0.0));
    GN_PRECISE GN_FLOAT part = (r * 0.5 + 0.5) * float(n);
    return gn_min(GN_UINT(part), GN_UINT(n - 1u));
}

/// The cell of a direction among n x n on each face of a cube: (face * n + part of the second axis) * n + part of the
/// first. Faces: +x, -x, +y, -y, +z, -z, by the largest coordinate, the first of equal ones; axes in their order.
///
/// expects: 0 < n; coordinates that are zero or normal numbers. Zero and NaN have a cell, but no meaning.
GN_FN GN_UINT gn_normal_cell(GN_VEC3 d, uint n) {
    GN_FLOAT ax = abs(d.x);
    GN_FLOAT ay = abs(d.y);
    GN_FLOAT az = abs(d.z);
    GN_BOOL on_x = ax >= ay && ax >= az;
    GN_BOOL on_y = !on_x && ay >= az;
    GN_FLOAT along = GN_SELECT(on_x, d.x, GN_SELECT(on_y, d.y, d.z));
    GN_FLOAT first = GN_SELECT(on_x, d.y, d.x);
    GN_FLOAT second = GN_SELECT(on_x || on_y, d.z, d.y);
    GN_FLOAT largest = abs(along);
    GN_UINT face = GN_SELECT(on_x, GN_UINT(0u), GN_SELECT(on_y, GN_UINT(2u), GN_UINT(4u))) +
                   GN_SELECT(along < 0.0, GN_UINT(1u), GN_UINT(0u));
    GN_UINT u = gn_cell_part(gn_div(first, largest), n);
    GN_UINT v = gn_cell_part(gn_div(second, largest), n);
    return (face * n + v) * n + u;
}

GN_END

#endif  // GNOMON_CLUSTER_FORMULA_KEY_GLSL
