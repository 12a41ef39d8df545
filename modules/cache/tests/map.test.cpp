#include <gnomon/cache/map.hpp>
#include <gnomon/check/check.hpp>

#include <string>

namespace {

using namespace gnomon;
using cache::MapAction;
using cache::MapEvent;
using cache::MapState;
using cache::MapStep;

// One row per event, one letter per state before: the state afterwards. u unplaced, q pending, p placed, i invalid,
// t partial, v valid. The action is what is due in that state, but for those in `map_todo`.
struct MapRow {
    MapEvent event;
    char const* next;  // from u q p i t v
};
constexpr MapRow map_rows[] = {
    {MapEvent::requested, "qqpitv"},
    {MapEvent::granted, "pppppp"},
    {MapEvent::evicted, "uuuuuu"},
    {MapEvent::content_lost, "uqpppp"},
    {MapEvent::moved_with_content, "uqpitv"},
    {MapEvent::light_posed, "uqpiii"},
    {MapEvent::light_range, "uqpiii"},
    {MapEvent::light_cone, "uqpiii"},
    {MapEvent::projection_changed, "uqpiii"},
    {MapEvent::resolution_changed, "uqpiii"},
    {MapEvent::settings_changed, "uqpiii"},
    {MapEvent::redraw_requested, "uqpiii"},
    {MapEvent::origin_rebased, "uqpitv"},
    {MapEvent::view_set_changed, "uqpitv"},
    {MapEvent::volume_moved, "uqpitt"},
    {MapEvent::volume_jumped, "uqpiii"},
    {MapEvent::member_changed, "uqpiii"},
    {MapEvent::member_joined, "uqpitt"},
    {MapEvent::drawn_partly, "uqtttt"},
    {MapEvent::drawn_wholly, "uqvvvv"},
    {MapEvent::postponed, "uqpitv"},
};

constexpr MapState map_state(char letter) {
    if (letter == 'u') return MapState::unplaced;
    if (letter == 'q') return MapState::pending;
    if (letter == 'p') return MapState::placed;
    if (letter == 'i') return MapState::invalid;
    return letter == 't' ? MapState::partial : MapState::valid;
}
constexpr MapAction map_due(char letter) {
    if (letter == 'q') return MapAction::place;
    if (letter == 'p' || letter == 'i') return MapAction::redraw;
    return letter == 't' ? MapAction::add : MapAction::none;
}

constexpr bool map_table_holds() {
    std::size_t rows = 0;
    for (MapRow const& row : map_rows) {
        if (static_cast<std::size_t>(row.event) != rows++) return false;
        for (std::size_t s = 0; s < cache::map_state_count; ++s) {
            auto const from = static_cast<MapState>(s);
            MapStep want{map_state(row.next[s]), map_due(row.next[s])};
            bool const held = s >= 2;
            if (row.event == MapEvent::evicted && held) want.action = MapAction::release;
            if (row.event == MapEvent::volume_moved && s >= 4) want.action = MapAction::scroll;
            if (cache::step(from, row.event) != want) return false;
        }
    }
    return rows == cache::map_event_count;
}
static_assert(map_table_holds(), "all 126 transitions");

constexpr bool only_whole_drawings_make_valid() {
    for (std::size_t s = 0; s < cache::map_state_count; ++s)
        for (MapRow const& row : map_rows) {
            auto const from = static_cast<MapState>(s);
            bool const valid = cache::step(from, row.event).next == MapState::valid;
            if (valid && from != MapState::valid && row.event != MapEvent::drawn_wholly) return false;
            // and what is a reason to draw never leaves a map valid
            if (valid && cache::detail::reason_of(row.event) != cache::Reason::none) return false;
        }
    return true;
}
static_assert(only_whole_drawings_make_valid());

TEST_CASE("every reason has a name of its own", "[cache][map]") {
    for (std::size_t a = 0; a < cache::reason_count; ++a)
        for (std::size_t b = 0; b < a; ++b)
            CHECK(std::string(cache::name_of(static_cast<cache::Reason>(a))) != cache::name_of(static_cast<cache::Reason>(b)));
    CHECK(std::string(cache::name_of(cache::Reason::part_owed)) == "part_owed");
    CHECK(std::string(cache::name_of(static_cast<cache::Reason>(200))) == "unknown");
    CHECK(cache::is_redraw(cache::Reason::member_missing));
    CHECK_FALSE(cache::is_redraw(cache::Reason::volume_moved));
}

}  // namespace
