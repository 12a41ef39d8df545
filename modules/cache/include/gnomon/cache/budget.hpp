#pragma once
// Which maps are drawn in this frame: mandatory work, then requested, then idle, as far as the budget goes. What waits is
// reported, and how long.

#include <gnomon/core/contract.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>

namespace gnomon::cache {

enum class Priority : std::uint8_t {
    mandatory,  ///< A wrong picture otherwise: done whatever it costs.
    requested,  ///< Looked up in this frame; the last image will do for a while.
    idle,       ///< Might be looked up soon.
};

/// One map's work.
struct Work {
    std::uint32_t id = 0;      ///< The map's: decides between equals, so it has to stay the same from frame to frame.
    Priority priority = Priority::requested;
    std::uint64_t cost = 0;    ///< In whatever the budget counts: triangles, texels, microseconds.
    std::uint64_t waited = 0;  ///< Updates that it was put off already, such as `CachedMap::stale_updates()`.
};

inline constexpr std::uint64_t waits_forever = ~std::uint64_t{0};

struct BudgetConfig {
    std::uint64_t cost = 0;                      ///< Of one frame.
    std::uint64_t requested_wait = 30;           ///< Requested work that has waited so long becomes mandatory.
    std::uint64_t idle_wait = waits_forever;     ///< The same for idle work.
};

struct BudgetReport {
    std::size_t chosen = 0;          ///< These come first in the order.
    std::size_t postponed = 0;
    std::size_t promoted = 0;        ///< Chosen because they had waited long enough.
    std::uint64_t cost = 0;          ///< Of what was chosen. More than the budget only for mandatory and promoted work.
    std::uint64_t longest_wait = 0;  ///< Of what is postponed, this time included.

    friend constexpr bool operator==(BudgetReport const&, BudgetReport const&) noexcept = default;
};

namespace detail {

[[nodiscard]] constexpr bool is_promoted(Work const& w, BudgetConfig const& config) noexcept {
    switch (w.priority) {
        case Priority::mandatory: return false;
        case Priority::requested: return config.requested_wait != waits_forever && w.waited >= config.requested_wait;
        case Priority::idle: return config.idle_wait != waits_forever && w.waited >= config.idle_wait;
    }
    return false;
}

[[nodiscard]] constexpr std::uint64_t saturated_sum(std::uint64_t a, std::uint64_t b) noexcept {
    return a + b < a ? ~std::uint64_t{0} : a + b;
}

[[nodiscard]] constexpr bool is_due(Work const& w, BudgetConfig const& config) noexcept {
    return w.priority == Priority::mandatory || is_promoted(w, config);
}

inline constexpr std::uint32_t waits_bit = std::uint32_t{1} << 31;  ///< Of a place in the order, while it is made.

/// Places that wait come after those that do not; then by urgency.
struct Urgency {
    std::span<Work const> works;
    BudgetConfig const& config;

    [[nodiscard]] constexpr bool operator()(std::uint32_t a, std::uint32_t b) const noexcept {
        if (((a ^ b) & waits_bit) != 0) return a < b;
        Work const& x = works[a & ~waits_bit];
        Work const& y = works[b & ~waits_bit];
        if (is_due(x, config) != is_due(y, config)) return is_due(x, config);
        if (x.priority != y.priority) return x.priority < y.priority;
        if (x.waited != y.waited) return x.waited > y.waited;
        return x.id != y.id ? x.id < y.id : a < b;
    }
};

/// Does the work fit? Counts it.
[[nodiscard]] constexpr bool take(Work const& w, BudgetConfig const& config, BudgetReport& report) noexcept {
    std::uint64_t const sum = saturated_sum(report.cost, w.cost);
    if (!is_due(w, config) && sum > config.cost) {
        ++report.postponed;
        report.longest_wait = std::max(report.longest_wait, saturated_sum(w.waited, 1));
        return false;
    }
    ++report.chosen;
    report.promoted += is_promoted(w, config) ? 1U : 0U;
    report.cost = sum;
    return true;
}

}  // namespace detail

/// Writes the places in `works` to `order`: those to be done now, then those that wait.
///
/// Mandatory and promoted work is always done. The rest in order of priority, of time waited, longest first, and of id,
/// each that still fits; a large one that does not fit leaves room for smaller ones behind it, and is promoted in its time.
/// Nothing requested waits for more than `requested_wait` updates, if every update asks.
///
/// expects: as much room in `order` as there is work, less than 2^31. Any order of `works` gives the same, if ids differ.
/// returns: what was chosen and what waits.
/// cost:    O(n log n). Never allocates.
inline BudgetReport choose(std::span<Work const> works, BudgetConfig const& config,
                           std::span<std::uint32_t> order) noexcept {
    GNOMON_EXPECT(order.size() >= works.size() && works.size() < detail::waits_bit);
    auto const places = order.first(std::min(works.size(), order.size()));
    for (std::size_t i = 0; i < places.size(); ++i) places[i] = static_cast<std::uint32_t>(i);
    detail::Urgency const urgency{works, config};
    std::sort(places.begin(), places.end(), urgency);
    BudgetReport report;
    for (std::uint32_t& place : places)
        if (!detail::take(works[place], config, report)) place |= detail::waits_bit;
    std::sort(places.begin(), places.end(), urgency);
    for (std::uint32_t& place : places) place &= ~detail::waits_bit;
    return report;
}

/// Is it map `id`'s turn, if each is drawn every `interval` frames and they take turns?
[[nodiscard]] constexpr bool is_turn(std::uint32_t id, std::uint64_t frame, std::uint32_t interval) noexcept {
    return interval <= 1 || frame % interval == id % interval;
}

}  // namespace gnomon::cache
