#include <gnomon/check/check.hpp>
#include <gnomon/core/executor_threads.hpp>
#include <gnomon/raster.hpp>

#include "oracle.hpp"
#include "query_scene.hpp"

#include <limits>
#include <vector>

namespace {

using namespace gnomon;
using namespace gnomon::raster;
using oracle::Random;

/// A street drawn into a float or a 16-bit image, and the layer to ask it through.
struct QueryImage {
    std::vector<float> depth;
    std::vector<std::uint16_t> codes;
    Layer layer{.target = ImageView<float>{}};
    Workspace workspace;

    QueryImage(query::Street const& street, math::View const& view, bool unorm16) {
        std::size_t const size = static_cast<std::size_t>(view.size_px.x) * static_cast<std::size_t>(view.size_px.y);
        depth.resize(size);
        codes.resize(size);
        layer.target = unorm16 ? DepthTarget(make_image(codes.data(), view.size_px.x, view.size_px.y))
                               : DepthTarget(make_image(depth.data(), view.size_px.x, view.size_px.y));
        layer.config.depth = view.depth;
        layer.origin = math::to_float(view.eye_m);
        layer.clip_from_relative = math::clip_from_relative(view);
        Draw const draw = street.draw(view);
        core::SerialExecutor serial;
        layered_pass({&draw, 1}, {&layer, 1}, workspace, serial);
    }

    /// Samples that change when the draws are drawn on top: the definition.
    std::uint64_t changed_by(std::span<Draw const> draws) {
        std::vector<float> drawn = depth;
        std::vector<std::uint16_t> drawn_codes = codes;
        Layer on_top = layer;
        std::int32_t const width = layer.target.width();
        std::int32_t const height = layer.target.height();
        on_top.target = layer.target.is_unorm16() ? DepthTarget(make_image(drawn_codes.data(), width, height))
                                                  : DepthTarget(make_image(drawn.data(), width, height));
        on_top.config.load = Load::keep;
        on_top.config.kernel = Kernel::scalar;
        core::SerialExecutor serial;
        layered_pass(draws, {&on_top, 1}, workspace, serial);
        std::uint64_t count = 0;
        for (std::size_t i = 0; i < depth.size(); ++i) count += drawn[i] != depth[i] || drawn_codes[i] != codes[i];
        return count;
    }
};

math::Aabb random_box(Random& random) {
    float const size = random.in(0, 3) == 0 ? 30.0F : random.in(0, 1) == 0 ? 0.2F : 4.0F;
    math::vec3 const at{random.unit() * 200.0F - 100.0F, random.unit() * 30.0F - 3.0F, random.unit() * 420.0F - 210.0F};
    return {at, at + math::vec3{random.unit() * size, random.unit() * size, random.unit() * size}};
}

Draw draw_of_box(std::array<math::vec3, 8>& corners, math::Aabb const& box) {
    for (unsigned c = 0; c < 8; ++c) corners[c] = math::corner(box, c);
    return {.positions = std::span<math::vec3 const>(corners),
            .indices = std::span<std::uint32_t const>(box_indices)};
}

}  // namespace

TEST_CASE("a box passes at exactly the samples that drawing it would change", "[raster][query]") {
    query::Street const street(71, 150);
    Random random{72};
    for (int round = 0; round < 6; ++round) {
        math::Depth const depth = round % 2 == 0 ? math::Depth::reversed : math::Depth::forward;
        QueryImage image(street, street.view(depth, {150, 110}), round >= 4);
        if (round == 2) image.layer.config.range = DepthRange::clamp;
        if (round == 3) image.layer.config.scissor = Rect{20, 10, 70, 90};
        if (round == 1) image.layer.config.kernel = Kernel::scalar;
        std::vector<math::Aabb> boxes;
        for (int i = 0; i < 250; ++i) boxes.push_back(random_box(random));
        for (std::size_t i = 0; i < 20; ++i) boxes.push_back(street.boxes[i]);  // Equal depths.
        std::vector<std::uint64_t> count(boxes.size());
        std::vector<std::uint8_t> any(boxes.size());
        QueryWorkspace workspace;
        core::ThreadExecutor pool(1 + round % 3);
        count_samples_passing(boxes, image.layer, count, workspace, pool);
        any_sample_passing(boxes, image.layer, any, workspace, pool);
        int some = 0;
        for (std::size_t i = 0; i < boxes.size(); ++i) {
            std::array<math::vec3, 8> corners;
            Draw const draw = draw_of_box(corners, boxes[i]);
            CAPTURE(round, i);
            CHECK(count[i] == image.changed_by({&draw, 1}));
            CHECK(any[i] == (count[i] != 0 ? 1 : 0));
            some += any[i];
        }
        CHECK(some > 20);
        CHECK(some < 200);
    }
}

