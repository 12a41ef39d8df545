// What a pixel shows of a triangle: position, normals, texture coordinates, and the mip that suits them. In float, with the
// same bits in C++ and GLSL, so that a fragment shader and a G-buffer made by the host agree.
//
// Weights of the corners come from areas, w_b = ((p - a) x (c - a)) . n / n . n; a mip from the geometric mean of the
// pixel's footprint and its stretched side, sqrt(pixel^2 / cosine), times the triangle's texels per metre. Between powers
// of two the mip is blended linearly in texels, as most GPUs do, so that no logarithm is taken.

#ifndef GNOMON_PIPELINE_FORMULA_SURFACE_GLSL
#define GNOMON_PIPELINE_FORMULA_SURFACE_GLSL

#include <gnomon/math/formula.glsl>
#include <gnomon/math/formula/view.glsl>
#include <gnomon/sample/formula/reconstruct.glsl>
#include <gnomon/trace/formula/mask.glsl>

GN_BEGIN

/// A triangle's corners in work space; normals are zeros where there are none.
GN_STRUCT(GnTriangle) {
    GN_VEC3 a;
    GN_VEC3 b;
    GN_VEC3 c;
    GN_VEC3 normal_a;
    GN_VEC3 normal_b;
    GN_VEC3 normal_c;
    GN_VEC2 uv_a;
    GN_VEC2 uv_b;
    GN_VEC2 uv_c;
};

GN_STRUCT(GnSurfacePoint) {
    GN_VEC3 position;
    GN_VEC3 normal;          // unit, of the plane, toward the eye
    GN_VEC3 shading_normal;  // unit, interpolated, on the eye's side
    GN_VEC2 uv;
};

GN_FN GN_VEC3 gn_cross(GN_VEC3 u, GN_VEC3 v) {
    GN_PRECISE GN_VEC3 r;
    r.x = u.y * v.z - u.z * v.y;
    r.y = u.z * v.x - u.x * v.z;
    r.z = u.x * v.y - u.y * v.x;
    return r;
}

GN_FN GN_VEC3 gn_select3(GN_BOOL mask, GN_VEC3 yes, GN_VEC3 no) {
    return GN_VEC3(GN_SELECT(mask, yes.x, no.x), GN_SELECT(mask, yes.y, no.y), GN_SELECT(mask, yes.z, no.z));
}

GN_FN GN_VEC3 gn_unit_or(GN_VEC3 v, GN_VEC3 fallback) {
    GN_FLOAT square = gn_dot(v, v);
    GN_BOOL usable = square > 1e-30 && square < 1e30;
    GN_FLOAT inverse = gn_div(GN_FLOAT(1.0), gn_sqrt(GN_SELECT(usable, square, GN_FLOAT(1.0))));
    GN_PRECISE GN_VEC3 u = v * inverse;
    return gn_select3(usable, u, fallback);
}

/// From a surface at `position` to the eye, or toward it.
GN_FN GN_VEC3 gn_sight(GN_IN(GnRayCamera) camera, GN_VEC3 position) {
    GN_PRECISE GN_VEC3 to_eye = GN_VEC3(camera.eye) - position;
    return camera.perspective != 0u ? to_eye : -GN_VEC3(camera.forward);
}

/// The triangle at image point `px`.
GN_FN GN_TYPE(GnSurfacePoint) gn_surface_point(GN_IN(GnRayCamera) camera, GN_VEC2 px, GN_IN(GN_TYPE(GnTriangle)) t) {
    GN_TYPE(GnReconstructed) made = gn_reconstruct(camera, px, t.a, t.b, t.c);
    GN_TYPE(GnSurfacePoint) r;
    r.position = made.position;
    GN_PRECISE GN_VEC3 u = t.b - t.a;
    GN_PRECISE GN_VEC3 v = t.c - t.a;
    GN_PRECISE GN_VEC3 w = made.position - t.a;
    GN_VEC3 n = gn_cross(u, v);
    GN_VEC3 sight = gn_sight(camera, t.a);
    GN_VEC3 toward = gn_select3(gn_dot(n, sight) < 0.0, -n, n);
    r.normal = gn_unit_or(toward, gn_unit_or(sight, GN_VEC3(0.0, 1.0, 0.0)));
    GN_FLOAT area = gn_dot(n, n);
    GN_BOOL usable = area > 1e-30;
    GN_FLOAT safe_area = GN_SELECT(usable, area, GN_FLOAT(1.0));
    GN_FLOAT weight_b = GN_SELECT(usable, gn_div(gn_dot(gn_cross(w, v), n), safe_area), GN_FLOAT(0.0));
    GN_FLOAT weight_c = GN_SELECT(usable, gn_div(gn_dot(gn_cross(u, w), n), safe_area), GN_FLOAT(0.0));
    GN_PRECISE GN_FLOAT weight_a = (1.0 - weight_b) - weight_c;
    GN_PRECISE GN_VEC3 mixed = (t.normal_a * weight_a + t.normal_b * weight_b) + t.normal_c * weight_c;
    GN_VEC3 outward = gn_select3(gn_dot(mixed, r.normal) < 0.0, -mixed, mixed);
    r.shading_normal = gn_unit_or(outward, r.normal);
    GN_PRECISE GN_VEC2 uv = (t.uv_a * weight_a + t.uv_b * weight_b) + t.uv_c * weight_c;
    r.uv = uv;
    return r;
}

