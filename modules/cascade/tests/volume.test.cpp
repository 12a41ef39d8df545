#include <gnomon/cascade/light_frame.hpp>
#include <gnomon/cascade/sub_frustum.hpp>
#include <gnomon/cascade/volume.hpp>
#include <gnomon/check/check.hpp>
#include <gnomon/math/generators.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

namespace {

namespace boxes {

using namespace gnomon;
using namespace gnomon::check;
using cascade::LightBox;
using cascade::LightFrame;
using cascade::Volume;

TEST_CASE("a light's frame is right-handed and of unit length for any direction and up, and always the same",
          "[light_frame]") {
    for_all(math::directions(), math::directions(), floats(1e-30, 1e30),
            [](math::dvec3 const& way, math::dvec3 const& up, double length) {
                LightFrame const light = cascade::make_light_frame(way * length, up).value();
                CHECK(light == cascade::make_light_frame(way * length, up).value());
                CHECK(std::abs(cascade::along(light.right, light.down)) < 1e-15);
                CHECK(std::abs(cascade::along(light.right, light.away)) < 1e-15);
                CHECK(std::abs(cascade::along(light.down, light.away)) < 1e-15);
                math::dvec3 const cross = glm::cross(light.right, light.down) - light.away;
                CHECK(cascade::along(cross, cross) < 1e-30);
                CHECK(cascade::along(light.away, way) > 0.999999);
            });
}

TEST_CASE("a sun overhead has a frame, and an upright one keeps the world's up upward", "[light_frame]") {
    LightFrame const noon = cascade::make_light_frame({0.0, -1.0, 0.0}).value();
    CHECK(noon.away == math::dvec3(0.0, -1.0, 0.0));
    CHECK(std::abs(cascade::along(noon.right, noon.right) - 1.0) < 1e-15);
    LightFrame const low = cascade::make_light_frame({1.0, -0.2, 0.0}).value();
    CHECK(low.down.y < -0.9);
    double const nan = std::numeric_limits<double>::quiet_NaN();
    CHECK(cascade::make_light_frame({0.0, -1.0, 0.0}, {nan, 0.0, 0.0}).value() == noon);
}

TEST_CASE(
    "the diameter is the farthest pair's, and the sphere holds the corners and is not larger than the diameter allows",
    "[sub_frustum]") {
    for_all(math::views(), floats(0.1, 50.0), floats(0.01, 100.0),
            [](math::View const& view, double begin, double length) {
                auto const corners = cascade::corners_in_view(view, {begin, begin + length, begin + length});
                double const diameter = cascade::diameter_m(corners);
                cascade::BoundingSphere const sphere = cascade::bounding_sphere(corners);
                double farthest = 0.0;
                for (unsigned i = 0; i < 8; ++i) {
                    CHECK(glm::distance(corners[i], sphere.center_in_view) <= sphere.radius_m * (1.0 + 1e-14));
                    for (unsigned j = 0; j < 8; ++j)
                        farthest = std::fmax(farthest, glm::distance(corners[i], corners[j]));
                }
                CHECK(std::abs(farthest - diameter) <= 1e-14 * diameter);
                CHECK(2.0 * sphere.radius_m >= diameter * (1.0 - 1e-14));
                bool const centred = view.window.left == -view.window.right && view.window.bottom == -view.window.top;
                if (!centred || view.lens != math::Lens::perspective) return;
                // The closed form: the middle at depth (n + f) / 2 (1 + tan^2 of the corner), or on the far window.
                double const tan_sq = view.window.right * view.window.right + view.window.top * view.window.top;
                double const end = begin + length;
                double const at = std::fmin(end, 0.5 * (begin + end) * (1.0 + tan_sq));
                double const radius = std::sqrt((end - at) * (end - at) + tan_sq * end * end);
                CHECK(std::abs(sphere.radius_m - radius) <= 1e-9 * radius);
            });
}

std::int64_t nearest_256(double x) { return static_cast<std::int64_t>(std::llrint(x * 256.0)); }

TEST_CASE("the light box of a world box holds every texel and code that is drawn of what lies within", "[volume]") {
    int boxed = 0;
    std::int64_t loose = 0;
    for_all(
        cases(2000), math::boxes(), math::points(), math::directions(), integers(0, 1 << 20),
        [&](math::Aabb const& box, math::vec3 const& offset, math::dvec3 const& sun, int seed) {
            LightFrame const light = cascade::make_light_frame(sun).value();
            Volume v;
            v.size_px = 512;
            v.texel_m = std::ldexp(1.0 + (seed % 7) * 0.125, seed % 9 - 6);
            v.depth_unit_m = std::ldexp(1.0 + (seed % 5) * 0.125, seed % 11 - 9);
            auto const held = cascade::try_box_in_light(light, v, box, math::to_double(offset));
            if (!held) return;
            ++boxed;
            std::int64_t lo[3];
            std::int64_t hi[3];
            std::fill_n(lo, 3, std::numeric_limits<std::int64_t>::max());
            std::fill_n(hi, 3, std::numeric_limits<std::int64_t>::min());
            for (unsigned i = 0; i < 8; ++i) {
                math::dvec3 const p = math::to_double(offset) + math::to_double(math::corner(box, i));
                math::dvec3 const q = cascade::light_from_relative(light, p);
                std::int64_t const at[3] = {nearest_256(q.x / v.texel_m), nearest_256(q.y / v.texel_m),
                                            nearest_256(q.z / v.depth_unit_m)};
                for (int a = 0; a < 3; ++a) {
                    lo[a] = std::min(lo[a], at[a]);
                    hi[a] = std::max(hi[a], at[a]);
                }
            }
            // Texel i is covered where lo <= 256 i + 128 <= hi; a code is floor((z + 128) / 256), and z off by one at
            // most.
            std::int64_t const first[3] = {(lo[0] + 127) >> 8, (lo[1] + 127) >> 8, (lo[2] + 127) >> 8};
            std::int64_t const end[3] = {((hi[0] - 128) >> 8) + 1, ((hi[1] - 128) >> 8) + 1, ((hi[2] + 129) >> 8) + 1};
            std::int64_t const begin_of[3] = {held->x0, held->y0, held->z0};
            std::int64_t const end_of[3] = {held->x1, held->y1, held->z1};
            for (int a = 0; a < 3; ++a) {
                CHECK((begin_of[a] <= first[a] && end[a] <= end_of[a]));
                CHECK((first[a] - begin_of[a] <= 1 && end_of[a] - end[a] <= 1));
                loose += first[a] - begin_of[a] + end_of[a] - end[a];
            }
        });
    CHECK(loose * 10 < boxed * 6);
    CHECK(boxed > 1000);
}

TEST_CASE("boxes that are empty, no numbers or too far have no light box", "[volume]") {
    LightFrame const light;
    Volume const v{{}, 512, cascade::unorm16_codes, 0.01, 0.01};
    math::Aabb const unit{math::vec3(0.0F), math::vec3(1.0F)};
    CHECK(cascade::try_box_in_light(light, v, unit, {1e7, -1e7, 1e7}));
    CHECK_FALSE(cascade::try_box_in_light(light, v, math::Aabb{}, {}));
    CHECK_FALSE(cascade::try_box_in_light(light, v, unit, {1e13, 0.0, 0.0}));
    CHECK_FALSE(cascade::try_box_in_light(light, v, unit, {std::numeric_limits<double>::quiet_NaN(), 0.0, 0.0}));
    CHECK_FALSE(cascade::try_box_in_light(light, v,
                                          {math::vec3(0.0F), math::vec3(std::numeric_limits<float>::infinity())}, {}));
}

TEST_CASE("may_cast and holds say what each texel and code of a box says", "[volume]") {
    for_all(cases(3000), array_of<6>(integers(-9, 9)), [](std::array<int, 6> const& n) {
        Volume const v{{1, -2, 3}, 5, 4, 1.0, 1.0};
        LightBox const box{n[0], n[1], n[2], n[0] + std::abs(n[3]), n[1] + std::abs(n[4]), n[2] + std::abs(n[5])};
        bool any = false;
        bool all = true;
        for (std::int64_t x = box.x0; x < box.x1; ++x)
            for (std::int64_t y = box.y0; y < box.y1; ++y)
                for (std::int64_t z = box.z0; z < box.z1; ++z) {
                    bool const beside = x < 1 || x >= 6 || y < -2 || y >= 3;
                    any = any || (!beside && z < 7);
                    all = all && !beside && z >= 3 && z < 7;
                }
        bool const some = box.x0 < box.x1 && box.y0 < box.y1 && box.z0 < box.z1;
        if (!some) return;
        CHECK(cascade::may_cast(v, box) == any);
        CHECK(cascade::holds(v, box) == all);
    });
}

}  // namespace boxes

}  // namespace
