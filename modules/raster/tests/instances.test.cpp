#include <gnomon/check/check.hpp>
#include <gnomon/core/executor_threads.hpp>
#include <gnomon/raster/instances.hpp>
#include <gnomon/raster/layers.hpp>

#include "mixed.hpp"

#include <cmath>
#include <limits>
#include <vector>

namespace {

using namespace fixture;

math::mat4 random_instance(Random& random, bool affine) {
    math::mat4 m(1.0F);
    for (math::axis_t c = 0; c < 4; ++c)
        for (math::axis_t r = 0; r < (affine ? 3 : 4); ++r) m[c][r] += (random.unit() - 0.5F) * (c == 3 ? 4.0F : 0.8F);
    return m;
}

Rows3x4 rows_of(math::mat4 const& m) {
    Rows3x4 rows;
    for (math::axis_t r = 0; r < 3; ++r)
        for (math::axis_t c = 0; c < 4; ++c) rows.row[r][c] = m[c][r];
    return rows;
}

/// Each instance as a draw of its own.
std::vector<Draw> unrolled(std::vector<Draw> const& draws) {
    std::vector<Draw> all;
    for (Draw const& draw : draws) {
        for (std::size_t i = 0; i < draw.instances.size(); ++i) {
            Draw one = draw;
            one.first_triangle += static_cast<std::uint32_t>(i * triangle_count(draw));
            if (draw.instances.is_set()) {
                one.origin = math::vec3(0.0F);
                one.clip_from_relative = clip_from_instance(draw.clip_from_relative, draw.origin, draw.instances[i]);
                one.instances = {};
            }
            all.push_back(one);
        }
    }
    return all;
}

}  // namespace

TEST_CASE("instances draw what a draw for each of them draws, whatever the matrices' layout and the indices' width",
          "[raster][instances]") {
    Random random{71};
    Mixed const scene(72, 60);
    std::vector<std::uint16_t> narrow;
    for (std::uint32_t const i : scene.indices) narrow.push_back(static_cast<std::uint16_t>(i));
    struct Engine {  // What an engine may keep for each instance.
        std::uint8_t flags;
        float rows[12];
        std::uint32_t material;
    };
    for (int round = 0; round < 30; ++round) {
        std::vector<math::mat4> matrices(static_cast<std::size_t>(random.in(0, 40)));
        for (math::mat4& m : matrices) m = random_instance(random, round % 2 == 0);
        std::vector<Engine> engine(matrices.size());
        for (std::size_t i = 0; i < engine.size(); ++i) {
            Rows3x4 const rows = rows_of(matrices[i]);
            std::copy(&rows.row[0][0], &rows.row[0][0] + 12, engine[i].rows);
        }
        std::vector<Draw> draws = scene.draws();
        draws[0].instances = core::StridedSpan<math::mat4>(std::span<math::mat4 const>(matrices));
        draws[1].first_triangle = static_cast<std::uint32_t>(triangle_count(draws[0]) * matrices.size());
        if (round % 2 == 0 && !engine.empty())
            draws[0].instances = core::StridedSpan<Rows3x4>(engine[0].rows, engine.size(), sizeof(Engine));
        if (round % 3 == 0) draws[0].indices = std::span<std::uint16_t const>(narrow);
        draws[0].origin = math::vec3{random.unit(), random.unit(), random.unit()};
        Canvas expected(150, 90);
        expected.draw(unrolled(draws), {.kernel = Kernel::scalar});
        Canvas got(150, 90);
        core::ThreadExecutor executor(round % 3 + 1);
        got.draw(draws, {}, executor);
        CAPTURE(round, matrices.size());
        CHECK(got.hash() == expected.hash());
        CHECK(got.stats == expected.stats);
    }
}

