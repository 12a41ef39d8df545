// Which cell of a Morton grid an item's centre lies in. Halves of coordinates, so that no difference overflows.

#ifndef GNOMON_BVH_FORMULA_CODE_GLSL
#define GNOMON_BVH_FORMULA_CODE_GLSL

#include <gnomon/math/formula.glsl>
#include <gnomon/math/formula/bits.glsl>

GN_BEGIN

struct GnCodeGrid {
    vec3 half_lo;  // half of the least centre
    float last;    // cells per axis - 1
    vec3 scale;    // cells per axis over half the extent; 0 for an axis without extent
    uint unused;
};

/// The scale of an axis whose halved centres lie in [half_lo, half_hi].
GN_PLAIN_FN float gn_code_scale(float half_lo, float half_hi, float cells) {
    GN_PRECISE float extent = half_hi - half_lo;
    return extent > 0.0f ? gn_div(cells, extent) : 0.0f;
}

/// 0 to `last`, whatever the operands are; the clamp is on the float, before the cast.
GN_FN GN_UINT gn_code_cell(GN_FLOAT half_center, float half_lo, float scale, float last) {
    GN_PRECISE GN_FLOAT at = (half_center - half_lo) * scale;
    GN_FLOAT inside = GN_SELECT(at > 0.0, GN_SELECT(at < last, at, GN_FLOAT(last)), GN_FLOAT(0.0));
    return GN_UINT(GN_INT(inside));
}

/// 30-bit code of an item; `grid.last` is 1023.
GN_FN GN_UINT gn_code_30(GN_IN(GnCodeGrid) grid, GN_VEC3 half_center) {
    return gn_morton_30(gn_code_cell(half_center.x, grid.half_lo.x, grid.scale.x, grid.last),
                        gn_code_cell(half_center.y, grid.half_lo.y, grid.scale.y, grid.last),
                        gn_code_cell(half_center.z, grid.half_lo.z, grid.scale.z, grid.last));
}

GN_END

#endif  // GNOMON_BVH_FORMULA_CODE_GLSL
