#include "texture.hpp"

#include <gnomon/math/texel.hpp>

#include <algorithm>
#include <array>
#include <cmath>

namespace gnomon::pipeline {

namespace {

std::array<float, 256> make_decode_table() {
    std::array<float, 256> table{};
    for (std::size_t i = 0; i < table.size(); ++i) {
        double const c = static_cast<double>(i) / 255.0;
        table[i] = static_cast<float>(c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4));
    }
    return table;
}

}  // namespace

float linear_from_srgb(std::uint8_t code) noexcept {
    static std::array<float, 256> const table = make_decode_table();
    return table[code];
}

std::uint8_t srgb_from_linear(float linear) noexcept {
    float const x = std::clamp(linear, 0.0F, 1.0F);  // a NaN stays one, and is caught below
    float const encoded = x <= 0.0031308F ? 12.92F * x : 1.055F * std::pow(x, 1.0F / 2.4F) - 0.055F;
    return encoded >= 0.0F ? static_cast<std::uint8_t>(encoded * 255.0F + 0.5F) : std::uint8_t{0};
}

MipChain::MipChain(scene::Image const& image) {
    levels_.push_back({image.size_px, image.rgba.data()});
    while (levels_.back().size_px.x > 1 || levels_.back().size_px.y > 1) {
        Level const from = levels_.back();
        math::ivec2 const size(std::max(1, from.size_px.x / 2), std::max(1, from.size_px.y / 2));
        std::vector<std::uint8_t> texels(static_cast<std::size_t>(size.x) * static_cast<std::size_t>(size.y) * 4);
        for (std::int32_t y = 0; y < size.y; ++y)
            for (std::int32_t x = 0; x < size.x; ++x) {
                std::array<float, 3> sum{};
                unsigned alpha = 2;  // rounds to nearest
                for (std::int32_t k = 0; k < 4; ++k) {
                    std::int32_t const sx = std::min(2 * x + (k & 1), from.size_px.x - 1);
                    std::int32_t const sy = std::min(2 * y + (k >> 1), from.size_px.y - 1);
                    std::uint8_t const* const texel = from.rgba + 4 * (std::ptrdiff_t{sy} * from.size_px.x + sx);
                    for (std::size_t c = 0; c < 3; ++c) sum[c] += linear_from_srgb(texel[c]);
                    alpha += texel[3];
                }
                std::uint8_t* const out = texels.data() + 4 * (std::ptrdiff_t{y} * size.x + x);
                for (std::size_t c = 0; c < 3; ++c) out[c] = srgb_from_linear(sum[c] * 0.25F);
                out[3] = static_cast<std::uint8_t>(alpha / 4);
            }
        storage_.push_back(std::move(texels));
        levels_.push_back({size, storage_.back().data()});
    }
}

math::vec3 MipChain::bilinear(Level const& level, math::vec2 const& uv, scene::Texture const& use) const noexcept {
    math::Tap const u = math::make_tap(static_cast<double>(uv.x), level.size_px.x, use.wrap_u);
    math::Tap const v = math::make_tap(static_cast<double>(uv.y), level.size_px.y, use.wrap_v);
    auto const u_weight = static_cast<float>(u.weight);
    auto const v_weight = static_cast<float>(v.weight);
    math::vec3 color(0.0F);
    for (std::int32_t k = 0; k < 4; ++k) {
        std::int32_t const x = (k & 1) != 0 ? u.second : u.first;
        std::int32_t const y = (k >> 1) != 0 ? v.second : v.first;
        std::uint8_t const* const texel = level.rgba + 4 * (std::ptrdiff_t{y} * level.size_px.x + x);
        float const weight =
            ((k & 1) != 0 ? u_weight : 1.0F - u_weight) * ((k >> 1) != 0 ? v_weight : 1.0F - v_weight);
        color +=
            math::vec3(linear_from_srgb(texel[0]), linear_from_srgb(texel[1]), linear_from_srgb(texel[2])) * weight;
    }
    return color;
}

math::vec3 MipChain::at(math::vec2 const& uv, float texels_per_pixel, scene::Texture const& use) const noexcept {
    auto const last = static_cast<float>(levels_.size() - 1);
    float const lod = texels_per_pixel > 1.0F ? std::min(std::log2(texels_per_pixel), last) : 0.0F;
    auto const level = static_cast<std::size_t>(lod);
    float const blend = lod - static_cast<float>(level);
    math::vec3 const sharp = bilinear(levels_[level], uv, use);
    if (blend == 0.0F || level + 1 >= levels_.size()) return sharp;
    return sharp * (1.0F - blend) + bilinear(levels_[level + 1], uv, use) * blend;
}

}  // namespace gnomon::pipeline
