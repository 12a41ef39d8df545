#pragma once
// The points inside all of several half-spaces: a frustum, a light's cull planes. What may touch it?

#include <gnomon/core/contract.hpp>
#include <gnomon/math/cone.hpp>
#include <gnomon/math/frustum.hpp>
#include <gnomon/math/touch.hpp>

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>

namespace gnomon::math {

/// Up to twelve half-spaces, and a box around their intersection where it is known: what lies off a corner of a frustum
/// is outside of it and yet outside of no plane.
///
/// All tests keep what is outside of no single plane and, but for crates, touches `bounds`.
struct PlaneSet {
    static constexpr std::size_t max_planes = 12;

    std::array<formula::GnPlane, max_planes> planes{};
    std::uint32_t count = 0;
    Aabb bounds{vec3(-std::numeric_limits<float>::infinity()), vec3(std::numeric_limits<float>::infinity())};

    PlaneSet() = default;

    /// expects: at most `max_planes`. A plane with a number that is none bounds nothing.
    explicit PlaneSet(std::span<Plane const> list) noexcept {
        GNOMON_EXPECT(list.size() <= max_planes);
        for (Plane const& plane : list)
            if (count < max_planes) planes[count++] = formula_plane(plane);
    }

    /// What a view sees, relative to its eye.
    explicit PlaneSet(Frustum const& frustum) noexcept : PlaneSet(std::span<Plane const>(frustum.planes)) {}

    template <class S>
    [[nodiscard, gnu::always_inline]] formula::Bool<S> touches(formula::GnBox<S> const& box) const noexcept {
        formula::Bool<S> touched = gn_touches_box_box(lane_bounds<S>(), box);
        for (std::uint32_t i = 0; i < count; ++i) touched = touched && gn_touches_plane_box(planes[i], box);
        return touched;
    }
    template <class S>
    [[nodiscard, gnu::always_inline]] formula::Bool<S> touches(formula::GnSphere<S> const& s) const noexcept {
        formula::Bool<S> touched = gn_touches_sphere_box(s.center, gn_touch_limit(s.radius), lane_bounds<S>());
        for (std::uint32_t i = 0; i < count; ++i) touched = touched && gn_touches_plane_sphere(planes[i], s);
        return touched;
    }
    template <class S>
    [[nodiscard, gnu::always_inline]] formula::Bool<S> touches(formula::GnSector<S> const& s) const noexcept {
        formula::Bool<S> touched = touches(formula::GnSphere<S>{s.apex, s.range});
        for (std::uint32_t i = 0; i < count; ++i) touched = touched && gn_touches_plane_sector(planes[i], s);
        return touched;
    }
    template <class S>
    [[nodiscard, gnu::always_inline]] formula::Bool<S> touches(formula::GnCrate<S> const& c) const noexcept {
        formula::Bool<S> touched = true;
        for (std::uint32_t i = 0; i < count; ++i) touched = touched && gn_touches_plane_crate(planes[i], c);
        return touched;
    }

private:
    template <class S>
    [[nodiscard, gnu::always_inline]] formula::GnBox<S> lane_bounds() const noexcept {
        return {formula::Vec3<S>(bounds.lo), formula::Vec3<S>(bounds.hi)};
    }
};

namespace detail {

/// Two unit vectors at right angles to a unit vector and to each other, to 1e-15.
[[nodiscard]] inline std::array<dvec3, 2> across(dvec3 const& axis) noexcept {
    dvec3 const some = std::abs(axis.x) < 0.6 ? dvec3(1.0, 0.0, 0.0) : dvec3(0.0, 1.0, 0.0);
    dvec3 u = glm::cross(axis, some);
    u /= std::sqrt(glm::dot(u, u));
    return {u, glm::cross(axis, u)};
}

/// The sector's box: its reach along each axis, with the bound of 32 e and a little more.
[[nodiscard]] inline Aabb box_of(formula::GnSector<float> const& sector) noexcept {
    Aabb box;
    for (axis_t axis = 0; axis < 3; ++axis) {
        vec3 n(0.0F);
        n[axis] = 1.0F;
        auto const reach = [&sector](vec3 const& direction) {
            auto const r = gn_reach_of_sector(sector, formula::Vec3<float>(direction));
            return static_cast<double>(r.value.v) + 2.3e-6 * static_cast<double>(r.magnitude.v);
        };
        box.hi[axis] = next_up(rounded(reach(n)));
        box.lo[axis] = -next_up(rounded(reach(-n)));
    }
    return box;
}

}  // namespace detail

/// Half-spaces and a box that hold a cone: the one in front of its apex, and where it is narrower than a half-space eight
/// that touch its side. Every plane goes through the apex:
///
///     (sin(theta) axis - cos(theta) e) . (p - apex) >= 0  for eight unit vectors e at right angles to the axis
///
/// The sector's angle is 2^-20 wide of the cone's, far more than what double and the float axis round.
[[nodiscard]] inline PlaneSet pyramid_of(formula::GnSector<float> const& sector) noexcept {
    dvec3 const apex = to_double(static_cast<vec3>(sector.apex));
    dvec3 const axis = glm::normalize(to_double(static_cast<vec3>(sector.axis)));
    auto const cosine = static_cast<double>(sector.cosine.v);
    auto const sine = static_cast<double>(sector.sine.v);
    auto const through_apex = [&apex](dvec3 const& normal) { return Plane{normal, -glm::dot(normal, apex)}; };
    std::array<Plane, 9> planes;
    std::size_t count = 0;
    // In front of the apex; a wide cone reaches behind it by range cos(theta).
    planes[count] = through_apex(axis);
    planes[count++].offset += cosine < 0.0 ? -cosine * static_cast<double>(sector.range.v) * (1.0 + 1e-6) : 0.0;
    std::array<dvec3, 2> const e = detail::across(axis);
    constexpr double half = 0.70710678118654752;
    constexpr double turns[4][2] = {{1.0, 0.0}, {half, half}, {0.0, 1.0}, {-half, half}};
    for (auto const& turn : turns)
        for (double const side : {cosine, -cosine})
            if (cosine > 0.0) planes[count++] = through_apex(axis * sine - (e[0] * turn[0] + e[1] * turn[1]) * side);
    PlaneSet set(std::span<Plane const>(planes.data(), count));
    set.bounds = detail::box_of(sector);
    return set;
}

[[nodiscard]] inline bool may_touch(PlaneSet const& planes, Aabb const& box) noexcept {
    return planes.touches(formula_box(box)).v && !is_empty(box);
}

[[nodiscard]] inline bool may_touch(PlaneSet const& planes, Sphere const& sphere) noexcept {
    return planes.touches(formula_sphere(sphere)).v;
}

[[nodiscard]] inline bool may_touch(PlaneSet const& planes, formula::GnSector<float> const& sector) noexcept {
    return planes.touches(sector).v;
}

[[nodiscard]] inline bool may_touch(PlaneSet const& planes, formula::GnCrate<float> const& crate) noexcept {
    return planes.touches(crate).v;
}

}  // namespace gnomon::math
