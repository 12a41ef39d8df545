#pragma once
// The rules by which a cached map is kept, one function each, so that a test can replace one and must then fail.

#include <gnomon/cache/box.hpp>
#include <gnomon/cache/map.hpp>
#include <gnomon/cache/plan.hpp>

namespace gnomon::cache::detail {

/// A member of S: an object as it was when it was drawn to C.
struct Member {
    ObjectId id;
    std::uint32_t revision;
    Box box;
    bool drawn = false;   ///< C may show some of it.
    bool owed = false;    ///< C lacks some of it.
    bool intact = false;  ///< C has all of it that was in its complete rectangle. Only of owed ones.
    bool ghost = false;   ///< Occluded now, but what hides it is perhaps not drawn yet.
};

static_assert(sizeof(Member) == 64 && sizeof(Object) == 64);

struct Rules {
    /// Is the object in the volume? No end toward the light.
    [[nodiscard]] static constexpr bool in_volume(Box const& box, Volume const& v) noexcept { return may_touch(box, v); }

    /// Must a member be drawn again because the volume moved? Compared with the volume that C shows.
    [[nodiscard]] static constexpr bool uncovered(Box const& box, Volume const& before, Volume const& now) noexcept {
        return shows_more(box, before, now);
    }

    /// May what is kept of C show the member? By its placement when it was drawn, not the one of now.
    [[nodiscard]] static constexpr bool in_kept(Member const& m, Object const*, Volume const& before,
                                                Volume const& now) noexcept {
        return may_touch_both(m.box, before, now);
    }

    /// Is C's image of the member still right?
    [[nodiscard]] static constexpr bool unchanged(Member const& m, Object const* now) noexcept {
        return now != nullptr && now->state == ObjectState::static_ && now->revision == m.revision && now->box == m.box;
    }

    /// Is no texel kept?
    [[nodiscard]] static constexpr bool jumped(Volume const& before, Volume const& now) noexcept {
        return is_empty(intersection(rect_of(before), rect_of(now)));
    }
    [[nodiscard]] static constexpr Shift shift(Volume const& before, Volume const& now) noexcept {
        return shift_between(before, now);
    }
    [[nodiscard]] static constexpr MapStep step(MapState now, MapEvent event) noexcept {
        return cache::step(now, event);
    }

    static constexpr bool remembers_owed = true;  ///< A member that was not drawn is drawn later.
    static constexpr bool keeps_ghosts = true;    ///< One that is hidden by what is not drawn yet can still show.
};

[[nodiscard]] constexpr std::int64_t area_of(TexelRect const& r) noexcept {
    return is_empty(r) ? 0 : (r.x1 - r.x0) * (r.y1 - r.y0);
}

/// What is kept of the texels of a volume, of which `box` is missing: the largest rectangle beside it.
[[nodiscard]] constexpr TexelRect without(TexelRect const& rect, TexelRect const& box) noexcept {
    if (is_empty(rect) || is_empty(intersection(rect, box))) return rect;
    TexelRect const sides[4] = {{rect.x0, rect.y0, box.x0, rect.y1},
                                {box.x1, rect.y0, rect.x1, rect.y1},
                                {rect.x0, rect.y0, rect.x1, box.y0},
                                {rect.x0, box.y1, rect.x1, rect.y1}};
    TexelRect best{};
    for (TexelRect const& side : sides)
        if (area_of(side) > area_of(best)) best = side;
    return best;
}

/// The larger of two rectangles, or of those that both together fill: side by side, or one above the other.
[[nodiscard]] constexpr TexelRect largest_in_both(TexelRect const& a, TexelRect const& b) noexcept {
    TexelRect best = area_of(a) >= area_of(b) ? a : b;
    if (is_empty(a) || is_empty(b)) return best;
    TexelRect const common = intersection(a, b);
    TexelRect const wide{std::min(a.x0, b.x0), common.y0, std::max(a.x1, b.x1), common.y1};
    TexelRect const high{common.x0, std::min(a.y0, b.y0), common.x1, std::max(a.y1, b.y1)};
    if (common.x0 <= common.x1 && area_of(wide) > area_of(best)) best = wide;
    if (common.y0 <= common.y1 && area_of(high) > area_of(best)) best = high;
    return best;
}

}  // namespace gnomon::cache::detail
