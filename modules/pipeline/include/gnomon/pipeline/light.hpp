#pragma once
// A light as the pipeline takes it: one sun, one bulb or one spot, in world metres.

#include <gnomon/math/vec.hpp>
#include <gnomon/pipeline/error.hpp>

#include <cstdint>
#include <limits>

namespace gnomon::pipeline {

enum class LightKind : std::uint8_t {
    directional,
    point,
    spot,
};

struct Light {
    LightKind kind = LightKind::directional;
    math::dvec3 position_m{0.0, 0.0, 0.0};     ///< Point and spot.
    math::dvec3 direction{-0.45, -0.8, -0.4};  ///< The way the light travels, any length above 0; directional and spot.
    math::vec3 color{1.0F, 1.0F, 1.0F};        ///< Linear RGB times intensity; pictures choose their exposure by it.
    double range_m = std::numeric_limits<double>::infinity();  ///< Point and spot: nothing is lit beyond.
    double inner_cone_rad = 0.0;                               ///< Spot: half angle of full light.
    double outer_cone_rad = 0.7853981633974483;                ///< Spot: half angle where the light ends.
};

[[nodiscard]] inline Light sun(math::dvec3 const& direction) {
    Light light;
    light.direction = direction;
    return light;
}

[[nodiscard]] inline Light bulb(math::dvec3 const& position_m,
                                double range_m = std::numeric_limits<double>::infinity()) {
    Light light;
    light.kind = LightKind::point;
    light.position_m = position_m;
    light.range_m = range_m;
    return light;
}

/// Success, or what is wrong with the light in one sentence that names the value.
[[nodiscard]] Result<core::Done> validate(Light const& light);

/// "directional", "point" or "spot".
[[nodiscard]] char const* name_of(LightKind kind) noexcept;

}  // namespace gnomon::pipeline
