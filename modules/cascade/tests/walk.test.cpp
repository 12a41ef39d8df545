// Volumes that walk over a field of heights: what is kept, scrolled and filled equals what is drawn anew, each time.
// The field is a function of whole numbers; nothing is rendered, and every map is drawn by its definition.

#include <gnomon/cascade/scroll.hpp>
#include <gnomon/check/check.hpp>

#include <algorithm>
#include <cstdint>
#include <vector>

namespace {

namespace walk {

using namespace gnomon;
using namespace gnomon::check;
using cascade::Action;
using cascade::Place;
using cascade::Update;
using cascade::Volume;

constexpr std::int32_t size = 16;
constexpr std::int32_t codes = 90;

std::uint32_t mixed(std::int64_t x, std::int64_t y, std::uint64_t salt) {
    std::uint64_t h = static_cast<std::uint64_t>(x) * 0x9E3779B97F4A7C15U +
                      static_cast<std::uint64_t>(y) * 0xC2B2AE3D27D4EB4FU + salt;
    h = (h ^ (h >> 30U)) * 0xBF58476D1CE4E5B9U;
    h = (h ^ (h >> 27U)) * 0x94D049BB133111EBU;
    return static_cast<std::uint32_t>(h >> 33U);
}

/// The depths of the two things that stand over a light-space texel; some texels have none.
struct Pillar {
    std::int64_t z[2];
    int count;
};

Pillar pillar_at(std::int64_t x, std::int64_t y) {
    std::uint32_t const h = mixed(x, y, 1);
    Pillar p{{0, 0}, static_cast<int>(h % 3)};
    for (int i = 0; i < 2; ++i)
        p.z[i] = static_cast<std::int64_t>(mixed(x, y, static_cast<std::uint64_t>(i) + 2) % 500) - 250;
    return p;
}

/// One of each of the printed errors; all false: the rule.
struct Mutation {
    bool wrapped_shift = false;     ///< The shift modulo the map's size.
    bool far_pulled_in = false;     ///< "Nothing drawn" moves as a depth does.
    bool only_new_members = false;  ///< What was in the old query volume is never drawn again.
    bool near_end = false;          ///< The query volume ends toward the light.
    bool wrong_sign = false;        ///< The depth is moved the other way.
    bool no_strip = false;          ///< The second strip is forgotten.
};

void draw(std::uint16_t& texel, std::int64_t z, Volume const& v, Mutation const& m) {
    std::int64_t const code = z - v.at.z;
    if (code >= v.codes || (m.near_end && code < 0)) return;
    texel = static_cast<std::uint16_t>(std::min<std::int64_t>(texel, std::max<std::int64_t>(code, 0)));
}

std::vector<std::uint16_t> drawn_anew(Volume const& v) {
    std::vector<std::uint16_t> map(static_cast<std::size_t>(size) * size, codes);
    for (std::int32_t y = 0; y < size; ++y)
        for (std::int32_t x = 0; x < size; ++x) {
            Pillar const p = pillar_at(v.at.x + x, v.at.y + y);
            for (int i = 0; i < p.count; ++i) draw(map[static_cast<std::size_t>(y * size + x)], p.z[i], v, {});
        }
    return map;
}

/// Draws into the map what its last volume did not hold undistorted: the corrected dS.
void fill(std::vector<std::uint16_t>& map, Volume const& from, Volume const& to, bool had_any, Mutation const& m) {
    for (std::int32_t y = 0; y < size; ++y)
        for (std::int32_t x = 0; x < size; ++x) {
            std::int64_t const at_x = to.at.x + x;
            std::int64_t const at_y = to.at.y + y;
            Pillar const p = pillar_at(at_x, at_y);
            for (int i = 0; i < p.count; ++i) {
                std::int64_t const code = p.z[i] - from.at.z;
                bool const beside = at_x < from.at.x || at_x >= from.at.x + size || at_y < from.at.y || at_y >= from.at.y + size;
                bool const was_member = had_any && !beside && code < codes;
                bool const old = was_member && (m.only_new_members || code >= 0);
                if (!old) draw(map[static_cast<std::size_t>(y * size + x)], p.z[i], to, m);
            }
        }
}

struct Walker {
    Volume at{{0, 0, 0}, size, codes, 0.5, 0.25};
    std::vector<std::uint16_t> map;
    bool any = false;

    /// The strips are checked to be all that scrolling leaves open, by clearing what lies in none of them afterwards.
    int wrong_after(Volume const& to, Mutation const& m) {
        Update update = any ? cascade::update_from(at, to) : cascade::redraw(cascade::Reason::first, size);
        if (m.wrapped_shift && any) {
            auto const wrapped = [](std::int64_t d) { return ((d + size / 2) % size + size) % size - size / 2; };
            Volume const near_by{{at.at.x + wrapped(to.at.x - at.at.x), at.at.y + wrapped(to.at.y - at.at.y), to.at.z},
                                 size,
                                 codes,
                                 0.5,
                                 0.25};
            update = cascade::update_from(at, near_by);
        }
        if (update.action == Action::redraw) map.assign(static_cast<std::size_t>(size) * size, codes);
        if (update.action == Action::scroll) apply(update, m);
        bool const held = update.action != Action::redraw;
        if (!(held && update.action == Action::keep)) fill(map, at, to, held, m);
        at = to;
        any = true;
        std::vector<std::uint16_t> const truth = drawn_anew(to);
        int wrong = 0;
        for (std::size_t i = 0; i < truth.size(); ++i) wrong += map[i] == truth[i] ? 0 : 1;
        return wrong;
    }

