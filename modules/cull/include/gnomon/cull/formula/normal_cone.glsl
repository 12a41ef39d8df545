// Lights behind all surfaces of a cluster [Olsson 2014, Paper II, section 3.3, figure 7].
//
// A ball (center, radius) holds the cluster's samples, a cone (axis, alpha) their normals. With v from the centre to the
// light, D = |v|, omega between v and the axis and sin(delta) = radius / D, no normal of the cone looks at the light from
// any point of the ball if omega > pi/2 + alpha + delta. In cosines, times D, without an angle:
//
//     v.axis < -(sin(alpha) sqrt(D^2 - radius^2) + cos(alpha) radius)   and   alpha + delta < pi/2

#ifndef GNOMON_CULL_FORMULA_NORMAL_CONE_GLSL
#define GNOMON_CULL_FORMULA_NORMAL_CONE_GLSL

#include <gnomon/math/formula.glsl>
#include <gnomon/math/formula/separate.glsl>

GN_BEGIN

/// Cosine and sine of the half angle; the axis a unit vector to 2 e. A cosine of 0 or below holds too much to reject.
GN_STRUCT(GnNormalCone) {
    GN_VEC3 axis;
    GN_FLOAT cosine;
    GN_FLOAT sine;
};

/// Whether a light at `light` may light a surface of the cluster from its front.
///
/// v errs by e of itself, its product with the axis by 6 e D, the squares by 5 e of themselves. The tangent's length is
/// taken of squares moved by 16 e: once too long, for the first condition, once too short, for the second. What else is
/// rounded, and the cone's own numbers (2 e each), stays below 16 e (D + radius); `bound` is twice that.
GN_FN GN_BOOL gn_may_face(GN_IN(GN_TYPE(GnNormalCone)) cone, GN_IN(GN_TYPE(GnSphere)) cluster, GN_VEC3 light) {
    GN_FLOAT radius = cluster.radius;
    GN_PRECISE GN_VEC3 v = light - cluster.center;
    GN_FLOAT d_sq = gn_dot3(v, v);
    GN_PRECISE GN_FLOAT long_sq = d_sq * 1.00000095367431640625 - radius * radius * 0.99999904632568359375;
    GN_PRECISE GN_FLOAT short_sq = d_sq * 0.99999904632568359375 - radius * radius * 1.00000095367431640625;
    GN_PRECISE GN_FLOAT bound = 1.9073486328125e-6 * (gn_norm3(v) + radius);
    GN_PRECISE GN_FLOAT back = -(cone.sine * gn_sqrt(gn_max(long_sq, GN_FLOAT(0.0))) + cone.cosine * radius) - bound;
    GN_PRECISE GN_FLOAT narrow =
        cone.cosine * gn_sqrt(gn_max(short_sq, GN_FLOAT(0.0))) - (cone.sine * radius + bound);
    GN_BOOL outside = short_sq > 1e-30 && radius >= 0.0;  // nearer than 1e-15 m squares underflow
    return !(outside && cone.cosine > 0.0 && narrow > 0.0 && gn_dot3(v, cone.axis) < back);
}

/// The same for light that comes from one direction: `toward` is a unit vector to 2 e, toward the light.
GN_FN GN_BOOL gn_may_face_direction(GN_IN(GN_TYPE(GnNormalCone)) cone, GN_VEC3 toward) {
    GN_PRECISE GN_FLOAT back = -cone.sine - 1.9073486328125e-6;
    return !(cone.cosine > 0.0 && gn_dot3(toward, cone.axis) < back);
}

GN_END

#endif  // GNOMON_CULL_FORMULA_NORMAL_CONE_GLSL
