#include <gnomon/cache.hpp>
#include <gnomon/check/check.hpp>

#include "model.hpp"

#include <algorithm>
#include <array>
#include <vector>

namespace {

using namespace gnomon;
using namespace gnomon::check;

constexpr std::uint32_t light_count = 12;

// Lights of which each sees some of 40 objects; what an image holds is the sum of the revisions that were drawn to it.
struct Lights {
    std::array<cache::CachedMap, light_count> maps;
    std::array<std::uint64_t, light_count> images{};
    std::vector<cache::Object> objects;
    std::uint64_t longest_wait = 0;
    std::uint64_t most_cost = 0;
    std::size_t postponed = 0;

    Lights() {
        for (std::uint32_t i = 0; i < 40; ++i) objects.push_back({cache::ObjectId{i}, 1, cache::ObjectState::static_, cache::ObjectEvent::moved, {}});
    }
    static bool sees(std::uint32_t light, std::uint32_t i) { return cache_model::Random::mix(light * 64 + i) % 4 == 0; }
    std::uint64_t right_image(std::uint32_t light) const {
        std::uint64_t sum = 0;
        for (std::uint32_t i = 0; i < objects.size(); ++i) sum += sees(light, i) ? objects[i].revision * (i + 1ULL) : 0;
        return sum;
    }
    void frame(std::uint64_t budget) {
        std::vector<cache::Work> works;
        std::vector<cache::Plan> plans(light_count);
        for (std::uint32_t l = 0; l < light_count; ++l) {
            plans[l] = maps[l].plan_fixed(objects, [l](std::uint32_t i) { return sees(l, i); });
            if (plans[l].action == cache::MapAction::none) maps[l].commit();
            else works.push_back({l, cache::Priority::requested, plans[l].statics.size(), maps[l].stale_updates()});
        }
        std::vector<std::uint32_t> order(works.size());
        auto const report = cache::choose(works, {.cost = budget, .requested_wait = 6}, order);
        most_cost = std::max(most_cost, report.promoted == 0 ? report.cost : 0);
        longest_wait = std::max(longest_wait, report.longest_wait);
        postponed += report.postponed;
        for (std::size_t k = 0; k < order.size(); ++k) {
            std::uint32_t const l = works[order[k]].id;
            if (k >= report.chosen) {
                maps[l].postpone();
                continue;
            }
            if (plans[l].action == cache::MapAction::redraw) images[l] = 0;
            for (std::uint32_t const i : plans[l].statics) images[l] += objects[i].revision * (i + 1ULL);
            maps[l].commit();
        }
    }
};

TEST_CASE("many lights under a budget: none waits too long, and all are right soon after the world comes to rest", "[cache][budget]") {
    for (std::uint64_t const budget : {1U, 12U, 25U, 400U}) {
        Lights lights;
        cache_model::Random random{budget};
        for (int f = 0; f < 200; ++f) {
            for (int n = 0; n < 2; ++n) ++lights.objects[static_cast<std::size_t>(random.below(40))].revision;
            lights.frame(budget);
        }
        CHECK(lights.longest_wait <= 6);
        CHECK(lights.most_cost <= budget);
        CHECK((lights.postponed == 0) == (budget == 400));
        for (int f = 0; f < 7; ++f) lights.frame(budget);
        std::uint64_t postponed = 0;
        for (std::uint32_t l = 0; l < light_count; ++l) {
            CHECK(lights.maps[l].state() == cache::MapState::valid);
            CHECK(lights.maps[l].stale_updates() == 0);
            CHECK(lights.images[l] == lights.right_image(l));
            CHECK(adds_up(lights.maps[l].history()));
            postponed += lights.maps[l].history().postponed;
        }
        CHECK(postponed == lights.postponed);
    }
}

}  // namespace
