#include "world.hpp"

#include <gnomon/check/check.hpp>

#include <cmath>
#include <limits>
#include <string>
#include <vector>

namespace {

using namespace gnomon;
using namespace gnomon::check;
using cache_model::Fault;
using cache_model::Faulty;

/// Sequences of 12 frames each.
template <class Rules>
cache_model::Tally run_sequences(std::uint64_t first, std::uint64_t count, Fault fault, bool until_wrong) {
    cache_model::Tally tally;
    for (std::uint64_t s = first; s < first + count; ++s) {
        cache_model::World<Rules> world(s, fault, tally);
        world.run(12);
        if (until_wrong && tally.wrong() > 0) break;
    }
    return tally;
}

void check_tally(cache_model::Tally const& t) {
    INFO("first wrong sequence " << t.first_wrong);
    CHECK(t.wrong_c == 0);
    CHECK(t.wrong_w == 0);
    CHECK(t.wrong_part == 0);
    CHECK(t.wrong_books == 0);
    CHECK(t.needless == 0);
    CHECK(t.wrong_near == 0);
    CHECK(t.near_clamped > t.frames / 50);
    CHECK(adds_up(t.history));
    CHECK(t.compared > t.frames / 2);
    CHECK(t.partial > t.frames / 50);
    CHECK(t.postponed > t.frames / 20);
    CHECK(t.history.scrolls > t.frames / 20);
    CHECK(t.history.kept > t.frames / 50);
    CHECK(t.history.additions > t.frames / 50);
}

#ifdef NDEBUG
constexpr std::uint64_t some_sequences = 100000;
#else
constexpr std::uint64_t some_sequences = 10000;
#endif

TEST_CASE("random sequences of events leave every map as it is drawn from nothing", "[cache][property]") {
    check_tally(run_sequences<cache::detail::Rules>(0, some_sequences, Fault::none, false));
}

TEST_CASE("a million random sequences leave every map as it is drawn from nothing", "[cache][property][.full]") {
    auto const t = run_sequences<cache::detail::Rules>(0, 1000000, Fault::none, false);
    check_tally(t);
    std::string text = "frames " + std::to_string(t.frames) + ", compared " + std::to_string(t.compared) + ", partial " +
                       std::to_string(t.partial) + ", postponed " + std::to_string(t.postponed);
    for (std::size_t i = 1; i < cache::reason_count; ++i)
        text += std::string("\n  ") + cache::name_of(static_cast<cache::Reason>(i)) + " " + std::to_string(t.history.by_reason[i]);
    WARN(text);
}

TEST_CASE("each rule that is broken, the paper's printed ones among them, is found out", "[cache][property]") {
    for (int f = 1; f < static_cast<int>(Fault::end); ++f) {
        auto const fault = static_cast<Fault>(f);
        Faulty::set(fault);
        auto const t = run_sequences<Faulty>(0, 40000, fault, true);
        INFO("fault " << f << " after " << t.frames << " frames");
        CHECK(t.wrong() > 0);
    }
    Faulty::set(Fault::none);
    CHECK(run_sequences<Faulty>(0, 200, Fault::none, true).wrong() == 0);
}

TEST_CASE("a jump of exactly one map's width redraws it, a jump of one less scrolls", "[cache]") {
    std::vector<cache::Object> const none;
    cache::CachedMap map;
    (void)map.plan({.width = 512, .height = 512}, none);
    map.commit();
    CHECK(map.plan({.x = 511, .width = 512, .height = 512}, none).action == cache::MapAction::scroll);
    CHECK(map.plan({.x = -511, .y = 511, .width = 512, .height = 512}, none).action == cache::MapAction::scroll);
    auto const& plan = map.plan({.x = 512, .width = 512, .height = 512}, none);
    CHECK(plan.action == cache::MapAction::redraw);
    CHECK(plan.reason == cache::Reason::volume_jumped);
    CHECK(map.plan({.y = -512, .width = 512, .height = 512}, none).reason == cache::Reason::volume_jumped);
    CHECK(map.plan({.z = 1000000, .width = 512, .height = 512}, none).action == cache::MapAction::scroll);
}

cache::Object static_object(std::uint32_t id, cache::Box const& box, std::uint32_t revision = 1) {
    return {cache::ObjectId{id}, revision, cache::ObjectState::static_, cache::ObjectEvent::deformed, box};
}

TEST_CASE("an object at the border is drawn to the strip that it reaches into, and only then", "[cache]") {
    std::vector<cache::Object> const objects{static_object(3, {90, 10, 5, 130, 20, 9}), static_object(7, {0, 0, 0, 10, 10, 1})};
    cache::CachedMap map;
    CHECK(map.plan({.width = 100, .height = 100}, objects).statics.size() == 2);
    map.commit();
    auto const& p = map.plan({.x = 20, .width = 100, .height = 100}, objects);
    CHECK(p.shift == cache::Shift{20, 0, 0});
    CHECK(p.before == cache::Volume{.width = 100, .height = 100});
    CHECK(p.volume == cache::Volume{.x = 20, .width = 100, .height = 100});
    CHECK(p.counts.members == 2);
    CHECK(p.statics.size() == 1);
    CHECK(p.statics[0] == 0);
    CHECK(p.counts.uncovered == 1);
    map.commit();
    CHECK(map.plan({.x = 25, .width = 100, .height = 100}, objects).statics.size() == 1);
    map.commit();
    CHECK(map.plan({.x = 40, .width = 100, .height = 100}, objects).statics.size() == 1);  // its last columns
    map.commit();
    CHECK(map.plan({.x = 45, .width = 100, .height = 100}, objects).statics.empty());  // wholly inside before
    map.commit();
    auto const& back = map.plan({.width = 100, .height = 100}, objects);
    CHECK(back.statics.size() == 1);  // the other one comes into view again
    CHECK(back.counts.joined == 1);
}

TEST_CASE("the plan says why, and which object is to blame", "[cache]") {
    std::vector<cache::Object> objects{static_object(3, {0, 0, 5, 30, 20, 9}), static_object(7, {0, 0, 0, 10, 10, 1})};
    cache::Volume const v{.width = 100, .height = 100};
    cache::CachedMap map;
    CHECK(map.plan(v, objects).reason == cache::Reason::first_use);
    map.commit();
    objects[1].revision = 2;
    CHECK(map.plan(v, objects).reason == cache::Reason::member_deformed);
    CHECK(map.plan(v, objects).culprit == cache::ObjectId{7});
    map.postpone();
    CHECK(map.state() == cache::MapState::invalid);
    CHECK(map.stale_updates() == 1);
    CHECK(map.plan(v, objects).reason == cache::Reason::member_deformed);  // still, a frame later
    CHECK(map.plan(v, objects).culprit == cache::ObjectId{7});
    map.notify(cache::MapEvent::content_lost);
    CHECK(map.plan(v, objects).reason == cache::Reason::content_lost);
    CHECK(map.plan(v, objects).culprit.is_none());
    map.commit();
    CHECK(map.stale_updates() == 0);
    objects.pop_back();
    CHECK(map.plan(v, objects).reason == cache::Reason::member_missing);
    map.commit();
    map.notify(cache::MapEvent::light_posed);
    CHECK(map.plan(v, objects).reason == cache::Reason::light_posed);
    map.commit();
    CHECK(map.history().redraws == 4);
    CHECK(map.history().of(cache::Reason::content_lost) == 1);
    CHECK(map.history().postponed == 1);
    CHECK(adds_up(map.history()));
}

TEST_CASE("a changed member that is not in the kept region costs no redraw, by where it was drawn", "[cache]") {
    std::vector<cache::Object> objects{static_object(1, {0, 0, 5, 10, 10, 9}), static_object(2, {60, 60, 0, 70, 70, 1})};
    cache::CachedMap map;
    (void)map.plan({.width = 100, .height = 100}, objects);
    map.commit();
    objects[0] = static_object(1, {50, 50, 5, 60, 60, 9}, 2);  // was at the border that is scrolled out
    auto const& p = map.plan({.x = 20, .width = 100, .height = 100}, objects);
    CHECK(p.action == cache::MapAction::scroll);
    CHECK(p.counts.left == 1);
    CHECK(p.statics.size() == 1);
    map.commit();
    objects[0] = static_object(1, {110, 0, 5, 119, 10, 9}, 3);  // moves to where the map will not have been
    CHECK(map.plan({.x = 60, .width = 100, .height = 100}, objects).action == cache::MapAction::scroll);
    CHECK(map.plan({.x = 40, .width = 100, .height = 100}, objects).action == cache::MapAction::redraw);
}

TEST_CASE("a spot's map is drawn again for a changed member only, and each face of a cube for itself", "[cache]") {
    std::vector<cache::Object> objects{static_object(1, {}), static_object(2, {}), static_object(5, {})};
    std::vector<int> face{0, 1, 1};
    cache::CachedMap faces[2];
    auto const update = [&](std::size_t f) {
        auto const p = faces[f].plan_fixed(objects, [&](std::uint32_t i) { return face[i] == static_cast<int>(f); });
        faces[f].commit();
        return p;
    };
    CHECK(update(0).action == cache::MapAction::redraw);
    CHECK(update(1).counts.statics == 2);
    CHECK(update(1).action == cache::MapAction::none);
    ++objects[2].revision;
    CHECK(update(0).action == cache::MapAction::none);
    CHECK(update(1).action == cache::MapAction::redraw);
    objects[0].state = cache::ObjectState::active;
    auto const p = update(0);
    CHECK(p.action == cache::MapAction::redraw);
    CHECK(p.counts.actives == 1);
    CHECK(p.compose == cache::Compose::copy_and_draw);
    CHECK(update(0).action == cache::MapAction::none);
    objects.erase(objects.begin());
    face = {1, 1};
    CHECK(update(0).compose == cache::Compose::copy);
    CHECK(update(0).compose == cache::Compose::keep);
    face = {0, 1};
    ++objects[0].revision;  // goes over to the other face
    CHECK(update(0).action == cache::MapAction::add);
    faces[0].notify(cache::MapEvent::light_posed);
    CHECK(update(0).action == cache::MapAction::redraw);
    CHECK(update(1).reason == cache::Reason::member_deformed);
    CHECK(update(1).counts.statics == 1);
}

TEST_CASE("the two strips of a scroll are filled in two frames, and the map is valid after the second", "[cache]") {
    std::vector<cache::Object> const objects{static_object(1, {0, 0, 5, 200, 200, 9}), static_object(2, {102, 90, 0, 106, 95, 1})};
    cache::CachedMap map;
    (void)map.plan({.width = 100, .height = 100}, objects);
    map.commit();
    cache::Volume const moved{.x = 10, .y = 5, .width = 100, .height = 100};
    CHECK(map.plan(moved, objects).statics.size() == 2);
    map.commit_rect({10, 100, 100, 105});  // below, as wide as what was kept
    CHECK(map.state() == cache::MapState::partial);
    CHECK(map.complete_rect() == cache::TexelRect{10, 5, 100, 105});
    CHECK(map.stale_updates() == 1);
    auto const& rest = map.plan(moved, objects);
    CHECK(rest.action == cache::MapAction::add);
    CHECK(rest.reason == cache::Reason::part_owed);
    CHECK(rest.statics.size() == 2);
    map.commit_rect({100, 5, 110, 105});
    CHECK(map.state() == cache::MapState::valid);
    CHECK(map.complete_rect() == cache::rect_of(moved));
    CHECK(map.plan(moved, objects).action == cache::MapAction::none);
}

TEST_CASE("an origin rebase keeps the cache", "[cache][property]") {
    auto const shift = array_of<3>(integers(-20000000, 20000000));
    for_all(cases(300), shift, array_of<3>(floats(-1000.0, 1000.0)), array_of<3>(floats(0.0, 30.0)), [](auto const& by, auto const& at, auto const& size) {
        // positions as a world holds them: whole 2^-20 m near 1e7 m
        auto const held = [](double x) { return std::floor(x * 0x1p20) * 0x1p-20; };
        math::dvec3 const anchor(1e7, -3e6, 17.0);
        math::dvec3 const low = math::dvec3(held(at[0]), held(at[1]), held(at[2])) + anchor;
        math::dvec3 const high = low + math::dvec3(held(size[0]), held(size[1]), held(size[2]));
        math::dvec3 const move(by[0], by[1], by[2]);
        cache::LightUnits const light{{0.6, 0.0, 0.8}, {0.0, -1.0, 0.0}, {-0.8, 0.0, 0.6}, 0.03125, 0.001};
        cache::Volume const v{.x = -100000, .y = -100000, .z = -2000000, .width = 200000, .height = 200000, .far_code = 1 << 24};
        cache::CachedMap map;
        auto const update = [&](math::dvec3 const& to) {
            auto const box = cache::enclose(light, (low + to) - (anchor + to), (high + to) - (anchor + to));
            std::vector<cache::Object> const objects{static_object(1, box.value_or(cache::Box{}))};
            auto const action = map.plan(v, objects).action;
            map.commit();
            return action;
        };
        CHECK(update({0.0, 0.0, 0.0}) == cache::MapAction::redraw);
        map.notify(cache::MapEvent::origin_rebased);
        CHECK(update(move) == cache::MapAction::none);
        CHECK(map.member_count() == 1);
    });
}

TEST_CASE("an object hidden by one that is not drawn yet is not forgotten", "[cache]") {
    cache::Volume const v{.width = 16, .height = 16};
    std::vector<cache::Object> objects{static_object(1, {0, 0, 9, 4, 4, 9}), static_object(2, {0, 0, 2, 8, 8, 3})};
    objects[1].state = cache::ObjectState::active;
    cache::CachedMap map;
    (void)map.plan(v, objects);
    map.commit();
    objects[1].state = cache::ObjectState::static_;  // rests before the first one, but there is no time to draw it to C
    auto const first = [](std::uint32_t i) { return i == 0; };
    CHECK(map.plan(v, objects, first).statics.size() == 1);
    map.commit_part(0);
    CHECK(map.state() == cache::MapState::partial);
    objects[1].state = cache::ObjectState::active;
    CHECK(map.plan(v, objects, first).action == cache::MapAction::none);
    map.postpone();
    objects[0].revision = 2;  // C still shows the first one
    CHECK(map.plan(v, objects).action == cache::MapAction::redraw);
    map.commit();
    objects[1].state = cache::ObjectState::static_;
    (void)map.plan(v, objects, first);
    map.commit();
    objects[0].revision = 3;  // now nothing of it can be seen
    CHECK(map.plan(v, objects, first).action == cache::MapAction::none);
}

TEST_CASE("a ghost that comes to light again is drawn where the map moved meanwhile", "[cache]") {
    // 1 reaches beyond the map; 2 covers all of it that the map shows, and is not drawn to C when the map moves
    std::vector<cache::Object> objects{static_object(1, {4, 0, 9, 20, 4, 9}), static_object(2, {0, 0, 2, 40, 8, 3})};
    objects[1].state = cache::ObjectState::active;
    auto const first = [](std::uint32_t i) { return i == 0; };
    cache::CachedMap map;
    (void)map.plan({.width = 16, .height = 16}, objects);
    map.commit();
    objects[1].state = cache::ObjectState::static_;
    cache::Volume const moved{.x = 2, .width = 16, .height = 16};
    (void)map.plan(moved, objects, first);
    SECTION("nothing drawn") { map.commit_part(0); }
    SECTION("a part that is not near it") { map.commit_rect({2, 10, 18, 16}); }
    objects[1].state = cache::ObjectState::active;
    auto const& plan = map.plan(moved, objects);
    CHECK(plan.action == cache::MapAction::add);
    CHECK(plan.statics.size() == 1);
    CHECK(plan.counts.owed == 1);
}

TEST_CASE("a caster that was never drawn to C is no reason to redraw it", "[cache]") {
    std::vector<cache::Object> objects{static_object(1, {0, 0, 0, 4, 4, 4}), static_object(2, {6, 6, 0, 8, 8, 4})};
    cache::Volume const v{.width = 16, .height = 16};
    cache::CachedMap map;
    (void)map.plan(v, objects);
    map.commit_part(1);
    objects[1].state = cache::ObjectState::active;
    CHECK(map.plan(v, objects).action == cache::MapAction::none);
    map.commit();
    CHECK(map.state() == cache::MapState::valid);
    objects[1].state = cache::ObjectState::static_;
    (void)map.plan(v, objects);
    map.commit_part(0);
    (void)map.plan(v, objects);
    map.commit_part(0);  // put off twice
    ++objects[1].revision;
    CHECK(map.plan(v, objects).action == cache::MapAction::add);
}

void ignore_contract(core::ContractViolation const&) {}

TEST_CASE("a void plan cannot be committed, nor one plan twice", "[cache]") {
    auto const previous = core::set_contract_handler(&ignore_contract);
    std::vector<cache::Object> const objects{static_object(1, {0, 0, 0, 4, 4, 4})};
    cache::Volume const v{.width = 16, .height = 16};
    cache::CachedMap map;
    map.commit();
    CHECK(map.state() == cache::MapState::placed);
    (void)map.plan(v, objects);
    map.notify(cache::MapEvent::granted);
    map.commit();
    CHECK(map.state() == cache::MapState::placed);
    (void)map.plan(v, objects);
    map.commit();
    map.commit();
    map.commit_part(0);
    map.commit_rect({0, 0, 4, 4});
    map.postpone();
    CHECK(map.state() == cache::MapState::valid);
    CHECK(map.member_count() == 1);
    (void)map.plan(v, objects);
    map.notify(cache::MapEvent::light_posed);
    map.commit();
    CHECK(map.state() == cache::MapState::invalid);
    CHECK(map.history().redraws == 1);
    core::set_contract_handler(previous);
}

TEST_CASE("a map that stays does not look at boxes, which may be another light's", "[cache]") {
    std::vector<cache::Object> objects{static_object(1, {0, 0, 0, 5, 5, 5}), static_object(2, {})};
    cache::CachedMap map;
    auto const update = [&] {
        auto const action = map.plan_fixed(objects, [](std::uint32_t) { return true; }).action;
        map.commit();
        return action;
    };
    CHECK(update() == cache::MapAction::redraw);
    objects[0].box = {100, 0, 0, 105, 5, 5};
    CHECK(update() == cache::MapAction::none);
    ++objects[0].revision;
    CHECK(update() == cache::MapAction::redraw);
    CHECK(map.plan({.width = 8, .height = 8}, objects).reason == cache::Reason::projection_changed);
}

TEST_CASE("any whole numbers make a legal box", "[cache][property]") {
    auto const number = [](Choices& c) {
        int const kind = integers(0, 2)(c);
        std::int64_t const small = integers(-20, 20)(c);
        std::int64_t const any = integers(std::numeric_limits<std::int64_t>::min(), std::numeric_limits<std::int64_t>::max())(c);
        return kind == 0 ? small : kind == 1 ? any : any < 0 ? std::numeric_limits<std::int64_t>::min() - std::min<std::int64_t>(small, 0) : std::numeric_limits<std::int64_t>::max() - std::max<std::int64_t>(small, 0);
    };
    for_all(cases(2000), vector_of(array_of<6>(number), 0, 6), array_of<3>(integers(-3, 3)), integers(0, 3), [](auto const& boxes, auto const& by, int far) {
        std::int64_t const base = far == 0 ? 0 : far == 1 ? cache::max_units - 16 : 16 - cache::max_units;
        cache::Volume v{.x = base, .y = base, .z = base, .width = 8, .height = 8, .far_code = 9};
        std::vector<cache::Object> objects;
        for (auto const& b : boxes) objects.push_back(static_object(static_cast<std::uint32_t>(objects.size()), {b[0], b[1], b[2], b[3], b[4], b[5]}));
        cache::CachedMap map;
        std::size_t const due = map.plan(v, objects).statics.size();
        map.commit_part(due / 2);
        v.x += by[0], v.y += by[1], v.z += by[2];
        (void)map.plan(v, objects);
        map.commit_rect({v.x, v.y, v.x + 3, v.y + 8});
        (void)map.plan(v, objects);
        map.commit();
        CHECK(map.state() == cache::MapState::valid);
        CHECK(map.plan(v, objects).action == cache::MapAction::none);
    });
}

TEST_CASE("a plan made before the light moved is void", "[cache]") {
    std::vector<cache::Object> const none;
    cache::CachedMap map;
    (void)map.plan({.width = 4, .height = 4}, none);
    map.commit();
    CHECK(map.state() == cache::MapState::valid);
    map.notify(cache::MapEvent::origin_rebased);
    CHECK(map.plan({.width = 4, .height = 4}, none).action == cache::MapAction::none);
    map.notify(cache::MapEvent::light_posed);
    CHECK(map.plan({.width = 4, .height = 4}, none).action == cache::MapAction::redraw);
    CHECK(map.notify(cache::MapEvent::evicted) == cache::MapAction::release);
    CHECK(map.plan({.width = 4, .height = 4}, none).action == cache::MapAction::none);
    CHECK(map.notify(cache::MapEvent::requested) == cache::MapAction::place);
    CHECK(map.notify(cache::MapEvent::granted) == cache::MapAction::redraw);
    CHECK(map.plan({.width = 4, .height = 4}, none).reason == cache::Reason::first_use);
}

}  // namespace
