#pragma once
// From items to sortable keys: which are usable, where their centres lie, which code each has.

#include <gnomon/bvh/detail/lanes_of.hpp>
#include <gnomon/bvh/detail/radix_sort.hpp>
#include <gnomon/bvh/formula/code.glsl>
#include <gnomon/bvh/items.hpp>
#include <gnomon/math/morton.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>

namespace gnomon::bvh::detail {

/// Of the usable items of a block: how many, and the bounds of their halved centres.
struct BlockSummary {
    std::uint32_t usable = 0;
    std::array<float, 3> lo{std::numeric_limits<float>::infinity(), std::numeric_limits<float>::infinity(),
                            std::numeric_limits<float>::infinity()};
    std::array<float, 3> hi{-std::numeric_limits<float>::infinity(), -std::numeric_limits<float>::infinity(),
                            -std::numeric_limits<float>::infinity()};

    void add(BlockSummary const& other) noexcept {
        usable += other.usable;
        for (std::size_t k = 0; k < 3; ++k) {
            lo[k] = std::min(lo[k], other.lo[k]);
            hi[k] = std::max(hi[k], other.hi[k]);
        }
    }
};

template <class Items>
using Arrays = std::array<float const*, Items::fields>;

template <class Items, class S>
struct Summing {
    formula::Float<S> lo[3], hi[3];
    std::uint32_t usable = 0;

