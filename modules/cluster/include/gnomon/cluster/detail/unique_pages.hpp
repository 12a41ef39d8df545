#pragma once
// Unique clusters by a page table over all keys there could be; see unique.hpp.

#include <gnomon/cluster/detail/unique_shared.hpp>
#include <gnomon/cluster/unique.hpp>

#include <algorithm>
#include <atomic>

namespace gnomon::cluster {

namespace detail {

inline constexpr std::uint32_t page_bits = 6;
inline constexpr std::uint32_t page_slots = 1U << page_bits;

/// Sets a flag, as other threads may be doing.
inline void set_flag(std::uint32_t& flag) noexcept {
    std::atomic_ref<std::uint32_t> const shared(flag);
    if (shared.load(std::memory_order_relaxed) == 0) shared.store(1, std::memory_order_relaxed);
}

/// Numbers the flagged pages in their order; the others get none.
///
/// returns: how many
[[nodiscard]] inline std::uint32_t allocate_pages(std::span<std::uint32_t> pages) noexcept {
    std::uint32_t next = 0;
    for (std::uint32_t& page : pages) {
        std::uint32_t const flagged = page;
        page = next;
        next += flagged;
    }
    return next;
}

}  // namespace detail

template <Key K, core::Executor E>
UniqueStats unique_by_page_table(KeyLayout<K> const& layout, std::span<K const> keys, UniqueOut<K> const& out,
                                 UniqueWorkspace<K>& work, E& executor) {
    GNOMON_EXPECT(fits_table(layout) && out.index.size() == keys.size() && keys.size() < no_cluster);
    auto const pages = static_cast<std::size_t>(layout.domain() / detail::page_slots + 1);
    detail::grow(work.pages, pages);
    std::fill_n(work.pages.begin(), pages, 0U);
    UniqueStats stats = detail::prepare_runs(layout, keys, work, executor, [&](std::size_t, detail::Runs const& runs) {
        for (std::size_t r = 0; r < runs.count; ++r)
            if (runs.number[r] != no_cluster) detail::set_flag(work.pages[runs.number[r] >> detail::page_bits]);
    });
    auto const slot_of = [&](std::uint32_t number) {
        return std::size_t{work.pages[number >> detail::page_bits]} * detail::page_slots + number % detail::page_slots;
    };
    // The table then goes from virtual to physical pages; a key's own number stands in its slot, plus 1.
    std::size_t const slots = std::size_t{detail::allocate_pages({work.pages.data(), pages})} * detail::page_slots;
    detail::grow(work.slots, slots);
    std::fill_n(work.slots.begin(), slots, 0U);
    executor.parallel_for(detail::block_count(keys.size()), 1, [&](std::size_t begin, std::size_t end) {
        for (std::size_t b = begin; b < end; ++b) {
            detail::Runs const runs = work.runs(b);
            for (std::size_t r = 0; r < runs.count; ++r) {
                std::uint32_t const number = runs.number[r];
                if (number == no_cluster) continue;
                std::atomic_ref<std::uint32_t>(work.slots[slot_of(number)]).store(number + 1, std::memory_order_relaxed);
            }
        }
    });
    for (std::size_t s = 0; s < slots; ++s) {
        if (work.slots[s] == 0) continue;
        if (stats.clusters < out.keys.size()) out.keys[stats.clusters] = layout.key(work.slots[s] - 1);
        work.slots[s] = static_cast<std::uint32_t>(stats.clusters++);
    }
    detail::link_samples(out.index, work, executor, [&](auto, std::size_t, detail::Runs const& runs) {
        for (std::size_t r = 0; r < runs.count; ++r)
            if (runs.number[r] != no_cluster) runs.number[r] = work.slots[slot_of(runs.number[r])];
    });
    return stats;
}

}  // namespace gnomon::cluster
