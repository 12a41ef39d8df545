#include <gnomon/check/check.hpp>
#include <gnomon/lights/shade.hpp>
#include <gnomon/math/generators.hpp>
#include <gnomon/math/lanes.hpp>

#include <array>
#include <cmath>
#include <cstdint>
#include <limits>

using namespace gnomon;

namespace {

/// splitmix64
struct ShadeRandom {
    std::uint64_t state = 1;
    float in(float low, float high) {
        std::uint64_t z = (state += 0x9E3779B97F4A7C15U);
        z = (z ^ (z >> 30U)) * 0xBF58476D1CE4E5B9U;
        z = (z ^ (z >> 27U)) * 0x94D049BB133111EBU;
        return low + (high - low) * (static_cast<float>((z ^ (z >> 31U)) >> 40U) * 0x1p-24F);
    }
    math::vec3 point(float size) { return math::vec3{in(-size, size), in(-size, size), in(-size, size)}; }
    math::vec3 direction() {
        math::vec3 const v = point(1.0F) + math::vec3(0.0F, 0.001F, 0.0F);
        return v / std::sqrt(v.x * v.x + v.y * v.y + v.z * v.z);
    }
};

struct Case {
    lights::ShadedLight light;
    lights::Surface surface;
    float range_m;
};

Case make_case(std::uint64_t seed) {
    ShadeRandom random{seed * 77 + 5};
    Case c{};
    c.range_m = random.in(0.5F, 6.0F);
    math::vec3 const at = random.point(3.0F);
    math::vec3 const color = random.point(0.5F) + math::vec3(0.6F);
    math::vec3 const axis = random.direction();
    float const outer = random.in(0.1F, 1.5F);
    c.light = seed % 3 == 0 ? lights::make_shaded_spot(at, c.range_m, color, axis, {outer * 0.5F, outer})
                            : lights::make_shaded_point(at, c.range_m, color);
    c.surface.position = random.point(3.0F);
    c.surface.normal = random.direction();
    c.surface.to_eye = random.direction();
    c.surface.diffuse = random.point(0.4F) + math::vec3(0.5F);
    c.surface.specular = random.point(0.2F) + math::vec3(0.3F);
    c.surface.shininess = static_cast<int>(seed % 11);
    return c;
}

/// The formula in double, term by term.
math::dvec3 shade_exactly(Case const& c) {
    math::dvec3 const way = math::to_double(c.light.position) - math::to_double(c.surface.position);
    double const square = glm::dot(way, way);
    math::dvec3 const l = way / std::sqrt(square);
    double const q = square / (static_cast<double>(c.range_m) * static_cast<double>(c.range_m));
    if (q >= 1.0) return math::dvec3(0.0);
    double strength = (1.0 - q * q) / square;
    if (c.light.cos_outer > -1.5F) {
        double const cosine = -glm::dot(math::to_double(c.light.axis), l);
        double const t = std::clamp((cosine - static_cast<double>(c.light.cos_outer)) * static_cast<double>(c.light.inverse_span), 0.0, 1.0);
        strength *= t * t;
    }
    math::dvec3 const n = math::to_double(c.surface.normal);
    strength *= std::max(0.0, glm::dot(n, l));
    math::dvec3 const h = glm::normalize(l + math::to_double(c.surface.to_eye));
    double const m = std::exp2(c.surface.shininess);
    double const gloss = std::pow(std::clamp(glm::dot(n, h), 0.0, 1.0), m) * (m + 8.0) / 8.0;
    return math::to_double(c.light.color) * strength * (math::to_double(c.surface.diffuse) + math::to_double(c.surface.specular) * gloss);
}

}  // namespace

TEST_CASE("what a light gives is the double formula's, to a bound that grows with the exponent of the highlight", "[lights][shade]") {
    std::size_t lit = 0;
    for (std::uint64_t seed = 0; seed < 20'000; ++seed) {
        Case const c = make_case(seed);
        math::vec3 const got = lights::shade(c.light, c.surface);
        math::dvec3 const want = shade_exactly(c);
        lit += want.x > 0.0 ? 1U : 0U;
        // The exponent multiplies the rounding of n . h; the window's end and the cone's edge lose leading digits.
        double const slack = std::ldexp(24.0, c.surface.shininess - 24);
        for (math::axis_t axis = 0; axis < 3; ++axis) {
            double const strongest = (static_cast<double>(c.light.color[axis]) * 30.0) / std::max(1e-3, static_cast<double>(want[axis]));
            CAPTURE(seed);
            REQUIRE(std::abs(static_cast<double>(got[axis]) - want[axis]) <= want[axis] * (slack + 1e-6 * strongest) + 1e-5);
        }
    }
    CHECK(lit > 1000);
}

