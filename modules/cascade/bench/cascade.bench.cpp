// A frame's plan, and scrolling a map beside copying and clearing it.

#include <benchmark/benchmark.h>

#include <gnomon/cascade.hpp>

#include <cstdint>
#include <cstring>
#include <vector>

namespace {

using namespace gnomon;

constexpr std::int32_t size_px = 512;

template <class T>
std::vector<T> some_map() {
    std::vector<T> map(static_cast<std::size_t>(size_px) * size_px);
    std::uint32_t state = 1;
    for (T& texel : map) {
        state = state * 1664525U + 1013904223U;
        if constexpr (std::is_integral_v<T>)
            texel = static_cast<T>(state >> 16U);
        else
            texel = static_cast<T>(state >> 8U) * 0x1p-24F;
    }
    return map;
}

template <class T>
cascade::MapScroll some_scroll(std::int64_t z) {
    return {{3, -5, z}, std::is_integral_v<T> ? cascade::unorm16_codes : cascade::float_codes, math::Depth::forward};
}

template <class T>
void scroll_map(benchmark::State& state) {
    auto from = some_map<T>();
    auto to = from;
    for (auto _ : state) {
        auto const stats = cascade::scroll<T>(cascade::MapTexels<T const>{from.data(), size_px, size_px},
                                              {to.data(), size_px, size_px}, some_scroll<T>(state.range(0)));
        benchmark::DoNotOptimize(stats.moved);
        benchmark::ClobberMemory();
    }
    state.SetItemsProcessed(state.iterations() * size_px * size_px);
}

template <class T>
void scroll_map_in_place(benchmark::State& state) {
    auto map = some_map<T>();
    for (auto _ : state) {
        auto const stats = cascade::scroll_in_place<T>({map.data(), size_px, size_px}, some_scroll<T>(state.range(0)));
        benchmark::DoNotOptimize(stats.moved);
        benchmark::ClobberMemory();
    }
    state.SetItemsProcessed(state.iterations() * size_px * size_px);
}

template <class T>
void scroll_torus(benchmark::State& state) {
    auto map = some_map<T>();
    cascade::Volume v{{}, size_px, some_scroll<T>(0).codes, 1.0, 1.0};
    for (auto _ : state) {
        v.at.x += 3;
        v.at.y -= 5;
        benchmark::DoNotOptimize(
            cascade::scroll_toroidal<T>({map.data(), size_px, size_px}, v, some_scroll<T>(state.range(0))));
        benchmark::ClobberMemory();
    }
    state.SetItemsProcessed(state.iterations() * size_px * size_px);
}

/// The peer: what any scroll must at least do, row by row.
template <class T>
void copy_map(benchmark::State& state) {
    auto const from = some_map<T>();
    auto to = from;
    for (auto _ : state) {
        for (std::size_t y = 0; y < size_px; ++y)
            std::memcpy(&to[y * size_px], &from[y * size_px], size_px * sizeof(T));
        benchmark::ClobberMemory();
    }
    state.SetItemsProcessed(state.iterations() * size_px * size_px);
}

void plan_frame(benchmark::State& state) {
    cascade::CascadeConfig config;
    config.splits.far_m = 200.0;
    config.fit.extent = state.range(0) == 0 ? cascade::Extent::diameter : cascade::Extent::sphere;
    auto camera = math::make_perspective({.size_px = {1280, 720}}).value();
    cascade::Cascades cascades;
    for (auto _ : state) {
        camera.eye_m.x += 0.5;
        auto const frame = cascade::plan(cascades, config, camera);
        cascade::commit(cascades, *frame);
    }
    benchmark::DoNotOptimize(cascades.held[3].volume.at.x);
}

BENCHMARK(plan_frame)->ArgName("sphere")->Arg(0)->Arg(1);
BENCHMARK(copy_map<std::uint16_t>);
BENCHMARK(scroll_map<std::uint16_t>)->ArgName("z")->Arg(0)->Arg(7);
BENCHMARK(scroll_map_in_place<std::uint16_t>)->ArgName("z")->Arg(0)->Arg(7);
BENCHMARK(scroll_torus<std::uint16_t>)->ArgName("z")->Arg(0)->Arg(7);
BENCHMARK(copy_map<float>);
BENCHMARK(scroll_map<float>)->ArgName("z")->Arg(0)->Arg(7);
BENCHMARK(scroll_map_in_place<float>)->ArgName("z")->Arg(0)->Arg(7);
BENCHMARK(scroll_torus<float>)->ArgName("z")->Arg(0)->Arg(7);

}  // namespace
