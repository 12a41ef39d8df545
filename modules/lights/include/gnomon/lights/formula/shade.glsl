// What one light gives to one surface: Lambert and Blinn-Phong under a window that ends at the light's range.
//
//     to = light - p,  d = |to|,  l = to / d,  h = (l + e) / |l + e|,  q = d^2 / range^2
//     window   = max(0, 1 - q^2)                                0 at the range and beyond, exactly
//     cone     = clamp((l . -axis - cos_outer) / (cos_inner - cos_outer), 0, 1)^2
//     strength = window cone max(0, n . l) / d^2
//     radiance = color strength (diffuse + specular (m + 8) / 8 max(0, n . h)^m),  m = 2^shininess
//
// Only sums, products and correctly rounded quotients and roots: the same bits on every machine, but for results below
// the normal numbers. What a light beyond its range adds is +0: however many such lights a list holds, and whichever
// technique made it, the sum of an ascending list is the same to the bit.
//
// source: [Olsson 2014, Paper I, 8]: "a fairly ordinary Blinn-Phong model"; glTF KHR_lights_punctual for window and cone

#ifndef GNOMON_LIGHTS_FORMULA_SHADE_GLSL
#define GNOMON_LIGHTS_FORMULA_SHADE_GLSL

#include <gnomon/math/formula.glsl>
#include <gnomon/math/formula/view.glsl>

GN_BEGIN

/// A light as shading reads it; see lights::make_shaded_point and its like. 64 bytes, by std430 too.
struct GnShadedLight {
    vec3 position;           // in the space of the surfaces; directional: toward the light, of length 1
    float inverse_range_sq;  // 0: no end
    vec3 color;              // linear, times the intensity
    float cos_outer;         // -2: no cone
    vec3 axis;               // where a spot shines, of length 1
    float inverse_span;      // 1 / (cos_inner - cos_outer)
    uint directional;        // 0 or 1
    uint unused_a;
    uint unused_b;
    uint unused_c;
};

/// A surface, ready for any number of lights.
GN_STRUCT(GnSurface) {
    GN_VEC3 position;
    GN_VEC3 normal;      // of length 1
    GN_VEC3 to_eye;      // of length 1
    GN_VEC3 diffuse;
    GN_VEC3 specular;    // times (m + 8) / 8 already
    GN_FLOAT shininess;  // a whole number from 0 to 10
};

/// v over its length; of a shorter one than 1e-16 the way up, so that nothing is NaN.
GN_FN GN_VEC3 gn_unit_or_up(GN_VEC3 v) {
    GN_FLOAT square = gn_dot(v, v);
    GN_BOOL none = !(square > 1e-32);
    GN_FLOAT inverse = gn_div(GN_FLOAT(1.0), gn_sqrt(GN_SELECT(none, GN_FLOAT(1.0), square)));
    GN_PRECISE GN_VEC3 u = v * inverse;
    return GN_VEC3(GN_SELECT(none, GN_FLOAT(0.0), u.x), GN_SELECT(none, GN_FLOAT(1.0), u.y), GN_SELECT(none, GN_FLOAT(0.0), u.z));
}

/// x to the power of 2^shininess, by squaring.
GN_FN GN_FLOAT gn_gloss(GN_FLOAT x, GN_FLOAT shininess) {
    GN_FLOAT power = x;
    for (int i = 0; i < 10; ++i) {
        GN_PRECISE GN_FLOAT squared = power * power;
        power = GN_SELECT(shininess > GN_FLOAT(i), squared, power);
    }
    return power;
}

/// A light seen from a surface.
GN_STRUCT(GnSeenLight) {
    GN_VEC3 to_light;   // of length 1
    GN_FLOAT strength;  // of the light before the surface's angle; 0 beyond range and cone
    GN_BOOL within;     // the range, whatever the cone
};

