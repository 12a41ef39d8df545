#pragma once
// Passes in whole units, recorded: the images of `raster::ortho_pass`, bit for bit.
//
// Corners are rounded to 1/256 texel in double, placed on that grid exactly, and never clipped; the fragment shader finds
// each sample's code from the triangle's own corners. What the fixed functions could round, they are not asked.

#include <gnomon/backend/ortho.hpp>
#include <gnomon/vulkan/draws.hpp>
#include <gnomon/vulkan/target.hpp>

#include <array>
#include <cstdint>
#include <span>

namespace gnomon::vulkan {

struct OrthoPipelinesConfig {
    /// Whether the device finds the samples of triangles up to `OrthoPipelines::device_size_px` wide and high that lie
    /// within `reach_px` of the image's middle. Else the fragment shader finds all: slower, for a device whose edges are
    /// not exact to 1/256 pixel. Not heeded where the device says that its are coarser.
    bool edges_by_device = true;
    /// Whether the device interpolates the depths of triangles that are gentle enough for its floats to be a sixteenth of a
    /// code off at most: without a fragment shader, but each corner is found twice; codes may be one apart from the CPU's.
    /// Coverage and alpha tests are exact, and steep triangles too. Heeded with 16 bits and `DepthRange::clamp`, on
    /// devices that clamp depth and find edges.
    bool codes_by_device = false;
    VkPipelineCache cache = VK_NULL_HANDLE;  ///< The caller's, if there is one.
};

/// Pipelines of the integer passes, each made when first asked for.
class OrthoPipelines {
  public:
    OrthoPipelines() noexcept = default;

    /// returns: the pipelines, or `missing_feature` without 64-bit floats and integers in shaders.
    [[nodiscard]] static Result<OrthoPipelines> make(PassPipelinesRef const& passes, OrthoPipelinesConfig const& config = {});

    [[nodiscard]] PassPipelinesRef const& passes() const noexcept { return passes_; }
    [[nodiscard]] VkPipelineLayout layout() const noexcept { return layout_.get(); }
    /// `part` 0: for all triangles, exact. 1: for the gentle ones, by the device. 2: for the others, exact.
    [[nodiscard]] Result<VkPipeline> get(backend::DepthFormat format, bool masked, std::uint32_t part = 0);

    /// Half of what lavapipe 22.3 draws without a wrong sample: from 4096 pixels on its edge functions overflow.
    static constexpr std::int32_t device_size_px = 2048;
    /// Half the side of the viewport: a power of two, at most 8192.
    [[nodiscard]] std::int32_t reach_px() const noexcept { return reach_px_; }
    [[nodiscard]] bool edges_by_device() const noexcept { return edges_by_device_; }
    [[nodiscard]] bool codes_by_device() const noexcept { return codes_by_device_; }

  private:
    PassPipelinesRef passes_;
    VkPipelineCache cache_ = VK_NULL_HANDLE;
    UniquePipelineLayout layout_;
    std::array<UniquePipeline, 12> pipelines_;
    std::int32_t reach_px_ = 0;
    bool edges_by_device_ = false;
    bool codes_by_device_ = false;
};

/// Records the layers of a pass into `target`, one rendering each; see `record_pass` for the rest.
///
/// expects: `backend::check_layers` has passed; `draws` uploaded, and made with the pipelines' `passes()`.
/// returns: what was asked for and the calls recorded, one for each draw of each layer, two
///          where codes are the device's; or what the driver said of a new
///          pipeline: then nothing was recorded.
/// cost:    no allocation. A vertex shader of some 300 operations in double a corner, a fragment shader of some 30; a
///          triangle that is not the device's own has a fragment for each texel of its bounds, and about as many more.
[[nodiscard]] Result<backend::PassCounts> record_ortho(VkCommandBuffer commands, OrthoPipelines& pipelines, DrawList& draws,
                                                       Target& target, std::span<backend::OrthoLayer const> layers);

}  // namespace gnomon::vulkan
