#include <gnomon/cache/object.hpp>
#include <gnomon/check/check.hpp>

namespace {

using namespace gnomon;
using namespace gnomon::check;
using cache::ObjectEvent;
using cache::ObjectState;
using cache::ObjectStep;

constexpr ObjectState object_states[] = {ObjectState::absent, ObjectState::hidden, ObjectState::active, ObjectState::static_};

// One row per event, one column per state: the next state, then c where a drawn image is out of date, r where rest begins anew.
struct ObjectRow {
    ObjectEvent event;
    char const* absent;
    char const* hidden;
    char const* active;
    char const* still;
};
constexpr ObjectRow object_rows[] = {
    {ObjectEvent::appeared, "Acr", "Acr", "Acr", "Acr"},
    {ObjectEvent::moved, "0", "Hc", "Acr", "Acr"},
    {ObjectEvent::teleported, "0", "Hc", "Acr", "Acr"},
    {ObjectEvent::deformed, "0", "Hc", "Acr", "Acr"},
    {ObjectEvent::material_changed, "0", "Hc", "Acr", "Acr"},
    {ObjectEvent::alpha_changed, "0", "Hc", "Acr", "Acr"},
    {ObjectEvent::lod_switched, "0", "Hc", "Acr", "Acr"},
    {ObjectEvent::layers_changed, "0", "Hc", "Acr", "Acr"},
    {ObjectEvent::hidden, "0", "H", "Hc", "Hc"},
    {ObjectEvent::shown, "0", "Acr", "A", "S"},
    {ObjectEvent::deleted, "0", "0c", "0c", "0c"},
    {ObjectEvent::rested, "0", "H", "S", "S"},
};

constexpr ObjectStep object_step(char const* text) {
    ObjectStep s{ObjectState::absent, false, false};
    if (*text == 'H') s.next = ObjectState::hidden;
    if (*text == 'A') s.next = ObjectState::active;
    if (*text == 'S') s.next = ObjectState::static_;
    for (char const* c = text + 1; *c != '\0'; ++c) (*c == 'c' ? s.changed : s.restarts) = true;
    return s;
}

constexpr bool object_table_holds() {
    std::size_t rows = 0;
    for (ObjectRow const& row : object_rows) {
        if (static_cast<std::size_t>(row.event) != rows++) return false;
        char const* const texts[] = {row.absent, row.hidden, row.active, row.still};
        for (std::size_t s = 0; s < 4; ++s)
            if (cache::step(object_states[s], row.event) != object_step(texts[s])) return false;
    }
    return rows == cache::object_event_count;
}
static_assert(object_table_holds(), "all 48 transitions");

constexpr bool casting_changes_are_told() {
    for (ObjectState const from : object_states)
        for (ObjectRow const& row : object_rows) {
            ObjectStep const s = cache::step(from, row.event);
            bool const cast = from == ObjectState::active || from == ObjectState::static_;
            bool const casts = s.next == ObjectState::active || s.next == ObjectState::static_;
            if (cast != casts && !s.changed) return false;                                   // else its shadow stays, or is missing
            if (from == ObjectState::static_ && s.next != from && !s.changed) return false;  // else C keeps it
            if (s.next == ObjectState::active && from != s.next && !s.restarts) return false;
        }
    return true;
}
static_assert(casting_changes_are_told());

TEST_CASE("an object is static when it has rested for the prescribed ticks, not one sooner", "[cache][object]") {
    cache::RestConfig const config{.rest_ticks = 10};
    auto r = cache::advance({}, ObjectEvent::appeared, 100);
    CHECK(cache::settle(r, config, 109).state == ObjectState::active);
    CHECK(cache::settle(r, config, 110).state == ObjectState::static_);
    r = cache::advance(r, ObjectEvent::moved, 105);
    CHECK(cache::settle(r, config, 114).state == ObjectState::active);
    CHECK(cache::settle(r, config, 115).state == ObjectState::static_);
    CHECK(cache::settle(r, config, 3).state == ObjectState::active);  // a clock that runs backward
    CHECK(cache::settle(r, config, 115).revision == r.revision);
}

TEST_CASE("fixed objects rest at once, dynamic ones never, and each waking doubles a rest where that is asked for", "[cache][object]") {
    cache::RestConfig const config{.rest_ticks = 10, .max_doublings = 2};
    auto r = cache::advance({.mobility = cache::Mobility::fixed}, ObjectEvent::appeared, 5);
    CHECK(cache::settle(r, config, 5).state == ObjectState::static_);
    r.mobility = cache::Mobility::dynamic;
    CHECK(cache::settle(r, config, ~std::uint64_t{0}).state == ObjectState::active);
    r.mobility = cache::Mobility::automatic;
    std::uint64_t now = 5;
    for (std::uint64_t const rest : {10U, 20U, 40U, 40U}) {
        CHECK(cache::settle(r, config, now + rest - 1).state == ObjectState::active);
        now += rest;
        r = cache::settle(r, config, now);
        CHECK(r.state == ObjectState::static_);
        r = cache::advance(r, ObjectEvent::moved, now);
    }
    CHECK(r.wakes == 4);
    CHECK(cache::advance(r, ObjectEvent::appeared, now).wakes == 0);  // another object by the same id
    r.state = ObjectState::static_;
    r.wakes = 255;
    CHECK(cache::advance(r, ObjectEvent::moved, now).wakes == 255);
    CHECK(cache::ticks_of_rest({.wakes = 255}, {.rest_ticks = ~std::uint64_t{0}, .max_doublings = 255}) == ~std::uint64_t{0});
}

TEST_CASE("whatever happens, no two images of an object have the same revision", "[cache][object][property]") {
    for_all(vector_of(integers(0, 11), 0, 40), [](std::vector<int> const& events) {
        cache::ObjectRecord r;
        std::uint64_t now = 0;
        for (int const e : events) {
            auto const before = r;
            auto const event = static_cast<ObjectEvent>(e);
            r = cache::advance(r, event, ++now);
            bool const other = cache::step(before.state, event).changed;
            CHECK(r.revision == before.revision + (other ? 1U : 0U));
            CHECK((r.since == now || r.since == before.since));
        }
    });
}

}  // namespace
