#include "surface_table.hpp"

#include <gnomon/lights/shade.hpp>
#include <gnomon/sample/reconstruct.hpp>

#include "../detail.hpp"
#include "../texture.hpp"

#include <algorithm>
#include <bit>
#include <cmath>

namespace gnomon::pipeline {

namespace {

/// The exponent 2^k of a roughness: Beckmann's 2 / alpha^2 - 2 with alpha = roughness^2.
float shininess_of(float roughness) noexcept {
    float const alpha = std::clamp(roughness, 0.05F, 1.0F) * std::clamp(roughness, 0.05F, 1.0F);
    float const exponent = std::fmax(2.0F / (alpha * alpha) - 2.0F, 1.0F);
    return std::clamp(std::round(std::log2(exponent)), 0.0F, 10.0F);
}

MaterialStd plain_material(scene::Material const& m) noexcept {
    float const shininess = shininess_of(m.roughness);
    return {{m.base_color.x, m.base_color.y, m.base_color.z},
            std::clamp(m.metallic, 0.0F, 1.0F),
            {m.emissive.x, m.emissive.y, m.emissive.z},
            shininess,
            lights::highlight_scale(static_cast<int>(shininess)),
            0,
            0,
            0,
            0,
            0,
            0,
            std::clamp(m.base_color.w, 0.0F, 1.0F)};
}

std::uint32_t word_of(std::uint8_t const* rgba) noexcept {
    return rgba[0] | std::uint32_t{rgba[1]} << 8U | std::uint32_t{rgba[2]} << 16U | std::uint32_t{rgba[3]} << 24U;
}

using Rgba = math::vec4;

/// A texel as formulas mix it: linear colour and alpha.
Rgba texel_at(std::span<std::uint32_t const> texels, std::size_t at) noexcept {
    std::uint32_t const word = texels[at];
    auto const linear = [&](unsigned shift) { return std::bit_cast<float>(texels[(word >> shift) & 0xFFU]); };
    return {linear(0), linear(8), linear(16), static_cast<float>(word >> 24U)};
}

formula::Vec3<float> rgb(Rgba const& c) noexcept { return {c.x, c.y, c.z}; }
formula::Vec3<float> alpha(Rgba const& c) noexcept { return {c.w, c.w, c.w}; }

/// One mip, bilinear.
Rgba sample_level(MaterialStd const& m, std::span<std::uint32_t const> texels, std::uint32_t level,
                  formula::Vec2<float> const& uv) noexcept {
    std::size_t first = m.first_texel;
    std::int32_t width = m.width;
    std::int32_t height = m.height;
    for (std::uint32_t k = 0; k < level; ++k) {
        first += static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
        width = std::max(1, width / 2);
        height = std::max(1, height / 2);
    }
    using Int = formula::Int<float>;
    auto const u = gn_color_tap(uv.x, Int(width), Int(static_cast<int>(m.wrap_u)));
    auto const v = gn_color_tap(uv.y, Int(height), Int(static_cast<int>(m.wrap_v)));
    auto const texel = [&](int x, int y) {
        return texel_at(texels, first + static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x));
    };
    Rgba const c00 = texel(u.first.v, v.first.v);
    Rgba const c10 = texel(u.second.v, v.first.v);
    Rgba const c01 = texel(u.first.v, v.second.v);
    Rgba const c11 = texel(u.second.v, v.second.v);
    formula::Vec2<float> const weight(u.weight, v.weight);
    auto const color = gn_bilinear(rgb(c00), rgb(c10), rgb(c01), rgb(c11), weight);
    auto const a = gn_bilinear(alpha(c00), alpha(c10), alpha(c01), alpha(c11), weight);
    return {color.x.v, color.y.v, color.z.v, a.x.v};
}

}  // namespace

MaterialTable::MaterialTable(scene::Scene const& scene, std::span<std::uint8_t const> seen) {
    texels.resize(decoded_codes);
    for (std::uint32_t code = 0; code < decoded_codes; ++code)
        texels[code] = std::bit_cast<std::uint32_t>(linear_from_srgb(static_cast<std::uint8_t>(code)));
    std::vector<std::size_t> made_of(scene.images.size(), ~std::size_t{0});  // Many materials share few images.
    for (std::size_t i = 0; i < scene.materials.size(); ++i) {
        scene::Material const& material = scene.materials[i];
        MaterialStd entry = plain_material(material);
        scene::Image const* const image = base_image(scene, material);
        if (image != nullptr && (seen.empty() || seen[i] != 0)) {
            scene::Texture const& texture = *base_texture(scene, material);
            MipChain const chain(*image);
            entry.levels = static_cast<std::uint32_t>(chain.levels());
            entry.width = image->size_px.x;
            entry.height = image->size_px.y;
            entry.wrap_u = static_cast<std::uint32_t>(texture.wrap_u);
            entry.wrap_v = static_cast<std::uint32_t>(texture.wrap_v);
            std::size_t& place = made_of[texture.image];
            if (place == ~std::size_t{0}) {
                place = texels.size();
                for (std::size_t level = 0; level < chain.levels(); ++level) {
                    std::span<std::uint8_t const> const rgba = chain.rgba(level);
                    for (std::size_t t = 0; t < rgba.size(); t += 4) texels.push_back(word_of(rgba.data() + t));
                }
            }
            entry.first_texel = static_cast<std::uint32_t>(place);
        }
        materials.push_back(entry);
    }
}

