#include <gnomon/check/check.hpp>
#include <gnomon/raster/pass.hpp>
#include <gnomon/raster/triangle.hpp>

#include "oracle.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

namespace {

using namespace gnomon;
using namespace gnomon::raster;
using oracle::Random;

constexpr Kernel kernels[] = {Kernel::scalar, Kernel::simd, Kernel::avx2};
constexpr std::int32_t size = 32;
constexpr std::int32_t size_units = size * 256;

/// Corners in fixed point, from the families that break rasterizers.
SnappedTriangle random_triangle(Random& random) {
    auto const z = [&] { return random.unit(); };
    std::int32_t const lo = -2 * size_units;
    std::int32_t const hi = 3 * size_units;
    auto const anywhere = [&] { return SnappedVertex{random.in(lo, hi), random.in(lo, hi), z()}; };
    auto const near_image = [&] {
        return SnappedVertex{random.in(-512, size_units + 512), random.in(-512, size_units + 512), z()};
    };
    auto const on_centre = [&] {
        return SnappedVertex{random.in(-2, size + 2) * 256 + 128, random.in(-2, size + 2) * 256 + 128, z()};
    };
    SnappedVertex const a = near_image();
    switch (random.in(0, 7)) {
        case 0: return {near_image(), near_image(), near_image()};
        case 1: return {anywhere(), anywhere(), anywhere()};
        case 2: {  // sub-pixel
            auto const close = [&] {
                return SnappedVertex{a.x + random.in(-200, 200), a.y + random.in(-200, 200), z()};
            };
            return {a, close(), close()};
        }
        case 3: return {on_centre(), on_centre(), on_centre()};
        case 4: {  // sliver along an edge
            SnappedVertex const b = anywhere();
            return {a, b, {(a.x + b.x) / 2 + random.in(-2, 2), (a.y + b.y) / 2 + random.in(-2, 2), z()}};
        }
        case 5: {  // huge: as far as the guard band lets corners go
            auto const far = [&] {
                return SnappedVertex{random.in(-5'900'000, 5'900'000), random.in(-5'900'000, 5'900'000), z()};
            };
            return {far(), far(), far()};
        }
        case 6: {  // a huge sliver through the image
            std::int32_t const dx = random.in(-5'000'000, 5'000'000);
            std::int32_t const dy = random.in(-5'000'000, 5'000'000);
            return {SnappedVertex{a.x - dx, a.y - dy, z()}, SnappedVertex{a.x + dx, a.y + dy, z()},
                    SnappedVertex{a.x + random.in(-300, 300), a.y + random.in(-300, 300), z()}};
        }
        default: {  // axis-aligned edges on centres and pixel borders
            std::int32_t const x = random.in(0, size * 2) * 128;
            std::int32_t const y = random.in(0, size * 2) * 128;
            return {SnappedVertex{x, y, z()}, SnappedVertex{x + random.in(-40, 40) * 128, y, z()},
                    SnappedVertex{x, y + random.in(-40, 40) * 128, z()}};
        }
    }
}

/// The same with corners that snapping moved, two times of three.
SnappedTriangle random_snapped_triangle(Random& random) {
    SnappedTriangle t = random_triangle(random);
    if (random.in(0, 2) == 0) return t;
    for (SnappedVertex& v : t) {
        v.residue_x = oracle::residue(random, v.x, size_units / 2);
        v.residue_y = oracle::residue(random, v.y, size_units / 2);
    }
    return t;
}

/// The clip coordinates that snap to the corner exactly: a power-of-two target makes every step exact.
math::vec3 clip_of(SnappedVertex const& v) {
    double const half = static_cast<double>(size_units) * 0.5;
    return math::vec3(static_cast<float>((v.x + v.residue_x / 4096.0 - half) / half),
                      static_cast<float>((v.y + v.residue_y / 4096.0 - half) / half), v.z);
}

struct Canvas {
    std::vector<float> depth = std::vector<float>(std::size_t{size} * size);
    std::vector<std::uint32_t> id = std::vector<std::uint32_t>(std::size_t{size} * size);
    Workspace workspace;
    core::SerialExecutor executor;

