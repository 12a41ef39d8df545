#include <gnomon/check/check.hpp>
#include <gnomon/math/generators.hpp>
#include <gnomon/math/lanes.hpp>
#include <gnomon/math/touch.hpp>

#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

using namespace gnomon::check;
using namespace gnomon::math;
namespace formula = gnomon::formula;

namespace {

__extension__ typedef __float128 Quad;  // 113 bits: squares of differences of floats up to 2^30 apart are exact

Quad quad(float x) { return static_cast<Quad>(x); }

/// Squared distance of a point from a box.
Quad distance_sq(vec3 const& p, Aabb const& box) {
    Quad sum = 0;
    for (axis_t k = 0; k < 3; ++k) {
        Quad const under = quad(box.lo[k]) - quad(p[k]);
        Quad const over = quad(p[k]) - quad(box.hi[k]);
        Quad const d = under > 0 ? under : over > 0 ? over : Quad{0};
        sum += d * d;
    }
    return sum;
}

/// A sphere that just touches a point of the box's surface, or just does not: what rounding gets wrong.
struct Touching {
    Aabb box;
    Sphere sphere;
};

auto touching() {
    return [](Choices& choices) {
        Touching t;
        t.box = boxes()(choices);
        t.sphere.center = points()(choices);
        auto const d = static_cast<double>(distance_sq(t.sphere.center, t.box));
        t.sphere.radius = from_ordinal(ordinal(static_cast<float>(std::sqrt(d))) + integers(-2, 2)(choices));
        if (!(t.sphere.radius >= 0.0F)) t.sphere.radius = 0.0F;
        return t;
    };
}

}  // namespace

TEST_CASE("sphere against box misses nothing, at the last place of the radius", "[touch][property]") {
    std::uint64_t touched = 0;
    std::uint64_t kept = 0;
    for_all(cases(20000), touching(), [&](Touching const& t) {
        Quad const r = quad(t.sphere.radius);
        bool const exactly = distance_sq(t.sphere.center, t.box) <= r * r;
        bool const may = may_touch(t.sphere, t.box);
        if (exactly) CHECK(may);
        Sphere apart = t.sphere;
        apart.radius *= 0.9999F;
        if (distance_sq(t.sphere.center, t.box) > Quad{1e-30}) CHECK_FALSE(may_touch(apart, t.box));
        touched += exactly ? 1U : 0U;
        kept += may ? 1U : 0U;
    });
    CHECK(touched > 5000);
    CHECK(kept > touched);
}

TEST_CASE("two spheres miss nothing", "[touch][property]") {
    for_all(cases(20000), points(), points(), floats(0.0F, 1.0F), integers(-2, 2),
            [](vec3 const& a, vec3 const& b, float part, int step) {
                Quad d = 0;
                for (axis_t k = 0; k < 3; ++k) d += (quad(a[k]) - quad(b[k])) * (quad(a[k]) - quad(b[k]));
                auto const length = static_cast<float>(std::sqrt(static_cast<double>(d)));
                float const r = length * part;
                float const rest = from_ordinal(ordinal(length - r) + step);
                if (!(rest >= 0.0F)) return;
                Quad const reach = quad(r) + quad(rest);
                bool const may = may_touch(Sphere{a, r}, Sphere{b, rest});
                if (d <= reach * reach) CHECK(may);
                if (length > 1e-10F) CHECK_FALSE(may_touch(Sphere{a, r * 0.999F}, Sphere{b, rest * 0.999F}));
            });
}

TEST_CASE("the box of a sphere holds it, by three units of the last place at most", "[touch][property]") {
    for_all(cases(20000), points(), any_float<float>(), [](vec3 const& p, float any) {
        float const r = std::abs(any);
        if (!is_finite(r)) return;
        Aabb const box = box_of(Sphere{p, r});
        for (axis_t k = 0; k < 3; ++k) {
            CHECK(quad(box.lo[k]) <= quad(p[k]) - quad(r));
            CHECK(quad(box.hi[k]) >= quad(p[k]) + quad(r));
            CHECK(ulps_between(box.lo[k], p[k] - r) <= 3);
            CHECK(ulps_between(p[k] + r, box.hi[k]) <= 3);
        }
    });
    CHECK(is_empty(box_of(Sphere{vec3(3.0F), -1.0F})));
}

