#pragma once
// Camera paths: where the eye stands and looks in each frame of a film.
//
// The procedural scenes' paths are fixed, as their triangles are: the same cameras come out everywhere. Time goes with the
// frames, frame i being shown at i / rate_hz seconds, so moving objects are where they belong.

#include <gnomon/scene/flatten.hpp>
#include <gnomon/scene/procedural.hpp>

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace gnomon::scene {

struct CameraPath {
    std::string name;
    double rate_hz = 30.0;
    std::vector<Camera> frames;

    friend bool operator==(CameraPath const&, CameraPath const&) = default;
};

/// The paths of a procedural scene, the one to show first; empty for one without any, and for other names.
[[nodiscard]] std::span<PathInfo const> procedural_paths(std::string_view scene) noexcept;

/// The path of this name through the scene that `config` makes.
///
/// returns: the cameras, all upright and outside of solid things, or which value is wrong: `config` as in
///          `make_procedural`, or a path that the scene does not have (its paths are listed).
[[nodiscard]] Result<CameraPath> make_path(ProceduralConfig const& config, std::string_view path);

/// A path for geometry that brings none: once round it, at the height of `auto_view` and clear of its bounds; in an
/// interior a full turn on the spot. The last frame is followed by the first.
///
/// expects: frames > 0.
/// returns: for empty geometry a path round the origin.
/// cost:    that of `auto_view`.
[[nodiscard]] CameraPath orbit(Geometry const& geometry, std::uint32_t frames);

}  // namespace gnomon::scene
