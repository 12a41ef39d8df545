#pragma once
// Unique clusters by a bitmap over all keys there could be; see unique.hpp.

#include <gnomon/cluster/detail/unique_shared.hpp>
#include <gnomon/cluster/unique.hpp>

#include <algorithm>
#include <atomic>
#include <bit>

namespace gnomon::cluster {

namespace detail {

/// Sets a bit that other threads may be setting too; mostly it is set already.
///
/// returns: whether this was the first of the word
inline bool set_bit(std::uint64_t& word, std::uint64_t bit) noexcept {
    std::atomic_ref<std::uint64_t> const shared(word);
    return (shared.load(std::memory_order_relaxed) & bit) == 0 && shared.fetch_or(bit, std::memory_order_relaxed) == 0;
}

/// A flag for each key there could be, and one for each cache line of words, so that what is empty is not looked at.
class Bitmap {
public:
    static constexpr std::uint32_t group_words = 4;

    template <Key K>
    explicit Bitmap(UniqueWorkspace<K>& work) noexcept : words_(work.words.data()), occupied_(work.occupied) {}

    /// From any thread.
    void set(std::uint32_t number) const noexcept {
        std::uint32_t const word = number / 64;
        if (set_bit(words_[word].bits, 1ULL << number % 64)) set_bit(occupied_[word / group_words / 64], 1ULL << word / group_words % 64);
    }
    [[nodiscard]] RankedWord const* words() const noexcept { return words_; }

    /// Calls `visit(word, number of its first key)` for each word of every group that is not empty, in order.
    template <class F>
    void for_each_word(F&& visit) const {
        for (std::size_t o = 0; o < occupied_.size(); ++o)
            for (std::uint64_t left = occupied_[o]; left != 0; left &= left - 1) {
                std::size_t const group = 64 * o + static_cast<std::size_t>(std::countr_zero(left));
                for (std::size_t w = group_words * group; w < group_words * (group + 1); ++w) visit(words_[w], std::uint64_t{64} * w);
            }
    }
    void clear() const noexcept {
        for_each_word([](RankedWord& word, std::uint64_t) { word = {}; });
        std::fill(occupied_.begin(), occupied_.end(), 0);
    }

private:
    RankedWord* words_;
    std::span<std::uint64_t> occupied_;
};

}  // namespace detail

template <Key K, core::Executor E>
UniqueStats unique_by_bitmap(KeyLayout<K> const& layout, std::span<K const> keys, UniqueOut<K> const& out,
                             UniqueWorkspace<K>& work, E& executor) {
    GNOMON_EXPECT(fits_table(layout) && out.index.size() == keys.size() && keys.size() < no_cluster);
    constexpr std::uint64_t group_words = detail::Bitmap::group_words;
    std::uint64_t const groups = layout.domain() / (64 * group_words) + 1;
    detail::grow(work.words, static_cast<std::size_t>(group_words * groups));
    detail::grow(work.occupied, static_cast<std::size_t>(groups / 64 + 1));
    detail::Bitmap const bitmap(work);
    UniqueStats stats = detail::prepare_runs(layout, keys, work, executor, [&](std::size_t, detail::Runs const& runs) {
        for (std::size_t r = 0; r < runs.count; ++r)
            if (runs.number[r] != no_cluster) bitmap.set(runs.number[r]);
    });
    bitmap.for_each_word([&](detail::RankedWord& word, std::uint64_t first) {
        word.rank = stats.clusters;
        for (std::uint64_t left = word.bits; left != 0; left &= left - 1, ++stats.clusters)
            if (stats.clusters < out.keys.size())
                out.keys[stats.clusters] = layout.key(first + static_cast<std::uint64_t>(std::countr_zero(left)));
    });
    detail::link_samples(out.index, work, executor, [&](auto kernels, std::size_t, detail::Runs const& runs) {
        kernels.rank(runs, bitmap.words());
    });
    bitmap.clear();
    return stats;
}

}  // namespace gnomon::cluster
