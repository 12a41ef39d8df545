#include <gnomon/check/check.hpp>

#include <gnomon/sample/reconstruct.hpp>

#include "../../predicates/tests/hard_floats.hpp"

#include <algorithm>
#include <cmath>

using namespace gnomon;

namespace {

struct Wide {
    long double x, y, z;
};

Wide wide(math::dvec3 const& p) { return {p.x, p.y, p.z}; }
Wide wide(math::vec3 const& p) { return wide(math::to_double(p)); }
Wide operator-(Wide const& a, Wide const& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
Wide operator+(Wide const& a, Wide const& b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
Wide operator*(Wide const& a, long double s) { return {a.x * s, a.y * s, a.z * s}; }
long double dot(Wide const& a, Wide const& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
Wide cross(Wide const& a, Wide const& b) {
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

/// A view, a triangle before it, and an image point, as hard as `k` says: far from work space's zero, thin, edge on.
struct ReconstructCase {
    math::View view;
    sample::Triangle triangle;
    math::vec2 px;
};

ReconstructCase reconstruct_case(hard::Random& random, int k) {
    auto const unit = [&] { return random.uniform(-1.0F, 1.0F); };
    auto const real = [&] { return static_cast<double>(unit()); };
    ReconstructCase c;
    float const offset = k % 3 == 0 ? 1000.0F : 0.0F;
    math::dvec3 const eye = math::dvec3{offset + 10.0F * unit(), 5.0F * unit(), offset * unit()};
    math::dvec3 const target = eye + math::dvec3{real(), 0.5 * real(), real() - 1.5} * 20.0;
    if (k % 2 == 0) {
        math::PerspectiveConfig config;
        config.eye_m = eye;
        config.target_m = target;
        config.size_px = math::ivec2(1024, 768);
        c.view = math::make_perspective(config).value();
    } else {
        math::OrthographicConfig config;
        config.eye_m = eye;
        config.target_m = target;
        config.window_m = {-12.0, 12.0, -9.0, 9.0};
        config.far_m = 100.0;
        config.size_px = math::ivec2(1024, 768);
        c.view = math::make_orthographic(config).value();
    }
    c.px = math::vec2{random.uniform(0.0F, 1024.0F), random.uniform(0.0F, 768.0F)};
    math::PixelRay const ray = math::pixel_ray(c.view, math::dvec2(static_cast<double>(c.px.x), static_cast<double>(c.px.y)));
    math::vec3 const hit = math::to_float(eye + ray.start_m + ray.step * (10.0 + 9.0 * real()));
    float const size = k % 5 == 0 ? 0.02F : 1.5F;
    math::vec3 const along = math::to_float(ray.step);
    c.triangle[0] = hit + math::vec3{unit(), unit(), unit()} * size;
    c.triangle[1] = hit + math::vec3{unit(), unit(), unit()} * size;
    c.triangle[2] = hit * 3.0F - c.triangle[0] - c.triangle[1];  // the ray goes through the middle
    if (k % 7 == 0) c.triangle[1] = c.triangle[0] + along * size + math::vec3{unit(), unit(), unit()} * (size * 1e-3F);
    if (k % 11 == 0) c.triangle[2] = (c.triangle[0] + c.triangle[1]) * 0.5F + math::vec3{unit(), unit(), unit()} * 1e-3F;
    return c;
}

struct ExactPlane {
    Wide crossing;
    Wide normal;
};

ExactPlane exact_plane(ReconstructCase const& c) {
    math::PixelRay const ray = math::pixel_ray(c.view, math::dvec2(static_cast<double>(c.px.x), static_cast<double>(c.px.y)));
    Wide const start = wide(c.view.eye_m) + wide(ray.start_m);
    Wide const a = wide(c.triangle[0]);
    Wide const n = cross(wide(c.triangle[1]) - a, wide(c.triangle[2]) - a);
    long double const t = dot(n, a - start) / dot(n, wide(ray.step));
    return {start + wide(ray.step) * t, n * (1.0L / std::sqrt(dot(n, n)))};
}

long double limited(long double p, float a, float b, float c) {
    return std::clamp(p, static_cast<long double>(std::min({a, b, c})), static_cast<long double>(std::max({a, b, c})));
}

}  // namespace

TEST_CASE("a reconstructed sample is within its own bound of the exact crossing, and its normal too", "[sample][reconstruct]") {
    hard::Random random{71};
    int usable = 0;
    int fine = 0;
    long double closest = 0.0L;  // of error to bound
    for (int k = 0; k < 60000; ++k) {
        ReconstructCase const c = reconstruct_case(random, k);
        auto const made = sample::reconstruct(sample::make_ray_camera(c.view, math::dvec3(0.0)), c.px, c.triangle);
        if (!made.usable) continue;
        ++usable;
        ExactPlane const exact = exact_plane(c);
        sample::Triangle const& t = c.triangle;
        Wide const p{limited(exact.crossing.x, t[0].x, t[1].x, t[2].x), limited(exact.crossing.y, t[0].y, t[1].y, t[2].y),
                     limited(exact.crossing.z, t[0].z, t[1].z, t[2].z)};
        Wide const off = wide(made.position) - p;
        Wide const bound = wide(made.error);
        CAPTURE(k);
        CHECK(std::abs(off.x) <= bound.x);
        CHECK(std::abs(off.y) <= bound.y);
        CHECK(std::abs(off.z) <= bound.z);
        Wide const turn = wide(made.normal) - exact.normal;
        CHECK(std::sqrt(dot(turn, turn)) <= static_cast<long double>(made.normal_error));
        closest = std::max({closest, std::abs(off.x) / bound.x, std::abs(off.y) / bound.y, std::abs(off.z) / bound.z});
        fine += std::max({made.error.x, made.error.y, made.error.z}) < 1e-3F ? 1 : 0;
    }
    INFO("largest error in bounds " << static_cast<double>(closest) << ", usable " << usable << ", below 1 mm " << fine);
    CHECK(usable > 55000);
    CHECK(fine > 30000);
    CHECK(closest > 0.01L);  // the bound is not so wide that anything would pass
}

TEST_CASE("a reconstructed sample is near the exact one", "[sample][reconstruct]") {
    hard::Random random{72};
    int compared = 0;
    for (int k = 0; k < 20000; ++k) {
        ReconstructCase const c = reconstruct_case(random, k);
        auto const made = sample::reconstruct(sample::make_ray_camera(c.view, math::dvec3(0.0)), c.px, c.triangle);
        if (!made.usable) continue;
        auto const ray = sample::sample_ray(c.view, math::dvec3(0.0), math::dvec2(static_cast<double>(c.px.x), static_cast<double>(c.px.y)));
        auto const eye = sample::eye_of(c.view, math::dvec3(0.0));
        math::vec3 const exact = sample::make_view_sample(core::TriangleId(0), c.triangle, ray, eye).position;
        // Where the ray misses the triangle the exact sample is its nearest point, not the crossing.
        Wide const missed_by = wide(sample::detail::nearest_point(c.triangle, ray)) - exact_plane(c).crossing;
        if (dot(missed_by, missed_by) > 1e-20L) continue;
        ++compared;
        float const largest = std::max({std::abs(exact.x), std::abs(exact.y), std::abs(exact.z)});
        float const rounding = 6.0F * 0x1p-24F * largest;
        CAPTURE(k);
        for (int axis = 0; axis < 3; ++axis)
            CHECK(std::abs(made.position[axis] - exact[axis]) <= (made.error[axis] + rounding) * 1.001F);
    }
    CHECK(compared > 15000);
}

TEST_CASE("a plane that is edge on, or none, is not usable", "[sample][reconstruct]") {
    math::PerspectiveConfig config;
    config.target_m = math::dvec3(0.0, 0.0, -1.0);
    config.size_px = math::ivec2(64, 64);
    auto const camera = sample::make_ray_camera(math::make_perspective(config).value(), math::dvec3(0.0));
    math::vec2 const middle(32.0F, 32.0F);
    sample::Triangle const facing{math::vec3(-1.0F, -1.0F, -5.0F), math::vec3(1.0F, -1.0F, -5.0F), math::vec3(0.0F, 1.0F, -5.0F)};
    auto const made = sample::reconstruct(camera, middle, facing);
    CHECK(made.usable);
    CHECK(made.position.z == -5.0F);
    CHECK(made.normal == math::vec3(0.0F, 0.0F, 1.0F));
    sample::Triangle const edge_on{math::vec3(0.0F, -1.0F, -5.0F), math::vec3(0.0F, 1.0F, -5.0F), math::vec3(0.0F, 0.0F, -9.0F)};
    CHECK_FALSE(sample::reconstruct(camera, middle, edge_on).usable);
    sample::Triangle const point{facing[0], facing[0], facing[0]};
    CHECK_FALSE(sample::reconstruct(camera, middle, point).usable);
}
