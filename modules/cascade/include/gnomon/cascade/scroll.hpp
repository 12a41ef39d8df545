#pragma once
// Scrolling a depth map: shifted by whole texels, moved by whole depth codes, the rest cleared. Into another map, or in
// place.
//
// source: [CSM Scrolling, 4.1 to 4.3]

#include <gnomon/cascade/formula/scroll.glsl>
#include <gnomon/cascade/step.hpp>
#include <gnomon/core/contract.hpp>
#include <gnomon/core/executor.hpp>

#include <algorithm>
#include <concepts>
#include <cstddef>

namespace gnomon::cascade {

/// What a map stores: 16-bit codes, or floats of code * 2^-24.
template <class T>
concept DepthTexel = std::same_as<std::remove_const_t<T>, std::uint16_t> || std::same_as < std::remove_const_t<T>,
float > ;

/// A square map in memory, its top row first. Owns nothing.
template <DepthTexel T>
struct MapTexels {
    T* first = nullptr;
    std::int32_t size_px = 0;
    std::ptrdiff_t pitch = 0;  ///< Texels from row to row.

    [[nodiscard]] T* row(std::int32_t y) const noexcept { return first + y * pitch; }
};

/// How a map moves: `Update::shift`, in the units of a `Volume`.
struct MapScroll {
    Place shift;  ///< Any: beyond the map's width nothing is left.
    std::int32_t codes = unorm16_codes;
    math::Depth depth = math::Depth::forward;
};

/// What scrolling did; the four add up to the texels of the map.
struct ScrollStats {
    std::int64_t moved = 0;      ///< Drawn, and exactly where a new drawing would put them.
    std::int64_t unwritten = 0;  ///< Within the old map, and nothing was drawn there.
    std::int64_t exposed = 0;    ///< Beyond the old map: cleared.
    std::int64_t clamped = 0;    ///< Drawn, and now in front of code 0 (held at it) or behind the last (cleared).

    friend bool operator==(ScrollStats const&, ScrollStats const&) noexcept = default;
};

/// The shader's words for the same scroll.
[[nodiscard]] constexpr formula::GnScroll shader_scroll(MapScroll const& scroll, std::int32_t size_px,
                                                        bool unorm16) noexcept {
    auto const within = [](std::int64_t x, std::int64_t most) { return x < -most ? -most : x > most ? most : x; };
    auto const add = static_cast<float>(-within(scroll.shift.z, scroll.codes));
    return {static_cast<int>(within(scroll.shift.x, size_px)),
            static_cast<int>(within(scroll.shift.y, size_px)),
            unorm16 ? add : add * 0x1p-24F,
            unorm16 ? static_cast<float>(scroll.codes) : 1.0F,
            size_px,
            scroll.depth == math::Depth::reversed ? 1U : 0U,
            unorm16 ? 1U : 0U,
            0U};
}

/// Writes to `to` what `from` holds, scrolled.
///
/// expects: equal sizes, no texel in both; `codes` of at most 65535 with 16 bits and of 2^24 with floats.
/// returns: what became of the texels; the same for any executor.
/// cost:    O(texels), rows in parallel
template <DepthTexel T, core::Executor E = core::SerialExecutor const>
ScrollStats scroll(MapTexels<T const> from, MapTexels<T> to, MapScroll const& by, E& executor);
template <DepthTexel T>
ScrollStats scroll(MapTexels<T const> from, MapTexels<T> to, MapScroll const& by) {
    core::SerialExecutor const serial;
    return scroll(from, to, by, serial);
}

/// The same within one map: rows, and texels of a row, in the order in which nothing is read after it was overwritten.
template <DepthTexel T>
ScrollStats scroll_in_place(MapTexels<T> map, MapScroll const& by);

}  // namespace gnomon::cascade

#include <gnomon/cascade/detail/scroll.hpp>
