#pragma once
// One cached shadow map's bookkeeping: what C holds, what of it can be kept in the next frame, and what must be drawn.
//
// Nothing is drawn here. In each frame the caller asks for a plan, performs it or a part of it, and says how far it came.
// source: [CSM Scrolling, 2 and 3] with the errata's rule for dS and for the query volume.

#include <gnomon/cache/detail/query.hpp>
#include <gnomon/cache/plan.hpp>

#include <cstdint>
#include <span>
#include <vector>

namespace gnomon::cache {

/// Nothing is known to be occluded.
struct NeverOccluded {
    [[nodiscard]] constexpr bool operator()(std::uint32_t) const noexcept { return false; }
};

/// The memory of one map: its state, V', S' and where its members were when they were drawn.
///
/// `Rules` is for tests; use `CachedMap`.
template <class Rules>
class BasicCachedMap {
public:
    /// A map with memory of its own starts as `placed`, one that waits for a place in an atlas as `unplaced`.
    explicit BasicCachedMap(MapState initial = MapState::placed) noexcept : state_(initial) {}

    /// Tells the map what happened to its light or memory, before it is asked for a plan: one made before is void, unless
    /// the event changes nothing. Volumes and members are looked at by `plan`, drawing is told by `commit`.
    ///
    /// returns: what remains to be done. `release` is said once.
    MapAction notify(MapEvent event) noexcept;

    /// What must be done so that the map shows `volume`, as it is now.
    ///
    /// `objects` are all casters that touch `volume`, and any others, by ascending ids. A member that is missing counts as
    /// deleted, which costs nothing if it had left the volume anyway.
    /// `occluded(i)`: is every texel of objects[i] that `volume` shows covered by nearer static objects of the list that are
    /// not occluded themselves? Only static ones: an object once hidden by them stays so until one of them is a reason to
    /// redraw. Never asked of objects outside. No test at all is always right.
    ///
    /// expects: ids ascend strictly; |coordinates| of the volume <= `max_units`, sizes 1 to 2^30, `far_code` > 0.
    /// returns: the plan, valid until the next call. Asking again without `commit` is legal and changes nothing.
    /// cost:    O(objects + members). Allocates only what earlier plans did not need.
    template <class Occluded = NeverOccluded>
    Plan const& plan(Volume const& volume, std::span<Object const> objects, Occluded const& occluded = {}) {
        GNOMON_EXPECT(is_legal(volume));
        return make_plan(detail::ScrollQuery<Rules>{volume_, volume}, objects, occluded);
    }

    /// The same for a map that does not move: a spot's, or one face of a cube.
    ///
    /// `touches(i)`: may objects[i] write a texel of this map? Never a false no. Boxes are not looked at.
    template <class Touches, class Occluded = NeverOccluded>
    Plan const& plan_fixed(std::span<Object const> objects, Touches const& touches, Occluded const& occluded = {}) {
        return make_plan(detail::FixedQuery<Rules, Touches>{touches}, objects, occluded);
    }

    /// All of the last plan was done.
    ///
    /// expects: of all four: a plan, asked for since the last of them, and not void.
    void commit() { commit_part(plan_.statics.size()); }
    /// Only the first `drawn` of the plan's `statics` were drawn; its action and what composes W were done.
    void commit_part(std::size_t drawn);
    /// All of the plan's `statics` were drawn, but only to the texels of `done`: a strip, or a part of a redraw. Its action and
    /// what composes W were done. Of a map that does not scroll nothing counts as drawn.
    void commit_rect(TexelRect const& done);
    /// Nothing of the last plan was done: C and W still show what they showed.
    void postpone() noexcept;

    [[nodiscard]] MapState state() const noexcept { return state_; }
    /// What C and W show, since the last commit. Until then, and while nothing is held, of no meaning.
    [[nodiscard]] Volume const& volume() const noexcept { return volume_; }
    /// Texels of C, in light space, that lack no member: all of a valid map's. Only of maps that scroll.
    [[nodiscard]] TexelRect const& complete_rect() const noexcept { return complete_; }
    /// Updates in a row after which W was not what it should have been.
    [[nodiscard]] std::uint64_t stale_updates() const noexcept { return stale_; }
    [[nodiscard]] History const& history() const noexcept { return history_; }
    [[nodiscard]] std::size_t member_count() const noexcept { return members_.size(); }

private:
    using Member = detail::Member;

    [[nodiscard]] static constexpr bool is_legal(Volume const& v) noexcept {
        auto const in = [](std::int64_t c) { return -max_units <= c && c <= max_units; };
        auto const size = [](std::int64_t c) { return 0 < c && c <= std::int64_t{1} << 30; };
        return in(v.x) && in(v.y) && in(v.z) && size(v.width) && size(v.height) && 0 < v.far_code && in(v.far_code);
    }
    [[nodiscard]] static constexpr bool shows(MapState s) noexcept {
        return s == MapState::partial || s == MapState::valid;
    }
    [[nodiscard]] bool has_memory() const noexcept {
        return state_ != MapState::unplaced && state_ != MapState::pending;
    }

    template <class Query, class Occluded>
    Plan const& make_plan(Query const& query, std::span<Object const> objects, Occluded const& occluded);
    /// Applies an event to the planned state; the first one that is a reason to redraw is the plan's reason.
    void suppose(MapEvent event, Reason reason, ObjectId culprit = {}) noexcept;
    template <class Query>
    void check_members(Query const& query, std::span<Object const> objects);
    template <class Query, class Occluded>
    void gather(Query const& query, std::span<Object const> objects, Occluded const& occluded);
    template <class Query>
    void add_static(Query const& query, std::uint32_t i, Object const& object, Member const* member);
    /// Is there a plan to commit, and memory?
    [[nodiscard]] bool take_plan() noexcept;
    void finish(bool whole);
    void count_commit() noexcept;
    void decide(bool moved) noexcept;
    void compose(std::span<Object const> objects) noexcept;

    MapState state_;
    Reason blame_ = Reason::first_use;  ///< Why it is placed or invalid.
    ObjectId blamed_{};
    bool fixed_ = false;
    Volume volume_{};
    TexelRect complete_{};
    TexelRect w_differs_{};     ///< Where W may hold active objects.
    bool w_has_actives_ = false;
    std::uint64_t stale_ = 0;
    History history_{};
    std::vector<Member> members_;  ///< S' by ascending ids, 64 bytes each.
    std::vector<Member> next_;     ///< S of the plan.
    std::vector<std::uint32_t> statics_;
    std::vector<std::uint8_t> beside_;
    std::vector<std::uint32_t> actives_;
    Plan plan_{};
    TexelRect w_will_differ_{};
    MapState planned_ = MapState::placed;
    bool has_plan_ = false;
    bool planned_fixed_ = false;
};

using CachedMap = BasicCachedMap<detail::Rules>;

}  // namespace gnomon::cache

#include <gnomon/cache/detail/cached_map.hpp>
