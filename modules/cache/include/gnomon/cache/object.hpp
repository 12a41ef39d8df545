#pragma once
// An object's state: does it change from frame to frame (active), or has it been at rest for long (static)?
//
// Static objects are drawn once, into the cached map C; active ones in every frame, onto the working map W.
// source: [CSM Scrolling, 2]. Time is whole ticks, of frames or milliseconds: the caller's clock, there is none here.

#include <gnomon/core/id.hpp>

#include <algorithm>
#include <cstdint>

namespace gnomon::cache {

using ObjectId = core::Id<struct ObjectTag>;

/// Only `active` and `static_` objects cast shadows.
enum class ObjectState : std::uint8_t {
    absent,   ///< Never there, or deleted.
    hidden,   ///< There, but casts no shadow: invisible, or in no layer that casts.
    active,   ///< Changed not long ago: part of A.
    static_,  ///< Has been at rest for the prescribed time: part of S. (`static` is a word of the language.)
};

/// What happens to an object. What leaves its shadow as it is, such as a new colour, is no event.
enum class ObjectEvent : std::uint8_t {
    appeared,          ///< Also an id that is given to a new object.
    moved,             ///< Position, rotation or scale.
    teleported,
    deformed,          ///< Skinned, morphed, or moved by its shader.
    material_changed,  ///< Another material with an effect on depth, such as two sides.
    alpha_changed,     ///< Its mask: texture, cutoff, texture coordinates.
    lod_switched,
    layers_changed,    ///< Casts for other lights or views than before.
    hidden,
    shown,
    deleted,
    rested,            ///< The prescribed time is over.
};
inline constexpr std::size_t object_event_count = 12;

/// What an event does to an object.
struct ObjectStep {
    ObjectState next;
    bool changed;   ///< An image drawn before is no longer right: caches that hold one drop it.
    bool restarts;  ///< The time of rest begins anew.

    friend constexpr bool operator==(ObjectStep, ObjectStep) noexcept = default;
};

namespace detail {

[[nodiscard]] constexpr bool changes_image(ObjectEvent event) noexcept {
    switch (event) {
        case ObjectEvent::moved:
        case ObjectEvent::teleported:
        case ObjectEvent::deformed:
        case ObjectEvent::material_changed:
        case ObjectEvent::alpha_changed:
        case ObjectEvent::lod_switched:
        case ObjectEvent::layers_changed: return true;
        case ObjectEvent::appeared:
        case ObjectEvent::hidden:
        case ObjectEvent::shown:
        case ObjectEvent::deleted:
        case ObjectEvent::rested: return false;
    }
    return false;
}

}  // namespace detail

/// One transition of one object. Pure.
///
/// A hidden object that changes stays hidden; an event of an absent one, other than `appeared`, does nothing.
[[nodiscard]] constexpr ObjectStep step(ObjectState now, ObjectEvent event) noexcept {
    if (event == ObjectEvent::appeared) return {ObjectState::active, true, true};
    bool const changes = detail::changes_image(event);
    switch (now) {
        case ObjectState::absent: return {now, false, false};
        case ObjectState::hidden:
            if (event == ObjectEvent::shown) return {ObjectState::active, true, true};
            if (event == ObjectEvent::deleted) return {ObjectState::absent, true, false};
            return {now, changes, false};
        case ObjectState::active:
        case ObjectState::static_:
            if (event == ObjectEvent::hidden) return {ObjectState::hidden, true, false};
            if (event == ObjectEvent::deleted) return {ObjectState::absent, true, false};
            if (event == ObjectEvent::rested) return {ObjectState::static_, false, false};
            return changes ? ObjectStep{ObjectState::active, true, true} : ObjectStep{now, false, false};
    }
    return {now, false, false};
}

/// How soon an object may rest.
enum class Mobility : std::uint8_t {
    automatic,  ///< After the prescribed time.
    fixed,      ///< At once: level geometry, of which a change is rare and may cost a redraw.
    dynamic,    ///< Never.
};

/// One object's memory between frames. `revision` is never the same for two images of it, not even after deletion.
struct ObjectRecord {
    ObjectState state = ObjectState::absent;
    Mobility mobility = Mobility::automatic;
    ObjectEvent cause = ObjectEvent::appeared;  ///< The last event that changed its image.
    std::uint8_t wakes = 0;                     ///< How often it stopped being static, at most 255.
    std::uint32_t revision = 0;
    std::uint64_t since = 0;                    ///< Tick of the last change.

    friend constexpr bool operator==(ObjectRecord const&, ObjectRecord const&) noexcept = default;
};

struct RestConfig {
    std::uint64_t rest_ticks = 600;  ///< 10 s at 60 frames per second, as in [CSM Scrolling, 2].
    std::uint8_t max_doublings = 0;  ///< Each time an object wakes doubles its next rest, so often at most.
};

/// The record after an event at tick `now`.
[[nodiscard]] constexpr ObjectRecord advance(ObjectRecord record, ObjectEvent event, std::uint64_t now) noexcept {
    ObjectStep const done = step(record.state, event);
    if (event == ObjectEvent::appeared) record.wakes = 0;
    else if (record.state == ObjectState::static_ && done.changed && record.wakes < 255) ++record.wakes;
    record.state = done.next;
    if (done.changed) {
        ++record.revision;
        record.cause = event;
    }
    if (done.restarts) record.since = now;
    return record;
}

/// The ticks that this object has to rest before it is static; `dynamic` ones rest never and are not asked.
[[nodiscard]] constexpr std::uint64_t ticks_of_rest(ObjectRecord const& record, RestConfig const& config) noexcept {
    if (record.mobility == Mobility::fixed) return 0;
    unsigned const doublings = std::min<unsigned>({record.wakes, config.max_doublings, 63U});
    std::uint64_t const longest = ~std::uint64_t{0} >> doublings;
    return config.rest_ticks > longest ? ~std::uint64_t{0} : config.rest_ticks << doublings;
}

/// The record at tick `now`: static if it is active and its time is over. A clock that runs backward lets nothing rest.
[[nodiscard]] constexpr ObjectRecord settle(ObjectRecord record, RestConfig const& config, std::uint64_t now) noexcept {
    if (record.state != ObjectState::active || record.mobility == Mobility::dynamic || now < record.since) return record;
    if (now - record.since < ticks_of_rest(record, config)) return record;
    return advance(record, ObjectEvent::rested, now);
}

static_assert(step(ObjectState::active, ObjectEvent::rested) == ObjectStep{ObjectState::static_, false, false});
static_assert(step(ObjectState::static_, ObjectEvent::deformed) == ObjectStep{ObjectState::active, true, true});
static_assert(step(ObjectState::static_, ObjectEvent::hidden) == ObjectStep{ObjectState::hidden, true, false});
static_assert(step(ObjectState::hidden, ObjectEvent::shown) == ObjectStep{ObjectState::active, true, true});
static_assert(step(ObjectState::static_, ObjectEvent::appeared) == ObjectStep{ObjectState::active, true, true},
              "an id given to a new object");
static_assert(step(ObjectState::absent, ObjectEvent::moved) == ObjectStep{ObjectState::absent, false, false});

}  // namespace gnomon::cache
