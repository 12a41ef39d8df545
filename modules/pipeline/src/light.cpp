#include <gnomon/math/scalar.hpp>
#include <gnomon/pipeline/light.hpp>

#include <string>

namespace gnomon::pipeline {

namespace {

std::string vector_text(math::dvec3 const& v) {
    return "(" + std::to_string(v.x) + ", " + std::to_string(v.y) + ", " + std::to_string(v.z) + ")";
}

core::Failure<Error> refuse(std::string sentence) { return {Error::bad_light, std::move(sentence)}; }

}  // namespace

char const* name_of(LightKind kind) noexcept {
    switch (kind) {
        case LightKind::directional: return "directional";
        case LightKind::point: return "point";
        case LightKind::spot: break;
    }
    return "spot";
}

Result<core::Done> validate(Light const& light) {
    bool const aimed = light.kind != LightKind::point;
    bool const placed = light.kind != LightKind::directional;
    if (aimed && !math::is_finite(light.direction))
        return refuse("the light's direction " + vector_text(light.direction) + " is not finite");
    if (aimed && light.direction == math::dvec3(0.0))
        return refuse("the light's direction " + vector_text(light.direction) +
                      " has no length: give one, such as (-0.45, -0.8, -0.4)");
    if (placed && !math::is_finite(light.position_m))
        return refuse("the light's position " + vector_text(light.position_m) + " m is not finite");
    if (placed && !(light.range_m > 0.0F))
        return refuse("the light's range is " + std::to_string(light.range_m) + " m; it must be above 0");
    constexpr float right_angle = 1.5707964F;
    if (light.kind == LightKind::spot && !(light.outer_cone_rad > 0.0F && light.outer_cone_rad <= right_angle))
        return refuse("the spot's outer half angle is " + std::to_string(light.outer_cone_rad * 57.29578F) +
                      " degrees; it must be above 0 and at most 90");
    math::vec3 const strength = light.color * light.intensity;
    if (!math::is_finite(strength) || strength.x < 0.0F || strength.y < 0.0F || strength.z < 0.0F)
        return refuse("the light's colour times intensity is " + vector_text(math::to_double(strength)) +
                      "; it must be finite and not negative");
    return core::Done{};
}

}  // namespace gnomon::pipeline
