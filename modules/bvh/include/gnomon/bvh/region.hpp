#pragma once
// What a tree can be asked for: anything that says "I may touch this box". Four come ready made.
//
// All are conservative: they may keep too much, and say no only where exact arithmetic on the same floats says no. The
// bounds stand at the tests, in gnomon/math/formula/touch.glsl and separate.glsl.

#include <gnomon/math/bounds.hpp>
#include <gnomon/math/cone.hpp>
#include <gnomon/math/lanes.hpp>
#include <gnomon/math/plane_set.hpp>
#include <gnomon/math/touch.hpp>

#include <concepts>

namespace gnomon::bvh {

/// Anything that can say "I may touch this box".
template <class R>
concept Region = requires(R const& region, math::Aabb const& box) {
    { region.may_touch(box) } noexcept -> std::same_as<bool>;
};

/// A region whose test is a formula, over floats and lanes; its children are tested side by side.
///
/// `touches` is asked for nodes and must be monotone: what it says of a box it says of every box around it, rounding
/// included. An item is a hit if `touches` says so of its box and `touches_item` of itself; so the hits do not depend on
/// the tree, and are those of brute force.
template <class R>
concept LaneRegion = Region<R> && requires(R const& region, formula::GnBox<float> const& box, formula::GnSphere<float> const& sphere) {
    { region.touches(box) } noexcept -> std::same_as<formula::Bool<float>>;
    { region.touches_item(box) } noexcept -> std::same_as<formula::Bool<float>>;
    { region.touches_item(sphere) } noexcept -> std::same_as<formula::Bool<float>>;
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
    [[nodiscard, gnu::always_inline]] formula::Bool<S> touches_item(formula::GnBox<S> const& /*box*/) const noexcept {
        return true;
    }
    template <class S>
    [[nodiscard, gnu::always_inline]] formula::Bool<S> touches_item(formula::GnSphere<S> const& s) const noexcept {
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
    [[nodiscard, gnu::always_inline]] formula::Bool<S> touches_item(formula::GnBox<S> const& /*box*/) const noexcept {
        return true;
    }
    template <class S>
    [[nodiscard, gnu::always_inline]] formula::Bool<S> touches_item(formula::GnSphere<S> const& s) const noexcept {
        return gn_touches_sphere_box(s.center, gn_touch_limit(s.radius), lanes<S>()) && formula::Bool<S>(!is_empty(box));
    }

private:
    template <class S>
    [[nodiscard, gnu::always_inline]] formula::GnBox<S> lanes() const noexcept {
        return {formula::Vec3<S>(box.lo), formula::Vec3<S>(box.hi)};
    }
};

/// The points inside several half-spaces, a frustum's for example; see math::PlaneSet.
struct PlanesRegion {
    math::PlaneSet planes;

    [[nodiscard]] bool may_touch(math::Aabb const& box) const noexcept { return touches(math::formula_box(box)).v; }
    template <class S>
    [[nodiscard, gnu::always_inline]] formula::Bool<S> touches(formula::GnBox<S> const& box) const noexcept {
        return planes.touches(box);
    }
    template <class S>
    [[nodiscard, gnu::always_inline]] formula::Bool<S> touches_item(formula::GnBox<S> const& /*box*/) const noexcept {
        return true;
    }
    template <class S>
    [[nodiscard, gnu::always_inline]] formula::Bool<S> touches_item(formula::GnSphere<S> const& s) const noexcept {
        return planes.touches(s);
    }
};

/// A cone with a round end, of any half angle up to 180 degrees: what a spot light reaches.
///
/// Nodes are tested against a pyramid of eight planes around the cone, its box and its ball, which is monotone; items
/// against the cone itself.
struct ConeRegion {
    formula::GnSector<float> sector;
    math::PlaneSet pyramid;

    explicit ConeRegion(math::Cone const& cone) noexcept;

    [[nodiscard]] bool may_touch(math::Aabb const& box) const noexcept { return touches(math::formula_box(box)).v; }
    template <class S>
    [[nodiscard, gnu::always_inline]] formula::Bool<S> touches(formula::GnBox<S> const& box) const noexcept {
        formula::GnSector<S> const s = lanes<S>();
        return pyramid.touches(box) && gn_touches_sphere_box(s.apex, gn_touch_limit(s.range), box);
    }
    template <class S>
    [[nodiscard, gnu::always_inline]] formula::Bool<S> touches_item(formula::GnBox<S> const& box) const noexcept {
        return gn_touches_sector_box(lanes<S>(), box);
    }
    template <class S>
    [[nodiscard, gnu::always_inline]] formula::Bool<S> touches_item(formula::GnSphere<S> const& s) const noexcept {
        return gn_touches_sector_sphere(lanes<S>(), s);
    }

private:
    template <class S>
    [[nodiscard, gnu::always_inline]] formula::GnSector<S> lanes() const noexcept {
        auto const each = [](formula::Vec3<float> const& v) {
            return formula::Vec3<S>(formula::Float<S>(v.x.v), formula::Float<S>(v.y.v), formula::Float<S>(v.z.v));
        };
        return {each(sector.apex), formula::Float<S>(sector.range.v), each(sector.axis), formula::Float<S>(sector.cosine.v),
                formula::Float<S>(sector.sine.v)};
    }
};

inline ConeRegion::ConeRegion(math::Cone const& cone) noexcept
    : sector(math::formula_sector(cone)), pyramid(math::pyramid_of(sector)) {}

static_assert(LaneRegion<SphereRegion> && LaneRegion<BoxRegion> && LaneRegion<PlanesRegion> && LaneRegion<ConeRegion>);

}  // namespace gnomon::bvh
