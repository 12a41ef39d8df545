// The verb `shade` on the CPU: every triangle drawn alone says which fragments there are.

#include <gnomon/backend.hpp>
#include <gnomon/check/check.hpp>
#include <gnomon/core/executor_threads.hpp>
#include <gnomon/raster.hpp>

#include <array>
#include <cstdint>
#include <vector>

namespace {

using namespace gnomon;

constexpr math::ivec2 shaded_px{150, 90};
constexpr std::size_t shaded_pixels = 150 * 90;

struct ShadedSoup {
    std::vector<math::vec3> positions;

    explicit ShadedSoup(std::uint64_t seed, int triangles) {
        std::uint64_t state = seed;
        auto const unit = [&] {
            state = state * 6364136223846793005U + 1442695040888963407U;
            return static_cast<float>(state >> 40U) * 0x1p-24F;
        };
        for (int i = 0; i < triangles; ++i) {
            float const x = unit() * 2.0F - 1.0F;
            float const y = unit() * 2.0F - 1.0F;
            float const size = i % 7 == 0 ? 2.5F : 0.4F;
            for (int k = 0; k < 3; ++k) {
                float const dx = (unit() - 0.5F) * size;
                float const dy = (unit() - 0.5F) * size;
                float const z = unit();
                positions.emplace_back(x + dx, y + dy, z);
            }
        }
        // The first once more: equal depths, of which the first drawn counts.
        positions.insert(positions.end(), positions.begin(), positions.begin() + 3);
    }
    [[nodiscard]] std::uint32_t triangles() const { return static_cast<std::uint32_t>(positions.size() / 3); }
    [[nodiscard]] backend::Draw draw(std::uint32_t first, std::uint32_t count) const {
        backend::Draw draw{.positions = std::span<math::vec3 const>(positions).subspan(std::size_t{first} * 3, std::size_t{count} * 3),
                           .indices = {}};
        draw.first_triangle = first;
        return draw;
    }
};

math::vec4 color_of(std::uint32_t triangle, std::uint32_t x, std::uint32_t y) {
    return {static_cast<float>(triangle + 1) * 0.125F, static_cast<float>(x), static_cast<float>(y),
            static_cast<float>(triangle % 5) * 0.25F};
}

/// Its id target, if it has one, says which fragment of equal depth is the visible one.
void color_fragments(backend::KernelData const& data, std::span<backend::Fragment const> fragments,
                     std::span<backend::FragmentColor> out) {
    for (std::size_t i = 0; i < fragments.size(); ++i) {
        backend::Fragment const& f = fragments[i];
        out[i].color = color_of(f.triangle, f.x, f.y);
        if (data.targets.empty()) continue;
        backend::TexelView const& ids = data.targets[0];
        out[i].discarded = ids.layer<std::uint32_t>(0)[f.y * static_cast<std::uint32_t>(ids.size_px.x) + f.x] != f.triangle;
    }
}

constexpr backend::FragmentKernel colors_kernel{.name = "colors", .cpu = &color_fragments, .spirv = {}};
constexpr backend::FragmentKernel visible_kernel{.name = "visible", .cpu = &color_fragments, .spirv = {}, .targets = 1};

backend::PassLayer shaded_layer(math::Depth depth) {
    backend::PassLayer layer;
    layer.depth = depth;
    return layer;
}

math::vec4 over(math::vec4 const& c, math::vec4 const& p) {
    float const rest = 1.0F - c.w;
    return {c.x + p.x * rest, c.y + p.y * rest, c.z + p.z * rest, c.w + p.w * rest};
}

struct Expected {
    std::vector<float> depth;
    std::vector<math::vec4> color;
};

/// Fragment by fragment, from passes of one triangle each.
Expected expected(ShadedSoup const& soup, math::Depth direction, backend::FragmentTest test, backend::Blend blend,
                  std::vector<float> const& begun) {
    core::SerialExecutor serial;
    raster::CpuBackend device(serial);
    auto const target = *device.make_target({.size_px = shaded_px, .triangle_ids = true});
    Expected e{begun, std::vector<math::vec4>(shaded_pixels, math::vec4(0.0F))};
    std::vector<float> depth(shaded_pixels);
    std::vector<std::uint32_t> ids(shaded_pixels);
    std::vector<std::uint8_t> done(shaded_pixels, 0);
    for (std::uint32_t t = 0; t < soup.triangles(); ++t) {
        backend::Draw const one = soup.draw(t, 1);
        auto const list = *device.keep({&one, 1});
        auto const layer = shaded_layer(direction);
        REQUIRE(device.draw(list, target, {&layer, 1}));
        backend::Rect const all{0, 0, shaded_px.x, shaded_px.y};
        REQUIRE(device.read({target, 0, backend::Plane::depth, all}, std::as_writable_bytes(std::span(depth))));
        REQUIRE(device.read({target, 0, backend::Plane::triangle, all}, std::as_writable_bytes(std::span(ids))));
        REQUIRE(device.release(list));
        for (std::size_t i = 0; i < shaded_pixels; ++i) {
            if (ids[i] != t) continue;
            bool const nearer = direction == math::Depth::reversed ? depth[i] > e.depth[i] : depth[i] < e.depth[i];
            bool const first = done[i] == 0;
            if (test == backend::FragmentTest::visible ? !(depth[i] == e.depth[i] && first) : !nearer) continue;
            if (test == backend::FragmentTest::nearer) e.depth[i] = depth[i];
            done[i] = 1;
            math::vec4 const c = color_of(t, static_cast<std::uint32_t>(i) % 150U, static_cast<std::uint32_t>(i) / 150U);
            math::vec4& p = e.color[i];
            p = blend == backend::Blend::over ? over(c, p) : math::vec4(c.x, c.y, c.z, c.w + p.w);
        }
    }
    return e;
}

Expected read_all(backend::Backend& device, backend::TargetId target) {
    Expected e{std::vector<float>(shaded_pixels), std::vector<math::vec4>(shaded_pixels)};
    backend::Rect const all{0, 0, shaded_px.x, shaded_px.y};
    REQUIRE(device.read({target, 0, backend::Plane::depth, all}, std::as_writable_bytes(std::span(e.depth))));
    REQUIRE(device.read({target, 0, backend::Plane::color, all}, std::as_writable_bytes(std::span(e.color))));
    REQUIRE(device.finish());
    return e;
}

void check_equal(Expected const& got, Expected const& wanted) {
    CHECK(got.depth == wanted.depth);
    std::size_t differ = 0;
    for (std::size_t i = 0; i < shaded_pixels; ++i) differ += got.color[i] != wanted.color[i] ? 1U : 0U;
    CHECK(differ == 0);
}

}  // namespace

