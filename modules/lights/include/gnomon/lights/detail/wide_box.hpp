#pragma once
// A box as a light tree is asked for it: balls that the predicate of `cull` may widen until they touch the box are hits.
//
// The predicate widens a ball by 32 e (|x| + |y| + |depth| + r), e = 2^-24, and its own rounding moves what it sees by less than
// as much again (formula/ball.glsl). Here a ball is widened by 128 e of that sum, and a node's box by 128 e of the largest such
// sum of a ball in it: so the tree itself holds the lights' own radii.

#include <gnomon/bvh/region.hpp>
#include <gnomon/math/bounds.hpp>
#include <gnomon/math/touch.hpp>

namespace gnomon::lights::detail {

struct WideBox {
    math::Aabb box;

    [[nodiscard]] bool may_touch(math::Aabb const& other) const noexcept { return touches(math::formula_box(other)).v; }

    template <class S>
    [[nodiscard, gnu::always_inline]] formula::Bool<S> touches(formula::GnBox<S> const& b) const noexcept {
        formula::Float<S> const x = gn_max(-b.lo.x, b.hi.x), y = gn_max(-b.lo.y, b.hi.y), z = gn_max(-b.lo.z, b.hi.z);
        formula::Float<S> const wide = (x + y + z) * formula::Float<S>(widening);
        return b.lo.x - wide <= box.hi.x && b.hi.x + wide >= box.lo.x && b.lo.y - wide <= box.hi.y && b.hi.y + wide >= box.lo.y &&
               b.lo.z - wide <= box.hi.z && b.hi.z + wide >= box.lo.z;
    }
    template <class S>
    [[nodiscard, gnu::always_inline]] formula::Bool<S> touches_item(formula::GnBox<S> const& /*box*/) const noexcept {
        return true;
    }
    template <class S>
    [[nodiscard, gnu::always_inline]] formula::Bool<S> touches_item(formula::GnSphere<S> const& s) const noexcept {
        formula::Float<S> const size = abs(s.center.x) + abs(s.center.y) + abs(s.center.z) + s.radius;
        formula::GnBox<S> const here{formula::Vec3<S>(box.lo), formula::Vec3<S>(box.hi)};
        return gn_touches_sphere_box(s.center, gn_touch_limit(s.radius + size * formula::Float<S>(widening)), here);
    }

private:
    static constexpr float widening = 7.62939453125e-6F;  // 128 e
};

static_assert(bvh::LaneRegion<WideBox>);

}  // namespace gnomon::lights::detail
