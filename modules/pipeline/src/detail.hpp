#pragma once
// What the pipeline's sources share among themselves.

#include <gnomon/core/executor.hpp>
#include <gnomon/pipeline/frame.hpp>
#include <gnomon/pipeline/lighting.hpp>
#include <gnomon/pipeline/technique.hpp>
#include <gnomon/raster/alpha_map.hpp>
#include <gnomon/raster/draw.hpp>
#include <gnomon/raster/pass.hpp>

#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <numbers>
#include <span>
#include <vector>

namespace gnomon::pipeline {

/// Items of a per-sample loop that one task takes.
inline constexpr std::size_t sample_grain = 4096;

/// Milliseconds since it was made or last asked.
class Stopwatch {
  public:
    [[nodiscard]] double lap_ms() {
        auto const now = std::chrono::steady_clock::now();
        double const ms = std::chrono::duration<double, std::milli>(now - last_).count();
        last_ = now;
        return ms;
    }

  private:
    std::chrono::steady_clock::time_point last_ = std::chrono::steady_clock::now();
};

/// Whether two directions of any length are at most a small angle apart: by the chord, which is nearly the angle.
[[nodiscard]] inline bool turned_at_most(math::dvec3 const& a, math::dvec3 const& b, double degrees) {
    return glm::length(glm::normalize(a) - glm::normalize(b)) <= degrees * (std::numbers::pi / 180.0);
}

/// The draws of a frame's geometry. Solid triangles go in as few as possible, masked ones by their texture.
struct DrawList {
    std::vector<raster::AlphaTest> alpha_tests;       ///< Pointed to by `draws`; filled first.
    std::deque<raster::AlphaMap> alpha_maps;          ///< Pointed to by `alpha_tests`; one for each that differs.
    std::vector<std::vector<std::uint32_t>> rebased;  ///< Indices of draws that use few of the vertices.
    std::vector<raster::Draw> draws;

    /// The same triangles for another view.
    void look_from(math::View const& view, math::dvec3 const& origin_m);
};

/// Whether surfaces that blend are drawn: those without an alpha mode of BLEND always are.
enum class Blended : std::uint8_t {
    as_masked,  ///< Solid where their alpha is at least one half.
    left_out,
};

/// Which way of facing is left out; triangles of double-sided materials never are.
[[nodiscard]] DrawList make_draws(scene::Scene const& scene, scene::Geometry const& geometry, raster::Cull cull,
                                  Blended blended = Blended::as_masked);

/// How a material's alpha cuts holes.
struct AlphaRule {
    bool tested = false;   ///< Otherwise all solid.
    bool nothing = false;  ///< Untextured and below the cutoff: not there at all.
    double cutoff = 0.5;
};
[[nodiscard]] AlphaRule alpha_rule(scene::Scene const& scene, scene::Material const& material) noexcept;

/// Its base colour image; null without a texture.
[[nodiscard]] scene::Texture const* base_texture(scene::Scene const& scene, scene::Material const& material) noexcept;
[[nodiscard]] scene::Image const* base_image(scene::Scene const& scene, scene::Material const& material) noexcept;

/// Unit vector from a work-space position to the frame's light.
[[nodiscard]] math::vec3 toward_light(Frame const& frame, math::vec3 const& position) noexcept;

/// One more of this name.
void add_one(std::string_view name, std::vector<Count>& counts);

/// Number of samples whose false-lit state the applied bias explains.
[[nodiscard]] std::uint64_t count_detached(Frame const& frame, TechniqueOutput const& output,
                                           core::ExecutorRef executor);

[[nodiscard]] Technique shadow_map_technique() noexcept;
[[nodiscard]] Technique shadow_map_cached_technique() noexcept;
[[nodiscard]] Technique ray_technique() noexcept;
[[nodiscard]] std::array<Technique, 3> cascade_techniques() noexcept;
[[nodiscard]] LightingTechnique deferred_technique() noexcept;
[[nodiscard]] LightingTechnique deferred_stencil_technique() noexcept;
[[nodiscard]] LightingTechnique tiled_deferred_technique() noexcept;
[[nodiscard]] LightingTechnique tiled_deferred_en_technique() noexcept;
[[nodiscard]] LightingTechnique tiled_deferred_single_technique() noexcept;
[[nodiscard]] LightingTechnique tiled_deferred_raster_technique() noexcept;
[[nodiscard]] std::span<LightingTechnique const> clustered_deferred_techniques() noexcept;
[[nodiscard]] LightingTechnique clustered_deferred_device_technique() noexcept;
[[nodiscard]] LightingTechnique forward_technique() noexcept;
[[nodiscard]] LightingTechnique tiled_forward_technique() noexcept;
[[nodiscard]] LightingTechnique tiled_forward_prez_technique() noexcept;
[[nodiscard]] LightingTechnique clustered_forward_technique() noexcept;

}  // namespace gnomon::pipeline
