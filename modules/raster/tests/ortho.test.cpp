#include <gnomon/check/check.hpp>
#include <gnomon/core/executor_threads.hpp>
#include <gnomon/raster/ortho.hpp>
#include <gnomon/raster/triangle.hpp>

#include "oracle.hpp"

#include <algorithm>
#include <array>
#include <vector>

namespace {

using namespace gnomon;
using namespace gnomon::raster;
using oracle::Quad;
using oracle::Random;
using oracle::Wide;

constexpr std::int32_t size = 48;

/// Light space with the world's axes: x right, y up, looking down -z; a unit of 1/256 texel is 2^-14 m, of depth 2^-18
/// m.
IntegerOrtho plain_light() { return {.texel_m = 0x1p-6, .depth_unit_m = 0x1p-10}; }

/// The position whose light vertex this is. Exact for units below 2^24.
math::vec3 position_of(LightVertex const& v) {
    return math::vec3(static_cast<float>(v.x) * 0x1p-14F, -static_cast<float>(v.y) * 0x1p-14F,
                      -static_cast<float>(v.z) * 0x1p-18F);
}

struct Canvas {
    std::vector<float> depth = std::vector<float>(std::size_t{size} * size);
    TileWorkspace workspace;
    core::SerialExecutor executor;
    OrthoConfig config{};