TEST_CASE("fragments are shaded in the order of the draws, as drawing each triangle alone says", "[raster][shade]") {
    ShadedSoup const soup(7, 60);
    backend::Draw const draws[] = {soup.draw(0, 20), soup.draw(20, soup.triangles() - 20)};
    core::SerialExecutor serial;
    core::ThreadExecutor threads(3);
    for (core::ExecutorRef const executor : {core::ExecutorRef(serial), core::ExecutorRef(threads)})
        for (math::Depth const direction : {math::Depth::reversed, math::Depth::forward}) {
            raster::CpuBackend device(executor);
            auto const list = *device.keep(draws);
            auto const target = *device.make_target({.size_px = shaded_px, .triangle_ids = true, .color = true});
            auto layer = shaded_layer(direction);
            std::vector<float> const far(shaded_pixels, direction == math::Depth::reversed ? 0.0F : 1.0F);
            for (backend::Blend const blend : {backend::Blend::replace_and_add, backend::Blend::over}) {
                layer.load = backend::Load::clear;
                backend::FragmentCall call{.test = backend::FragmentTest::nearer, .blend = blend};
                auto const counts = device.shade(list, target, layer, colors_kernel, call);
                REQUIRE(counts);
                CHECK(counts->triangles == soup.triangles());
                check_equal(read_all(device, target), expected(soup, direction, call.test, blend, far));
                // Depth of half the triangles first; then all that is nearer, and the depth stays.
                backend::Draw const half = soup.draw(0, 30);
                auto const before = *device.keep({&half, 1});
                REQUIRE(device.draw(before, target, {&layer, 1}));
                auto const held = read_all(device, target).depth;
                layer.load = backend::Load::keep;
                call.test = backend::FragmentTest::behind_nothing;
                REQUIRE(device.shade(list, target, layer, colors_kernel, call));
                check_equal(read_all(device, target), expected(soup, direction, call.test, blend, held));
                // What is visible, once a pixel.
                layer.load = backend::Load::clear;
                REQUIRE(device.draw(list, target, {&layer, 1}));
                auto const nearest = read_all(device, target).depth;
                layer.load = backend::Load::keep;
                call.test = backend::FragmentTest::visible;
                backend::TargetBinding const ids{target, backend::Plane::triangle};
                call.targets = {&ids, 1};
                REQUIRE(device.shade(list, target, layer, visible_kernel, call));
                check_equal(read_all(device, target), expected(soup, direction, call.test, blend, nearest));
            }
        }
}

TEST_CASE("a pass of fragments changes nothing outside of its area, and keeps colours where it is told to", "[raster][shade]") {
    ShadedSoup const soup(3, 40);
    backend::Draw const draw = soup.draw(0, soup.triangles());
    core::SerialExecutor serial;
    raster::CpuBackend device(serial);
    auto const list = *device.keep({&draw, 1});
    auto const target = *device.make_target({.size_px = shaded_px, .color = true});
    auto layer = shaded_layer(math::Depth::reversed);
    REQUIRE(device.shade(list, target, layer, colors_kernel, {}));
    auto const once = read_all(device, target);
    layer.scissor = backend::Rect{30, 20, 41, 33};
    REQUIRE(device.shade(list, target, layer, colors_kernel, {.color = backend::Load::keep}));
    auto const twice = read_all(device, target);
    std::size_t changed = 0;
    for (std::int32_t y = 0; y < shaded_px.y; ++y)
        for (std::int32_t x = 0; x < shaded_px.x; ++x) {
            auto const i = static_cast<std::size_t>(y * shaded_px.x + x);
            bool const inside = x >= 30 && x < 71 && y >= 20 && y < 53;
            if (!inside) CHECK(twice.color[i] == once.color[i]);
            if (inside) CHECK(twice.color[i].w == 2.0F * once.color[i].w);  // counted again
            changed += twice.color[i] != once.color[i] ? 1U : 0U;
        }
    CHECK(changed > 100);
}
