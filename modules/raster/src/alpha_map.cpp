#include <gnomon/raster/alpha_map.hpp>

#include <cstddef>

namespace gnomon::raster {

namespace {

constexpr auto clear_bit = static_cast<std::uint8_t>(AlphaMap::Cell::clear);
constexpr auto solid_bit = static_cast<std::uint8_t>(AlphaMap::Cell::solid);
constexpr double slack = 0x1p-40;

/// Texels from `solid_from` on are solid, texels below `clear_below` clear, with the slack; the test is monotone.
struct Thresholds {
    int clear_below = 0;
    int solid_from = 256;
};

Thresholds make_thresholds(AlphaTest const& test) {
    Thresholds t;
    if (!(test.factor >= 0x1p-100 && test.factor <= 0x1p100)) return t;
    auto const value = [&](int alpha) { return alpha / 255.0 * test.factor; };
    while (t.clear_below < 256 && value(t.clear_below) * (1.0 + slack) < test.cutoff) ++t.clear_below;
    while (t.solid_from > 0 && value(t.solid_from - 1) * (1.0 - slack) >= test.cutoff) --t.solid_from;
    return t;
}

/// The texels on both sides of cell k of an axis.
struct Sides {
    std::int32_t first, second;
};
Sides sides_of(std::int32_t k, std::int32_t size, math::Wrap wrap) {
    return {math::detail::wrapped(k - 1, size, wrap), math::detail::wrapped(k, size, wrap)};
}

/// What each texel of a row could be alone, and its cells with the next column's: cell k at `out[k]`.
void classify_row(AlphaTest const& test, Thresholds const& t, std::int32_t row, std::vector<std::uint8_t>& out) {
    math::AlphaTexture const& texture = test.texture;
    std::int32_t const width = texture.size_px.x;
    std::ptrdiff_t const first = std::ptrdiff_t{row} * width;
    std::uint8_t const* const alpha = texture.texels.data() + (first + 1) * texture.channels - 1;
    auto const at = [&](std::int32_t x) {
        int const a = alpha[std::ptrdiff_t{x} * texture.channels];
        return static_cast<std::uint8_t>((a >= t.solid_from ? solid_bit : 0) | (a < t.clear_below ? clear_bit : 0));
    };
    std::uint8_t before = at(0);
    for (std::int32_t k = 1; k < width; ++k) {
        std::uint8_t const here = at(k);
        out[static_cast<std::size_t>(k)] = before & here;
        before = here;
    }
    for (std::int32_t const k : {0, width}) {
        Sides const s = sides_of(k, width, texture.wrap_u);
        out[static_cast<std::size_t>(k)] = at(s.first) & at(s.second);
    }
}

}  // namespace

AlphaMap::Cell AlphaMap::cell(std::int32_t column, std::int32_t row) const noexcept {
    GNOMON_EXPECT(column >= 0 && row >= 0 && column <= size_px_.x && row <= size_px_.y);
    std::size_t const word = static_cast<std::size_t>(row / 4) * static_cast<std::size_t>(words_across()) +
                             static_cast<std::size_t>(column / 4);
    return static_cast<Cell>((words_[word] >> (2 * (row % 4 * 4 + column % 4))) & 3U);
}

bool AlphaMap::is_of(AlphaTest const& test) const noexcept {
    math::AlphaTexture const& t = test.texture;
    return !words_.empty() && texels_ == t.texels.data() && size_px_ == t.size_px && wrap_u_ == t.wrap_u &&
           wrap_v_ == t.wrap_v && factor_ == test.factor && cutoff_ == test.cutoff;
}

AlphaMap make_alpha_map(AlphaTest const& test) {
    AlphaMap map;
    math::AlphaTexture const& texture = test.texture;
    if (!math::is_complete(texture)) return map;
    map.texels_ = texture.texels.data();
    map.size_px_ = texture.size_px;
    map.wrap_u_ = texture.wrap_u;
    map.wrap_v_ = texture.wrap_v;
    map.factor_ = test.factor;
    map.cutoff_ = test.cutoff;
    Thresholds const thresholds = make_thresholds(test);
    auto const columns = static_cast<std::size_t>(texture.size_px.x) + 1;
    auto const across = static_cast<std::size_t>(map.words_across());
    map.words_.assign(across * ((static_cast<std::size_t>(texture.size_px.y) + 4) / 4), 0);
    std::vector<std::uint8_t> first(columns);
    std::vector<std::uint8_t> second(columns);
    std::int32_t held = -1;  // The row in `second`, which is the next cell's first in all but the border rows.
    for (std::int32_t l = 0; l <= texture.size_px.y; ++l) {
        Sides const rows = sides_of(l, texture.size_px.y, texture.wrap_v);
        first.swap(second);
        if (held != rows.first) classify_row(test, thresholds, rows.first, first);
        classify_row(test, thresholds, rows.second, second);
        held = rows.second;
        std::uint32_t* const words = map.words_.data() + static_cast<std::size_t>(l / 4) * across;
        int const shift = l % 4 * 8;
        for (std::size_t k = 0; k < columns; ++k)
            words[k / 4] |= std::uint32_t{static_cast<std::uint8_t>(first[k] & second[k])}
                            << (shift + static_cast<int>(k % 4) * 2);
    }
    return map;
}

}  // namespace gnomon::raster