    OrthoStats draw(std::vector<math::vec3> const& positions, IntegerOrtho const& light,
                    math::dvec3 const& origin_m = math::dvec3(0.0)) {
        OrthoDraw const draw{.positions = std::span<math::vec3 const>(positions), .indices = {}, .origin_m = origin_m};
        return ortho_pass({&draw, 1}, light, make_image(depth.data(), size, size), config, workspace, executor);
    }
    [[nodiscard]] std::int64_t code(std::int32_t x, std::int32_t y) const {
        return static_cast<std::int64_t>(depth[static_cast<std::size_t>(y * size + x)] * 0x1p24F);
    }
};

using LightTriangle = std::array<LightVertex, 3>;
constexpr std::int64_t last_code = std::int64_t{1} << 24;

std::int64_t in(Random& random, std::int64_t low, std::int64_t high) {
    return low + static_cast<std::int64_t>(random.next() % static_cast<std::uint64_t>(high - low + 1));
}

LightVertex near_image(Random& random, std::int64_t margin) {
    return {in(random, -margin, size * 256 + margin), in(random, -margin, size * 256 + margin),
            in(random, 1 << 20, 1 << 23)};
}

LightTriangle random_triangle(Random& random) {
    LightVertex const a = near_image(random, 500);
    auto const close = [&](std::int64_t most) {
        return LightVertex{a.x + in(random, -most, most), a.y + in(random, -most, most), in(random, 1 << 20, 1 << 23)};
    };
    switch (random.in(0, 5)) {
        case 0: return {a, near_image(random, 500), near_image(random, 500)};
        case 1: return {a, close(300), close(300)};
        case 2: return {a, near_image(random, 8'000'000), near_image(random, 8'000'000)};
        case 3: return {a, near_image(random, 8'000'000), close(3)};
        case 4: {  // Corners on centres, for the tie rule.
            auto const centre = [&] {
                return LightVertex{in(random, -3, size + 3) * 256 + 128, in(random, -3, size + 3) * 256 + 128, 1 << 22};
            };
            return {centre(), centre(), centre()};
        }
        default: return {a, close(2000), close(2000)};
    }
}

/// Which side of a -> b the point is on when moved right by an infinitesimal step and down by an infinitely smaller
/// one.
int side(LightVertex const& a, LightVertex const& b, Wide x, Wide y) {
    Wide const dx = b.x - a.x;
    Wide const dy = b.y - a.y;
    Wide const cross = dx * (y - a.y) - dy * (x - a.x);
    if (cross != 0) return cross > 0 ? 1 : -1;
    if (dy != 0) return dy < 0 ? 1 : -1;
    return dx > 0 ? 1 : dx < 0 ? -1 : 0;
}

bool oracle_covers(LightTriangle const& t, std::int32_t px, std::int32_t py) {
    Wide const x = Wide{px} * 256 + 128;
    Wide const y = Wide{py} * 256 + 128;
    int const s = side(t[0], t[1], x, y);
    return s != 0 && s == side(t[1], t[2], x, y) && s == side(t[2], t[0], x, y);
}

/// Depth of the plane at the pixel's centre, in codes.
Quad oracle_depth(LightTriangle const& t, std::int32_t px, std::int32_t py) {
    oracle::WideTriangle const w{{{t[0].x, t[0].y}, {t[1].x, t[1].y}, {t[2].x, t[2].y}}};
    return oracle::plane_at(w, {static_cast<Quad>(t[0].z), static_cast<Quad>(t[1].z), static_cast<Quad>(t[2].z)},
                            {Wide{px} * 256 + 128, Wide{py} * 256 + 128}) /
           256;
}

bool has_area(LightTriangle const& t) {
    return Wide{t[1].x - t[0].x} * (t[2].y - t[0].y) != Wide{t[2].x - t[0].x} * (t[1].y - t[0].y);
}

struct Report {
    std::uint64_t covered = 0, wrong_coverage = 0, wrong_depth = 0;
};

void compare(Canvas const& canvas, LightTriangle const& t, Report& report) {
    double const range = static_cast<double>(std::abs(t[1].z - t[0].z) + std::abs(t[2].z - t[0].z));
    double const bound = 0.5 + (0.5 + 0x1p-50 * range) / 256.0;
    for (std::int32_t y = 0; y < size; ++y)
        for (std::int32_t x = 0; x < size; ++x) {
            bool const covered = has_area(t) && oracle_covers(t, x, y);
            report.wrong_coverage += covered == (canvas.code(x, y) != last_code) ? 0U : 1U;
            if (!covered) continue;
            ++report.covered;
            Quad const error = static_cast<Quad>(canvas.code(x, y)) - oracle_depth(t, x, y);
            report.wrong_depth += static_cast<double>(error < 0 ? -error : error) <= bound ? 0U : 1U;
        }
}

Report compare_near(int count, std::uint64_t seed) {
    Random random{seed};
    Canvas canvas;
    Report report;
    int unlike_covers = 0;
    for (int i = 0; i < count; ++i) {
        LightTriangle const t = random_triangle(random);
        canvas.draw({position_of(t[0]), position_of(t[1]), position_of(t[2])}, plain_light());
        compare(canvas, t, report);
        SnappedTriangle snapped;
        for (std::size_t k = 0; k < 3; ++k)
            snapped[k] = {static_cast<std::int32_t>(t[k].x), static_cast<std::int32_t>(t[k].y), 0.5F};
        for (std::int32_t at = 0; at < size * size; ++at)
            unlike_covers +=
                covers(snapped, at % size, at / size) == (canvas.code(at % size, at / size) != last_code) ? 0 : 1;
    }
    CHECK(unlike_covers == 0);
    return report;
}

/// Triangles whose corners are up to 2^38 units, a billion texels, away.
Report compare_far(int count, std::uint64_t seed) {
    Random random{seed};
    Canvas canvas;
    Report report;
    IntegerOrtho light = plain_light();
    for (int i = 0; i < count; ++i) {
        // Positions that floats hold: few bits, far away.
        LightTriangle t;
        std::vector<math::vec3> positions;
        for (LightVertex& v : t) {
            std::int64_t const scale = std::int64_t{1} << random.in(0, 22);
            v = {in(random, -65536, 65536) * scale, in(random, -65536, 65536) * scale, in(random, 1 << 20, 1 << 23)};
            positions.push_back(position_of(v));
        }
        canvas.draw(positions, light);
        compare(canvas, t, report);
    }
    return report;
}

/// Compares the image with the one of the scene or the image moved by whole units; returns differing texels.
int shift_differences(Canvas& canvas, Canvas& other, Random& random) {
    std::vector<math::vec3> positions;
    for (int k = random.in(1, 12); k > 0; --k)
        for (LightVertex const& v : random_triangle(random)) positions.push_back(position_of(v));
    IntegerOrtho light = plain_light();
    light.origin_x = random.in(-20, 20);
    light.origin_y = random.in(-20, 20);
    canvas.draw(positions, light);
    bool const far = random.in(0, 1) == 0;
    std::int64_t const dx = far ? in(random, -(1 << 30), 1 << 30) : random.in(-40, 40);
    std::int64_t const dy = far ? in(random, -(1 << 30), 1 << 30) : random.in(-40, 40);
    std::int64_t const dz = far ? in(random, -(1 << 30), 1 << 30) : random.in(-2000, 2000);
    IntegerOrtho moved = light;
    moved.origin_x += dx;
    moved.origin_y += dy;
    moved.origin_z += dz;
    // The scene and the image move together: nothing may change.
    other.draw(positions, moved,
               math::dvec3(static_cast<double>(dx) * 0x1p-6, -static_cast<double>(dy) * 0x1p-6,
                           -static_cast<double>(dz) * 0x1p-10));
    int wrong = canvas.depth == other.depth ? 0 : 1;
    if (far) return wrong;
    // The image alone moves: where both see, it is the same, moved.
    other.draw(positions, moved);
    for (std::int32_t y = 0; y < size; ++y)
        for (std::int32_t x = 0; x < size; ++x) {
            auto const ox = x - static_cast<std::int32_t>(dx);
            auto const oy = y - static_cast<std::int32_t>(dy);
            if (ox < 0 || oy < 0 || ox >= size || oy >= size) continue;
            std::int64_t const code = canvas.code(x, y);
            wrong += other.code(ox, oy) == (code == last_code ? last_code : code - dz) ? 0 : 1;
        }
    return wrong;
}

}  // namespace