    [[gnu::always_inline]] Summing() noexcept {
        for (std::size_t k = 0; k < 3; ++k) {
            lo[k] = formula::Float<S>(std::numeric_limits<float>::infinity());
            hi[k] = formula::Float<S>(-std::numeric_limits<float>::infinity());
        }
    }
    [[gnu::always_inline]] void add(ItemOf<S, Items::fields> const& item) noexcept {
        formula::Bool<S> const good = Items::template usable<S>(item);
        formula::Vec3<S> const c = Items::template half_center<S>(item);
        formula::Float<S> const at[3] = {c.x, c.y, c.z};
        for (std::size_t k = 0; k < 3; ++k) {
            lo[k] = gn_min(lo[k], gn_select(good, at[k], lo[k]));
            hi[k] = gn_max(hi[k], gn_select(good, at[k], hi[k]));
        }
        usable += static_cast<std::uint32_t>(__builtin_popcount(bits_of(good)));
    }
    [[gnu::always_inline]] void add_to(BlockSummary& sum) const noexcept {
        sum.usable += usable;
        for (std::size_t k = 0; k < 3; ++k) {
            float low[lane_count<S>];
            float high[lane_count<S>];
            store(low, lo[k]);
            store(high, hi[k]);
            for (std::size_t i = 0; i < lane_count<S>; ++i) {
                sum.lo[k] = std::min(sum.lo[k], low[i]);
                sum.hi[k] = std::max(sum.hi[k], high[i]);
            }
        }
    }
};

template <class Items, class S>
[[gnu::always_inline]] inline void summarize(Arrays<Items> const& arrays, std::size_t begin, std::size_t end,
                                             BlockSummary& sum) noexcept {
    constexpr std::size_t n = lane_count<S>;
    Summing<Items, S> lanes;
    std::size_t i = begin;
    for (; i + n <= end; i += n) lanes.add(load_item<S>(arrays, i));
    lanes.add_to(sum);
    Summing<Items, float> rest;
    for (; i < end; ++i) rest.add(load_item<float>(arrays, i));
    rest.add_to(sum);
}

/// The grid of codes over halved centres.
[[nodiscard]] inline formula::GnCodeGrid make_code_grid(BlockSummary const& sum, float cells) noexcept {
    formula::GnCodeGrid grid{};
    if (sum.usable == 0) return grid;
    grid.half_lo = math::vec3(sum.lo[0], sum.lo[1], sum.lo[2]);
    grid.last = cells - 1.0F;
    grid.scale = math::vec3(formula::gn_code_scale(sum.lo[0], sum.hi[0], cells), formula::gn_code_scale(sum.lo[1], sum.hi[1], cells),
                            formula::gn_code_scale(sum.lo[2], sum.hi[2], cells));
    return grid;
}

/// Codes of one item or of a group: 30 bits in lanes, 63 bits from cells in lanes.
template <class Items, class S, class Key>
[[gnu::always_inline]] inline void codes_of(formula::GnCodeGrid const& grid, ItemOf<S, Items::fields> const& item,
                                            std::uint64_t* codes) noexcept {
    formula::Vec3<S> const c = Items::template half_center<S>(item);
    std::uint32_t cell[3][lane_count<S>];
    auto const put = [](std::uint32_t* to, formula::Uint<S> const& x) {
        if constexpr (lane_count<S> == 1) *to = x.v;
        else x.v.store(to);
    };
    if constexpr (Key::digits == Key30::digits) {
        put(cell[0], gn_code_30(grid, c));
        for (std::size_t i = 0; i < lane_count<S>; ++i) codes[i] = cell[0][i];
    } else {
        put(cell[0], gn_code_cell(c.x, grid.half_lo.x, grid.scale.x, grid.last));
        put(cell[1], gn_code_cell(c.y, grid.half_lo.y, grid.scale.y, grid.last));
        put(cell[2], gn_code_cell(c.z, grid.half_lo.z, grid.scale.z, grid.last));
        for (std::size_t i = 0; i < lane_count<S>; ++i) codes[i] = math::morton_63(cell[0][i], cell[1][i], cell[2][i]);
    }
}

/// Where a block's keys and copies of items go.
template <class Key>
struct KeyOutput {
    Key* keys;       ///< The block's first.
    float* records;  ///< The item's numbers side by side, at its id: one cache line to fetch later instead of several.
};

template <std::size_t fields>
inline constexpr std::size_t record_size = fields == 4 ? 4 : 8;

template <class Items, class Key, class S>
[[gnu::always_inline]] inline Key* put_keys(Arrays<Items> const& arrays, formula::GnCodeGrid const& grid, std::size_t at,
                                            KeyOutput<Key> const& out, Key* next) noexcept {
    constexpr std::size_t n = lane_count<S>;
    ItemOf<S, Items::fields> const item = load_item<S>(arrays, at);
    std::uint64_t codes[n];
    codes_of<Items, S, Key>(grid, item, codes);
    std::uint32_t const good = bits_of(Items::template usable<S>(item));
    for (std::size_t i = 0; i < n; ++i)
        if ((good >> i & 1U) != 0) *next++ = Key::make(codes[i], static_cast<std::uint32_t>(at + i));
    float* const record = out.records + at * record_size<Items::fields>;
    for (std::size_t i = 0; i < n; ++i)
        for (std::size_t k = 0; k < Items::fields; ++k) record[i * record_size<Items::fields> + k] = arrays[k][at + i];
    return next;
}

/// Writes the keys of the usable items of [begin, end), and copies of all.
template <class Items, class Key, class S>
[[gnu::always_inline]] inline void make_keys(Arrays<Items> const& arrays, formula::GnCodeGrid const& grid,
                                             std::size_t begin, std::size_t end, KeyOutput<Key> const& out) noexcept {
    constexpr std::size_t n = lane_count<S>;
    Key* next = out.keys;
    std::size_t i = begin;
    for (; i + n <= end; i += n) next = put_keys<Items, Key, S>(arrays, grid, i, out, next);
    for (; i < end; ++i) next = put_keys<Items, Key, float>(arrays, grid, i, out, next);
}

#if GNOMON_BVH_AVX2
template <class Items>
[[gnu::target("avx2"), gnu::flatten]] void summarize_avx2(Arrays<Items> const& arrays, std::size_t begin,
                                                          std::size_t end, BlockSummary& sum) noexcept {
    summarize<Items, math::Lanes<float, 8>>(arrays, begin, end, sum);
}
template <class Items, class Key>
[[gnu::target("avx2"), gnu::flatten]] void make_keys_avx2(Arrays<Items> const& arrays, formula::GnCodeGrid const& grid,
                                                          std::size_t begin, std::size_t end,
                                                          KeyOutput<Key> const& out) noexcept {
    make_keys<Items, Key, math::Lanes<float, 8>>(arrays, grid, begin, end, out);
}
#endif

}  // namespace gnomon::bvh::detail
