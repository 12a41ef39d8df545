#pragma once
// The parts of BasicCachedMap that are longer than a line. Included by cached_map.hpp.

#include <gnomon/cache/cached_map.hpp>

#include <algorithm>

namespace gnomon::cache {

template <class Rules>
MapAction BasicCachedMap<Rules>::notify(MapEvent event) noexcept {
    MapStep const done = Rules::step(state_, event);
    Reason const reason = detail::reason_of(event);
    bool const emptied = reason == Reason::first_use || reason == Reason::content_lost;
    if (emptied || (shows(state_) && done.next == MapState::invalid)) {
        blame_ = reason;
        blamed_ = {};
    }
    if (done.next != state_ || reason != Reason::none) has_plan_ = false;
    state_ = done.next;
    return done.action;
}

template <class Rules>
void BasicCachedMap<Rules>::suppose(MapEvent event, Reason reason, ObjectId culprit) noexcept {
    MapState const next = Rules::step(planned_, event).next;
    if (shows(planned_) && next == MapState::invalid) {
        plan_.reason = reason;
        plan_.culprit = culprit;
    }
    planned_ = next;
}

template <class Rules>
template <class Query, class Occluded>
Plan const& BasicCachedMap<Rules>::make_plan(Query const& query, std::span<Object const> objects,
                                             Occluded const& occluded) {
    GNOMON_EXPECT(detail::ids_ascend(objects));
    plan_ = {};
    plan_.volume = query.now;
    planned_ = state_;
    planned_fixed_ = Query::fixed;
    has_plan_ = true;
    statics_.clear();
    beside_.clear();
    actives_.clear();
    next_.clear();
    if (!has_memory()) {
        plan_.action = detail::due_in(state_);
        return plan_;
    }
    if (shows(planned_)) {
        auto const change = fixed_ == Query::fixed ? query.change() : MapEvent::projection_changed;
        if (change) suppose(*change, detail::reason_of(*change));
    } else {
        plan_.reason = blame_;
        plan_.culprit = blamed_;
    }
    if (shows(planned_)) check_members(query, objects);
    gather(query, objects, occluded);
    if (shows(planned_) && !Query::fixed) {
        plan_.before = query.before;
        plan_.shift = Rules::shift(query.before, query.now);
    }
    decide(query.moved());
    compose(objects);
    return plan_;
}

template <class Rules>
template <class Query>
void BasicCachedMap<Rules>::check_members(Query const& query, std::span<Object const> objects) {
    detail::Seeker seeker(objects);
    for (Member const& m : members_) {
        Object const* const o = seeker.find(m.id);
        ++plan_.counts.members;
        if (!m.drawn || query.unchanged(m, o)) continue;
        if (!query.keeps(m, o)) ++plan_.counts.left;
        else suppose(MapEvent::member_changed, o != nullptr ? reason_of(o->cause) : Reason::member_missing, m.id);
    }
}

template <class Rules>
template <class Query, class Occluded>
void BasicCachedMap<Rules>::gather(Query const& query, std::span<Object const> objects, Occluded const& occluded) {
    bool const keeps = shows(planned_);
    PlanCounts& counts = plan_.counts;
    std::size_t at = 0;
    counts.objects = objects.size();
    for (std::uint32_t i = 0; i < objects.size(); ++i) {
        Object const& o = objects[i];
        bool const is_static = o.state == ObjectState::static_;
        while (at < members_.size() && members_[at].id < o.id) ++at;
        bool const known = keeps && at < members_.size() && members_[at].id == o.id && query.unchanged(members_[at], &o);
        Member const* const member = known ? &members_[at] : nullptr;
        if (!is_static && o.state != ObjectState::active) {
            ++counts.not_casting;
        } else if (!query.touches(o, i)) {
            ++counts.outside;
        } else if (occluded(i)) {
            ++counts.occluded;
            if (member == nullptr || !member->drawn || !Rules::keeps_ghosts) continue;
            next_.push_back(*member);
            next_.back().owed = next_.back().ghost = true;
        } else if (is_static) {
            ++counts.statics;
            add_static(query, i, o, member);
        } else {
            ++counts.actives;
            actives_.push_back(i);
        }
    }
}

template <class Rules>
template <class Query>
void BasicCachedMap<Rules>::add_static(Query const& query, std::uint32_t i, Object const& object,
                                       Member const* member) {
    Member next{.id = object.id, .revision = object.revision, .box = object.box};
    next.drawn = member != nullptr && member->drawn;
    next.intact = next.drawn && query.depths_kept(object.box);
    bool const owed = member != nullptr && member->owed;
    bool const uncovered = member != nullptr && query.moved() && query.uncovers(object.box);
    next.owed = member == nullptr || owed || uncovered;
    if (owed) ++plan_.counts.owed;
    else if (member == nullptr) ++plan_.counts.joined;
    else if (uncovered) ++plan_.counts.uncovered;
    next_.push_back(next);
    if (!next.owed) return;
    statics_.push_back(i);
    beside_.push_back(next.intact && !owed ? 1 : 0);
}

template <class Rules>
void BasicCachedMap<Rules>::decide(bool moved) noexcept {
    bool const keeps = shows(planned_);
    plan_.statics = statics_;
    plan_.beside = beside_;
    plan_.actives = actives_;
    plan_.action = keeps ? MapAction::none : MapAction::redraw;
    if (keeps && !statics_.empty()) {
        planned_ = Rules::step(planned_, MapEvent::member_joined).next;
        plan_.action = MapAction::add;
        plan_.reason = plan_.counts.joined > 0 ? Reason::member_joined : Reason::part_owed;
    }
    if (keeps && moved) {
        planned_ = Rules::step(planned_, MapEvent::volume_moved).next;
        plan_.action = MapAction::scroll;
        plan_.reason = Reason::volume_moved;
    }
}

template <class Rules>
void BasicCachedMap<Rules>::compose(std::span<Object const> objects) noexcept {
    TexelRect const all = rect_of(plan_.volume);
    auto const bounds = [&](std::span<std::uint32_t const> list) {
        TexelRect rect{};
        for (std::uint32_t const i : list) rect = merged(rect, intersection(rect_of(objects[i].box), all));
        return rect;
    };
    bool const stays = plan_.action == MapAction::none || plan_.action == MapAction::add;
    plan_.copied = stays ? merged(w_differs_, bounds(statics_)) : all;
    w_will_differ_ = bounds(actives_);
    if (!actives_.empty()) plan_.compose = Compose::copy_and_draw;
    else if (plan_.action != MapAction::none || w_has_actives_) plan_.compose = Compose::copy;
}

template <class Rules>
bool BasicCachedMap<Rules>::take_plan() noexcept {
    GNOMON_EXPECT(has_plan_);
    bool const due = has_plan_ && has_memory();
    has_plan_ = false;
    return due;
}

template <class Rules>
void BasicCachedMap<Rules>::commit_part(std::size_t drawn) {
    GNOMON_EXPECT(drawn <= plan_.statics.size());
    if (!take_plan()) return;
    bool const whole = drawn >= plan_.statics.size();
    TexelRect const all = rect_of(plan_.volume);
    complete_ = whole || plan_.action == MapAction::redraw ? all : intersection(complete_, all);
    std::size_t count = 0;
    for (Member& m : next_) {
        if (!m.owed || m.ghost) continue;
        if (count++ < drawn || !Rules::remembers_owed) {
            m.drawn = true;
            m.owed = false;
        } else if (!m.intact) {
            complete_ = detail::without(complete_, rect_of(m.box));
        }
    }
    finish(whole);
}

template <class Rules>
void BasicCachedMap<Rules>::commit_rect(TexelRect const& done) {
    TexelRect const all = rect_of(plan_.volume);
    TexelRect const here = intersection(done, all);
    if (plan_.statics.empty() || contains(here, all)) return commit();
    if (planned_fixed_ || is_empty(here)) return commit_part(0);
    if (!take_plan()) return;
    TexelRect kept = plan_.action == MapAction::redraw ? all : intersection(complete_, all);
    for (Member const& m : next_)
        if (m.owed && !m.ghost && !m.intact) kept = detail::without(kept, rect_of(m.box));
    complete_ = detail::largest_in_both(kept, here);
    for (Member& m : next_) {
        if (!m.owed || m.ghost) continue;
        TexelRect const seen = intersection(rect_of(m.box), all);
        m.drawn = m.drawn || !is_empty(intersection(seen, here));
        m.owed = Rules::remembers_owed && !contains(complete_, seen);
    }
    finish(contains(complete_, all));
}

template <class Rules>
void BasicCachedMap<Rules>::finish(bool whole) {
    if (whole) next_.erase(std::remove_if(next_.begin(), next_.end(), [](Member const& m) { return m.ghost; }), next_.end());
    members_.swap(next_);
    next_.clear();
    state_ = Rules::step(planned_, whole ? MapEvent::drawn_wholly : MapEvent::drawn_partly).next;
    volume_ = plan_.volume;
    fixed_ = planned_fixed_;
    w_differs_ = w_will_differ_;
    w_has_actives_ = !plan_.actives.empty();
    stale_ = whole ? 0 : stale_ + 1;
    count_commit();
}

template <class Rules>
void BasicCachedMap<Rules>::count_commit() noexcept {
    switch (plan_.action) {
        case MapAction::redraw: ++history_.redraws; break;
        case MapAction::scroll: ++history_.scrolls; break;
        case MapAction::add: ++history_.additions; break;
        case MapAction::none:
        case MapAction::place:
        case MapAction::release: ++history_.kept; break;
    }
    if (plan_.reason != Reason::none) ++history_.by_reason[static_cast<std::size_t>(plan_.reason)];
}

template <class Rules>
void BasicCachedMap<Rules>::postpone() noexcept {
    if (!take_plan()) return;
    if (plan_.action == MapAction::redraw) {
        state_ = Rules::step(planned_, MapEvent::postponed).next;
        blame_ = plan_.reason;
        blamed_ = plan_.culprit;
    }
    if (plan_.action != MapAction::none || plan_.compose != Compose::keep) ++stale_;
    ++history_.postponed;
}

}  // namespace gnomon::cache