TEST_CASE("orthographic coverage and depth equal exact arithmetic", "[raster][ortho]") {
    Report const report = compare_near(1'500, 41);
    CHECK(report.wrong_coverage == 0);
    CHECK(report.wrong_depth == 0);
    CHECK(report.covered > 100'000);
}

TEST_CASE("triangles far beyond the image are drawn exactly", "[raster][ortho]") {
    Report const report = compare_far(1'500, 42);
    CHECK(report.wrong_coverage == 0);
    CHECK(report.wrong_depth == 0);
    CHECK(report.covered > 100'000);
}

TEST_CASE("a scene moved by whole texels and depth units gives the moved image", "[raster][ortho]") {
    Random random{43};
    Canvas canvas;
    Canvas other;
    int wrong = 0;
    for (int i = 0; i < 10'000; ++i) wrong += shift_differences(canvas, other, random);
    CHECK(wrong == 0);
}

TEST_CASE("ten thousand kilometres away the image is the same", "[raster][ortho]") {
    Random random{44};
    Canvas canvas;
    Canvas far;
    for (int i = 0; i < 200; ++i) {
        std::vector<math::vec3> positions;
        for (LightVertex const& v : random_triangle(random)) positions.push_back(position_of(v));
        IntegerOrtho light = plain_light();
        canvas.draw(positions, light);
        light.origin_x = 10'000'000 * 64;
        light.origin_y = 10'000'000 * 64;
        light.origin_z = std::int64_t{10'000'000} * 1024;
        far.draw(positions, light, math::dvec3(1e7, -1e7, -1e7));
        CHECK((canvas.depth == far.depth));
    }
}

TEST_CASE("a tilted light rounds corners to the nearest unit", "[raster][ortho]") {
    IntegerOrtho light{.right = {0.6, 0.0, 0.8}, .down = {0.0, -1.0, 0.0}, .away = {0.8, 0.0, -0.6}, .texel_m = 0.02};
    Random random{45};
    for (int i = 0; i < 2'000; ++i) {
        math::dvec3 const p{static_cast<double>(random.unit()) * 2e7 - 1e7,
                            static_cast<double>(random.unit()) * 2e7 - 1e7,
                            static_cast<double>(random.unit()) * 2e7 - 1e7};
        auto const v = try_light_vertex(light, p);
        REQUIRE(v.has_value());
        Quad const exact = (static_cast<Quad>(light.right.x) * static_cast<Quad>(p.x) +
                            static_cast<Quad>(light.right.z) * static_cast<Quad>(p.z)) *
                           256 / static_cast<Quad>(light.texel_m);
        double const error = static_cast<double>(static_cast<Quad>(v->x) - exact);
        CHECK(std::abs(error) <= 0.5 + 0x1p-51 * 4e7 * 256 / 0.02);
    }
    CHECK_FALSE(try_light_vertex(light, {1e18, 0, 0}).has_value());
    CHECK_FALSE(try_light_vertex(light, {__builtin_nan(""), 0, 0}).has_value());
}

TEST_CASE("what is before the first code and behind the last is clamped or left out", "[raster][ortho]") {
    auto const flat = [](std::int64_t z) {
        return std::vector<math::vec3>{position_of({0, 0, z}), position_of({20'000, 0, z}),
                                       position_of({0, 20'000, z})};
    };
    Canvas canvas;
    canvas.draw(flat(-100 * 256), plain_light());
    CHECK(canvas.code(3, 3) == 0);
    canvas.draw(flat(77 * 256 + 127), plain_light());
    CHECK(canvas.code(3, 3) == 77);
    canvas.draw(flat(77 * 256 + 128), plain_light());
    CHECK(canvas.code(3, 3) == 78);
    canvas.config.depth = math::Depth::reversed;
    canvas.draw(flat(77 * 256), plain_light());
    CHECK(canvas.code(3, 3) == last_code - 77);
    CHECK(canvas.code(47, 47) == 0);
    canvas.config = {.range = DepthRange::clip};
    canvas.draw(flat(-100 * 256), plain_light());
    CHECK(canvas.code(3, 3) == last_code);
    std::vector<std::uint16_t> codes(std::size_t{size} * size);
    auto const positions = flat(1234 * 256);
    OrthoDraw const draw{.positions = std::span<math::vec3 const>(positions), .indices = {}};
    ortho_pass({&draw, 1}, plain_light(), make_image(codes.data(), size, size), {}, canvas.workspace, canvas.executor);
    CHECK((codes[3 * size + 3] == 1234 && codes.back() == 65535));
}

TEST_CASE("the orthographic pass counts what it leaves out, and any executor draws the same", "[raster][ortho]") {
    Random random{46};
    std::vector<math::vec3> positions;
    for (int i = 0; i < 5'000; ++i)
        for (LightVertex const& v : random_triangle(random)) positions.push_back(position_of(v));
    positions[1].x = __builtin_nanf("");
    positions[4].y = 1e15F;
    positions[7].z = 1e37F;
    std::vector<std::uint32_t> indices;
    for (std::uint32_t i = 0; i < positions.size(); ++i) indices.push_back(i);
    indices[30] = 1'000'000;
    OrthoDraw const draws[2] = {
        {.positions = std::span<math::vec3 const>(positions),
         .indices = std::span<std::uint32_t const>(indices),
         .cull = Cull::back},
        {.positions = std::span<math::vec3 const>(positions).subspan(0, 3'000), .indices = {}, .cull = Cull::front}};
    std::vector<float> one(300 * 200);
    std::vector<float> other = one;
    TileWorkspace workspace;
    core::SerialExecutor serial;
    core::ThreadExecutor pool(2);
    OrthoConfig const config{.scissor = Rect{5, 7, 250, 180}};
    auto const stats = ortho_pass(draws, plain_light(), make_image(one.data(), 300, 200), config, workspace, serial);
    CHECK(stats == ortho_pass(draws, plain_light(), make_image(other.data(), 300, 200), config, workspace, pool));
    CHECK((one == other));
    CHECK(stats.triangles == 6'000);
    CHECK(stats.not_finite == 2);
    CHECK(stats.overflow == 4);
    CHECK(stats.bad_index == 1);
    CHECK(stats.culled > 1'000);
    CHECK(stats.triangles == stats.bad_index + stats.not_finite + stats.overflow + stats.outside + stats.degenerate +
                                 stats.culled + stats.no_sample + stats.drawn);
    std::size_t const bytes = workspace.size_bytes();
    ortho_pass(draws, plain_light(), make_image(one.data(), 300, 200), config, workspace, serial);
    CHECK(workspace.size_bytes() == bytes);
}

TEST_CASE("an orthographic alpha test cuts the half of a quad that is clear", "[raster][ortho][alpha]") {
    std::vector<math::vec3> const positions{position_of({0, 0, 2560}), position_of({8192, 0, 2560}),
                                            position_of({8192, 8192, 2560}), position_of({0, 8192, 2560})};
    std::vector<math::vec2> const uv{{0, 0}, {1, 0}, {1, 1}, {0, 1}};
    std::vector<std::uint16_t> const indices{0, 1, 2, 0, 2, 3};
    std::vector<std::uint8_t> const texels{255, 0};
    AlphaTest const test{.uv = std::span<math::vec2 const>(uv),
                         .texture = {.texels = texels,
                                     .size_px = {2, 1},
                                     .wrap_u = math::Wrap::clamp,
                                     .wrap_v = math::Wrap::clamp,
                                     .channels = 1}};
    OrthoDraw const draw{.positions = std::span<math::vec3 const>(positions),
                         .indices = std::span<std::uint16_t const>(indices),
                         .alpha_test = &test};
    Canvas canvas;
    ortho_pass({&draw, 1}, plain_light(), make_image(canvas.depth.data(), size, size), {}, canvas.workspace,
               canvas.executor);
    CHECK((canvas.code(15, 5) == 10 && canvas.code(15, 25) == 10));
    CHECK((canvas.code(17, 5) == last_code && canvas.code(17, 25) == last_code));
}
