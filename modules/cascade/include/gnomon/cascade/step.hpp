#pragma once
// From one frame's volume to the next: keep the map, scroll it, or draw it anew, and why. Pure and whole-numbered.
//
// source: [CSM Scrolling, 3 and 5]; the listing's `verts[2]` reads u0 where it needs u1, and its depth needs whole
// units

#include <gnomon/cascade/volume.hpp>

#include <array>

namespace gnomon::cascade {

enum class Action : std::uint8_t {
    keep,    ///< Nothing of the map's place changed.
    scroll,  ///< Moved by whole texels and units: shift what is held, draw what is exposed.
    redraw,  ///< Nothing held is of use.
};

enum class Reason : std::uint8_t {
    none,          ///< Of `keep` and `scroll`.
    first,         ///< Nothing is held yet.
    requested,     ///< By `invalidate`.
    light_turned,  ///< Other axes: not a move in light space.
    anchor_moved,  ///< Another anchor without `rebase`.
    map_size,      ///< Other texels a side.
    depth_format,  ///< Another last code.
    texel_size,    ///< The field of view, the splits or the fit changed.
    depth_unit,    ///< The depth range's length changed.
    moved_past,    ///< By a map's width or more: no texel is common.
    depth_past,    ///< By the whole depth range or more: no code is common.
};

inline constexpr std::size_t reason_count = 11;

/// Texels of a map: [x, x + width) x [y, y + height).
struct TexelRect {
    std::int32_t x = 0;
    std::int32_t y = 0;
    std::int32_t width = 0;
    std::int32_t height = 0;

    friend constexpr bool operator==(TexelRect const&, TexelRect const&) noexcept = default;
};

/// The texels that scrolling leaves without content: none, one or two strips that do not overlap, or the whole map.
struct ExposedRects {
    std::int32_t count = 0;
    std::array<TexelRect, 2> rects{};

    friend constexpr bool operator==(ExposedRects const&, ExposedRects const&) noexcept = default;
};

/// The columns first, over the whole height; then what is left of the rows.
[[nodiscard]] constexpr ExposedRects exposed_by(Place const& shift, std::int32_t size_px) noexcept {
    std::int64_t const size = size_px;
    ExposedRects out;
    if (shift.x >= size || shift.x <= -size || shift.y >= size || shift.y <= -size) {
        out.rects[0] = {0, 0, size_px, size_px};
        out.count = 1;
        return out;
    }
    auto const dx = static_cast<std::int32_t>(shift.x);
    auto const dy = static_cast<std::int32_t>(shift.y);
    std::int32_t const columns = dx < 0 ? -dx : dx;
    std::int32_t const rows = dy < 0 ? -dy : dy;
    if (columns != 0)
        out.rects[static_cast<std::size_t>(out.count++)] = {dx > 0 ? size_px - columns : 0, 0, columns, size_px};
    if (rows != 0)
        out.rects[static_cast<std::size_t>(out.count++)] = {dx < 0 ? columns : 0, dy > 0 ? size_px - rows : 0,
                                                            size_px - columns, rows};
    return out;
}

/// One corner of a quad that scrolls a map with ordinary texture mapping: where it stands in the new map, what it reads
/// of the old one (0 to 1 is the map), and what is added to the depth (0 to 1 is the range).
struct QuadVertex {
    float x_px, y_px;
    float u, v;
    float depth;

