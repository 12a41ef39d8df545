#include <gnomon/check/check.hpp>
#include <gnomon/core/executor_threads.hpp>
#include <gnomon/raster/conservative.hpp>

#include "oracle.hpp"

#include <algorithm>
#include <array>
#include <vector>

namespace {

using namespace gnomon;
using namespace gnomon::raster;
using oracle::Quad;
using oracle::Random;

constexpr std::int32_t size = 32;
using Corners = std::array<math::vec3, 3>;
using QuadPoint = std::array<Quad, 4>;

/// clip = (x, -y, 1/8, -z): exact in float. Near plane at 1/8, reversed depth, infinite far plane.
math::mat4 camera() {
    math::mat4 m(0.0F);
    m[0][0] = 1.0F;
    m[1][1] = -1.0F;
    m[3][2] = 0.125F;
    m[2][3] = -1.0F;
    return m;
}

QuadPoint clip_of(math::vec3 const& p) {
    return {static_cast<Quad>(p.x), -static_cast<Quad>(p.y), static_cast<Quad>(0.125), -static_cast<Quad>(p.z)};
}

struct Images {
    std::vector<float> nearest = std::vector<float>(std::size_t{size} * size);
    std::vector<float> farthest = nearest;
    TileWorkspace workspace;
    core::SerialExecutor executor;

