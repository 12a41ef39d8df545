#pragma once
// The world's frames: what happens, what the cache says, what is drawn, and whether it is what had to be.

#include "model.hpp"

namespace cache_model {

template <class Rules>
class World {
public:
    static constexpr int casters = 7;

    World(std::uint64_t sequence, Fault fault, Tally& tally)
        : random_{sequence * 0x2545f4914f6cdd1dULL + 1}, fault_(fault), sequence_(sequence), tally_(tally) {
        static constexpr std::int64_t bases[] = {0, 10000 * 64, std::int64_t{1} << 40, -(std::int64_t{1} << 42)};
        base_.x = bases[random_.below(4)];
        base_.y = bases[random_.below(4)];
        base_.z = bases[random_.below(4)];
        volume_ = {base_.x, base_.y, base_.z, 8, 8, 24};
        crowded_ = random_.one_in(8);
        for (Caster& c : all_)
            if (!random_.one_in(4)) appear(c);
        garbage();
    }

    void run(int frames) {
        for (int f = 0; f < frames; ++f) {
            bool const last = f + 1 == frames;
            int const events = random_.one_in(3) ? 0 : random_.below(4);
            for (int e = 0; e < events; ++e) object_event(all_[static_cast<std::size_t>(random_.below(casters))]);
            for (Caster& c : all_)
                if (c.record.state == ObjectState::active && random_.one_in(4)) {
                    c.record = cache::advance(c.record, ObjectEvent::rested, 0);
                    happened_ = true;
                }
            if (random_.one_in(2)) move_volume();
            if (random_.one_in(6)) map_event();
            frame(last);
        }
        if (!adds_up(map_.history()) || map_.history().redraws != redraws_ || map_.history().postponed != postponed_) ++tally_.wrong_books;
        tally_.add(map_.history());
    }

private:
    void garbage() {
        for (auto& c : c_.code) c = random_.within(0, 9);
        for (auto& c : w_.code) c = random_.within(0, 9);
    }
    void place(Caster& c) {
        // crowded: most of them lie before each other
        std::int64_t const x = volume_.x + (crowded_ ? random_.within(0, 2) : random_.within(-10, 14));
        std::int64_t const y = volume_.y + (crowded_ ? random_.within(0, 2) : random_.within(-10, 14));
        std::int64_t const z = volume_.z + random_.within(-16, 34);
        int const wide = random_.within(1, 8);
        int const high = random_.within(1, 8);
        int const deep = random_.within(0, 12);
        c.box = {x, y, z, x + wide, y + high, z + deep};
    }
    void appear(Caster& c) {
        if (!c.there || random_.one_in(2)) place(c);
        c.there = true;
        c.seed = random_.next();
        tell(c, ObjectEvent::appeared, Fault::object_replaced_untold);
        if (random_.one_in(2)) c.record = cache::advance(c.record, ObjectEvent::rested, 0);
    }
    /// Tells the object's record, unless forgetting that is the fault.
    void tell(Caster& c, ObjectEvent event, Fault untold) {
        happened_ = true;
        if (fault_ != untold || c.record.state == ObjectState::absent) c.record = cache::advance(c.record, event, 0);
    }
    void object_event(Caster& c) {
        switch (random_.below(12)) {
            case 0: appear(c); break;
            case 1:
                if (random_.one_in(2)) c.seed = random_.next();  // turned within its box
                else c.box = {c.box.x0 + 1, c.box.y0, c.box.z0 - 1, c.box.x1 + 1, c.box.y1, c.box.z1 - 1};
                tell(c, ObjectEvent::moved, Fault::object_moved_untold);
                break;
            case 2:
                if (random_.one_in(2)) place(c);
                c.seed = random_.next();
                tell(c, ObjectEvent::teleported, Fault::object_teleported_untold);
                break;
            case 3: change(c, ObjectEvent::deformed, Fault::object_deformed_untold); break;
            case 4: change(c, ObjectEvent::material_changed, Fault::object_material_untold); break;
            case 5: change(c, ObjectEvent::alpha_changed, Fault::object_alpha_untold); break;
            case 6: change(c, ObjectEvent::lod_switched, Fault::object_lod_untold); break;
            case 7: change(c, ObjectEvent::layers_changed, Fault::object_layers_untold); break;
            case 8:
                c.there = false;
                tell(c, ObjectEvent::hidden, Fault::object_hidden_untold);
                break;
            case 9:
                c.there |= c.record.state == ObjectState::hidden;
                tell(c, ObjectEvent::shown, Fault::object_shown_untold);
                break;
            case 10:
                c.there = false;
                tell(c, ObjectEvent::deleted, Fault::object_deleted_untold);
                break;
            case 11:  // a box that moves and no event: boxes are compared too
                if (c.record.state == ObjectState::static_) {
                    place(c);
                    happened_ = true;
                }
                break;
            default: break;
        }
    }
    void change(Caster& c, ObjectEvent event, Fault untold) {
        c.seed = random_.next();
        tell(c, event, untold);
    }
    void move_volume() {
        Volume const old = volume_;
        int const kind = random_.below(12);
        auto const sign = [this] { return random_.one_in(2) ? 1 : -1; };
        if (kind < 6) {
            volume_.x += random_.within(-2, 2);
            volume_.y += random_.within(-2, 2);
            volume_.z += random_.one_in(2) ? 0 : random_.within(-6, 6);
        } else if (kind == 6) {
            volume_.x += sign() * volume_.width;  // exactly one map: seems not to have moved where sizes wrap
        } else if (kind == 7) {
            volume_.y += sign() * volume_.height;
        } else if (kind == 8) {
            volume_.z += sign() * random_.within(10, 40);
        } else if (kind == 9) {
            volume_.x += sign() * (volume_.width - 1);
        } else if (kind == 10 && random_.one_in(3)) {
            volume_.x = base_.x, volume_.y = base_.y, volume_.z = base_.z;
        } else {
            volume_.y += random_.within(-9, 9);
        }
        happened_ |= !(old == volume_);
    }
    void tell_light(MapEvent event) {
        ++epoch_;  // every image is another one
        happened_ = true;
        map_.notify(event);
    }
    void map_event() {
        switch (random_.below(14)) {
            case 0: tell_light(MapEvent::light_posed); break;
            case 1: tell_light(MapEvent::light_range); break;
            case 2: tell_light(MapEvent::light_cone); break;
            case 3: tell_light(MapEvent::projection_changed); break;
            case 4: tell_light(MapEvent::settings_changed); break;
            case 5: tell_light(MapEvent::redraw_requested); break;
            case 6:
                volume_.width = volume_.width == 8 ? 6 : 8;  // found without being told
                happened_ = true;
                break;
            case 7:
                volume_.far_code = volume_.far_code == 24 ? 20 : 24;
                happened_ = true;
                break;
            case 8:
                garbage();
                happened_ = true;
                map_.notify(MapEvent::content_lost);
                break;
            case 9:
                map_.notify(MapEvent::evicted);
                garbage();
                happened_ = true;
                if (random_.one_in(2)) {
                    if (map_.plan(volume_, {}).action != MapAction::none) ++tally_.wrong_books;
                    map_.commit();
                }
                map_.notify(MapEvent::requested);
                if (map_.plan(volume_, {}).action != MapAction::place) ++tally_.wrong_books;
                map_.notify(MapEvent::granted);
                break;
            case 10: map_.notify(MapEvent::origin_rebased); break;
            case 11: map_.notify(MapEvent::view_set_changed); break;
            case 12: map_.notify(MapEvent::moved_with_content); break;
            case 13:  // another place, at once
                map_.notify(MapEvent::granted);
                garbage();
                happened_ = true;
                break;
            default: break;
        }
    }