namespace {

/// n.p + o at the box's innermost corner, in 113 bits: exact in sign where it matters, as each product is.
Quad innermost(Plane const& plane, Aabb const& box) {
    Quad sum = static_cast<Quad>(plane.offset);
    for (axis_t k = 0; k < 3; ++k) {
        auto const n = static_cast<Quad>(plane.normal[k]);
        sum += n * quad(n >= 0 ? box.hi[k] : box.lo[k]);
    }
    return sum;
}

/// Planes through a corner of a box, moved by a few units of the last place of the offset.
auto plane_and_box() {
    return [](Choices& choices) {
        Aabb const box = boxes()(choices);
        Plane plane;
        plane.normal = directions()(choices) * (choices.draw(3) == 0 ? 1e-200 : 3.0);
        dvec3 corner(0.0);
        for (axis_t k = 0; k < 3; ++k) corner[k] = static_cast<double>(plane.normal[k] >= 0.0 ? box.hi[k] : box.lo[k]);
        plane.offset = -glm::dot(plane.normal, corner) * (1.0 + 1e-16 * integers(-3, 3)(choices));
        return std::pair(plane, box);
    };
}

}  // namespace

TEST_CASE("half-space against box and sphere misses nothing", "[touch][property]") {
    std::uint64_t touched = 0;
    for_all(cases(20000), plane_and_box(), floats(0.0F, 10.0F), [&](std::pair<Plane, Aabb> const& p, float r) {
        formula::GnPlane const plane = formula_plane(p.first);
        bool const exactly = innermost(p.first, p.second) >= 0;
        if (exactly) CHECK(gn_touches_plane_box(plane, formula_box(p.second)).v);
        touched += exactly ? 1U : 0U;
        // A sphere around the corner's point moved outward by its radius touches; so does its box.
        double const length = glm::length(p.first.normal);
        if (length < 1e-100) return;
        vec3 const c = to_float(to_double(p.second.lo) - p.first.normal / length * static_cast<double>(r));
        Quad n_sq = 0;
        Quad value = static_cast<Quad>(p.first.offset);
        for (axis_t k = 0; k < 3; ++k) {
            n_sq += static_cast<Quad>(p.first.normal[k]) * static_cast<Quad>(p.first.normal[k]);
            value += static_cast<Quad>(p.first.normal[k]) * quad(c[k]);
        }
        bool const sphere_touches = value >= 0 || value * value <= quad(r) * quad(r) * n_sq;
        if (sphere_touches) CHECK(gn_touches_plane_sphere(plane, formula_sphere({c, r})).v);
    });
    CHECK(touched > 5000);
    formula::GnPlane const up = formula_plane({dvec3(0.0, 2.0, 0.0), -4.0});
    CHECK_FALSE(gn_touches_plane_box(up, formula_box({vec3(0.0F), vec3(1.999F)})).v);
    CHECK_FALSE(gn_touches_plane_sphere(up, formula_sphere({vec3(0.0F), 1.999F})).v);
    CHECK(gn_touches_plane_box(formula_plane({dvec3(NAN, 0.0, 0.0), 1.0}), formula_box({vec3(0.0F), vec3(1.0F)})).v);
}

TEST_CASE("lanes of tests have the bits of one at a time", "[touch]") {
    using Eight = Lanes<float, 8>;
    std::uint64_t differ = 0;
    std::uint64_t yes = 0;
    for_all(cases(2000), array_of<8>(touching()), plane_and_box(), [&](std::array<Touching, 8> const& t, std::pair<Plane, Aabb> const& p) {
        formula::GnPlane const plane = formula_plane(p.first);
        float c[11][8];
        for (std::size_t i = 0; i < 8; ++i) {
            float const v[10] = {t[i].box.lo.x, t[i].box.lo.y, t[i].box.lo.z, t[i].box.hi.x, t[i].box.hi.y, t[i].box.hi.z,
                                 t[i].sphere.center.x, t[i].sphere.center.y, t[i].sphere.center.z, t[i].sphere.radius};
            for (std::size_t k = 0; k < 10; ++k) c[k][i] = v[k];
        }
        auto const at = [&c](std::size_t k) { return formula::Float<Eight>(Eight::load(c[k])); };
        formula::GnBox<Eight> const box{{at(0), at(1), at(2)}, {at(3), at(4), at(5)}};
        formula::GnSphere<Eight> const sphere{{at(6), at(7), at(8)}, at(9)};
        std::uint32_t const touches = bits(gn_touches_sphere_box(sphere.center, gn_touch_limit(sphere.radius), box).v);
        std::uint32_t const inside = bits(gn_touches_plane_box(plane, box).v);
        std::uint32_t const near = bits(gn_touches_plane_sphere(plane, sphere).v);
        for (std::size_t i = 0; i < 8; ++i) {
            differ += (touches >> i & 1U) != (may_touch(t[i].sphere, t[i].box) ? 1U : 0U) ? 1U : 0U;
            differ += (inside >> i & 1U) != (gn_touches_plane_box(plane, formula_box(t[i].box)).v ? 1U : 0U) ? 1U : 0U;
            differ += (near >> i & 1U) != (gn_touches_plane_sphere(plane, formula_sphere(t[i].sphere)).v ? 1U : 0U) ? 1U : 0U;
        }
        yes += static_cast<std::uint64_t>(std::popcount(touches));
    });
    CHECK(differ == 0);
    CHECK(yes > 1000);
}
