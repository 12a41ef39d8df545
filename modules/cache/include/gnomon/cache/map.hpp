#pragma once
// A cached map's state: has it a place in memory, is what stands there right, and is it all there?

#include <gnomon/cache/reason.hpp>

#include <cstddef>
#include <cstdint>

namespace gnomon::cache {

enum class MapState : std::uint8_t {
    unplaced,  ///< Has no memory and asks for none.
    pending,   ///< Asks for memory.
    placed,    ///< Has memory that was never drawn to: nothing to look up in.
    invalid,   ///< Holds an image that is out of date.
    partial,   ///< Holds a part of the right image, and nothing wrong.
    valid,     ///< Holds the right image.
};
inline constexpr std::size_t map_state_count = 6;

enum class MapEvent : std::uint8_t {
    requested,           ///< Somebody wants to look up in it.
    granted,             ///< A place in memory was found; what is there is not this map's.
    evicted,             ///< Its memory is taken away, or no longer asked for.
    content_lost,        ///< The memory is its own still, its content gone: a lost device.
    moved_with_content,  ///< Another place in the atlas, image copied.
    light_posed,         ///< The light's position or direction.
    light_range,
    light_cone,
    projection_changed,  ///< Its kind, depth convention, or units.
    resolution_changed,
    settings_changed,    ///< What else decides the image: format, culled faces, clamping or clipping, a bias that is drawn.
    redraw_requested,
    origin_rebased,      ///< World positions and the anchor are shifted alike.
    view_set_changed,    ///< Other views look up in it. A volume that follows them moves by `volume_moved`.
    volume_moved,
    volume_jumped,
    member_changed,      ///< A member is not static any more as it was drawn, and touches what is kept.
    member_joined,       ///< A member has to be drawn in addition.
    drawn_partly,
    drawn_wholly,
    postponed,           ///< The budget had no room for it.
};
inline constexpr std::size_t map_event_count = 21;

/// What remains to be done.
enum class MapAction : std::uint8_t {
    none,
    place,    ///< Find it a place.
    release,  ///< Its place is free.
    redraw,   ///< Clear C and draw S.
    scroll,   ///< Move C, then draw dS.
    add,      ///< Draw dS.
};

struct MapStep {
    MapState next;
    MapAction action;

    friend constexpr bool operator==(MapStep, MapStep) noexcept = default;
};

namespace detail {

[[nodiscard]] constexpr MapAction due_in(MapState state) noexcept {
    switch (state) {
        case MapState::unplaced:
        case MapState::valid: return MapAction::none;
        case MapState::pending: return MapAction::place;
        case MapState::placed:
        case MapState::invalid: return MapAction::redraw;
        case MapState::partial: return MapAction::add;
    }
    return MapAction::none;
}

[[nodiscard]] constexpr MapStep stay(MapState state) noexcept { return {state, due_in(state)}; }

/// The reason that an event gives for drawing.
[[nodiscard]] constexpr Reason reason_of(MapEvent event) noexcept {
    switch (event) {
        case MapEvent::granted: return Reason::first_use;
        case MapEvent::content_lost: return Reason::content_lost;
        case MapEvent::light_posed: return Reason::light_posed;
        case MapEvent::light_range: return Reason::light_range;
        case MapEvent::light_cone: return Reason::light_cone;
        case MapEvent::projection_changed: return Reason::projection_changed;
        case MapEvent::resolution_changed: return Reason::resolution_changed;
        case MapEvent::settings_changed: return Reason::settings_changed;
        case MapEvent::redraw_requested: return Reason::redraw_requested;
        case MapEvent::volume_jumped: return Reason::volume_jumped;
        case MapEvent::member_changed: return Reason::member_moved;
        case MapEvent::volume_moved: return Reason::volume_moved;
        case MapEvent::member_joined: return Reason::member_joined;
        case MapEvent::requested:
        case MapEvent::evicted:
        case MapEvent::moved_with_content:
        case MapEvent::origin_rebased:
        case MapEvent::view_set_changed:
        case MapEvent::drawn_partly:
        case MapEvent::drawn_wholly:
        case MapEvent::postponed: return Reason::none;
    }
    return Reason::none;
}

/// A map that has memory: what its image does to it, and what its memory.
[[nodiscard]] constexpr MapStep step_placed(MapState now, MapEvent event) noexcept {
    bool const shows = now == MapState::partial || now == MapState::valid;
    switch (event) {
        case MapEvent::granted:
        case MapEvent::content_lost: return stay(MapState::placed);
        case MapEvent::evicted: return {MapState::unplaced, MapAction::release};
        case MapEvent::light_posed:
        case MapEvent::light_range:
        case MapEvent::light_cone:
        case MapEvent::projection_changed:
        case MapEvent::resolution_changed:
        case MapEvent::settings_changed:
        case MapEvent::redraw_requested:
        case MapEvent::volume_jumped:
        case MapEvent::member_changed: return stay(shows ? MapState::invalid : now);
        case MapEvent::volume_moved: return shows ? MapStep{MapState::partial, MapAction::scroll} : stay(now);
        case MapEvent::member_joined: return stay(shows ? MapState::partial : now);
        case MapEvent::drawn_partly: return stay(MapState::partial);
        case MapEvent::drawn_wholly: return stay(MapState::valid);
        case MapEvent::requested:
        case MapEvent::moved_with_content:
        case MapEvent::origin_rebased:
        case MapEvent::view_set_changed:
        case MapEvent::postponed: return stay(now);
    }
    return stay(now);
}

}  // namespace detail

/// One transition of one cached map. Pure: the caller performs the action.
///
/// A map without memory cannot become right or wrong; only `requested`, `granted` and `evicted` move it. A part that is
/// drawn never makes a map valid, not even a valid one that is drawn over.
[[nodiscard]] constexpr MapStep step(MapState now, MapEvent event) noexcept {
    if (now != MapState::unplaced && now != MapState::pending) return detail::step_placed(now, event);
    if (event == MapEvent::granted) return detail::stay(MapState::placed);
    if (event == MapEvent::requested) return detail::stay(MapState::pending);
    if (event == MapEvent::evicted) return detail::stay(MapState::unplaced);
    return detail::stay(now);
}

/// May one look up in the map, its texels perhaps out of date or not all there?
[[nodiscard]] constexpr bool holds_image(MapState state) noexcept {
    return state == MapState::invalid || state == MapState::partial || state == MapState::valid;
}

static_assert(step(MapState::valid, MapEvent::light_posed) == MapStep{MapState::invalid, MapAction::redraw});
static_assert(step(MapState::valid, MapEvent::volume_moved) == MapStep{MapState::partial, MapAction::scroll});
static_assert(step(MapState::valid, MapEvent::origin_rebased) == MapStep{MapState::valid, MapAction::none});
static_assert(step(MapState::partial, MapEvent::drawn_partly) == MapStep{MapState::partial, MapAction::add});
static_assert(step(MapState::valid, MapEvent::drawn_partly).next == MapState::partial);
static_assert(step(MapState::invalid, MapEvent::volume_moved) == MapStep{MapState::invalid, MapAction::redraw});
static_assert(step(MapState::valid, MapEvent::evicted) == MapStep{MapState::unplaced, MapAction::release});

}  // namespace gnomon::cache