TEST_CASE("a light at its range and beyond adds +0, and so does the far side", "[lights][shade]") {
    lights::ShadedLight const light = lights::make_shaded_point(math::vec3(0.0F, 2.0F, 0.0F), 2.0F, math::vec3(1.0F));
    lights::Surface surface;
    auto const is_plus_zero = [](math::vec3 const& v) {
        return v == math::vec3(0.0F) && !std::signbit(v.x) && !std::signbit(v.y) && !std::signbit(v.z);
    };
    CHECK(is_plus_zero(lights::shade(light, surface)));  // exactly at the range
    surface.position.y = std::nextafter(0.0F, 1.0F);
    CHECK(is_plus_zero(lights::shade(light, surface)));
    surface.position.y = 0.01F;
    CHECK(lights::shade(light, surface).x > 0.0F);
    surface.normal.y = -1.0F;
    CHECK(is_plus_zero(lights::shade(light, surface)));
    for (float const far : {-1.0F, -1e6F, -1e19F, -3e38F}) {
        surface.position = math::vec3(0.0F, far, 0.0F);
        CHECK(is_plus_zero(lights::shade(light, surface)));
    }
}

TEST_CASE("a surface at the light, one in a sun, and an endless light have finite radiance", "[lights][shade]") {
    lights::Surface surface;
    surface.specular = math::vec3(0.04F);
    lights::ShadedLight const here = lights::make_shaded_point(surface.position, 1.0F, math::vec3(1.0F));
    CHECK(std::isfinite(lights::shade(here, surface).x));
    lights::ShadedLight const sun = lights::make_shaded_directional(math::vec3(0.0F, -3.0F, 0.0F), math::vec3(2.0F));
    CHECK(lights::shade(sun, surface).x >= 2.0F);
    surface.position = math::vec3(1e7F);
    CHECK(lights::shade(sun, surface).x >= 2.0F);
    lights::ShadedLight const endless =
        lights::make_shaded_point(math::vec3(1e7F, 1e7F + 10.0F, 1e7F), std::numeric_limits<float>::infinity(), math::vec3(1.0F));
    CHECK(lights::shade(endless, surface).x > 0.0F);
}

TEST_CASE("lanes shade as one surface does, to the bit", "[lights][shade]") {
    using Group = math::Lanes<float, 8>;
    for (std::uint64_t first = 0; first < 4000; first += 8) {
        lights::ShadedLight const light = make_case(first).light;
        std::array<lights::Surface, 8> surfaces;
        float numbers[16][8];
        for (std::size_t k = 0; k < 8; ++k) {
            surfaces[k] = make_case(first + k).surface;
            lights::Surface const& s = surfaces[k];
            math::vec3 const scaled = s.specular * lights::highlight_scale(s.shininess);
            math::vec3 const* const vectors[5] = {&s.position, &s.normal, &s.to_eye, &s.diffuse, &scaled};
            for (std::size_t v = 0; v < 5; ++v)
                for (math::axis_t axis = 0; axis < 3; ++axis) numbers[3 * v + static_cast<std::size_t>(axis)][k] = (*vectors[v])[axis];
            numbers[15][k] = static_cast<float>(s.shininess);
        }
        auto const vec = [&](std::size_t v) {
            return formula::Vec3<Group>(Group::load(numbers[3 * v]), Group::load(numbers[3 * v + 1]), Group::load(numbers[3 * v + 2]));
        };
        formula::GnSurface<Group> const group{vec(0), vec(1), vec(2), vec(3), vec(4), formula::Float<Group>(Group::load(numbers[15]))};
        auto const got = gn_shade(light, group);
        for (std::size_t k = 0; k < 8; ++k) {
            math::vec3 const want = lights::shade(light, surfaces[k]);
            REQUIRE(got.x.v[k] == want.x);
            REQUIRE(got.y.v[k] == want.y);
            REQUIRE(got.z.v[k] == want.z);
        }
    }
}
