#include <gnomon/check/check.hpp>
#include <gnomon/raster/alpha_map.hpp>
#include <gnomon/raster/pass.hpp>

#include "mixed.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace {

using namespace fixture;
using Cell = AlphaMap::Cell;

/// A texture of blots: mostly clear and solid, with borders and some noise.
struct Blots {
    std::vector<std::uint8_t> texels;
    AlphaTest test;

    Blots(Random& random, math::ivec2 size, std::int32_t channels)
        : texels(static_cast<std::size_t>(size.x) * static_cast<std::size_t>(size.y) *
                 static_cast<std::size_t>(channels)) {
        for (std::uint8_t& t : texels) t = static_cast<std::uint8_t>(random.in(0, 255));
        int const noise = random.in(0, 3);
        for (std::int32_t y = 0; y < size.y; ++y)
            for (std::int32_t x = 0; x < size.x; ++x) {
                std::size_t const at = static_cast<std::size_t>(y * size.x + x) * static_cast<std::size_t>(channels);
                if (random.in(0, 3) >= noise)
                    texels[at + static_cast<std::size_t>(channels) - 1] = (x / 5 + y / 7) % 2 == 0 ? 255 : 0;
            }
        auto const wrap = [&] { return static_cast<math::Wrap>(random.in(0, 2)); };
        test.texture = {texels, size, wrap(), wrap(), channels};
        double const cutoffs[] = {0.5, 128.0 / 255.0, 0.0, 1.0, -1.0, 2.0, 0.1, 0.73};
        double const factors[] = {1.0, 1.0, 0.5, 0.999, 2.0, 0.0, -1.0};
        test.cutoff = cutoffs[random.in(0, 7)];
        test.factor = factors[random.in(0, 6)];
    }
};

bool passes(AlphaTest const& test, math::dvec2 const& uv) {
    return math::alpha_at(test.texture, uv) * test.factor >= test.cutoff;
}

/// A coordinate in cell k of an axis: `weight` of the way from one texel's centre to the next.
double coordinate_in(std::int32_t k, double weight, std::int32_t size) {
    return (static_cast<double>(k) - 0.5 + weight) / static_cast<double>(size);
}

/// Masked triangles of all sizes in front of a camera, with coordinates of any size.
struct MaskedScene {
    Mixed mesh;
    std::vector<math::vec2> uv;

    MaskedScene(std::uint64_t seed, int count) : mesh(seed, count) {
        Random random{seed + 1};
        float const reach[] = {0.01F, 1.0F, 20.0F, 1e9F};
        float const span = reach[random.in(0, 3)];
        for (std::size_t i = 0; i < mesh.positions.size(); ++i)
            uv.push_back({(random.unit() - 0.5F) * span, (random.unit() - 0.3F) * span});
        if (random.in(0, 4) != 0) return;
        uv[0].x = std::numeric_limits<float>::quiet_NaN();
        uv[4].y = std::numeric_limits<float>::infinity();
        uv[8].y = -3e38F;
    }
};

}  // namespace

