// Looking lights up in a shader: which cluster a point is in, and the lights of it from bit planes or from lists.
//
// GLSL 4.50. Copy this file, which needs no other (in C++ it does), or include it, and say first where the tables are:
//
//     layout(std430, set = 0, binding = 0) readonly buffer Planes { uint plane_words[]; };
//     layout(std430, set = 0, binding = 1) readonly buffer Depths { float slice_depth_m[]; };
//     #define GN_PLANE_WORD(i) plane_words[i]       // lights::BitPlanes::words
//     #define GN_SLICE_DEPTH(k) slice_depth_m[k]    // slices + 1 planes
//     #include <gnomon/lights/formula/lookup.glsl>
//     ...
//     uint cluster = gn_cluster_index(grid, tile.x, tile.y, gn_slice_at(grid, depth_m));
//     for (uint group = 0u; group < groups; ++group)
//         for (uint bits = GN_PLANE_WORD(gn_plane_word(group, stride, cluster)); bits != 0u; bits &= bits - 1u)
//             shade(lights[group * 32u + uint(findLSB(bits))]);
//
// From lists: `uvec2 cell = cells[cluster]` is (offset, count), and the lights are indices[cell.x] to
// indices[cell.x + cell.y - 1]; of 16-bit lists `gn_index_of_pair` takes one out of the word that holds it.

#ifndef GNOMON_LIGHTS_FORMULA_LOOKUP_GLSL
#define GNOMON_LIGHTS_FORMULA_LOOKUP_GLSL

#ifdef __cplusplus
#include <gnomon/math/formula.glsl>
#elif !defined(GNOMON_MATH_FORMULA_GLSL)
// The words of math/formula.glsl that stand below, as it has them.
#define GN_BEGIN
#define GN_END
#define GN_FN
#define GN_UINT uint
#define GN_IN(type) type
#define GN_SELECT(mask, yes, no) mix(no, yes, mask)
#endif

GN_BEGIN

struct GnClusterCounts {
    uint columns;
    uint rows;
    uint slices;
};

/// The dense index of a cluster: columns run fastest, then rows, then slices.
GN_FN GN_UINT gn_cluster_index(GN_IN(GnClusterCounts) grid, GN_UINT column, GN_UINT row, GN_UINT slice) {
    return (slice * GN_UINT(grid.rows) + row) * GN_UINT(grid.columns) + column;
}

/// Where the word of a group of 32 lights is for a cluster.
GN_FN GN_UINT gn_plane_word(GN_UINT group, GN_UINT stride, GN_UINT cluster) { return group * stride + cluster; }

/// A 16-bit index out of the word indices / 2 that holds it and its neighbour.
GN_FN GN_UINT gn_index_of_pair(GN_UINT word, GN_UINT at) {
    return GN_SELECT((at & GN_UINT(1u)) == GN_UINT(0u), word & GN_UINT(0xFFFFu), word >> 16);
}

GN_END

#ifdef GN_SLICE_DEPTH

/// The slice of a depth: the last whose near plane is not beyond it; 0 before the first, and for NaN.
uint gn_slice_at(GnClusterCounts grid, float depth_m) {
    uint first = 0u;
    for (uint count = grid.slices; count > 1u;) {
        uint upper = count / 2u;
        bool beyond = depth_m >= GN_SLICE_DEPTH(first + upper);
        first = beyond ? first + upper : first;
        count = beyond ? count - upper : upper;
    }
    return first;
}

#endif

#endif  // GNOMON_LIGHTS_FORMULA_LOOKUP_GLSL
