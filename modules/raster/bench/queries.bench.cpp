// Occlusion of boxes in the city's street view: the pyramid's cost, and the tests beside each other.
//
// The mix: the boxes of all 1,260 buildings, and 15,000 props of 0.3 to 3 m that stand on the ground. Times are per
// box; `found` is the share of the truly hidden boxes in the view that a test calls hidden.

#include <gnomon/raster.hpp>

#include <benchmark/benchmark.h>

#include "city.hpp"

#include <algorithm>
#include <memory>
#include <vector>

namespace {

using namespace gnomon;
using raster::BoxVerdict;

/// From above the roofs, where most boxes are seen.
math::View air_view(std::int32_t size_px) {
    return math::make_perspective({.eye_m = {-420, 170, -480},
                                   .target_m = {0, 0, 0},
                                   .near_m = 0.5,
                                   .far_m = 2000.0,
                                   .size_px = {size_px, size_px},
                                   .depth = math::Depth::forward})
        .value();
}

struct StreetView {
    bench::City city = bench::make_city(0);
    std::int32_t size;
    bool air;
    math::View view;
    raster::Draw draw;
    std::vector<float> memory;
    float* depth;  // On a cache line, as graphics memory is.
    std::vector<std::uint32_t> id;
    raster::DepthPyramid pyramid;
    raster::Workspace workspace;
    raster::Layer layer{.target = raster::ImageView<float>{}};
    std::vector<math::Aabb> boxes;
    std::vector<std::uint8_t> passes;  // Exactly.
    std::vector<BoxVerdict> verdict;

    StreetView(std::int32_t size_px, bool from_air)
        : size(size_px), air(from_air), view(from_air ? air_view(size_px) : bench::make_view(false, size_px)) {
        draw = {.positions = std::span<math::vec3 const>(city.positions),
                .indices = std::span<std::uint32_t const>(city.indices),
                .origin = math::to_float(view.eye_m),
                .clip_from_relative = math::clip_from_relative(view)};
        std::size_t const pixels = static_cast<std::size_t>(size) * static_cast<std::size_t>(size);
        memory.resize(pixels + 16);
        depth = memory.data() + (64 - reinterpret_cast<std::uintptr_t>(memory.data()) % 64) / sizeof(float) % 16;
        id.resize(pixels);
        core::SerialExecutor serial;
        raster::camera_pass({&draw, 1}, {raster::make_image(depth, size, size),
                                         raster::make_image(id.data(), size, size)},
                            {.depth = view.depth, .pyramid = &pyramid}, workspace, serial);
        layer.target = raster::make_image(depth, size, size);
        layer.origin = draw.origin;
        layer.clip_from_relative = draw.clip_from_relative;
        layer.config.depth = view.depth;
        boxes = city.boxes;
        std::uint64_t state = 4711;
        auto const random = [&] {
            state = state * 6364136223846793005ULL + 1442695040888963407ULL;
            return static_cast<float>(state >> 40U) * 0x1p-24F;
        };
        for (int i = 0; i < 15'000; ++i) {
            math::vec3 const at{random() * 1000.0F - 500.0F, 0.0F, random() * 1000.0F - 500.0F};
            boxes.push_back({at, at + math::vec3{0.3F + 2.7F * random(), 0.3F + 2.7F * random(), 0.3F + 2.7F * random()}});
        }
        passes = exactly(boxes);
        verdict.assign(boxes.size(), BoxVerdict::outside);
        raster::test_boxes(boxes, layer, pyramid, verdict, serial);
    }

    [[nodiscard]] std::vector<std::uint8_t> exactly(std::vector<math::Aabb> const& queried) const {
        core::SerialExecutor serial;
        raster::QueryWorkspace query;
        std::vector<std::uint8_t> any(queried.size());
        raster::any_sample_passing(queried, layer, any, query, serial);
        return any;
    }

