#pragma once
// Why a cached map was drawn again, and how often.

#include <gnomon/cache/object.hpp>

#include <array>
#include <cstddef>
#include <cstdint>

namespace gnomon::cache {

/// Why something of the cached map C had to be drawn. Up to `redraw_requested` and the members': all of it.
enum class Reason : std::uint8_t {
    none,
    first_use,  ///< Its memory has never been drawn to, or was given away.
    content_lost,
    light_posed,
    light_range,
    light_cone,
    projection_changed,
    resolution_changed,
    settings_changed,
    redraw_requested,
    volume_jumped,  ///< Old and new volume have no texel in common.
    member_moved,   ///< A static object in the kept region is not what it was when it was drawn.
    member_teleported,
    member_deformed,
    member_material,
    member_alpha,
    member_lod,
    member_layers,
    member_hidden,
    member_replaced,  ///< Its id is another object's.
    member_missing,   ///< Deleted, or gone where the map does not see it.
    volume_moved,     ///< A scroll; from here on: a part of the map.
    member_joined,    ///< An object is newly static or newly in view.
    part_owed,        ///< What an earlier frame left undone.
};
inline constexpr std::size_t reason_count = 24;

/// All of the map, not a part of it?
[[nodiscard]] constexpr bool is_redraw(Reason reason) noexcept {
    return reason != Reason::none && reason < Reason::volume_moved;
}

/// The reason's name, as it stands above.
[[nodiscard]] constexpr char const* name_of(Reason reason) noexcept {
    constexpr std::array<char const*, reason_count> names{
        "none",           "first_use",         "content_lost",       "light_posed",        "light_range",
        "light_cone",     "projection_changed", "resolution_changed", "settings_changed",   "redraw_requested",
        "volume_jumped",  "member_moved",      "member_teleported",  "member_deformed",    "member_material",
        "member_alpha",   "member_lod",        "member_layers",      "member_hidden",      "member_replaced",
        "member_missing", "volume_moved",      "member_joined",      "part_owed"};
    auto const i = static_cast<std::size_t>(reason);
    return i < reason_count ? names[i] : "unknown";
}

/// Why a member's image is not right, by what happened to it last.
[[nodiscard]] constexpr Reason reason_of(ObjectEvent cause) noexcept {
    switch (cause) {
        case ObjectEvent::moved: return Reason::member_moved;
        case ObjectEvent::teleported: return Reason::member_teleported;
        case ObjectEvent::deformed: return Reason::member_deformed;
        case ObjectEvent::material_changed: return Reason::member_material;
        case ObjectEvent::alpha_changed: return Reason::member_alpha;
        case ObjectEvent::lod_switched: return Reason::member_lod;
        case ObjectEvent::layers_changed: return Reason::member_layers;
        case ObjectEvent::hidden:
        case ObjectEvent::shown: return Reason::member_hidden;
        case ObjectEvent::appeared: return Reason::member_replaced;
        case ObjectEvent::deleted: return Reason::member_missing;
        case ObjectEvent::rested: return Reason::member_moved;
    }
    return Reason::none;
}

/// What was done to a map over many frames. Every update is one of redraws, scrolls, additions, kept and postponed.
struct History {
    std::uint64_t redraws = 0;    ///< C drawn from nothing.
    std::uint64_t scrolls = 0;    ///< C moved, and the members in `dS` drawn.
    std::uint64_t additions = 0;  ///< Members drawn onto a C that did not move.
    std::uint64_t kept = 0;       ///< C as it was.
    std::uint64_t postponed = 0;
    std::array<std::uint64_t, reason_count> by_reason{};  ///< Of redraws, scrolls and additions, one reason each.

    [[nodiscard]] constexpr std::uint64_t of(Reason reason) const noexcept {
        return by_reason[static_cast<std::size_t>(reason)];
    }

    friend constexpr bool operator==(History const&, History const&) noexcept = default;
};

/// Do the reasons add up to what was drawn, those of all of the map and those of a part each for itself?
[[nodiscard]] constexpr bool adds_up(History const& h) noexcept {
    std::uint64_t whole = 0;
    std::uint64_t part = 0;
    for (std::size_t i = 1; i < reason_count; ++i)
        (is_redraw(static_cast<Reason>(i)) ? whole : part) += h.by_reason[i];
    return h.by_reason[0] == 0 && whole == h.redraws && part == h.scrolls + h.additions;
}

}  // namespace gnomon::cache
