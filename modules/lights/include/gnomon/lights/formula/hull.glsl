// Lights as meshes: twenty triangles around a ball or a cone, and which tiles of the image a triangle may touch.
//
// Conservative rasterization into an image of one pixel a tile, in homogeneous coordinates (x, y, depth), so that nothing
// is clipped: an edge is the plane through the eye and its two corners, moved outward until it holds the tile that it cuts.
//
//     n = a x b,  inside: n . (X, Y, 1) >= 0 for some corner (X, Y) of the tile       det = n . c > 0: faces away
//
// Triangles that face the eye, or lie behind it, are left out: a ray that meets the light leaves its hull, through one that faces away, so
// the others cover all of the light in front of the eye, with the eye inside it too. An orthographic view is the same with depth 1.
//
// No tile is missed. With u = 2^-24: an edge's normal, a x (b - a), errs by at most 3.1 u of its terms' sizes, its value at a
// tile's corner by 6.1 u, the determinant by 7.1 u; all are compared with 10 u. The corners themselves are rounded, by at
// most 16 u of the light's coordinates, which moves the mesh by no more: lights::make_hull makes it larger by 128 u. As a
// mesh that moves without meeting the light stays wound around it once, rays that meet the light still leave through it.
//
// source: [Olsson 2014, Paper I, 6.1]; [Hasselgren et al. 2005, Conservative Rasterization], the first of the algorithms

#ifndef GNOMON_LIGHTS_FORMULA_HULL_GLSL
#define GNOMON_LIGHTS_FORMULA_HULL_GLSL

#include <gnomon/math/formula.glsl>

GN_BEGIN

// Kinds: 0 an icosahedron, 1 a pyramid of ten sides with its base, 2 everywhere, 3 nowhere.
// Corners are origin + a u + b v + c w; u, v, w are right-handed. 64 bytes, by std430 too.
struct GnHull {
    vec3 origin;
    uint kind;
    vec3 u;
    uint unused_a;
    vec3 v;
    uint unused_b;
    vec3 w;
    uint unused_c;
};

GN_PLAIN_FN uint gn_hull_faces() { return 20u; }

/// Of 36 degrees times k, 0 to 9.
GN_PLAIN_FN float gn_ring_cos(uint k) {
    uint m = k > 5u ? 10u - k : k;
    float inner = m == 2u ? 0.30901699f : -0.30901699f;
    float outer = m == 1u ? 0.80901699f : -0.80901699f;
    return m == 0u ? 1.0f : m == 5u ? -1.0f : m == 2u || m == 3u ? inner : outer;
}

GN_PLAIN_FN float gn_ring_sin(uint k) {
    uint m = k > 5u ? k - 5u : k;
    float s = m == 0u || m == 5u ? 0.0f : m == 1u || m == 4u ? 0.58778525f : 0.95105652f;
    return k > 5u ? -s : s;
}

/// Corner i, 0 to 11. Icosahedron: top, five of the upper ring, five of the lower, bottom. Pyramid: apex, ten, base.
GN_PLAIN_VEC_FN vec3 gn_hull_corner(GN_IN(GnHull) h, uint i) {
    bool cone = h.kind == 1u;
    bool end = i == 0u || i == 11u;
    uint ring = i < 6u ? 2u * i - 2u : 2u * i - 11u;
    uint k = end ? 0u : cone ? i - 1u : ring;
    float radius = end ? 0.0f : cone ? 1.0f : 0.89442719f;
    float level = i == 0u ? 1.0f : i == 11u ? -1.0f : i < 6u ? 0.44721360f : -0.44721360f;
    float c = cone ? (i == 0u ? 0.0f : 1.0f) : level;
    GN_PRECISE float a = radius * gn_ring_cos(k);
    GN_PRECISE float b = radius * gn_ring_sin(k);
    GN_PRECISE float x = ((h.origin.x + h.u.x * a) + h.v.x * b) + h.w.x * c;
    GN_PRECISE float y = ((h.origin.y + h.u.y * a) + h.v.y * b) + h.w.y * c;
    GN_PRECISE float z = ((h.origin.z + h.u.z * a) + h.v.z * b) + h.w.z * c;
    return vec3(x, y, z);
}

