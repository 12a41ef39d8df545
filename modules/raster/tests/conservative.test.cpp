#include <gnomon/check/check.hpp>
#include <gnomon/raster/conservative.hpp>

#include "square_oracle.hpp"

#include <cmath>
#include <cstdlib>
#include <vector>

namespace {

using namespace gnomon;
using namespace gnomon::raster;
using oracle::Random;

constexpr std::int32_t size = 8;
constexpr std::int32_t size_units = size * 256;

/// Depths of all kinds: most in [0, 1], some equal, some tiny, some huge.
float random_depth(Random& random) {
    switch (random.in(0, 9)) {
        case 0: return 0.0F;
        case 1: return 1.0F;
        case 2: return random.unit() * 1e-30F;
        case 3: return (random.unit() - 0.5F) * 1e9F;
        default: return random.unit();
    }
}

SnappedVertex near_image(Random& random) {
    return {random.in(-700, size_units + 700), random.in(-700, size_units + 700), random_depth(random)};
}

/// One whose every corner is on the grid of pixel corners, centres and their middles.
SnappedVertex on_grid(Random& random) {
    return {random.in(-6, 2 * size + 6) * 128, random.in(-6, 2 * size + 6) * 128, random_depth(random)};
}

SnappedVertex moved(Random& random, SnappedVertex const& from, std::int32_t most) {
    return {from.x + random.in(-most, most), from.y + random.in(-most, most), random_depth(random)};
}

SnappedTriangle random_sliver(Random& random, SnappedVertex const& a) {
    std::int32_t const dx = random.in(-8'000'000, 8'000'000);
    std::int32_t const dy = random.in(-8'000'000, 8'000'000);
    return {SnappedVertex{a.x - dx, a.y - dy, random_depth(random)},
            SnappedVertex{a.x + dx, a.y + dy, random_depth(random)}, moved(random, a, random.in(0, 1) == 0 ? 2 : 300)};
}

/// No area: a point, or three corners on one line.
SnappedTriangle random_flat(Random& random, SnappedVertex const& a) {
    if (random.in(0, 4) == 0) return {a, {a.x, a.y, random_depth(random)}, {a.x, a.y, random_depth(random)}};
    std::int32_t const reach = random.in(0, 1) == 0 ? 20 : 2000;
    std::int32_t const dx = random.in(-reach, reach);
    std::int32_t const dy = random.in(0, 2) == 0 ? 0 : random.in(-reach, reach);
    std::int32_t const n = random.in(-5, 5);
    return {a, {a.x + dx, a.y + dy, random_depth(random)}, {a.x + n * dx, a.y + n * dy, random_depth(random)}};
}

SnappedTriangle any_triangle(Random& random) {
    SnappedVertex const a = random.in(0, 1) == 0 ? near_image(random) : on_grid(random);
    auto const anywhere = [&](std::int32_t far) {
        return SnappedVertex{random.in(-far, far), random.in(-far, far), random_depth(random)};
    };
    switch (random.in(0, 9)) {
        case 0: return {a, near_image(random), near_image(random)};
        case 1: return {on_grid(random), on_grid(random), on_grid(random)};
        case 2: return {a, moved(random, a, 200), moved(random, a, 200)};
        case 3: return {a, moved(random, a, 4), moved(random, a, 4)};
        case 4: return {a, anywhere(20'000), moved(random, a, 3)};
        case 5: return {anywhere(5'000'000), anywhere(5'000'000), anywhere(5'000'000)};
        case 6: return random_sliver(random, a);
        case 7: return random_flat(random, a);
        case 8: return {anywhere(16'000'000), anywhere(16'000'000), anywhere(16'000'000)};
        default:
            return {a, on_grid(random), {random.in(0, 1) == 0 ? a.x : 4096, on_grid(random).y, random_depth(random)}};
    }
}

SnappedTriangle random_triangle(Random& random) {
    SnappedTriangle t = any_triangle(random);
    if (random.in(0, 7) == 0) t[1].z = t[2].z = t[0].z;
    return t;
}

/// How far outside the truth a bound is, in parts of what it may be: 0 to 1 where it is right. The truth has 113 bits.
double excess(oracle::Quad truth, oracle::Quad bound, double size_of_z, double sign) {
    double const over = static_cast<double>((truth - bound) * static_cast<oracle::Quad>(sign));
    double const at = std::abs(static_cast<double>(truth));
    if (over < 0.0 && over >= -0x1p-106 * size_of_z) return 0.0;
    return over / (at * 1.0001 * 0x1p-23 + size_of_z * 0x1p-44 + 0x1p-148);
}

struct Report {
    std::uint64_t pixels = 0, touched = 0, covered = 0, wrong_coverage = 0, wrong_depth = 0;
    double worst = 0.0;
};

void compare_pixel(SnappedTriangle const& t, math::ivec2 const& pixel, std::int32_t slack, Report& report) {
    oracle::SquareTruth const truth(t, pixel.x, pixel.y, slack);
    bool const touched = truth.touched();
    bool const covered = truth.covered();
    ++report.pixels;
    report.touched += touched ? 1 : 0;
    report.covered += covered ? 1 : 0;
    if (touched != touches(t, pixel.x, pixel.y, slack) || covered != covers_fully(t, pixel.x, pixel.y, slack))
        ++report.wrong_coverage;
    if (!touched) return;
    auto const range = truth.depths();
    DepthBounds const bounds = depth_bounds(t, pixel.x, pixel.y, slack);
    double const z = std::max({std::abs(t[0].z), std::abs(t[1].z), std::abs(t[2].z)});
    double const low = excess(range.least, static_cast<oracle::Quad>(bounds.least), z, 1.0);
    double const high = excess(range.greatest, static_cast<oracle::Quad>(bounds.greatest), z, -1.0);
    if (low < 0.0 || high < 0.0 || low > 1.0 || high > 1.0) ++report.wrong_depth;
    report.worst = std::max({report.worst, low, high});
}

/// A pixel of the image, half of the time near one of the corners.
math::ivec2 aimed_pixel(Random& random, SnappedTriangle const& t) {
    SnappedVertex const& v = t[static_cast<std::size_t>(random.in(0, 2))];
    std::int32_t const far = 8'000'000;
    if (random.in(0, 1) == 0 || std::abs(v.x) > far || std::abs(v.y) > far)
        return {random.in(-2, size + 1), random.in(-2, size + 1)};
    return {(v.x >> 8) + random.in(-2, 2), (v.y >> 8) + random.in(-2, 2)};
}

Report compare_pieces(std::uint64_t count, std::uint64_t seed) {
    Random random{seed};
    Report report;
    for (std::uint64_t i = 0; i < count; ++i) {
        SnappedTriangle const t = random_triangle(random);
        std::int32_t const slack = random.in(0, 2) != 0   ? 0
                                   : random.in(0, 1) == 0 ? snap_slack
                                                          : random.in(0, max_slack);
        for (int k = 0; k < 6; ++k) compare_pixel(t, aimed_pixel(random, t), slack, report);
    }
    return report;
}

/// The clip coordinates that snap to the corner exactly: a power-of-two target makes every step exact.
math::vec3 clip_of(SnappedVertex const& v) {
    float const half = static_cast<float>(size_units) * 0.5F;
    return math::vec3((static_cast<float>(v.x) - half) / half, (static_cast<float>(v.y) - half) / half, v.z);
}

struct Canvas {
    std::vector<float> depth = std::vector<float>(std::size_t{size} * size);
    TileWorkspace workspace;
    core::SerialExecutor executor;
    ConservativeConfig config{};

    ConservativeStats draw(std::vector<math::vec3> const& positions, math::mat4 const& matrix = math::mat4(1.0F),
                           Cull cull = Cull::none) {
        Draw const draw{.positions = std::span<math::vec3 const>(positions),
                        .indices = {},
                        .clip_from_relative = matrix,
                        .cull = cull};
        return conservative_pass({&draw, 1}, make_image(depth.data(), size, size), config, workspace, executor);
    }
    ConservativeStats draw(SnappedTriangle const& t) { return draw({clip_of(t[0]), clip_of(t[1]), clip_of(t[2])}); }
    [[nodiscard]] float at(std::int32_t x, std::int32_t y) const {
        return depth[static_cast<std::size_t>(y * size + x)];
    }
};

void set_modes(ConservativeConfig& config, std::uint64_t i) {
    config.coverage = (i & 1U) != 0 ? Coverage::outer : Coverage::inner;
    config.bound = (i & 2U) != 0 ? Bound::nearest : Bound::farthest;
    config.depth = (i & 4U) != 0 ? math::Depth::forward : math::Depth::reversed;
    config.range = DepthRange::clamp;
    config.load = Load::keep;
    config.slack = (i & 24U) == 0 ? snap_slack : 0;
}

bool fits_guard(SnappedTriangle const& t) {
    return std::all_of(t.begin(), t.end(),
                       [](auto const& v) { return std::abs(v.x) < 6'000'000 && std::abs(v.y) < 6'000'000; });
}

/// Compares an image of one triangle with the exact truth: coverage, and the bound within its stated amount.
void compare_image(Canvas& canvas, SnappedTriangle const& t, Report& report) {
    ConservativeConfig const& config = canvas.config;
    float const clear = config.depth == math::Depth::forward ? 2.0F : -1.0F;  // Behind all depths: any pixel shows.
    std::fill(canvas.depth.begin(), canvas.depth.end(), clear);
    canvas.draw(t);
    bool const wants_least = (config.bound == Bound::nearest) == (config.depth == math::Depth::forward);
    double const z = std::max({std::abs(t[0].z), std::abs(t[1].z), std::abs(t[2].z)});
    for (std::int32_t y = 0; y < size; ++y)
        for (std::int32_t x = 0; x < size; ++x) {
            oracle::SquareTruth const truth(t, x, y, config.slack);
            bool const expected = config.coverage == Coverage::outer ? truth.touched() : truth.covered();
            ++report.pixels;
            report.touched += expected ? 1 : 0;
            if (!expected) {
                report.wrong_coverage += canvas.at(x, y) == clear ? 0U : 1U;
                continue;
            }
            auto const range = truth.depths();
            oracle::Quad const exact = std::clamp<oracle::Quad>(wants_least ? range.least : range.greatest, 0, 1);
            report.wrong_coverage += canvas.at(x, y) == clear ? 1U : 0U;
            double const over = excess(exact, static_cast<oracle::Quad>(canvas.at(x, y)), z, wants_least ? 1.0 : -1.0);
            if (over < 0.0 || over > 1.0) ++report.wrong_depth;
            report.worst = std::max(report.worst, over);
        }
}

Report compare_images(std::uint64_t count, std::uint64_t seed) {
    Random random{seed};
    Canvas canvas;
    Report report;
    for (std::uint64_t i = 0; i < count; ++i) {
        SnappedTriangle t = random_triangle(random);
        while (!fits_guard(t)) t = random_triangle(random);
        set_modes(canvas.config, random.next());
        compare_image(canvas, t, report);
    }
    return report;
}

void check_report(Report const& report) {
    CAPTURE(report.pixels, report.touched, report.covered, report.worst);
    CHECK(report.wrong_coverage == 0);
    CHECK(report.wrong_depth == 0);
    CHECK(report.touched > report.pixels / 5);
    CHECK(report.covered > report.pixels / 50);
    CHECK(report.worst > 0.2);  // The bound is of the right size.
}

}  // namespace

TEST_CASE("touched and covered pixels and their depth bounds equal exact intersection", "[raster][conservative]") {
    check_report(compare_pieces(20'000, 21));
}

TEST_CASE("a conservative pass draws exactly the touched or covered pixels, with bounds of their depths",
          "[raster][conservative]") {
    Report const report = compare_images(6'000, 22);
    CAPTURE(report.pixels, report.touched, report.worst);
    CHECK(report.wrong_coverage == 0);
    CHECK(report.wrong_depth == 0);
    CHECK(report.touched > report.pixels / 20);
}

TEST_CASE("a million triangles are touched and covered exactly", "[.][full][conservative]") {
    Report const pieces = compare_pieces(1'000'000, 23);
    check_report(pieces);
    Report const images = compare_images(1'000'000, 24);
    CAPTURE(images.pixels, images.touched, images.worst);
    CHECK(images.wrong_coverage == 0);
    CHECK(images.wrong_depth == 0);
    WARN(pieces.pixels + images.pixels << " pixels, worst " << pieces.worst << " of the stated excess");
}
