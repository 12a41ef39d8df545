#pragma once
// What a tree can be asked for: anything that says "I may touch this box". Four regions come ready made.
//
// All are conservative: they may keep too much, and say no only where exact arithmetic on the same floats says no. The
// bounds stand at the tests, in gnomon/math/formula/touch.glsl.

#include <gnomon/math/bounds.hpp>
#include <gnomon/math/frustum.hpp>
#include <gnomon/math/lanes.hpp>
#include <gnomon/math/touch.hpp>

#include <array>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <span>

namespace gnomon::bvh {

/// Anything that can say "I may touch this box".
template <class R>
concept Region = requires(R const& region, math::Aabb const& box) {
    { region.may_touch(box) } noexcept -> std::same_as<bool>;
};

/// A region whose test is a formula, over floats and lanes, of boxes and spheres; its children are tested side by side.
template <class R>
concept LaneRegion = Region<R> && requires(R const& region, formula::GnBox<float> const& box, formula::GnSphere<float> const& sphere) {
    { region.touches(box) } noexcept -> std::same_as<formula::Bool<float>>;
    { region.touches(sphere) } noexcept -> std::same_as<formula::Bool<float>>;
};

/// A ball. One with a negative, infinite or no radius, or a centre that is no number, touches nothing.
struct SphereRegion {
    math::Sphere sphere;

    [[nodiscard]] bool may_touch(math::Aabb const& box) const noexcept { return touches(math::formula_box(box)).v; }
    template <class S>
    [[nodiscard, gnu::always_inline]] formula::Bool<S> touches(formula::GnBox<S> const& box) const noexcept {
        auto const limit = gn_touch_limit(formula::Float<float>(sphere.radius));
        return gn_touches_sphere_box(formula::Vec3<S>(sphere.center), formula::Float<S>(limit.v), box);
    }
    template <class S>
    [[nodiscard, gnu::always_inline]] formula::Bool<S> touches(formula::GnSphere<S> const& s) const noexcept {
        bool const has_points = math::is_finite(sphere.radius) && math::is_finite(sphere.center);
        return gn_touches_sphere_sphere(formula::Vec3<S>(sphere.center), formula::Float<S>(sphere.radius), s) &&
               formula::Bool<S>(has_points);
    }
};

/// A box; one without points touches nothing. Exact against boxes.
struct BoxRegion {
    math::Aabb box;

    [[nodiscard]] bool may_touch(math::Aabb const& other) const noexcept { return touches(math::formula_box(other)).v; }
    template <class S>
    [[nodiscard, gnu::always_inline]] formula::Bool<S> touches(formula::GnBox<S> const& other) const noexcept {
        return gn_touches_box_box(lanes<S>(), other) && formula::Bool<S>(!is_empty(box));
    }
    template <class S>
    [[nodiscard, gnu::always_inline]] formula::Bool<S> touches(formula::GnSphere<S> const& s) const noexcept {
        return gn_touches_sphere_box(s.center, gn_touch_limit(s.radius), lanes<S>()) && formula::Bool<S>(!is_empty(box));
    }

private:
    template <class S>
    [[nodiscard, gnu::always_inline]] formula::GnBox<S> lanes() const noexcept {
        return {formula::Vec3<S>(box.lo), formula::Vec3<S>(box.hi)};
    }
};

/// The points inside every one of up to twelve half-spaces, and inside `bounds` where it is known: a large box near a
/// frustum's corner may lie outside of it and yet be outside of no plane.
struct PlanesRegion {
    static constexpr std::size_t max_planes = 12;

    std::array<formula::GnPlane, max_planes> planes{};
    std::uint32_t count = 0;
    math::Aabb bounds{math::vec3(-std::numeric_limits<float>::infinity()), math::vec3(std::numeric_limits<float>::infinity())};

    PlanesRegion() = default;

    /// expects: at most `max_planes`. A plane with a number that is none bounds nothing.
    explicit PlanesRegion(std::span<math::Plane const> list) noexcept {
        GNOMON_EXPECT(list.size() <= max_planes);
        for (math::Plane const& plane : list)
            if (count < max_planes) planes[count++] = math::formula_plane(plane);
    }

    /// What a view sees, relative to its eye.
    explicit PlanesRegion(math::Frustum const& frustum) noexcept : PlanesRegion(std::span<math::Plane const>(frustum.planes)) {}

    [[nodiscard]] bool may_touch(math::Aabb const& box) const noexcept { return touches(math::formula_box(box)).v; }
    template <class S>
    [[nodiscard, gnu::always_inline]] formula::Bool<S> touches(formula::GnBox<S> const& box) const noexcept {
        formula::Bool<S> touched = gn_touches_box_box({formula::Vec3<S>(bounds.lo), formula::Vec3<S>(bounds.hi)}, box);
        for (std::uint32_t i = 0; i < count; ++i) touched = touched && gn_touches_plane_box(planes[i], box);
        return touched;
    }
    template <class S>
    [[nodiscard, gnu::always_inline]] formula::Bool<S> touches(formula::GnSphere<S> const& s) const noexcept {
        formula::GnBox<S> const box{formula::Vec3<S>(bounds.lo), formula::Vec3<S>(bounds.hi)};
        formula::Bool<S> touched = gn_touches_sphere_box(s.center, gn_touch_limit(s.radius), box);
        for (std::uint32_t i = 0; i < count; ++i) touched = touched && gn_touches_plane_sphere(planes[i], s);
        return touched;
    }
};

static_assert(LaneRegion<SphereRegion> && LaneRegion<BoxRegion> && LaneRegion<PlanesRegion>);

}  // namespace gnomon::bvh
