#include <gnomon/check/allocations.hpp>
#include <gnomon/check/check.hpp>
#include <gnomon/core/executor_threads.hpp>
#include <gnomon/raster.hpp>

#include "mixed.hpp"
#include "oracle.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <memory>
#include <vector>

namespace {

using namespace gnomon;
using namespace gnomon::raster;
using namespace fixture;
using oracle::Random;

struct Mesh {
    Positions positions;
    Indices indices;
};

/// A grid of n x n quads over [-1, 1]^2 mapped by `place`, triangles in random order, their corners turned and
/// mirrored at random.
template <class Place>
Mesh shuffled_grid(int n, Random& random, Place place) {
    Mesh mesh;
    for (int j = 0; j <= n; ++j)
        for (int i = 0; i <= n; ++i)
            mesh.positions.push_back(place(static_cast<float>(i) * 2.0F / static_cast<float>(n) - 1.0F,
                                           static_cast<float>(j) * 2.0F / static_cast<float>(n) - 1.0F));
    std::vector<std::array<std::uint32_t, 3>> triangles;
    for (int j = 0; j < n; ++j)
        for (int i = 0; i < n; ++i) {
            auto const a = static_cast<std::uint32_t>(j * (n + 1) + i);
            auto const below = a + static_cast<std::uint32_t>(n) + 1;
            triangles.push_back({a, a + 1, below});
            triangles.push_back({a + 1, below + 1, below});
        }
    for (std::size_t i = triangles.size(); i > 1; --i)
        std::swap(triangles[i - 1],
                  triangles[static_cast<std::size_t>(random.in(0, static_cast<std::int32_t>(i) - 1))]);
    for (auto& t : triangles) {
        std::rotate(t.begin(), t.begin() + random.in(0, 2), t.end());
        if (random.in(0, 1) == 0) std::swap(t[1], t[2]);
        mesh.indices.insert(mesh.indices.end(), t.begin(), t.end());
    }
    return mesh;
}

/// How often each pixel is hit when every triangle is drawn alone.
std::vector<int> hits(Canvas& canvas, Mesh const& mesh, math::mat4 const& matrix, Kernel kernel) {
    std::vector<int> count(canvas.id.size(), 0);
    for (std::size_t i = 0; i < mesh.indices.size(); i += 3) {
        Indices const one(mesh.indices.begin() + static_cast<std::ptrdiff_t>(i),
                          mesh.indices.begin() + static_cast<std::ptrdiff_t>(i) + 3);
        canvas.draw({draw_of(mesh.positions, one, matrix)}, {.kernel = kernel});
        for (std::size_t p = 0; p < count.size(); ++p) count[p] += canvas.id[p] == 0 ? 1 : 0;
    }
    return count;
}

}  // namespace

TEST_CASE("every pixel of a tessellated square is hit exactly once", "[raster][watertight]") {
    Random random{11};
    for (int round = 0; round < 6; ++round) {
        Mesh mesh = shuffled_grid(8, random, [&](float x, float y) {
            bool const border = x * x == 1.0F || y * y == 1.0F;
            float const shift = border ? 0.0F : 0.12F;
            return math::vec3{1.5F * x + shift * (random.unit() - 0.5F), 1.5F * y + shift * (random.unit() - 0.5F),
                              random.unit()};
        });
        Canvas canvas(48, 40);
        std::vector<int> const count = hits(canvas, mesh, math::mat4(1.0F), every_kernel[round % 3]);
        CHECK(std::all_of(count.begin(), count.end(), [](int n) { return n == 1; }));
    }
}

