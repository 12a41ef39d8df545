#include <gnomon/check/check.hpp>
#include <gnomon/cluster/bounds.hpp>
#include <gnomon/math/generators.hpp>

#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

namespace {

using namespace gnomon;
using cluster::implicit_bounds;

/// Planes of one cluster, of any sign and order of size, with perspective or without.
struct OneCluster {
    std::array<float, 2> x, y, depth_m;
    bool perspective;

    [[nodiscard]] cluster::GridView view() const { return {x, y, depth_m, perspective}; }
};

std::string check_string(OneCluster const& c) {
    return math::check_string(math::vec3(c.x[0], c.y[0], c.depth_m[0])) + " .. " + math::check_string(math::vec3(c.x[1], c.y[1], c.depth_m[1])) +
           (c.perspective ? " with perspective" : "");
}

auto one_clusters() {
    return [](check::Choices& choices) {
        auto const pair = [&](float scale) {
            float const a = check::floats(-1.0F, 1.0F)(choices) * scale;
            float const size = check::floats(0.0F, 1.0F)(choices) * check::element_of({1.0F, 1e-3F, 1e-6F})(choices) * scale;
            float const first = choices.draw(7) == 7 ? 0.0F : a;
            return std::array<float, 2>{first, std::max(math::next_up(first), first + size)};
        };
        OneCluster c{pair(2.0F), pair(2.0F), {}, choices.draw(3) != 0};
        c.depth_m = pair(check::element_of({1.0F, 1000.0F, 1e-3F})(choices));
        if (c.perspective) {
            c.depth_m[0] = std::abs(c.depth_m[0]) + 1e-9F;
            c.depth_m[1] = std::max(math::next_up(c.depth_m[0]), std::abs(c.depth_m[1]));
        }
        return c;
    };
}

/// A float position in the hexahedron, often at its borders; nothing where rounding finds none.
bool position_inside(OneCluster const& c, check::Choices& choices, math::vec3& p) {
    auto const between = [&](double lo, double hi) {
        double const part = check::element_of({0.0, 1.0, 0.5, 1e-7, 0.1, 0.9})(choices);
        float const at = static_cast<float>(lo + (hi - lo) * part);
        return static_cast<double>(at) < lo ? math::next_up(at) : static_cast<double>(at) > hi ? math::next_down(at) : at;
    };
    p.z = between(static_cast<double>(c.depth_m[0]), static_cast<double>(c.depth_m[1]));
    double const s = c.perspective ? static_cast<double>(p.z) : 1.0;
    p.x = between(static_cast<double>(c.x[0]) * s, static_cast<double>(c.x[1]) * s);
    p.y = between(static_cast<double>(c.y[0]) * s, static_cast<double>(c.y[1]) * s);
    return contains(c.view(), {0, 0, 0}, p);
}

auto positions_in_clusters() {
    return check::bind(one_clusters(), [](OneCluster const& c) {
        return [c](check::Choices& choices) {
            std::vector<math::vec3> inside;
            for (int i = 0; i < 6; ++i)
                if (math::vec3 p(0.0F); position_inside(c, choices, p)) inside.push_back(p);
            return std::pair{c, inside};
        };
    });
}

}  // namespace

TEST_CASE("the implicit box holds every float point of its cluster, and no smaller box of floats does", "[cluster][property]") {
    std::size_t tried = 0;
    check::for_all(check::cases(5000), positions_in_clusters(), [&](auto const& sample) {
        auto const& [c, points] = sample;
        math::Aabb const box = implicit_bounds(c.view(), {0, 0, 0});
        for (math::vec3 const& p : points) CHECK(contains(box, p));
        tried += points.size();
        // Its sides are the floats next to the exact corners.
        double const s0 = c.perspective ? static_cast<double>(c.depth_m[0]) : 1.0;
        double const s1 = c.perspective ? static_cast<double>(c.depth_m[1]) : 1.0;
        double const lo = std::min(static_cast<double>(c.x[0]) * s0, static_cast<double>(c.x[0]) * s1);
        double const hi = std::max(static_cast<double>(c.y[1]) * s0, static_cast<double>(c.y[1]) * s1);
        CHECK((static_cast<double>(box.lo.x) <= lo && static_cast<double>(math::next_up(box.lo.x)) > lo));
        CHECK((static_cast<double>(box.hi.y) >= hi && static_cast<double>(math::next_down(box.hi.y)) < hi));
        CHECK(box.lo.z == c.depth_m[0]);
        CHECK(box.hi.z == c.depth_m[1]);
    });
    CHECK(tried > 5000);
}

TEST_CASE("an open border makes an open box", "[cluster]") {
    float const inf = std::numeric_limits<float>::infinity();
    OneCluster c{{-inf, 0.0F}, {0.0F, 0.5F}, {10.0F, inf}, true};
    math::Aabb const box = implicit_bounds(c.view(), {0, 0, 0});
    CHECK(box == math::Aabb{math::vec3(-inf, 0.0F, 10.0F), math::vec3(0.0F, inf, inf)});
    c = {{1.0F, 3e38F}, {-3e38F, -1.0F}, {1.0F, 100.0F}, true};
    math::Aabb const far_box = implicit_bounds(c.view(), {0, 0, 0}, 0.5);
    CHECK(far_box == math::Aabb{math::vec3(0.5F, -inf, 1.0F), math::vec3(inf, -0.5F, 100.0F)});
}

