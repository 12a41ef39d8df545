#pragma once
// The light of a frame: a scene's own kind, whether it comes from a file or from a command line.

#include <gnomon/math/vec.hpp>
#include <gnomon/pipeline/error.hpp>
#include <gnomon/scene/scene.hpp>

#include <limits>

namespace gnomon::pipeline {

using Light = scene::Light;
using LightKind = scene::LightKind;

/// A white sun that shines along `direction`, of any length above 0.
[[nodiscard]] inline Light sun(math::dvec3 const& direction) {
    Light light;
    light.direction = direction;
    return light;
}

/// A white light in all directions.
[[nodiscard]] inline Light bulb(math::dvec3 const& position_m, float range_m = std::numeric_limits<float>::infinity()) {
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