TEST_CASE("a ground through the near plane and the guard band has no gaps and no double hits",
          "[raster][watertight][clip]") {
    Random random{12};
    for (int round = 0; round < 6; ++round) {
        float const height = 0.2F + random.unit() * 3.0F;
        float const spin = random.unit() * 2.0F - 1.0F;
        Mesh mesh = shuffled_grid(8, random, [&](float x, float y) {
            return math::vec3(3000.0F * (x + spin * y), -height, 3000.0F * (y - spin * x));
        });
        Canvas canvas(48, 40);
        std::vector<int> const count = hits(canvas, mesh, camera(), every_kernel[round % 3]);
        CHECK(*std::max_element(count.begin(), count.end()) == 1);
        // One metre ahead of w = -z is where the image's lower border sees; two rows below the horizon is all ground.
        int missing = 0;
        for (std::int32_t y = 22; y < 40; ++y)
            for (std::int32_t x = 0; x < 48; ++x) missing += count[static_cast<std::size_t>(y * 48 + x)] == 1 ? 0 : 1;
        CHECK(missing == 0);
    }
}

TEST_CASE("the image is the same for 1, 2 and 7 threads, scalar or simd, and any executor", "[raster][determinism]") {
    Mixed const scene(21, 6000);
    Canvas reference(333, 217);
    reference.draw(scene.draws(), {.kernel = Kernel::scalar});
    CHECK(reference.stats.clipped > 100);
    CHECK(reference.stats.drawn > 1000);
    PassStats const& s = reference.stats;
    CHECK(s.triangles == s.bad_index + s.not_finite + s.outside + s.degenerate + s.culled + s.no_sample + s.drawn);
    for (int threads : {1, 2, 7})
        for (Kernel kernel : every_kernel) {
            core::ThreadExecutor executor(threads);
            Canvas canvas(333, 217);
            canvas.draw(scene.draws(), {.kernel = kernel}, executor);
            CAPTURE(threads, static_cast<int>(kernel));
            CHECK(canvas.hash() == reference.hash());
            CHECK(canvas.stats == reference.stats);
        }
}

TEST_CASE("a scene's image has the hash it always had", "[raster][golden]") {
    Mixed const scene(22, 5000);
    Canvas canvas(512, 512);
    CHECK(canvas.draw(scene.draws()).hash() == 4106641077533732734ULL);
    CHECK(canvas.draw(scene.draws(), {.depth = math::Depth::forward, .range = DepthRange::clamp}).hash() ==
          9019783874720890964ULL);
}

TEST_CASE("a pass equals a brute-force search for the nearest triangle at each pixel", "[raster]") {
    Mixed const scene(23, 300);
    Canvas canvas(48, 48);
    canvas.draw({scene.draws()[0]});
    ViewportTransform const viewport = make_viewport({0, 0, 48, 48}, true);
    std::vector<float> nearest(canvas.depth.size(), 0.0F);
    std::vector<std::uint32_t> id(canvas.id.size(), no_triangle);
    for (std::size_t t = 0; t < scene.indices.size() / 3; ++t) {
        std::array<math::vec4, 3> clip;
        for (std::size_t c = 0; c < 3; ++c) {
            math::vec3 const p = scene.positions[scene.indices[t * 3 + c]];
            clip[c] = math::vec4(p.x, -p.y, 0.125F, -p.z);
        }
        ClipPolygon const polygon = clip_triangle(clip, viewport);
        for (int k = 2; k < polygon.count; ++k) {
            auto const at = [&](int i) { return snap(polygon.corner[static_cast<std::size_t>(i)], viewport); };
            SnappedTriangle const piece{at(0), at(k - 1), at(k)};
            for (std::int32_t y = 0; y < 48; ++y)
                for (std::int32_t x = 0; x < 48; ++x) {
                    if (oracle::signed_cover(piece, x, y) == 0) continue;
                    std::size_t const p = static_cast<std::size_t>(y * 48 + x);
                    float const z = std::clamp(depth_at(piece, x, y), 0.0F, 1.0F);
                    if (!(z > nearest[p])) continue;
                    nearest[p] = z;
                    id[p] = static_cast<std::uint32_t>(t);
                }
        }
    }
    CHECK(id == canvas.id);
    CHECK(nearest == canvas.depth);
}

