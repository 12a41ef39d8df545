#pragma once
// What goes into one update of a cached map, and what comes out of it: plain data.

#include <gnomon/cache/box.hpp>
#include <gnomon/cache/map.hpp>
#include <gnomon/cache/object.hpp>
#include <gnomon/cache/reason.hpp>

#include <cstdint>
#include <span>

namespace gnomon::cache {

/// One caster as it is now. Batches of an object that moves as a whole are objects of their own: the finer they are, the
/// less is drawn to fill a strip [CSM Scrolling, 3].
struct Object {
    ObjectId id{};
    std::uint32_t revision = 0;  ///< Another one for every image, see `ObjectRecord`.
    ObjectState state = ObjectState::absent;
    ObjectEvent cause = ObjectEvent::appeared;  ///< Of its last change; only reasons use it.
    Box box{};                                  ///< In light space. Maps that do not scroll have no use for it.
};

[[nodiscard]] constexpr Object make_object(ObjectId id, ObjectRecord const& record, Box const& box = {}) noexcept {
    return {id, record.revision, record.state, record.cause, box};
}

/// How the working map W is made of C.
enum class Compose : std::uint8_t {
    keep,           ///< W is right as it is: C was kept and no active object is or was on it.
    copy,           ///< Copy C's texels of `Plan::copied` to W.
    copy_and_draw,  ///< The same, then draw A onto it.
};

/// What an update looked at.
struct PlanCounts {
    std::uint64_t objects = 0;
    std::uint64_t not_casting = 0;  ///< Absent or hidden.
    std::uint64_t outside = 0;      ///< Of the volume, or an empty box.
    std::uint64_t occluded = 0;
    std::uint64_t statics = 0;      ///< |S|. The five add up to `objects` with `actives`.
    std::uint64_t actives = 0;      ///< |A|.
    std::uint64_t joined = 0;       ///< Of dS: those that were not in S'.
    std::uint64_t uncovered = 0;    ///< Of dS: those of which the new volume shows more than the old one.
    std::uint64_t owed = 0;         ///< Of dS: those that an earlier frame left undone.
    std::uint64_t members = 0;      ///< |S'|: what C was drawn from.
    std::uint64_t left = 0;         ///< Of S': changed, but only where the map does not look any more.

    friend constexpr bool operator==(PlanCounts const&, PlanCounts const&) noexcept = default;
};

/// The work of one update, in this order: `action`, `statics` onto C, `compose`, `actives` onto W.
struct Plan {
    MapAction action = MapAction::none;
    Reason reason = Reason::none;
    ObjectId culprit{};                        ///< The first member that is to blame, if one is.
    Volume before{};                           ///< V': what C shows now. Only of scrolls.
    Volume volume{};                           ///< V: what it shows afterwards.
    Shift shift{};                             ///< From V' to V; 0 but for scrolls.
    std::span<std::uint32_t const> statics{};  ///< Places in the span of objects, ascending: S of a redraw, else dS.
    /// Of each of `statics`: 1 where C lacks it only in texels that it did not show before, so that a drawing that is cut
    /// to those is enough.
    std::span<std::uint8_t const> beside{};
    std::span<std::uint32_t const> actives{};  ///< A, alike.
    Compose compose = Compose::keep;
    /// What of C has to be copied, in light space and inside of V: where C changes or active objects were. A map that does
    /// not scroll is copied whole.
    TexelRect copied{};
    PlanCounts counts{};
};

}  // namespace gnomon::cache
