// From a pixel and a depth to a cluster, and to a position in the view space of the culling (x right, y down, depth).
//
// Tiles are integer quotients of pixels; slices come from the table of slices.glsl.

#ifndef GNOMON_CLUSTER_FORMULA_GRID_GLSL
#define GNOMON_CLUSTER_FORMULA_GRID_GLSL

#include <gnomon/cluster/formula/slices.glsl>
#include <gnomon/math/formula.glsl>

GN_BEGIN

// See cluster::Grid. In a storage buffer or push constants (std430).
struct GnGrid {
    uint tile_x;  // pixels
    uint tile_y;
    float inverse_tile_x;  // a guess; integers mend it
    float inverse_tile_y;
    uint columns;
    uint rows;
    uint perspective;
    float x0;  // on the plane at distance 1, or in metres: of the image's left border
    float dx;  // of a pixel's width
    float y0;  // of the top border, y down
    float dy;
    GnSliceTable depth;
};

/// a / b rounded down, from a guess of 1 / b.
///
/// expects: a below 65536, 0 < b <= 65536, a guess within a relative 1e-6: the product is then less than 1 off.
GN_FN GN_UINT gn_quotient(GN_UINT a, uint b, float inverse_b) {
    GN_PRECISE GN_FLOAT about = GN_FLOAT(a) * inverse_b;
    GN_UINT q = GN_UINT(about);
    q = q - GN_SELECT(q * b > a, GN_UINT(1u), GN_UINT(0u));
    q = q + GN_SELECT((q + 1u) * b <= a, GN_UINT(1u), GN_UINT(0u));
    return q;
}

/// The column of pixel column `x`; the last one beyond the image.
GN_FN GN_UINT gn_column_of(GN_IN(GnGrid) grid, GN_UINT x) {
    return gn_min(gn_quotient(gn_min(x, GN_UINT(65535u)), grid.tile_x, grid.inverse_tile_x), GN_UINT(grid.columns - 1u));
}

/// The row of pixel row `y`, from the top.
GN_FN GN_UINT gn_row_of(GN_IN(GnGrid) grid, GN_UINT y) {
    return gn_min(gn_quotient(gn_min(y, GN_UINT(65535u)), grid.tile_y, grid.inverse_tile_y), GN_UINT(grid.rows - 1u));
}

/// The dense index: columns run fastest, then rows, then slices.
GN_FN GN_UINT gn_cluster_of(GN_IN(GnGrid) grid, GN_UINT column, GN_UINT row, GN_UINT slice) {
    return (slice * grid.rows + row) * grid.columns + column;
}

/// The dense index of the cluster of pixel (`x`, `y`) at `depth`.
GN_WORDS_FN GN_UINT gn_cluster_at(GN_IN(GnGrid) grid, GN_WORDS words, GN_UINT x, GN_UINT y, GN_FLOAT depth) {
    GN_UINT slice = gn_slice_at(grid.depth, words, depth);
    return gn_cluster_of(grid, gn_column_of(grid, x), gn_row_of(grid, y), slice);
}

/// Where image point (`u`, `v`), in pixels, lies at `depth`.
GN_FN GN_VEC3 gn_position_at(GN_IN(GnGrid) grid, GN_FLOAT u, GN_FLOAT v, GN_FLOAT depth) {
    GN_FLOAT scale = grid.perspective != 0u ? depth : GN_FLOAT(1.0);
    GN_PRECISE GN_FLOAT right = u * grid.dx + grid.x0;
    GN_PRECISE GN_FLOAT down = v * grid.dy + grid.y0;
    GN_PRECISE GN_FLOAT x = right * scale;
    GN_PRECISE GN_FLOAT y = down * scale;
    return GN_VEC3(x, y, depth);
}

/// How far an offset goes along a direction: of a sample's offset from the eye along the view's, its depth.
GN_FN GN_FLOAT gn_along(GN_VEC3 offset, GN_VEC3 direction) {
    GN_PRECISE GN_FLOAT sum = offset.x * direction.x + offset.y * direction.y + offset.z * direction.z;
    return sum;
}

GN_END

#endif  // GNOMON_CLUSTER_FORMULA_GRID_GLSL
