// A tile of the image between its nearest and its farthest sample: six planes, and balls against them.
//
// Culling space: x right, y down, depth in front of the eye. The planes bound a convex region; a ball that reaches all six
// inner sides may still miss it beside an edge, so six planes keep more balls than the rows of rows.glsl do.
//
// source: [Olsson 2014, Paper I, 7], after [Lauritzen 2010]

#ifndef GNOMON_CULL_FORMULA_TILE_GLSL
#define GNOMON_CULL_FORMULA_TILE_GLSL

#include <gnomon/math/formula/touch.glsl>

GN_BEGIN

/// A border between columns or rows of tiles: x / depth or y / depth there (x or y in an orthographic view), and no less
/// than sqrt(1 + at^2), or 1.
struct GnTileBorder {
    float at;
    float norm;
};

/// The borders of a tile and the depths of its samples.
struct GnTile {
    GnTileBorder left;
    GnTileBorder right;
    GnTileBorder top;
    GnTileBorder bottom;
    float nearest;
    float farthest;
};

struct GnTilePlanes {
    GnPlane left;
    GnPlane right;
    GnPlane top;
    GnPlane bottom;
    GnPlane nearest;
    GnPlane farthest;
};

/// Coefficients that are exact: their magnitude is theirs, and a little more that no rounding takes away.
GN_PLAIN_VEC_FN GnPlane gn_exact_plane(vec3 normal, float offset, float norm) {
    GN_PRECISE float x = abs(normal.x) * 1.00000023841857910156f + 1.5777218e-30f;
    GN_PRECISE float y = abs(normal.y) * 1.00000023841857910156f + 1.5777218e-30f;
    GN_PRECISE float z = abs(normal.z) * 1.00000023841857910156f + 1.5777218e-30f;
    GnPlane plane;
    plane.normal = normal;
    plane.offset = offset;
    plane.magnitude = vec3(x, y, z);
    plane.norm = norm;
    return plane;
}

/// With perspective side planes go through the eye: x - at depth >= 0. Without, they stand: x - at >= 0.
GN_PLAIN_VEC_FN GnTilePlanes gn_tile_planes(GN_IN(GnTile) tile, bool perspective) {
    GnTileBorder l = tile.left;
    GnTileBorder r = tile.right;
    GnTileBorder t = tile.top;
    GnTileBorder b = tile.bottom;
    GnTilePlanes p;
    p.left = gn_exact_plane(vec3(1.0f, 0.0f, perspective ? -l.at : 0.0f), perspective ? 0.0f : -l.at, l.norm);
    p.right = gn_exact_plane(vec3(-1.0f, 0.0f, perspective ? r.at : 0.0f), perspective ? 0.0f : r.at, r.norm);
    p.top = gn_exact_plane(vec3(0.0f, 1.0f, perspective ? -t.at : 0.0f), perspective ? 0.0f : -t.at, t.norm);
    p.bottom = gn_exact_plane(vec3(0.0f, -1.0f, perspective ? b.at : 0.0f), perspective ? 0.0f : b.at, b.norm);
    p.nearest = gn_exact_plane(vec3(0.0f, 0.0f, 1.0f), -tile.nearest, 1.0f);
    p.farthest = gn_exact_plane(vec3(0.0f, 0.0f, -1.0f), tile.farthest, 1.0f);
    return p;
}

/// Whether a ball reaches the inner sides of all six planes. One of infinite radius does; one of negative radius does not.
GN_FN GN_BOOL gn_touches_tile(GN_IN(GnTilePlanes) planes, GN_IN(GN_TYPE(GnSphere)) ball) {
    return gn_touches_plane_sphere(planes.left, ball) && gn_touches_plane_sphere(planes.right, ball) &&
           gn_touches_plane_sphere(planes.top, ball) && gn_touches_plane_sphere(planes.bottom, ball) &&
           gn_touches_plane_sphere(planes.nearest, ball) && gn_touches_plane_sphere(planes.farthest, ball);
}

/// Whether a ball may reach depths of the tile: its ends are rounded outward. Infinite and negative radii as above.
GN_FN GN_BOOL gn_touches_depths(float nearest, float farthest, GN_IN(GN_TYPE(GnSphere)) ball) {
    return gn_low_end(ball.center.z, ball.radius) <= farthest && -gn_low_end(-ball.center.z, ball.radius) >= nearest && ball.radius >= 0.0;
}

GN_END

#endif  // GNOMON_CULL_FORMULA_TILE_GLSL
