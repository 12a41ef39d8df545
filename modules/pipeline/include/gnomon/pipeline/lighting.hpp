#pragma once
// Many lights on one frame: techniques that shade the same samples under the same lights, each finding for itself which
// lights to evaluate where.
//
// All of them sum a sample's lights in ascending order, and a light beyond its range adds +0 (lights/shade.hpp), so the
// image depends on the G-buffer's format only: one technique's differs from another's by no bit.

#include <gnomon/backend/verbs.hpp>
#include <gnomon/core/executor.hpp>
#include <gnomon/pipeline/error.hpp>
#include <gnomon/pipeline/frame.hpp>
#include <gnomon/pipeline/image.hpp>
#include <gnomon/pipeline/technique.hpp>

#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

namespace gnomon::pipeline {

/// All that a lighting technique is given.
struct LightingRun {
    Frame const& frame;  ///< Its own light means nothing here.
    std::span<Light const> lights;
    Params const& params;
    Workspace& workspace;
    backend::Backend& device;    ///< Runs the kernels.
    core::ExecutorRef executor;  ///< For what the host does: clusters and assignment.
};

/// What a lighting technique gives: per sample and in total.
struct LightingOutput {
    std::vector<math::vec3> radiance;         ///< Linear, one per sample.
    std::vector<std::uint32_t> computations;  ///< Lights evaluated, one per sample.
    std::vector<StageTime> stages;            ///< In order; their sum is the run's time.
    std::vector<Count> counts;                ///< `lighting_computations`, `light_pairs`, `clusters` ...
    std::vector<Count> bytes;
};

struct LightingTechnique {
    std::string_view name;
    std::string_view summary;  ///< One line.
    std::span<ParamInfo const> params;
    Result<LightingOutput> (*run)(LightingRun const& on);
};

/// Every lighting technique there is.
[[nodiscard]] std::span<LightingTechnique const> lighting_techniques() noexcept;

/// returns: the technique, or a failure that names the unknown one and lists those that exist.
[[nodiscard]] Result<LightingTechnique const*> find_lighting_technique(std::string_view name);

/// As for a shadow technique.
[[nodiscard]] Result<Params> make_params(LightingTechnique const& technique, std::span<Setting const> settings = {});

struct TransparencyConfig {
    std::int32_t tile_px = 32;
    bool clusters = false;  ///< Lights by cluster; else by tile, behind nothing opaque of the tile.
    bool nearest = true;    ///< By tile: and not before the tile's nearest transparent surface, for a pass of depth more.
};

/// An image with its transparent surfaces, one entry per pixel.
struct TransparentOutput {
    std::vector<math::vec3> image;            ///< Linear; the background gives nothing.
    std::vector<std::uint32_t> computations;  ///< Lights evaluated for transparent surfaces.
    std::vector<StageTime> stages;
    std::vector<Count> counts;  ///< `lighting_computations`, `light_pairs`, `lists`, `transparent_triangles`.
};

/// Shades the frame's BLEND surfaces, triangles back to front, under lights found as for the opaque ones, over the image
/// that any technique gave.
///
/// source:  [Olsson 2014, Paper I, 4 and 6.3]
/// expects: a frame that leaves blended surfaces out; `radiance` of its samples. `on.params` is not read.
/// returns: where triangles cut each other, the farther centre is behind: as sorting by triangle does.
[[nodiscard]] Result<TransparentOutput> shade_transparent(LightingRun const& on, std::span<math::vec3 const> radiance,
                                                          TransparencyConfig const& config = {});

struct AntialiasConfig {
    std::int32_t tile_px = 32;
    /// Off: each triangle that a pixel's samples show is shaded once, at the pixel's centre, as multisampled forward
    /// shading does. On: where the four samples show one triangle, once; else each sample at its own place, as deferred
    /// shading can that looks at its samples.
    bool edges_only = false;
};

/// An image of four samples a pixel, one entry per pixel.
struct AntialiasedOutput {
    std::vector<math::vec3> image;  ///< Linear, the mean of the samples; the background gives nothing.
    std::vector<StageTime> stages;
    std::vector<Count> counts;  ///< `lighting_computations`, `light_pairs`, `lists`.
};

/// Draws the frame's view with four samples a pixel, at Vulkan's standard positions, and shades it under the lights of tiles.
///
/// Coverage and depth are each sample's own: four array layers, drawn in one pass where the device can. No hardware
/// multisampling, so that every backend gives the same samples.
///
/// source:  [Olsson 2014, Paper I, 2.1 and 3.1]
[[nodiscard]] Result<AntialiasedOutput> shade_antialiased(LightingRun const& on, AntialiasConfig const& config = {});

/// The exposure that suits an image: its brighter samples become white paper.
[[nodiscard]] float pick_exposure(std::span<math::vec3 const> radiance);

/// The picture of a lit frame: tone mapped, sRGB; the background is black.
[[nodiscard]] Image lit_picture(Frame const& frame, std::span<math::vec3 const> radiance, float exposure);

/// Black at 0, then blue, green, yellow, red at fifths, white at 1. Linear.
[[nodiscard]] math::vec3 heat_color(float share) noexcept;

/// Lighting computations per pixel as `heat_color` of their share of `most`.
[[nodiscard]] Image heat_map(Frame const& frame, std::span<std::uint32_t const> computations, std::uint32_t most);

}  // namespace gnomon::pipeline
