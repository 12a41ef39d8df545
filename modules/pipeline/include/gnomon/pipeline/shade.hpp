#pragma once
// Shading good enough to judge a shadow by eye, and the pictures that show errors.

#include <gnomon/core/executor.hpp>
#include <gnomon/math/vec.hpp>
#include <gnomon/pipeline/frame.hpp>
#include <gnomon/pipeline/image.hpp>

#include <cstdint>
#include <span>
#include <vector>

namespace gnomon::pipeline {

struct ShadeConfig {
    float exposure = 0.0F;   ///< Multiplies the linear radiance; 0 picks it from the scene, without shadows.
    float ambient = 0.35F;   ///< The sky's strength relative to the light's on a surface that faces it.
    float specular = 0.04F;  ///< Blinn-Phong reflectance.
    float shininess = 32.0F;
    math::vec3 sky_color{0.62F, 0.75F, 1.0F};
    math::vec3 ground_color{0.36F, 0.32F, 0.28F};
};

/// Per sample, linear RGB: what the light gives where nothing blocks it, and what arrives in full shadow.
///
/// radiance = ambient + visibility * direct; shadows change only the second term, so a frame is shaded once.
struct Shading {
    std::vector<math::vec3> ambient;
    std::vector<math::vec3> direct;
    float exposure = 1.0F;
    ShadeConfig config;
};

[[nodiscard]] Shading shade(Frame const& frame, ShadeConfig const& config, core::ExecutorRef executor);

/// The picture for these visibilities: tone mapped, sRGB, a sky behind.
[[nodiscard]] Image picture(Frame const& frame, Shading const& shading, std::span<float const> visibility);

/// The same, each sample's surface in a colour of `tint` (linear RGB, white as it is).
[[nodiscard]] Image tinted_picture(Frame const& frame, Shading const& shading, std::span<float const> visibility,
                                   std::span<math::vec3 const> tint);

/// The same picture in grey, false-lit samples in orange, false-shadow ones in blue.
[[nodiscard]] Image error_overlay(Frame const& frame, Shading const& shading, std::span<float const> visibility);

/// RMS difference of the linear radiance from the exact one's, over the exact one's RMS. 0 without samples.
[[nodiscard]] double radiance_error(Frame const& frame, Shading const& shading, std::span<float const> visibility);

/// The truth as visibilities.
[[nodiscard]] std::vector<float> exact_visibility(Frame const& frame);

inline constexpr math::vec3 false_lit_color{1.0F, 0.45F, 0.05F};
inline constexpr math::vec3 false_shadow_color{0.10F, 0.45F, 1.0F};

}  // namespace gnomon::pipeline
