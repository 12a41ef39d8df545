// How large texels and depth units are, and how long they stay so.

#include "placing.hpp"

#include <gnomon/cascade/fit.hpp>

#include <cmath>

namespace {

namespace placing_fit {

using namespace placing;
using cascade::Action;
using cascade::DepthRange;
using cascade::Reason;

TEST_CASE("a field of view that breathes keeps its texels; one that opens wide changes them a few times",
          "[cascades][zoom]") {
    CascadeConfig const config = ordinary();
    Cascades state;
    int redraws = 0;
    for (int i = 0; i < 600; ++i) {
        double const fov = 1.0 + 0.015 * std::sin(0.1 * i);
        CascadeFrame const frame =
            cascade::plan(state, config, camera_at(math::dvec3(0.0), {0.0, 0.0, -1.0}, fov)).value();
        for (std::uint32_t k = 0; k < frame.count; ++k)
            redraws += i != 0 && frame.cascades[k].update.action == Action::redraw ? 1 : 0;
        cascade::commit(state, frame);
    }
    CHECK(redraws <= 4);  // each map at most once
    redraws = 0;
    for (int i = 0; i < 600; ++i) {
        CascadeFrame const frame =
            cascade::plan(state, config, camera_at(math::dvec3(0.0), {0.0, 0.0, -1.0}, 0.5 + 0.001 * i)).value();
        redraws += frame.cascades[3].update.reason == Reason::texel_size ? 1 : 0;
        CHECK((frame.cascades[3].update.action == Action::redraw) == (frame.cascades[3].update.reason != Reason::none));
        cascade::commit(state, frame);
    }
    CHECK((redraws > 2 && redraws < 16));
}

TEST_CASE("a camera jittered by parts of a pixel redraws nothing", "[cascades][zoom]") {
    CascadeConfig const config = ordinary();
    Cascades state;
    math::View const still = camera_at({5.0, 1.7, 3.0}, {0.2, -0.1, -1.0});
    cascade::commit(state, cascade::plan(state, config, still).value());
    for (int i = 0; i < 64; ++i) {
        CascadeFrame const frame =
            cascade::plan(state, config, math::jittered(still, {(i % 8) / 8.0 - 0.5, (i / 8) / 8.0 - 0.5})).value();
        for (std::uint32_t k = 0; k < frame.count; ++k) CHECK(frame.cascades[k].update.action != Action::redraw);
        cascade::commit(state, frame);
    }
}

TEST_CASE("scene bounds give a depth range that stands still and holds the scene", "[cascades][depth]") {
    for_all(cases(300), math::boxes(), math::directions(), booleans(),
            [](math::Aabb const& box, math::dvec3 const& sun, bool reals) {
                CascadeConfig config = ordinary();
                config.direction = sun;
                config.fit.depth = {DepthRange::scene_bounds,
                                    reals ? cascade::float_codes : cascade::unorm16_codes,
                                    0.0,
                                    0.0,
                                    math::to_double(box.lo),
                                    math::to_double(box.hi)};
                auto const frame = cascade::plan(Cascades{}, config, camera_at(math::dvec3(0.0), {1.0, 0.0, 0.0}));
                auto const other = cascade::plan(Cascades{}, config, camera_at({40.0, 30.0, -9.0}, {0.0, 1.0, 1.0}));
                if (!frame || !other) return;
                CHECK_FALSE(frame->clamp_near);
                for (unsigned i = 0; i < 8; ++i) {
                    Volume const& v = frame->cascades[0].volume;
                    CHECK(v.at.z == other->cascades[0].volume.at.z);
                    double const z =
                        cascade::along(frame->light.away, math::to_double(math::corner(box, i))) / v.depth_unit_m -
                        static_cast<double>(v.at.z);
                    CHECK((z >= 1.0 && z <= static_cast<double>(v.codes - 1)));
                }
            });
}

}  // namespace placing_fit

}  // namespace
