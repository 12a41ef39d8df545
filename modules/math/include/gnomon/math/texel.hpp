#pragma once
// Texture lookups that several modules must agree on: wrapping, bilinear weights, and the alpha that masks surfaces.

#include <gnomon/math/scalar.hpp>
#include <gnomon/math/vec.hpp>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>

namespace gnomon::math {

/// How a texture continues outside [0, 1]: glTF's three.
enum class Wrap : std::uint8_t {
    repeat,
    clamp,
    mirror,
};

/// The two texels on both sides of a coordinate, and the weight of the second; the first has the rest.
struct Tap {
    std::int32_t first;
    std::int32_t second;
    double weight;
};

namespace detail {

/// expects: -1 <= i <= n (clamp, repeat) or 2n (mirror): one step outside at most, so no division is needed.
[[nodiscard]] constexpr std::int32_t wrapped(std::int32_t i, std::int32_t n, Wrap wrap) noexcept {
    switch (wrap) {
        case Wrap::repeat: return i < 0 ? n - 1 : i < n ? i : 0;
        case Wrap::clamp: return i < 0 ? 0 : i < n ? i : n - 1;
        case Wrap::mirror: return i < 0 ? 0 : i < n ? i : i < 2 * n ? 2 * n - 1 - i : 0;
    }
    return 0;
}

}  // namespace detail

/// The texels around coordinate `u` on an axis of `size` texels; u = 1 is the texture's far border.
///
/// Whole repeats are dropped in double before anything becomes an integer, so any number is legal: NaN and infinities
/// read as 0.
///
/// expects: 1 <= size <= 2^29.
[[nodiscard]] inline Tap make_tap(double u, std::int32_t size, Wrap wrap) noexcept {
    double reduced = 0.0;
    switch (wrap) {
        case Wrap::repeat: reduced = u >= 0.0 && u < 1.0 ? u : u - std::floor(u); break;
        case Wrap::clamp: reduced = u < 0.0 ? 0.0 : u > 1.0 ? 1.0 : u; break;
        case Wrap::mirror: reduced = u - 2.0 * std::floor(u * 0.5); break;
    }
    if (!is_finite(reduced)) reduced = 0.0;
    double const place = reduced * size - 0.5;
    // floor(place) without a call: the cast rounds toward zero.
    auto i = static_cast<std::int32_t>(place);
    if (place < i) --i;
    return {detail::wrapped(i, size, wrap), detail::wrapped(i + 1, size, wrap), place - i};
}

/// A view of 8-bit texels, rows from v = 0 on, `channels` bytes each; alpha is the last. 4: RGBA; 1: alpha alone.
struct AlphaTexture {
    std::span<std::uint8_t const> texels;
    ivec2 size_px{0, 0};
    Wrap wrap_u = Wrap::repeat;
    Wrap wrap_v = Wrap::repeat;
    std::int32_t channels = 4;
};

/// Has texels, and all that its size promises.
[[nodiscard]] inline bool is_complete(AlphaTexture const& texture) noexcept {
    if (texture.size_px.x <= 0 || texture.size_px.y <= 0 || texture.channels <= 0) return false;
    std::size_t const row = static_cast<std::size_t>(texture.size_px.x) * static_cast<std::size_t>(texture.channels);
    return texture.texels.size() / row >= static_cast<std::size_t>(texture.size_px.y);
}

/// Alpha in [0, 1] at (u, v): mip 0, bilinear between texel centres, in double.
///
/// expects: `is_complete(texture)`. Any coordinates are legal; see `make_tap`.
[[nodiscard]] inline double alpha_at(AlphaTexture const& texture, dvec2 const& uv) noexcept {
    Tap const x = make_tap(uv.x, texture.size_px.x, texture.wrap_u);
    Tap const y = make_tap(uv.y, texture.size_px.y, texture.wrap_v);
    auto const texel = [&](std::int32_t column, std::int32_t row) noexcept {
        std::ptrdiff_t const at = std::ptrdiff_t{row} * texture.size_px.x + column;
        return static_cast<double>(texture.texels.data()[(at + 1) * texture.channels - 1]);
    };
    double const top = texel(x.first, y.first) * (1.0 - x.weight) + texel(x.second, y.first) * x.weight;
    double const bottom = texel(x.first, y.second) * (1.0 - x.weight) + texel(x.second, y.second) * x.weight;
    return (top * (1.0 - y.weight) + bottom * y.weight) / 255.0;
}

}  // namespace gnomon::math