TEST_CASE("a mesh passes at exactly the samples that drawing it would change", "[raster][query]") {
    query::Street const street(73, 60);
    QueryImage image(street, street.view(math::Depth::reversed, {150, 110}), false);
    // Leaves with holes, a few and many triangles, instances.
    std::uint8_t const rgba[8] = {0, 0, 0, 0, 0, 0, 0, 255};
    std::vector<math::vec2> uv;
    AlphaTest leaves{.uv = {}, .texture = {.texels = rgba, .size_px = {2, 1}}};
    Random random{74};
    std::vector<std::vector<math::vec3>> positions(40);
    for (auto& mesh : positions) {
        int const triangles = random.in(0, 1) == 0 ? 10 : 150;
        math::vec3 const at{random.unit() * 40.0F - 20.0F, random.unit() * 8.0F, 60.0F + random.unit() * 120.0F};
        for (int i = 0; i < 3 * triangles; ++i)
            mesh.push_back(at + math::vec3{random.unit(), random.unit(), random.unit()} * 6.0F);
        while (uv.size() < mesh.size()) uv.push_back(math::vec2{random.unit(), random.unit()});
    }
    leaves.uv = std::span<math::vec2 const>(uv);
    std::vector<Draw> draws;
    for (auto const& mesh : positions)
        draws.push_back({.positions = std::span<math::vec3 const>(mesh),
                         .indices = {},
                         .first_triangle = 0xFFFFFFF0U,
                         .alpha_test = draws.size() % 3 == 0 ? &leaves : nullptr});
    std::vector<std::span<Draw const>> meshes;
    for (std::size_t i = 0; i + 2 <= draws.size(); ++i) meshes.push_back({&draws[i], 1 + i % 2});
    std::vector<std::uint64_t> count(meshes.size());
    std::vector<std::uint8_t> any(meshes.size());
    QueryWorkspace workspace;
    core::ThreadExecutor pool(2);
    count_samples_passing(meshes, image.layer, count, workspace, pool);
    any_sample_passing(meshes, image.layer, any, workspace, pool);
    std::uint64_t sum = 0;
    for (std::size_t i = 0; i < meshes.size(); ++i) {
        CAPTURE(i);
        CHECK(count[i] == image.changed_by(meshes[i]));
        CHECK(any[i] == (count[i] != 0 ? 1 : 0));
        CHECK(count_samples_passing(meshes[i], image.layer, workspace) == count[i]);
        CHECK(any_sample_passing(meshes[i], image.layer, workspace) == (any[i] != 0));
        sum += count[i];
    }
    CHECK(sum > 1000);
}

TEST_CASE("a rectangle passes where its depth is nearer, and where its mask has a bit", "[raster][query]") {
    query::Street const street(75, 60);
    Random random{76};
    for (int round = 0; round < 4; ++round) {
        math::Depth const depth = round % 2 == 0 ? math::Depth::reversed : math::Depth::forward;
        QueryImage image(street, street.view(depth, {150, 110}), round >= 2);
        for (int i = 0; i < 200; ++i) {
            std::size_t const picked = static_cast<std::size_t>(random.in(0, 150 * 110 - 1));
            float const at = round >= 2 ? static_cast<float>(image.codes[picked]) / 65535.0F : image.depth[picked];
            RectQuery query{{random.in(-30, 150), random.in(-30, 110), random.in(-3, 90), random.in(-3, 90)}, at, {}};
            std::vector<std::uint32_t> words(3 * 90);
            for (std::uint32_t& word : words) word = static_cast<std::uint32_t>(random.next());
            if (i % 2 == 0) query.mask = {words.data(), 3};
            if (i % 5 == 0) image.layer.config.scissor = Rect{10, 20, 100, 50};
            std::uint64_t expected = 0;
            for (std::int32_t y = 0; y < query.rect.height; ++y)
                for (std::int32_t x = 0; x < query.rect.width; ++x) {
                    std::int32_t const px = query.rect.x + x;
                    std::int32_t const py = query.rect.y + y;
                    bool const inside = i % 5 == 0 ? px >= 10 && px < 110 && py >= 20 && py < 70
                                                   : px >= 0 && px < 150 && py >= 0 && py < 110;
                    bool const bit = i % 2 != 0 || (words[static_cast<std::size_t>(y * 3 + x / 32)] >> (x % 32) & 1U);
                    if (!inside || !bit) continue;
                    std::size_t const p = static_cast<std::size_t>(py * 150 + px);
                    bool const greater = round >= 2 ? image.codes[picked] > image.codes[p] : at > image.depth[p];
                    bool const less = round >= 2 ? image.codes[picked] < image.codes[p] : at < image.depth[p];
                    expected += (depth == math::Depth::reversed ? greater : less) ? 1U : 0U;
                }
            CHECK(count_samples_passing(query, image.layer) == expected);
            CHECK(any_sample_passing(query, image.layer) == (expected != 0));
            image.layer.config.scissor.reset();
        }
        RectQuery const all{{-2'000'000'000, 0, 2'147'483'647, 200}, std::numeric_limits<float>::quiet_NaN(), {}};
        CHECK(count_samples_passing(all, image.layer) == 0);
    }
}

TEST_CASE("queries of empty boxes and of nothing pass nowhere, and a second batch allocates nothing",
          "[raster][query][memory]") {
    query::Street const street(77, 60);
    QueryImage image(street, street.view(math::Depth::reversed, {64, 64}), false);
    float const nan = std::numeric_limits<float>::quiet_NaN();
    float const inf = std::numeric_limits<float>::infinity();
    std::vector<math::Aabb> boxes{math::Aabb{}, {math::vec3(nan), math::vec3(1)}, {math::vec3(1), math::vec3(-1)},
                                  {math::vec3(-inf), math::vec3(inf)}, {math::vec3(0, 1, 180), math::vec3(0, 1, 180)}};
    Random random{78};
    while (boxes.size() < 300) boxes.push_back(random_box(random));
    std::vector<std::uint64_t> count(boxes.size(), 7);
    QueryWorkspace workspace;
    core::SerialExecutor serial;
    count_samples_passing(boxes, image.layer, count, workspace, serial);
    for (std::size_t i = 0; i < 5; ++i) CHECK(count[i] == 0);
    CHECK(count_samples_passing(std::span<Draw const>{}, image.layer, workspace) == 0);
    std::size_t const bytes = workspace.size_bytes();
    count_samples_passing(boxes, image.layer, count, workspace, serial);
    CHECK(workspace.size_bytes() == bytes);
}
