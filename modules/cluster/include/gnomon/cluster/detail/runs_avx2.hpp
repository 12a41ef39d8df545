#pragma once
// The kernels of runs.hpp for x86 with AVX2, which is looked for at run time. The same results; no branch on the keys.

#include <gnomon/cluster/detail/runs.hpp>
#include <gnomon/math/lanes.hpp>

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>

#if GNOMON_VECTOR_EXTENSION && defined(__x86_64__)
#define GNOMON_CLUSTER_AVX2 1
#else
#define GNOMON_CLUSTER_AVX2 0
#endif

namespace gnomon::cluster::detail {

#if GNOMON_CLUSTER_AVX2

[[nodiscard]] inline bool has_avx2() noexcept {
    return __builtin_cpu_supports("avx2") && __builtin_cpu_supports("popcnt") && __builtin_cpu_supports("bmi");
}

using EightOf = std::array<std::uint32_t, 8>;

/// For each byte, the places of its set bits, side by side: eight samples' changes become the starts of runs. 8 KB.
inline constexpr auto set_bits_of = [] {
    std::array<EightOf, 256> table{};
    for (std::uint32_t mask = 0; mask < 256; ++mask)
        for (std::uint32_t bit = 0, n = 0; bit < 8; ++bit)
            if ((mask >> bit & 1U) != 0) table[mask][n++] = bit;
    return table;
}();

/// For bits 1 to 7 of a byte of changes, each sample's run, counted from the first sample's. 4 KB.
inline constexpr auto runs_of = [] {
    std::array<EightOf, 128> table{};
    for (std::uint32_t upper = 0; upper < 128; ++upper)
        for (std::uint32_t bit = 1; bit < 8; ++bit) table[upper][bit] = table[upper][bit - 1] + (upper >> (bit - 1) & 1U);
    return table;
}();

struct Avx2Kernels {
    [[gnu::target("avx2,popcnt,bmi"), gnu::flatten]] static BlockStats find(KeyLayout<std::uint32_t> const& layout,
                                                                            std::uint32_t const* keys, Block block,
                                                                            Runs runs) noexcept {
        BlockStats stats;
        stats.runs = find_starts(keys, block, runs);
        runs.count = stats.runs;
        number_runs(layout, keys, runs, stats);
        return stats;
    }
    static BlockStats find(KeyLayout<std::uint64_t> const& layout, std::uint64_t const* keys, Block const& block,
                           Runs runs) noexcept {
        return PlainKernels::find(layout, keys, block, runs);
    }
    [[gnu::target("avx2,popcnt,bmi"), gnu::flatten]] static void rank(Runs const& runs, RankedWord const* words) noexcept {
        rank_runs(runs, words);
    }
    template <Key K>
    static void fill(Runs const& runs, Block const& block, std::uint32_t* index) noexcept {
        if constexpr (sizeof(K) == 4) fill_by_changes(runs, block, index);
        else fill_runs(runs, block, index);
    }

private:
    typedef std::uint32_t Words __attribute__((vector_size(32)));
    typedef std::int32_t Ints __attribute__((vector_size(32)));
    typedef float Floats __attribute__((vector_size(32)));

    [[gnu::target("avx2,popcnt,bmi")]] static std::uint32_t find_starts(std::uint32_t const* keys, Block block,
                                                                        Runs runs) noexcept {
        std::uint32_t count = 0;
        runs.start[count++] = block.begin;
        std::uint32_t i = block.begin + 1;
        std::uint8_t* changes = runs.changes;
        for (; i + 8 <= block.end; i += 8) {
            Words a;
            Words b;
            Words places;
            std::memcpy(&a, keys + i, sizeof a);
            std::memcpy(&b, keys + i - 1, sizeof b);
            Floats const same = reinterpret_cast<Floats>(a == b);
            unsigned const changed = static_cast<unsigned>(__builtin_ia32_movmskps256(same)) ^ 0xFFU;
            *changes++ = static_cast<std::uint8_t>(changed);
            std::memcpy(&places, &set_bits_of[changed], sizeof places);
            places += i;
            std::memcpy(runs.start + count, &places, sizeof places);
            count += static_cast<std::uint32_t>(std::popcount(changed));
        }
        for (; i < block.end; ++i) {
            runs.start[count] = i;
            count += keys[i] != keys[i - 1] ? 1U : 0U;
        }
        runs.start[count] = block.end;
        return count;
    }

    /// Eight samples at a time take their runs' numbers by a permutation.
    [[gnu::target("avx2,popcnt,bmi")]] static void fill_by_changes(Runs runs, Block block, std::uint32_t* index) noexcept {
        std::size_t run = 0;
        index[block.begin] = runs.number[0];
        std::uint32_t i = block.begin + 1;
        std::uint8_t const* changes = runs.changes;
        for (; i + 8 <= block.end; i += 8) {
            unsigned const changed = *changes++;
            Ints numbers;
            Ints from;
            std::memcpy(&numbers, runs.number + run + (changed & 1U), sizeof numbers);
            std::memcpy(&from, &runs_of[changed >> 1U], sizeof from);
            Ints const to = reinterpret_cast<Ints>(__builtin_ia32_permvarsi256(numbers, from));
            std::memcpy(index + i, &to, sizeof to);
            run += static_cast<std::size_t>(std::popcount(changed));
        }
        for (; i < block.end; ++i) {
            run += runs.start[run + 1] == i ? 1U : 0U;
            index[i] = runs.number[run];
        }
    }
};
#endif

/// Calls `f` with the machine's kernels.
template <class F>
void with_kernels(F&& f) {
#if GNOMON_CLUSTER_AVX2
    if (has_avx2()) return f(Avx2Kernels{});
#endif
    f(PlainKernels{});
}

}  // namespace gnomon::cluster::detail
