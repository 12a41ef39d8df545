#pragma once
// The frame's materials, ready for shading: a sample's base colour, filtered over its pixel.

#include <gnomon/pipeline/frame.hpp>

#include "texture.hpp"

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace gnomon::pipeline {

/// Texels per metre of each triangle would be a table; per sample it is one division more, and no memory.
[[nodiscard]] inline float texels_per_metre(scene::Geometry const& g, std::uint32_t triangle, math::ivec2 texture_px) noexcept {
    std::uint32_t const* const corner = g.indices.data() + std::size_t{triangle} * 3;
    math::vec3 const e1 = g.positions[corner[1]] - g.positions[corner[0]];
    math::vec3 const e2 = g.positions[corner[2]] - g.positions[corner[0]];
    math::vec2 const u1 = g.uv[corner[1]] - g.uv[corner[0]];
    math::vec2 const u2 = g.uv[corner[2]] - g.uv[corner[0]];
    math::vec3 const cross = glm::cross(e1, e2);
    float const area = std::sqrt(glm::dot(cross, cross));
    float const texels =
        std::abs(u1.x * u2.y - u1.y * u2.x) * static_cast<float>(texture_px.x) * static_cast<float>(texture_px.y);
    return area > 0.0F ? std::sqrt(texels / area) : 0.0F;
}

/// The frame's materials, ready for shading.
class Palette {
  public:
    explicit Palette(Frame const& frame) : frame_(&frame), chains_(frame.scene->materials.size()) {
        std::vector<std::uint8_t> seen(chains_.size(), 0);
        for (std::uint32_t const triangle : frame.samples.triangle)
            seen[frame.geometry->triangle_material[triangle]] = 1;
        for (std::size_t i = 0; i < chains_.size(); ++i) {
            scene::Image const* const image = base_image(*frame.scene, frame.scene->materials[i]);
            if (seen[i] != 0 && image != nullptr) chains_[i].emplace(*image);
        }
    }

    [[nodiscard]] scene::Material const& material(std::size_t sample) const noexcept {
        return frame_->scene->materials[frame_->geometry->triangle_material[frame_->samples.triangle[sample]]];
    }

    [[nodiscard]] math::vec3 base_color(std::size_t i, float pixel_m, float cosine) const noexcept {
        scene::Material const& m = material(i);
        math::vec3 const factor(m.base_color.x, m.base_color.y, m.base_color.z);
        std::uint32_t const triangle = frame_->samples.triangle[i];
        auto const& chain = chains_[frame_->geometry->triangle_material[triangle]];
        if (!chain || frame_->geometry->uv.empty()) return factor;
        // The pixel's footprint grows with 1 / cosine along one direction only: the geometric mean of both.
        float const footprint = pixel_m / std::sqrt(std::fmax(cosine, 0.05F));
        float const density = texels_per_metre(*frame_->geometry, triangle, chain->size_px());
        return factor * chain->at(frame_->samples.uv[i], density * footprint, *base_texture(*frame_->scene, m));
    }

  private:
    Frame const* frame_;
    std::vector<std::optional<MipChain>> chains_;
};

}  // namespace gnomon::pipeline
