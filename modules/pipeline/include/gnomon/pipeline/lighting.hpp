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

/// The exposure that suits an image: its brighter samples become white paper.
[[nodiscard]] float pick_exposure(std::span<math::vec3 const> radiance);

/// The picture of a lit frame: tone mapped, sRGB; the background is black.
[[nodiscard]] Image lit_picture(Frame const& frame, std::span<math::vec3 const> radiance, float exposure);

/// Black at 0, then blue, green, yellow, red at fifths, white at 1. Linear.
[[nodiscard]] math::vec3 heat_color(float share) noexcept;

/// Lighting computations per pixel as `heat_color` of their share of `most`.
[[nodiscard]] Image heat_map(Frame const& frame, std::span<std::uint32_t const> computations, std::uint32_t most);

}  // namespace gnomon::pipeline