TEST_CASE("equal depths go to the first triangle drawn", "[raster][order]") {
    Positions const positions{{-1, -1, 0.5F}, {3, -1, 0.5F}, {-1, 3, 0.5F}};
    Indices indices;
    for (int i = 0; i < 3000; ++i) indices.insert(indices.end(), {0, 1, 2});
    Canvas canvas(70, 70);
    Draw draw = draw_of(positions, indices);
    draw.first_triangle = 40;
    canvas.draw({draw});
    CHECK(std::all_of(canvas.id.begin(), canvas.id.end(), [](std::uint32_t id) { return id == 40; }));
    CHECK(canvas.stats.samples_written == 70 * 70);
}

TEST_CASE("many triangles in a small image are drawn in batches with the same result", "[raster][batch]") {
    Mixed const scene(24, 5000);
    std::vector<Draw> draws;
    for (int copy = 0; copy < 30; ++copy) {
        Draw draw = draw_of(scene.positions, scene.indices, camera());
        draw.first_triangle = static_cast<std::uint32_t>(copy) * 10'000;
        draw.origin.x = static_cast<float>(copy) * 0.03F;
        draws.push_back(draw);
    }
    Canvas whole(64, 64);
    whole.draw(draws);
    CHECK(whole.stats.triangles > 160'000);
    Canvas parts(64, 64);
    for (std::size_t i = 0; i < draws.size(); ++i)
        parts.draw({draws[i]}, {.load = i == 0 ? Load::clear : Load::keep, .kernel = Kernel::scalar});
    CHECK(whole.hash() == parts.hash());
}

TEST_CASE("bad data is left out and counted", "[raster][bad]") {
    float const nan = std::numeric_limits<float>::quiet_NaN();
    float const inf = std::numeric_limits<float>::infinity();
    Positions const positions{{-1, -1, 0.5F}, {1, -1, 0.5F},    {-1, 1, 0.5F}, {nan, 0, 0.5F},
                              {0, inf, 0.5F}, {3e38F, 0, 0.5F}, {0, 0, -3e38F}};
    Indices const indices{0, 1, 2, 0, 1, 3, 4, 1, 2, 0, 5, 2, 0, 1, 6, 0, 1, 7, 0, 1, 0xFFFFFFFFU, 0, 0, 1, 2, 1};
    Draw draw = draw_of(positions, indices);
    for (Kernel kernel : every_kernel) {
        Canvas canvas(16, 16);
        canvas.draw({draw}, {.kernel = kernel});
        CHECK(canvas.stats.triangles == 8);
        CHECK(canvas.stats.not_finite == 4);
        CHECK(canvas.stats.bad_index == 2);
        CHECK(canvas.stats.degenerate == 1);
        CHECK(canvas.stats.drawn == 1);
        CHECK(std::count(canvas.id.begin(), canvas.id.end(), 0U) ==
              static_cast<std::ptrdiff_t>(canvas.stats.samples_written));
    }
    DrawFaults const faults = validate(draw);
    CHECK((faults.any() && faults.bad_index_triangles == 2 && faults.not_finite_positions == 2 &&
           faults.loose_indices == 2));
    draw.clip_from_relative[0][0] = nan;
    CHECK(Canvas(8, 8).draw({draw}).stats.drawn == 0);
}

TEST_CASE("any bits in vertices, matrix and indices give the same image from both kernels", "[raster][bad][fuzz]") {
    Random random{33};
    // Ordinary numbers, powers of two of any size, and plain bits: NaN, infinities, denormals.
    auto const number = [&]() -> float {
        switch (random.in(0, 9)) {
            case 0: return std::bit_cast<float>(static_cast<std::uint32_t>(random.next()));
            case 1: return std::ldexp(random.unit() - 0.5F, random.in(-40, 40));
            case 2: return static_cast<float>(random.in(-2, 2));
            default: return (random.unit() - 0.5F) * 4.0F;
        }
    };
    Canvas scalar(50, 70);
    Canvas simd(50, 70);
    std::uint64_t drawn = 0;
    for (int round = 0; round < 1500; ++round) {
        Positions positions(40);
        for (math::vec3& p : positions) p = math::vec3{number(), number(), number()};
        Indices indices;
        for (int i = 0; i < 75; ++i)
            indices.push_back(static_cast<std::uint32_t>(random.in(0, random.in(0, 20) == 0 ? 50 : 39)));
        Draw draw = draw_of(positions, indices, round % 3 == 0 ? camera() : math::mat4(1.0F));
        for (int i = random.in(0, 6); i > 0; --i) draw.clip_from_relative[random.in(0, 3)][random.in(0, 3)] = number();
        draw.origin = math::vec3{number(), 0.0F, 0.0F};
        PassConfig config{.depth = (round & 1) != 0 ? math::Depth::forward : math::Depth::reversed,
                          .range = (round & 2) != 0 ? DepthRange::clip : DepthRange::clamp,
                          .kernel = Kernel::scalar};
        if ((round & 4) != 0)
            config.viewport =
                Rect{random.in(-16384, 16384), random.in(-100, 100), random.in(1, 16384), random.in(1, 200)};
        if ((round & 8) != 0)
            config.scissor = Rect{random.in(-20, 60), random.in(-20, 60), random.in(0, 60), random.in(0, 90)};
        scalar.draw({draw}, config);
        for (Kernel kernel : {Kernel::simd, Kernel::avx2}) {
            config.kernel = kernel;
            simd.draw({draw}, config);
            CAPTURE(round, static_cast<int>(kernel));
            REQUIRE(scalar.hash() == simd.hash());
            REQUIRE(scalar.stats == simd.stats);
        }
        drawn += scalar.stats.drawn;
    }
    CHECK(drawn > 1000);
}

TEST_CASE("nothing to draw clears, and nothing to draw on is legal", "[raster][empty]") {
    Canvas canvas(65, 3);
    canvas.draw({}, {.depth = math::Depth::forward});
    CHECK(std::all_of(canvas.depth.begin(), canvas.depth.end(), [](float z) { return z == 1.0F; }));
    CHECK(std::all_of(canvas.id.begin(), canvas.id.end(), [](std::uint32_t id) { return id == no_triangle; }));
    canvas.draw({Draw{}});
    CHECK(std::all_of(canvas.depth.begin(), canvas.depth.end(), [](float z) { return z == 0.0F; }));
    Mixed const scene(25, 10);
    CHECK(Canvas(0, 0).draw(scene.draws()).stats.samples_written == 0);
    CHECK(Canvas(5, 0).draw(scene.draws()).stats.outside == Canvas(5, 0).draw(scene.draws()).stats.triangles);
}

TEST_CASE("a scissor rectangle limits what is cleared and drawn, and nothing else changes", "[raster][scissor]") {
    Mixed const scene(26, 2000);
    Canvas whole(200, 150);
    whole.draw(scene.draws());
    for (Rect const scissor :
         {Rect{0, 0, 64, 64}, Rect{37, 41, 99, 57}, Rect{-10, 140, 1000, 1000}, Rect{90, 90, 0, 5}}) {
        Canvas part(200, 150);
        part.draw(scene.draws(), {.scissor = scissor});
        int wrong = 0;
        for (std::int32_t y = 0; y < 150; ++y)
            for (std::int32_t x = 0; x < 200; ++x) {
                bool const in =
                    x >= scissor.x && y >= scissor.y && x < scissor.x + scissor.width && y < scissor.y + scissor.height;
                auto const p = static_cast<std::size_t>(y * 200 + x);
                wrong += (in ? part.id[p] == whole.id[p] && part.depth[p] == whole.depth[p]
                             : part.id[p] == 7 && part.depth[p] == -7.0F)
                             ? 0
                             : 1;
            }
        CHECK(wrong == 0);
    }
}

TEST_CASE("a viewport moved by whole pixels moves the image", "[raster][viewport]") {
    Mixed const scene(27, 2000);
    Canvas home(120, 90);
    home.draw(scene.draws());
    Canvas away(300, 200);
    away.draw(scene.draws(), {.viewport = Rect{70, -20, 120, 90}});
    int wrong = 0;
    for (std::int32_t y = 0; y < 70; ++y)
        for (std::int32_t x = 0; x < 120; ++x)
            wrong += home.id[static_cast<std::size_t>((y + 20) * 120 + x)] ==
                             away.id[static_cast<std::size_t>(y * 300 + x + 70)]
                         ? 0
                         : 1;
    CHECK(wrong == 0);
}

TEST_CASE("a 16-bit target holds the nearest codes of the float depths", "[raster][unorm16]") {
    Mixed const scene(28, 1);
    Positions const positions{{-1, -1, 0.1F}, {1, -1, 0.9F}, {-1, 1, 0.4F}};
    Indices const indices{0, 1, 2};
    for (Kernel kernel : every_kernel) {
        Canvas canvas(100, 100);
        canvas.draw({draw_of(positions, indices)}, {.kernel = kernel});
        std::vector<std::uint16_t> codes(10'000, 77);
        core::SerialExecutor serial;
        Draw const draw = draw_of(positions, indices);
        depth_pass({&draw, 1}, make_image(codes.data(), 100, 100), {.kernel = kernel}, canvas.workspace, serial);
        int wrong = 0;
        for (std::size_t p = 0; p < codes.size(); ++p) {
            double const exact = static_cast<double>(canvas.depth[p]) * 65535.0;
            wrong += std::abs(static_cast<double>(codes[p]) - exact) <= 0.51 ? 0 : 1;
        }
        CHECK(wrong == 0);
        CHECK(codes[99 * 100 + 99] == 0);
    }
}

TEST_CASE("culling leaves out one facing, as seen", "[raster][cull]") {
    // Clip y points down: these corners run counter-clockwise as seen, so the triangle is a front.
    Positions const positions{{-1, -1, 0.5F}, {-1, 1, 0.5F}, {1, -1, 0.5F}};
    Indices const front{0, 1, 2};
    Indices const back{0, 2, 1};
    auto const drawn = [&](Indices const& indices, Cull cull) {
        Draw draw = draw_of(positions, indices);
        draw.cull = cull;
        return Canvas(8, 8).draw({draw}).stats.drawn;
    };
    CHECK((drawn(front, Cull::none) == 1 && drawn(front, Cull::back) == 1 && drawn(front, Cull::front) == 0));
    CHECK((drawn(back, Cull::none) == 1 && drawn(back, Cull::back) == 0 && drawn(back, Cull::front) == 1));
}

TEST_CASE("clamped depth keeps casters in front of the near plane, at the nearest depth", "[raster][clamp]") {
    Positions const positions{{-1, -1, 1.5F}, {3, -1, 1.5F}, {-1, 3, -0.5F}};
    Indices const indices{0, 1, 2};
    Canvas canvas(32, 32);
    canvas.draw({draw_of(positions, indices)}, {.range = DepthRange::clamp});
    CHECK((canvas.depth[0] == 1.0F && canvas.id[0] == 0 && canvas.stats.clipped == 0));
    CHECK(std::all_of(canvas.depth.begin(), canvas.depth.end(), [](float z) { return z >= 0.0F && z <= 1.0F; }));
    canvas.draw({draw_of(positions, indices)});
    CHECK((canvas.depth[0] == 0.0F && canvas.id[0] == no_triangle && canvas.stats.clipped == 1));
}

TEST_CASE("16-bit indices, strided positions and sub-ranges draw what 32-bit packed ones do", "[raster][fetch]") {
    Mixed const scene(29, 3000);
    Canvas reference(128, 128);
    reference.draw({draw_of(scene.positions, scene.indices, camera())});
    std::vector<std::uint16_t> narrow;
    for (std::uint32_t i : scene.indices) narrow.push_back(static_cast<std::uint16_t>(i));
    struct Vertex {
        float weight;
        math::vec3 position;
        float more[3];
    };
    std::vector<Vertex> vertices;
    for (math::vec3 const& p : scene.positions) vertices.push_back({1.0F, p, {0, 0, 0}});
    Draw draw = draw_of(scene.positions, scene.indices, camera());
    draw.indices = std::span<std::uint16_t const>(narrow);
    draw.positions = core::StridedSpan<math::vec3>(&vertices[0].position, vertices.size(), sizeof(Vertex));
    Canvas canvas(128, 128);
    CHECK(canvas.draw({draw}).hash() == reference.hash());
    std::vector<Draw> pieces;
    for (std::size_t i = 0; i < scene.indices.size(); i += 3 * 61) {
        Draw piece = draw_of(scene.positions, {}, camera());
        piece.indices = std::span(scene.indices).subspan(i, std::min<std::size_t>(3 * 61, scene.indices.size() - i));
        piece.first_triangle = static_cast<std::uint32_t>(i / 3);
        pieces.push_back(piece);
    }
    CHECK(canvas.draw(pieces).hash() == reference.hash());
}

TEST_CASE("targets of 16384 pixels on a side are covered to their last pixel", "[raster][size]") {
    for (bool const wide : {true, false}) {
        Canvas canvas(wide ? max_size_px : 3, wide ? 3 : max_size_px);
        Positions const positions{{-1, -1, 0.5F}, {1, -1, 0.25F}, {-1, 1, 0.125F}, {1, 1, 1.0F}};
        Indices const indices{0, 1, 2, 2, 1, 3};
        for (Kernel kernel : every_kernel) {
            canvas.draw({draw_of(positions, indices)}, {.kernel = kernel});
            CHECK(canvas.stats.samples_written == 3 * 16384);
            CHECK(std::none_of(canvas.id.begin(), canvas.id.end(), [](std::uint32_t id) { return id == no_triangle; }));
        }
    }
}

TEST_CASE("an image that is written past the caches equals one that is not", "[raster][size]") {
    Mixed const scene(32, 3000);
    std::int32_t const size = 4096;
    std::vector<float> memory(static_cast<std::size_t>(size) * static_cast<std::size_t>(size) + 32);
    void* start = memory.data();
    std::size_t space = memory.size() * sizeof(float);
    auto* const aligned = static_cast<float*>(std::align(64, sizeof(float), start, space));
    std::vector<float> plain(static_cast<std::size_t>(size) * static_cast<std::size_t>(size));
    Workspace workspace;
    core::SerialExecutor serial;
    std::vector<Draw> const draws = scene.draws();
    depth_pass(draws, make_image(plain.data(), size, size), {.kernel = Kernel::scalar}, workspace, serial);
    for (int columns : {0, 5}) {  // On a cache line, and past its start.
        depth_pass(draws, make_image(aligned + columns, size, size), {}, workspace, serial);
        CHECK(std::equal(plain.begin(), plain.end(), aligned + columns));
    }
}

TEST_CASE("large triangles equal the oracle pixel by pixel", "[raster][size]") {
    Random random{30};
    for (int i = 0; i < 12; ++i) {
        Canvas canvas(2048, 64);
        SnappedTriangle t;
        Positions positions;
        for (SnappedVertex& v : t) {
            v = {random.in(-700'000, 1'200'000), random.in(-300'000, 300'000), random.unit()};
            v.residue_x = oracle::residue(random, v.x, 262144);
            v.residue_y = oracle::residue(random, v.y, 8192);
            positions.push_back(math::vec3(static_cast<float>((v.x + v.residue_x / 4096.0) / 262144.0 - 1.0),
                                           static_cast<float>((v.y + v.residue_y / 4096.0) / 8192.0 - 1.0), v.z));
        }
        canvas.draw({draw_of(positions, {})}, {.depth = math::Depth::forward, .kernel = every_kernel[i % 3]});
        int wrong = 0;
        for (std::int32_t y = 0; y < 64; ++y)
            for (std::int32_t x = 0; x < 2048; ++x) {
                auto const p = static_cast<std::size_t>(y * 2048 + x);
                bool const covered = oracle::signed_cover(t, x, y) != 0;
                wrong += covered == (canvas.id[p] == 0) ? 0 : 1;
                if (!covered) continue;
                double const error =
                    static_cast<double>(static_cast<oracle::Quad>(canvas.depth[p]) - oracle::depth(t, x, y));
                double const bound = 0x1p-24 * static_cast<double>(canvas.depth[p]) + oracle::moved_error(t);
                wrong += std::abs(error) <= 1.000001 * bound ? 0 : 1;
            }
        CHECK(wrong == 0);
    }
}

TEST_CASE("an alpha test cuts holes where the texture is clear", "[raster][alpha]") {
    // Two texels, left clear and right opaque, over a square twice the image's width seen in perspective.
    std::uint8_t const rgba[8] = {1, 2, 3, 0, 4, 5, 6, 255};
    std::vector<math::vec2> const uv{{0, 0}, {1, 0}, {0, 1}, {1, 1}};
    AlphaTest const test{
        .uv = std::span<math::vec2 const>(uv),
        .texture = {.texels = rgba, .size_px = {2, 1}, .wrap_u = math::Wrap::clamp, .wrap_v = math::Wrap::clamp}};
    // The right border is three times as far away as the left one, so u = 1/2 is seen at x = 0.5 of the way.
    Positions const positions{{-1, -1, -1}, {3, -3, -3}, {-1, 1, -1}, {3, 3, -3}};
    Indices const indices{0, 1, 2, 2, 1, 3};
    Draw draw = draw_of(positions, indices, camera());
    draw.alpha_test = &test;
    Canvas canvas(64, 64);
    canvas.draw({draw});
    // u(x) = ((x + 1) / 2) / (3 - 2 (x + 1) / 2 ...): the plane's u = 1/2 point is (1, ., -2), at x_ndc = 1/2.
    for (std::int32_t y = 24; y < 40; ++y) {
        CHECK(canvas.id[static_cast<std::size_t>(y * 64 + 47)] == no_triangle);
        CHECK(canvas.id[static_cast<std::size_t>(y * 64 + 48)] != no_triangle);
    }
    draw.alpha_test = nullptr;
    canvas.draw({draw});
    CHECK(canvas.id[32 * 64 + 20] != no_triangle);
}

TEST_CASE("a path of cameras allocates nothing after its first frame", "[raster][memory]") {
    Mixed const scene(33, 4000);
    std::vector<Draw> draws = scene.draws();
    Canvas canvas(256, 256);
    core::SerialExecutor serial;
    auto const draw_frame = [&](int frame) {
        for (Draw& draw : draws) {
            // Starts looking at nothing, goes into the scene and through it.
            draw.origin = math::vec3{frame == 0 ? 1000.0F : 0.2F * static_cast<float>(frame) - 2.0F,
                                     0.1F * static_cast<float>(frame) - 1.0F, 4.0F - 0.4F * static_cast<float>(frame)};
        }
        PassStats const seen = camera_pass(draws, canvas.target(), {}, canvas.workspace, serial);
        depth_pass(draws, make_image(canvas.depth.data(), 256, 256), {}, canvas.workspace, serial);
        return seen.drawn;
    };
    CHECK(draw_frame(0) == 0);
    std::uint64_t const before = check::allocations_made();
    std::uint64_t most = 0;
    for (int frame = 1; frame < 20; ++frame) most = std::max(most, draw_frame(frame));
    CHECK(check::allocations_made() == before);
    CHECK(most > 1000);
}

TEST_CASE("a second pass of the same size allocates nothing", "[raster][memory]") {
    Mixed const scene(31, 4000);
    std::vector<Draw> const draws = scene.draws();
    Canvas canvas(256, 256);
    canvas.draw(draws);
    std::size_t const bytes = canvas.workspace.size_bytes();
    std::uint64_t const before = check::allocations_made();
    core::SerialExecutor serial;
    camera_pass(draws, canvas.target(), {}, canvas.workspace, serial);
    CHECK(check::allocations_made() == before);
    CHECK(canvas.workspace.size_bytes() == bytes);
}
