#pragma once
// Alpha-masked surfaces: is a point of a triangle solid? Mip 0, bilinear, >= cutoff is solid, all in double.
//
// Plain spans in; whoever rasterizes masked triangles calls the same functions and gets the same answer.

#include <gnomon/core/id.hpp>
#include <gnomon/math/vec.hpp>
#include <gnomon/trace/query.hpp>

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>

namespace gnomon::trace {

/// glTF's three.
enum class Wrap : std::uint8_t { repeat, clamp, mirror };

/// 8 bits per channel, four channels, rows from v = 0 on. A texture that is too short for its size reads as solid.
struct AlphaTexture {
    std::span<std::uint8_t const> rgba;
    math::ivec2 size_px{0, 0};
    Wrap wrap_u = Wrap::repeat;
    Wrap wrap_v = Wrap::repeat;
};

/// alpha = factor * texture; solid where it is >= cutoff.
struct AlphaMaterial {
    static constexpr std::uint32_t no_texture = std::numeric_limits<std::uint32_t>::max();

    bool is_masked = false;  ///< Otherwise solid everywhere.
    float factor = 1.0F;
    float cutoff = 0.5F;
    std::uint32_t texture = no_texture;
};

namespace detail {

/// Texel index of the integer coordinate `i` on an axis of `n` texels.
[[nodiscard]] inline std::int64_t wrapped(std::int64_t i, std::int64_t n, Wrap wrap) noexcept {
    switch (wrap) {
        case Wrap::clamp: return i < 0 ? 0 : i < n ? i : n - 1;
        case Wrap::repeat: return (i % n + n) % n;
        case Wrap::mirror: {
            std::int64_t const j = (i % (2 * n) + 2 * n) % (2 * n);
            return j < n ? j : 2 * n - 1 - j;
        }
    }
    return 0;
}

/// The two texels on both sides of coordinate `u` (1 is the texture's width), and the weight of the second.
struct Tap {
    std::int64_t first;
    std::int64_t second;
    double weight;
};

[[nodiscard]] inline Tap make_tap(double u, int size, Wrap wrap) noexcept {
    // Reduced to [0, 2) where texels repeat, limited where they do not: the cast below is safe for any number. NaN: 0.
    double const period = 2.0;
    double reduced = wrap == Wrap::clamp ? std::fmin(std::fmax(u, -1.0), 2.0) : u - period * std::floor(u / period);
    if (!(reduced >= -1.0 && reduced <= 2.0)) reduced = 0.0;
    double const place = reduced * size - 0.5;
    double const whole = std::floor(place);
    auto const i = static_cast<std::int64_t>(whole);
    return {wrapped(i, size, wrap), wrapped(i + 1, size, wrap), place - whole};
}

}  // namespace detail

/// Alpha in [0, 1] of `texture` at `uv`, bilinear between texel centres.
///
/// returns: 1 for a texture without texels. NaN and infinite coordinates read as 0.
[[nodiscard]] inline double alpha_at(AlphaTexture const& texture, math::dvec2 const& uv) noexcept {
    auto const [w, h] = std::array{texture.size_px.x, texture.size_px.y};
    if (w <= 0 || h <= 0) return 1.0;
    if (texture.rgba.size() / 4 / static_cast<std::size_t>(w) < static_cast<std::size_t>(h)) return 1.0;
    detail::Tap const x = detail::make_tap(uv.x, w, texture.wrap_u);
    detail::Tap const y = detail::make_tap(uv.y, h, texture.wrap_v);
    auto const texel = [&](std::int64_t column, std::int64_t row) noexcept {
        return static_cast<double>(texture.rgba[static_cast<std::size_t>(row * w + column) * 4 + 3]);
    };
    double const top = texel(x.first, y.first) * (1.0 - x.weight) + texel(x.second, y.first) * x.weight;
    double const bottom = texel(x.first, y.second) * (1.0 - x.weight) + texel(x.second, y.second) * x.weight;
    return (top * (1.0 - y.weight) + bottom * y.weight) / 255.0;
}

/// Solid at `uv`.
[[nodiscard]] inline bool is_solid(AlphaMaterial const& material, std::span<AlphaTexture const> textures,
                                   math::dvec2 const& uv) noexcept {
    if (!material.is_masked) return true;
    double const sampled = material.texture < textures.size() ? alpha_at(textures[material.texture], uv) : 1.0;
    return static_cast<double>(material.factor) * sampled >= static_cast<double>(material.cutoff);
}

/// The opacity of a scene's triangles: an `Opacity` for the queries.
///
/// expects: `uvs` has three per triangle, in corner order, for every triangle whose material is masked and textured.
struct AlphaTest {
    std::span<std::uint32_t const> material_of;  ///< Per triangle; beyond its end, and beyond `materials`, all is solid.
    std::span<AlphaMaterial const> materials;
    std::span<AlphaTexture const> textures;
    std::span<math::vec2 const> uvs;

    [[nodiscard]] bool operator()(Crossing const& crossing) const noexcept {
        std::size_t const id = crossing.triangle.index();
        if (id >= material_of.size() || material_of[id] >= materials.size()) return true;
        AlphaMaterial const& material = materials[material_of[id]];
        if (!material.is_masked) return true;
        math::dvec2 uv(0.0, 0.0);
        if (3 * id + 2 < uvs.size())
            for (std::size_t corner = 0; corner < 3; ++corner) {
                double const weight = crossing.weights[static_cast<int>(corner)];
                uv.x += weight * static_cast<double>(uvs[3 * id + corner].x);
                uv.y += weight * static_cast<double>(uvs[3 * id + corner].y);
            }
        return is_solid(material, textures, uv);
    }
};

}  // namespace gnomon::trace
