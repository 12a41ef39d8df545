// One lookup of one receiver, by filter width and bias; the baseline is the projection and a single compare.

#include <gnomon/shadow.hpp>

#include <benchmark/benchmark.h>

#include <cstdint>
#include <vector>

namespace {

using namespace gnomon;

struct Setup {
    math::View view;
    shadow::MapView map;
    std::vector<float> texels;
    std::vector<math::vec3> receivers;
};

Setup make_setup() {
    math::OrthographicConfig config;
    config.eye_m = math::dvec3(0.0, 100.0, 0.0);
    config.target_m = math::dvec3(40.0, 0.0, 20.0);
    config.window_m = {-60.0, 60.0, -60.0, 60.0};
    config.far_m = 200.0;
    config.size_px = math::ivec2(2048, 2048);
    Setup setup;
    setup.view = math::make_orthographic(config).value();
    setup.map = shadow::make_map_view(setup.view, math::dvec3(0.0));
    setup.texels.assign(2048 * 2048, 0.3F);
    std::uint32_t state = 1;
    auto const random = [&] {
        state = state * 1664525U + 1013904223U;
        return static_cast<float>(state >> 8U) / 16777216.0F;
    };
    for (int i = 0; i < 4096; ++i) setup.receivers.push_back({10.0F + 50.0F * random(), 0.0F, 50.0F * random()});
    return setup;
}

void look_up(benchmark::State& state) {
    static Setup const setup = make_setup();
    shadow::LookupConfig config;
    config.taps = static_cast<int>(state.range(0));
    config.bias.automatic = state.range(1) != 0;
    config.bias.receiver_plane = state.range(1) != 0;
    shadow::Texels<float> const texels{setup.texels.data(), 2048};
    math::vec3 const up(0.0F, 1.0F, 0.0F);
    float sum = 0.0F;
    for ([[maybe_unused]] auto _ : state)
        for (math::vec3 const& p : setup.receivers) sum += shadow::look_up(setup.map, texels, p, up, config).visibility;
    benchmark::DoNotOptimize(sum);
    state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(setup.receivers.size()));
}

void look_up_many(benchmark::State& state) {
    static Setup const setup = make_setup();
    shadow::LookupConfig config;
    config.taps = static_cast<int>(state.range(0));
    shadow::Texels<float> const texels{setup.texels.data(), 2048};
    std::vector<shadow::Surface> surfaces;
    for (math::vec3 const& p : setup.receivers) surfaces.push_back({p, math::vec3(0.0F, 1.0F, 0.0F)});
    std::vector<shadow::Lookup> seen(surfaces.size());
    for ([[maybe_unused]] auto _ : state) {
        shadow::look_up_many(setup.map, texels, config, surfaces, seen);
        benchmark::DoNotOptimize(seen.data());
    }
    state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(setup.receivers.size()));
}

}  // namespace

BENCHMARK(look_up_many)->ArgName("taps")->Arg(1)->Arg(2)->Arg(3)->Arg(5);
BENCHMARK(look_up)->ArgNames({"taps", "automatic"})->ArgsProduct({{1, 2, 3, 5}, {0, 1}});
