#include <gnomon/check/check.hpp>

#include <gnomon/predicates/orient.hpp>
#include <gnomon/trace/build.hpp>
#include <gnomon/trace/filter.hpp>
#include <gnomon/trace/query.hpp>

#include "hard_segments.hpp"
#include "scenes.hpp"
#include "sloppy.hpp"

#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

using namespace gnomon;
using scenes::Light;
using scenes::Mesh;
using scenes::Random;
using scenes::Segment;
using scenes::TriangleId;
using segments::any_scale;
using segments::Scale;
using segments::segment_at;
using segments::triangle_of;
using trace::Answer;
using Sloppy = sloppy::Float;

namespace {

struct Tally {
    int asked = 0;
    int unsure = 0;
    int wrong = 0;
    int blocked = 0;
};

template <class S>
Tally compare_triangles(int count, std::uint64_t seed) {
    Random random{seed};
    Tally tally;
    for (int i = 0; i < count; ++i) {
        Scale const scale = any_scale(random);
        trace::Triangle const t = triangle_of(random, scale);
        Segment const s = segment_at(random, t, scale);
        if (!is_valid(s)) continue;
        sloppy::redraw();
        auto const ray = trace::detail::make_ray<S>(s);
        Answer const got = ray.usable.v ? static_cast<Answer>(trace::detail::meet(ray, t).answer.v) : Answer::unsure;
        ++tally.asked;
        tally.unsure += got == Answer::unsure ? 1 : 0;
        bool const truth = blocks(t, s);
        tally.blocked += truth && got == Answer::blocked ? 1 : 0;
        tally.wrong += got != Answer::unsure && (got == Answer::blocked) != truth ? 1 : 0;
    }
    return tally;
}

/// The largest part of its bound that an error took, of the sides and of their sum.
struct Worst {
    double side = 0.0;
    double total = 0.0;
};

using scenes::Quad;

/// Sides in 113 bits from the exact coordinates; the slopes' quotients are off by 2^-113.
std::array<Quad, 3> sides_in_quad(formula::GnRay<Sloppy> const& ray, trace::Triangle const& t, Segment const& s) {
    auto const coordinate = [&](math::vec3 const& p, int axis, float sign, bool relative) {
        return (static_cast<Quad>(p[axis]) - (relative ? static_cast<Quad>(s.start[axis]) : Quad{0})) *
               static_cast<Quad>(sign);
    };
    int const axis[3] = {ray.axis_x.v, ray.axis_y.v, ray.axis_z.v};
    float const sign[3] = {ray.sign.x.v.v, ray.sign.y.v.v, ray.sign.z.v.v};
    Quad extent[3];
    for (int i = 0; i < 3; ++i) extent[i] = coordinate(s.end.xyz, axis[i], sign[i], !s.end.at_infinity);
    Quad x[3];
    Quad y[3];
    for (std::size_t k = 0; k < 3; ++k) {
        Quad const z = coordinate(t[k], axis[2], sign[2], true);
        x[k] = coordinate(t[k], axis[0], sign[0], true) - extent[0] / extent[2] * z;
        y[k] = coordinate(t[k], axis[1], sign[1], true) - extent[1] / extent[2] * z;
    }
    return {x[1] * y[2] - y[1] * x[2], x[2] * y[0] - y[2] * x[0], x[0] * y[1] - y[0] * x[1]};
}

Worst worst_errors(int count, std::uint64_t seed) {
    Random random{seed};
    Worst worst;
    for (int i = 0; i < count; ++i) {
        Scale const scale = any_scale(random);
        trace::Triangle const t = triangle_of(random, scale);
        Segment const s = segment_at(random, t, scale);
        if (!is_valid(s)) continue;
        sloppy::redraw();
        auto const ray = trace::detail::make_ray<Sloppy>(s);
        if (!ray.usable.v) continue;
        auto const meeting = trace::detail::meet(ray, t);
        auto const exact = sides_in_quad(ray, t, s);
        float const got[3] = {meeting.sides.x.v.v, meeting.sides.y.v.v, meeting.sides.z.v.v};
        auto const bound = static_cast<double>(meeting.bound.v.v);
        Quad sum = 0;
        for (std::size_t k = 0; k < 3; ++k) {
            sum += exact[k];
            worst.side =
                std::max(worst.side, std::abs(static_cast<double>(static_cast<Quad>(got[k]) - exact[k])) / bound);
        }
        Quad const off = static_cast<Quad>(meeting.total.v.v) - sum;
        worst.total = std::max(worst.total, std::abs(static_cast<double>(off)) / (5.4 * bound));
    }
    return worst;
}

int rejected_boxes(int count, std::uint64_t seed) {
    // Integers of few bits, so that the segment passes the point exactly, at every scale that the filter allows.
    Random random{seed};
    int rejected = 0;
    for (int i = 0; i < count; ++i) {
        int const exponent = random.below(3) == 0 ? -149 : random.below(160) - 149;
        auto const number = [&](int range) {
            return std::ldexp(static_cast<float>(random.below(2 * range + 1) - range), exponent);
        };
        math::vec3 lo;
        math::vec3 hi;
        math::vec3 point;
        math::vec3 d;
        for (int axis = 0; axis < 3; ++axis) {
            lo[axis] = number(1000);
            hi[axis] = lo[axis] + std::abs(number(50));
            int const place = random.below(3);
            point[axis] = place == 0 ? lo[axis] : hi[axis];
            d[axis] = random.below(3) == 0 ? (random.below(2) == 0 ? 0.0F : -0.0F) : number(300);
        }
        float const back = static_cast<float>(random.below(4));
        for (bool const sun : {false, true}) {
            Segment const s{point + d * back, sun ? Light::direction(-d) : Light::point(point - d)};
            if (!is_valid(s)) continue;
            sloppy::redraw();
            auto const ray = trace::detail::make_ray<Sloppy>(s);
            if (ray.usable.v) rejected += trace::detail::may_touch(ray, lo, hi) ? 0 : 1;
        }
    }
    return rejected;
}

template <std::size_t StackSize = trace::filter_stack>
Tally compare_scenes(int scene_count, int segments, std::uint64_t seed) {
    Random random{seed};
    Tally tally;
    for (int scene = 0; scene < scene_count; ++scene) {
        Mesh mesh = scenes::soup(random, 20 + static_cast<std::size_t>(random.below(300)));
        float const offset = scene % 3 == 0 ? 8192.0F : 0.0F;
        for (math::vec3& p : mesh.positions) p += math::vec3(offset);
        trace::Bvh const bvh = trace::build_bvh(mesh.list());
        for (int i = 0; i < segments; ++i) {
            Segment s = scenes::grid_segment(random, mesh);
            if (!is_valid(s)) continue;
            TriangleId const own(static_cast<std::uint32_t>(random.below(20)));
            sloppy::redraw();
            Answer const got = trace::detail::filter_blocked<Sloppy, StackSize>(bvh, s, own, trace::detail::AllSolid{});
            bool const truth = is_blocked(bvh, s, own);
            ++tally.asked;
            tally.unsure += got == Answer::unsure ? 1 : 0;
            tally.blocked += truth && got == Answer::blocked ? 1 : 0;
            tally.wrong += got != Answer::unsure && (got == Answer::blocked) != truth ? 1 : 0;
        }
    }
    return tally;
}

/// A texture of any size with noise, edges or flat alpha, and a material whose cutoff may be one of its values.
struct MaskedTriangle {
    std::vector<std::uint8_t> texels;
    std::array<math::AlphaTexture, 1> textures;
    std::array<trace::AlphaMaterial, 1> materials;
    std::array<math::vec2, 3> uvs;
    std::array<std::uint32_t, 1> material_of{0};

