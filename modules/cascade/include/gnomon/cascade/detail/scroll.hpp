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

    [[nodiscard]] Number value(T held) const noexcept {
        if constexpr (is_code)
            return gn_scrolled_code(formula::Int<float>(std::int32_t{held}), add, last, reversed).v;
        else
            return gn_scrolled(formula::Float<float>(held), add, last, reversed).v;
    }

    /// Counts one texel: 0 for one that was unwritten, 1 for one that was clamped.
    void count(T held, std::int32_t& unwritten, std::int32_t& clamped) const noexcept {
        auto const number = static_cast<Number>(held);
        bool const drawn = reversed ? number > Number{} : number < last;
        Number const sum = reversed ? number - add : number + add;
        bool const beyond = sum < Number{} || sum > last || sum == clear();
        unwritten += drawn ? 0 : 1;
        clamped += drawn && beyond ? 1 : 0;
    }

    /// Texels [x0, x1) of a row, from low to high or the other way; `from` may be `to`.
    ScrollStats shift(T const* from, T* to, std::int32_t x0, std::int32_t x1, bool upward) const noexcept {
        std::int32_t unwritten = 0;
        std::int32_t clamped = 0;
        auto const one = [&](std::int32_t x) {
            T const held = from[x + dx];
            count(held, unwritten, clamped);
            to[x] = static_cast<T>(value(held));
        };
        if (upward)
            for (std::int32_t x = x0; x < x1; ++x) one(x);
        else
            for (std::int32_t x = x1; x-- > x0;) one(x);
        return {x1 - x0 - unwritten - clamped, unwritten, 0, clamped};
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
