#pragma once
// What the methods of unique.hpp share: their result, and memory that callers keep from frame to frame.

#include <gnomon/cluster/detail/runs.hpp>
#include <gnomon/cluster/key.hpp>

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace gnomon::cluster {

namespace detail {

/// A sorted list's place in a buffer of many.
struct List {
    std::size_t begin = 0;
    std::size_t end = 0;
};

/// Makes a vector at least so large.
template <class T>
void grow(std::vector<T>& v, std::size_t size) {
    if (v.size() < size) v.resize(size);
}

}  // namespace detail

/// What the samples held; the same for every method, executor and capacity.
struct UniqueStats {
    std::size_t clusters = 0;    ///< The keys needed: more than given room means that only the first were written.
    std::size_t background = 0;  ///< Samples with `no_key`: no geometry, in no cluster.
    std::size_t invalid = 0;     ///< Samples whose key is none of the layout: in no cluster.

    friend bool operator==(UniqueStats const&, UniqueStats const&) noexcept = default;
};

/// Where the result goes.
template <Key K>
struct UniqueOut {
    std::span<K> keys;               ///< Ascending; as many as there is room for.
    std::span<std::uint32_t> index;  ///< Per sample its key's place among all of them, or `no_cluster`.
};

/// Memory of the methods: grows to the samples and the layout's domain, then nothing is allocated.
template <Key K>
struct UniqueWorkspace {
    std::vector<std::uint32_t> starts;       ///< Of runs: 4 bytes a sample, as many used as there are runs.
    std::vector<std::uint32_t> numbers;      ///< Of runs: their keys', then their clusters'.
    std::vector<std::uint8_t> changes;       ///< A bit a sample: where runs begin.
    std::vector<detail::BlockStats> blocks;
    std::vector<detail::RankedWord> words;   ///< Bitmap: 2 bits for each key there could be. All 0 between calls.
    std::vector<std::uint64_t> occupied;     ///< Bitmap: a bit for four words; set if one of them is not 0.
    std::vector<std::uint32_t> pages;        ///< Page table: 4 bytes for 64 keys there could be.
    std::vector<std::uint32_t> slots;        ///< Page table: 256 bytes for each page that holds a key.
    std::vector<std::uint32_t> memory;       ///< Local sort: of blocks, 8 bytes a sample, then their keys' places.
    std::vector<K> sorted;                   ///< Local sort: each block's keys.
    std::vector<K> merged[2];                ///< Local sort: the blocks' lists merged, from one to the other.
    std::vector<detail::List> lists;

    /// Room for the runs of `blocks` blocks.
    void grow(std::size_t block_count) {
        detail::grow(starts, block_count * detail::block_room);
        detail::grow(numbers, block_count * detail::block_room);
        detail::grow(changes, block_count * detail::block_samples / 8);
        detail::grow(blocks, block_count);
    }
    /// The runs of block `b`.
    [[nodiscard]] detail::Runs runs(std::size_t b) noexcept {
        return {starts.data() + b * detail::block_room, numbers.data() + b * detail::block_room,
                changes.data() + b * detail::block_samples / 8, blocks[b].runs};
    }
};

}  // namespace gnomon::cluster
