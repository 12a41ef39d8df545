#include <gnomon/check/check.hpp>
#include <gnomon/cull/shapes.hpp>
#include <gnomon/math/generators.hpp>
#include <gnomon/math/lanes.hpp>

#include "cone_oracle.hpp"
#include "light_scenes.hpp"
#include "oracle.hpp"

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <limits>
#include <string>

using namespace gnomon;
using namespace gnomon::check;

namespace {

__extension__ typedef __float128 Quad;
using Point = std::array<Quad, 3>;

constexpr float infinity = std::numeric_limits<float>::infinity();

/// A cluster of any view and one of its points, in exact arithmetic: a corner, on an edge, on a face or inside.
struct Spot {
    cull::Cell cell;
    Point point;
};

std::string check_string(Spot const& s) {
    auto const& b = s.cell.borders;
    char text[200];
    std::snprintf(text, sizeof text, "%s x %.9g..%.9g y %.9g..%.9g depth %.9g..%.9g at (%.9g %.9g %.9g)", s.cell.perspective ? "persp" : "ortho",
                  static_cast<double>(b.left.v), static_cast<double>(b.right.v), static_cast<double>(b.top.v),
                  static_cast<double>(b.bottom.v), static_cast<double>(b.near.v), static_cast<double>(b.far.v),
                  static_cast<double>(s.point[0]), static_cast<double>(s.point[1]), static_cast<double>(s.point[2]));
    return text;
}

float between(Choices& choices, float lo, float hi) {
    float const low = math::is_finite(lo) ? lo : math::is_finite(hi) ? hi - 3.0F : -3.0F;
    float const high = math::is_finite(hi) ? hi : low + 3.0F * (1.0F + std::abs(low));
    std::uint64_t const kind = choices.draw(3);
    float const part = floats(0.0F, 1.0F)(choices);
    float const x = kind == 0 ? low : kind == 1 ? high : low + part * (high - low);
    return std::fmin(std::fmax(x, low), high);
}

auto spots() {
    return [](Choices& choices) {
        Spot s;
        s.cell.perspective = choices.draw(3) != 0;
        float const unit = s.cell.perspective ? 1.0F : 100.0F;
        auto const borders = [&](float& lo, float& hi) {
            lo = floats(-2.0F, 2.0F)(choices) * unit;
            std::uint64_t const kind = choices.draw(7);
            hi = kind == 7 ? infinity : lo + (kind == 6 ? 1e-4F : floats(1e-3F, 1.0F)(choices)) * unit;
            if (choices.draw(15) == 15) lo = -infinity;
            if (!(lo < hi)) hi = math::next_up(lo);
        };
        float x0 = 0, x1 = 0, y0 = 0, y1 = 0;
        borders(x0, x1);
        borders(y0, y1);
        float const near = element_of({0.1F, 1e-3F, 5.0F, 100.0F, 1e4F, 1e7F})(choices);
        std::uint64_t const kind = choices.draw(7);
        float const far = kind == 7 ? infinity : near * floats(1.01F, 3.0F)(choices);
        s.cell.borders = {x0, x1, y0, y1, near, far};
        float const d = between(choices, near, far);
        float const x = between(choices, x0, x1);
        float const y = between(choices, y0, y1);
        Quad const scale = s.cell.perspective ? Quad{d} : Quad{1};
        s.point = {Quad{x} * scale, Quad{y} * scale, Quad{d}};
        return s;
    };
}

float around(Choices& choices, Quad at) {
    auto const near = static_cast<float>(at);
    switch (choices.draw(5)) {
        case 0: return near;
        case 1: return near + floats(-1.0F, 1.0F)(choices);
        case 2: return -near;  // behind the camera, or on the other side
        case 3: return 0.0F;   // the camera
        case 4: return near * floats(0.5F, 2.0F)(choices);
        default: return math::coordinates()(choices);
    }
}

math::vec3 place_around(Choices& choices, Point const& p) {
    float const x = around(choices, p[0]);
    float const y = around(choices, p[1]);
    float const z = around(choices, p[2]);
    return math::vec3(x, y, z);
}

Point minus(Point const& p, math::vec3 const& c) { return {p[0] - Quad{c.x}, p[1] - Quad{c.y}, p[2] - Quad{c.z}}; }

Quad dot(Point const& a, Point const& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

/// The least float whose square is at least `square`.
float root_up(Quad square) {
    auto r = static_cast<float>(std::sqrt(static_cast<double>(square)));
    while (r > 0.0F && Quad{math::next_down(r)} * Quad{math::next_down(r)} >= square) r = math::next_down(r);
    while (Quad{r} * Quad{r} < square) r = math::next_up(r);
    return r;
}

}  // namespace

TEST_CASE("a sphere that holds a point of a cluster, by the last place of its radius, touches it", "[cull][property]") {
    for_all(cases(20000), [](Choices& choices) {
        Spot const spot = spots()(choices);
        math::vec3 const c = place_around(choices, spot.point);
        return std::pair(spot, c);
    }, [](std::pair<Spot, math::vec3> const& at) {
        Point const v = minus(at.first.point, at.second);
        float const r = root_up(dot(v, v));
        CHECK(cull::may_touch(math::Sphere{at.second, r}, at.first.cell));
    });
}

namespace {

struct Aimed {
    Spot spot;
    math::Cone cone;
};

std::string check_string(Aimed const& a) {
    return check_string(a.spot) + " cone from " + math::check_string(a.cone.apex) + " along " + math::check_string(a.cone.axis) +
           " range " + std::to_string(a.cone.range) + " angle " + std::to_string(a.cone.half_angle_rad);
}

/// A cone whose border goes through the point, moved outward by less than the last place of its angle and range.
auto aimed_cones() {
    return [](Choices& choices) {
        Aimed a;
        a.spot = spots()(choices);
        a.cone.apex = place_around(choices, a.spot.point);
        Point const v = minus(a.spot.point, a.cone.apex);
        math::dvec3 const to(static_cast<double>(v[0]), static_cast<double>(v[1]), static_cast<double>(v[2]));
        double const length = glm::length(to);
        double const degrees = element_of({0.0, 1e-3, 15.0, 45.0, 89.9, 90.0, 90.1, 120.0, 179.99, 180.0})(choices);
        math::dvec3 const side = math::directions()(choices);
        math::dvec3 const u = length > 0.0 ? to / length : math::dvec3(0.0, 0.0, 1.0);
        math::dvec3 across = glm::cross(u, side);
        across = glm::length(across) > 1e-9 ? glm::normalize(across) : math::dvec3(u.y, -u.x, 0.0);
        double const angle = degrees * 3.14159265358979323846 / 180;
        double const scale = element_of({1.0, 1.0, 1e-3, 50.0})(choices);
        a.cone.axis = math::to_float((u * std::cos(angle) + across * std::sin(angle)) * scale);
        if (glm::length(math::to_double(a.cone.axis)) < 1e-6) a.cone.axis = math::vec3(1.0F, 0.0F, 0.0F);
        a.cone.range = choices.draw(3) == 0 ? root_up(dot(v, v)) * 4.0F : root_up(dot(v, v));
        // The angle, to 64 bits, by the arc tangent of cross and dot product.
        long double c[3], d = 0;
        math::dvec3 const w = math::to_double(a.cone.axis);
        long double const p[3] = {static_cast<long double>(v[0]), static_cast<long double>(v[1]), static_cast<long double>(v[2])};
        long double const q[3] = {w.x, w.y, w.z};
        for (std::size_t k = 0; k < 3; ++k) {
            c[k] = p[(k + 1) % 3] * q[(k + 2) % 3] - p[(k + 2) % 3] * q[(k + 1) % 3];
            d += p[k] * q[k];
        }
        long double const exact = std::atan2(std::sqrt(c[0] * c[0] + c[1] * c[1] + c[2] * c[2]), d) + 1e-17L;
        a.cone.half_angle_rad = static_cast<float>(exact);
        if (static_cast<long double>(a.cone.half_angle_rad) < exact) a.cone.half_angle_rad = math::next_up(a.cone.half_angle_rad);
        return a;
    };
}

}  // namespace

TEST_CASE("a cone of any angle whose border goes through a point of a cluster touches it", "[cull][property]") {
    for_all(cases(20000), aimed_cones(), [](Aimed const& a) {
        auto const sector = math::formula_sector(a.cone);
        for (int steps : {0, 1, 2, 5}) CHECK(cull::may_touch(sector, a.spot.cell, steps));
        math::vec3 const lo(static_cast<float>(a.spot.point[0]), static_cast<float>(a.spot.point[1]), static_cast<float>(a.spot.point[2]));
        math::Aabb box{lo, lo};
        for (math::axis_t k = 0; k < 3; ++k) {  // a box that holds the point in a corner
            if (Quad{box.lo[k]} > a.spot.point[static_cast<std::size_t>(k)]) box.lo[k] = math::next_down(box.lo[k]);
            if (Quad{box.hi[k]} < a.spot.point[static_cast<std::size_t>(k)]) box.hi[k] = math::next_up(box.hi[k]);
        }
        CHECK(math::may_touch(sector, box));
        box.hi += math::vec3(1.0F);
        CHECK(math::may_touch(sector, box));
        CHECK(cull::may_touch(box, a.spot.cell));
        CHECK(math::may_touch(sector, math::Sphere{lo, root_up(dot(minus(a.spot.point, lo), minus(a.spot.point, lo)))}));
    });
}

namespace {

/// Coordinates of a vector in three axes, by Cramer's rule in 113 bits; false where they are nearly in a plane.
bool coordinates_in(std::array<math::vec3, 3> const& axes, Point const& v, Point& out) {
    Point a[3];
    for (std::size_t i = 0; i < 3; ++i) a[i] = {Quad{axes[i].x}, Quad{axes[i].y}, Quad{axes[i].z}};
    auto const cross = [](Point const& p, Point const& q) {
        return Point{p[1] * q[2] - p[2] * q[1], p[2] * q[0] - p[0] * q[2], p[0] * q[1] - p[1] * q[0]};
    };
    Quad const volume = dot(a[0], cross(a[1], a[2]));
    Quad const size = dot(a[0], a[0]) + dot(a[1], a[1]) + dot(a[2], a[2]);
    if (volume * volume < Quad{1e-12} * size * size * size) return false;
    for (std::size_t i = 0; i < 3; ++i) out[i] = dot(v, cross(a[(i + 1) % 3], a[(i + 2) % 3])) / volume;
    return true;
}

Quad size_of(Quad x) { return x < 0 ? -x : x; }

}  // namespace

TEST_CASE("a box of any orientation that holds a point of a cluster in a face touches it", "[cull][property]") {
    std::uint64_t tried = 0;
    for_all(cases(10000), [](Choices& choices) {
        Spot const spot = spots()(choices);
        math::vec3 const c = place_around(choices, spot.point);
        math::dvec3 const x = math::directions()(choices);
        math::dvec3 const some = math::directions()(choices);
        math::dvec3 y = glm::cross(x, some);
        y = glm::length(y) > 1e-6 ? glm::normalize(y) : glm::normalize(glm::cross(x, math::dvec3(x.y + 1.0, -x.x, 0.3)));
        math::dvec3 const z = glm::cross(x, y);
        double const a = floats(0.01, 10.0)(choices);
        double const b = floats(0.01, 10.0)(choices);
        return std::tuple(spot, c, std::array<math::vec3, 3>{math::to_float(x * a), math::to_float(y * b), math::to_float(z)});
    }, [&](std::tuple<Spot, math::vec3, std::array<math::vec3, 3>> const& at) {
        auto const& [spot, c, unscaled] = at;
        std::array<math::vec3, 3> axes = unscaled;
        Point u{};
        if (!coordinates_in(axes, minus(spot.point, c), u)) return;
        for (int round = 0; round < 4; ++round) {  // grow the axes until the point is in a face, or just inside
            bool inside = true;
            for (std::size_t i = 0; i < 3; ++i) {
                if (!(size_of(u[i]) > 1)) continue;
                axes[i] = math::to_float(math::to_double(axes[i]) * (static_cast<double>(size_of(u[i])) * (1.0 + 1e-7 * round)));
                inside = false;
            }
            if (inside || !coordinates_in(axes, minus(spot.point, c), u)) break;
        }
        if (!(size_of(u[0]) <= 1 && size_of(u[1]) <= 1 && size_of(u[2]) <= 1)) return;
        ++tried;
        auto const crate = cull::make_crate(c, axes[0], axes[1], axes[2]);
        CHECK(cull::may_touch(crate, spot.cell));
        float const reach = 0.5F + std::abs(static_cast<float>(spot.point[0])) * 1e-6F;
        math::vec3 const p(static_cast<float>(spot.point[0]), static_cast<float>(spot.point[1]), static_cast<float>(spot.point[2]));
        math::vec3 const lo = p - math::vec3(reach, 1e-6F * std::abs(p.y), 1e-6F * std::abs(p.z));
        math::vec3 const hi = p + math::vec3(1e-6F * std::abs(p.x), 1e-6F * std::abs(p.y) + reach, 1e-6F * std::abs(p.z));
        CHECK(cull::may_touch(crate, math::Aabb{lo, hi}));
    });
    CHECK(tried > 5000);
}

TEST_CASE("shapes that are none touch no cluster", "[cull]") {
    test::YardGrid const yard;
    cull::Cell const cell = cull::cell_of(yard.view(), 13, 7, 5);
    float const nan = std::numeric_limits<float>::quiet_NaN();
    for (float const bad : {nan, infinity, -infinity}) {
        CHECK_FALSE(cull::may_touch(math::Sphere{math::vec3(0.0F, bad, 9.0F), 100.0F}, cell));
        CHECK_FALSE(cull::may_touch(math::Sphere{math::vec3(0.0F), bad}, cell));
        CHECK_FALSE(cull::may_touch(math::formula_sector({math::vec3(bad, 0.0F, 0.0F), 100.0F, math::vec3(1.0F), 1.0F}), cell));
        CHECK_FALSE(cull::may_touch(math::formula_sector({math::vec3(0.0F), bad, math::vec3(1.0F), 1.0F}), cell));
        CHECK_FALSE(cull::may_touch(math::formula_sector({math::vec3(0.0F), 100.0F, math::vec3(bad), 1.0F}), cell));
        CHECK_FALSE(cull::may_touch(math::Aabb{math::vec3(-1e3F), math::vec3(1e3F, bad, 1e3F)}, cell));
        CHECK_FALSE(cull::may_touch(cull::make_crate(math::vec3(0.0F), math::vec3(bad), math::vec3(1e3F), math::vec3(1e3F)), cell));
    }
    CHECK_FALSE(cull::may_touch(math::formula_sector({math::vec3(0.0F), 100.0F, math::vec3(1.0F), nan}), cell));
    CHECK_FALSE(cull::may_touch(math::formula_sector({math::vec3(0.0F), 100.0F, math::vec3(0.0F), 1.0F}), cell));
    CHECK(cull::may_touch(math::formula_sector({math::vec3(0.0F), 100.0F, math::vec3(0.0F, 0.0F, 1.0F), 0.0F}), cell));
    CHECK(cull::may_touch(math::formula_sector({math::vec3(0.0F), 100.0F, math::vec3(0.0F, 0.0F, -1.0F), infinity}), cell));
    CHECK(cull::may_touch(math::Sphere{math::vec3(0.0F), 1e30F}, cell));
}

TEST_CASE("eight clusters at a time get the verdicts of one at a time", "[cull]") {
    using Eight = math::Lanes<float, 8>;
    test::YardGrid const yard;
    auto const grid = yard.view();
    std::size_t differ = 0;
    std::size_t yes = 0;
    for (auto const& light : test::make_lights(test::light_scenes[2], 40)) {
        auto const sector = math::formula_sector({light.center, light.range, light.axis, light.half_angle_rad});
        auto const wide = [](formula::Float<float> const& x) { return formula::Float<Eight>(x.v); };
        auto const wide3 = [&](formula::Vec3<float> const& v) { return formula::Vec3<Eight>(wide(v.x), wide(v.y), wide(v.z)); };
        formula::GnSector<Eight> const sectors{wide3(sector.apex), wide(sector.range), wide3(sector.axis), wide(sector.cosine), wide(sector.sine)};
        formula::GnSphere<Eight> const spheres{wide3(sector.apex), wide(sector.range)};
        for (std::uint32_t slice = 0; slice < grid.slices(); ++slice)
            for (std::uint32_t row = 0; row < grid.rows(); row += 3) {
                formula::GnCell<Eight> const cells{Eight::load(grid.x.data() + 9), Eight::load(grid.x.data() + 10), grid.y[row], grid.y[row + 1],
                                                   grid.depth_m[slice], grid.depth_m[slice + 1]};
                std::uint32_t const cone = bits(gn_touches_sector_cell(sectors, cells, true, 2).v);
                std::uint32_t const ball = bits(gn_touches_sphere_cell(spheres, cells, true).v);
                for (std::uint32_t i = 0; i < 8; ++i) {
                    cull::Cell const cell = cull::cell_of(grid, 9 + i, row, slice);
                    differ += (cone >> i & 1U) != (cull::may_touch(sector, cell) ? 1U : 0U) ? 1U : 0U;
                    differ += (ball >> i & 1U) != (cull::may_touch(math::Sphere{light.center, light.range}, cell) ? 1U : 0U) ? 1U : 0U;
                    yes += (cone | ball) >> i & 1U;
                }
            }
    }
    CHECK(differ == 0);
    CHECK(yes > 100);
}

namespace {

struct Count {
    std::size_t exact = 0, kept = 0, missed = 0, undecided = 0;

