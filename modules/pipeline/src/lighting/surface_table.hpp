#pragma once
// Geometry, materials and textures as formula/surface.glsl reads them, on the host and laid out by std430 for kernels.

#include <gnomon/math/vec.hpp>
#include <gnomon/math/view.hpp>
#include <gnomon/pipeline/formula/surface.glsl>
#include <gnomon/scene/flatten.hpp>
#include <gnomon/scene/scene.hpp>

#include <cstdint>
#include <span>
#include <vector>

namespace gnomon::pipeline {

/// A vertex: zeros where the geometry has no normals or no coordinates.
struct VertexStd {
    float position[3];
    float normal[3];
    float uv[2];
};
static_assert(sizeof(VertexStd) == 32);

struct TriangleStd {
    std::uint32_t corner[3];
    std::uint32_t material;
};
static_assert(sizeof(TriangleStd) == 16);

struct MaterialStd {
    float base[3];
    float metallic;
    float emissive[3];
    float shininess;
    float scale;                ///< lights::highlight_scale of the shininess.
    std::uint32_t first_texel;  ///< A word of the texels: mip 0, the others after it.
    std::uint32_t levels;       ///< 0: no texture.
    std::int32_t width, height;
    std::uint32_t wrap_u, wrap_v;
    float opacity;  ///< The base colour's alpha.
};
static_assert(sizeof(MaterialStd) == 64);

/// Words before the texels: the linear values of 256 codes, as floats.
inline constexpr std::uint32_t decoded_codes = 256;

/// Materials, and RGBA texels of 8 bits a channel, R in the lowest.
struct MaterialTable {
    std::vector<MaterialStd> materials;
    std::vector<std::uint32_t> texels;

    /// `seen[m]` != 0: with material m's texture. All of them where it is empty.
    MaterialTable() = default;
    MaterialTable(scene::Scene const& scene, std::span<std::uint8_t const> seen);
};

[[nodiscard]] std::vector<VertexStd> make_vertices(scene::Geometry const& geometry);
[[nodiscard]] std::vector<TriangleStd> make_triangles(scene::Geometry const& geometry);

[[nodiscard]] VertexStd vertex_of(scene::Geometry const& geometry, std::uint32_t vertex) noexcept;
[[nodiscard]] formula::GnTriangle<float> triangle_of(VertexStd const& a, VertexStd const& b, VertexStd const& c) noexcept;
[[nodiscard]] formula::GnTriangle<float> triangle_of(scene::Geometry const& geometry, std::uint32_t triangle) noexcept;

/// Of its texture, in texels.
[[nodiscard]] formula::Vec2<float> size_of(MaterialStd const& material) noexcept;
/// Linear base colour and opacity, filtered over a pixel.
[[nodiscard]] math::vec4 base_color_of(MaterialStd const& material, std::span<std::uint32_t const> texels,
                                       formula::Vec2<float> const& uv, formula::Float<float> texels_per_pixel) noexcept;

/// A view's rays, and a pixel's width: at 1 m, or at any distance of an orthographic view.
struct CameraRays {
    formula::GnRayCamera camera;
    float pixel_m = 0.0F;
};
[[nodiscard]] CameraRays make_camera_rays(math::View const& view, math::dvec3 const& origin_m) noexcept;

/// A surface and what reflects there, ready for lights.
struct SurfaceStd {
    math::vec3 position, normal;
    math::vec3 diffuse, specular, emissive;
    float shininess = 0.0F;
    float opacity = 1.0F;
};

/// What kernels read; on the host the same.
struct SurfaceData {
    std::span<VertexStd const> vertices;
    std::span<TriangleStd const> triangles;
    std::span<MaterialStd const> materials;
    std::span<std::uint32_t const> texels;
    CameraRays rays;

    /// Of a triangle at an image point.
    [[nodiscard]] SurfaceStd at(std::uint32_t triangle, math::vec2 const& px) const noexcept;
};

}  // namespace gnomon::pipeline