    explicit MaskedTriangle(Random& random) {
        int const width = 1 + random.below(40);
        int const height = 1 + random.below(40);
        int const channels = random.below(2) == 0 ? 4 : 1;
        texels.resize(static_cast<std::size_t>(width * height * channels));
        int const kind = random.below(3);
        for (std::uint8_t& t : texels)
            t = static_cast<std::uint8_t>(kind == 0 ? random.below(256) : kind == 1 ? 255 * random.below(2) : 128);
        auto const wrap = [&] { return static_cast<math::Wrap>(random.below(3)); };
        textures[0] = {texels, math::ivec2(width, height), wrap(), wrap(), channels};
        float const cutoff =
            random.below(4) == 0 ? static_cast<float>(random.below(256)) / 255.0F : random.uniform(0.0F, 1.0F);
        materials[0] = {true, random.below(2) == 0 ? 1.0F : random.uniform(0.0F, 2.0F), cutoff,
                        random.below(20) == 0 ? 7U : 0U};
        float const reach = std::ldexp(1.0F, random.below(12) - 2);
        for (math::vec2& uv : uvs) uv = math::vec2{random.uniform(-reach, reach), random.uniform(-reach, reach)};
        if (random.below(4) == 0) uvs[1] = uvs[0];
    }
    [[nodiscard]] trace::AlphaTest test() const { return {material_of, materials, textures, uvs}; }
};

Tally compare_masks(int count, std::uint64_t seed) {
    Random random{seed};
    Tally tally;
    while (tally.asked < count) {
        Scale const scale = any_scale(random);
        trace::Triangle const t = triangle_of(random, scale);
        Segment const s = segment_at(random, t, scale);
        MaskedTriangle const masked(random);
        sloppy::redraw();
        auto const ray = trace::detail::make_ray<Sloppy>(s);
        if (!ray.usable.v || !blocks(t, s)) continue;
        auto const meeting = trace::detail::meet(ray, t);
        Answer const got = trace::detail::filter_solid(masked.test(), TriangleId(0), meeting);
        bool const truth = masked.test()(crossing_of(TriangleId(0), t, s));
        ++tally.asked;
        // A triangle that is not met for certain is unsure whatever its texture says.
        tally.unsure += meeting.answer.v == 1 && got == Answer::unsure ? 1 : 0;
        tally.blocked += truth && got == Answer::blocked ? 1 : 0;
        tally.wrong += got != Answer::unsure && (got == Answer::blocked) != truth ? 1 : 0;
    }
    return tally;
}

/// Triangles of which eye or light lie in the plane, or anywhere.
Tally compare_own_planes(int count, std::uint64_t seed) {
    Random random{seed};
    Tally tally;
    for (int i = 0; i < count; ++i) {
        Scale const scale = any_scale(random);
        trace::Triangle const t = triangle_of(random, scale);
        predicates::Target const light = segment_at(random, t, scale).end;
        predicates::Target const eye = segment_at(random, t, scale).end;
        sloppy::redraw();
        Answer const got = trace::detail::filter_separates<Sloppy>(t, eye, light);
        bool const truth = predicates::separates(t[0], t[1], t[2], eye, light);
        ++tally.asked;
        tally.unsure += got == Answer::unsure ? 1 : 0;
        tally.blocked += truth && got == Answer::blocked ? 1 : 0;
        tally.wrong += got != Answer::unsure && (got == Answer::blocked) != truth ? 1 : 0;
    }
    return tally;
}

/// Upright walls under a sun that stands straight above them, and lamps right above samples on them.
Tally compare_walls(int count, std::uint64_t seed) {
    Random random{seed};
    Tally tally;
    for (int i = 0; i < count; ++i) {
        auto const any = [&] { return random.uniform(-100.0F, 100.0F); };
        int const up = random.below(3);
        int const along = (up + 1) % 3;
        trace::Triangle t{math::vec3{any(), any(), any()}, math::vec3{any(), any(), any()}, math::vec3(0.0F)};
        if (random.below(2) == 0) t[1][along] = t[0][along];
        t[2] = t[static_cast<std::size_t>(random.below(2))];
        t[2][up] = any();
        float const u = random.uniform(0.0F, 1.0F);
        math::vec3 const start = random.below(2) == 0 ? t[0] + (t[1] - t[0]) * u : t[0];
        math::vec3 end(random.below(2) == 0 ? 0.0F : -0.0F);
        end[up] = any();
        bool const sun = random.below(2) == 0;
        Segment const s{start, sun ? Light::direction(end) : Light::point(start + end)};
        if (!is_valid(s)) continue;
        sloppy::redraw();
        auto const ray = trace::detail::make_ray<Sloppy>(s);
        Answer const got = ray.usable.v ? static_cast<Answer>(trace::detail::meet(ray, t).answer.v) : Answer::unsure;
        Answer const own = trace::detail::filter_separates<Sloppy>(t, Light::point(start + math::vec3(1.0F)), s.end);
        ++tally.asked;
        tally.unsure += got == Answer::unsure || (sun && own == Answer::unsure) ? 1 : 0;
        tally.wrong += blocks(t, s) || got == Answer::blocked || (sun && own == Answer::blocked) ? 1 : 0;
    }
    return tally;
}

}  // namespace

