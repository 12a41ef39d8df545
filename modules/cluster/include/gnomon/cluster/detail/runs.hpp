#pragma once
// Runs of equal keys in blocks of samples: found, numbered, ranked and filled with their clusters' indices.
//
// The reference, and what runs where there is no AVX2.

#include <gnomon/cluster/key.hpp>

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>

namespace gnomon::cluster::detail {

/// Samples of a block: runs end with it, so that blocks go to threads. What there is of it fits the second-level cache.
inline constexpr std::size_t block_samples = 16384;
/// Room for a block's runs: one a sample, where the last one ends, and groups that are read or written but not used.
inline constexpr std::size_t block_room = block_samples + 16;

struct BlockStats {
    std::uint32_t runs = 0;
    std::uint32_t keys = 0;  ///< Local sort: unique ones of the block.
    std::uint32_t background = 0;
    std::uint32_t invalid = 0;
};

/// A block's range of samples.
struct Block {
    std::uint32_t begin;
    std::uint32_t end;
};

/// The runs of a block: run r is [start[r], start[r + 1]).
struct Runs {
    std::uint32_t* start;
    std::uint32_t* number;  ///< Of the key in its layout, then of its cluster; `no_cluster` for none.
    std::uint8_t* changes;  ///< AVX2: which of eight samples begin a run, from the block's second sample on.
    std::size_t count;
};

/// 64 keys' flags, and how many are set before them.
struct RankedWord {
    std::uint64_t bits = 0;
    std::uint64_t rank = 0;
};

[[nodiscard]] inline std::size_t block_count(std::size_t samples) noexcept {
    return (samples + block_samples - 1) / block_samples;
}

[[nodiscard]] inline Block block_at(std::size_t block, std::size_t samples) noexcept {
    return {static_cast<std::uint32_t>(block * block_samples),
            static_cast<std::uint32_t>(std::min(samples, (block + 1) * block_samples))};
}

/// Whether 32 bytes at `a` and at `b` differ: integers that the compiler makes wide ones of.
[[nodiscard, gnu::always_inline]] inline bool differs_32(void const* a, void const* b) noexcept {
    std::uint64_t p[4];
    std::uint64_t q[4];
    std::memcpy(p, a, 32);
    std::memcpy(q, b, 32);
    return ((p[0] ^ q[0]) | (p[1] ^ q[1]) | (p[2] ^ q[2]) | (p[3] ^ q[3])) != 0;
}

/// Writes the starts of a block's runs to `start`, and the block's end behind them.
///
/// expects: a block with a sample
/// returns: how many
template <Key K>
[[nodiscard]] inline std::uint32_t find_starts_plain(K const* keys, Block const& block, std::uint32_t* start) noexcept {
    constexpr std::uint32_t group = 32 / sizeof(K);
    std::uint32_t count = 0;
    start[count++] = block.begin;
    std::uint32_t i = block.begin + 1;
    for (; i + group <= block.end; i += group) {
        if (!differs_32(keys + i, keys + i - 1)) continue;
        for (std::uint32_t k = i; k < i + group; ++k) {  // no branch: each start is written, and kept if it is one
            start[count] = k;
            count += keys[k] != keys[k - 1] ? 1U : 0U;
        }
    }
    for (; i < block.end; ++i) {
        start[count] = i;
        count += keys[i] != keys[i - 1] ? 1U : 0U;
    }
    start[count] = block.end;
    return count;
}

/// Gives each run its key's number, or none; 0 where numbers have more than 32 bits.
template <Key K>
[[gnu::always_inline]] inline void number_runs(KeyLayout<K> const& layout, K const* keys, Runs const& runs,
                                               BlockStats& stats) noexcept {
    bool const numbered = layout.domain() < no_cluster;
    std::uint32_t background = 0;
    std::uint32_t none = 0;
    for (std::size_t r = 0; r < runs.count; ++r) {
        K const key = keys[runs.start[r]];
        KeyParts const p = unpack_key(key);
        bool const holds = static_cast<unsigned>(p.column < layout.columns) & static_cast<unsigned>(p.row < layout.rows) &
                           static_cast<unsigned>(p.slice < layout.slices) & static_cast<unsigned>(p.cell < layout.cells);
        std::uint32_t const number = ((p.row * layout.columns + p.column) * layout.slices + p.slice) * layout.cells + p.cell;
        std::uint32_t const length = runs.start[r + 1] - runs.start[r];
        runs.number[r] = holds ? (numbered ? number : 0U) : no_cluster;
        none += holds ? 0U : length;
        background += key == no_key<K> ? length : 0U;
    }
    stats.background = background;
    stats.invalid = none - background;
}

/// Replaces each run's number by how many keys there are before it.
[[gnu::always_inline]] inline void rank_runs(Runs const& runs, RankedWord const* words) noexcept {
    for (std::size_t r = 0; r < runs.count; ++r) {
        std::uint32_t const number = runs.number[r];
        if (number == no_cluster) continue;
        RankedWord const& word = words[number / 64];
        std::uint64_t const before = word.bits & ((1ULL << number % 64) - 1);
        runs.number[r] = static_cast<std::uint32_t>(word.rank) + static_cast<std::uint32_t>(std::popcount(before));
    }
}

/// Writes each run's number to all of its samples: eight at a time, into what the next runs write again.
[[gnu::always_inline]] inline void fill_runs(Runs const& runs, Block const& block, std::uint32_t* index) noexcept {
    for (std::size_t r = 0; r < runs.count; ++r) {
        std::uint32_t const number = runs.number[r];
        std::uint32_t const value[8] = {number, number, number, number, number, number, number, number};
        std::uint32_t const end = runs.start[r + 1];
        std::uint32_t i = runs.start[r];
        for (; i < end && i + 8 <= block.end; i += 8) std::memcpy(index + i, value, sizeof value);
        for (; i < end; ++i) index[i] = number;
    }
}

/// The kernels of any machine; `runs_avx2.hpp` has others.
struct PlainKernels {
    template <Key K>
    static BlockStats find(KeyLayout<K> const& layout, K const* keys, Block const& block, Runs runs) noexcept {
        BlockStats stats;
        stats.runs = find_starts_plain(keys, block, runs.start);
        runs.count = stats.runs;
        number_runs(layout, keys, runs, stats);
        return stats;
    }
    static void rank(Runs const& runs, RankedWord const* words) noexcept { rank_runs(runs, words); }
    template <Key K>
    static void fill(Runs const& runs, Block const& block, std::uint32_t* index) noexcept {
        fill_runs(runs, block, index);
    }
};

}  // namespace gnomon::cluster::detail
