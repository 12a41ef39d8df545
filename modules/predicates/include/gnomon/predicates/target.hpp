#pragma once
// Where a segment ends: at a point, or nowhere (a ray). Lights and eyes are targets: a lamp and a perspective eye are
// points, the sun and an orthographic eye are directions.

#include <gnomon/math/scalar.hpp>
#include <gnomon/math/vec.hpp>

namespace gnomon::predicates {

/// A point, or the point at infinity in a direction: the direction TOWARDS the light or eye, of any length above 0.
struct Target {
    math::vec3 xyz{0.0F, 0.0F, 0.0F};
    bool at_infinity = false;

    [[nodiscard]] static Target point(math::vec3 const& position) noexcept { return {position, false}; }
    [[nodiscard]] static Target direction(math::vec3 const& towards) noexcept { return {towards, true}; }
};

/// Finite, and a direction is not zero. For any other target every predicate that takes it is `Sign::zero`.
[[nodiscard]] inline bool is_valid(Target const& target) noexcept {
    return math::is_finite(target.xyz) && !(target.at_infinity && target.xyz == math::vec3(0.0F));
}

}  // namespace gnomon::predicates
