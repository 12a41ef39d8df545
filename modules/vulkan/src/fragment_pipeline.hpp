#pragma once
// Pipelines that shade: a fragment kernel behind the vertex shader that pulls its corners, which knows each triangle's id.

#include <gnomon/backend/fragment.hpp>
#include <gnomon/vulkan/pass_pipelines.hpp>

#include "fragment_set.hpp"

#include <array>

namespace gnomon::vulkan {

class FragmentPipeline {
  public:
    FragmentPipeline() noexcept = default;

    /// expects: the kernel outlives the pipeline.
    /// returns: the pipeline, what `FragmentSet::make` says, or `missing_feature` where the device cannot blend float colours.
    [[nodiscard]] static Result<FragmentPipeline> make(PassPipelinesRef const& passes, backend::FragmentKernel const& kernel);

    /// The pipeline of a way to blend, made when first asked for.
    [[nodiscard]] Result<VkPipeline> get(backend::Blend blend);
    [[nodiscard]] VkPipelineLayout layout() const noexcept { return set_.layout(); }
    /// Binds the kernel's set and pushes its constants. Set 0 is the draw list's.
    [[nodiscard]] Result<core::Done> bind(VkCommandBuffer commands, DescriptorRing& sets, FragmentInputs const& inputs) const {
        return set_.bind(commands, sets, inputs);
    }

  private:
    PassPipelinesRef passes_;
    detail::FragmentSet set_;
    std::array<UniquePipeline, 2> pipelines_;
};

}  // namespace gnomon::vulkan