TEST_CASE("the filter never decides a triangle wrongly, whatever each operation rounds and flushes",
          "[trace][filter][property]") {
    Tally const tally = compare_triangles<Sloppy>(200'000, 71);
    CHECK(tally.wrong == 0);
    CHECK(tally.blocked > 15'000);
    CHECK(tally.unsure < tally.asked * 6 / 10);  // aimed at edges, corners and planes as most are
    CHECK(compare_triangles<float>(100'000, 72).wrong == 0);
}

TEST_CASE("the filter never decides one of five million triangles wrongly", "[.full][trace][filter][property]") {
    Tally const tally = compare_triangles<Sloppy>(5'000'000, 73);
    CHECK(tally.wrong == 0);
}

TEST_CASE("the sides' errors stay within the proven bounds, which are not much too wide", "[trace][filter][property]") {
    Worst const worst = worst_errors(200'000, 74);
    CAPTURE(worst.side);
    CAPTURE(worst.total);
    CHECK(worst.side < 1.0);
    CHECK(worst.side > 0.15);
    CHECK(worst.total < 1.0);
    CHECK(worst.total > 0.05);
}

TEST_CASE("the filter never rejects a box that the segment meets in one corner, edge or face point",
          "[trace][filter][property]") {
    CHECK(rejected_boxes(100'000, 75) == 0);
}

TEST_CASE("the filter's walk of a hierarchy is exact where it is sure, on random and aimed segments",
          "[trace][filter][property]") {
    Tally const tally = compare_scenes(20, 1'000, 76);
    CHECK(tally.wrong == 0);
    CHECK(tally.blocked > 3'000);
    CHECK(tally.unsure < tally.asked / 2);
}

TEST_CASE("a walk that forgets subtrees for want of room is unsure, not wrong", "[trace][filter]") {
    Tally const tally = compare_scenes<4>(10, 1'000, 80);
    CHECK(tally.wrong == 0);
    CHECK(tally.unsure > compare_scenes(10, 1'000, 80).unsure + 300);
}

TEST_CASE("a vertex beyond the filter's range makes the hierarchy unsure", "[trace][filter]") {
    Mesh mesh;
    mesh.add(math::vec3(-1.0F, 1.0F, -1.0F), math::vec3(1.0F, 1.0F, -1.0F), math::vec3(0.0F, 1.0F, 1.0F));
    Segment const s{math::vec3(0.0F), Light::direction(math::vec3(0.0F, 1.0F, 0.0F))};
    CHECK(filter_blocked(trace::build_bvh(mesh.list()), s) == Answer::blocked);
    CHECK(filter_blocked(trace::build_bvh(mesh.list()), s, TriangleId(0)) == Answer::free);
    mesh.add(math::vec3(5.0F, 1.0F, -1.0F), math::vec3(6.0F, 1.0F, 3e8F), math::vec3(7.0F, 1.0F, 1.0F));
    CHECK(filter_blocked(trace::build_bvh(mesh.list()), s) == Answer::unsure);
    CHECK(filter_blocked(trace::Bvh{}, s) == Answer::free);
}

TEST_CASE("the filter never takes a hole for solid or solid for a hole, whatever each operation rounds",
          "[trace][filter][alpha][property]") {
    Tally const tally = compare_masks(30'000, 77);
    CHECK(tally.wrong == 0);
    CHECK(tally.blocked > 5'000);
    CHECK(tally.unsure < tally.asked / 4);
}

TEST_CASE("a plane between eye and light is certain or unsure, whatever each operation rounds",
          "[trace][filter][property]") {
    Tally const tally = compare_own_planes(100'000, 78);
    CHECK(tally.wrong == 0);
    CHECK(tally.blocked > 25'000);
    CHECK(tally.unsure < tally.asked / 3);
}

TEST_CASE("walls in the direction of the light are decided though they are seen edge-on", "[trace][filter][property]") {
    Tally const tally = compare_walls(20'000, 79);
    CHECK(tally.wrong == 0);
    CHECK(tally.unsure == 0);
}

TEST_CASE("a light straight above a box is decided on its walls and below its edges and corners", "[trace][filter]") {
    // A roof of two triangles; points below its border, its corners, its diagonal and its middle.
    float const x[3] = {478.300659F, 482.1F, 486.111115F};
    float const z[3] = {-492.128265F, -488.9F, -485.714294F};
    math::vec3 const a(x[0], 76.7897034F, z[0]);
    math::vec3 const c(x[2], 76.7897034F, z[2]);
    trace::Triangle const roof{a, math::vec3(x[0], a.y, z[2]), c};
    int sure = 0;
    for (float const at_x : x)
        for (float const at_z : z)
            for (bool const sun : {false, true}) {
                math::vec3 const start(at_x, 12.3F, at_z);
                Segment const s{start, sun ? Light::direction(math::vec3(-0.0F, 1.0F, 0.0F))
                                           : Light::point(math::vec3(at_x, 200.0F, at_z))};
                Answer const got = trace::filter_blocks(roof, s);
                CHECK((got == Answer::unsure || (got == Answer::blocked) == blocks(roof, s)));
                sure += got != Answer::unsure ? 1 : 0;
            }
    CHECK(sure == 18);
}

TEST_CASE("beyond what the filter was made for it is unsure", "[trace][filter]") {
    using trace::filter_blocks;
    trace::Triangle const t{math::vec3(-1.0F, 1.0F, -1.0F), math::vec3(1.0F, 1.0F, -1.0F),
                            math::vec3(0.0F, 1.0F, 1.0F)};
    math::vec3 const below(0.0F, 0.0F, 0.0F);
    math::vec3 const up(0.0F, 2.0F, 0.0F);
    CHECK(filter_blocks(t, {below, Light::direction(up)}) == Answer::blocked);
    CHECK(filter_blocks(t, {below, Light::point(up)}) == Answer::blocked);
    CHECK(filter_blocks(t, {below, Light::point(math::vec3(0.0F, 0.5F, 0.0F))}) == Answer::free);
    CHECK(filter_blocks(t, {below, Light::direction(-up)}) == Answer::free);
    CHECK(filter_blocks(t, {below, Light::direction(up * 1e37F)}) == Answer::blocked);
    CHECK(filter_blocks(t, {below, Light::direction(up * 1e-30F)}) == Answer::blocked);
    CHECK(filter_blocks(t, {below, Light::direction(up * 1e-44F)}) == Answer::unsure);
    for (float const bad : {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity(), 3e8F})
        for (int axis = 0; axis < 3; ++axis) {
            math::vec3 p = below;
            p[axis] = bad;
            CHECK(filter_blocks(t, {p, Light::direction(up)}) == Answer::unsure);
            CHECK(filter_blocks(t, {up, Light::point(p)}) == Answer::unsure);
        }
    CHECK(filter_blocks(t, {below, Light::direction(below)}) == Answer::unsure);
    CHECK(filter_blocks(t, {below, Light::point(math::vec3(0.0F, 1e-13F, 0.0F))}) == Answer::unsure);
}
