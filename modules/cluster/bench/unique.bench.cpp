// Unique clusters of a 1080p picture's keys, each method beside std::sort + unique + a search per run of samples, all in
// one run. `ratio` is the peer's least CPU time over the method's; one thread.

#include "picture.hpp"

#include <benchmark/benchmark.h>

#include <algorithm>

using namespace gnomon;

namespace {

struct Peer {
    std::vector<std::uint32_t> keys;
    std::vector<std::uint32_t> index;

    /// The straight way, but for one thing in its favour: a sample like the one before is not searched for again.
    void run(std::vector<std::uint32_t> const& in) {
        keys = in;
        std::sort(keys.begin(), keys.end());
        keys.erase(std::unique(keys.begin(), keys.end()), keys.end());
        index.resize(in.size());
        for (std::size_t i = 0; i < in.size(); ++i)
            index[i] = i != 0 && in[i] == in[i - 1]
                           ? index[i - 1]
                           : static_cast<std::uint32_t>(std::lower_bound(keys.begin(), keys.end(), in[i]) - keys.begin());
    }
};

void unique(benchmark::State& state) {
    auto const& p = scene::shared_picture(state.range(1) != 0, state.range(2) != 0 ? 3 : 0);
    cluster::UniqueWorkspace<std::uint32_t> work;
    std::vector<std::uint32_t> keys(p.keys.size());
    std::vector<std::uint32_t> index(p.keys.size());
    cluster::UniqueOut<std::uint32_t> const out{keys, index};
    std::span<std::uint32_t const> const in(p.keys);
    Peer peer;
    scene::Race race;
    cluster::UniqueStats stats;
    for (auto _ : state)
        race.run(
            [&] {
                if (state.range(0) == 0) stats = unique_by_bitmap(p.layout, in, out, work);
                if (state.range(0) == 1) stats = unique_by_page_table(p.layout, in, out, work);
                if (state.range(0) == 2) stats = unique_by_local_sort(p.layout, in, out, work);
                benchmark::DoNotOptimize(index.data());
            },
            [&] { peer.run(p.keys); });
    std::size_t runs = 0;
    for (std::size_t i = 1; i < p.keys.size(); ++i) runs += p.keys[i] != p.keys[i - 1] ? 1U : 0U;
    state.counters["clusters"] = static_cast<double>(stats.clusters);
    state.counters["runs"] = static_cast<double>(runs);
    state.counters["ours_ms"] = race.ours_s * 1e3;
    state.counters["peer_ms"] = race.peer_s * 1e3;
    state.counters["ratio"] = race.peer_s / race.ours_s;
}
BENCHMARK(unique)->ArgNames({"method", "leaves", "normals"})->ArgsProduct({{0, 1, 2}, {0, 1}, {0, 1}})->Iterations(25)->Unit(benchmark::kMillisecond);

}  // namespace
