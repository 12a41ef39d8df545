// Pictures of frames under many lights.

#include <gnomon/pipeline/lighting.hpp>

#include "../tone.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace gnomon::pipeline {

namespace {

/// Black, blue, green, yellow, red, white: linear RGB at equal steps.
constexpr std::array<math::vec3, 6> heat{math::vec3(0.0F),        math::vec3(0.02F, 0.05F, 0.6F), math::vec3(0.02F, 0.6F, 0.1F),
                                         math::vec3(1.0F, 0.8F, 0.0F), math::vec3(0.9F, 0.05F, 0.0F), math::vec3(1.0F)};

template <class Color>
Image painted(Frame const& frame, Color&& color_of_sample) {
    Image image{frame.view.size_px, std::vector<std::uint8_t>(pixel_count(frame.view.size_px) * 3)};
    for (std::size_t i = 0; i < frame.samples.size(); ++i) put(image, frame.samples.pixel[i], color_of_sample(i));
    return image;
}

}  // namespace

math::vec3 heat_color(float share) noexcept {
    float const place = std::clamp(share, 0.0F, 1.0F) * static_cast<float>(heat.size() - 1);
    auto const first = std::min(static_cast<std::size_t>(place), heat.size() - 2);
    float const weight = place - static_cast<float>(first);
    return heat[first] * (1.0F - weight) + heat[first + 1] * weight;
}

float pick_exposure(std::span<math::vec3 const> radiance) {
    std::vector<float> lit;
    for (math::vec3 const& c : radiance)
        if (float const l = luminance(c); l > 0.0F) lit.push_back(l);
    if (lit.empty()) return 1.0F;
    auto const key = lit.begin() + static_cast<std::ptrdiff_t>(lit.size() * 9 / 10);
    std::nth_element(lit.begin(), key, lit.end());
    return 0.5F / *key;
}

Image lit_picture(Frame const& frame, std::span<math::vec3 const> radiance, float exposure) {
    return painted(frame, [&](std::size_t i) { return tone_mapped(radiance[i] * exposure); });
}

Image heat_map(Frame const& frame, std::span<std::uint32_t const> computations, std::uint32_t most) {
    float const scale = most > 0 ? 1.0F / static_cast<float>(most) : 0.0F;
    return painted(frame, [&](std::size_t i) { return heat_color(static_cast<float>(computations[i]) * scale); });
}

}  // namespace gnomon::pipeline
