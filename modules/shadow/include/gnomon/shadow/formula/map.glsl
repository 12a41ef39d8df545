// What a lookup must know of a shadow map and of its bias, as C++ and a storage buffer (std430) both lay it out.

#ifndef GNOMON_SHADOW_FORMULA_MAP_GLSL
#define GNOMON_SHADOW_FORMULA_MAP_GLSL

#include <gnomon/math/formula.glsl>

GN_BEGIN

struct GnShadowMap {
    mat4 clip_from_relative;
    vec3 eye;  // work space, metres
    float near_m;
    vec3 right;
    float depth_scale;  // depth = scale * d + offset (orthographic) or scale + offset / d (perspective)
    vec3 up;
    float depth_offset;
    vec3 back;
    float half_code;  // half a step of the stored format, in depth: 0 for float
    vec2 texel;       // metres: anywhere (orthographic) or at one metre along the axis (perspective)
    vec2 size_px;
    uint perspective;  // 0 or 1
    uint reversed;
    uint unused_a;
    uint unused_b;
};

struct GnShadowConfig {
    int taps;             // 1 to 15 each way
    uint automatic;       // 0 or 1: add the bias that the map's own errors need
    uint receiver_plane;  // 0 or 1: compare each tap with the receiver's plane under it
    uint in_texels;       // 1: constant and normal_offset are times the texel's world size; 0: metres
    float constant;
    float slope;
    float normal_offset;
    float max_tan;
};

GN_END

#endif  // GNOMON_SHADOW_FORMULA_MAP_GLSL
