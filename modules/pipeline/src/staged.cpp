#include "staged.hpp"

#include "shadow/kernels.hpp"

#include <algorithm>
#include <cstring>
#include <string>
#include <vector>

namespace gnomon::pipeline {

core::Failure<Error> Verbs::failure() const {
    GNOMON_EXPECT(failure_.has_value());
    Error const code = failure_->code == backend::Error::too_large ? Error::too_large : Error::backend_failed;
    return {code, "backend " + std::string(device_->name()) + ": " + backend::name_of(failure_->code) + ": " +
                      failure_->message};
}

backend::BufferId StagedBuffer::fit(Verbs& verbs, std::size_t bytes) {
    bytes = std::max<std::size_t>((bytes + 15) / 16 * 16, 16);
    if (bytes <= bytes_) return held_.get();
    held_ = {};  // first, so that both are never there at once
    bytes_ = 0;
    held_ = Held(verbs.device(), verbs(verbs.device().make_buffer(bytes)));
    if (verbs.good()) bytes_ = bytes;
    return held_.get();
}

void StagedSamples::fit(Verbs& verbs, Frame const& frame) {
    if (of == frame.state) return;
    of = nullptr;
    samples.fill<sample::ViewSample>(verbs, frame.state->samples);
    normals.fill<math::vec3>(verbs, frame.samples.normal);
    reached.fill<std::uint8_t>(verbs, frame.reached);
    if (verbs.good()) of = frame.state;
}

namespace {

/// Textures one after the other, each from a multiple of 4 bytes on.
struct PackedTextures {
    std::vector<RayTextureStd> table;
    std::vector<std::uint8_t> texels;

    explicit PackedTextures(std::span<math::AlphaTexture const> textures) {
        for (math::AlphaTexture const& texture : textures) {
            if (!math::is_complete(texture)) {
                table.push_back({});
                continue;
            }
            std::uint32_t const wraps = static_cast<std::uint32_t>(texture.wrap_u) |
                                        static_cast<std::uint32_t>(texture.wrap_v) << 8U |
                                        static_cast<std::uint32_t>(texture.channels) << 16U;
            table.push_back({static_cast<std::uint32_t>(texels.size()), texture.size_px.x, texture.size_px.y, wraps});
            texels.insert(texels.end(), texture.texels.begin(), texture.texels.end());
            texels.resize((texels.size() + 3) / 4 * 4);
        }
    }
};

}  // namespace

void StagedSurfaces::fit(Verbs& verbs, Frame const& frame) {
    Surfaces const& s = *frame.state->surfaces;
    if (of == frame.state->surfaces) return;
    of = nullptr;
    positions.fill<math::vec3>(verbs, frame.geometry->positions);
    corners.fill<math::uvec3>(verbs, s.corners);
    std::vector<RayMaterialStd> table;
    for (trace::AlphaMaterial const& m : s.materials)
        table.push_back({m.is_masked ? 1U : 0U, m.factor, m.cutoff, m.texture});
    PackedTextures const packed(s.textures);
    bool const masked = s.masked;
    material_of.fill<std::uint32_t>(verbs, masked ? std::span<std::uint32_t const>(frame.geometry->triangle_material)
                                                  : std::span<std::uint32_t const>());
    materials.fill<RayMaterialStd>(verbs, table);
    textures.fill<RayTextureStd>(verbs, packed.table);
    texels.fill<std::uint8_t>(verbs, packed.texels);
    corner_uv.fill<math::vec2>(verbs, s.corner_uv);
    if (verbs.good()) of = frame.state->surfaces;
}

}  // namespace gnomon::pipeline
