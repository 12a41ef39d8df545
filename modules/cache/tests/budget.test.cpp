#include <gnomon/cache/budget.hpp>
#include <gnomon/check/check.hpp>

#include <algorithm>
#include <vector>

namespace {

using namespace gnomon;
using namespace gnomon::check;
using cache::Priority;
using cache::Work;

std::vector<Work> some_works(Choices& c) {
    int const count = integers(0, 12)(c);
    std::vector<Work> works;
    for (int i = 0; i < count; ++i) {
        int const priority = integers(0, 2)(c);
        int const cost = integers(0, 20)(c);
        int const waited = integers(0, 6)(c);
        works.push_back({static_cast<std::uint32_t>(i), static_cast<Priority>(priority), static_cast<std::uint64_t>(cost), static_cast<std::uint64_t>(waited)});
    }
    return works;
}

bool is_promoted_work(Work const& w) { return w.priority == Priority::requested && w.waited >= 5; }

/// By picking the most urgent of what is left, over and over.
std::vector<std::uint32_t> choose_slowly(std::vector<Work> works, std::uint64_t budget) {
    std::vector<std::uint32_t> now;
    std::uint64_t spent = 0;
    while (!works.empty()) {
        std::size_t best = 0;
        auto const rank = [](Work const& w) { return w.priority == Priority::mandatory ? 0 : is_promoted_work(w) ? 1 : 1 + static_cast<int>(w.priority); };
        for (std::size_t i = 1; i < works.size(); ++i) {
            Work const& a = works[i];
            Work const& b = works[best];
            if (rank(a) != rank(b) ? rank(a) < rank(b) : a.waited != b.waited ? a.waited > b.waited : a.id < b.id) best = i;
        }
        Work const w = works[best];
        works.erase(works.begin() + static_cast<std::ptrdiff_t>(best));
        bool const due = w.priority == Priority::mandatory || is_promoted_work(w);
        if (!due && spent + w.cost > budget) continue;
        spent += w.cost;
        now.push_back(w.id);
    }
    return now;
}

TEST_CASE("the budget chooses what picking the most urgent work by hand does, in any order of the list", "[cache][budget][property]") {
    for_all(cases(2000), some_works, integers(0, 60), integers(0, 11), [](std::vector<Work> const& given, int budget, int turn) {
        auto works = given;
        if (!works.empty()) std::rotate(works.begin(), works.begin() + turn % static_cast<int>(works.size()), works.end());
        std::vector<std::uint32_t> order(works.size());
        cache::BudgetConfig const config{.cost = static_cast<std::uint64_t>(budget), .requested_wait = 5};
        auto const report = cache::choose(works, config, order);
        std::vector<std::uint32_t> chosen;
        std::uint64_t cost = 0;
        std::uint64_t longest = 0;
        std::vector<bool> seen(works.size());
        for (std::size_t i = 0; i < order.size(); ++i) {
            Work const& w = works[order[i]];
            CHECK_FALSE(seen[w.id]);
            seen[w.id] = true;
            if (i < report.chosen) {
                chosen.push_back(w.id);
                cost += w.cost;
            } else {
                CHECK(w.priority != Priority::mandatory);
                CHECK(w.cost + report.cost > config.cost);  // nothing that would fit still waits
                longest = std::max(longest, w.waited + 1);
            }
        }
        CHECK(chosen == choose_slowly(given, config.cost));
        CHECK(report.cost == cost);
        CHECK(report.postponed == works.size() - report.chosen);
        CHECK(report.longest_wait == longest);
    });
}

TEST_CASE("no requested map waits longer than it may, however small the budget, and idle ones only with leave", "[cache][budget]") {
    std::vector<Work> works;
    for (std::uint32_t i = 0; i < 20; ++i) works.push_back({i, i < 15 ? Priority::requested : Priority::idle, 10, 0});
    std::vector<std::uint32_t> order(works.size());
    cache::BudgetConfig const config{.cost = 9, .requested_wait = 7, .idle_wait = 50};
    std::uint64_t longest = 0;
    std::uint64_t longest_idle = 0;
    std::uint64_t promoted = 0;
    for (int frame = 0; frame < 400; ++frame) {
        auto const report = cache::choose(works, config, order);
        promoted += report.promoted;
        for (std::size_t k = 0; k < order.size(); ++k) {
            Work& w = works[order[k]];
            w.waited = k < report.chosen ? 0 : w.waited + 1;
            auto& most = w.priority == Priority::idle ? longest_idle : longest;
            most = std::max(most, w.waited);
        }
    }
    CHECK(longest == 7);
    CHECK(longest_idle == 50);
    CHECK(promoted == 15 * 50 + 5 * 7);
}

TEST_CASE("costs too large to add are too large for the budget", "[cache][budget]") {
    std::vector<Work> const works{{0, Priority::requested, ~std::uint64_t{0}, 0}, {1, Priority::mandatory, ~std::uint64_t{0}, 0}, {2, Priority::idle, 1, ~std::uint64_t{0}}};
    std::vector<std::uint32_t> order(3);
    auto const report = cache::choose(works, {.cost = 100}, order);
    CHECK(report.chosen == 1);
    CHECK(order[0] == 1);
    CHECK(report.longest_wait == ~std::uint64_t{0});
    CHECK(cache::choose({}, {.cost = 100}, {}).chosen == 0);
}

TEST_CASE("maps that take turns are drawn once in an interval each, and not all at once", "[cache][budget]") {
    for (std::uint32_t id = 0; id < 8; ++id) {
        int turns = 0;
        for (std::uint64_t frame = 100; frame < 104; ++frame) turns += cache::is_turn(id, frame, 4) ? 1 : 0;
        CHECK(turns == 1);
        CHECK(cache::is_turn(id, 5, 0));
    }
    CHECK(cache::is_turn(1, 5, 4));
    CHECK_FALSE(cache::is_turn(2, 5, 4));
}

}  // namespace