    void apply(Update const& update, Mutation const& m) {
        cascade::MapScroll by{update.shift, codes, math::Depth::forward};
        if (m.wrong_sign) by.shift.z = -by.shift.z;
        if (m.far_pulled_in && by.shift.z > 0)
            for (std::uint16_t& texel : map) texel = std::min<std::uint16_t>(texel, codes - 1);
        cascade::scroll_in_place<std::uint16_t>({map.data(), size, size}, by);
        // Outside of the strips nothing was cleared: garbage that is put there first must be what is found there now.
        for (std::int32_t i = 0; i < update.exposed.count - (m.no_strip ? 1 : 0); ++i) {
            cascade::TexelRect const& r = update.exposed.rects[static_cast<std::size_t>(i)];
            for (std::int32_t y = r.y; y < r.y + r.height; ++y)
                for (std::int32_t x = r.x; x < r.x + r.width; ++x)
                    exposed_ += map[static_cast<std::size_t>(y * size + x)] == codes ? 1 : 0;
        }
        expected_exposed_ += size * size - std::max<std::int64_t>(0, size - std::abs(update.shift.x)) *
                                               std::max<std::int64_t>(0, size - std::abs(update.shift.y));
    }

    std::int64_t exposed_ = 0;           ///< Texels of the strips that were cleared.
    std::int64_t expected_exposed_ = 0;  ///< Texels that the old map did not show.
};

std::int64_t step_of(std::uint32_t h, std::int64_t whole) {
    switch (h % 12) {
        case 0: return whole;
        case 1: return -whole;
        case 2: return whole - 1;
        case 3: return 1 - whole;
        case 4: return 2 * whole;
        case 5: return 3 * whole + 7;
        case 6:
        case 7: return 0;
        default: return static_cast<std::int64_t>((h >> 8U) % 11) - 5;
    }
}

struct Walked {
    int wrong_frames = 0;
    Walker walker;
};

Walked walk(std::uint32_t seed, int frames, std::int64_t origin, Mutation const& m) {
    Walked out;
    Volume v = out.walker.at;
    v.at = {origin, -origin, 0};
    for (int i = 0; i < frames; ++i) {
        std::uint32_t const kind = mixed(i, seed, 11) % 4;
        if (kind != 1) v.at.x += step_of(mixed(i, seed, 12), size);
        if (kind != 2) v.at.y += step_of(mixed(i, seed, 13), size);
        if (kind != 3) v.at.z += step_of(mixed(i, seed, 14), codes) / 2;
        if (v.at.z > 300 || v.at.z < -300) v.at.z = 0;
        out.wrong_frames += out.walker.wrong_after(v, m) != 0 ? 1 : 0;
    }
    return out;
}

TEST_CASE("scrolled and filled maps equal maps drawn anew, over walks with jumps of whole maps and moves in depth",
          "[walk]") {
    for_all(cases(40), integers(0, 1000000), element_of({0LL, 1000000LL, 1LL << 40}), [](int seed, long long origin) {
        Walked const walked = walk(static_cast<std::uint32_t>(seed), 60, origin, {});
        CHECK(walked.wrong_frames == 0);
        CHECK(walked.walker.exposed_ == walked.walker.expected_exposed_);
    });
}

TEST_CASE("scrolled and filled maps equal maps drawn anew, over a hundred thousand frames", "[walk][.full]") {
    for (std::uint32_t const seed : {1U, 2U, 3U, 4U, 5U}) {
        Walked const walked = walk(seed, 20000, seed == 1 ? 0 : std::int64_t{1} << (30 + 2 * seed), {});
        CHECK(walked.wrong_frames == 0);
        CHECK(walked.walker.exposed_ == walked.walker.expected_exposed_);
    }
}

TEST_CASE("each printed error is seen by the walk", "[walk][mutation]") {
    Mutation m;
    m.wrapped_shift = true;
    CHECK(walk(7, 200, 0, m).wrong_frames > 0);
    m = {};
    m.far_pulled_in = true;
    CHECK(walk(7, 200, 0, m).wrong_frames > 0);
    m = {};
    m.only_new_members = true;
    CHECK(walk(7, 200, 0, m).wrong_frames > 0);
    m = {};
    m.near_end = true;
    CHECK(walk(7, 200, 0, m).wrong_frames > 0);
    m = {};
    m.wrong_sign = true;
    CHECK(walk(7, 200, 0, m).wrong_frames > 0);
    m = {};
    m.no_strip = true;
    Walked const short_of = walk(7, 200, 0, m);
    CHECK(short_of.walker.exposed_ < short_of.walker.expected_exposed_);
}

}  // namespace walk

}  // namespace
