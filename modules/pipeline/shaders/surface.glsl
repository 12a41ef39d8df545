// A surface by triangle and image point: the GLSL half of src/lighting/surface_table.hpp. GNOMON_SET is the set of the
// buffers, from binding 0 on.

#include <gnomon/lights/formula/shade.glsl>
#include <gnomon/pipeline/formula/surface.glsl>

struct Material {
    float base_r, base_g, base_b;
    float metallic;
    float emissive_r, emissive_g, emissive_b;
    float shininess;
    float scale;
    uint first_texel;
    uint levels;
    int width, height;
    uint wrap_u, wrap_v;
    float opacity;
};

layout(std430, set = GNOMON_SET, binding = 0) readonly buffer Vertices { float vertices[]; };  // 8 of each
layout(std430, set = GNOMON_SET, binding = 1) readonly buffer Triangles { uvec4 triangles[]; };
layout(std430, set = GNOMON_SET, binding = 2) readonly buffer Materials { Material materials[]; };
layout(std430, set = GNOMON_SET, binding = 3) readonly buffer Texels { uint texels[]; };
layout(std430, set = GNOMON_SET, binding = 4) readonly buffer Rays {
    GnRayCamera camera;
    float pixel_m;
};

vec3 vec3_at(uint at) { return vec3(vertices[at], vertices[at + 1u], vertices[at + 2u]); }
vec2 vec2_at(uint at) { return vec2(vertices[at], vertices[at + 1u]); }

GnTriangle triangle_at(uvec3 corner) {
    uvec3 at = corner * 8u;
    GnTriangle t;
    t.a = vec3_at(at.x);
    t.b = vec3_at(at.y);
    t.c = vec3_at(at.z);
    t.normal_a = vec3_at(at.x + 3u);
    t.normal_b = vec3_at(at.y + 3u);
    t.normal_c = vec3_at(at.z + 3u);
    t.uv_a = vec2_at(at.x + 6u);
    t.uv_b = vec2_at(at.y + 6u);
    t.uv_c = vec2_at(at.z + 6u);
    return t;
}

/// Linear colour, and alpha from 0 to 255.
vec4 texel_at(uint at) {
    uint word = texels[at];
    return vec4(uintBitsToFloat(texels[word & 0xFFu]), uintBitsToFloat(texels[(word >> 8) & 0xFFu]),
                uintBitsToFloat(texels[(word >> 16) & 0xFFu]), float(word >> 24));
}

vec4 sample_level(Material m, uint level, vec2 uv) {
    uint first = m.first_texel;
    int width = m.width;
    int height = m.height;
    for (uint k = 0u; k < level; ++k) {
        first += uint(width) * uint(height);
        width = max(1, width / 2);
        height = max(1, height / 2);
    }
    GnTap u = gn_color_tap(uv.x, width, int(m.wrap_u));
    GnTap v = gn_color_tap(uv.y, height, int(m.wrap_v));
    uint upper = first + uint(v.first) * uint(width);
    uint lower = first + uint(v.second) * uint(width);
    vec4 c00 = texel_at(upper + uint(u.first));
    vec4 c10 = texel_at(upper + uint(u.second));
    vec4 c01 = texel_at(lower + uint(u.first));
    vec4 c11 = texel_at(lower + uint(u.second));
    vec2 weight = vec2(u.weight, v.weight);
    vec3 color = gn_bilinear(c00.xyz, c10.xyz, c01.xyz, c11.xyz, weight);
    vec3 alpha = gn_bilinear(c00.www, c10.www, c01.www, c11.www, weight);
    return vec4(color, alpha.x);
}

vec4 base_color_of(Material m, vec2 uv, float texels_per_pixel) {
    if (m.levels == 0u) return vec4(m.base_r, m.base_g, m.base_b, m.opacity);
    GnMip mip = gn_mip(texels_per_pixel, m.levels - 1u);
    vec4 fine = sample_level(m, mip.level, uv);
    vec4 coarse = fine;
    if (mip.blend > 0.0) coarse = sample_level(m, mip.level + 1u, uv);
    vec3 color = gn_blend(fine.xyz, coarse.xyz, mip.blend);
    vec3 alpha = gn_blend(fine.www, coarse.www, mip.blend);
    precise vec4 r;
    r.x = m.base_r * color.x;
    r.y = m.base_g * color.y;
    r.z = m.base_b * color.z;
    r.w = m.opacity * (alpha.x * 0.0039215686274509803);
    return r;
}

struct Shaded {
    GnSurface surface;
    vec3 emissive;
    float opacity;
};

Shaded surface_at(uint triangle, vec2 px) {
    uvec4 corner = triangles[triangle];
    GnTriangle t = triangle_at(corner.xyz);
    GnSurfacePoint at = gn_surface_point(camera, px, t);
    Material m = materials[corner.w];
    float density = gn_texels_per_pixel(camera, pixel_m, t, at, vec2(float(m.width), float(m.height)));
    vec4 base = base_color_of(m, at.uv, density);
    GnReflectance r = gn_reflectance(base.xyz, m.metallic, m.scale, vec3(m.emissive_r, m.emissive_g, m.emissive_b));
    Shaded s;
    s.surface.position = at.position;
    s.surface.normal = at.shading_normal;
    precise vec3 sight = camera.eye - at.position;
    s.surface.to_eye = camera.perspective != 0u ? gn_unit_or_up(sight) : -camera.forward;
    s.surface.diffuse = r.diffuse;
    s.surface.specular = r.specular;
    s.surface.shininess = m.shininess;
    s.emissive = r.emissive;
    s.opacity = base.w;
    return s;
}
