#pragma once
// A stable radix sort by digits from the lowest up, in blocks that an executor runs in any order: the result is unique.

#include <gnomon/core/executor.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace gnomon::bvh::detail {

/// A 30-bit code and an id in one number, which sorts by both.
struct Key30 {
    static constexpr unsigned digit_bits = 10;
    static constexpr unsigned digits = 3;
    std::uint64_t bits;

    [[nodiscard]] static Key30 make(std::uint64_t code, std::uint32_t id) noexcept { return {code << 32U | id}; }
    [[nodiscard]] std::uint64_t code() const noexcept { return bits >> 32U; }
    [[nodiscard]] std::uint32_t id() const noexcept { return static_cast<std::uint32_t>(bits); }
};

/// A 63-bit code and an id.
struct Key63 {
    static constexpr unsigned digit_bits = 11;
    static constexpr unsigned digits = 6;
    std::uint64_t bits;
    std::uint32_t number;

    [[nodiscard]] static Key63 make(std::uint64_t code, std::uint32_t id) noexcept { return {code, id}; }
    [[nodiscard]] std::uint64_t code() const noexcept { return bits; }
    [[nodiscard]] std::uint32_t id() const noexcept { return number; }
};

/// How the items are split for threads: blocks of `size`, the last one shorter.
struct Blocks {
    std::size_t items = 0;
    std::size_t size = 1;
    std::size_t count = 0;

    /// At most 32 of at least 16,384 items: a block's histogram costs some thousand steps a digit.
    [[nodiscard]] static Blocks of(std::size_t items) noexcept {
        std::size_t const size = std::max<std::size_t>(16384, (items + 31) / 32);
        return {items, size, (items + size - 1) / size};
    }
    [[nodiscard]] std::size_t begin(std::size_t block) const noexcept { return block * size; }
    [[nodiscard]] std::size_t end(std::size_t block) const noexcept { return std::min(items, (block + 1) * size); }
};

/// Calls `f(block)` for every block.
template <class F>
void for_each_block(core::ExecutorRef executor, Blocks const& blocks, F const& f) {
    auto const run = [&f](std::size_t begin, std::size_t end) {
        for (std::size_t block = begin; block < end; ++block) f(block);
    };
    if (blocks.count <= 1) run(0, blocks.count);
    else executor.parallel_for(blocks.count, 1, run);
}

/// Turns the blocks' counts of a digit into where each block's first key of that digit goes.
inline void offsets_of_counts(std::uint32_t* counts, std::size_t blocks, std::size_t buckets) noexcept {
    std::uint32_t sum = 0;
    for (std::size_t digit = 0; digit < buckets; ++digit)
        for (std::size_t block = 0; block < blocks; ++block) {
            std::uint32_t& count = counts[block * buckets + digit];
            std::uint32_t const next = sum + count;
            count = sum;
            sum = next;
        }
}

/// Sorts by code; equal codes keep their order. `keys` and `spare` are as long; the result is in the one returned.
///
/// cost: two passes over the keys a digit, and 4 bytes times blocks times 2^digit_bits of `counts`.
template <class Key>
[[nodiscard]] Key* sort_keys(Key* keys, Key* spare, std::size_t n, std::vector<std::uint32_t>& counts,
                             core::ExecutorRef executor) {
    constexpr std::size_t buckets = std::size_t{1} << Key::digit_bits;
    Blocks const blocks = Blocks::of(n);
    counts.resize(std::max(counts.size(), blocks.count * buckets));
    for (unsigned digit = 0; digit < Key::digits; ++digit) {
        unsigned const shift = digit * Key::digit_bits;
        auto const digit_of = [shift](Key const& key) { return key.code() >> shift & (buckets - 1); };
        for_each_block(executor, blocks, [&](std::size_t block) {
            std::uint32_t* const count = counts.data() + block * buckets;
            std::fill(count, count + buckets, 0U);
            for (std::size_t i = blocks.begin(block); i < blocks.end(block); ++i) ++count[digit_of(keys[i])];
        });
        offsets_of_counts(counts.data(), blocks.count, buckets);
        for_each_block(executor, blocks, [&](std::size_t block) {
            std::uint32_t* const place = counts.data() + block * buckets;
            for (std::size_t i = blocks.begin(block); i < blocks.end(block); ++i) spare[place[digit_of(keys[i])]++] = keys[i];
        });
        std::swap(keys, spare);
    }
    return keys;
}

}  // namespace gnomon::bvh::detail
