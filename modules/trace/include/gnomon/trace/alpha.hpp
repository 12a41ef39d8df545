#pragma once
// Alpha-masked surfaces: is a point of a triangle solid? Mip 0, bilinear, >= cutoff is solid, all in double.
//
// Plain spans in; whoever rasterizes masked triangles calls the same functions and gets the same answer.

#include <gnomon/core/id.hpp>
#include <gnomon/math/texel.hpp>
#include <gnomon/math/vec.hpp>
#include <gnomon/trace/query.hpp>

#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>

namespace gnomon::trace {

/// alpha = factor * texture; solid where it is >= cutoff.
struct AlphaMaterial {
    static constexpr std::uint32_t no_texture = std::numeric_limits<std::uint32_t>::max();

    bool is_masked = false;  ///< Otherwise solid everywhere.
    float factor = 1.0F;
    float cutoff = 0.5F;
    std::uint32_t texture = no_texture;
};

/// Solid at `uv`. A texture that is missing, or too short for its size, reads as solid.
[[nodiscard]] inline bool is_solid(AlphaMaterial const& material, std::span<math::AlphaTexture const> textures,
                                   math::dvec2 const& uv) noexcept {
    if (!material.is_masked) return true;
    bool const textured = material.texture < textures.size() && math::is_complete(textures[material.texture]);
    double const sampled = textured ? math::alpha_at(textures[material.texture], uv) : 1.0;
    return static_cast<double>(material.factor) * sampled >= static_cast<double>(material.cutoff);
}

/// The texture coordinates of a crossing: those of its triangle's corners, mixed in double. (0, 0) where there are none.
///
/// expects: `uvs` has three per triangle, in corner order.
[[nodiscard]] inline math::dvec2 uv_at(Crossing const& crossing, std::span<math::vec2 const> uvs) noexcept {
    std::size_t const id = crossing.triangle.index();
    math::dvec2 uv(0.0, 0.0);
    if (3 * id + 2 >= uvs.size()) return uv;
    for (std::size_t corner = 0; corner < 3; ++corner) {
        double const weight = crossing.weights[static_cast<int>(corner)];
        uv.x += weight * static_cast<double>(uvs[3 * id + corner].x);
        uv.y += weight * static_cast<double>(uvs[3 * id + corner].y);
    }
    return uv;
}

/// The opacity of a scene's triangles: an `Opacity` for the queries.
///
/// expects: `uvs` has three per triangle, in corner order, for every triangle whose material is masked and textured.
struct AlphaTest {
    std::span<std::uint32_t const> material_of;  ///< Per triangle; beyond its end, and beyond `materials`, all is solid.
    std::span<AlphaMaterial const> materials;
    std::span<math::AlphaTexture const> textures;
    std::span<math::vec2 const> uvs;

    [[nodiscard]] bool operator()(Crossing const& crossing) const noexcept {
        std::size_t const id = crossing.triangle.index();
        if (id >= material_of.size() || material_of[id] >= materials.size()) return true;
        AlphaMaterial const& material = materials[material_of[id]];
        return !material.is_masked || is_solid(material, textures, uv_at(crossing, uvs));
    }
};

}  // namespace gnomon::trace
