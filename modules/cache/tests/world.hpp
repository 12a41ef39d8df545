#pragma once
// The world's frames: what happens, what the cache says, what is drawn, and whether it is what had to be.

#include "actors.hpp"

#include <optional>

namespace cache_model {

template <class Rules>
class World {
public:
    World(std::uint64_t sequence, Fault fault, Tally& tally)
        : actors_(sequence, fault), fault_(fault), sequence_(sequence), tally_(tally) {
        garbage();
    }

    void run(int frames) {
        for (int f = 0; f < frames; ++f) {
            actors_.happen();
            if (random_.one_in(actors_.crowded ? 40 : 6)) map_event();
            frame(f + 1 == frames);
        }
        if (!adds_up(map_.history()) || map_.history().redraws != redraws_ || map_.history().postponed != postponed_) ++tally_.wrong_books;
        tally_.add(map_.history());
    }

private:
    void garbage() {
        for (auto& c : c_.code) c = random_.within(0, 9);
        for (auto& c : w_.code) c = random_.within(0, 9);
    }
    void tell_light(MapEvent event) {
        ++epoch_;  // every image is another one
        actors_.happened = true;
        map_.notify(event);
    }
    /// A map that scrolls finds it without being told.
    void shape_changed(MapEvent event) {
        actors_.happened = true;
        if (actors_.stays) map_.notify(event);
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
                (random_.one_in(2) ? volume_.width : volume_.height) = random_.one_in(2) ? 6 : 8;
                shape_changed(MapEvent::resolution_changed);
                break;
            case 7:
                volume_.far_code = volume_.far_code == 24 ? 20 : 24;
                shape_changed(MapEvent::light_range);
                break;
            case 8:
                garbage();
                actors_.happened = true;
                map_.notify(MapEvent::content_lost);
                break;
            case 9:
                map_.notify(MapEvent::evicted);
                garbage();
                actors_.happened = true;
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
                actors_.happened = true;
                break;
            default: break;
        }
    }

    void list_objects() {
        objects_.clear();
        for (std::uint32_t i = 0; i < Actors::count; ++i) {
            Caster const& c = actors_.all[i];
            if (c.record.state == ObjectState::absent) continue;
            // of those that do not touch the volume the cache has to know nothing
            bool const aside = c.box.x1 <= volume_.x || c.box.y1 <= volume_.y || c.box.x0 >= volume_.x + volume_.width ||
                               c.box.y0 >= volume_.y + volume_.height || c.box.z0 >= volume_.z + volume_.far_code;
            if (aside && random_.one_in(2)) continue;
            if (c.record.state == ObjectState::hidden && random_.one_in(2)) continue;
            objects_.push_back(make_object(cache::ObjectId{i}, c.record, actors_.stays ? Box{} : c.box));
        }
    }
    Caster const& caster(std::uint32_t place) const { return actors_.all[objects_[place].id.index()]; }

    bool is_hidden(Caster const& c) const {
        Image const& front = fault_ == Fault::active_occluders ? truth_w_ : truth_c_;
        bool hidden = true;
        for_texels(c, epoch_, volume_, [&](std::int64_t i, std::int64_t j, std::int64_t code, bool) {
            hidden &= code > front.at(i, j) || code == volume_.far_code;
        });
        return hidden;
    }

    void frame(bool last) {
        ++tally_.frames;
        list_objects();
        truth_c_.clear(volume_);
        for (Caster const& c : actors_.all)
            if (c.record.state == ObjectState::static_) draw(truth_c_, c, epoch_);
        truth_w_ = truth_c_;
        for (Caster const& c : actors_.all) draw(truth_w_, c, epoch_);
        bool const occlusion = actors_.crowded || random_.one_in(2);
        bool const was_valid = map_.state() == MapState::valid;
        auto const occluded = [&](std::uint32_t i) { return occlusion && is_hidden(caster(i)); };
        cache::Plan const& plan = actors_.stays ? map_.plan_fixed(objects_, touched(), occluded) : map_.plan(volume_, objects_, occluded);
        check_books(plan);
        if (was_valid && !actors_.happened && !occlusion && !occluded_before_ && plan.action != MapAction::none) ++tally_.needless;
        if (!last && random_.one_in(8)) {
            ++tally_.postponed;
            ++postponed_;
            map_.postpone();
            return;
        }
        bool const in_part = !last && !plan.statics.empty() && random_.one_in(actors_.crowded ? 2 : 4);
        std::size_t const count = in_part ? static_cast<std::size_t>(random_.below(static_cast<int>(plan.statics.size()))) : plan.statics.size();
        redraws_ += plan.action == MapAction::redraw ? 1U : 0U;
        if (in_part && !actors_.stays && random_.one_in(2)) return frame_of_rect(plan, occlusion);
        perform(plan, count);
        if (in_part) map_.commit_part(count);
        else map_.commit();
        actors_.happened = false;
        occluded_before_ = occlusion;
        compare();
    }

