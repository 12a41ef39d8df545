// The tiles that a triangle of a light's hull may touch, marked: the GLSL half of `mark_tiles`. tile_kernels.hpp has the layout.

#version 450
#extension GL_GOOGLE_include_directive : require

#include <gnomon/lights/formula/hull.glsl>

#include "gnomon/backend/item.glsl"

layout(local_size_x = 64) in;

layout(std430, set = 0, binding = 0) readonly buffer Hulls { GnHull hulls[]; };
layout(std430, set = 0, binding = 1) readonly buffer Borders { float borders[]; };
layout(std430, set = 0, binding = 2) buffer Marks { uint marks[]; };
layout(push_constant) uniform Constants {
    uint count;
    uint columns, rows;
    uint words;
    uint orthographic;
    uint bands;
    uint band_rows;
} c;

// Ways to leave tiles out: what is left of the face, right of it, above, below.
const uint to_left = 0u;
const uint to_right = 1u;
const uint above = 2u;
const uint below = 3u;

bool is_past(GnHullFace face, uint way, uint i) {
    uint row = c.columns + 1u + i;
    if (way == to_left) return gn_is_face_right(face, borders[i + 1u], 1.0);
    if (way == to_right) return !gn_is_face_right(face, -borders[i], -1.0);
    if (way == above) return gn_is_face_below(face, borders[row + 1u], 1.0);
    return !gn_is_face_below(face, -borders[row], -1.0);
}

/// How many borders are past, by binary search.
uint count_past(GnHullFace face, uint way, uint count) {
    uint first = 0u;
    for (uint rest = count; rest > 0u;) {
        uint middle = rest / 2u;
        bool past = is_past(face, way, first + middle);
        first = past ? first + middle + 1u : first;
        rest = past ? rest - middle - 1u : middle;
    }
    return first;
}

const uint block = 8u;  // lights::hull_block

bool covers(GnHullFace face, uint i, uint i_end, uint j, uint j_end) {
    uint rows = c.columns + 1u;
    return gn_may_cover(face, GnTileWindow(borders[i], borders[i_end], borders[rows + j], borders[rows + j_end]));
}

void mark(uint light, uint tile) { atomicOr(marks[tile * c.words + (light >> 5)], 1u << (light & 31u)); }

void main() {
    uint item = GNOMON_ITEM;
    if (item >= c.count) return;
    uint triangle = item / c.bands;
    uint light = triangle / gn_hull_faces();
    uint f = triangle % gn_hull_faces();
    uint band_top = min(item % c.bands * c.band_rows, c.rows);
    uint band_bottom = min(band_top + c.band_rows, c.rows);
    GnHull hull = hulls[light];
    if (hull.kind == 2u && f == 0u)
        for (uint tile = band_top * c.columns; tile < band_bottom * c.columns; ++tile) mark(light, tile);
    if (hull.kind >= 2u) return;
    GnHullFace face = gn_hull_face(hull, f, c.orthographic == 0u);
    if (face.kind == 0u) return;
    uint left = count_past(face, to_left, c.columns);
    uint right = count_past(face, to_right, c.columns);
    uint top = max(count_past(face, above, c.rows), band_top);
    uint bottom = min(count_past(face, below, c.rows), band_bottom);
    for (uint block_j = top; block_j < bottom; block_j += block)
        for (uint block_i = left; block_i < right; block_i += block) {
            uint j_end = min(block_j + block, bottom);
            uint i_end = min(block_i + block, right);
            if (!covers(face, block_i, i_end, block_j, j_end)) continue;
            for (uint j = block_j; j < j_end; ++j)
                for (uint i = block_i; i < i_end; ++i)
                    if (covers(face, i, i + 1u, j, j + 1u)) mark(light, j * c.columns + i);
        }
}
