#pragma once
// The records of all objects of a scene, and which of them wait to come to rest.

#include <gnomon/cache/object.hpp>
#include <gnomon/core/contract.hpp>

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace gnomon::cache {

/// One record per object, by id. Events cost O(1), a frame costs O(active objects).
class ObjectTable {
public:
    explicit ObjectTable(RestConfig const& config = {}) noexcept : config_(config) {}

    /// Room for ids up to `count` - 1, absent until they appear. Records are never taken away: their revisions must go on.
    void grow(std::size_t count, Mobility mobility = Mobility::automatic) {
        if (count <= records_.size()) return;
        records_.resize(count, ObjectRecord{.mobility = mobility});
        waits_.resize(count, 0);
        waiting_.reserve(count);
    }
    /// How soon this object may rest, from now on.
    void set_mobility(ObjectId id, Mobility mobility) noexcept {
        if (holds(id)) records_[id.index()].mobility = mobility;
    }
    /// Tells what happened to an object at tick `now`.
    ///
    /// expects: `grow` has made room for the id.
    /// returns: whether its image changed.
    bool apply(ObjectId id, ObjectEvent event, std::uint64_t now) noexcept {
        if (!holds(id)) return false;
        ObjectRecord& r = records_[id.index()];
        std::uint32_t const revision = r.revision;
        r = advance(r, event, now);
        if (r.state == ObjectState::active && waits_[id.index()] == 0) {
            waits_[id.index()] = 1;
            waiting_.push_back(id);
        }
        return r.revision != revision;
    }
    /// Lets rest what has been still for long enough; once a frame, after its events.
    ///
    /// returns: how many objects became static.
    std::size_t settle(std::uint64_t now) noexcept {
        std::size_t rested = 0;
        std::size_t kept = 0;
        for (ObjectId const id : waiting_) {
            ObjectRecord& r = records_[id.index()];
            bool const was_active = r.state == ObjectState::active;
            r = cache::settle(r, config_, now);
            if (r.state == ObjectState::active) {
                waiting_[kept++] = id;
            } else {
                waits_[id.index()] = 0;
                rested += was_active ? 1U : 0U;
            }
        }
        waiting_.resize(kept);
        return rested;
    }

    /// expects: `grow` has made room for the id.
    [[nodiscard]] ObjectRecord operator[](ObjectId id) const noexcept {
        return holds(id) ? records_[id.index()] : ObjectRecord{};
    }
    [[nodiscard]] std::span<ObjectRecord const> records() const noexcept { return records_; }
    /// Objects that are active, and some that were until the next `settle`.
    [[nodiscard]] std::size_t waiting() const noexcept { return waiting_.size(); }

private:
    [[nodiscard]] bool holds(ObjectId id) const noexcept {
        GNOMON_EXPECT(id.index() < records_.size());
        return id.index() < records_.size();
    }

    RestConfig config_;
    std::vector<ObjectRecord> records_;  ///< 24 bytes each.
    std::vector<std::uint8_t> waits_;    ///< Is it in `waiting_`?
    std::vector<ObjectId> waiting_;      ///< Active objects, in the order of their events.
};

}  // namespace gnomon::cache