GN_FN GN_TYPE(GnSeenLight) gn_see_light(GN_IN(GnShadedLight) light, GN_VEC3 position) {
    GN_VEC3 target = GN_VEC3(light.position);
    bool directional = light.directional != 0u;
    GN_PRECISE GN_VEC3 way = target - position;
    GN_FLOAT dot_way = gn_dot(way, way);
    GN_FLOAT square = gn_max(dot_way, GN_FLOAT(1e-8));
    GN_FLOAT inverse = gn_div(GN_FLOAT(1.0), gn_sqrt(square));
    GN_PRECISE GN_FLOAT q = square * light.inverse_range_sq;
    GN_PRECISE GN_FLOAT window = 1.0 - q * q;
    GN_PRECISE GN_VEC3 to = way * inverse;
    GN_PRECISE GN_FLOAT strength = gn_max(window, GN_FLOAT(0.0)) * (inverse * inverse);
    GN_FLOAT cosine = -gn_dot(GN_VEC3(light.axis), to);
    GN_PRECISE GN_FLOAT edge = (cosine - light.cos_outer) * light.inverse_span;
    GN_FLOAT inside = gn_min(gn_max(edge, GN_FLOAT(0.0)), GN_FLOAT(1.0));
    GN_PRECISE GN_FLOAT in_cone = strength * (inside * inside);
    GN_TYPE(GnSeenLight) r;
    r.to_light.x = directional ? target.x : to.x;
    r.to_light.y = directional ? target.y : to.y;
    r.to_light.z = directional ? target.z : to.z;
    r.strength = directional ? GN_FLOAT(1.0) : GN_SELECT(q < 1.0, in_cone, GN_FLOAT(0.0));
    r.within = q < 1.0 || directional;
    return r;
}

/// Whether the far side of the light's ball is not in front of the position, seen from the eye: the sample is in the ball,
/// or the ball lies behind it on its ray.
///
///     w = p - c:  |w| < r   or   v . w < 0 and |w|^2 - (v . w)^2 < r^2,  v of length 1 from the eye through p
GN_FN GN_BOOL gn_covered(GN_IN(GnShadedLight) light, GN_VEC3 position, GN_VEC3 to_eye) {
    GN_PRECISE GN_VEC3 way = GN_VEC3(light.position) - position;
    GN_FLOAT square = gn_dot(way, way);
    GN_FLOAT along = gn_dot(way, to_eye);
    GN_PRECISE GN_FLOAT off = (square - along * along) * light.inverse_range_sq;
    GN_PRECISE GN_FLOAT q = square * light.inverse_range_sq;
    return q < 1.0 || (along < 0.0 && off < 1.0) || GN_BOOL(light.directional != 0u);
}

/// What the light adds to the surface's radiance toward the eye.
GN_FN GN_VEC3 gn_shade(GN_IN(GnShadedLight) light, GN_IN(GN_TYPE(GnSurface)) surface) {
    GN_TYPE(GnSeenLight) seen = gn_see_light(light, surface.position);
    GN_FLOAT facing = gn_max(gn_dot(surface.normal, seen.to_light), GN_FLOAT(0.0));
    GN_PRECISE GN_FLOAT strength = seen.strength * facing;
    GN_PRECISE GN_VEC3 between = seen.to_light + surface.to_eye;
    GN_FLOAT facing_half = gn_max(gn_dot(surface.normal, gn_unit_or_up(between)), GN_FLOAT(0.0));
    GN_FLOAT gloss = gn_gloss(gn_min(facing_half, GN_FLOAT(1.0)), surface.shininess);
    GN_PRECISE GN_VEC3 reflected = surface.diffuse + surface.specular * gloss;
    GN_PRECISE GN_VEC3 radiance;
    radiance.x = (light.color.x * strength) * reflected.x;
    radiance.y = (light.color.y * strength) * reflected.y;
    radiance.z = (light.color.z * strength) * reflected.z;
    return radiance;
}

GN_END

#endif  // GNOMON_LIGHTS_FORMULA_SHADE_GLSL
