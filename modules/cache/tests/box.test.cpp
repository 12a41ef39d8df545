#include <gnomon/cache/box.hpp>
#include <gnomon/check/check.hpp>

#include <limits>

namespace {

using namespace gnomon;
using namespace gnomon::check;
using cache::Box;
using cache::Volume;

Box small_box(Choices& c) {
    int const x = integers(-6, 10)(c);
    int const y = integers(-6, 10)(c);
    int const z = integers(-9, 18)(c);
    int const wide = integers(0, 8)(c);
    int const high = integers(0, 8)(c);
    int const deep = integers(-1, 12)(c);
    return {x, y, z, x + wide, y + high, z + deep};
}
Volume small_volume(Choices& c) {
    int const x = integers(-5, 5)(c);
    int const y = integers(-5, 5)(c);
    int const z = integers(-8, 8)(c);
    return {x, y, z, 5, 4, 9};
}

/// f(texel, depth) for all that a caster in the box may write.
template <class F>
void for_points(Box const& b, F const& f) {
    for (std::int64_t y = b.y0; y < b.y1; ++y)
        for (std::int64_t x = b.x0; x < b.x1; ++x)
            for (std::int64_t z = b.z0; z <= b.z1; ++z) f(x, y, z);
}
bool holds_texel(Volume const& v, std::int64_t x, std::int64_t y) {
    return v.x <= x && x < v.x + v.width && v.y <= y && y < v.y + v.height;
}

TEST_CASE("a box touches a volume if a point of it is written there, or in what two volumes share", "[cache][box][property]") {
    for_all(cases(400), small_box, small_volume, small_volume, [](Box const& box, Volume const& v, Volume const& w) {
        bool writes = false;
        bool both = false;
        for_points(box, [&](auto x, auto y, auto z) {
            bool const in_v = holds_texel(v, x, y) && z < v.z + v.far_code;
            writes |= in_v;
            both |= in_v && holds_texel(w, x, y) && z < w.z + w.far_code;
        });
        CHECK(cache::may_touch(box, v) == writes);
        CHECK(cache::may_touch_both(box, v, w) == both);
    });
}

TEST_CASE("a volume shows more of a box if scrolling loses the code of one of its points", "[cache][box][property]") {
    for_all(cases(400), small_box, small_volume, small_volume, [](Box const& box, Volume const& before, Volume const& now) {
        bool lost = false;
        auto const code = [](std::int64_t z, Volume const& v) { return std::clamp<std::int64_t>(z - v.z, 0, v.far_code); };
        for_points(box, [&](auto x, auto y, auto z) {
            if (!holds_texel(now, x, y)) return;
            auto const old = code(z, before);
            auto const kept = old == before.far_code ? now.far_code : std::clamp<std::int64_t>(old + before.z - now.z, 0, now.far_code);
            lost |= (holds_texel(before, x, y) ? kept : now.far_code) != code(z, now);
        });
        if (cache::may_touch(box, now)) CHECK(cache::shows_more(box, before, now) == lost);
        else CHECK_FALSE(lost);
    });
}

math::dvec3 turned(math::dvec3 const& a, math::dvec3 const& b) {
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

TEST_CASE("an enclosing box holds every point, with room for what drawing rounds, at 1e7 m too", "[cache][box][property]") {
    auto const at = one_of(floats(-100.0, 100.0), floats(-1e7, 1e7));
    auto const size = floats(0.0, 50.0);
    for_all(array_of<3>(at), array_of<3>(size), array_of<3>(floats(0.0, 1.0)), array_of<3>(floats(-1.0, 1.0)),
            [](auto const& low, auto const& wide, auto const& part, auto const& way) {
                math::dvec3 const raw(way[0], way[1], way[2] + 2.0);
                math::dvec3 const away = raw * (1.0 / std::sqrt(raw.x * raw.x + raw.y * raw.y + raw.z * raw.z));
                math::dvec3 const side = turned(away, {0.0, 1.0, 0.0});
                math::dvec3 const right = side * (1.0 / std::sqrt(side.x * side.x + side.y * side.y + side.z * side.z));
                cache::LightUnits const light{right, turned(away, right), away, 0.03125, 0.002};
                math::dvec3 const lo(low[0], low[1], low[2]);
                math::dvec3 const hi(low[0] + wide[0], low[1] + wide[1], low[2] + wide[2]);
                auto const box = cache::enclose(light, lo, hi);
                REQUIRE(box);
                using Wide = long double;
                auto const mix = [](double a, double b, double t) { return std::min(b, a + (b - a) * t); };
                math::dvec3 const p(mix(lo.x, hi.x, part[0]), mix(lo.y, hi.y, part[1]), mix(lo.z, hi.z, part[2]));
                auto const along = [&](math::dvec3 const& axis, double unit) {
                    return (Wide{axis.x} * p.x + Wide{axis.y} * p.y + Wide{axis.z} * p.z) / Wide{unit};
                };
                Wide const margin = 0.75L;
                CHECK(static_cast<Wide>(box->x0) + margin <= along(right, 0.03125));
                CHECK(static_cast<Wide>(box->x1) - margin >= along(right, 0.03125));
                CHECK(static_cast<Wide>(box->y0) + margin <= along(light.down, 0.03125));
                CHECK(static_cast<Wide>(box->y1) - margin >= along(light.down, 0.03125));
                CHECK(static_cast<Wide>(box->z0) + margin <= along(away, 0.002));
                CHECK(static_cast<Wide>(box->z1) - margin >= along(away, 0.002));
            });
}

TEST_CASE("what is no box, or too far away, is enclosed by none", "[cache][box]") {
    double const nan = std::numeric_limits<double>::quiet_NaN();
    double const infinity = std::numeric_limits<double>::infinity();
    cache::LightUnits const light;
    CHECK_FALSE(cache::enclose(light, {nan, 0, 0}, {1, 1, 1}));
    CHECK_FALSE(cache::enclose(light, {0, 0, 0}, {1, nan, 1}));
    CHECK_FALSE(cache::enclose(light, {0, 0, 2}, {1, 1, 1}));
    CHECK_FALSE(cache::enclose(light, {0, 0, -infinity}, {1, 1, 1}));
    CHECK_FALSE(cache::enclose(light, {-infinity, 0, 0}, {infinity, 1, 1}));
    CHECK_FALSE(cache::enclose(light, {0, 0, 0}, {1e300, 1, 1}));
    CHECK(cache::enclose(light, {0, 0, 0}, {0, 0, 0}) == Box{-1, -1, -1, 1, 1, 1});
}

}  // namespace
