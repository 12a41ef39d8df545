// Where a pixel's ray meets its triangle's plane, in float, with a bound of the error: view samples as a GPU makes them.
//
// sample::make_view_sample is the definition; it works in double and decides sides exactly. With e = 2^-24, and M the sum
// of the absolute products of a component of the normal (ab x ac, so |n| <= M and its error is at most 4 e M):
//
//     across = corner + x dx + y dy                 error r = 4 e (|corner| + |x dx| + |y dy|)
//     t = n.(a - eye - start) / n.step
//     error of the numerator    sum M (10 e (|a - eye| + |start|) + r_start + e |eye|)     = N
//     error of the denominator  sum M (8 e |step| + r_step)                                = D
//     error of t                (N + |t| D) / (|n.step| - D) + e |t|                       = T
//     error of the position     |step| T + (|t| + T) r_step + r_start + 3 e (|eye| + |start| + |step t|)
//
// Constants are rounded up by a hundredth for terms of second order and for the bound's own rounding.
//
// expects: differences of coordinates between 1e-9 and 1e9 or zero, so that no product leaves the normal numbers.

#ifndef GNOMON_SAMPLE_FORMULA_RECONSTRUCT_GLSL
#define GNOMON_SAMPLE_FORMULA_RECONSTRUCT_GLSL

#include <gnomon/math/formula.glsl>
#include <gnomon/math/formula/view.glsl>

GN_BEGIN

/// A camera's rays; see sample::make_ray_camera. The same layout in C++ and, by std430, in a storage buffer.
struct GnRayCamera {
    vec3 eye;          // work space
    uint perspective;  // 0 or 1
    vec3 corner;       // from the eye to image point (0, 0): at 1 m along the axis of sight, or in the eye's plane
    uint unused_a;
    vec3 dx;  // a pixel to the right
    uint unused_b;
    vec3 dy;  // a pixel down
    uint unused_c;
    vec3 forward;
    uint unused_d;
};

GN_STRUCT(GnReconstructed) {
    GN_VEC3 position;
    GN_VEC3 error;          // of each coordinate against the plane's exact crossing with the ray, metres
    GN_VEC3 normal;         // unit length, of the counter-clockwise side
    GN_FLOAT normal_error;  // length of the difference to the exact one
    GN_BOOL usable;         // otherwise the plane is edge on, as far as float can tell, or there is none
};

GN_FN GN_VEC3 gn_abs(GN_VEC3 v) { return GN_VEC3(abs(v.x), abs(v.y), abs(v.z)); }

GN_FN GN_FLOAT gn_limited(GN_FLOAT p, GN_FLOAT a, GN_FLOAT b, GN_FLOAT c) {
    return gn_min(gn_max(p, gn_min(gn_min(a, b), c)), gn_max(gn_max(a, b), c));
}

/// The normal, not of unit length, in the plain order of products; `magnitude` is M.
GN_STRUCT(GnNormal) {
    GN_VEC3 n;
    GN_VEC3 magnitude;
};

GN_FN GN_TYPE(GnNormal) gn_normal_of(GN_VEC3 a, GN_VEC3 b, GN_VEC3 c) {
    GN_PRECISE GN_VEC3 u = b - a;
    GN_PRECISE GN_VEC3 v = c - a;
    GN_PRECISE GN_TYPE(GnNormal) r;
    r.n.x = u.y * v.z - u.z * v.y;
    r.n.y = u.z * v.x - u.x * v.z;
    r.n.z = u.x * v.y - u.y * v.x;
    r.magnitude.x = abs(u.y * v.z) + abs(u.z * v.y);
    r.magnitude.y = abs(u.z * v.x) + abs(u.x * v.z);
    r.magnitude.z = abs(u.x * v.y) + abs(u.y * v.x);
    return r;
}

