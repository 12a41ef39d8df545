#pragma once
// Cameras, configurations and an exact light space, for the tests of where maps are placed.

#include <gnomon/cascade/cascades.hpp>
#include <gnomon/check/check.hpp>
#include <gnomon/math/generators.hpp>

#include <cstdint>
#include <string>

namespace placing {

using namespace gnomon;
using namespace gnomon::check;
using cascade::CascadeConfig;
using cascade::CascadeFrame;
using cascade::Cascades;
using cascade::Extent;
using cascade::Volume;

__extension__ typedef __float128 Real;
struct RealPoint {
    Real at[3];
};

/// Corner `i` of a sub-frustum in light space, from the camera's doubles without any rounding that matters here.
inline RealPoint corner_in_light(math::View const& camera, cascade::DepthInterval const& depths, CascadeFrame const& frame,
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

inline CascadeConfig ordinary() {
    CascadeConfig config;
    config.splits.far_m = 200.0;
    return config;
}

inline math::View camera_at(math::dvec3 const& eye_m, math::dvec3 const& direction, double fov_y_rad = 1.0) {
    math::PerspectiveConfig config;
    config.eye_m = eye_m;
    config.target_m = eye_m + direction;
    config.fov_y_rad = fov_y_rad;
    config.size_px = {1280, 720};
    return math::make_perspective(config).value();
}

inline auto configs() {
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

inline std::string check_string(Scenario const& s) {
    return check_string(s.camera) + " size " + std::to_string(s.config.fit.size_px) + " filter " +
           std::to_string(s.config.fit.filter_px) + " guard " + std::to_string(s.config.fit.guard_px) + " codes " +
           std::to_string(s.config.fit.depth.codes);
}

inline auto scenarios() {
    return [](Choices& choices) {
        Scenario s{configs()(choices), math::views()(choices)};
        s.config.splits.far_m = s.camera.near_m * element_of({50.0, 1.7, 4000.0})(choices);
        if (choices.draw(1) != 0) s.config.anchor_m = s.camera.eye_m + math::dvec3(100.0, -20.0, 3.0);
        return s;
    };
}

/// How many corners lie outside of the map, less its filter's margin, or of its codes.
inline int corners_outside(Scenario const& s, CascadeFrame const& frame) {
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

}  // namespace placing
