// What techniques evaluate, counted without shading. [Olsson 2014, Paper I, 8: lighting computations]

#include "../detail.hpp"
#include "lighting.hpp"
#include "../workspace.hpp"

#include <gnomon/math/lanes.hpp>

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace gnomon::pipeline {

namespace {

struct ListedSamples {
    std::span<math::vec3 const> position;
    std::span<std::uint32_t const> list_of;
    Lighting const& l;

    [[nodiscard]] std::uint32_t listed(std::size_t i) const noexcept { return list_of[i] != no_list ? l.list_cells[list_of[i]].count : 0; }
};

/// How many of the lights of their lists reach samples [begin, end), as shading sees it.
template <std::size_t N>
[[gnu::always_inline]] inline std::uint64_t count_reaching(ListedSamples const& s, std::size_t begin, std::size_t end) noexcept {
    using Group = math::Lanes<float, N>;
    std::uint64_t reaching = 0;
    for (std::size_t i = begin; i < end;) {
        std::size_t count = 1;
        while (count < N && i + count < end && s.list_of[i + count] == s.list_of[i]) ++count;
        float p[3][N];
        for (std::size_t k = 0; k < N; ++k)
            for (math::axis_t c = 0; c < 3; ++c) p[c][k] = s.position[i + (k < count ? k : count - 1)][c];
        formula::Vec3<Group> const position(Group::load(p[0]), Group::load(p[1]), Group::load(p[2]));
        std::uint32_t const there = (1U << count) - 1U;
        lights::Cell const cell = s.list_of[i] != no_list ? s.l.list_cells[s.list_of[i]] : lights::Cell{};
        for (std::uint32_t k = 0; k < cell.count; ++k) {
            lights::ShadedLight const& light = s.l.prepared.shaded[s.l.list_indices[cell.offset + k]];
            reaching += static_cast<std::uint64_t>(__builtin_popcount(math::bits(gn_see_light(light, position).within.v) & there));
        }
        i += count;
    }
    return reaching;
}

#if GNOMON_VECTOR_EXTENSION && defined(__x86_64__)
[[gnu::target("avx2,popcnt"), gnu::flatten]] std::uint64_t count_reaching_avx2(ListedSamples const& s, std::size_t begin, std::size_t end) noexcept {
    return count_reaching<8>(s, begin, end);
}
#endif

std::uint64_t count_reaching(ListedSamples const& s, std::size_t begin, std::size_t end) noexcept {
#if GNOMON_VECTOR_EXTENSION && defined(__x86_64__)
    if (__builtin_cpu_supports("avx2")) return count_reaching_avx2(s, begin, end);
#endif
    return count_reaching<4>(s, begin, end);
}

}  // namespace

Result<ComputationCounts> count_computations(LightingRun const& on) {
    Lighting& l = on.workspace.state().lighting;
    prepare_lights(on.frame, on.lights, l.prepared);
    std::vector<StageTime> stages;
    auto clustered = find_clustered_lists(on, stages);
    if (!clustered) return std::move(clustered).failure();
    ComputationCounts counts;
    counts.clusters = l.list_cells.size();
    ListedSamples const samples{on.frame.samples.position, l.list_of_sample, l};
    std::atomic<std::uint64_t> reaching{0};
    on.executor.parallel_for(l.list_of_sample.size(), sample_grain, [&](std::size_t begin, std::size_t end) {
        reaching.fetch_add(count_reaching(samples, begin, end), std::memory_order_relaxed);
    });
    counts.stencil = reaching.load();
    for (std::size_t i = 0; i < l.list_of_sample.size(); ++i) counts.clustered += samples.listed(i);
    auto tiled = find_tiled_lists(on, stages);
    if (!tiled) return std::move(tiled).failure();
    ListedSamples const tiles{on.frame.samples.position, l.list_of_sample, l};
    for (std::size_t i = 0; i < l.list_of_sample.size(); ++i) counts.tiled += tiles.listed(i);
    return counts;
}

}  // namespace gnomon::pipeline
