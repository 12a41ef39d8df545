#pragma once
// The steps that all methods of unique.hpp begin and end with.

#include <gnomon/cluster/detail/runs_avx2.hpp>
#include <gnomon/cluster/unique_workspace.hpp>
#include <gnomon/core/contract.hpp>
#include <gnomon/core/executor.hpp>

namespace gnomon::cluster::detail {

/// What every method begins with: room, and the runs of each block with what `mark` does to them.
template <Key K, core::Executor E, class F>
[[nodiscard]] UniqueStats prepare_runs(KeyLayout<K> const& layout, std::span<K const> keys, UniqueWorkspace<K>& work,
                                       E& executor, F const& mark) {
    std::size_t const blocks = block_count(keys.size());
    work.grow(blocks);
    executor.parallel_for(blocks, 1, [&](std::size_t begin, std::size_t end) {
        with_kernels([&](auto kernels) {
            for (std::size_t b = begin; b < end; ++b) {
                work.blocks[b] = kernels.find(layout, keys.data(), block_at(b, keys.size()), work.runs(b));
                mark(b, work.runs(b));
            }
        });
    });
    UniqueStats stats;
    for (std::size_t b = 0; b < blocks; ++b) {
        stats.background += work.blocks[b].background;
        stats.invalid += work.blocks[b].invalid;
    }
    return stats;
}

/// What every method ends with: each run's place by `place`, then each sample's.
template <Key K, core::Executor E, class F>
void link_samples(std::span<std::uint32_t> index, UniqueWorkspace<K>& work, E& executor, F const& place) {
    executor.parallel_for(block_count(index.size()), 1, [&](std::size_t begin, std::size_t end) {
        with_kernels([&](auto kernels) {
            for (std::size_t b = begin; b < end; ++b) {
                place(kernels, b, work.runs(b));
                kernels.template fill<K>(work.runs(b), block_at(b, index.size()), index.data());
            }
        });
    });
}

}  // namespace gnomon::cluster::detail