    void add(test::Touch truth, bool may) {
        exact += truth == test::Touch::yes ? 1U : 0U;
        undecided += truth == test::Touch::undecided ? 1U : 0U;
        kept += may ? 1U : 0U;
        missed += truth == test::Touch::yes && !may ? 1U : 0U;
    }
    [[nodiscard]] double surplus() const { return static_cast<double>(kept) / static_cast<double>(exact) - 1.0; }
};

/// Every cluster of the yardstick's grid against every light, balls and cones.
template <class Verdict>
Count count_pairs(test::LightScene const& scene, std::size_t lights, Verdict const& verdict) {
    test::YardGrid const yard;
    auto const grid = yard.view();
    Count count;
    for (auto const& light : test::make_lights(scene, lights))
        for (std::uint32_t slice = 0; slice < grid.slices(); ++slice) {
            if (grid.depth_m[slice] > light.center.z + light.range * 1.001F || grid.depth_m[slice + 1] < light.center.z - light.range * 1.001F) continue;
            for (std::uint32_t row = 0; row < grid.rows(); ++row)
                for (std::uint32_t column = 0; column < grid.columns(); ++column) verdict(count, grid, light, test::Cell{column, row, slice});
        }
    return count;
}

Count count_balls(test::LightScene const& scene, std::size_t lights) {
    return count_pairs(scene, lights, [](Count& count, cluster::GridView const& grid, test::SceneLight const& light, test::Cell c) {
        bool const may = cull::may_touch(math::Sphere{light.center, light.range}, cull::cell_of(grid, c.column, c.row, c.slice));
        count.add(test::ball_touches(grid, c, light.center, light.range), may);
    });
}

Count count_cones(test::LightScene const& scene, std::size_t lights, int steps) {
    return count_pairs(scene, lights, [steps](Count& count, cluster::GridView const& grid, test::SceneLight const& light, test::Cell c) {
        math::Cone const cone{light.center, light.range, light.axis, light.half_angle_rad};
        bool const may = cull::may_touch(math::formula_sector(cone), cull::cell_of(grid, c.column, c.row, c.slice), steps);
        count.add(test::cone_touches(grid, c, cone), may);
    });
}

}  // namespace

namespace {

using Real3 = std::array<double, 3>;

Real3 cross(Real3 const& a, Real3 const& b) {
    return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

/// Whether two convex bodies of eight corners are apart along one of the directions that decide: normals and edge crosses.
bool apart_along(std::array<Real3, 8> const& a, std::array<Real3, 8> const& b, Real3 const& n) {
    double a_lo = 1e300, a_hi = -1e300, b_lo = 1e300, b_hi = -1e300;
    for (std::size_t i = 0; i < 8; ++i) {
        double const p = a[i][0] * n[0] + a[i][1] * n[1] + a[i][2] * n[2];
        double const q = b[i][0] * n[0] + b[i][1] * n[1] + b[i][2] * n[2];
        a_lo = std::fmin(a_lo, p);
        a_hi = std::fmax(a_hi, p);
        b_lo = std::fmin(b_lo, q);
        b_hi = std::fmax(b_hi, q);
    }
    return a_hi < b_lo || b_hi < a_lo;
}

bool corners_touch(std::array<Real3, 8> const& a, std::array<Real3, 8> const& b) {
    auto const edges = [](std::array<Real3, 8> const& c) {
        std::array<Real3, 12> e{};
        std::size_t n = 0;
        for (std::size_t i = 0; i < 8; ++i)
            for (std::size_t bit = 1; bit < 8; bit *= 2)
                if ((i & bit) == 0) e[n++] = {c[i | bit][0] - c[i][0], c[i | bit][1] - c[i][1], c[i | bit][2] - c[i][2]};
        return e;
    };
    auto const ea = edges(a);
    auto const eb = edges(b);
    for (auto const& list : {ea, eb})
        for (std::size_t i = 0; i < 12; ++i)
            for (std::size_t j = 0; j < i; ++j)
                if (apart_along(a, b, cross(list[i], list[j]))) return false;
    for (auto const& x : ea)
        for (auto const& y : eb)
            if (apart_along(a, b, cross(x, y))) return false;
    return true;
}

std::array<Real3, 8> corners_of(formula::GnCell<float> const& c) {
    std::array<Real3, 8> p{};
    for (std::size_t i = 0; i < 8; ++i) {
        auto const d = static_cast<double>((i & 4U) != 0 ? c.far.v : c.near.v);
        p[i] = {static_cast<double>((i & 1U) != 0 ? c.right.v : c.left.v) * d, static_cast<double>((i & 2U) != 0 ? c.bottom.v : c.top.v) * d, d};
    }
    return p;
}

/// A box in a light's place, turned along its axis, as long as its range and a third and a fifth as wide.
struct TurnedBox {
    math::vec3 center;
    std::array<math::vec3, 3> half;

    explicit TurnedBox(test::SceneLight const& light) : center(light.center) {
        math::dvec3 const z = glm::normalize(math::to_double(light.axis));
        math::dvec3 const x = glm::normalize(glm::cross(z, std::abs(z.x) < 0.6 ? math::dvec3(1.0, 0.0, 0.0) : math::dvec3(0.0, 1.0, 0.0)));
        auto const r = static_cast<double>(light.range);
        half = {math::to_float(x * (r / 3)), math::to_float(glm::cross(z, x) * (r / 5)), math::to_float(z * r)};
    }
    [[nodiscard]] std::array<Real3, 8> corners() const {
        std::array<Real3, 8> p{};
        for (std::size_t i = 0; i < 8; ++i)
            for (std::size_t k = 0; k < 3; ++k) {
                auto const a = static_cast<math::axis_t>(k);
                p[i][k] = static_cast<double>(center[a]);
                for (std::size_t h = 0; h < 3; ++h) p[i][k] += static_cast<double>(half[h][a]) * ((i >> h & 1U) != 0 ? 1.0 : -1.0);
            }
        return p;
    }
};

Count count_crates(test::LightScene const& scene, std::size_t lights) {
    return count_pairs(scene, lights, [](Count& count, cluster::GridView const& grid, test::SceneLight const& light, test::Cell c) {
        TurnedBox const box(light);
        cull::Cell const cell = cull::cell_of(grid, c.column, c.row, c.slice);
        bool const may = cull::may_touch(cull::make_crate(box.center, box.half[0], box.half[1], box.half[2]), cell);
        bool const near = cull::may_touch(math::Sphere{light.center, light.range * 1.2F}, cell);
        bool const touches = near && corners_touch(box.corners(), corners_of(cell.borders));
        count.add(touches ? test::Touch::yes : test::Touch::no, may);
    });
}

/// Cones against the box around each cluster, as if it were the bounds of its samples.
Count count_cones_and_boxes(test::LightScene const& scene, std::size_t lights) {
    return count_pairs(scene, lights, [](Count& count, cluster::GridView const& grid, test::SceneLight const& light, test::Cell c) {
        auto const corners = corners_of(cull::cell_of(grid, c.column, c.row, c.slice).borders);
        math::Aabb box;
        for (auto const& p : corners) box = math::extended(box, math::to_float(math::dvec3(p[0], p[1], p[2])));
        math::Cone const cone{light.center, light.range, light.axis, light.half_angle_rad};
        int budget = 20000;
        math::dvec3 const lo = math::to_double(box.lo);
        math::dvec3 const hi = math::to_double(box.hi);
        count.add(test::ConeOracle(cone, false).touches({lo.x, lo.y, lo.z}, {hi.x, hi.y, hi.z}, budget),
                  math::may_touch(math::formula_sector(cone), box));
    });
}

}  // namespace

TEST_CASE("boxes of any orientation, and cones against boxes, are kept without need in few pairs", "[cull]") {
    Count const crates = count_crates(test::light_scenes[0], 24);
    CHECK(crates.missed == 0);
    CHECK(crates.exact > 40);
    CHECK(crates.surplus() < 0.1);
    Count const cones = count_cones_and_boxes(test::light_scenes[2], 8);
    CHECK(cones.missed == 0);
    CHECK(cones.exact > 50);
    CHECK(cones.surplus() < 0.15);
}

TEST_CASE("of the yardstick's pairs none is missed, and hardly one is kept without need", "[cull]") {
    Count const balls = count_balls(test::light_scenes[0], 64);
    CHECK(balls.exact == 259);
    CHECK(balls.missed == 0);
    CHECK(balls.kept <= 260);
    Count const cones = count_cones(test::light_scenes[2], 24, cull::cone_steps);
    CHECK(cones.missed == 0);
    CHECK(cones.exact > 100);
    CHECK(cones.surplus() < 0.1);
}

TEST_CASE("pairs of all of the yardstick's scenes", "[.full][cull]") {
    for (auto const& scene : test::light_scenes) {
        Count const balls = count_balls(scene, 256);
        CHECK(balls.missed == 0);
        std::printf("%-6s balls: %zu exact, %zu kept\n", scene.name, balls.exact, balls.kept);
        Count const crates = count_crates(scene, 256);
        CHECK(crates.missed == 0);
        std::printf("%-6s turned boxes: %zu exact, %zu kept, %.1f %% too many\n", scene.name, crates.exact, crates.kept, 100.0 * crates.surplus());
        Count const boxed = count_cones_and_boxes(scene, 64);
        CHECK(boxed.missed == 0);
        std::printf("%-6s cones and boxes, 64 lights: %zu exact, %zu kept, %.1f %% too many\n", scene.name, boxed.exact, boxed.kept,
                    100.0 * boxed.surplus());
        for (int steps : {1, 2, 3, 5}) {
            Count const cones = count_cones(scene, 256, steps);
            CHECK(cones.missed == 0);
            std::printf("%-6s cones, %d steps: %zu exact (%zu undecided), %zu kept, %.1f %% too many\n", scene.name, steps, cones.exact,
                        cones.undecided, cones.kept, 100.0 * cones.surplus());
        }
    }
}
