#include "texture.hpp"

#include <gnomon/math/scalar.hpp>

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

std::int32_t wrapped(std::int32_t i, std::int32_t size, scene::Wrap wrap) noexcept {
    switch (wrap) {
        case scene::Wrap::clamp_to_edge: return std::clamp(i, 0, size - 1);
        case scene::Wrap::mirrored_repeat: {
            std::int32_t const period = 2 * size;
            std::int32_t const m = ((i % period) + period) % period;
            return m < size ? m : period - 1 - m;
        }
        case scene::Wrap::repeat: break;
    }
    return ((i % size) + size) % size;
}

/// The texel left of or at `coordinate` and how far beyond its centre it lies.
struct Place {
    std::int32_t texel;
    float fraction;
};

Place place_of(float coordinate, std::int32_t size) noexcept {
    // Whole repeats are dropped before the cast, so that no coordinate leaves the range of int.
    float const unit = math::is_finite(coordinate) ? coordinate : 0.0F;
    float const near_zero = std::fabs(unit) < 16384.0F ? unit : unit - 2.0F * std::floor(unit * 0.5F);
    float const x = near_zero * static_cast<float>(size) - 0.5F;
    float const whole = std::floor(x);
    return {static_cast<std::int32_t>(whole), x - whole};
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
                for (std::int32_t k = 0; k < 4; ++k) {
                    std::int32_t const sx = std::min(2 * x + (k & 1), from.size_px.x - 1);
                    std::int32_t const sy = std::min(2 * y + (k >> 1), from.size_px.y - 1);
                    std::uint8_t const* const texel = from.rgba + 4 * (std::ptrdiff_t{sy} * from.size_px.x + sx);
                    for (std::size_t c = 0; c < 3; ++c) sum[c] += linear_from_srgb(texel[c]);
                }
                std::uint8_t* const out = texels.data() + 4 * (std::ptrdiff_t{y} * size.x + x);
                for (std::size_t c = 0; c < 3; ++c) out[c] = srgb_from_linear(sum[c] * 0.25F);
                out[3] = 255;
            }
        storage_.push_back(std::move(texels));
        levels_.push_back({size, storage_.back().data()});
    }
}

math::vec3 MipChain::bilinear(Level const& level, math::vec2 const& uv, scene::Texture const& use) const noexcept {
    Place const u = place_of(uv.x, level.size_px.x);
    Place const v = place_of(uv.y, level.size_px.y);
    math::vec3 color(0.0F);
    for (std::int32_t k = 0; k < 4; ++k) {
        std::int32_t const x = wrapped(u.texel + (k & 1), level.size_px.x, use.wrap_u);
        std::int32_t const y = wrapped(v.texel + (k >> 1), level.size_px.y, use.wrap_v);
        std::uint8_t const* const texel = level.rgba + 4 * (std::ptrdiff_t{y} * level.size_px.x + x);
        float const weight =
            ((k & 1) != 0 ? u.fraction : 1.0F - u.fraction) * ((k >> 1) != 0 ? v.fraction : 1.0F - v.fraction);
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
