#pragma once
// A table of things by id, whose ids are never mistaken: one that was erased is unknown for good.

#include <gnomon/core/id.hpp>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

namespace gnomon::backend {

/// Owns `T`s; an id's low 20 bits are its place, the high 12 count how often the place was used.
///
/// A place is used at most 4095 times, then never again, so an old id names nothing rather than something else.
template <class Id, class T>
class Slots {
  public:
    static constexpr std::uint32_t place_bits = 20;
    static constexpr std::uint32_t max_places = (1U << place_bits) - 1;
    static constexpr std::uint32_t max_uses = 4095;

    /// returns: the new id; none when a million things live.
    [[nodiscard]] Id insert(T value) {
        if (free_.empty()) {
            if (slots_.size() >= max_places) return Id::none();
            free_.push_back(static_cast<std::uint32_t>(slots_.size()));
            slots_.emplace_back();
        }
        std::uint32_t const place = free_.back();
        free_.pop_back();
        Slot& slot = slots_[place];
        slot.value.emplace(std::move(value));
        ++live_;
        return Id(slot.uses << place_bits | place);
    }

    /// returns: null for an id that was never given, or was erased.
    [[nodiscard]] T* find(Id id) noexcept {
        std::uint32_t const place = id.value & max_places;
        if (id.is_none() || place >= slots_.size()) return nullptr;
        Slot& slot = slots_[place];
        return slot.value && slot.uses == id.value >> place_bits ? &*slot.value : nullptr;
    }
    [[nodiscard]] T const* find(Id id) const noexcept { return const_cast<Slots*>(this)->find(id); }

    /// returns: whether there was such a thing.
    bool erase(Id id) {
        if (find(id) == nullptr) return false;
        Slot& slot = slots_[id.value & max_places];
        slot.value.reset();
        --live_;
        if (++slot.uses < max_uses) free_.push_back(id.value & max_places);
        return true;
    }

    [[nodiscard]] std::size_t size() const noexcept { return live_; }

    /// Calls `use(T&)` for each that lives, in no order that means anything.
    template <class Use>
    void for_each(Use&& use) {
        for (Slot& slot : slots_)
            if (slot.value) use(*slot.value);
    }

  private:
    struct Slot {
        std::optional<T> value;
        std::uint32_t uses = 0;
    };

    std::vector<Slot> slots_;
    std::vector<std::uint32_t> free_;
    std::size_t live_ = 0;
};

}  // namespace gnomon::backend