TEST_CASE("instances and layers together draw what single draws in single passes draw", "[raster][instances][layers]") {
    Random random{73};
    Mixed const scene(74, 500);
    std::vector<math::mat4> matrices(9);
    for (math::mat4& m : matrices) m = random_instance(random, true);
    std::vector<Draw> draws = scene.draws();
    draws[1].instances = core::StridedSpan<math::mat4>(std::span<math::mat4 const>(matrices));
    std::vector<float> together(3 * 80 * 80);
    std::vector<float> single(80 * 80);
    std::vector<Layer> layers;
    for (int i = 0; i < 3; ++i) {
        Layer layer{.target = make_image(together.data() + i * 6400, 80, 80)};
        layer.clip_from_relative = camera() * random_instance(random, true);
        layer.origin = math::vec3{random.unit(), random.unit(), random.unit()};
        layers.push_back(layer);
    }
    Workspace workspace;
    core::SerialExecutor serial;
    (void)layered_pass(draws, layers, workspace, serial);
    Workspace other;
    for (std::size_t i = 0; i < 3; ++i) {
        std::vector<Draw> own = draws;
        for (Draw& draw : own) {
            draw.origin = layers[i].origin;
            draw.clip_from_relative = layers[i].clip_from_relative;
        }
        depth_pass(unrolled(own), make_image(single.data(), 80, 80), {.kernel = Kernel::scalar}, other, serial);
        CHECK(std::equal(single.begin(), single.end(), together.begin() + static_cast<std::ptrdiff_t>(i * 6400)));
    }
}

TEST_CASE("an instance's matrix is the product within one rounding of each element", "[raster][instances]") {
    using oracle::Quad;
    Random random{75};
    for (int round = 0; round < 2000; ++round) {
        math::mat4 const clip = random_instance(random, false);
        math::mat4 instance = random_instance(random, round % 2 == 0);
        // Far from the world's origin, where the two cancel.
        math::vec3 const origin{1e6F + random.unit(), -3e5F, random.unit() * 1e3F};
        for (math::axis_t k = 0; k < 3; ++k) instance[3][k] = origin[k] + random.unit() * 8.0F;
        math::mat4 const got = clip_from_instance(clip, origin, instance);
        for (math::axis_t c = 0; c < 4; ++c)
            for (math::axis_t r = 0; r < 4; ++r) {
                Quad exact = static_cast<Quad>(clip[3][r]) * static_cast<Quad>(instance[c][3]);
                Quad size = exact < 0 ? -exact : exact;
                for (math::axis_t k = 0; k < 3; ++k) {
                    Quad const relative = static_cast<Quad>(instance[c][k]) -
                                          static_cast<Quad>(origin[k]) * static_cast<Quad>(instance[c][3]);
                    Quad const term = static_cast<Quad>(clip[k][r]) * relative;
                    exact += term;
                    size += term < 0 ? -term : term;
                }
                Quad const error = static_cast<Quad>(got[c][r]) - exact;
                Quad const magnitude = exact < 0 ? -exact : exact;
                // Half an ulp of the result, and what the double sum may lose where the terms cancel.
                REQUIRE((error < 0 ? -error : error) <= magnitude * Quad{0x1.0001p-24} + size * Quad{0x1p-50});
            }
    }
}

TEST_CASE("a span of no instances draws nothing, and one that was never set draws once", "[raster][instances]") {
    Mixed const scene(76, 20);
    Draw draw = scene.draws()[0];
    CHECK_FALSE(draw.instances.is_set());
    CHECK(draw.instances.size() == 1);
    Canvas canvas(16, 16);
    CHECK(canvas.draw({draw}).stats.triangles == triangle_count(draw));
    draw.instances = core::StridedSpan<math::mat4>(std::span<math::mat4 const>{});
    CHECK(canvas.draw({draw}).stats.triangles == 0);
}

TEST_CASE("an instance with a NaN or an infinity is left out and counted, the others are drawn",
          "[raster][instances]") {
    Mixed const scene(77, 20);
    Draw draw = scene.draws()[0];
    std::vector<math::mat4> matrices(3, math::mat4(1.0F));
    matrices[0][3][0] = std::numeric_limits<float>::quiet_NaN();
    matrices[2][1][1] = std::numeric_limits<float>::infinity();
    draw.instances = core::StridedSpan<math::mat4>(std::span<math::mat4 const>(matrices));
    Canvas alone(32, 32);
    alone.draw({scene.draws()[0]});
    Canvas canvas(32, 32);
    canvas.draw({draw});
    CHECK(canvas.depth == alone.depth);
    CHECK(canvas.stats.not_finite >= 2 * triangle_count(draw));
    CHECK(canvas.stats.drawn == alone.stats.drawn);
}