/// Corners of face f, 0 to 19, counter-clockwise from outside: three times four bits.
GN_PLAIN_FN uint gn_hull_face_corners(uint kind, uint f) {
    uint side = f < 10u ? f : f - 10u;
    uint next = side == 9u ? 1u : side + 2u;
    uint of_cone = f < 10u ? next << 4 | (side + 1u) << 8 : 11u | (side + 1u) << 4 | next << 8;
    uint s = f % 5u;
    uint upper = 1u + s;
    uint upper_next = s == 4u ? 1u : upper + 1u;
    uint lower = upper + 5u;
    uint lower_next = upper_next + 5u;
    uint top = upper << 4 | upper_next << 8;
    uint down = upper | lower << 4 | upper_next << 8;
    uint up = lower | lower_next << 4 | upper_next << 8;
    uint bottom = 11u | lower_next << 4 | lower << 8;
    uint of_ball = f < 5u ? top : f < 10u ? down : f < 15u ? up : bottom;
    return kind == 1u ? of_cone : of_ball;
}

/// The plane through the eye and two corners; `size`: the sizes of the terms of its coefficients.
struct GnHullEdge {
    vec3 normal;
    vec3 size;
};

GN_PLAIN_VEC_FN GnHullEdge gn_hull_edge(vec3 a, vec3 b) {
    GN_PRECISE float x = b.x - a.x;
    GN_PRECISE float y = b.y - a.y;
    GN_PRECISE float z = b.z - a.z;
    GN_PRECISE float yz = a.y * z;
    GN_PRECISE float zy = a.z * y;
    GN_PRECISE float zx = a.z * x;
    GN_PRECISE float xz = a.x * z;
    GN_PRECISE float xy = a.x * y;
    GN_PRECISE float yx = a.y * x;
    GN_PRECISE float normal_x = yz - zy;
    GN_PRECISE float normal_y = zx - xz;
    GN_PRECISE float normal_z = xy - yx;
    GN_PRECISE float size_x = abs(yz) + abs(zy);
    GN_PRECISE float size_y = abs(zx) + abs(xz);
    GN_PRECISE float size_z = abs(xy) + abs(yx);
    GnHullEdge e;
    e.normal = vec3(normal_x, normal_y, normal_z);
    e.size = vec3(size_x, size_y, size_z);
    return e;
}

// Kinds: 0 faces the eye or is not in front of it, 1 faces away, 2 edge-on as far as rounding can tell, so that its edges say nothing.
struct GnHullFace {
    vec3 a;
    vec3 b;
    vec3 c;
    GnHullEdge ab;
    GnHullEdge bc;
    GnHullEdge ca;
    uint kind;
};

GN_PLAIN_VEC_FN GnHullFace gn_hull_face(GN_IN(GnHull) hull, uint f, bool perspective) {
    uint corners = gn_hull_face_corners(hull.kind, f);
    GnHullFace face;
    face.a = gn_hull_corner(hull, corners & 15u);
    face.b = gn_hull_corner(hull, corners >> 4 & 15u);
    face.c = gn_hull_corner(hull, corners >> 8);
    if (!perspective) {
        face.a.z = 1.0f;
        face.b.z = 1.0f;
        face.c.z = 1.0f;
    }
    face.ab = gn_hull_edge(face.a, face.b);
    face.bc = gn_hull_edge(face.b, face.c);
    face.ca = gn_hull_edge(face.c, face.a);
    GN_PRECISE float x = face.c.x - face.a.x;
    GN_PRECISE float y = face.c.y - face.a.y;
    GN_PRECISE float z = face.c.z - face.a.z;
    GN_PRECISE float det = (face.ab.normal.x * x + face.ab.normal.y * y) + face.ab.normal.z * z;
    GN_PRECISE float size = (face.ab.size.x * abs(x) + face.ab.size.y * abs(y)) + face.ab.size.z * abs(z);
    GN_PRECISE float bound = size * 5.9604644775390625e-7f + 7.52316384526264e-37f;
    bool behind = face.a.z <= 0.0f && face.b.z <= 0.0f && face.c.z <= 0.0f;
    face.kind = det < -bound || behind ? 0u : det > bound ? 1u : 2u;
    return face;
}

