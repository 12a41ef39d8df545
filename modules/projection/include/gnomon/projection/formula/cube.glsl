// Which of a point light's six faces sees a direction.

#ifndef GNOMON_PROJECTION_FORMULA_CUBE_GLSL
#define GNOMON_PROJECTION_FORMULA_CUBE_GLSL

#include <gnomon/math/formula.glsl>

GN_BEGIN

/// 0 to 5: +x -x +y -y +z -z, of the largest component; x before y before z, a zero of either sign as positive.
GN_FN GN_UINT gn_face_of(GN_VEC3 direction) {
    GN_FLOAT x = abs(direction.x);
    GN_FLOAT y = abs(direction.y);
    GN_FLOAT z = abs(direction.z);
    GN_BOOL is_x = x >= y && x >= z;
    GN_BOOL is_y = y >= z;
    GN_FLOAT major = GN_SELECT(is_x, direction.x, GN_SELECT(is_y, direction.y, direction.z));
    GN_UINT axis = GN_SELECT(is_x, 0u, GN_SELECT(is_y, 2u, 4u));
    return axis + GN_SELECT(major < 0.0, 1u, 0u);
}

GN_END

#endif  // GNOMON_PROJECTION_FORMULA_CUBE_GLSL