    /// -1 where nothing is drawn.
    ConservativeStats draw(std::vector<math::vec3> const& positions, Coverage coverage, std::int32_t slack,
                           Cull cull = Cull::none) {
        Draw const draw{.positions = std::span<math::vec3 const>(positions),
                        .indices = {},
                        .clip_from_relative = camera(),
                        .cull = cull};
        ConservativeConfig config{.coverage = coverage, .slack = slack, .load = Load::keep};
        std::fill(nearest.begin(), nearest.end(), -1.0F);
        std::fill(farthest.begin(), farthest.end(), -1.0F);
        auto const stats =
            conservative_pass({&draw, 1}, make_image(nearest.data(), size, size), config, workspace, executor);
        config.bound = Bound::farthest;
        CHECK(
            stats.drawn ==
            conservative_pass({&draw, 1}, make_image(farthest.data(), size, size), config, workspace, executor).drawn);
        return stats;
    }
};

/// A triangle before, behind and across the camera, or a small one before it.
Corners random_corners(Random& random) {
    float const scale = random.in(0, 2) == 0 ? 40.0F : random.in(0, 1) == 0 ? 0.4F : 3.0F;
    Corners c;
    for (math::vec3& p : c)
        p = math::vec3{(random.unit() - 0.5F) * scale, (random.unit() - 0.5F) * scale, (0.3F - random.unit()) * scale};
    if (random.in(0, 2) != 0) return c;
    float const small = random.in(0, 1) == 0 ? 0.02F : 0.2F;
    for (std::size_t i = 1; i < 3; ++i)
        c[i] = c[0] + math::vec3{random.unit() - 0.5F, random.unit() - 0.5F, random.unit() - 0.5F} * small;
    return c;
}

/// Depths that corners' z / w, rounded to float, may be off by.
constexpr double rounding = 1.0 + 0x1p-21;

/// Points of the triangle itself, projected exactly, that an outer image misses or does not bound.
int outer_misses(Images const& images, Corners const& corners, Random& random) {
    int missed = 0;
    for (int k = 0; k < 60; ++k) {
        double a = static_cast<double>(random.unit());
        double b = static_cast<double>(random.unit());
        if (k % 3 == 0) a = 0.0;  // On an edge.
        if (k % 7 == 0) b = 1.0 - a;
        if (a + b > 1.0) continue;
        QuadPoint p{};
        for (std::size_t i = 0; i < 4; ++i)
            p[i] = static_cast<Quad>(1.0 - a - b) * clip_of(corners[0])[i] +
                   static_cast<Quad>(a) * clip_of(corners[1])[i] + static_cast<Quad>(b) * clip_of(corners[2])[i];
        if (p[3] < static_cast<Quad>(0.125)) continue;  // In front of the near plane.
        Quad const x = (p[0] / p[3] + 1) * (size / 2);
        Quad const y = (p[1] / p[3] + 1) * (size / 2);
        if (x < 0 || y < 0 || x >= size || y >= size) continue;
        auto const at = static_cast<std::size_t>(static_cast<int>(y) * size + static_cast<int>(x));
        double const z = static_cast<double>(p[2] / p[3]);
        bool const held = static_cast<double>(images.nearest[at]) * rounding >= z && images.farthest[at] >= 0.0F &&
                          static_cast<double>(images.farthest[at]) <= z * rounding;
        missed += held ? 0 : 1;
    }
    return missed;
}

Quad determinant(QuadPoint const& a, QuadPoint const& b, QuadPoint const& c) {
    return a[0] * (b[1] * c[3] - b[3] * c[1]) - a[1] * (b[0] * c[3] - b[3] * c[0]) + a[3] * (b[0] * c[1] - b[1] * c[0]);
}

/// Points of drawn pixels that the triangle itself does not cover or whose depth is not bounded.
int inner_excess(Images const& images, Corners const& corners) {
    int wrong = 0;
    QuadPoint const c[3] = {clip_of(corners[0]), clip_of(corners[1]), clip_of(corners[2])};
    Quad const all = determinant(c[0], c[1], c[2]);
    for (int i = 0; i < 4 * size * size; ++i) {
        int const px = i / 4 % size;
        int const py = i / 4 / size;
        auto const at = static_cast<std::size_t>(py * size + px);
        if (images.nearest[at] < 0.0F) continue;
        QuadPoint const p{static_cast<Quad>(px + i % 2) / (size / 2) - 1,
                          static_cast<Quad>(py + i / 2 % 2) / (size / 2) - 1, 0, 1};
        Quad const weight[3] = {determinant(p, c[1], c[2]) / all, determinant(c[0], p, c[2]) / all,
                                determinant(c[0], c[1], p) / all};
        Quad const sum = weight[0] + weight[1] + weight[2];  // 8 z / w there.
        bool const inside = weight[0] >= 0 && weight[1] >= 0 && weight[2] >= 0 && sum > 0 && sum <= 8;
        double const z = static_cast<double>(sum) * 0.125;
        bool const bounded = static_cast<double>(images.nearest[at]) * rounding >= z &&
                             static_cast<double>(images.farthest[at]) <= z * rounding;
        wrong += inside && bounded ? 0 : 1;
    }
    return wrong;
}

struct Truth {
    int outer_misses = 0, inner_excess = 0, clipped = 0;
    std::uint64_t inner_pixels = 0;
};

Truth compare_with_geometry(int count, std::uint64_t seed) {
    Random random{seed};
    Images images;
    Truth truth;
    for (int i = 0; i < count; ++i) {
        Corners const corners = random_corners(random);
        std::vector<math::vec3> const positions(corners.begin(), corners.end());
        truth.clipped += static_cast<int>(images.draw(positions, Coverage::outer, snap_slack).clipped);
        truth.outer_misses += outer_misses(images, corners, random);
        truth.inner_pixels += images.draw(positions, Coverage::inner, snap_slack).pixels_written;
        truth.inner_excess += inner_excess(images, corners);
    }
    return truth;
}

void check_geometry(Truth const& truth, int count) {
    CAPTURE(truth.clipped, truth.inner_pixels);
    CHECK(truth.outer_misses == 0);
    CHECK(truth.inner_excess == 0);
    CHECK(truth.clipped > count / 5);
    CHECK(truth.inner_pixels > static_cast<std::uint64_t>(count) * 10);
}

/// Quads a with depth 0.25 and b with depth 0.5 (reversed: nearer) over each other, and their images.
std::vector<math::vec3> two_quads() {
    std::vector<math::vec3> p;
    for (float const w : {0.5F, 0.25F}) {
        math::vec3 const q[4] = {{-w, -w, -w}, {w, -w, -w}, {w, w, -w}, {-w, w, -w}};
        for (int const i : {0, 1, 2, 0, 2, 3}) p.push_back(q[i]);
    }
    return p;
}

}  // namespace