    void list_objects() {
        objects_.clear();
        for (std::uint32_t i = 0; i < casters; ++i) {
            Caster const& c = all_[i];
            if (c.record.state == ObjectState::absent) continue;
            // of those that do not touch the volume the cache has to know nothing
            bool const aside = c.box.x1 <= volume_.x || c.box.y1 <= volume_.y || c.box.x0 >= volume_.x + volume_.width ||
                               c.box.y0 >= volume_.y + volume_.height || c.box.z0 >= volume_.z + volume_.far_code;
            if (aside && random_.one_in(2)) continue;
            if (c.record.state == ObjectState::hidden && random_.one_in(2)) continue;
            objects_.push_back(make_object(cache::ObjectId{i}, c.record, c.box));
        }
    }
    Caster const& caster(std::uint32_t place) const { return all_[objects_[place].id.index()]; }

    bool is_hidden(Caster const& c) const {
        Image const& front = fault_ == Fault::active_occluders ? truth_w_ : truth_c_;
        bool hidden = true;
        for_texels(c, epoch_, volume_, [&](std::int64_t i, std::int64_t j, std::int64_t code) {
            hidden &= code > front.at(i, j) || code == volume_.far_code;
        });
        return hidden;
    }

    void frame(bool last) {
        ++tally_.frames;
        list_objects();
        truth_c_.clear(volume_);
        for (Caster const& c : all_)
            if (c.record.state == ObjectState::static_) draw(truth_c_, c, epoch_);
        truth_w_ = truth_c_;
        for (Caster const& c : all_) draw(truth_w_, c, epoch_);
        bool const occlusion = crowded_ || random_.one_in(2);
        bool const was_valid = map_.state() == MapState::valid;
        auto const occluded = [&](std::uint32_t i) { return occlusion && is_hidden(caster(i)); };
        cache::Plan const& plan = map_.plan(volume_, objects_, occluded);
        check_books(plan);
        if (was_valid && !happened_ && !occlusion && !occluded_before_ && plan.action != MapAction::none) ++tally_.needless;
        if (!last && random_.one_in(8)) {
            ++tally_.postponed;
            ++postponed_;
            map_.postpone();
            return;
        }
        bool const in_part = !last && !plan.statics.empty() && random_.one_in(crowded_ ? 2 : 4);
        std::size_t const count = in_part ? static_cast<std::size_t>(random_.below(static_cast<int>(plan.statics.size()))) : plan.statics.size();
        perform(plan, count);
        redraws_ += plan.action == MapAction::redraw ? 1U : 0U;
        if (in_part) map_.commit_part(count);
        else map_.commit();
        happened_ = false;
        occluded_before_ = occlusion;
        compare();
    }