    friend constexpr bool operator==(QuadVertex const&, QuadVertex const&) noexcept = default;
};

/// The paper's listing: top left, bottom left, top right, bottom right.
///
/// `reversed`: nearest is 1, so the offset has the other sign, and what is beyond the border reads as 0.
/// source:  [CSM Scrolling, 5, listing]
/// expects: a shift of less than 2^24 texels; exact where the size is a power of two and the codes are 2^24
[[nodiscard]] constexpr std::array<QuadVertex, 4> quad_of(Place const& shift, Volume const& v, bool reversed) noexcept {
    auto const ratio = [](std::int64_t units, std::int32_t of) {
        return static_cast<float>(static_cast<double>(units) / of);
    };
    float const size = static_cast<float>(v.size_px);
    float const u0 = ratio(shift.x, v.size_px);
    float const v0 = ratio(shift.y, v.size_px);
    float const u1 = ratio(shift.x + v.size_px, v.size_px);
    float const v1 = ratio(shift.y + v.size_px, v.size_px);
    float const depth = ratio(reversed ? shift.z : -shift.z, v.codes);
    return {{{0.0F, 0.0F, u0, v0, depth},
             {0.0F, size, u0, v1, depth},
             {size, 0.0F, u1, v0, depth},
             {size, size, u1, v1, depth}}};
}

/// What becomes of one cascade's static map.
struct Update {
    Action action = Action::redraw;
    Reason reason = Reason::first;
    Place shift;                 ///< From the old place to the new one, never wrapped; 0 with `redraw` of other units.
    ExposedRects exposed;        ///< To be drawn: all of the map with `redraw`. Shifts in depth reveal more.
    std::int32_t add_codes = 0;  ///< Added to every code that is not the last, for forward depth: -shift.z.

    friend constexpr bool operator==(Update const&, Update const&) noexcept = default;
};

[[nodiscard]] constexpr Update redraw(Reason reason, std::int32_t size_px) noexcept {
    return {Action::redraw, reason, {}, {1, {TexelRect{0, 0, size_px, size_px}, TexelRect{}}}, 0};
}

/// What to do when a map that holds `from` has to hold `to`, in the same light frame.
///
/// A move in depth alone exposes no texel, but reveals what was beyond the last code or clamped at the first: whoever
/// draws the exposed strips draws every member of the old volume again that it did not hold whole (`cache::shows_more`).
[[nodiscard]] constexpr Update update_from(Volume const& from, Volume const& to) noexcept {
    if (from.size_px != to.size_px) return redraw(Reason::map_size, to.size_px);
    if (from.codes != to.codes) return redraw(Reason::depth_format, to.size_px);
    if (from.texel_m != to.texel_m) return redraw(Reason::texel_size, to.size_px);
    if (from.depth_unit_m != to.depth_unit_m) return redraw(Reason::depth_unit, to.size_px);
    Place const shift = to.at - from.at;
    if (shift == Place{}) return {Action::keep, Reason::none, {}, {}, 0};
    auto const reaches = [](std::int64_t moved, std::int64_t size) { return moved >= size || moved <= -size; };
    Update update = redraw(Reason::moved_past, to.size_px);
    update.shift = shift;
    if (reaches(shift.x, to.size_px) || reaches(shift.y, to.size_px)) return update;
    update.reason = Reason::depth_past;
    if (reaches(shift.z, to.codes)) return update;
    return {Action::scroll, Reason::none, shift, exposed_by(shift, to.size_px), static_cast<std::int32_t>(-shift.z)};
}

namespace detail {
inline constexpr Volume volume_rows{{100, 200, 300}, 64, unorm16_codes, 0.5, 0.25};
constexpr Volume moved(std::int64_t x, std::int64_t y, std::int64_t z) {
    return {{100 + x, 200 + y, 300 + z}, 64, unorm16_codes, 0.5, 0.25};
}
}  // namespace detail

static_assert(update_from(detail::volume_rows, detail::volume_rows).action == Action::keep);
static_assert(update_from(detail::volume_rows, detail::moved(3, 0, 0)).exposed.rects[0] == TexelRect{61, 0, 3, 64});
static_assert(update_from(detail::volume_rows, detail::moved(-3, 5, 0)).exposed.rects[1] == TexelRect{3, 59, 61, 5});
static_assert(update_from(detail::volume_rows, detail::moved(0, 0, 7)).add_codes == -7);
static_assert(update_from(detail::volume_rows, detail::moved(0, 0, 7)).exposed.count == 0);
static_assert(update_from(detail::volume_rows, detail::moved(63, 0, 0)).action == Action::scroll);
static_assert(update_from(detail::volume_rows, detail::moved(64, 0, 0)).reason == Reason::moved_past);
static_assert(update_from(detail::volume_rows, detail::moved(0, -64, 0)).reason == Reason::moved_past);
static_assert(update_from(detail::volume_rows, detail::moved(0, 0, 65535)).reason == Reason::depth_past);
static_assert(update_from(detail::volume_rows, detail::moved(0, 0, 65534)).action == Action::scroll);

}  // namespace gnomon::cascade
