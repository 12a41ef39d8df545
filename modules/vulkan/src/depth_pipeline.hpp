#pragma once
// Pipelines of depth kernels: a triangle over the rectangle, and a fragment shader that gives each pixel its depth.

#include <gnomon/backend/depth_kernel.hpp>
#include <gnomon/vulkan/descriptors.hpp>
#include <gnomon/vulkan/target.hpp>

#include "fragment_set.hpp"

#include <array>

namespace gnomon::vulkan {

class DepthPipeline {
  public:
    DepthPipeline() noexcept = default;

    /// expects: the kernel outlives the pipeline.
    /// returns: the pipeline, or what `FragmentSet::make` says.
    [[nodiscard]] static Result<DepthPipeline> make(GpuRef const& gpu, backend::DepthKernel const& kernel);

    /// The pipeline of a format, made when first asked for.
    [[nodiscard]] Result<VkPipeline> get(backend::DepthFormat format);
    /// Binds the kernel's set and pushes its constants.
    [[nodiscard]] Result<core::Done> bind(VkCommandBuffer commands, DescriptorRing& sets, FragmentInputs const& inputs) const {
        return set_.bind(commands, sets, inputs);
    }
    /// Records the rendering of `rect` in one layer. What the target holds elsewhere stays; nothing, where it holds nothing.
    void draw(VkCommandBuffer commands, VkPipeline pipeline, Target& target, backend::DepthCall const& call) const;

  private:
    GpuRef gpu_;
    detail::FragmentSet set_;
    std::array<UniquePipeline, 2> pipelines_;
};

}  // namespace gnomon::vulkan
