#pragma once
// Texels for the formulas: one fetch for each lane.

#include <gnomon/math/formula.hpp>
#include <gnomon/math/scalar.hpp>

#include <concepts>
#include <cstddef>
#include <cstdint>

namespace gnomon::shadow {

[[nodiscard]] inline float depth_of(float texel) noexcept { return texel; }
[[nodiscard]] inline float depth_of(std::uint16_t texel) noexcept { return math::depth_of_code(texel); }

/// Anything that can give the texel at (x, y): memory, an atlas tile, a page table, a formula.
template <class S>
concept TexelSource = requires(S const& source, std::int32_t i) {
    { depth_of(source.at(i, i)) }
    noexcept->std::same_as<float>;
};

}  // namespace gnomon::shadow

namespace gnomon::formula {

/// What GN_TEXEL is in C++.
template <class S, shadow::TexelSource Source>
[[nodiscard, gnu::always_inline]] inline Float<S> gn_texel(Source const& texels, Int<S> const& x, Int<S> const& y) noexcept {
    if constexpr (requires { S::size; }) {
        float depth[S::size];
        for (std::size_t i = 0; i < S::size; ++i) depth[i] = shadow::depth_of(texels.at(x.v[i], y.v[i]));
        return S::load(depth);
    } else {
        return shadow::depth_of(texels.at(x.v, y.v));
    }
}

}  // namespace gnomon::formula