/// The sample of image point (x, y) in pixels, on the plane of triangle abc, within the triangle's bounds.
GN_FN GN_TYPE(GnReconstructed) gn_reconstruct(GN_IN(GnRayCamera) camera, GN_VEC2 px, GN_VEC3 a, GN_VEC3 b, GN_VEC3 c) {
    bool perspective = camera.perspective != 0u;
    GN_VEC3 eye = GN_VEC3(camera.eye);
    GN_VEC3 forward = GN_VEC3(camera.forward);
    GN_VEC3 none = GN_VEC3(0.0, 0.0, 0.0);
    GN_TYPE(GnNormal) plane = gn_normal_of(a, b, c);
    GN_VEC3 m = plane.magnitude;

    GN_PRECISE GN_VEC3 by_x = GN_VEC3(camera.dx) * px.x;
    GN_PRECISE GN_VEC3 by_y = GN_VEC3(camera.dy) * px.y;
    GN_PRECISE GN_VEC3 across = (GN_VEC3(camera.corner) + by_x) + by_y;
    GN_PRECISE GN_VEC3 r = (gn_abs(GN_VEC3(camera.corner)) + gn_abs(by_x) + gn_abs(by_y)) * 2.41e-7;  // 4 e
    GN_VEC3 start = perspective ? none : across;
    GN_VEC3 step_m = perspective ? across : forward;
    GN_PRECISE GN_VEC3 r_forward = gn_abs(forward) * 6.02e-8;
    GN_VEC3 r_start = perspective ? none : r;
    GN_VEC3 r_step = perspective ? r : r_forward;

    GN_PRECISE GN_VEC3 from_eye = a - eye;
    GN_PRECISE GN_VEC3 from_start = from_eye - start;
    GN_FLOAT above = gn_dot(plane.n, from_start);
    GN_FLOAT below = gn_dot(plane.n, step_m);
    GN_PRECISE GN_VEC3 above_errors = (gn_abs(from_eye) + gn_abs(start)) * 6.02e-7 + r_start + gn_abs(eye) * 6.02e-8;
    GN_PRECISE GN_VEC3 below_errors = gn_abs(step_m) * 4.82e-7 + r_step;
    GN_FLOAT above_error = gn_dot(m, above_errors);
    GN_FLOAT below_error = gn_dot(m, below_errors);
    GN_PRECISE GN_FLOAT below_least = abs(below) - below_error * 1.01;

    GN_PRECISE GN_TYPE(GnReconstructed) made;
    made.usable = below_least > 0.0;
    GN_FLOAT t = gn_div(above, GN_SELECT(made.usable, below, 1.0));
    GN_PRECISE GN_FLOAT t_above = (above_error + abs(t) * below_error) * 1.01;
    GN_PRECISE GN_FLOAT t_error = gn_div(t_above, GN_SELECT(made.usable, below_least, 1.0)) + abs(t) * 6.02e-8;
    GN_PRECISE GN_VEC3 along = step_m * t;
    GN_PRECISE GN_VEC3 p = eye + (start + along);
    made.position = GN_VEC3(gn_limited(p.x, a.x, b.x, c.x), gn_limited(p.y, a.y, b.y, c.y), gn_limited(p.z, a.z, b.z, c.z));
    made.error = (gn_abs(step_m) * t_error + r_step * (abs(t) + t_error) + r_start +
                  (gn_abs(eye) + gn_abs(start) + gn_abs(along)) * 1.81e-7) * 1.01;

    GN_FLOAT length_m = gn_sqrt(gn_dot(plane.n, plane.n));
    GN_FLOAT inverse = gn_div(1.0, GN_SELECT(length_m > 0.0, length_m, 1.0));
    made.normal = plane.n * inverse;
    // 4 e M turns it by at most twice that over its length; the root, the quotient and the product round.
    made.normal_error = gn_sqrt(gn_dot(m, m)) * inverse * 4.82e-7 + 3.6e-7;
    return made;
}

GN_END

#endif  // GNOMON_SAMPLE_FORMULA_RECONSTRUCT_GLSL
