#pragma once
// From radiance to the bytes of a picture.

#include <gnomon/math/vec.hpp>
#include <gnomon/pipeline/image.hpp>

#include "texture.hpp"

#include <cmath>
#include <cstddef>

namespace gnomon::pipeline {

/// source: K. Narkowicz, "ACES Filmic Tone Mapping Curve", 2016: a toe for contrast, a shoulder for highlights.
[[nodiscard]] inline float tone_mapped(float radiance) noexcept {
    float const x = std::fmin(std::fmax(radiance, 0.0F), 1e4F);
    return std::fmin(x * (2.51F * x + 0.03F) / (x * (2.43F * x + 0.59F) + 0.14F), 1.0F);
}
[[nodiscard]] inline math::vec3 tone_mapped(math::vec3 const& radiance) noexcept {
    return math::vec3(tone_mapped(radiance.x), tone_mapped(radiance.y), tone_mapped(radiance.z));
}

[[nodiscard]] inline float luminance(math::vec3 const& c) noexcept { return 0.2126F * c.x + 0.7152F * c.y + 0.0722F * c.z; }

inline void put(Image& image, std::size_t pixel, math::vec3 const& linear) noexcept {
    for (int c = 0; c < 3; ++c) image.rgb[pixel * 3 + static_cast<std::size_t>(c)] = srgb_from_linear(linear[c]);
}

}  // namespace gnomon::pipeline
