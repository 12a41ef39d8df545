#include <gnomon/cache/cached_map.hpp>
#include <gnomon/check/allocations.hpp>
#include <gnomon/check/check.hpp>

#include <vector>

GNOMON_COUNT_ALLOCATIONS;

namespace {

using namespace gnomon;

TEST_CASE("updates of a warm map allocate nothing", "[cache]") {
    std::vector<cache::Object> objects;
    for (std::uint32_t i = 0; i < 1000; ++i) {
        std::int64_t const x = 7 * i;
        objects.push_back({cache::ObjectId{i}, 1, cache::ObjectState::static_, cache::ObjectEvent::moved, {x, 0, 0, x + 20, 20, 9}});
    }
    cache::CachedMap map;
    auto const update = [&](std::int64_t x, cache::ObjectState state) {
        for (std::size_t i = 0; i < objects.size(); i += 3) objects[i].state = state;
        auto const drawn = map.plan({.x = x, .width = 8192, .height = 64}, objects).statics.size();
        map.commit();
        return drawn;
    };
    update(0, cache::ObjectState::static_);  // all of them members
    update(0, cache::ObjectState::active);   // each third active
    update(0, cache::ObjectState::static_);
    update(4000, cache::ObjectState::static_);
    auto const before = check::allocations_made();
    std::size_t drawn = 0;
    for (std::int64_t frame = 0; frame < 50; ++frame)
        drawn += update(100 * frame, frame % 2 == 0 ? cache::ObjectState::static_ : cache::ObjectState::active);
    CHECK(check::allocations_made() == before);
    CHECK(drawn > 1000);
}

}  // namespace
