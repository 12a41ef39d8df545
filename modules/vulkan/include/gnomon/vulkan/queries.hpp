#pragma once
// Precise occlusion queries: at how many samples boxes or draws would pass the depth test, counted by the device.

#include <gnomon/backend/pass.hpp>
#include <gnomon/math/bounds.hpp>
#include <gnomon/vulkan/draws.hpp>
#include <gnomon/vulkan/target.hpp>

#include <array>
#include <cstdint>
#include <span>

namespace gnomon::vulkan {

struct SampleQueriesConfig {
    std::uint32_t capacity = 4096;  ///< Queries of one rendering; more are counted in several.
    bool f32 = true;                ///< Targets of `DepthFormat::f32`.
    bool unorm16 = true;
    bool clamp = true;  ///< `DepthRange::clamp`.
    VkPipelineCache cache = VK_NULL_HANDLE;
};

/// Where counts go: 32 bits each, in a buffer of usage TRANSFER_DST.
struct CountsOut {
    VkBuffer buffer = VK_NULL_HANDLE;
    VkDeviceSize offset = 0;  ///< A multiple of 4.
};

/// Counts against one layer of a target, which is only read: it is left in `TargetUse::count`.
///
/// A sample counts once for each triangle that passes there: a count is that of `raster::count_samples_passing` where a
/// box or draw does not pass with two surfaces at a sample, and 0 exactly where that is 0. The counts are written as by a
/// copy (VK_PIPELINE_STAGE_2_COPY_BIT): the caller orders what reads them.
class SampleQueries {
  public:
    SampleQueries() noexcept = default;

    /// returns: `missing_feature` for a device without precise occlusion queries.
    [[nodiscard]] static Result<SampleQueries> make(GpuRef const& gpu, SampleQueriesConfig const& config = {});

    /// Writes the count of box i, both sides of its faces drawn, to place i. `view.load` and `view.groups` are not
    /// looked at. An empty box, or one with a NaN, counts 0.
    ///
    /// Outside of a rendering. No allocation; one call a box, without memory: its corners are push constants.
    [[nodiscard]] Result<core::Done> record_boxes(VkCommandBuffer commands, std::span<math::Aabb const> boxes,
                                                  Target& target, backend::PassLayer const& view, CountsOut const& out);

    /// Writes the count of draw i of the list, all its instances together, to place i; 0 for draws of other groups than
    /// the view's.
    [[nodiscard]] Result<core::Done> record_draws(VkCommandBuffer commands, DrawList& draws, Target& target,
                                                  backend::PassLayer const& view, CountsOut const& out);

  private:
    [[nodiscard]] VkPipeline pipeline(backend::DepthFormat format, backend::DepthRange range) const noexcept;
    struct Batches;
    template <class Draw>
    void record_batches(VkCommandBuffer commands, Batches const& batches, Draw draw);

    GpuRef gpu_;
    std::uint32_t capacity_ = 0;
    UniqueQueryPool pool_;
    UniquePipelineLayout layout_;
    std::array<UniquePipeline, 4> pipelines_;
};

}  // namespace gnomon::vulkan
