#include <gnomon/cascade/cascades.hpp>
#include <gnomon/cascade/view.hpp>
#include <gnomon/check/check.hpp>
#include <gnomon/math/generators.hpp>

#include <cmath>
#include <cstdint>
#include <limits>
#include <string>

namespace {

namespace placing {

using namespace gnomon;
using namespace gnomon::check;
using cascade::Action;
using cascade::CascadeConfig;
using cascade::CascadeFrame;
using cascade::Cascades;
using cascade::DepthRange;
using cascade::Extent;
using cascade::Place;
using cascade::Reason;
using cascade::Volume;

__extension__ typedef __float128 Real;
struct RealPoint {
    Real at[3];
};

/// Corner `i` of a sub-frustum in light space, from the camera's doubles without any rounding that matters here.
RealPoint corner_in_light(math::View const& camera, cascade::DepthInterval const& depths, CascadeFrame const& frame,
                          unsigned i) {
    Real const depth = (i & 4U) != 0 ? depths.end_m : depths.begin_m;
    Real const scale = camera.lens == math::Lens::orthographic ? Real{1} : depth;
    Real const x = static_cast<Real>((i & 1U) != 0 ? camera.window.right : camera.window.left) * scale;
    Real const y = static_cast<Real>((i & 2U) != 0 ? camera.window.top : camera.window.bottom) * scale;
    Real p[3];
    for (math::axis_t a = 0; a < 3; ++a)
        p[a] = static_cast<Real>(camera.eye_m[a]) - static_cast<Real>(frame.anchor_m[a]) +
               static_cast<Real>(camera.right[a]) * x + static_cast<Real>(camera.up[a]) * y -
               static_cast<Real>(camera.back[a]) * depth;
    math::dvec3 const axes[3] = {frame.light.right, frame.light.down, frame.light.away};
    RealPoint out{};
    for (int k = 0; k < 3; ++k)
        for (math::axis_t a = 0; a < 3; ++a) out.at[k] += static_cast<Real>(axes[k][a]) * p[a];
    return out;
}

CascadeConfig ordinary() {
    CascadeConfig config;
    config.splits.far_m = 200.0;
    return config;
}

math::View camera_at(math::dvec3 const& eye_m, math::dvec3 const& direction, double fov_y_rad = 1.0) {
    math::PerspectiveConfig config;
    config.eye_m = eye_m;
    config.target_m = eye_m + direction;
    config.fov_y_rad = fov_y_rad;
    config.size_px = {1280, 720};
    return math::make_perspective(config).value();
}

auto configs() {
    return [](Choices& choices) {
        CascadeConfig config;
        config.direction = math::directions()(choices);
        config.up = math::directions()(choices);
        config.splits.count = static_cast<std::uint32_t>(integers(1, 8)(choices));
        config.splits.overlap = element_of({0.1, 0.0, 1.0})(choices);
        config.fit.filter_px = integers(0, 7)(choices);
        config.fit.guard_px = choices.draw(1) != 0 ? integers(0, 40)(choices) : 0;
        config.fit.size_px =
            2 * (config.fit.filter_px + config.fit.guard_px) + 3 + static_cast<int>(choices.draw(1000));
        config.fit.extent = choices.draw(1) != 0 ? Extent::sphere : Extent::diameter;
        config.fit.texel_steps = element_of({8U, 0U, 1U, 64U})(choices);
        config.fit.depth.codes = choices.draw(1) != 0 ? cascade::float_codes : cascade::unorm16_codes;
        config.fit.depth.length_m = element_of({1000.0, 1.0, 20000.0})(choices);
        return config;
    };
}

/// Views whose depths can be split and whose anchor is within reach.
struct Scenario {
    CascadeConfig config;
    math::View camera;
};

std::string check_string(Scenario const& s) {
    return check_string(s.camera) + " size " + std::to_string(s.config.fit.size_px) + " filter " +
           std::to_string(s.config.fit.filter_px) + " guard " + std::to_string(s.config.fit.guard_px) + " codes " +
           std::to_string(s.config.fit.depth.codes);
}

auto scenarios() {
    return [](Choices& choices) {
        Scenario s{configs()(choices), math::views()(choices)};
        s.config.splits.far_m = s.camera.near_m * element_of({50.0, 1.7, 4000.0})(choices);
        if (choices.draw(1) != 0) s.config.anchor_m = s.camera.eye_m + math::dvec3(100.0, -20.0, 3.0);
        return s;
    };
}

/// How many corners lie outside of the map, less its filter's margin, or of its codes.
int corners_outside(Scenario const& s, CascadeFrame const& frame) {
    int outside = 0;
    for (std::uint32_t k = 0; k < frame.count; ++k) {
        Volume const& v = frame.cascades[k].volume;
        for (unsigned i = 0; i < 8; ++i) {
            RealPoint const p = corner_in_light(s.camera, frame.cascades[k].depths, frame, i);
            Real const x = p.at[0] / v.texel_m;
            Real const y = p.at[1] / v.texel_m;
            Real const z = p.at[2] / v.depth_unit_m;
            std::int64_t const margin = s.config.fit.filter_px;
            bool const in = x >= v.at.x + margin && x <= v.at.x + v.size_px - margin && y >= v.at.y + margin &&
                            y <= v.at.y + v.size_px - margin && z >= v.at.z + 1 && z <= v.at.z + v.codes - 1;
            outside += in ? 0 : 1;
        }
    }
    return outside;
}

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

TEST_CASE("a map that stays while the camera moves within its guard band still holds the sub-frustum",
          "[cascades][guard]") {
    for_all(cases(200), scenarios(), integers(0, 1000), [&](Scenario const& s, int seed) {
        Cascades state;
        Scenario moving = s;
        for (int i = 0; i < 12; ++i) {
            auto const frame = cascade::plan(state, moving.config, moving.camera);
            if (!frame) return;
            CHECK(corners_outside(moving, *frame) == 0);
            cascade::commit(state, *frame);
            double const texel = frame->cascades[0].volume.texel_m;
            double const angle = static_cast<double>((seed * 31 + i * 17) % 64) / 10.0;
            moving.camera.eye_m +=
                math::dvec3(std::cos(angle), 0.3, std::sin(angle)) * (texel * static_cast<double>((seed + i) % 23));
        }
    });
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

TEST_CASE("a guard band holds the map still until the map proper leaves it", "[cascades][guard]") {
    CascadeConfig config = ordinary();
    config.fit.guard_px = 16;
    config.direction = {0.0, -1.0, 0.0};
    Cascades state;
    int scrolls = 0;
    std::int64_t proper = 0;
    double const step_m = 0.05;
    for (int i = 0; i < 500; ++i) {
        CascadeFrame const frame =
            cascade::plan(state, config, camera_at({i * step_m, 2.0, 0.0}, {0.0, 0.0, -1.0})).value();
        Place const& d = frame.cascades[1].update.shift;
        if (i != 0 && frame.cascades[1].update.action == Action::scroll) {
            ++scrolls;
            CHECK((std::abs(d.x) == 17 || std::abs(d.y) == 17 || std::abs(d.x) == 18 || std::abs(d.y) == 18));
        }
        proper += std::abs(d.x) + std::abs(d.y);
        cascade::commit(state, frame);
    }
    double const texels = 500 * step_m / state.held[1].volume.texel_m;
    CHECK(scrolls > 0);
    CHECK(scrolls <= static_cast<int>(texels / 17.0) + 1);
    CHECK(static_cast<double>(proper) >= texels - 18.0);
}

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
                auto const in_light = cascade::try_box_in_light(frame->light, v, box, eye_m - frame->anchor_m);
                if (!in_light) return;
                bool outside = false;
                for (math::Plane const& plane : planes) outside = outside || math::surely_outside(plane, box);
                bool const covers = in_light->x0 < in_light->x1 && in_light->y0 < in_light->y1;
                if (covers && cascade::may_cast(v, *in_light)) CHECK_FALSE(outside);
                cascade::LightBox const wide{in_light->x0 - 3, in_light->y0 - 3, in_light->z0 - 3,
                                             in_light->x1 + 3, in_light->y1 + 3, in_light->z1 + 3};
                if (!cascade::may_cast(v, wide)) CHECK(outside);
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

}  // namespace placing

}  // namespace
