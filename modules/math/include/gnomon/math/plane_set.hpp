#pragma once
// The points inside all of several half-spaces: a frustum, a light's cull planes. What may touch it?

#include <gnomon/core/contract.hpp>
#include <gnomon/math/cone.hpp>
#include <gnomon/math/frustum.hpp>
#include <gnomon/math/touch.hpp>

#include <array>
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