TEST_CASE("a cell that the map decides passes or fails at every weight, and the others have texels of both kinds",
          "[raster][alpha][property]") {
    Random random{81};
    int decided = 0;
    int mixed = 0;
    for (int round = 0; round < 400; ++round) {
        math::ivec2 const size{random.in(1, 23), random.in(1, 17)};
        Blots const blots(random, size, random.in(1, 4));
        AlphaMap const map = make_alpha_map(blots.test);
        REQUIRE(map.is_of(blots.test));
        for (std::int32_t l = 0; l <= size.y; ++l)
            for (std::int32_t k = 0; k <= size.x; ++k) {
                Cell const cell = map.cell(k, l);
                bool all = true;
                bool none = true;
                for (int i = 0; i < 12; ++i) {
                    // Corners first, then anywhere between; the borders belong to the cells on both sides.
                    double const x = i < 4 ? (i & 1) * 0.999 : static_cast<double>(random.unit());
                    double const y = i < 4 ? (i >> 1) * 0.999 : static_cast<double>(random.unit());
                    bool const pass = passes(blots.test, {coordinate_in(k, x, size.x), coordinate_in(l, y, size.y)});
                    all = all && pass;
                    none = none && !pass;
                }
                CAPTURE(round, k, l, size.x, size.y);
                if (cell == Cell::solid) REQUIRE(all);
                if (cell == Cell::clear) REQUIRE(none);
                (cell == Cell::mixed ? mixed : decided) += 1;
            }
    }
    CHECK(decided > 10'000);
    CHECK(mixed > 1'000);
}

TEST_CASE("a map decides all cells of a texture without grey but those on a border", "[raster][alpha]") {
    // Half clear, half solid, 8 x 4; the borders repeat, so columns 0, 4 and 8 of the cells are mixed.
    std::vector<std::uint8_t> texels;
    for (int i = 0; i < 32; ++i) texels.push_back(i % 8 < 4 ? 0 : 255);
    AlphaTest test;
    test.texture = {.texels = texels, .size_px = {8, 4}, .channels = 1};
    AlphaMap const map = make_alpha_map(test);
    for (std::int32_t l = 0; l <= 4; ++l)
        for (std::int32_t k = 0; k <= 8; ++k)
            CHECK(map.cell(k, l) == (k % 4 == 0 ? Cell::mixed : k < 4 ? Cell::clear : Cell::solid));
    AlphaTest other = test;
    other.cutoff = 0.25;
    CHECK_FALSE(map.is_of(other));
    CHECK_FALSE(make_alpha_map({}).is_of({}));
}

TEST_CASE("alpha-tested triangles are the same from both kernels, with and without a map",
          "[raster][alpha][property]") {
    Random random{82};
    std::uint64_t written = 0;
    std::uint64_t solid = 0;
    for (int round = 0; round < 160; ++round) {
        MaskedScene const scene(200 + static_cast<std::uint64_t>(round), random.in(3, 120));
        std::int32_t const most = round % 4 == 0 ? 3 : 90;
        Blots blots(random, {random.in(1, most), random.in(1, most)}, round % 3 == 0 ? random.in(1, 3) : 4);
        blots.test.uv = std::span<math::vec2 const>(scene.uv);
        Draw masked = draw_of(scene.mesh.positions, scene.mesh.indices, camera());
        if (round % 5 == 0) {  // Orthographic: 1 / w is the same everywhere.
            masked.clip_from_relative = math::mat4(0.4F);
            masked.clip_from_relative[3][3] = round % 2 == 0 ? 1.0F : 0.7F;
        }
        masked.alpha_test = &blots.test;
        Draw plain = scene.mesh.draws()[1];
        PassConfig config{.depth = round % 2 == 0 ? math::Depth::reversed : math::Depth::forward,
                          .range = round % 3 == 0 ? DepthRange::clamp : DepthRange::clip,
                          .kernel = Kernel::scalar};
        if (round % 6 == 1) config.viewport = Rect{random.in(-3000, 50), random.in(-90, 50), random.in(1, 4000), 120};
        if (round % 6 == 2) config.scissor = Rect{random.in(-5, 50), random.in(-5, 50), random.in(1, 90), 70};
        Canvas expected(150, 130);
        expected.draw({masked, plain, masked}, config);
        AlphaMap const map = make_alpha_map(blots.test);
        std::vector<std::uint16_t> codes[2];
        for (bool const mapped : {false, true}) {
            config.kernel = Kernel::simd;
            blots.test.map = mapped ? &map : nullptr;
            Canvas got(150, 130);
            got.draw({masked, plain, masked}, config);
            CAPTURE(round, mapped);
            REQUIRE(got.hash() == expected.hash());
            REQUIRE(got.stats == expected.stats);
            codes[mapped].assign(150 * 130, 7);
            config.kernel = mapped ? Kernel::simd : Kernel::scalar;
            core::SerialExecutor serial;
            depth_pass({&masked, 1}, make_image(codes[mapped].data(), 150, 130), config, got.workspace, serial);
        }
        CHECK(codes[0] == codes[1]);
        written += expected.stats.samples_written;
        masked.alpha_test = nullptr;
        solid += expected.draw({masked, plain, masked}, config).stats.samples_written;
    }
    CHECK(written * 10 > solid);
    CHECK(written * 10 < solid * 9);
}

TEST_CASE("masked triangles larger than 1024 pixels are the same from both kernels", "[raster][alpha][size]") {
    Random random{83};
    Blots blots(random, {64, 64}, 4);
    blots.test.cutoff = 0.5;
    blots.test.factor = 1.0;
    AlphaMap const map = make_alpha_map(blots.test);
    blots.test.map = &map;
    Positions const positions{{-0.9F, -0.8F, -1}, {5, -4, -6}, {-1, 1, -1.2F}, {3, 4, -3}};
    std::vector<math::vec2> const uv{{0, 0}, {3, 0}, {0, 7}, {4, 4}};
    Indices const indices{0, 1, 2, 2, 1, 3};
    blots.test.uv = std::span<math::vec2 const>(uv);
    Draw draw = draw_of(positions, indices, camera());
    draw.alpha_test = &blots.test;
    Canvas scalar(1800, 300);
    Canvas simd(1800, 300);
    scalar.draw({draw}, {.kernel = Kernel::scalar});
    simd.draw({draw}, {.kernel = Kernel::simd});
    CHECK(scalar.hash() == simd.hash());
    CHECK((scalar.stats.samples_written > 20'000 && scalar.stats.samples_written < 500'000));
}
