#pragma once
// The rules of a cached map, each of which can be broken: what the model finds wrong then shows that it is looked at.

#include <gnomon/cache/cached_map.hpp>

#include <algorithm>
#include <cstdint>

namespace cache_model {

using namespace gnomon;
using cache::Box;
using cache::MapAction;
using cache::MapEvent;
using cache::MapState;
using cache::Object;
using cache::ObjectEvent;
using cache::ObjectState;
using cache::Volume;

/// The rules that can be broken, one at a time. Those of `cache` itself, and those that its caller has to keep.
enum class Fault : std::uint8_t {
    none,
    printed_difference,  // dS = S - S'
    strip_aside,         // the parts of the corrected one
    strip_nearer,
    strip_farther,
    query_ends_at_near,
    kept_ends_at_near,
    placement_of_this_frame,
    deleted_member,
    active_member,
    revision_of_member,
    box_of_member,
    wrapped_shift,
    part_is_whole,
    part_is_remembered_as_whole,
    forgets_hidden_members,
    postponed_is_done,
    resolution_ignored,
    granted_ignored,
    content_lost_ignored,
    light_posed_ignored,
    light_range_ignored,
    light_cone_ignored,
    projection_ignored,
    settings_ignored,
    request_ignored,
    // of the caller
    active_occluders,
    far_is_moved,
    near_is_not_clamped,
    object_moved_untold,
    object_teleported_untold,
    object_deformed_untold,
    object_material_untold,
    object_alpha_untold,
    object_lod_untold,
    object_layers_untold,
    object_hidden_untold,
    object_shown_untold,
    object_deleted_untold,
    object_replaced_untold,
    end
};

/// The rules with one fault.
struct Faulty : cache::detail::Rules {
    using Rules = cache::detail::Rules;
    static inline Fault fault = Fault::none;
    static inline bool remembers_owed = true;
    static inline bool keeps_ghosts = true;

    static void set(Fault f) {
        fault = f;
        remembers_owed = f != Fault::part_is_remembered_as_whole;
        keeps_ghosts = f != Fault::forgets_hidden_members;
    }
    static bool in_volume(Box const& box, Volume const& v) {
        return Rules::in_volume(box, v) && (fault != Fault::query_ends_at_near || box.z1 >= v.z);
    }
    static bool uncovered(Box box, Volume const& before, Volume const& now) {
        if (fault == Fault::printed_difference) return false;
        auto const inside = cache::intersection(cache::rect_of(box), cache::rect_of(before));
        if (fault == Fault::strip_aside) box = {inside.x0, inside.y0, box.z0, inside.x1, inside.y1, box.z1};
        if (fault == Fault::strip_nearer) box.z0 = std::max(box.z0, before.z);
        if (fault == Fault::strip_farther) box.z1 = std::min(box.z1, before.z + before.far_code - 1);
        return Rules::uncovered(box, before, now);
    }
    static bool in_kept(cache::detail::Member m, Object const* o, Volume const& before, Volume const& now) {
        if (fault == Fault::placement_of_this_frame && o != nullptr) m.box = o->box;
        if (fault == Fault::kept_ends_at_near && m.box.z1 < std::max(before.z, now.z)) return false;
        return Rules::in_kept(m, o, before, now);
    }
    static bool unchanged(cache::detail::Member const& m, Object const* o) {
        if (fault == Fault::deleted_member && o == nullptr) return true;
        if (o == nullptr) return false;
        Object as_was = *o;
        if (fault == Fault::active_member && o->state == ObjectState::active) as_was = {m.id, m.revision, ObjectState::static_, o->cause, m.box};
        if (fault == Fault::revision_of_member) as_was.revision = m.revision;
        if (fault == Fault::box_of_member) as_was.box = m.box;
        return Rules::unchanged(m, &as_was);
    }
    static cache::Shift shift(Volume const& before, Volume const& now) {
        auto s = Rules::shift(before, now);
        if (fault == Fault::wrapped_shift) s = {s.x % now.width, s.y % now.height, s.z};
        return s;
    }
    static bool jumped(Volume const& before, Volume const& now) {
        if (fault == Fault::wrapped_shift) return false;
        return Rules::jumped(before, now);
    }
    static cache::MapStep step(MapState state, MapEvent event) {
        bool const done = fault == Fault::postponed_is_done && event == MapEvent::postponed;
        bool const whole = fault == Fault::part_is_whole && event == MapEvent::drawn_partly;
        if (done || whole) return Rules::step(state, MapEvent::drawn_wholly);
        bool const ignored = (fault == Fault::content_lost_ignored && event == MapEvent::content_lost) ||
                             (fault == Fault::granted_ignored && event == MapEvent::granted) ||
                             (fault == Fault::light_posed_ignored && event == MapEvent::light_posed) ||
                             (fault == Fault::light_range_ignored && event == MapEvent::light_range) ||
                             (fault == Fault::light_cone_ignored && event == MapEvent::light_cone) ||
                             (fault == Fault::projection_ignored && event == MapEvent::projection_changed) ||
                             (fault == Fault::resolution_ignored && event == MapEvent::resolution_changed) ||
                             (fault == Fault::settings_ignored && event == MapEvent::settings_changed) ||
                             (fault == Fault::request_ignored && event == MapEvent::redraw_requested);
        return ignored ? Rules::step(state, MapEvent::view_set_changed) : Rules::step(state, event);
    }
};

}  // namespace cache_model
