#pragma once
// The rows of a scroll; see scroll.hpp.

#include <gnomon/cascade/scroll.hpp>

#include <atomic>
#include <type_traits>

namespace gnomon::cascade {

namespace detail {

/// A scroll whose shifts are cut to the map and its codes.
template <DepthTexel T>
struct ScrollKernel {
    static constexpr bool is_code = std::is_integral_v<T>;
    using Number = std::conditional_t<is_code, std::int32_t, float>;

    std::int32_t dx, dy, size_px;
    Number add, last;
    bool reversed;

    [[nodiscard]] Number clear() const noexcept { return reversed ? Number{} : last; }

    /// [begin, end) of the texels of a row or column that have a source within the map.
    [[nodiscard]] std::int32_t begin(std::int32_t shift) const noexcept {
        return std::min(std::max(-shift, 0), size_px);
    }
    [[nodiscard]] std::int32_t end(std::int32_t shift) const noexcept {
        return std::max(std::min(size_px - shift, size_px), 0);
    }

    /// Texels [0, n) from one place to another that shares none with it: what `gn_scrolled` and
    /// `gn_scrolled_code` say of each, and what became of it.
    ///
    /// Without a branch, and with all that does not change in a local, as compilers need it to vectorize.
    template <bool Reversed>
    [[gnu::noinline]] void float_block(T const* __restrict from, T* __restrict to, std::int32_t n,
                                       ScrollStats& stats) const noexcept {
        Number const by = Reversed ? -add : add;
        Number const most = last;
        Number const least{};
        // What may be raised by `by` and not pass `most`; sums beyond 1 would be rounded.
        Number const highest = by > least ? most - by : most;
        Number const unwritten = Reversed ? least : most;
        std::int32_t unwritten_count = 0;
        std::int32_t inside_count = 0;
        for (std::int32_t i = 0; i < n; ++i) {
            auto const number = static_cast<Number>(from[i]);
            Number const sum = number + by;
            bool const drawn = Reversed ? number > least : number < most;  // false for a NaN
            Number const raised = sum < least ? least : sum;
            Number const moved = raised > most ? most : raised;
            bool const inside =
                drawn & (Reversed ? sum > least : sum >= least) & (Reversed ? number <= highest : sum < most);
            to[i] = static_cast<T>(drawn ? moved : unwritten);
            unwritten_count += drawn ? 0 : 1;
            inside_count += inside ? 1 : 0;
        }
        stats.moved += inside_count;
        stats.unwritten += unwritten_count;
        stats.clamped += n - unwritten_count - inside_count;
    }

    /// The same of codes, in 16-bit numbers: `least` and `most` are the first and last ones that stay exact.
    ///
    ///     max(held, lower) - lower  or  min(held, last - raise) + raise,  one of lower and raise being 0
    [[gnu::noinline]] void code_block(T const* __restrict from, T* __restrict to, std::int32_t n,
                                      ScrollStats& stats) const noexcept {
        std::int32_t const by = reversed ? -add : add;
        auto const raise = static_cast<T>(by > 0 ? by : 0);
        auto const lower = static_cast<T>(by < 0 ? -by : 0);
        auto const highest = static_cast<T>(last - raise);
        auto const unwritten = static_cast<T>(clear());
        auto const least = static_cast<T>(reversed ? lower + 1 : lower);
        auto const most = static_cast<T>(reversed ? highest : highest - 1);
        bool const any_inside = reversed ? lower < last : highest > 0;
        T unwritten_count = 0;  // a block has few texels
        T inside_count = 0;
        for (std::int32_t i = 0; i < n; ++i) {
            T const held = from[i];
            T const at_least = held > lower ? held : lower;
            auto const lowered = static_cast<T>(at_least - lower);
            T const at_most = lowered < highest ? lowered : highest;
            auto const moved = static_cast<T>(at_most + raise);
            to[i] = held == unwritten ? unwritten : moved;
            unwritten_count = static_cast<T>(unwritten_count + (held == unwritten ? 1 : 0));
            inside_count = static_cast<T>(inside_count + (((held >= least) & (held <= most)) ? 1 : 0));
        }
        std::int32_t const inside = any_inside ? inside_count : 0;
        stats.moved += inside;
        stats.unwritten += unwritten_count;
        stats.clamped += n - unwritten_count - inside;
    }