    void perform(cache::Plan const& plan, std::size_t count) {
        if (plan.action == MapAction::redraw) c_.clear(volume_);
        if (plan.action == MapAction::scroll) c_ = scrolled(c_, volume_, plan.shift, fault_);
        for (std::size_t k = 0; k < count; ++k) draw(c_, caster(plan.statics[k]), epoch_);
        if (plan.compose != cache::Compose::keep) copy_texels(w_, c_, plan.copied);
        for (std::uint32_t const i : plan.actives) draw(w_, caster(i), epoch_);
    }

    void check_books(cache::Plan const& plan) {
        auto const& c = plan.counts;
        bool good = c.objects == objects_.size() && c.objects == c.not_casting + c.outside + c.occluded + c.statics + c.actives;
        good &= plan.actives.size() == c.actives;
        good &= plan.statics.size() == (plan.action == MapAction::redraw ? c.statics : c.joined + c.uncovered + c.owed);
        good &= (plan.action == MapAction::none) == (plan.reason == cache::Reason::none);
        good &= (plan.action == MapAction::redraw) == cache::is_redraw(plan.reason);
        if (!good) ++tally_.wrong_books;
    }

    void compare() {
        bool const valid = map_.state() == MapState::valid;
        ++(valid ? tally_.compared : tally_.partial);
        auto const whole = map_.complete_rect();
        bool wrong_c = false;
        bool wrong_w = false;
        for (std::int64_t j = 0; j < volume_.height; ++j)
            for (std::int64_t i = 0; i < volume_.width; ++i) {
                bool const due = valid || cache::contains(whole, {volume_.x + i, volume_.y + j, volume_.x + i + 1, volume_.y + j + 1});
                // what is missing may be farther than the truth, never nearer
                wrong_c |= due ? c_.at(i, j) != truth_c_.at(i, j) : c_.at(i, j) < truth_c_.at(i, j);
                wrong_w |= due ? w_.at(i, j) != truth_w_.at(i, j) : w_.at(i, j) < truth_w_.at(i, j);
            }
        if (valid && !(whole == cache::rect_of(volume_))) ++tally_.wrong_books;
        if (wrong_c) ++(valid ? tally_.wrong_c : tally_.wrong_part);
        if (wrong_w) ++(valid ? tally_.wrong_w : tally_.wrong_part);
        if ((wrong_c || wrong_w) && tally_.first_wrong == ~std::uint64_t{0}) tally_.first_wrong = sequence_;
    }

    Random random_;
    Fault fault_;
    std::uint64_t sequence_;
    Tally& tally_;
    Volume base_{};
    std::uint64_t epoch_ = 0;
    Volume volume_{};
    std::array<Caster, casters> all_{};
    std::vector<Object> objects_;
    cache::BasicCachedMap<Rules> map_{};
    Image c_{}, w_{}, truth_c_{}, truth_w_{};
    std::uint64_t redraws_ = 0;
    std::uint64_t postponed_ = 0;
    bool crowded_ = false;
    bool happened_ = true;
    bool occluded_before_ = true;
};

}  // namespace cache_model
