// Placed volumes as views and culling planes.

#include "placing.hpp"

#include <gnomon/cache/box.hpp>
#include <gnomon/cache/light_bounds.hpp>
#include <gnomon/cascade/view.hpp>

#include <cmath>

namespace {

namespace placing_view {

using namespace placing;

TEST_CASE("culling planes cut at one unit beside a map, and keep its border", "[cascades][cull]") {
    for_all(cases(300), math::points(), math::directions(), integers(0, 4),
            [](math::vec3 const& eye, math::dvec3 const& way, int side) {
                CascadeConfig config = ordinary();
                config.direction = way;
                math::dvec3 const eye_m = math::to_double(eye);
                auto const frame = cascade::plan(Cascades{}, config, camera_at(eye_m, {0.0, 0.1, -1.0}));
                if (!frame) return;
                Volume const& v = frame->cascades[1].volume;
                math::dvec3 const middle_m = cascade::middle_m(frame->light, v, frame->anchor_m);
                auto const planes = cascade::culling_planes(frame->light, v, frame->anchor_m, middle_m);
                // Half the map away from its middle, and `beyond` units more, along one of the five ways.
                math::dvec3 const ways[5] = {-frame->light.right, frame->light.right, -frame->light.down,
                                             frame->light.down, frame->light.away};
                double const unit_m = side == 4 ? v.depth_unit_m : v.texel_m;
                double const half = 0.5 * static_cast<double>(side == 4 ? v.codes : v.size_px);
                auto const is_outside = [&](double beyond) {
                    math::vec3 const p = math::to_float(ways[side] * (unit_m * (half + beyond)));
                    bool outside = false;
                    for (math::Plane const& plane : planes) outside = outside || math::surely_outside(plane, {p, p});
                    return outside;
                };
                CHECK_FALSE(is_outside(0.5));
                CHECK(is_outside(1.5));
                CHECK_FALSE(is_outside(-1.5));
            });
}

TEST_CASE("culling planes keep what may cast, and little else", "[cascades][cull]") {
    int kept = 0;
    int left_out = 0;
    for_all(cases(1500), math::points(), math::boxes(), math::directions(),
            [&](math::vec3 const& eye, math::Aabb const& box, math::dvec3 const& way) {
                CascadeConfig config = ordinary();
                config.direction = way;
                math::dvec3 const eye_m = math::to_double(eye);
                auto const frame = cascade::plan(Cascades{}, config, camera_at(eye_m, {0.0, 0.1, -1.0}));
                if (!frame) return;
                Volume const& v = frame->cascades[3].volume;
                auto const planes = cascade::culling_planes(frame->light, v, frame->anchor_m, eye_m);
                cache::LightBounds corners({frame->light.right, frame->light.down, frame->light.away, v.texel_m, v.depth_unit_m});
                for (unsigned i = 0; i < 8; ++i) corners.add(eye_m - frame->anchor_m + math::to_double(math::corner(box, i)));
                auto const in_light = corners.box();
                if (!in_light) return;
                bool outside = false;
                for (math::Plane const& plane : planes) outside = outside || math::surely_outside(plane, box);
                cache::Volume const map{v.at.x, v.at.y, v.at.z, v.size_px, v.size_px, v.codes};
                if (cache::may_touch(*in_light, map)) CHECK_FALSE(outside);
                cache::Box const wide{in_light->x0 - 3, in_light->y0 - 3, in_light->z0 - 3, in_light->x1 + 3, in_light->y1 + 3, in_light->z1 + 3};
                if (!cache::may_touch(wide, map)) CHECK(outside);
                (outside ? left_out : kept) += 1;
            });
    CHECK((kept > 20 && left_out > 100));
}

TEST_CASE("the view of a placed map puts light-space units on its texels and codes", "[cascades][view]") {
    for_all(cases(200), math::points(), math::directions(), booleans(),
            [](math::vec3 const& eye, math::dvec3 const& way, bool reversed) {
                CascadeConfig config = ordinary();
                config.anchor_m = {3.0, -4.0, 5.0};
                auto const frame = cascade::plan(Cascades{}, config, camera_at(math::to_double(eye), way));
                if (!frame) return;
                Volume const& v = frame->cascades[1].volume;
                math::Depth const depth = reversed ? math::Depth::reversed : math::Depth::forward;
                math::View const view = cascade::view_of(*frame, 1, depth);
                for (int i = 0; i < 3; ++i) {
                    double const x = 100.0 * i;
                    double const z = 30000.0 * i;
                    math::dvec3 const light_m((static_cast<double>(v.at.x) + x) * v.texel_m,
                                              (static_cast<double>(v.at.y) + x) * v.texel_m,
                                              (static_cast<double>(v.at.z) + z) * v.depth_unit_m);
                    math::dvec3 const world =
                        frame->anchor_m + ((frame->light.right * light_m.x + frame->light.down * light_m.y) +
                                           frame->light.away * light_m.z);
                    math::dvec3 const seen = math::project(view, world - view.eye_m);
                    double const code = (reversed ? 1.0 - seen.z : seen.z) * static_cast<double>(v.codes);
                    CHECK((std::abs(seen.x - x) < 1e-5 && std::abs(seen.y - x) < 1e-5));
                    CHECK(std::abs(code - z) < 1e-4);
                }
            });
}

}  // namespace placing_view

}  // namespace