/// Borders of a tile: x / depth and y / depth, or x and y.
struct GnTileWindow {
    float left;
    float right;
    float top;
    float bottom;
};

/// Whether some corner of the tile may be on the inner side of an edge. What is no number may.
GN_PLAIN_FN bool gn_may_be_within(GN_IN(GnHullEdge) e, GN_IN(GnTileWindow) t) {
    GN_PRECISE float at_left = e.normal.x * t.left;
    GN_PRECISE float at_right = e.normal.x * t.right;
    GN_PRECISE float at_top = e.normal.y * t.top;
    GN_PRECISE float at_bottom = e.normal.y * t.bottom;
    float x = at_left > at_right ? at_left : at_right;
    float y = at_top > at_bottom ? at_top : at_bottom;
    GN_PRECISE float value = (x + y) + e.normal.z;
    float widest = abs(t.left) > abs(t.right) ? abs(t.left) : abs(t.right);
    float highest = abs(t.top) > abs(t.bottom) ? abs(t.top) : abs(t.bottom);
    GN_PRECISE float size = (e.size.x * widest + e.size.y * highest) + e.size.z;
    GN_PRECISE float bound = size * -5.9604644775390625e-7f - 7.52316384526264e-37f;
    return !(value < bound);
}

/// Whether a face that does not face the eye may touch a tile between its bounds.
GN_PLAIN_FN bool gn_may_cover(GN_IN(GnHullFace) face, GN_IN(GnTileWindow) tile) {
    return face.kind == 2u || (gn_may_be_within(face.ab, tile) && gn_may_be_within(face.bc, tile) && gn_may_be_within(face.ca, tile));
}

/// Whether a corner in front of the eye lies surely beyond a border: x > at depth. Errs by 2.1 u of the terms.
GN_PLAIN_FN bool gn_is_beyond(float x, float depth, float at) {
    GN_PRECISE float there = at * depth;
    GN_PRECISE float off = x - there;
    GN_PRECISE float bound = (abs(x) + abs(there)) * 2.384185791015625e-7f + 7.52316384526264e-37f;
    return off > bound;
}

/// Whether a whole face lies surely right of a border between columns; `sign` -1 and the border's negative: left of it.
/// Where a corner is not in front of the eye nothing is sure.
GN_PLAIN_FN bool gn_is_face_right(GN_IN(GnHullFace) f, float at, float sign) {
    GN_PRECISE float a = f.a.x * sign;
    GN_PRECISE float b = f.b.x * sign;
    GN_PRECISE float c = f.c.x * sign;
    bool in_front = f.a.z > 0.0f && f.b.z > 0.0f && f.c.z > 0.0f;
    return in_front && gn_is_beyond(a, f.a.z, at) && gn_is_beyond(b, f.b.z, at) && gn_is_beyond(c, f.c.z, at);
}

/// The same of rows: below, or above.
GN_PLAIN_FN bool gn_is_face_below(GN_IN(GnHullFace) f, float at, float sign) {
    GN_PRECISE float a = f.a.y * sign;
    GN_PRECISE float b = f.b.y * sign;
    GN_PRECISE float c = f.c.y * sign;
    bool in_front = f.a.z > 0.0f && f.b.z > 0.0f && f.c.z > 0.0f;
    return in_front && gn_is_beyond(a, f.a.z, at) && gn_is_beyond(b, f.b.z, at) && gn_is_beyond(c, f.c.z, at);
}

GN_END

#endif  // GNOMON_LIGHTS_FORMULA_HULL_GLSL
