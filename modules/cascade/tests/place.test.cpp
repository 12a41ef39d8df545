// Where maps stand: beside an exact light space, in quadruple precision.

#include "placing.hpp"

#include <gnomon/cascade/place.hpp>

#include <cmath>
#include <cstdint>

namespace {

namespace placing_place {

using namespace placing;
using cascade::Action;
using cascade::Place;

TEST_CASE("a cascade's map holds its sub-frustum and the filter about it, for any camera and light, far away too",
          "[cascades]") {
    int placed = 0;
    int refused = 0;
    for_all(cases(1500), scenarios(), [&](Scenario const& s) {
        Cascades const none;
        auto const frame = cascade::plan(none, s.config, s.camera);
        (frame ? placed : refused) += 1;
        if (!frame) {
            CHECK(frame.failure().code == cascade::Error::too_far);
            return;
        }
        CHECK(corners_outside(s, *frame) == 0);
    });
    CHECK(placed > 10 * refused);
}

TEST_CASE("texels and depth units are the same bits however the camera is turned and moved", "[cascades]") {
    for_all(cases(300), configs(), math::directions(), math::points(),
            [](CascadeConfig config, math::dvec3 const& way, math::vec3 const& eye) {
                config.splits.far_m = 300.0;
                Cascades const none;
                auto const first = cascade::plan(none, config, camera_at(math::dvec3(0.0), {0.0, 0.0, -1.0}));
                auto const other = cascade::plan(none, config, camera_at(math::to_double(eye), way));
                if (!first || !other) return;
                for (std::uint32_t k = 0; k < first->count; ++k) {
                    CHECK(first->cascades[k].volume.texel_m == other->cascades[k].volume.texel_m);
                    CHECK(first->cascades[k].volume.depth_unit_m == other->cascades[k].volume.depth_unit_m);
                }
            });
}

TEST_CASE("a move of less than a texel moves a map by at most one texel, and by none in between",
          "[cascades][stability]") {
    for (double const away : {0.0, 1e4, 1e6, 1e7}) {
        Cascades state;
        CascadeConfig const config = ordinary();
        math::View camera = camera_at({away, 1.7, -away}, {0.3, -0.1, -1.0});
        std::int64_t travelled = 0;
        Place const begin = cascade::plan(state, config, camera)->cascades[0].volume.at;
        int kept = 0;
        for (int i = 0; i < 400; ++i) {
            camera.eye_m = math::dvec3(away, 1.7, -away) + camera.right * (0.00137 * i);
            CascadeFrame const frame = cascade::plan(state, config, camera).value();
            for (std::uint32_t k = 0; k < frame.count; ++k) {
                Place const& d = frame.cascades[k].update.shift;
                CHECK((d.x >= -1 && d.x <= 1 && d.y >= -1 && d.y <= 1));
                CHECK((i == 0) == (frame.cascades[k].update.action == Action::redraw));
            }
            Place const& d = frame.cascades[0].update.shift;
            travelled += d.x;
            kept += d == Place{} ? 1 : 0;
            cascade::commit(state, frame);
        }
        CHECK(travelled == state.held[0].volume.at.x - begin.x);
        CHECK(kept > 100);
    }
}

TEST_CASE("places are the floors of exact coordinates", "[cascades]") {
    for_all(cases(300), math::points(), math::directions(), [](math::vec3 const& eye, math::dvec3 const& way) {
        CascadeConfig config = ordinary();
        math::View const camera = camera_at(math::to_double(eye), way);
        auto const frame = cascade::plan(Cascades{}, config, camera);
        if (!frame) return;
        for (std::uint32_t k = 0; k < frame->count; ++k) {
            Volume const& v = frame->cascades[k].volume;
            Real lo[2] = {1e30, 1e30};
            Real hi[2] = {-1e30, -1e30};
            for (unsigned i = 0; i < 8; ++i)
                for (int a = 0; a < 2; ++a) {
                    Real const c = corner_in_light(camera, frame->cascades[k].depths, *frame, i).at[a] / v.texel_m;
                    lo[a] = c < lo[a] ? c : lo[a];
                    hi[a] = c > hi[a] ? c : hi[a];
                }
            for (int a = 0; a < 2; ++a) {
                Real const over = (lo[a] + hi[a]) / 2 - static_cast<Real>((a == 0 ? v.at.x : v.at.y) + v.size_px / 2);
                CHECK((over >= Real{-0.0078125} && over < Real{1.0078125}));
            }
        }
    });
}

TEST_CASE("places along a path are the same whole numbers on every compiler and machine", "[cascades][golden]") {
    std::uint64_t hash = 14695981039346656037U;
    auto const mix = [&](std::int64_t x) { hash = (hash ^ static_cast<std::uint64_t>(x)) * 1099511628211U; };
    math::View camera;
    camera.window = {-0.9, 0.9, -0.5, 0.5};
    for (Extent const extent : {Extent::diameter, Extent::sphere}) {
        CascadeConfig config = ordinary();
        config.fit.extent = extent;
        config.fit.guard_px = 4;
        Cascades state;
        for (int i = 0; i < 500; ++i) {
            camera.eye_m = math::dvec3(1e7 + 0.31 * i, 1.7, -0.17 * i);
            camera = math::looking_along(camera, math::dvec3((i * 37 % 101) - 50.0, -3.0, (i * 53 % 97) - 48.5),
                                         {0.0, 1.0, 0.0});
            CascadeFrame const frame = cascade::plan(state, config, camera).value();
            for (std::uint32_t k = 0; k < frame.count; ++k) {
                Volume const& v = frame.cascades[k].volume;
                for (std::int64_t const n : {v.at.x, v.at.y, v.at.z, static_cast<std::int64_t>(v.texel_m * 0x1p40)})
                    mix(n);
                mix(static_cast<std::int64_t>(frame.cascades[k].update.action));
            }
            cascade::commit(state, frame);
        }
    }
    CHECK(hash == 11015732304268825855U);
}

TEST_CASE("a view as long as all of the depth codes gets a longer unit, and room at both ends", "[cascades][depth]") {
    for (double const length : {65500.0, 65527.0, 65534.8, 65535.0, 65536.5}) {
        Scenario s;
        s.camera.lens = math::Lens::orthographic;
        s.camera.window = {-1e-3, 1e-3, -1e-3, 1e-3};
        s.camera.near_m = 0.0;
        s.camera.far_m = length;
        s.config.direction = {0.0, 0.0, -1.0};
        s.config.splits.scheme = cascade::SplitScheme::uniform;
        s.config.splits.count = 1;
        s.config.fit.depth.length_m = 1.0;
        s.config.fit.depth.guard_m = 0.0;
        for (int i = 0; i < 8; ++i) {
            s.camera.eye_m.z = 0.3 * i;
            CascadeFrame const frame = cascade::plan(Cascades{}, s.config, s.camera).value();
            CHECK(corners_outside(s, frame) == 0);
        }
    }
}

}  // namespace placing_place

}  // namespace