    /// All casters, but to a half or to any rectangle only.
    void frame_of_rect(cache::Plan const& plan, bool occlusion) {
        cache::TexelRect done = cache::rect_of(volume_);
        switch (random_.below(5)) {
            case 0: done.x1 = done.x0 + 4; break;
            case 1: done.x0 += 4; break;
            case 2: done.y0 += 4; break;
            case 3: done.y1 = done.y0 + 4; break;
            default: {
                std::int64_t const x = random_.within(-1, 4);
                std::int64_t const y = random_.within(-1, 4);
                int const wide = random_.within(0, 9);
                int const high = random_.within(0, 9);
                done = {done.x0 + x, done.y0 + y, done.x0 + x + wide, done.y0 + y + high};
                break;
            }
        }
        perform(plan, plan.statics.size(), done);
        map_.commit_rect(done);
        actors_.happened = false;
        occluded_before_ = occlusion;
        compare();
    }

    /// What a map that stays is told, by looking at all texels.
    auto touched() const {
        return [this](std::uint32_t i) {
            Caster c = caster(i);
            c.there = true;
            bool writes = false;
            for_texels(c, epoch_, volume_, [&](auto, auto, std::int64_t code, bool) { writes |= code < volume_.far_code; });
            return writes;
        };
    }

    void perform(cache::Plan const& plan, std::size_t count, std::optional<cache::TexelRect> const& only = {}) {
        if (plan.action == MapAction::redraw) c_.clear(volume_);
        if (plan.action == MapAction::scroll) c_ = scrolled(c_, volume_, plan.shift, fault_);
        for (std::size_t k = 0; k < count; ++k) {
            Image const before = c_;
            draw(c_, caster(plan.statics[k]), epoch_, only.value_or(cache::rect_of(volume_)));
            if (plan.beside[k] != 0) restore_shown(c_, before, plan.shift);
        }
        if (plan.compose != cache::Compose::keep) copy_texels(w_, c_, actors_.stays ? cache::rect_of(volume_) : plan.copied);
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
                bool const due = valid || (!actors_.stays && cache::contains(whole, {volume_.x + i, volume_.y + j, volume_.x + i + 1, volume_.y + j + 1}));
                // what is missing may be farther than the truth, never nearer
                wrong_c |= due ? c_.at(i, j) != truth_c_.at(i, j) : c_.at(i, j) < truth_c_.at(i, j);
                wrong_w |= due ? w_.at(i, j) != truth_w_.at(i, j) : w_.at(i, j) < truth_w_.at(i, j);
            }
        if (valid && !actors_.stays && !(whole == cache::rect_of(volume_))) ++tally_.wrong_books;
        if (valid && sequence_ % 8 == 0) compare_with_clipped();
        if (wrong_c) ++(valid ? tally_.wrong_c : tally_.wrong_part);
        if (wrong_w) ++(valid ? tally_.wrong_w : tally_.wrong_part);
        if ((wrong_c || wrong_w) && tally_.first_wrong == ~std::uint64_t{0}) tally_.first_wrong = sequence_;
    }

    /// The one difference from a redraw that clips at the near plane is code 0 where that one looks behind the clipped.
    void compare_with_clipped() {
        Image clipped;
        clipped.clear(volume_);
        for (Caster const& c : actors_.all)
            if (c.record.state == ObjectState::static_)
                for_texels(c, epoch_, volume_, [&](std::int64_t i, std::int64_t j, std::int64_t code, bool before) {
                    if (!before) clipped.at(i, j) = std::min(clipped.at(i, j), static_cast<std::int32_t>(code));
                });
        for (std::size_t k = 0; k < clipped.code.size(); ++k)
            if (c_.code[k] != clipped.code[k]) ++(c_.code[k] == 0 ? tally_.near_clamped : tally_.wrong_near);
    }

    Actors actors_;
    Random& random_ = actors_.random;
    Volume& volume_ = actors_.volume;
    Fault fault_;
    std::uint64_t sequence_;
    Tally& tally_;
    std::uint64_t epoch_ = 0;
    std::vector<Object> objects_;
    cache::BasicCachedMap<Rules> map_{};
    Image c_{}, w_{}, truth_c_{}, truth_w_{};
    std::uint64_t redraws_ = 0;
    std::uint64_t postponed_ = 0;
    bool occluded_before_ = true;
};

}  // namespace cache_model
