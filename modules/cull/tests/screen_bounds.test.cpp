#include <gnomon/check/check.hpp>
#include <gnomon/cull/screen_bounds.hpp>
#include <gnomon/math/generators.hpp>

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>

using namespace gnomon;
using namespace gnomon::check;

namespace {

__extension__ typedef __float128 SlopeQuad;

/// Greatest slope c / z of the disc's points before the near plane, found by trying angles on its arc, finer and finer.
double greatest_slope(double c, double z, double r, double near) {
    double best = -1e300;
    double const cosine = r > 0.0 ? (near - z) / r : 0.0;
    double const arc = cosine <= -1.0 ? 3.14159265358979323846 : std::acos(std::fmin(cosine, 1.0));
    double from = -arc;
    double to = arc;
    double at = 0.0;
    for (int round = 0; round < 12; ++round) {
        for (int i = 0; i <= 100; ++i) {
            double const a = from + (to - from) * i / 100;
            double const pz = z + r * std::cos(a);
            double const slope = pz >= near ? (c + r * std::sin(a)) / pz : -1e300;
            if (slope > best) {
                best = slope;
                at = a;
            }
        }
        double const step = (to - from) / 50;
        from = at - step;
        to = at + step;
    }
    double const chord_sq = r * r - (z - near) * (z - near);
    if (chord_sq >= 0.0) best = std::fmax(best, (c + std::sqrt(chord_sq)) / near);
    return best;
}

struct Ball : math::Sphere {};

std::string check_string(Ball const& b) { return math::check_string(b.center) + " radius " + std::to_string(b.radius); }

auto spheres_seen() {
    return [](Choices& choices) {
        Ball s;
        std::uint64_t const kind = choices.draw(5);
        float const scale = kind == 5 ? 1e6F : kind == 4 ? 1e-2F : 10.0F;
        for (math::axis_t k = 0; k < 3; ++k) s.center[k] = floats(-1.0F, 1.0F)(choices) * scale;
        auto const d = static_cast<float>(glm::length(math::to_double(s.center)));
        // Through the eye to a few units of the last place, around it, or anywhere.
        s.radius = kind == 0 ? math::from_ordinal(math::ordinal(d) + integers(-2, 2)(choices)) : floats(0.0F, 1.5F)(choices) * scale;
        return s;
    };
}

}  // namespace

TEST_CASE("every point of a sphere before the near plane lies within its screen bounds", "[cull][property]") {
    for_all(cases(20000), spheres_seen(), element_of({0.1F, 1e-3F, 1.0F}), math::directions(), floats(0.0, 1.0),
            [](Ball const& s, float near, math::dvec3 const& u, double part) {
                cull::ScreenBounds const b = cull::screen_bounds(s, near);
                double const inside = static_cast<double>(s.radius) * (1.0 - part * part * part);
                math::dvec3 p = math::to_double(s.center) + u * (inside * (1.0 - 1e-15));
                math::dvec3 const off = p - math::to_double(s.center);
                if (off.x * off.x + off.y * off.y + off.z * off.z > static_cast<double>(s.radius) * static_cast<double>(s.radius)) return;
                if (p.z < static_cast<double>(near)) return;
                for (math::axis_t k = 0; k < 2; ++k) {
                    auto const slope = static_cast<SlopeQuad>(p[k]) / static_cast<SlopeQuad>(p.z);
                    CHECK(slope <= static_cast<SlopeQuad>(b.hi[k]));
                    CHECK(slope >= static_cast<SlopeQuad>(b.lo[k]));
                }
            });
}

TEST_CASE("screen bounds are the tangents, to a few units of the last place", "[cull][property]") {
    std::uint64_t seen = 0;
    for_all(cases(1500), spheres_seen(), element_of({0.1F, 0.01F, 1.0F}), [&](Ball const& s, float near) {
        cull::ScreenBounds const b = cull::screen_bounds(s, near);
        auto const c = math::to_double(s.center);
        auto const r = static_cast<double>(s.radius);
        auto const n = static_cast<double>(near);
        if (c.z + r < n) {
            CHECK(b.empty());
            return;
        }
        ++seen;
        for (math::axis_t k = 0; k < 2; ++k) {
            double const high = greatest_slope(c[k], c.z, r, n);
            double const low = -greatest_slope(-c[k], c.z, r, n);
            double const slack = 1e-6 * (1.0 + std::abs(high) + std::abs(low) + r / n * 0.1) * (1.0 + 1e-7 * (glm::length(c) + r) / n);
            CHECK(static_cast<double>(b.hi[k]) >= high - 1e-12 * (1.0 + std::abs(high)));
            CHECK(static_cast<double>(b.hi[k]) <= high + slack);
            CHECK(static_cast<double>(b.lo[k]) <= low + 1e-12 * (1.0 + std::abs(low)));
            CHECK(static_cast<double>(b.lo[k]) >= low - slack);
        }
    });
    CHECK(seen > 500);
}

TEST_CASE("spheres that are none, or behind, have empty bounds", "[cull]") {
    float const nan = std::numeric_limits<float>::quiet_NaN();
    CHECK(cull::screen_bounds({math::vec3(0.0F, 0.0F, -5.0F), 4.0F}, 0.1F).empty());
    CHECK(cull::screen_bounds({math::vec3(0.0F, 0.0F, 5.0F), -1.0F}, 0.1F).empty());
    CHECK(cull::screen_bounds({math::vec3(nan, 0.0F, 5.0F), 1.0F}, 0.1F).empty());
    CHECK(cull::screen_bounds({math::vec3(0.0F, 0.0F, 5.0F), nan}, 0.1F).empty());
    CHECK(cull::screen_bounds({math::vec3(0.0F, 0.0F, 5.0F), 1.0F}, nan).empty());
    CHECK_FALSE(cull::screen_bounds({math::vec3(0.0F, 0.0F, -5.0F), 5.2F}, 0.1F).empty());
    cull::ScreenBounds const flat = cull::screen_bounds_orthographic({math::vec3(3.0F, -2.0F, -9.0F), 1.0F});
    CHECK((flat.lo.x <= 2.0F && flat.hi.x >= 4.0F && flat.lo.y <= -3.0F && flat.hi.y >= -1.0F && flat.hi.x < 4.00001F));
}
