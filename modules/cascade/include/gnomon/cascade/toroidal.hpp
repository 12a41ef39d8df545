#pragma once
// Maps addressed as a torus: a texel of light space is kept at its coordinates modulo the map's size. Scrolling then
// moves no texel: only the strips are cleared, and all depths change only where the map moved in depth.

#include <gnomon/cascade/formula/toroidal.glsl>
#include <gnomon/cascade/scroll.hpp>

#include <array>

namespace gnomon::cascade {

/// `x` modulo `size`, never negative.
///
/// expects: size above 0.
[[nodiscard]] constexpr std::int32_t wrapped(std::int64_t x, std::int32_t size) noexcept {
    std::int64_t const rest = x % size;
    return static_cast<std::int32_t>(rest < 0 ? rest + size : rest);
}
static_assert(wrapped(-1, 512) == 511 && wrapped(512, 512) == 0 && wrapped(-512, 512) == 0);

/// A part of a map that lies in one piece in memory: map texel (x, y) of `in_map` is kept (x, y) - (in_map.x, in_map.y)
/// + (kept.x, kept.y). To be drawn with the viewport moved by that difference, within `kept`.
struct ToroidalPiece {
    TexelRect in_map;
    TexelRect kept;

    friend constexpr bool operator==(ToroidalPiece const&, ToroidalPiece const&) noexcept = default;
};

/// At most four for a rectangle, eight for two strips.
struct ToroidalPieces {
    std::int32_t count = 0;
    std::array<ToroidalPiece, 8> pieces{};
};

/// Adds the pieces of `rect`, texels of the map `v`, to `out`.
///
/// expects: room for four more; `rect` within the map.
constexpr void add_pieces(Volume const& v, TexelRect const& rect, ToroidalPieces& out) noexcept {
    struct Runs {
        std::int32_t from[2], kept[2], length[2];
        std::int32_t count;
    };
    auto const runs_of = [&](std::int64_t first, std::int32_t begin, std::int32_t length) {
        std::int32_t const kept = wrapped(first + begin, v.size_px);
        std::int32_t const whole = v.size_px - kept;
        if (length <= whole) return Runs{{begin, 0}, {kept, 0}, {length, 0}, 1};
        return Runs{{begin, begin + whole}, {kept, 0}, {whole, length - whole}, 2};
    };
    if (rect.width <= 0 || rect.height <= 0) return;
    Runs const columns = runs_of(v.at.x, rect.x, rect.width);
    Runs const rows = runs_of(v.at.y, rect.y, rect.height);
    for (std::int32_t j = 0; j < rows.count; ++j)
        for (std::int32_t i = 0; i < columns.count; ++i) {
            ToroidalPiece& piece = out.pieces[static_cast<std::size_t>(out.count++)];
            piece.in_map = {columns.from[i], rows.from[j], columns.length[i], rows.length[j]};
            piece.kept = {columns.kept[i], rows.kept[j], columns.length[i], rows.length[j]};
        }
}

/// The pieces of all that is exposed in the map that `v` is now.
[[nodiscard]] constexpr ToroidalPieces toroidal_exposed(Volume const& v, ExposedRects const& exposed) noexcept {
    ToroidalPieces out;
    for (std::int32_t i = 0; i < exposed.count; ++i) add_pieces(v, exposed.rects[static_cast<std::size_t>(i)], out);
    return out;
}

/// Brings a toroidal map to the place of `v`, to which `by` has led: clears the strips, and moves all depths where `by`
/// moves in depth.
///
/// expects: as `scroll`, with `v` the volume after the move.
/// returns: how many texels were written
/// cost:    O(texels of the strips), O(texels) with a move in depth
template <DepthTexel T>
std::int64_t scroll_toroidal(MapTexels<T> map, Volume const& v, MapScroll const& by) {
    GNOMON_EXPECT(map.size_px == v.size_px);
    detail::ScrollKernel<T> kernel = detail::make_kernel<T>(by, map.size_px);
    kernel.dx = 0;
    std::int64_t written = 0;
    if (by.shift.z != 0) {
        for (std::int32_t y = 0; y < map.size_px; ++y) kernel.shift(map.row(y), map.row(y), 0, map.size_px, true);
        written = std::int64_t{map.size_px} * map.size_px;
    }
    ToroidalPieces const open = toroidal_exposed(v, exposed_by(by.shift, map.size_px));
    for (std::int32_t i = 0; i < open.count; ++i) {
        TexelRect const& kept = open.pieces[static_cast<std::size_t>(i)].kept;
        for (std::int32_t y = kept.y; y < kept.y + kept.height; ++y)
            std::fill_n(map.row(y) + kept.x, kept.width, static_cast<T>(kernel.clear()));
        written += by.shift.z != 0 ? 0 : std::int64_t{kept.width} * kept.height;
    }
    return written;
}

}  // namespace gnomon::cascade
