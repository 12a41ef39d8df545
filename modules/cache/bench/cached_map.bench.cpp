// What an update of one map costs, by the number of objects, in nanoseconds an object. Peer: asking each object alone
// whether it touches the volume, which is the query that drawing without a cache needs too.

#include <gnomon/cache.hpp>

#include <benchmark/benchmark.h>

#include <vector>

using namespace gnomon;

namespace {

/// A street of objects, of which one in `active_in` is active.
std::vector<cache::Object> street(std::uint32_t count, std::uint32_t active_in) {
    std::vector<cache::Object> objects;
    for (std::uint32_t i = 0; i < count; ++i) {
        std::int64_t const x = (i * 37U) % 2048U;
        std::int64_t const y = (i * 101U) % 2048U;
        auto const state = active_in != 0 && i % active_in == 0 ? cache::ObjectState::active : cache::ObjectState::static_;
        objects.push_back({cache::ObjectId{i}, 1, state, cache::ObjectEvent::moved, {x, y, 100, x + 24, y + 24, 400}});
    }
    return objects;
}

void finish(benchmark::State& state, std::size_t objects) {
    state.SetItemsProcessed(static_cast<std::int64_t>(state.iterations() * static_cast<std::int64_t>(objects)));
}

void query_alone(benchmark::State& state) {
    auto const objects = street(static_cast<std::uint32_t>(state.range(0)), 20);
    std::int64_t x = 0;
    for (auto _ : state) {
        cache::Volume const v{.x = x++ % 1024, .width = 512, .height = 512};
        std::size_t hits = 0;
        for (auto const& o : objects) hits += cache::may_touch(o.box, v) ? 1U : 0U;
        benchmark::DoNotOptimize(hits);
    }
    finish(state, objects.size());
}

void still(benchmark::State& state) {
    auto const objects = street(static_cast<std::uint32_t>(state.range(0)), 20);
    cache::CachedMap map;
    for (auto _ : state) {
        benchmark::DoNotOptimize(map.plan({.width = 512, .height = 512}, objects).statics.size());
        map.commit();
    }
    finish(state, objects.size());
}

void scrolling(benchmark::State& state) {
    auto const objects = street(static_cast<std::uint32_t>(state.range(0)), 20);
    cache::CachedMap map;
    std::int64_t x = 0;
    for (auto _ : state) {
        benchmark::DoNotOptimize(map.plan({.x = x++ % 1024, .width = 512, .height = 512}, objects).statics.size());
        map.commit();
    }
    finish(state, objects.size());
}

BENCHMARK(query_alone)->Arg(1000)->Arg(100000);
BENCHMARK(still)->Arg(1000)->Arg(100000);
BENCHMARK(scrolling)->Arg(1000)->Arg(100000);

}  // namespace
