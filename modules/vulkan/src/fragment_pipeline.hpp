#pragma once
// Pipelines that shade: a fragment kernel behind the vertex shader that pulls its corners, which knows each triangle's id.

#include <gnomon/backend/fragment.hpp>
#include <gnomon/vulkan/descriptors.hpp>
#include <gnomon/vulkan/pass_pipelines.hpp>

#include <array>
#include <span>
#include <string>

namespace gnomon::vulkan {

/// What a pass of a fragment kernel is given; see backend/fragment.hpp for the bindings.
struct FragmentInputs {
    std::span<VkDescriptorBufferInfo const> buffers;
    std::span<VkDescriptorImageInfo const> targets;
    std::span<std::byte const> constants;
};

class FragmentPipeline {
  public:
    FragmentPipeline() noexcept = default;

    /// Compares the shader's own words with the kernel, then makes the layouts.
    ///
    /// returns: the pipeline, or `shader_rejected` with what differs, or `missing_feature` where the device cannot blend
    ///          float colours.
    [[nodiscard]] static Result<FragmentPipeline> make(PassPipelinesRef const& passes, backend::FragmentKernel const& kernel);

    /// The pipeline of a way to blend, made when first asked for.
    [[nodiscard]] Result<VkPipeline> get(backend::Blend blend);
    [[nodiscard]] VkPipelineLayout layout() const noexcept { return layout_.get(); }
    /// Binds the kernel's set and pushes its constants. Set 0 is the draw list's.
    [[nodiscard]] Result<core::Done> bind(VkCommandBuffer commands, DescriptorRing& sets, FragmentInputs const& inputs) const;

  private:
    [[nodiscard]] Result<core::Done> make_layouts();

    PassPipelinesRef passes_;
    backend::FragmentKernel const* kernel_ = nullptr;
    UniqueSetLayout set_layout_;
    UniquePipelineLayout layout_;
    std::array<UniquePipeline, 2> pipelines_;
};

}  // namespace gnomon::vulkan
