// Agglomerated batches beside a plain cut of the Morton curve into 128s, in the same run: CPU time of all threads, and
// what the batches are like. `ratio` is agglomeration over the cut; `diagonals` and `areas` too (sums over all boxes).

#include <gnomon/batch/build.hpp>

#include "../tests/shapes.hpp"

#include <benchmark/benchmark.h>

#include <algorithm>
#include <cmath>
#include <ctime>
#include <limits>

using namespace gnomon;

namespace {

/// Of all threads of this process: other processes' load does not count.
double cpu_seconds() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

/// Batches of consecutive triangles along the curve.
void cut_the_curve(batch::Triangles const& list, batch::Workspace& workspace, batch::Batches& out) {
    core::SerialExecutor const serial;
    out.left_out = batch::detail::collect(list, workspace.keys, serial);
    out.triangles.clear();
    out.batches.clear();
    for (batch::detail::Key const& key : workspace.keys) {
        auto const place = static_cast<std::uint32_t>(out.triangles.size());
        if (out.batches.empty() || out.batches.back().count == 128 || out.batches.back().group != key.group)
            out.batches.push_back({place, 0, key.group});
        ++out.batches.back().count;
        out.triangles.push_back(key.triangle);
    }
    out.boxes.resize(out.batches.size());
    static_cast<void>(refit(out, list, out.boxes));
}

struct Sums {
    double diagonals = 0.0;
    double areas = 0.0;

    explicit Sums(batch::Batches const& batches) {
        for (math::Aabb const& box : batches.boxes) {
            math::dvec3 const e = math::to_double(box.hi) - math::to_double(box.lo);
            diagonals += std::sqrt(e.x * e.x + e.y * e.y + e.z * e.z);
            areas += 2.0 * (e.x * e.y + e.y * e.z + e.z * e.x);
        }
    }
};

void build(benchmark::State& state, shapes::Mesh (*make)(std::size_t)) {
    shapes::Mesh const mesh = make(static_cast<std::size_t>(state.range(0)));
    core::SerialExecutor const serial;
    batch::Workspace workspace;
    batch::Batches ours;
    batch::Batches cut;
    double ours_s = std::numeric_limits<double>::infinity();
    double cut_s = ours_s;
    double refit_s = ours_s;
    for (auto _ : state) {
        double const start = cpu_seconds();
        build_batches(mesh.list(), {}, workspace, ours, serial);
        double const middle = cpu_seconds();
        cut_the_curve(mesh.list(), workspace, cut);
        double const end = cpu_seconds();
        static_cast<void>(refit(ours, mesh.list(), ours.boxes));
        ours_s = std::min(ours_s, middle - start);
        cut_s = std::min(cut_s, end - middle);
        refit_s = std::min(refit_s, cpu_seconds() - end);
    }
    auto const n = static_cast<double>(mesh.list().size());
    state.counters["triangles"] = n;
    state.counters["ns_per_triangle"] = ours_s / n * 1e9;
    state.counters["ratio"] = ours_s / cut_s;
    state.counters["refit_ns_per_triangle"] = refit_s / n * 1e9;
    state.counters["fill"] = n / static_cast<double>(ours.batches.size()) / 128.0;
    state.counters["batches"] = static_cast<double>(ours.batches.size()) / static_cast<double>(cut.batches.size());
    state.counters["diagonals"] = Sums(ours).diagonals / Sums(cut).diagonals;
    state.counters["areas"] = Sums(ours).areas / Sums(cut).areas;
    state.counters["hurried"] = static_cast<double>(ours.hurried);
}

shapes::Mesh make_soup(std::size_t n) { return shapes::soup(n); }

}  // namespace

BENCHMARK_CAPTURE(build, town, &shapes::town)->Arg(1000)->Arg(10'000)->Arg(100'000)->Arg(1'000'000)->Unit(benchmark::kMillisecond)->Iterations(2);
BENCHMARK_CAPTURE(build, soup, &make_soup)->Arg(1000)->Arg(10'000)->Arg(100'000)->Arg(1'000'000)->Unit(benchmark::kMillisecond)->Iterations(2);
BENCHMARK_CAPTURE(build, needles, &shapes::needles)->Arg(1000)->Arg(10'000)->Arg(100'000)->Unit(benchmark::kMillisecond)->Iterations(1);