TEST_CASE("with slack, conservative coverage and depths hold for the triangle itself, clipped or not",
          "[raster][conservative]") {
    check_geometry(compare_with_geometry(3'000, 31), 3'000);
}

TEST_CASE("conservative coverage and depths hold for a hundred thousand triangles themselves",
          "[.][full][conservative]") {
    check_geometry(compare_with_geometry(100'000, 32), 100'000);
}

TEST_CASE("clipped polygons are touched as their fans are and covered within all sides", "[raster][conservative]") {
    Random random{33};
    Images images;
    ViewportTransform const viewport = make_viewport({0, 0, size, size}, true);
    int wrong = 0;
    int polygons = 0;
    for (int i = 0; i < 3'000; ++i) {
        Corners const corners = random_corners(random);
        std::array<math::vec4, 3> clip;
        for (std::size_t k = 0; k < 3; ++k) clip[k] = math::vec4(corners[k].x, -corners[k].y, 0.125F, -corners[k].z);
        if ((outcode(clip[0], viewport) | outcode(clip[1], viewport) | outcode(clip[2], viewport)) == 0) continue;
        ClipPolygon const polygon = clip_triangle(clip, viewport);
        if (polygon.count < 3) continue;
        ++polygons;
        std::vector<SnappedVertex> p;
        for (int k = 0; k < polygon.count; ++k)
            p.push_back(snap(polygon.corner[static_cast<std::size_t>(k)], viewport));
        std::vector<math::vec3> const positions(corners.begin(), corners.end());
        images.draw(positions, Coverage::outer, 0);
        for (std::int32_t at = 0; at < size * size; ++at) {
            bool touched = false;
            DepthBounds bounds{2.0F, -1.0F};
            for (std::size_t k = 2; k < p.size(); ++k) {
                SnappedTriangle const t{p[0], p[k - 1], p[k]};
                if (!touches(t, at % size, at / size)) continue;
                touched = true;
                DepthBounds const here = depth_bounds(t, at % size, at / size);
                bounds = {std::min(bounds.least, here.least), std::max(bounds.greatest, here.greatest)};
            }
            auto const pixel = static_cast<std::size_t>(at);
            if (!touched)
                wrong += images.nearest[pixel] == -1.0F && images.farthest[pixel] == -1.0F ? 0 : 1;
            else
                wrong +=
                    images.nearest[pixel] == std::min(bounds.greatest, 1.0F) && images.farthest[pixel] == bounds.least
                        ? 0
                        : 1;
        }
    }
    CHECK(wrong == 0);
    CHECK(polygons > 600);
}

TEST_CASE("of several triangles the nearest or the farthest bound is kept, and cleared to the other end",
          "[raster][conservative]") {
    auto const positions = two_quads();
    Draw const draw{.positions = std::span<math::vec3 const>(positions), .indices = {}, .clip_from_relative = camera()};
    std::vector<float> image(std::size_t{size} * size);
    TileWorkspace workspace;
    core::SerialExecutor executor;
    auto const target = make_image(image.data(), size, size);
    conservative_pass({&draw, 1}, target, {.keep = Bound::nearest}, workspace, executor);
    CHECK((target.at(9, 9) == 0.5F && target.at(0, 0) == 0.5F));
    conservative_pass({&draw, 1}, target, {.keep = Bound::farthest}, workspace, executor);
    CHECK((target.at(9, 9) == 0.25F && target.at(0, 0) == 0.25F));
    conservative_pass({}, target, {.keep = Bound::farthest}, workspace, executor);
    CHECK(target.at(3, 3) == 1.0F);
    conservative_pass({}, target, {.keep = Bound::nearest}, workspace, executor);
    CHECK(target.at(3, 3) == 0.0F);
}

TEST_CASE("a 16-bit target's bounds are rounded outwards", "[raster][conservative]") {
    Random random{34};
    std::vector<float> image(std::size_t{size} * size);
    std::vector<std::uint16_t> codes(std::size_t{size} * size);
    TileWorkspace workspace;
    core::SerialExecutor executor;
    int wrong = 0;
    for (int i = 0; i < 400; ++i) {
        Corners const corners = random_corners(random);
        Draw const draw{
            .positions = std::span<math::vec3 const>(corners), .indices = {}, .clip_from_relative = camera()};
        ConservativeConfig config{.bound = (i & 1) != 0 ? Bound::nearest : Bound::farthest};
        conservative_pass({&draw, 1}, make_image(image.data(), size, size), config, workspace, executor);
        conservative_pass({&draw, 1}, make_image(codes.data(), size, size), config, workspace, executor);
        for (std::size_t k = 0; k < image.size(); ++k) {
            double const over = static_cast<double>(codes[k]) - static_cast<double>(image[k]) * 65535.0;
            wrong += config.bound == Bound::nearest ? over < 0.0 || over >= 1.0 : over > 0.0 || over <= -1.0;
        }
    }
    CHECK(wrong == 0);
}

TEST_CASE("culling leaves what may face either way, and triangles without area", "[raster][conservative]") {
    Images images;
    std::vector<math::vec3> const front{{-0.5F, -0.5F, -1.0F}, {0.5F, -0.5F, -1.0F}, {0.0F, 0.5F, -1.0F}};
    std::vector<math::vec3> const back{front[0], front[2], front[1]};
    std::vector<math::vec3> const line{front[0], front[2], front[2]};
    float const thin = 0.01F / 256.0F;  // 0.16 units of 1/256 pixel, unsnapped
    std::vector<math::vec3> const sliver{
        {-0.5F, 0.0F, -1.0F}, {0.0F, 2.0F / (16 * 256.0F) + thin, -1.0F}, {0.5F, 0.0F, -1.0F}};
    CHECK(images.draw(front, Coverage::outer, 0, Cull::back).drawn == 1);
    CHECK(images.draw(back, Coverage::outer, 0, Cull::back).culled == 1);
    CHECK(images.draw(back, Coverage::outer, snap_slack, Cull::back).culled == 1);
    CHECK(images.draw(line, Coverage::outer, 0, Cull::back).drawn == 1);
    CHECK(images.draw(line, Coverage::inner, 0, Cull::none).no_pixel == 1);
    CHECK(images.draw(sliver, Coverage::outer, 0, Cull::back).culled == 1);
    CHECK(images.draw(sliver, Coverage::outer, snap_slack, Cull::back).drawn == 1);
}

TEST_CASE("a conservative pass counts bad data, draws instances, and is the same for any executor",
          "[raster][conservative]") {
    Random random{35};
    std::vector<math::vec3> positions;
    for (int i = 0; i < 6'000; ++i)
        for (math::vec3 const& p : random_corners(random)) positions.push_back(p);
    positions[4].y = __builtin_nanf("");
    std::vector<std::uint32_t> indices;
    for (std::uint32_t i = 0; i < positions.size(); ++i) indices.push_back(i);
    indices[30] = 1'000'000;
    math::mat4 moved(1.0F);
    moved[3][0] = 0.3F;
    std::vector<math::mat4> const matrices{math::mat4(1.0F), moved};
    Draw const draw{.positions = std::span<math::vec3 const>(positions),
                    .indices = std::span<std::uint32_t const>(indices),
                    .clip_from_relative = camera(),
                    .instances = InstanceSpan(std::span<math::mat4 const>(matrices))};
    std::vector<float> one(300 * 200);
    std::vector<float> other = one;
    TileWorkspace workspace;
    core::SerialExecutor serial;
    core::ThreadExecutor pool(2);
    ConservativeConfig const config{.scissor = Rect{10, 20, 200, 150}};
    auto const stats = conservative_pass({&draw, 1}, make_image(one.data(), 300, 200), config, workspace, serial);
    CHECK(stats == conservative_pass({&draw, 1}, make_image(other.data(), 300, 200), config, workspace, pool));
    CHECK((one == other));
    CHECK(stats.triangles == 12'000);
    CHECK(stats.bad_index == 2);
    CHECK(stats.not_finite == 2);
    CHECK(stats.triangles ==
          stats.bad_index + stats.not_finite + stats.outside + stats.culled + stats.no_pixel + stats.drawn);
    std::size_t const bytes = workspace.size_bytes();
    conservative_pass({&draw, 1}, make_image(one.data(), 300, 200), config, workspace, serial);
    CHECK(workspace.size_bytes() == bytes);
}