    PassStats draw(std::vector<math::vec3> const& positions, math::mat4 const& matrix, math::Depth depth_order,
                   Kernel kernel) {
        Draw const draw{
            .positions = std::span<math::vec3 const>(positions), .indices = {}, .clip_from_relative = matrix};
        return camera_pass({&draw, 1}, {make_image(depth.data(), size, size), make_image(id.data(), size, size)},
                           {.depth = depth_order, .kernel = kernel}, workspace, executor);
    }
};

/// Draws eight copies, a whole vector of triangles; returns the pixels that differ from the oracle, in coverage, id or
/// beyond the depth's bound.
int differences(Canvas& canvas, SnappedTriangle const& t, Kernel kernel) {
    std::vector<math::vec3> positions;
    for (int copy = 0; copy < 8; ++copy)
        for (SnappedVertex const& v : t) positions.push_back(clip_of(v));
    canvas.draw(positions, math::mat4(1.0F), math::Depth::forward, kernel);
    int wrong = 0;
    std::array<oracle::Quad, 3> const moved = oracle::moved_depths(t);
    double const least_z = static_cast<double>(std::min({moved[0], moved[1], moved[2]}));
    double const corner_error = oracle::moved_error(t);
    for (std::int32_t y = 0; y < size; ++y)
        for (std::int32_t x = 0; x < size; ++x) {
            std::size_t const at = static_cast<std::size_t>(y * size + x);
            bool const covered = oracle::signed_cover(t, x, y) != 0;
            // A depth of 1 is no nearer than what a forward pass clears to.
            bool const drawn = covered && depth_at(t, x, y) < 1.0F;
            bool ok = drawn == (canvas.id[at] == 0) && covered == covers(t, x, y);
            if (covered && ok) {
                oracle::Quad const exact = oracle::depth(t, x, y);
                oracle::Quad const error = static_cast<oracle::Quad>(canvas.depth[at]) - exact;
                double const bound = 0x1p-24 * 1.000001 *
                                     (4.0 * (static_cast<double>(exact) - least_z) + 2.0 * static_cast<double>(exact));
                ok = (error < 0 ? -error : error) <=
                     static_cast<oracle::Quad>(bound + 1.000001 * corner_error + 0x1p-140);
                ok = ok && canvas.depth[at] == std::clamp(depth_at(t, x, y), 0.0F, 1.0F);
            }
            wrong += ok || (!covered && canvas.id[at] == no_triangle && canvas.depth[at] == 1.0F) ? 0 : 1;
        }
    return wrong;
}

void compare(std::uint64_t count, std::uint64_t seed) {
    Random random{seed};
    Canvas canvas;
    std::uint64_t wrong = 0;
    for (std::uint64_t i = 0; i < count; ++i) {
        SnappedTriangle const t = random_snapped_triangle(random);
        int const bad = differences(canvas, t, kernels[i % 3]);
        if (bad != 0 && wrong == 0) {
            CAPTURE(i, t[0].x, t[0].y, t[1].x, t[1].y, t[2].x, t[2].y, bad);
            CHECK(bad == 0);
        }
        wrong += static_cast<std::uint64_t>(bad);
    }
    CHECK(wrong == 0);
}

/// w = -z: a camera at the origin, near plane at 1/8, reversed depth with an infinite far plane.
math::mat4 camera() {
    math::mat4 m(0.0F);
    m[0][0] = 1.0F;
    m[1][1] = -1.0F;
    m[3][2] = 0.125F;
    m[2][3] = -1.0F;
    return m;
}

math::vec4 transformed(math::mat4 const& m, math::vec3 const& p) {
    math::vec4 r(0.0F);
    for (math::axis_t i = 0; i < 4; ++i) r[i] = ((m[0][i] * p.x + m[1][i] * p.y) + m[2][i] * p.z) + m[3][i];
    return r;
}

/// Pixels whose coverage differs from the winding of the clipped and snapped polygon.
int clipped_differences(Canvas& canvas, std::vector<math::vec3> const& corners, Kernel kernel) {
    ViewportTransform const viewport = make_viewport({0, 0, size, size}, true);
    std::array<math::vec4, 3> clip;
    for (std::size_t i = 0; i < 3; ++i) clip[i] = transformed(camera(), corners[i]);
    ClipPolygon const polygon = clip_triangle(clip, viewport);
    std::vector<SnappedVertex> snapped;
    for (int i = 0; i < polygon.count; ++i)
        snapped.push_back(snap(polygon.corner[static_cast<std::size_t>(i)], viewport));
    canvas.draw(corners, camera(), math::Depth::reversed, kernel);
    int wrong = 0;
    for (std::int32_t y = 0; y < size; ++y)
        for (std::int32_t x = 0; x < size; ++x)
            if ((oracle::winding(snapped, x, y) != 0) != (canvas.id[static_cast<std::size_t>(y * size + x)] == 0))
                ++wrong;
    return wrong;
}

void compare_clipped(std::uint64_t count, std::uint64_t seed) {
    Random random{seed};
    Canvas canvas;
    std::uint64_t wrong = 0;
    for (std::uint64_t i = 0; i < count; ++i) {
        float const scale = random.in(0, 3) == 0 ? 3000.0F : random.in(0, 1) == 0 ? 0.3F : 3.0F;
        std::vector<math::vec3> corners;
        for (int c = 0; c < 3; ++c)
            corners.push_back(math::vec3{(random.unit() - 0.5F) * scale, (random.unit() - 0.5F) * scale,
                                         (0.3F - random.unit()) * (random.in(0, 1) == 0 ? 1.0F : scale)});
        wrong += static_cast<std::uint64_t>(clipped_differences(canvas, corners, kernels[i % 3]));
    }
    CHECK(wrong == 0);
}

}  // namespace