    /// Texels [x0, x1) of a row, in blocks from left to right or the other way, each read whole before it is written:
    /// `from` may be `to`.
    ScrollStats shift(T const* from, T* to, std::int32_t x0, std::int32_t x1, bool upward) const noexcept {
        constexpr std::int32_t size = 256;
        T held[size];
        T moved[size];
        ScrollStats stats;
        for (std::int32_t done = 0; done < x1 - x0; done += size) {
            std::int32_t const n = std::min(size, x1 - x0 - done);
            std::int32_t const x = upward ? x0 + done : x1 - done - n;
            std::copy_n(from + x + dx, n, held);
            if constexpr (is_code)
                code_block(held, moved, n, stats);
            else
                reversed ? float_block<true>(held, moved, n, stats) : float_block<false>(held, moved, n, stats);
            std::copy_n(moved, n, to + x);
        }
        return stats;
    }

    /// All of row `y` of the new map.
    ScrollStats row(MapTexels<T const> from, MapTexels<T> to, std::int32_t y, bool upward) const noexcept {
        T* const out = to.row(y);
        std::int32_t const x0 = begin(dx);
        std::int32_t const x1 = std::max(end(dx), x0);
        bool const inside = y >= begin(dy) && y < end(dy);
        ScrollStats stats;
        if (inside) stats = shift(from.row(y + dy), out, x0, x1, upward);
        auto const cleared = static_cast<T>(clear());
        std::fill(out, out + (inside ? x0 : size_px), cleared);
        if (inside) std::fill(out + x1, out + size_px, cleared);
        stats.exposed = inside ? size_px - (x1 - x0) : size_px;
        return stats;
    }
};

template <DepthTexel T>
[[nodiscard]] ScrollKernel<T> make_kernel(MapScroll const& by, std::int32_t size_px) noexcept {
    auto const within = [](std::int64_t x, std::int64_t most) {
        return static_cast<std::int32_t>(x < -most ? -most : x > most ? most : x);
    };
    ScrollKernel<T> kernel{within(by.shift.x, size_px),      within(by.shift.y, size_px), size_px, {}, {},
                           by.depth == math::Depth::reversed};
    std::int32_t const add = -within(by.shift.z, by.codes);
    if constexpr (std::is_integral_v<T>) {
        GNOMON_EXPECT(by.codes > 0 && by.codes <= unorm16_codes);
        kernel.add = add;
        kernel.last = by.codes;
    } else {
        GNOMON_EXPECT(by.codes == float_codes);
        kernel.add = static_cast<float>(add) * 0x1p-24F;
        kernel.last = 1.0F;
    }
    return kernel;
}

inline void add_to(ScrollStats& sum, ScrollStats const& part) noexcept {
    sum.moved += part.moved;
    sum.unwritten += part.unwritten;
    sum.exposed += part.exposed;
    sum.clamped += part.clamped;
}

}  // namespace detail

template <DepthTexel T, core::Executor E>
ScrollStats scroll(MapTexels<T const> from, MapTexels<T> to, MapScroll const& by, E& executor) {
    GNOMON_EXPECT(from.size_px == to.size_px);
    auto const kernel = detail::make_kernel<T>(by, to.size_px);
    std::atomic<std::int64_t> moved{0};
    std::atomic<std::int64_t> unwritten{0};
    std::atomic<std::int64_t> exposed{0};
    std::atomic<std::int64_t> clamped{0};
    executor.parallel_for(static_cast<std::size_t>(to.size_px), std::size_t{64},
                          [&](std::size_t begin, std::size_t end) {
                              ScrollStats part;
                              for (std::size_t y = begin; y < end; ++y)
                                  detail::add_to(part, kernel.row(from, to, static_cast<std::int32_t>(y), true));
                              moved += part.moved;
                              unwritten += part.unwritten;
                              exposed += part.exposed;
                              clamped += part.clamped;
                          });
    return {moved, unwritten, exposed, clamped};
}

template <DepthTexel T>
ScrollStats scroll_in_place(MapTexels<T> map, MapScroll const& by) {
    auto const kernel = detail::make_kernel<T>(by, map.size_px);
    MapTexels<T const> const from{map.first, map.size_px, map.pitch};
    ScrollStats stats;
    // A row is read by the row `dy` before it: upward where the source lies below, downward where it lies above.
    if (kernel.dy >= 0)
        for (std::int32_t y = 0; y < map.size_px; ++y) detail::add_to(stats, kernel.row(from, map, y, kernel.dx >= 0));
    else
        for (std::int32_t y = map.size_px; y-- > 0;) detail::add_to(stats, kernel.row(from, map, y, kernel.dx >= 0));
    return stats;
}

}  // namespace gnomon::cascade