TEST_CASE("approximate bounds hold the box of the samples that set their bits, and are its tenths", "[cluster][property]") {
    check::for_all(check::cases(5000), positions_in_clusters(), [](auto const& sample) {
        auto const& [c, points] = sample;
        math::Aabb const implicit = implicit_bounds(c.view(), {0, 0, 0});
        math::Aabb exact;
        cluster::PositionBits bits = 0;
        for (math::vec3 const& p : points) {
            exact = math::extended(exact, p);
            cluster::PositionBits const one = cluster::position_bits(implicit, p);
            using Vec3 = formula::Vec3<float>;
            CHECK(one == gn_position_bits(Vec3(p), Vec3(implicit.lo), Vec3(implicit.hi)).v);
            CHECK(std::popcount(one) == 3);
            CHECK(std::popcount(one & 0x3FFU) == 1);
            bits |= one;
        }
        math::Aabb const box = cluster::approximate_bounds(implicit, bits);
        if (points.empty()) CHECK(is_empty(box));
        for (math::vec3 const& p : points) CHECK(contains(box, p));
        for (math::axis_t a = 0; a < 3 && !points.empty(); ++a) {
            CHECK((implicit.lo[a] <= box.lo[a] && box.hi[a] <= implicit.hi[a]));
            // Less than two tenths wider, and some floats of rounding.
            float const rounding = 4.0F * std::numeric_limits<float>::epsilon() * (std::abs(implicit.lo[a]) + std::abs(implicit.hi[a])) + 1e-44F;
            CHECK(box.hi[a] - box.lo[a] <= exact.hi[a] - exact.lo[a] + 0.2001F * (implicit.hi[a] - implicit.lo[a]) + rounding);
        }
    });
}

TEST_CASE("every set of tenths reads back as its first and last", "[cluster]") {
    math::Aabb const box{math::vec3(0.0F, -10.0F, 100.0F), math::vec3(10.0F, 0.0F, 200.0F)};
    for (std::uint32_t set = 1; set < 1024; ++set) {
        math::Aabb const b = cluster::approximate_bounds(box, set | set << 10U | set << 20U);
        auto const first = static_cast<float>(std::countr_zero(set));
        auto const last = static_cast<float>(std::bit_width(set));
        CHECK(std::abs(b.lo.x - first) < 1e-5F);
        CHECK(std::abs(b.hi.x - last) < 1e-5F);
        CHECK(std::abs(b.lo.y + 10.0F - first) < 1e-5F);
        CHECK(std::abs(b.hi.z - 100.0F - 10.0F * last) < 1e-4F);
    }
    float const inf = std::numeric_limits<float>::infinity();
    math::Aabb const open{math::vec3(-inf, 0.0F, 100.0F), math::vec3(0.0F, inf, inf)};
    check::for_all(check::any_float<float>().with_nan().with_inf(), check::any_float<float>().with_nan().with_inf(), check::any_float<float>().with_nan().with_inf(),
                   [](float at, float lo, float hi) {
                       math::Aabb const any{math::vec3(hi < lo ? hi : lo), math::vec3(hi < lo ? lo : hi)};
                       using Vec3 = formula::Vec3<float>;
                       CHECK(cluster::position_bits(any, math::vec3(at)) == gn_position_bits(Vec3(math::vec3(at)), Vec3(any.lo), Vec3(any.hi)).v);
                   });
    CHECK(cluster::approximate_bounds(open, cluster::position_bits(open, math::vec3(-1e30F, 5.0F, 1e10F))) == open);
}

TEST_CASE("lanes set the same bits", "[cluster]") {
    using Group = math::Lanes<float, 8>;
    math::Aabb const box{math::vec3(-1.0F, 2.0F, 0.1F), math::vec3(1.0F, 2.5F, 7.0F)};
    formula::Vec3<Group> const lo(Group::all(box.lo.x), Group::all(box.lo.y), Group::all(box.lo.z));
    formula::Vec3<Group> const hi(Group::all(box.hi.x), Group::all(box.hi.y), Group::all(box.hi.z));
    for (int i = 0; i < 1000; i += 8) {
        auto const at = [&](float from, float to) { return Group::ramp(from + (to - from) * static_cast<float>(i) / 1000.0F, (to - from) / 1000.0F); };
        formula::Vec3<Group> const p(at(-1.0F, 1.0F), at(2.5F, 2.0F), at(0.1F, 7.0F));
        auto const bits = gn_position_bits(p, lo, hi);
        for (std::size_t lane = 0; lane < 8; ++lane)
            CHECK(bits.v[lane] == cluster::position_bits(box, math::vec3(p.x.v[lane], p.y.v[lane], p.z.v[lane])));
    }
}