TEST_CASE("coverage and depth of random triangles equal the exact oracle", "[raster][coverage]") { compare(6'000, 1); }

TEST_CASE("coverage of triangles behind and across the near plane equals the polygon's winding", "[raster][clip]") {
    compare_clipped(6'000, 2);
}

TEST_CASE("a million triangles equal the exact oracle", "[.][full]") {
    compare(800'000, 3);
    compare_clipped(200'000, 4);
}

TEST_CASE("a triangle may be given in any order of its corners", "[raster][depth]") {
    Random random{5};
    for (int i = 0; i < 2'000; ++i) {
        SnappedTriangle const t = random_snapped_triangle(random);
        if (doubled_area(t) == 0) continue;
        SnappedTriangle const turned{t[1], t[2], t[0]};
        SnappedTriangle const mirrored{t[2], t[1], t[0]};
        std::int32_t const x = random.in(0, size - 1);
        std::int32_t const y = random.in(0, size - 1);
        CHECK((covers(t, x, y) == covers(turned, x, y) && covers(t, x, y) == covers(mirrored, x, y)));
        if (covers(t, x, y))
            CHECK((depth_at(t, x, y) == depth_at(turned, x, y) && depth_at(t, x, y) == depth_at(mirrored, x, y)));
    }
}

TEST_CASE("a flat triangle has its depth at every sample", "[raster][depth]") {
    SnappedTriangle const t{SnappedVertex{0, 0, 0.3F}, SnappedVertex{7000, 10, 0.3F}, SnappedVertex{3, 6000, 0.3F}};
    for (std::int32_t y = 0; y < 20; ++y)
        for (std::int32_t x = 0; x < 20; ++x)
            if (covers(t, x, y)) CHECK(depth_at(t, x, y) == 0.3F);
}

TEST_CASE("depth is that of the plane through the corners before snapping", "[raster][depth]") {
    using oracle::Quad;
    Random random{7};
    constexpr double side = 1024.0;
    ViewportTransform const viewport = make_viewport({0, 0, 1024, 1024}, true);
    int samples = 0;
    int wrong = 0;
    int wrong_as_snapped = 0;  // The plane through the snapped corners would not do.
    for (int i = 0; i < 3'000; ++i) {
        float const reach = random.in(0, 1) == 0 ? 0.004F : 0.05F;
        math::vec3 const at{random.unit() * 2.0F - 1.0F, random.unit() * 2.0F - 1.0F, random.unit()};
        SnappedTriangle snapped;
        double x[3];
        double y[3];
        double z[3];
        for (std::size_t c = 0; c < 3; ++c) {
            float const w = 0.5F + random.unit();
            math::vec4 const clip{(at.x + reach * (random.unit() - 0.5F)) * w,
                                  (at.y + reach * (random.unit() - 0.5F)) * w, (0.9F * at.z + 0.1F * random.unit()) * w,
                                  w};
            snapped[c] = snap(clip, viewport);
            auto const divided = [&](float v) { return static_cast<double>(v) / static_cast<double>(w); };
            x[c] = (divided(clip.x) + 1.0) * (side / 2.0);
            y[c] = (divided(clip.y) + 1.0) * (side / 2.0);
            z[c] = divided(clip.z);
        }
        double const area = (x[1] - x[0]) * (y[2] - y[0]) - (x[2] - x[0]) * (y[1] - y[0]);
        double const gx = ((z[1] - z[0]) * (y[2] - y[0]) - (z[2] - z[0]) * (y[1] - y[0])) / area;
        double const gy = ((z[2] - z[0]) * (x[1] - x[0]) - (z[1] - z[0]) * (x[2] - x[0])) / area;
        double const longest = std::max({std::hypot(x[1] - x[0], y[1] - y[0]), std::hypot(x[2] - x[1], y[2] - y[1]),
                                         std::hypot(x[0] - x[2], y[0] - y[2])});
        if (std::abs(area) < 0.125 * longest) continue;
        SnappedTriangle rounded = snapped;
        for (SnappedVertex& v : rounded) v.residue_x = v.residue_y = 0;
        // In pixels: rounding of the residue (2^-20), of three products and a sum in float (4 * 1024 * 2^-24).
        double const bound = (std::abs(gx) + std::abs(gy)) * 1.01 * (0x1p-20 + 0x1p-12) + 8 * 0x1p-24;
        for (std::int32_t py = snapped[0].y / 256 - 2; py <= snapped[0].y / 256 + 2; ++py)
            for (std::int32_t px = snapped[0].x / 256 - 2; px <= snapped[0].x / 256 + 2; ++px) {
                if (!covers(snapped, px, py)) continue;
                double const exact = z[0] + gx * (px + 0.5 - x[0]) + gy * (py + 0.5 - y[0]);
                ++samples;
                wrong += std::abs(static_cast<double>(depth_at(snapped, px, py)) - exact) <= bound ? 0 : 1;
                wrong_as_snapped += std::abs(static_cast<double>(depth_at(rounded, px, py)) - exact) <= bound ? 0 : 1;
            }
    }
    CHECK(samples > 5'000);
    CHECK(wrong == 0);
    CHECK(wrong_as_snapped > samples / 4);
}

TEST_CASE("snapping rounds to the nearest 1/256 pixel, ties to even", "[raster][snap]") {
    ViewportTransform const viewport = make_viewport({0, 0, 512, 512}, true);
    // 1/512 px is half a unit: x_ndc of 2^-17 is half a unit right of the centre.
    CHECK(snap(math::vec4(0x1p-17F, 0.0F, 0.5F, 1.0F), viewport).x == 256 * 256);
    CHECK(snap(math::vec4(3 * 0x1p-17F, 0.0F, 0.5F, 1.0F), viewport).x == 256 * 256 + 2);
    CHECK(snap(math::vec4(-1.0F, 1.0F, 0.5F, 1.0F), viewport) == SnappedVertex{0, 512 * 256, 0.5F});
    CHECK(snap(math::vec4(2.0F, 2.0F, 1.0F, 4.0F), viewport) == SnappedVertex{384 * 256, 384 * 256, 0.25F});
    // What rounding took, in 1/4096 of a unit; half a unit up is one too many for 12 bits.
    CHECK(snap(math::vec4(5 * 0x1p-18F, -0x1p-18F, 0.5F, 1.0F), viewport) ==
          SnappedVertex{256 * 256 + 1, 256 * 256, 0.5F, 1024, -1024});
    CHECK(snap(math::vec4(0x1p-17F, -0x1p-17F, 0.5F, 1.0F), viewport) ==
          SnappedVertex{256 * 256, 256 * 256, 0.5F, 2047, -2048});
}

TEST_CASE("a viewport's place moves snapped corners by whole pixels", "[raster][snap]") {
    math::vec4 const corner(0.3712F, -0.611F, 0.4F, 1.37F);
    SnappedVertex const home = snap(corner, make_viewport({0, 0, 333, 217}, true));
    SnappedVertex const away = snap(corner, make_viewport({-77, 9001, 333, 217}, true));
    CHECK(away == SnappedVertex{home.x - 77 * 256, home.y + 9001 * 256, home.z, home.residue_x, home.residue_y});
}

TEST_CASE("an edge is cut at the same corner whichever triangle owns it", "[raster][clip]") {
    Random random{6};
    ViewportTransform const viewport = make_viewport({0, 0, 640, 480}, true);
    auto const corner = [&] {
        return math::vec4{random.unit() * 4000.0F - 2000.0F, random.unit() * 4.0F - 2.0F, random.unit() - 0.5F,
                          random.unit() * 2.0F - 1.0F};
    };
    int compared = 0;
    for (int i = 0; i < 5'000; ++i) {
        math::vec4 const a = corner();
        math::vec4 const b = corner();
        if ((outcode(a, viewport) == 0) == (outcode(b, viewport) == 0)) continue;
        auto const holds = [&](ClipPolygon const& p, math::vec4 const& v) {
            return std::find(p.corner.begin(), p.corner.begin() + p.count, v) != p.corner.begin() + p.count;
        };
        // The edge alone, as a triangle without area, gives what both must have.
        ClipPolygon const edge = clip_triangle({a, b, b}, viewport);
        ClipPolygon const left = clip_triangle({a, b, corner()}, viewport);
        ClipPolygon const right = clip_triangle({b, a, corner()}, viewport);
        for (int k = 0; k < edge.count; ++k) {
            CHECK(holds(left, edge.corner[static_cast<std::size_t>(k)]));
            CHECK(holds(right, edge.corner[static_cast<std::size_t>(k)]));
            ++compared;
        }
    }
    CHECK(compared > 100);
}
