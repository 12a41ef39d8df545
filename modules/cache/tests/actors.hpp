#pragma once
// What happens in the model's world: to casters, each told to its record, and to the volume that a map has to show.

#include "model.hpp"

namespace cache_model {

struct Actors {
    static constexpr int count = 7;

    Actors(std::uint64_t sequence, Fault f) : random{sequence * 0x2545f4914f6cdd1dULL + 1}, fault(f) {
        static constexpr std::int64_t bases[] = {0, 10000 * 64, std::int64_t{1} << 40, -(std::int64_t{1} << 42)};
        base.x = bases[random.below(4)];
        base.y = bases[random.below(4)];
        base.z = bases[random.below(4)];
        volume = {base.x, base.y, base.z, 8, 8, 24};
        crowded = random.one_in(8);
        stays = random.one_in(8);
        for (Caster& c : all)
            if (!random.one_in(4)) appear(c);
    }

    void happen() {
        int const events = random.one_in(3) ? 0 : random.below(4);
        for (int e = 0; e < events; ++e) object_event(all[static_cast<std::size_t>(random.below(count))]);
        for (Caster& c : all)
            if (c.record.state == ObjectState::active && random.one_in(4)) {
                c.record = cache::advance(c.record, ObjectEvent::rested, 0);
                happened = true;
            }
        if (random.one_in(2)) move_volume();
    }
    void place(Caster& c) {
        // crowded: most of them lie before each other
        std::int64_t const x = volume.x + (crowded ? random.within(-2, 4) : random.within(-10, 14));
        std::int64_t const y = volume.y + (crowded ? random.within(-2, 4) : random.within(-10, 14));
        std::int64_t const z = volume.z + random.within(-16, 34);
        int const wide = random.within(1, 8);
        int const high = random.within(1, 8);
        int const deep = random.within(0, 12);
        c.box = {x, y, z, x + wide, y + high, z + deep};
    }
    void appear(Caster& c) {
        if (!c.there || random.one_in(2)) place(c);
        c.there = true;
        c.seed = random.next();
        tell(c, ObjectEvent::appeared, Fault::object_replaced_untold);
        if (random.one_in(2)) c.record = cache::advance(c.record, ObjectEvent::rested, 0);
    }
    /// Tells the object's record, unless forgetting that is the fault.
    void tell(Caster& c, ObjectEvent event, Fault untold) {
        happened = true;
        if (fault != untold || c.record.state == ObjectState::absent) c.record = cache::advance(c.record, event, 0);
    }
    void object_event(Caster& c) {
        switch (random.below(12)) {
            case 0: appear(c); break;
            case 1:
                if (random.one_in(2)) c.seed = random.next();  // turned within its box
                else c.box = {c.box.x0 + 1, c.box.y0, c.box.z0 - 1, c.box.x1 + 1, c.box.y1, c.box.z1 - 1};
                tell(c, ObjectEvent::moved, Fault::object_moved_untold);
                break;
            case 2:
                if (random.one_in(2)) place(c);
                c.seed = random.next();
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
                if (c.record.state == ObjectState::static_ && !stays) {
                    place(c);
                    happened = true;
                }
                break;
            default: break;
        }
    }
    void change(Caster& c, ObjectEvent event, Fault untold) {
        c.seed = random.next();
        tell(c, event, untold);
    }
    void move_volume() {
        if (stays) return;
        Volume const old = volume;
        int const kind = crowded ? 0 : random.below(12);
        auto const sign = [this] { return random.one_in(2) ? 1 : -1; };
        if (kind < 6) {
            volume.x += random.within(-2, 2);
            volume.y += random.within(-2, 2);
            volume.z += random.one_in(2) ? 0 : random.within(-6, 6);
        } else if (kind == 6) {
            volume.x += sign() * volume.width;  // exactly one map: seems not to have moved where sizes wrap
        } else if (kind == 7) {
            volume.y += sign() * volume.height;
        } else if (kind == 8) {
            volume.z += sign() * random.within(10, 40);
        } else if (kind == 9) {
            volume.x += sign() * (volume.width - 1);
        } else if (kind == 10 && random.one_in(3)) {
            volume.x = base.x, volume.y = base.y, volume.z = base.z;
        } else {
            volume.y += random.within(-9, 9);
        }
        happened |= !(old == volume);
    }

    Random random;
    Fault fault;
    Volume base{};
    Volume volume{};
    std::array<Caster, count> all{};
    bool crowded = false;  ///< Most casters lie before each other, few images are lost, and many drawn in part.
    bool stays = false;    ///< The volume does, and the map is told what touches it.
    bool happened = true;  ///< Since the last commit.
};

}  // namespace cache_model
