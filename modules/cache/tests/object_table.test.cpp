#include <gnomon/cache/object_table.hpp>
#include <gnomon/check/check.hpp>

#include <vector>

namespace {

using namespace gnomon;
using namespace gnomon::check;
using cache::ObjectEvent;
using cache::ObjectState;

struct TableEvent {
    std::uint32_t id;
    ObjectEvent event;
    int ticks;  // before it
};

TEST_CASE("a table of objects holds what each record would become alone", "[cache][object][property]") {
    auto const event = [](Choices& c) {
        int const id = integers(0, 5)(c);
        int const what = integers(0, 10)(c);
        int const ticks = integers(0, 3)(c);
        return TableEvent{static_cast<std::uint32_t>(id), static_cast<ObjectEvent>(what), ticks};
    };
    for_all(cases(1000), vector_of(event, 0, 40), [](std::vector<TableEvent> const& events) {
        cache::RestConfig const config{.rest_ticks = 3, .max_doublings = 1};
        cache::ObjectTable table(config);
        std::vector<cache::ObjectRecord> alone(6);
        table.grow(4);
        table.grow(6);
        table.set_mobility(cache::ObjectId{0}, cache::Mobility::fixed);
        table.set_mobility(cache::ObjectId{1}, cache::Mobility::dynamic);
        alone[0].mobility = cache::Mobility::fixed;
        alone[1].mobility = cache::Mobility::dynamic;
        std::uint64_t now = 0;
        for (TableEvent const& e : events) {
            now += static_cast<std::uint64_t>(e.ticks);
            auto& r = alone[e.id];
            auto const next = cache::advance(r, e.event, now);
            CHECK(table.apply(cache::ObjectId{e.id}, e.event, now) == (next.revision != r.revision));
            r = next;
            std::size_t rested = 0;
            std::size_t active = 0;
            for (auto& record : alone) {
                auto const after = cache::settle(record, config, now);
                rested += after.state != record.state ? 1U : 0U;
                record = after;
                active += record.state == ObjectState::active ? 1U : 0U;
            }
            CHECK(table.settle(now) == rested);
            CHECK(table.waiting() == active);
            for (std::uint32_t i = 0; i < 6; ++i) CHECK(table[cache::ObjectId{i}] == alone[i]);
        }
    });
}

}  // namespace