VertexStd vertex_of(scene::Geometry const& g, std::uint32_t v) noexcept {
    math::vec3 const p = g.positions[v];
    math::vec3 const n = v < g.normals.size() ? g.normals[v] : math::vec3(0.0F);
    math::vec2 const uv = v < g.uv.size() ? g.uv[v] : math::vec2(0.0F);
    return {{p.x, p.y, p.z}, {n.x, n.y, n.z}, {uv.x, uv.y}};
}

std::vector<VertexStd> make_vertices(scene::Geometry const& g) {
    std::vector<VertexStd> vertices;
    vertices.reserve(g.positions.size());
    for (std::uint32_t v = 0; v < g.positions.size(); ++v) vertices.push_back(vertex_of(g, v));
    return vertices;
}

std::vector<TriangleStd> make_triangles(scene::Geometry const& g) {
    std::vector<TriangleStd> triangles;
    triangles.reserve(g.indices.size() / 3);
    for (std::size_t i = 0; i + 2 < g.indices.size(); i += 3)
        triangles.push_back({{g.indices[i], g.indices[i + 1], g.indices[i + 2]}, g.triangle_material[i / 3]});
    return triangles;
}

formula::GnTriangle<float> triangle_of(VertexStd const& a, VertexStd const& b, VertexStd const& c) noexcept {
    using Vec3 = formula::Vec3<float>;
    using Vec2 = formula::Vec2<float>;
    auto const three = [](float const(&v)[3]) { return Vec3(v[0], v[1], v[2]); };
    return {three(a.position),       three(b.position),       three(c.position),
            three(a.normal),         three(b.normal),         three(c.normal),
            Vec2(a.uv[0], a.uv[1]), Vec2(b.uv[0], b.uv[1]), Vec2(c.uv[0], c.uv[1])};
}

formula::GnTriangle<float> triangle_of(scene::Geometry const& g, std::uint32_t triangle) noexcept {
    std::uint32_t const* const corner = g.indices.data() + std::size_t{triangle} * 3;
    return triangle_of(vertex_of(g, corner[0]), vertex_of(g, corner[1]), vertex_of(g, corner[2]));
}

formula::Vec2<float> size_of(MaterialStd const& m) noexcept {
    return {static_cast<float>(m.width), static_cast<float>(m.height)};
}

math::vec4 base_color_of(MaterialStd const& m, std::span<std::uint32_t const> texels, formula::Vec2<float> const& uv,
                         formula::Float<float> texels_per_pixel) noexcept {
    if (m.levels == 0) return {m.base[0], m.base[1], m.base[2], m.opacity};
    auto const mip = gn_mip(texels_per_pixel, formula::Uint<float>(m.levels - 1));
    Rgba const fine = sample_level(m, texels, mip.level.v, uv);
    Rgba const coarse = mip.blend.v > 0.0F ? sample_level(m, texels, mip.level.v + 1, uv) : fine;
    auto const color = gn_blend(rgb(fine), rgb(coarse), mip.blend);
    auto const a = gn_blend(alpha(fine), alpha(coarse), mip.blend);
    return {m.base[0] * color.x.v, m.base[1] * color.y.v, m.base[2] * color.z.v, m.opacity * (a.x.v * (1.0F / 255.0F))};
}

CameraRays make_camera_rays(math::View const& view, math::dvec3 const& origin_m) noexcept {
    math::dvec2 const pixel = math::pixel_size_m(view, 1.0);
    return {sample::make_ray_camera(view, origin_m), static_cast<float>(std::fmax(pixel.x, pixel.y))};
}

SurfaceStd SurfaceData::at(std::uint32_t triangle, math::vec2 const& px) const noexcept {
    TriangleStd const& corners = triangles[triangle];
    auto const t = triangle_of(vertices[corners.corner[0]], vertices[corners.corner[1]], vertices[corners.corner[2]]);
    auto const point = gn_surface_point(rays.camera, formula::Vec2<float>(px), t);
    MaterialStd const& m = materials[corners.material];
    using Float = formula::Float<float>;
    auto const density = gn_texels_per_pixel(rays.camera, rays.pixel_m, t, point, size_of(m));
    math::vec4 const base = base_color_of(m, texels, point.uv, density);
    auto const r = gn_reflectance(rgb(base), Float(m.metallic), Float(m.scale),
                                  formula::Vec3<float>(m.emissive[0], m.emissive[1], m.emissive[2]));
    return {math::vec3(point.position), math::vec3(point.shading_normal), math::vec3(r.diffuse), math::vec3(r.specular),
            math::vec3(r.emissive),     m.shininess,                      base.w};
}

}  // namespace gnomon::pipeline