/// Texels of mip 0 that a pixel is wide, for a texture of `size`. `pixel_m` is the pixel's width at 1 m, or at
/// any distance of an orthographic view.
GN_FN GN_FLOAT gn_texels_per_pixel(GN_IN(GnRayCamera) camera, float pixel_m, GN_IN(GN_TYPE(GnTriangle)) t,
                                   GN_IN(GN_TYPE(GnSurfacePoint)) at, GN_VEC2 size) {
    GN_VEC3 sight = gn_sight(camera, at.position);
    GN_FLOAT distance_m = gn_max(gn_sqrt(gn_dot(sight, sight)), GN_FLOAT(1e-6));
    GN_PRECISE GN_VEC3 to_eye = sight * gn_div(GN_FLOAT(1.0), distance_m);
    GN_FLOAT cosine = gn_max(abs(gn_dot(at.normal, to_eye)), GN_FLOAT(0.05));
    GN_PRECISE GN_FLOAT width_m = pixel_m * (camera.perspective != 0u ? distance_m : GN_FLOAT(1.0));
    GN_FLOAT footprint_m = gn_div(width_m, gn_sqrt(cosine));
    GN_PRECISE GN_VEC3 u = t.b - t.a;
    GN_PRECISE GN_VEC3 v = t.c - t.a;
    GN_VEC3 n = gn_cross(u, v);
    GN_FLOAT area = gn_sqrt(gn_dot(n, n));
    GN_PRECISE GN_VEC2 p = t.uv_b - t.uv_a;
    GN_PRECISE GN_VEC2 q = t.uv_c - t.uv_a;
    GN_PRECISE GN_FLOAT uv_area = p.x * q.y - p.y * q.x;
    GN_PRECISE GN_FLOAT texels = (abs(uv_area) * size.x) * size.y;
    GN_BOOL usable = area > 0.0;
    GN_FLOAT density = gn_sqrt(gn_div(texels, GN_SELECT(usable, area, GN_FLOAT(1.0))));
    GN_PRECISE GN_FLOAT result = GN_SELECT(usable, density, GN_FLOAT(0.0)) * footprint_m;
    return result;
}

/// The finer of two mips, and the weight of the next.
GN_STRUCT(GnMip) {
    GN_UINT level;
    GN_FLOAT blend;
};

/// t texels a pixel: mip e and t / 2^e - 1 of the next, with 2^e <= t < 2^(e + 1); mip 0 below 1 and for NaN.
GN_FN GN_TYPE(GnMip) gn_mip(GN_FLOAT texels_per_pixel, GN_UINT last) {
    GN_UINT bits = floatBitsToUint(texels_per_pixel);
    GN_BOOL coarser = texels_per_pixel > 1.0;
    GN_UINT power = GN_SELECT(coarser, ((bits >> 23) & 0xFFu) - 127u, GN_UINT(0u));
    GN_PRECISE GN_FLOAT share = GN_FLOAT(bits & 0x7FFFFFu) * 1.1920928955078125e-7;
    GN_TYPE(GnMip) mip;
    mip.level = gn_min(power, last);
    mip.blend = GN_SELECT(coarser && power < last, share, GN_FLOAT(0.0));
    return mip;
}

/// A tap at any coordinate: far ones, infinite ones and NaN are drawn near.
GN_FN GN_TYPE(GnTap) gn_color_tap(GN_FLOAT coordinate, GN_INT size, GN_INT wrap) {
    GN_FLOAT limited = gn_max(GN_FLOAT(-1048576.0), gn_min(GN_FLOAT(1048576.0), coordinate));
    return gn_tap(GN_VEC2(limited, GN_FLOAT(0.0)), size, wrap);
}

/// Four texels around a point: first and second in x of the first row, then of the second.
GN_FN GN_VEC3 gn_bilinear(GN_VEC3 c00, GN_VEC3 c10, GN_VEC3 c01, GN_VEC3 c11, GN_VEC2 weight) {
    GN_PRECISE GN_FLOAT left = 1.0 - weight.x;
    GN_PRECISE GN_FLOAT top = 1.0 - weight.y;
    GN_PRECISE GN_VEC3 upper = c00 * left + c10 * weight.x;
    GN_PRECISE GN_VEC3 lower = c01 * left + c11 * weight.x;
    GN_PRECISE GN_VEC3 r = upper * top + lower * weight.y;
    return r;
}

GN_FN GN_VEC3 gn_blend(GN_VEC3 a, GN_VEC3 b, GN_FLOAT share_of_b) {
    GN_PRECISE GN_FLOAT share_of_a = 1.0 - share_of_b;
    GN_PRECISE GN_VEC3 r = a * share_of_a + b * share_of_b;
    return r;
}

/// What lights see of a base colour: glTF's metallic workflow over Blinn-Phong; no light adds `emissive`, of which a
/// hundredth of the base colour is ambience. `scale` is lights::highlight_scale.
GN_STRUCT(GnReflectance) {
    GN_VEC3 diffuse;
    GN_VEC3 specular;
    GN_VEC3 emissive;
};

GN_FN GN_TYPE(GnReflectance) gn_reflectance(GN_VEC3 base, GN_FLOAT metallic, GN_FLOAT scale, GN_VEC3 emissive) {
    GN_VEC3 dielectric = GN_VEC3(0.04, 0.04, 0.04);
    GN_PRECISE GN_FLOAT rest = 1.0 - metallic;
    GN_TYPE(GnReflectance) r;
    GN_PRECISE GN_VEC3 diffuse = base * rest;
    GN_PRECISE GN_VEC3 specular = (dielectric + (base - dielectric) * metallic) * scale;
    GN_PRECISE GN_VEC3 emitted = emissive + base * 0.01;
    r.diffuse = diffuse;
    r.specular = specular;
    r.emissive = emitted;
    return r;
}

GN_END

#endif  // GNOMON_PIPELINE_FORMULA_SURFACE_GLSL
