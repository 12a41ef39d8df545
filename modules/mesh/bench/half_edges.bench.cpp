// Half-edges of a wavy sheet and of a soup of quads without shared corners, beside a hash map from pairs of vertices to
// half-edges in the same run. CPU time; `ratio` is ours over the map's.

#include <gnomon/mesh/half_edges.hpp>

#include "../tests/meshes.hpp"

#include <benchmark/benchmark.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <ctime>
#include <limits>
#include <unordered_map>

using namespace gnomon;

namespace {

double cpu_seconds() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

/// What people write first: twins only, no welding, no report.
std::size_t twins_by_map(meshes::Mesh const& m) {
    std::unordered_map<std::uint64_t, std::uint32_t> edges;
    edges.reserve(m.indices.size());
    std::size_t paired = 0;
    for (std::uint32_t h = 0; h < m.indices.size(); ++h) {
        std::uint64_t const a = m.indices[h];
        std::uint64_t const b = m.indices[mesh::next(h)];
        paired += edges.contains(b << 32U | a) ? 1U : 0U;
        edges.emplace(a << 32U | b, h);
    }
    return paired;
}

void half_edges(benchmark::State& state) {
    auto const side = static_cast<std::uint32_t>(std::sqrt(static_cast<double>(state.range(0)) / 2.0));
    bool const exploded = state.range(1) != 0;
    meshes::Mesh const m = exploded ? meshes::sheet(side).exploded() : meshes::sheet(side);
    mesh::Workspace workspace;
    mesh::HalfEdges built;
    double ours_s = std::numeric_limits<double>::infinity();
    double map_s = ours_s;
    for (auto _ : state) {
        double const start = cpu_seconds();
        build_half_edges(m.list(), workspace, built);
        double const middle = cpu_seconds();
        benchmark::DoNotOptimize(twins_by_map(m));
        ours_s = std::min(ours_s, middle - start);
        map_s = std::min(map_s, cpu_seconds() - middle);
    }
    auto const n = static_cast<double>(m.list().size());
    state.counters["triangles"] = n;
    state.counters["ns_per_triangle"] = ours_s / n * 1e9;
    state.counters["ratio"] = ours_s / map_s;
    state.counters["open"] = static_cast<double>(built.report.open_edges);
}

}  // namespace

// Arguments: triangles, whether every corner has a position of its own.
BENCHMARK(half_edges)->ArgsProduct({{1000, 30'000, 1'000'000}, {0, 1}})->Unit(benchmark::kMillisecond)->Iterations(3);
