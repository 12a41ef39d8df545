#include <gnomon/check/check.hpp>
#include <gnomon/raster/pass.hpp>
#include <gnomon/raster/triangle.hpp>

#include "mixed.hpp"

#include <algorithm>
#include <array>
#include <vector>

namespace {

using namespace fixture;

/// Nearest depth and triangle at each pixel, by a search through all triangles that shares the clipper alone.
struct Searched {
    std::vector<float> depth;
    std::vector<std::uint32_t> id;
};

Searched search(Mixed const& scene, Canvas const& canvas, Rect const& viewport_px, Rect const& scissor) {
    Searched found{std::vector<float>(canvas.depth.size(), -7.0F), std::vector<std::uint32_t>(canvas.id.size(), 7U)};
    auto const inside = [&](std::int32_t x, std::int32_t y) {
        return x >= scissor.x && y >= scissor.y && std::int64_t{x} < std::int64_t{scissor.x} + scissor.width &&
               std::int64_t{y} < std::int64_t{scissor.y} + scissor.height;
    };
    auto const each = [&](auto&& f) {
        for (std::int32_t y = 0; y < canvas.height; ++y)
            for (std::int32_t x = 0; x < canvas.width; ++x)
                if (inside(x, y)) f(static_cast<std::size_t>(y * canvas.width + x), x, y);
    };
    each([&](std::size_t p, std::int32_t, std::int32_t) {
        found.depth[p] = 0.0F;
        found.id[p] = no_triangle;
    });
    if (viewport_px.width <= 0 || viewport_px.height <= 0) return found;
    ViewportTransform const viewport = make_viewport(viewport_px, true);
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
            each([&](std::size_t p, std::int32_t x, std::int32_t y) {
                if (oracle::signed_cover(piece, x, y) == 0) return;
                float const z = std::clamp(depth_at(piece, x, y), 0.0F, 1.0F);
                if (!(z > found.depth[p])) return;
                found.depth[p] = z;
                found.id[p] = static_cast<std::uint32_t>(t);
            });
        }
    }
    return found;
}

}  // namespace

TEST_CASE("any viewport and any scissor rectangle give what a search through all triangles finds",
          "[raster][viewport][scissor][property]") {
    Random random{91};
    std::vector<Rect> viewports{{-20, -15, 60, 50},
                                {30, 25, 40, 40},
                                {-300, 5, 400, 20},
                                {50, 50, 30, 30},
                                {-90, -90, 40, 40},
                                {0, 0, 1, 1},
                                {5, 5, 0, 20},
                                {5, 5, 20, -3},
                                {-16384, 3, 16384, 9},
                                {16384, 0, 20, 20},
                                {-8000, -8000, 16384, 16384}};
    std::vector<Rect> scissors{{0, 0, 45, 37},
                               {3, 4, 0, 9},
                               {3, 4, 9, 0},
                               {3, 4, -5, 9},
                               {-5, -5, 12, 12},
                               {44, 36, 100, 100},
                               {45, 0, 5, 5},
                               {-9, -9, 9, 9},
                               {-2147483647, 0, 2147483647, 20},
                               {7, 8, 2147483647, 2147483647},
                               {20, 0, 1, 37}};
    int drawn = 0;
    for (int round = 0; round < 66; ++round) {
        Mixed const scene(300 + static_cast<std::uint64_t>(round), 25);
        Canvas canvas(45, 37);
        Rect const viewport = viewports[static_cast<std::size_t>(round) % viewports.size()];
        Rect const scissor = scissors[static_cast<std::size_t>(round % 2 == 0 ? 0 : random.in(0, 10))];
        canvas.draw(
            {scene.draws()[0]},
            {.kernel = round % 2 == 0 ? Kernel::simd : Kernel::scalar, .viewport = viewport, .scissor = scissor});
        Searched const expected = search(scene, canvas, viewport, scissor);
        CAPTURE(round);
        CHECK(canvas.id == expected.id);
        CHECK(canvas.depth == expected.depth);
        PassStats const& s = canvas.stats;
        CHECK(s.triangles == s.bad_index + s.not_finite + s.outside + s.degenerate + s.culled + s.no_sample + s.drawn);
        drawn += s.samples_written > 0 ? 1 : 0;
    }
    CHECK(drawn > 12);
}

TEST_CASE("16-bit indices reach position 65535, and count as bad beyond the positions", "[raster][fetch]") {
    Positions positions(65536, math::vec3(0.0F));
    positions[65533] = {-1, -1, 0.5F};
    positions[65534] = {3, -1, 0.5F};
    positions[65535] = {-1, 3, 0.5F};
    std::vector<std::uint16_t> const indices{65533, 65534, 65535, 65535, 65533, 65534};
    Draw draw{.positions = std::span<math::vec3 const>(positions), .indices = std::span<std::uint16_t const>(indices)};
    for (Kernel const kernel : {Kernel::scalar, Kernel::simd}) {
        Canvas canvas(20, 20);
        CHECK(canvas.draw({draw}, {.kernel = kernel}).stats.drawn == 2);
        CHECK(std::all_of(canvas.id.begin(), canvas.id.end(), [](std::uint32_t id) { return id == 0; }));
        Draw shorter = draw;
        shorter.positions = std::span<math::vec3 const>(positions).first(65535);
        CHECK(canvas.draw({shorter}, {.kernel = kernel}).stats.bad_index == 2);
    }
    // Nine in a row, so that the vector path reads them too.
    std::vector<std::uint16_t> many;
    for (int i = 0; i < 9; ++i) many.insert(many.end(), {65535, 65533, 65534});
    draw.indices = std::span<std::uint16_t const>(many);
    Canvas canvas(20, 20);
    CHECK(canvas.draw({draw}).stats.drawn == 9);
}

TEST_CASE("positions may lie at any distance, unaligned, or all at one place", "[raster][fetch]") {
    Mixed const scene(92, 400);
    Canvas reference(90, 90);
    reference.draw({draw_of(scene.positions, scene.indices, camera())});
    for (std::size_t const stride : {12U, 13U, 16U, 31U, 100U}) {
        std::vector<std::byte> bytes(3 + stride * scene.positions.size());
        for (std::size_t i = 0; i < scene.positions.size(); ++i)
            __builtin_memcpy(bytes.data() + 3 + i * stride, &scene.positions[i], 12);
        Draw draw = draw_of(scene.positions, scene.indices, camera());
        draw.positions = core::StridedSpan<math::vec3>(bytes.data() + 3, scene.positions.size(), stride);
        for (Kernel const kernel : {Kernel::scalar, Kernel::simd}) {
            CAPTURE(stride, static_cast<int>(kernel));
            CHECK(Canvas(90, 90).draw({draw}, {.kernel = kernel}).hash() == reference.hash());
        }
    }
    // Stride 0: every corner is the same, so no triangle has an area.
    Draw draw = draw_of(scene.positions, scene.indices, math::mat4(1.0F));
    math::vec3 const one(0.25F, 0.5F, 0.5F);
    draw.positions = core::StridedSpan<math::vec3>(&one, scene.positions.size(), 0);
    PassStats const stats = Canvas(90, 90).draw({draw}).stats;
    CHECK(stats.degenerate == stats.triangles);
}
