// The CPU time to record a frame: every verb of the backend but those that make, on a driver that does nothing, so that
// the time is the module's alone; and on the device, with the driver's part and without validation.

#include "../tests/frame_rig.hpp"
#include "../tests/null_driver.hpp"
#include "lavapipe_gpu.hpp"

#include <benchmark/benchmark.h>

#include <chrono>

namespace {

using namespace gnomon;

/// A target of two layers drawn by one list of so many draws: the time of the verb alone, not of `finish`.
void record_draws(benchmark::State& state, backend::Backend& b) {
    using Clock = std::chrono::steady_clock;
    vulkan::test::FrameRig rig;
    if (auto made = rig.make(b, static_cast<std::size_t>(state.range(0))); !made) {
        state.SkipWithError(made.failure().message.c_str());
        return;
    }
    std::uint64_t draw_calls = 0;
    for (auto _ : state) {
        b.stage("pass");  // begins the frame
        auto const begin = Clock::now();
        auto const counts = rig.draw(b, 0);
        state.SetIterationTime(std::chrono::duration<double>(Clock::now() - begin).count());
        if (!counts || !b.finish()) state.SkipWithError("the pass failed");
        else draw_calls = counts->draw_calls;
    }
    state.counters["draw_calls"] = static_cast<double>(draw_calls);
}

vulkan::Properties generous() {
    vulkan::Properties p;
    p.limits.maxImageDimension2D = p.limits.maxFramebufferWidth = p.limits.maxFramebufferHeight = 16384;
    p.limits.maxViewportDimensions[0] = p.limits.maxViewportDimensions[1] = 16384;
    p.limits.maxImageArrayLayers = p.limits.maxFramebufferLayers = 256;
    p.limits.maxStorageBufferRange = ~0U;
    p.limits.maxDrawIndexedIndexValue = ~0U;
    p.limits.maxDrawIndirectCount = ~0U;
    p.limits.maxComputeWorkGroupCount[0] = p.limits.maxComputeWorkGroupCount[1] = 65535;
    p.limits.maxPerStageDescriptorStorageBuffers = p.limits.maxPerStageDescriptorSampledImages = 64;
    p.limits.nonCoherentAtomSize = 64;
    return p;
}

vulkan::Features all_features() {
    vulkan::Features f;
    f.multi_draw_indirect = f.draw_indirect_first_instance = f.layer_from_vertex_shader = f.geometry_shader = true;
    f.depth_clamp = f.precise_occlusion_queries = f.shader_float64 = true;
    return f;
}

/// Without multi_draw_indirect each draw is a call: the peer.
void null_pass(benchmark::State& state, bool indirect) {
    vulkan::Features features = all_features();
    features.multi_draw_indirect = indirect;
    auto const b = vulkan::Backend::make(vulkan::test::null_gpu(generous(), features), vulkan::test::null_host());
    record_draws(state, **b);
}

void null_frame(benchmark::State& state) {
    auto const b = vulkan::Backend::make(vulkan::test::null_gpu(generous(), all_features()), vulkan::test::null_host());
    vulkan::test::FrameRig rig;
    if (!rig.make(**b, static_cast<std::size_t>(state.range(0)))) state.SkipWithError("not made");
    std::uint64_t const before = vulkan::test::null_driver::counts.commands;
    for (auto _ : state)
        if (!rig.step(**b)) state.SkipWithError("a verb failed");
    state.counters["commands"] = static_cast<double>(vulkan::test::null_driver::counts.commands - before) /
                                 static_cast<double>(state.iterations());
}

void lavapipe_pass(benchmark::State& state, bool indirect) {
    vulkan::bench::LavapipeGpu device(indirect);
    if (device.gpu() == nullptr) {
        state.SkipWithError("no Vulkan here");
        return;
    }
    auto const b = vulkan::Backend::make(device.gpu(), device.host());
    record_draws(state, **b);
}

void batches(benchmark::internal::Benchmark* b) {
    b->ArgName("batches")->Arg(1)->Arg(100)->Arg(10'000)->Unit(benchmark::kMicrosecond);
}

BENCHMARK_CAPTURE(null_pass, indirect, true)->Apply(batches)->UseManualTime();
BENCHMARK_CAPTURE(null_pass, a_call_each, false)->Apply(batches)->UseManualTime();
BENCHMARK_CAPTURE(lavapipe_pass, indirect, true)->Apply(batches)->UseManualTime()->Iterations(30);
BENCHMARK_CAPTURE(lavapipe_pass, a_call_each, false)->Apply(batches)->UseManualTime()->Iterations(30);
BENCHMARK(null_frame)->Apply(batches);

}  // namespace
