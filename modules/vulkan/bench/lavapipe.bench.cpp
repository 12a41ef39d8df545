// The CPU rasterizer against lavapipe, one thread each and one core for both, the two interleaved in one run: medians of
// eleven, and how the images differ.
//
// Lavapipe draws the same list through module vulkan's passes, recorded each time (a microsecond).
// `ms`, `lavapipe_ms`: CPU time of the whole process between submit and done, which is one thread's work on either side
// and stays honest on a loaded machine; `wall_*`: the clock on the wall. `ratio` is lavapipe_ms / ms. `memset_ms`
// writes the image once, which no pass can do without.

#include <gnomon/raster.hpp>

#include <benchmark/benchmark.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <memory>
#include <vector>

#include "../../raster/bench/city.hpp"
#include "../../raster/bench/clocks.hpp"
#include "../../raster/bench/one_core.hpp"
#include "lavapipe_gpu.hpp"

namespace {

using namespace gnomon;

/// Pixels that only one image covers, and how depths differ where both do: the greatest difference, and the pixels
/// whose difference is so large that they must lie on the edge between two surfaces and see one in one image and the
/// other in the other. Those are counted, not measured.
void compare(benchmark::State& state, std::vector<float> const& ours, std::vector<float> const& theirs) {
    std::size_t coverage = 0;
    std::size_t beyond = 0;
    std::size_t other_surface = 0;
    float depth = 0.0F;
    for (std::size_t i = 0; i < ours.size(); ++i) {
        if ((ours[i] == 1.0F) != (theirs[i] == 1.0F)) {
            ++coverage;
            continue;
        }
        float const difference = std::abs(ours[i] - theirs[i]);
        beyond += difference > 2e-6F ? 1U : 0U;
        other_surface += difference >= 1e-4F ? 1U : 0U;
        if (difference < 1e-4F) depth = std::max(depth, difference);
    }
    state.counters["coverage_px"] = static_cast<double>(coverage);
    state.counters["beyond_2e-6_px"] = static_cast<double>(beyond);
    state.counters["beyond_1e-4_px"] = static_cast<double>(other_surface);
    state.counters["depth_e-6"] = static_cast<double>(depth) * 1e6;
}

/// Lavapipe, rasterizing on the queue's own thread.
struct Lavapipe {
    Lavapipe() {
        setenv("LP_NUM_THREADS", "0", 1);
        device = std::make_unique<vulkan::bench::LavapipeGpu>(true);
        if (device->gpu() == nullptr || !device->is_lavapipe()) return;
        if (auto made = vulkan::Backend::make(device->gpu(), device->host())) backend = *std::move(made);
    }

    std::unique_ptr<vulkan::bench::LavapipeGpu> device;
    std::unique_ptr<vulkan::Backend> backend;  ///< Null where there is none.
};

/// One draw into one target, over and over.
class Peer {
  public:
    Peer(backend::Backend& b, backend::Draw const& draw, std::int32_t size)
        : backend_(b), list_(b.keep({&draw, 1})), target_(b.make_target({.size_px = {size, size}})), size_(size) {
        layer_.origin = draw.origin;
        layer_.clip_from_relative = draw.clip_from_relative;
        layer_.depth = math::Depth::forward;
    }
    ~Peer() {
        if (list_) static_cast<void>(backend_.release(*list_));
        if (target_) static_cast<void>(backend_.release(*target_));
    }
    Peer(Peer const&) = delete;
    Peer& operator=(Peer const&) = delete;

    [[nodiscard]] bool draw() {
        return list_ && target_ && backend_.draw(*list_, *target_, {&layer_, 1}) && backend_.finish();
    }
    [[nodiscard]] std::vector<float> read() {
        std::vector<float> depth(static_cast<std::size_t>(size_) * static_cast<std::size_t>(size_));
        auto const bytes = std::as_writable_bytes(std::span<float>(depth));
        if (!backend_.read({*target_, 0, backend::Plane::depth, {0, 0, size_, size_}}, bytes) || !backend_.finish())
            depth.clear();
        return depth;
    }

  private:
    backend::Backend& backend_;
    backend::Result<backend::DrawListId> list_;
    backend::Result<backend::TargetId> target_;
    backend::PassLayer layer_;
    std::int32_t size_;
};

void against_lavapipe(benchmark::State& state) {
    bench::OneCore const one_core;  // For lavapipe's thread too, which the next line starts.
    static Lavapipe const lavapipe;
    if (lavapipe.backend == nullptr) {
        state.SkipWithError("no lavapipe on this machine (Debian: mesa-vulkan-drivers)");
        return;
    }
    bench::City const city = bench::make_city(static_cast<int>(state.range(0)));
    auto const size = static_cast<std::int32_t>(state.range(2));
    math::View const view = bench::make_view(state.range(1) == 0, size);
    raster::Draw const draw{.positions = std::span<math::vec3 const>(city.positions),
                            .indices = std::span<std::uint32_t const>(city.indices),
                            .origin = math::to_float(view.eye_m),
                            .clip_from_relative = math::clip_from_relative(view)};
    Peer peer(*lavapipe.backend, draw, size);
    std::vector<float> depth(static_cast<std::size_t>(size) * static_cast<std::size_t>(size));
    raster::Workspace workspace;
    core::SerialExecutor serial;
    auto const ours = [&] {
        raster::depth_pass({&draw, 1}, raster::make_image(depth.data(), size, size), {.depth = math::Depth::forward},
                           workspace, serial);
    };
    ours();
    if (!peer.draw()) {
        state.SkipWithError("lavapipe failed");
        return;
    }
    bench::Times mine;
    bench::Times theirs;
    bench::Times floor;
    for (auto _ : state) {
        mine.measure(ours);
        theirs.measure([&] { benchmark::DoNotOptimize(peer.draw()); });
    }
    std::vector<float> const image = peer.read();
    if (image.size() == depth.size()) compare(state, depth, image);
    else state.SkipWithError("lavapipe's image could not be read");
    for (int i = 0; i < 5; ++i)
        floor.measure([&] {
            std::memset(depth.data(), i, depth.size() * sizeof(float));
            benchmark::ClobberMemory();
        });
    state.counters["ms"] = bench::median(mine.cpu);
    state.counters["lavapipe_ms"] = bench::median(theirs.cpu);
    state.counters["ratio"] = bench::median(theirs.cpu) / bench::median(mine.cpu);
    state.counters["memset_ms"] = bench::median(floor.cpu);
    state.counters["wall_ms"] = bench::median(mine.wall);
    state.counters["wall_lavapipe_ms"] = bench::median(theirs.wall);
    state.counters["wall_ratio"] = bench::median(theirs.wall) / bench::median(mine.wall);
}

BENCHMARK(against_lavapipe)
    ->ArgNames({"city", "persp", "px"})
    ->ArgsProduct({{0, 1, 2}, {0, 1}, {1024, 2048, 4096}})
    ->Unit(benchmark::kMillisecond)
    ->Iterations(11);

}  // namespace
