// Cascades from frame to frame: what is exposed, why a map is drawn anew, what is refused.

#include "placing.hpp"

#include <gnomon/cascade/cascades.hpp>

#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string>

namespace {

namespace placing_cascades {

using namespace placing;
using cascade::Action;
using cascade::DepthRange;
using cascade::Reason;

/// The part of its texels that each map exposes in a frame, on average, at 30 frames a second; in percent.
std::array<double, 4> exposed_percent(double metres_per_frame, double degrees_per_frame) {
    CascadeConfig const config = ordinary();
    Cascades state;
    std::array<double, 4> percent{};
    constexpr int frames = 360;
    for (int i = 0; i <= frames; ++i) {
        double const angle = 0.3 + i * degrees_per_frame * 0.017453292519943295;
        math::dvec3 const way(std::sin(angle), 0.0, -std::cos(angle));
        CascadeFrame const frame =
            cascade::plan(state, config, camera_at(way * (i * metres_per_frame) + math::dvec3(0.0, 1.7, 0.0), way))
                .value();
        for (std::uint32_t k = 0; k < 4; ++k) {
            auto const& exposed = frame.cascades[k].update.exposed;
            for (int r = 0; i != 0 && r < exposed.count; ++r) {
                auto const& rect = exposed.rects[static_cast<std::size_t>(r)];
                percent[k] += 100.0 * rect.width * rect.height / (512.0 * 512.0) / frames;
            }
        }
        cascade::commit(state, frame);
    }
    return percent;
}

TEST_CASE("at the paper's speeds one texel in a hundred is exposed by moving, one in twenty by turning", "[cascades]") {
    auto const street = exposed_percent(0.5, 0.0);
    auto const spin = exposed_percent(0.0, 7.0);
    INFO(street[0] << " " << street[1] << " " << street[2] << " " << street[3] << " and " << spin[0] << " " << spin[1]
                   << " " << spin[2] << " " << spin[3]);
    CHECK((street[0] > 0.5 && street[0] < 1.5));
    for (std::size_t k = 1; k < 4; ++k) CHECK(street[k] < 0.7 * street[k - 1]);
    for (std::size_t k = 0; k < 4; ++k) CHECK((spin[k] > 4.0 && spin[k] < 6.0));
}

TEST_CASE("every change that is no move has its reason, and what is not committed is not forgotten",
          "[cascades][reason]") {
    CascadeConfig config = ordinary();
    math::View camera = camera_at(math::dvec3(0.0), {0.0, 0.0, -1.0});
    Cascades state;
    auto const next = [&] { return cascade::plan(state, config, camera).value(); };
    CHECK(next().cascades[2].update.reason == Reason::first);
    CHECK(next().clamp_near);
    cascade::commit(state, next());
    CHECK(next().cascades[2].update.action == Action::keep);
    cascade::invalidate(state, 2);
    CHECK(next().cascades[2].update.reason == Reason::requested);
    CHECK(next().cascades[1].update.action == Action::keep);
    cascade::commit(state, next(), 1);
    CHECK(next().cascades[2].update.reason == Reason::requested);
    cascade::commit(state, next(), 2);
    CHECK(next().cascades[2].update.action == Action::keep);
    auto const reason_of = [&](auto const& change) {
        CascadeConfig const before = config;
        change();
        Reason const reason = next().cascades[2].update.reason;
        config = before;
        return reason;
    };
    CHECK(reason_of([&] { config.direction.x += 1e-6; }) == Reason::light_turned);
    CHECK(reason_of([&] { config.anchor_m.x = 1.0; }) == Reason::anchor_moved);
    CHECK(reason_of([&] { config.fit.size_px = 513; }) == Reason::map_size);
    CHECK(reason_of([&] { config.fit.depth.codes = cascade::float_codes; }) == Reason::depth_format);
    CHECK(reason_of([&] { config.splits.far_m = 100.0; }) == Reason::texel_size);
    CHECK(reason_of([&] { config.fit.depth.length_m = 900.0; }) == Reason::depth_unit);
    camera.eye_m = {5000.0, 0.0, 0.0};
    CHECK(next().cascades[2].update.reason == Reason::moved_past);
}

TEST_CASE("a shift of the world's origin redraws nothing and moves no map", "[cascades][rebase]") {
    for (double const x : {4096.0, -1048576.0, 0.5}) {
        CascadeConfig config = ordinary();
        math::View camera = camera_at({12.25, 1.5, -7.75}, {0.3, -0.2, -1.0});
        Cascades state;
        cascade::commit(state, cascade::plan(state, config, camera).value());
        math::dvec3 const shift(x, -2.0 * x, 0.25 * x);
        cascade::rebase(state, config, shift);
        camera.eye_m += shift;
        CascadeFrame const frame = cascade::plan(state, config, camera).value();
        for (std::uint32_t k = 0; k < frame.count; ++k) CHECK(frame.cascades[k].update.action == Action::keep);
    }
}

TEST_CASE("what cannot be placed is refused with its value", "[cascades][errors]") {
    double const nan = std::numeric_limits<double>::quiet_NaN();
    auto const refusal = [](auto const& change) {
        CascadeConfig config = ordinary();
        math::View camera = camera_at(math::dvec3(0.0), {0.0, 0.0, -1.0});
        change(config, camera);
        auto const frame = cascade::plan(Cascades{}, config, camera);
        return frame ? std::string("placed")
                     : std::to_string(static_cast<int>(frame.failure().code)) + " " + frame.failure().message;
    };
    auto const code = [](cascade::Error e) { return std::to_string(static_cast<int>(e)); };
    using cascade::Error;
    auto const starts = [](std::string const& text, std::string const& with) { return text.rfind(with, 0) == 0; };
    CHECK(starts(refusal([&](CascadeConfig& c, math::View&) { c.direction.y = nan; }), code(Error::not_finite)));
    CHECK(starts(refusal([&](CascadeConfig& c, math::View&) { c.direction = math::dvec3(0.0); }),
                 code(Error::no_direction)));
    CHECK(starts(refusal([&](CascadeConfig& c, math::View&) { c.splits.count = 9; }),
                 code(Error::bad_count) + " 9 cascades"));
    CHECK(starts(refusal([&](CascadeConfig& c, math::View&) { c.splits.far_m = 0.0; }), code(Error::not_finite)));
    CHECK(starts(refusal([&](CascadeConfig& c, math::View&) { c.splits.far_m = -3.0; }), code(Error::bad_range)));
    CHECK(starts(refusal([&](CascadeConfig& c, math::View&) { c.splits.lambda = nan; }), code(Error::bad_fraction)));
    CHECK(starts(refusal([&](CascadeConfig& c, math::View&) { c.fit.guard_px = 254; }),
                 code(Error::bad_size) + " a map of 512 texels with a filter of 2"));
    CHECK(starts(refusal([&](CascadeConfig& c, math::View&) { c.fit.size_px = 1 << 20; }), code(Error::bad_size)));
    CHECK(starts(refusal([&](CascadeConfig& c, math::View&) { c.fit.texel_steps = 3; }), code(Error::bad_fraction)));
    CHECK(starts(refusal([&](CascadeConfig& c, math::View&) { c.fit.depth.length_m = nan; }), code(Error::bad_depth)));
    CHECK(starts(refusal([&](CascadeConfig& c, math::View&) { c.fit.depth.codes = 0; }), code(Error::bad_depth)));
    CHECK(starts(refusal([&](CascadeConfig& c, math::View&) {
                     c.fit.depth.range = DepthRange::scene_bounds;
                     c.fit.depth.scene_lo_m.x = 1.0;
                 }),
                 code(Error::bad_depth)));
    CHECK(starts(refusal([&](CascadeConfig&, math::View& v) { v.eye_m.x = nan; }), code(Error::not_finite)));
    CHECK(starts(refusal([&](CascadeConfig&, math::View& v) { v.window.left = v.window.right; }),
                 code(Error::bad_range)));
    CHECK(starts(refusal([&](CascadeConfig&, math::View& v) { v.window.right = 1e300; }), code(Error::too_far)));
    CHECK(starts(refusal([&](CascadeConfig&, math::View& v) { v.eye_m.x = 1e300; }), code(Error::too_far)));
    CHECK(starts(refusal([&](CascadeConfig&, math::View& v) { v.eye_m.x = 1e14; }), code(Error::too_far)));
    CHECK(refusal([&](CascadeConfig&, math::View& v) { v.eye_m.x = 1e7; }) == "placed");
}

/// Any bits at all in every number of a configuration and a camera.
auto hostile() {
    return [](Choices& choices) {
        auto const any = [&] {
            auto const wild = any_float<double>().with_nan().with_inf();
            return choices.draw(3) == 0 ? element_of({0.0, 1.0, 1e300, 1e-300, 1e7, 0x1p60})(choices) : wild(choices);
        };
        auto const mostly = [&](double x) { return choices.draw(7) != 7 ? x : any(); };
        auto const vector = [&](double x, double y, double z) {
            double const a = mostly(x);
            double const b = mostly(y);
            double const c = mostly(z);
            return math::dvec3(a, b, c);
        };
        Scenario s;
        s.camera = camera_at(math::dvec3(0.0), {0.0, 0.0, -1.0});
        s.camera.eye_m = vector(1.0, 2.0, 3.0);
        s.camera.right = vector(1.0, 0.0, 0.0);
        s.camera.window.left = mostly(-1.0);
        s.camera.window.top = mostly(1.0);
        s.camera.near_m = mostly(0.1);
        s.config.direction = vector(0.3, -1.0, 0.2);
        s.config.up = vector(0.0, 1.0, 0.0);
        s.config.anchor_m = vector(0.0, 0.0, 0.0);
        s.config.splits.far_m = mostly(200.0);
        s.config.splits.lambda = mostly(0.5);
        s.config.splits.count = choices.draw(7) != 7 ? 4 : static_cast<std::uint32_t>(choices.draw(0xFFFFFFFF));
        auto const number = [&](int x) {
            return choices.draw(15) != 15
                       ? x
                       : static_cast<std::int32_t>(static_cast<std::uint32_t>(choices.draw(0xFFFFFFFF)));
        };
        s.config.fit.size_px = number(512);
        s.config.fit.guard_px = number(8);
        s.config.fit.filter_px = number(2);
        s.config.fit.texel_steps = static_cast<std::uint32_t>(number(8));
        s.config.fit.hold = mostly(0.1);
        s.config.fit.depth.codes = number(65535);
        s.config.fit.depth.length_m = mostly(1000.0);
        s.config.fit.depth.guard_m = mostly(50.0);
        if (choices.draw(3) == 3) s.config.fit.depth.range = DepthRange::scene_bounds;
        s.config.fit.depth.scene_lo_m = vector(-1.0, -1.0, -1.0);
        s.config.fit.depth.scene_hi_m = vector(9.0, 9.0, 9.0);
        s.config.fit.extent = choices.draw(1) != 0 ? Extent::sphere : Extent::diameter;
        return s;
    };
}

TEST_CASE("any numbers are refused, or give places within reach and units that are lengths", "[cascades][errors]") {
    int placed = 0;
    for_all(cases(4000), hostile(), [&](Scenario const& s) {
        Cascades state;
        auto frame = cascade::plan(state, s.config, s.camera);
        if (!frame) {
            CHECK(!frame.failure().message.empty());
            return;
        }
        ++placed;
        cascade::commit(state, *frame);
        auto const again = cascade::plan(state, s.config, s.camera);
        REQUIRE(again);
        for (std::uint32_t k = 0; k < frame->count; ++k) {
            Volume const& v = frame->cascades[k].volume;
            CHECK((v.texel_m > 0.0 && v.texel_m < 1e13 && v.depth_unit_m > 0.0 && v.depth_unit_m < 1e13));
            for (std::int64_t const n : {v.at.x, v.at.y, v.at.z})
                CHECK((n < 2 * cascade::max_light_units && n > -2 * cascade::max_light_units));
            CHECK(again->cascades[k].update.action == Action::keep);
        }
    });
    CHECK((placed > 200 && placed < 3800));
}

}  // namespace placing_cascades

}  // namespace
