#pragma once
// The two kinds of maps: those whose volume moves by whole units, and those that stay where they are.

#include <gnomon/cache/detail/rules.hpp>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

namespace gnomon::cache::detail {

/// A volume that scrolls, such as a cascade's.
template <class Rules>
struct ScrollQuery {
    Volume before;
    Volume now;

    static constexpr bool fixed = false;
    [[nodiscard]] constexpr bool touches(Object const& o, std::uint32_t) const noexcept {
        return !is_empty(o.box) && Rules::in_volume(o.box, now);
    }
    [[nodiscard]] constexpr bool uncovers(Box const& box) const noexcept { return Rules::uncovered(box, before, now); }
    [[nodiscard]] constexpr bool keeps(Member const& m, Object const* o) const noexcept {
        return Rules::in_kept(m, o, before, now);
    }
    [[nodiscard]] constexpr bool unchanged(Member const& m, Object const* o) const noexcept {
        return Rules::unchanged(m, o);
    }
    [[nodiscard]] constexpr bool moved() const noexcept { return Rules::shift(before, now) != Shift{}; }
    /// Does C show all of the box's depths where it shows its texels?
    [[nodiscard]] constexpr bool depths_kept(Box const& box) const noexcept {
        return box.z0 >= before.z && box.z1 < before.z + before.far_code;
    }
    /// The event that it is to have a volume of which C can show nothing.
    [[nodiscard]] constexpr std::optional<MapEvent> change() const noexcept {
        if (before.width != now.width || before.height != now.height) return MapEvent::resolution_changed;
        if (before.far_code != now.far_code) return MapEvent::light_range;
        if (Rules::jumped(before, now)) return MapEvent::volume_jumped;
        return std::nullopt;
    }
};

/// A local light's map: whatever the caller's test says, in the light's own space.
template <class Rules, class Touches>
struct FixedQuery {
    Touches const& test;
    Volume before{};
    Volume now{};

    static constexpr bool fixed = true;
    [[nodiscard]] bool touches(Object const&, std::uint32_t i) const { return test(i); }
    [[nodiscard]] constexpr bool uncovers(Box const&) const noexcept { return false; }
    [[nodiscard]] constexpr bool keeps(Member const&, Object const*) const noexcept { return true; }
    /// Boxes are of no use here: they may be those of another light, which turns.
    [[nodiscard]] constexpr bool unchanged(Member m, Object const* o) const noexcept {
        if (o != nullptr) m.box = o->box;
        return Rules::unchanged(m, o);
    }
    [[nodiscard]] constexpr bool moved() const noexcept { return false; }
    [[nodiscard]] constexpr bool depths_kept(Box const&) const noexcept { return true; }
    [[nodiscard]] constexpr std::optional<MapEvent> change() const noexcept { return std::nullopt; }
};

/// Walks along objects by ascending ids.
class Seeker {
public:
    explicit constexpr Seeker(std::span<Object const> objects) noexcept : objects_(objects) {}

    /// The object of this id; ids are asked for in ascending order.
    [[nodiscard]] constexpr Object const* find(ObjectId id) noexcept {
        while (at_ < objects_.size() && objects_[at_].id < id) ++at_;
        return at_ < objects_.size() && objects_[at_].id == id ? &objects_[at_] : nullptr;
    }

private:
    std::span<Object const> objects_;
    std::size_t at_ = 0;
};

[[nodiscard]] inline bool ids_ascend(std::span<Object const> objects) noexcept {
    for (std::size_t i = 1; i < objects.size(); ++i)
        if (!(objects[i - 1].id < objects[i].id)) return false;
    return true;
}

}  // namespace gnomon::cache::detail
