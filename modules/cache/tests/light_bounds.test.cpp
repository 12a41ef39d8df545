#include <gnomon/cache/light_bounds.hpp>
#include <gnomon/check/check.hpp>

#include <limits>
#include <vector>

namespace {

using namespace gnomon;
using namespace gnomon::check;

struct LongRange {
    long double low = std::numeric_limits<long double>::infinity();
    long double high = -low;
    void add(long double x) { low = std::min(low, x), high = std::max(high, x); }
};

// every texel whose centre is covered, with 1/32 to spare, and none whose centre is 1/8 off
bool is_tight(std::int64_t begin, std::int64_t end, LongRange const& r) {
    auto const middle = static_cast<std::int64_t>(std::floor(r.low));
    for (std::int64_t t = middle - 4; static_cast<long double>(t) < r.high + 4.0L; ++t) {
        long double const centre = static_cast<long double>(t) + 0.5L;
        bool const in = begin <= t && t < end;
        if (!in && r.low - 1.0L / 32 <= centre && centre <= r.high + 1.0L / 32) return false;
        if (in && (centre < r.low - 0.125L || centre > r.high + 0.125L)) return false;
    }
    return true;
}

TEST_CASE("the box of corners has every texel with a covered centre, and no other, at 1e7 m too", "[cache][box][property]") {
    auto const at = one_of(floats(-100.0, 100.0), floats(-1e7, 1e7));
    for_all(cases(1000), array_of<3>(at), vector_of(array_of<3>(floats(-3.0, 3.0)), 1, 6), floats(-1.5, 1.5), [](auto const& middle, auto const& offsets, double angle) {
        double const c = 1.0 / std::sqrt(1.0 + angle * angle);
        cache::LightUnits const light{{c, 0.0, c * angle}, {0.0, -1.0, 0.0}, {-c * angle, 0.0, c}, 0.0625, 0.01};
        cache::LightBounds bounds(light);
        LongRange x, y, z;
        for (auto const& o : offsets) {
            math::dvec3 const p(middle[0] + o[0], middle[1] + o[1], middle[2] + o[2]);
            bounds.add(p);
            auto const along = [&](math::dvec3 const& a, double unit) {
                return (static_cast<long double>(a.x) * p.x + static_cast<long double>(a.y) * p.y + static_cast<long double>(a.z) * p.z) / static_cast<long double>(unit);
            };
            x.add(along(light.right, 0.0625));
            y.add(along(light.down, 0.0625));
            z.add(along(light.away, 0.01));
        }
        auto const box = bounds.box();
        REQUIRE(box);
        CHECK(is_tight(box->x0, box->x1, x));
        CHECK(is_tight(box->y0, box->y1, y));
        CHECK(static_cast<long double>(box->z0) <= z.low - 0.75L);
        CHECK(static_cast<long double>(box->z1) >= z.high + 0.75L);
        CHECK(static_cast<long double>(box->z1 - box->z0) <= z.high - z.low + 4.0L);
    });
}

TEST_CASE("corners that are no numbers or too far away are left out of the box and counted", "[cache][box]") {
    double const nan = std::numeric_limits<double>::quiet_NaN();
    cache::LightBounds bounds(cache::LightUnits{.texel_m = 1.0, .depth_unit_m = 1.0});
    CHECK_FALSE(bounds.box());
    bounds.add({nan, 0, 0});
    bounds.add({0, 0, std::numeric_limits<double>::infinity()});
    bounds.add({1e30, 0, 0});
    CHECK_FALSE(bounds.box());
    CHECK(bounds.left_out() == 3);
    bounds.add({0.25, -0.25, 0.0});
    REQUIRE(bounds.box());
    CHECK(cache::is_empty(*bounds.box()));  // covers no centre
    bounds.add({2.75, -3.25, -7.0});
    CHECK(*bounds.box() == cache::Box{0, 0, -1, 3, 3, 8});
    bounds.add({0x1p49, 0.0, 0.0});
    CHECK(bounds.box()->x1 == std::int64_t{1} << 49);
}

}  // namespace
