#pragma once
// Unique clusters by sorting blocks and merging their lists; see unique.hpp.

#include <gnomon/cluster/detail/unique_shared.hpp>
#include <gnomon/cluster/unique.hpp>

#include <algorithm>
#include <bit>

namespace gnomon::cluster {

namespace detail {

[[nodiscard]] inline std::uint32_t hash_of(std::uint32_t key) noexcept { return key * 0x9E3779B1U >> 16U; }
[[nodiscard]] inline std::uint32_t hash_of(std::uint64_t key) noexcept {
    return static_cast<std::uint32_t>(key * 0x9E3779B97F4A7C15ULL >> 48U);
}

/// Gives each of a block's runs the place of its key in `found`, which has the keys in the order they first come.
///
/// expects: a table of 2^n places, twice as many as there are runs, or more; room for a key a run
/// returns: how many keys
template <Key K>
[[nodiscard]] std::uint32_t collect_keys(std::span<K const> keys, Runs const& runs, std::span<std::uint32_t> table, K* found) {
    std::fill(table.begin(), table.end(), no_cluster);
    std::uint32_t count = 0;
    for (std::size_t r = 0; r < runs.count; ++r) {
        if (runs.number[r] == no_cluster) continue;
        K const key = keys[runs.start[r]];
        std::size_t at = hash_of(key) & (table.size() - 1);
        while (table[at] != no_cluster && found[table[at]] != key) at = (at + 1) & (table.size() - 1);
        if (table[at] == no_cluster) {
            found[count] = key;
            table[at] = count++;
        }
        runs.number[r] = table[at];
    }
    return count;
}

/// Sorts the keys of a block's runs to `sorted`, and gives each run its key's place there. Runs are compacted before
/// their keys are sorted: the same tile comes again in each row of pixels.
///
/// expects: memory of 2 block_samples words, and of a key a run
/// returns: how many keys
template <Key K>
[[nodiscard]] std::uint32_t sort_block(std::span<K const> keys, Runs const& runs, std::uint32_t* memory, K* found, K* sorted) {
    std::size_t const places = std::bit_ceil(2 * std::max(runs.count, std::size_t{1}));
    std::uint32_t const count = collect_keys(keys, runs, {memory, places}, found);
    std::uint32_t* const order = memory;  // the table is no longer needed
    std::uint32_t* const place = memory + count;
    for (std::uint32_t i = 0; i < count; ++i) order[i] = i;
    std::sort(order, order + count, [&](std::uint32_t a, std::uint32_t b) { return found[a] < found[b]; });
    for (std::uint32_t i = 0; i < count; ++i) {
        place[order[i]] = i;
        sorted[i] = found[order[i]];
    }
    for (std::size_t r = 0; r < runs.count; ++r)
        if (runs.number[r] != no_cluster) runs.number[r] = place[runs.number[r]];
    return count;
}

/// Merges each two neighbouring lists to where the first one stands, and drops what both have. What is dropped leaves
/// gaps, so that pairs go to threads.
template <Key K, core::Executor E>
void merge_pairs(std::vector<K> const& from, std::vector<K>& to, std::vector<List>& lists, E& executor) {
    std::size_t const count = lists.size();
    executor.parallel_for((count + 1) / 2, 1, [&](std::size_t begin, std::size_t end) {
        for (std::size_t p = begin; p < end; ++p) {
            List& a = lists[2 * p];
            List const b = 2 * p + 1 < count ? lists[2 * p + 1] : List{};
            K* const target = to.data() + a.begin;
            K* const last = std::set_union(from.data() + a.begin, from.data() + a.end, from.data() + b.begin,
                                           from.data() + b.end, target);
            a.end = a.begin + static_cast<std::size_t>(last - target);
        }
    });
    for (std::size_t p = 0; 2 * p < count; ++p) lists[p] = lists[2 * p];
    lists.resize((count + 1) / 2);
}

/// Merges the blocks' lists in `work.sorted` into one.
///
/// returns: it, in one of `work.merged`
template <Key K, core::Executor E>
[[nodiscard]] std::span<K const> merge_blocks(std::size_t blocks, UniqueWorkspace<K>& work, E& executor) {
    work.lists.resize(blocks);
    for (std::size_t b = 0; b < blocks; ++b) work.lists[b] = {b * block_samples, b * block_samples + work.blocks[b].keys};
    std::vector<K> const* from = &work.sorted;
    std::size_t next = 0;
    while (work.lists.size() > 1) {
        merge_pairs(*from, work.merged[next], work.lists, executor);
        from = &work.merged[next];
        next = 1 - next;
    }
    return blocks == 0 ? std::span<K const>{} : std::span<K const>(from->data(), work.lists[0].end);
}

/// The place of `key` in `all`, at or after `from`: steps that double, then bisection between the last two.
///
/// expects: it is there
template <Key K>
[[nodiscard]] std::size_t place_after(std::span<K const> all, std::size_t from, K key) noexcept {
    std::size_t step = 1;
    while (from + step < all.size() && all[from + step] <= key) {
        from += step;
        step *= 2;
    }
    auto const begin = all.begin() + static_cast<std::ptrdiff_t>(from);
    auto const end = all.begin() + static_cast<std::ptrdiff_t>(std::min(all.size(), from + step));
    return static_cast<std::size_t>(std::lower_bound(begin, end, key) - all.begin());
}

}  // namespace detail

template <Key K, core::Executor E>
UniqueStats unique_by_local_sort(KeyLayout<K> const& layout, std::span<K const> keys, UniqueOut<K> const& out,
                                 UniqueWorkspace<K>& work, E& executor) {
    GNOMON_EXPECT(out.index.size() == keys.size() && keys.size() < no_cluster);
    detail::grow(work.memory, 2 * detail::block_samples * detail::block_count(keys.size()));
    for (std::vector<K>* const buffer : {&work.sorted, &work.merged[0], &work.merged[1]}) detail::grow(*buffer, keys.size());
    UniqueStats stats = detail::prepare_runs(layout, keys, work, executor, [&](std::size_t b, detail::Runs const& runs) {
        std::size_t const begin = b * detail::block_samples;
        work.blocks[b].keys = detail::sort_block(keys, runs, work.memory.data() + 2 * begin, work.merged[0].data() + begin,
                                                 work.sorted.data() + begin);
    });
    std::span<K const> const all = detail::merge_blocks(detail::block_count(keys.size()), work, executor);
    stats.clusters = all.size();
    std::copy_n(all.begin(), std::min(all.size(), out.keys.size()), out.keys.begin());
    detail::link_samples(out.index, work, executor, [&](auto, std::size_t b, detail::Runs const& runs) {
        // The block's memory is free again: it now takes the place of each of the block's keys among all.
        std::uint32_t* const places = work.memory.data() + 2 * b * detail::block_samples;
        std::size_t place = 0;
        for (std::uint32_t i = 0; i < work.blocks[b].keys; ++i) {
            place = detail::place_after(all, place, work.sorted[b * detail::block_samples + i]);
            places[i] = static_cast<std::uint32_t>(place);
        }
        for (std::size_t r = 0; r < runs.count; ++r)
            if (runs.number[r] != no_cluster) runs.number[r] = places[runs.number[r]];
    });
    return stats;
}

}  // namespace gnomon::cluster