    /// The boxes that the test gave one verdict, repeated to as many as the mix has.
    [[nodiscard]] std::vector<math::Aabb> with(BoxVerdict wanted) const {
        std::vector<math::Aabb> some;
        for (std::size_t i = 0; i < boxes.size(); ++i)
            if (verdict[i] == wanted) some.push_back(boxes[i]);
        for (std::size_t i = 0; some.size() < boxes.size(); ++i) some.push_back(some[i]);
        return some;
    }
};

StreetView& street(benchmark::State const& state) {
    static std::unique_ptr<StreetView> held;
    auto const size = static_cast<std::int32_t>(state.range(0));
    bool const air = state.range(1) != 0;
    if (held == nullptr || held->size != size || held->air != air) held = std::make_unique<StreetView>(size, air);
    return *held;
}

void report(benchmark::State& state, StreetView const& s, std::vector<BoxVerdict> const& verdict) {
    double share[3] = {0, 0, 0};
    double hidden = 0;
    double found = 0;
    for (std::size_t i = 0; i < verdict.size(); ++i) {
        share[static_cast<int>(verdict[i])] += 100.0 / static_cast<double>(verdict.size());
        if (s.passes[i] != 0 || s.verdict[i] == BoxVerdict::outside) continue;
        hidden += 1.0;
        found += verdict[i] == BoxVerdict::hidden ? 1.0 : 0.0;
    }
    state.counters["outside%"] = share[0];
    state.counters["hidden%"] = share[1];
    state.counters["visible%"] = share[2];
    state.counters["found%"] = 100.0 * found / hidden;
}

void count_boxes(benchmark::State& state, std::size_t each) {
    state.counters["ns/box"] = benchmark::Counter(static_cast<double>(each) * 1e-9,
                                                  benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}

void box_test(benchmark::State& state, raster::Kernel kernel) {
    StreetView& s = street(state);
    core::SerialExecutor serial;
    raster::Layer layer = s.layer;
    layer.config.kernel = kernel;
    std::vector<BoxVerdict> verdict(s.boxes.size());
    for (auto _ : state) raster::test_boxes(s.boxes, layer, s.pyramid, verdict, serial);
    report(state, s, verdict);
    count_boxes(state, s.boxes.size());
}

void box_test_of(benchmark::State& state, BoxVerdict wanted) {
    StreetView& s = street(state);
    core::SerialExecutor serial;
    std::vector<math::Aabb> const boxes = s.with(wanted);
    std::vector<BoxVerdict> verdict(boxes.size());
    for (auto _ : state) raster::test_boxes(boxes, s.layer, s.pyramid, verdict, serial);
    count_boxes(state, boxes.size());
}

/// What most engines do: the rectangle of the corners and their nearest depth, against four texels of the pyramid.
BoxVerdict plain_test(StreetView const& s, math::Aabb const& box) {
    math::mat4 const& m = s.layer.clip_from_relative;
    float low_x = 1e9F, low_y = 1e9F, high_x = -1e9F, high_y = -1e9F, nearest = 1.0F;
    for (unsigned i = 0; i < 8; ++i) {
        math::vec3 const p = math::corner(box, i) - s.layer.origin;
        math::vec4 const c = m * math::vec4(p.x, p.y, p.z, 1.0F);
        if (c.z < 0.0F) return BoxVerdict::visible;
        float const r = 1.0F / c.w;
        float const half = static_cast<float>(s.size) * 0.5F;
        float const x = c.x * r * half + half;
        float const y = c.y * r * half + half;
        low_x = std::min(low_x, x);
        low_y = std::min(low_y, y);
        high_x = std::max(high_x, x);
        high_y = std::max(high_y, y);
        nearest = std::min(nearest, c.z * r);
    }
    auto const limit = static_cast<float>(s.size);
    if (!(high_x >= 0.0F && high_y >= 0.0F && low_x < limit && low_y < limit)) return BoxVerdict::outside;
    auto const block = [&](float x) { return static_cast<std::int32_t>(std::clamp(x, 0.0F, limit - 1.0F)) >> 3; };
    std::int32_t const x0 = block(low_x - 0.01F), y0 = block(low_y - 0.01F);
    std::int32_t const x1 = block(high_x + 0.01F), y1 = block(high_y + 0.01F);
    int level = 0;
    while ((x1 >> level) - (x0 >> level) > 1 || (y1 >> level) - (y0 >> level) > 1) ++level;
    raster::ImageView<float const> const farthest = s.pyramid.farthest(level);
    float const most = std::max(std::max(farthest.at(x0 >> level, y0 >> level), farthest.at(x1 >> level, y0 >> level)),
                                std::max(farthest.at(x0 >> level, y1 >> level), farthest.at(x1 >> level, y1 >> level)));
    return nearest * 0.999999F < most ? BoxVerdict::visible : BoxVerdict::hidden;
}

void rectangle_only(benchmark::State& state) {
    StreetView& s = street(state);
    std::vector<BoxVerdict> verdict(s.boxes.size());
    for (auto _ : state)
        for (std::size_t i = 0; i < s.boxes.size(); ++i) verdict[i] = plain_test(s, s.boxes[i]);
    report(state, s, verdict);
    count_boxes(state, s.boxes.size());
}

void exact_any_sample(benchmark::State& state) {
    StreetView& s = street(state);
    core::SerialExecutor serial;
    raster::QueryWorkspace query;
    std::vector<std::uint8_t> any(s.boxes.size());
    for (auto _ : state) raster::any_sample_passing(s.boxes, s.layer, any, query, serial);
    count_boxes(state, s.boxes.size());
}

/// Buildings whose triangles are seen at some pixel, and those whose boxes, a centimetre larger, are called visible.
void buildings(benchmark::State& state) {
    StreetView& s = street(state);
    core::SerialExecutor serial;
    std::vector<math::Aabb> boxes = s.city.boxes;
    for (math::Aabb& box : boxes) {
        box.lo = box.lo - math::vec3(0.01F);
        box.hi = box.hi + math::vec3(0.01F);
    }
    std::vector<BoxVerdict> verdict(boxes.size());
    for (auto _ : state) raster::test_boxes(boxes, s.layer, s.pyramid, verdict, serial);
    std::vector<bool> seen(boxes.size());
    for (std::uint32_t const id : s.id)
        if (id != raster::no_triangle && id >= 2048) seen[(id - 2048) / 40] = true;
    std::vector<std::uint8_t> const exact = s.exactly(boxes);
    auto const count = [](auto const& list, auto const& what) {
        return static_cast<double>(std::count(list.begin(), list.end(), what));
    };
    state.counters["inside"] = static_cast<double>(boxes.size()) - count(verdict, BoxVerdict::outside);
    state.counters["seen"] = count(seen, true);
    state.counters["exact_box"] = count(exact, std::uint8_t{1});
    state.counters["reported"] = count(verdict, BoxVerdict::visible);
    for (std::size_t i = 0; i < boxes.size(); ++i)
        if (seen[i] && verdict[i] != BoxVerdict::visible) state.SkipWithError("a building that is seen is hidden");
    count_boxes(state, boxes.size());
}

enum class Pyramid { none, handed_out, alone };

void depth_with_pyramid(benchmark::State& state, Pyramid how) {
    StreetView& s = street(state);
    core::SerialExecutor serial;
    raster::DepthTarget const target = raster::make_image(s.depth, s.size, s.size);
    raster::PassConfig config{.depth = s.view.depth};
    raster::DepthPyramid pyramid;
    if (how == Pyramid::handed_out) config.pyramid = &pyramid;
    for (auto _ : state)
        if (how == Pyramid::alone)
            raster::build_pyramid(target, s.view.depth, pyramid, serial);
        else
            raster::depth_pass({&s.draw, 1}, target, config, s.workspace, serial);
}

void sizes(benchmark::internal::Benchmark* b) { b->ArgNames({"px", "air"})->Args({1024, 0})->Args({2048, 0}); }
void views(benchmark::internal::Benchmark* b) { b->ArgNames({"px", "air"})->ArgsProduct({{1024, 2048}, {0, 1}}); }

BENCHMARK_CAPTURE(box_test, mix, raster::Kernel::automatic)->Apply(views);
BENCHMARK_CAPTURE(box_test, mix_scalar, raster::Kernel::scalar)->Apply(sizes);
BENCHMARK_CAPTURE(box_test_of, outside, BoxVerdict::outside)->Apply(sizes);
BENCHMARK_CAPTURE(box_test_of, hidden, BoxVerdict::hidden)->Apply(sizes);
BENCHMARK_CAPTURE(box_test_of, visible, BoxVerdict::visible)->Apply(sizes);
BENCHMARK(rectangle_only)->Apply(views);
BENCHMARK(exact_any_sample)->Apply(views);
BENCHMARK(buildings)->Apply(sizes);
BENCHMARK_CAPTURE(depth_with_pyramid, none, Pyramid::none)->Apply(sizes)->Args({4096, 0})->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(depth_with_pyramid, handed_out, Pyramid::handed_out)->Apply(sizes)->Args({4096, 0})->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(depth_with_pyramid, alone, Pyramid::alone)->Apply(sizes)->Args({4096, 0})->Unit(benchmark::kMillisecond);

}  // namespace
