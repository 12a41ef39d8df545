#pragma once
// The truth's definition once more, brute force in big integers: what decides where two implementations differ.

#include "exact_oracle.hpp"

#include <gnomon/pipeline/frame.hpp>
#include <gnomon/scene/flatten.hpp>

#include <array>
#include <cstddef>

namespace truth {

[[nodiscard]] inline oracle::Point as_point(gnomon::math::vec3 const& v) { return {v.x, v.y, v.z}; }

[[nodiscard]] inline std::array<oracle::Point, 3> corners_of(gnomon::scene::Geometry const& geometry, std::size_t triangle) {
    auto const corner = [&](std::size_t i) { return as_point(geometry.positions[geometry.indices[3 * triangle + i]]); };
    return {corner(0), corner(1), corner(2)};
}

/// Whether sample `i` is lit: its own plane does not strictly separate eye and light, and no other triangle blocks the
/// open segment to the light. For opaque scenes.
///
/// cost: O(triangles), microseconds each: for a handful of samples.
[[nodiscard]] inline bool oracle_lit(gnomon::pipeline::Frame const& frame, std::size_t i) {
    gnomon::scene::Geometry const& geometry = *frame.geometry;
    bool const sun = frame.light.kind == gnomon::pipeline::LightKind::directional;
    oracle::Point const light = as_point(sun ? frame.to_light : frame.light_position);
    oracle::Point const eye = as_point(gnomon::math::to_float(frame.view.eye_m - geometry.origin_m));
    oracle::Point const sample = as_point(frame.samples.position[i]);
    std::size_t const own = frame.samples.triangle[i];
    auto const t = corners_of(geometry, own);
    if (oracle::orient3d(t[0], t[1], t[2], eye) * oracle::orient3d(t[0], t[1], t[2], light, sun) < 0) return false;
    for (std::size_t triangle = 0; triangle < geometry.indices.size() / 3; ++triangle)
        if (triangle != own && oracle::blocks(sample, light, sun, corners_of(geometry, triangle))) return false;
    return true;
}

/// Whether the sample's own plane strictly separates eye and light: in shadow before any ray is cast.
[[nodiscard]] inline bool oracle_faces_away(gnomon::pipeline::Frame const& frame, std::size_t i) {
    gnomon::scene::Geometry const& geometry = *frame.geometry;
    bool const sun = frame.light.kind == gnomon::pipeline::LightKind::directional;
    auto const t = corners_of(geometry, frame.samples.triangle[i]);
    oracle::Point const eye = as_point(gnomon::math::to_float(frame.view.eye_m - geometry.origin_m));
    oracle::Point const light = as_point(sun ? frame.to_light : frame.light_position);
    return oracle::orient3d(t[0], t[1], t[2], eye) * oracle::orient3d(t[0], t[1], t[2], light, sun) < 0;
}

}  // namespace truth
