#pragma once
// The smallest texture that alpha can be looked up in, for the tests of math and of those who build on it.

#include <gnomon/math/texel.hpp>

#include <array>
#include <cstdint>

namespace texels {

/// 2 x 2 texels with these alphas, row by row.
struct Texels {
    std::array<std::uint8_t, 16> bytes{};

    Texels(std::uint8_t a, std::uint8_t b, std::uint8_t c, std::uint8_t d) {
        bytes[3] = a;
        bytes[7] = b;
        bytes[11] = c;
        bytes[15] = d;
    }
    [[nodiscard]] gnomon::math::AlphaTexture texture(gnomon::math::Wrap wrap) const { return {bytes, gnomon::math::ivec2(2, 2), wrap, wrap}; }
};

}  // namespace texels
