#include <gnomon/check/check.hpp>

#include <gnomon/trace/build.hpp>
#include <gnomon/trace/query.hpp>

#include "scenes.hpp"

#include <cmath>

using namespace gnomon;
using scenes::Light;
using scenes::Mesh;
using scenes::Random;
using trace::is_blocked;

namespace {

struct SheetTally {
    int leaks = 0;         ///< Segments through a shared corner or an edge's midpoint that were not blocked.
    int false_blocks = 0;  ///< Segments one ulp outside the border that were.
};

/// Aims `count` segments through the sheet's corners and edge midpoints, and as many along its border, one ulp outside.
///
/// Everything is float-exact: corners are multiples of 1/16, midpoints of 1/32, ends of 1/64, and at 131,072 m floats
/// are multiples of 1/64. The slope of the segments is steeper than any triangle's.
SheetTally aim(int n, float offset, int count, std::uint64_t seed) {
    Random random{seed};
    Mesh const mesh = scenes::sheet(random, n, offset);
    trace::Bvh const bvh = trace::build_bvh(mesh.list());
    SheetTally tally;
    auto const corner = [&](int x, int z) { return mesh.positions[static_cast<std::size_t>(z * (n + 1) + x)]; };
    for (int i = 0; i < count; ++i) {
        int const x = random.below(n);
        int const z = random.below(n);
        math::vec3 target = corner(x, z);
        int const edge = random.below(4);  // the corner itself, or one of the three edges from it
        if (edge == 1) target = (target + corner(x + 1, z)) * 0.5F;
        if (edge == 2) target = (target + corner(x, z + 1)) * 0.5F;
        if (edge == 3) target = (corner(x + 1, z) + corner(x, z + 1)) * 0.5F;
        math::vec3 const d{scenes::dyadic(random, 4, 64), 40.0F + scenes::dyadic(random, 8, 64), scenes::dyadic(random, 4, 64)};
        bool const from_below = random.below(2) == 0;
        math::vec3 const start = from_below ? target - d : target + d;
        math::vec3 const end = from_below ? target + d : target - d;
        bool const sun = random.below(4) == 0;
        tally.leaks += is_blocked(bvh, {start, sun ? Light::direction(end - start) : Light::point(end)}) ? 0 : 1;

        // Outside the border: the coordinate across it stays one ulp beyond, the others vary.
        int const axis = random.below(2) == 0 ? 0 : 2;
        bool const high = random.below(2) == 0;
        float const border = offset + (high ? static_cast<float>(n) : 0.0F);
        float const outside = std::nextafter(border, high ? 1e9F : -1e9F);
        math::vec3 beside = axis == 0 ? corner(high ? n : 0, z) : corner(x, high ? n : 0);
        math::vec3 slant = d;
        beside[axis] = outside;
        slant[axis] = 0.0F;
        math::vec3 const beside_start = beside - slant;
        math::vec3 const beside_end = beside + slant;
        tally.false_blocks +=
            is_blocked(bvh, {beside_start, sun ? Light::direction(slant) : Light::point(beside_end)}) ? 1 : 0;
        // And exactly on the border: blocked.
        math::vec3 on = beside;
        on[axis] = border;
        tally.leaks += is_blocked(bvh, {on - slant, sun ? Light::direction(slant) : Light::point(on + slant)}) ? 0 : 1;
    }
    return tally;
}

}  // namespace

TEST_CASE("segments through a sheet's corners and edges are blocked, one ulp outside its border they are free", "[trace][leak]") {
    for (float const offset : {0.0F, 8192.0F, 131072.0F}) {
        SheetTally const tally = aim(64, offset, 20'000, 21);
        CAPTURE(offset);
        CHECK(tally.leaks == 0);
        CHECK(tally.false_blocks == 0);
    }
}

TEST_CASE("a million segments through the sheet of 256 x 256", "[.full][trace][leak]") {
    for (float const offset : {0.0F, 8192.0F, 131072.0F}) {
        SheetTally const tally = aim(256, offset, 1'000'000, 22);
        CAPTURE(offset);
        CHECK(tally.leaks == 0);
        CHECK(tally.false_blocks == 0);
    }
}
