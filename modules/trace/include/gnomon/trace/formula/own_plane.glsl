// Does a sample's own plane stand between its eye and its light? In float, with a proven bound, in C++ and in GLSL.
//
// Arithmetic is as imprecise as ray.glsl says; e = 2^-23.

#ifndef GNOMON_TRACE_FORMULA_OWN_PLANE_GLSL
#define GNOMON_TRACE_FORMULA_OWN_PLANE_GLSL

#include <gnomon/trace/formula/ray.glsl>

GN_BEGIN

/// On which side of the plane of a, b, c the target lies, a point or else a direction: 1, -1 or 0 for certain, else 2.
///
///     ((b - a) x (c - a)) . (target - a)
///
/// A product of three holds at most eight roundings: off by 8.01e times the sum of the products' sizes, and by what is
/// flushed, below 2^-60.
///
/// expects: `gn_in_range` of all, or `gn_scaled` of a direction.
GN_FN GN_INT gn_plane_side(GN_VEC3 a, GN_VEC3 b, GN_VEC3 c, GN_VEC3 target, GN_BOOL is_point) {
    GN_BOOL flat_x = gn_same(target.x, GN_SELECT(is_point, a.x, GN_FLOAT(0.0)));
    GN_BOOL flat_y = gn_same(target.y, GN_SELECT(is_point, a.y, GN_FLOAT(0.0)));
    GN_BOOL flat_z = gn_same(target.z, GN_SELECT(is_point, a.z, GN_FLOAT(0.0)));
    GN_BOOL within =
        gn_holds_direction(a, b, c, flat_x, flat_y) ||
        gn_holds_direction(GN_VEC3(a.y, a.z, a.x), GN_VEC3(b.y, b.z, b.x), GN_VEC3(c.y, c.z, c.x), flat_y, flat_z) ||
        gn_holds_direction(GN_VEC3(a.z, a.x, a.y), GN_VEC3(b.z, b.x, b.y), GN_VEC3(c.z, c.x, c.y), flat_z, flat_x);
    GN_PRECISE GN_VEC3 p = b - a;
    GN_PRECISE GN_VEC3 q = c - a;
    GN_PRECISE GN_FLOAT dx = target.x - GN_SELECT(is_point, a.x, GN_FLOAT(0.0));
    GN_PRECISE GN_FLOAT dy = target.y - GN_SELECT(is_point, a.y, GN_FLOAT(0.0));
    GN_PRECISE GN_FLOAT dz = target.z - GN_SELECT(is_point, a.z, GN_FLOAT(0.0));
    GN_PRECISE GN_FLOAT yz = p.y * q.z;
    GN_PRECISE GN_FLOAT zy = p.z * q.y;
    GN_PRECISE GN_FLOAT zx = p.z * q.x;
    GN_PRECISE GN_FLOAT xz = p.x * q.z;
    GN_PRECISE GN_FLOAT xy = p.x * q.y;
    GN_PRECISE GN_FLOAT yx = p.y * q.x;
    GN_PRECISE GN_FLOAT side = (yz - zy) * dx + (zx - xz) * dy + (xy - yx) * dz;
    GN_PRECISE GN_FLOAT sizes =
        (abs(yz) + abs(zy)) * abs(dx) + (abs(zx) + abs(xz)) * abs(dy) + (abs(xy) + abs(yx)) * abs(dz);
    GN_PRECISE GN_FLOAT bound = sizes * 1.0728836059570312e-6 + 8.673617379884035e-19;
    return GN_SELECT(within, 0, GN_SELECT(side > bound, 1, GN_SELECT(side < -bound, -1, 2)));
}

/// Whether a sample's own plane has eye and light strictly on opposite sides: 0 no, 1 yes, 2 unsure.
GN_FN GN_INT gn_turned_away(GN_INT eye_side, GN_INT light_side) {
    GN_BOOL on_plane = eye_side == 0 || light_side == 0;
    GN_BOOL unsure = eye_side == 2 || light_side == 2;
    return GN_SELECT(on_plane, 0, GN_SELECT(unsure, 2, GN_SELECT(eye_side == light_side, 0, 1)));
}

GN_END

#endif  // GNOMON_TRACE_FORMULA_OWN_PLANE_GLSL
