#pragma once
// What vulkan::Backend holds: resources by id, and the frame that is being recorded.

#include <gnomon/vulkan/backend.hpp>

#include <gnomon/backend/check.hpp>
#include <gnomon/backend/slots.hpp>
#include <gnomon/vulkan/barrier.hpp>
#include <gnomon/vulkan/kernel.hpp>
#include <gnomon/vulkan/ortho.hpp>
#include <gnomon/vulkan/pass.hpp>
#include <gnomon/vulkan/queries.hpp>
#include <gnomon/vulkan/read_back.hpp>
#include <gnomon/vulkan/staging.hpp>
#include <gnomon/vulkan/timestamps.hpp>

#include "depth_pipeline.hpp"
#include "fragment_pipeline.hpp"

#include <optional>
#include <vector>

namespace gnomon::vulkan {

struct KeptBuffer {
    Buffer buffer;
    std::size_t bytes = 0;  ///< As asked for; the memory is a multiple of 4.
    Touched touched;
};

/// A kernel is known by its address.
struct CompiledKernel {
    backend::Kernel const* kernel = nullptr;
    ComputeKernel compute;
};

struct CompiledDepthKernel {
    backend::DepthKernel const* kernel = nullptr;
    DepthPipeline pipeline;
};

struct CompiledFragmentKernel {
    backend::FragmentKernel const* kernel = nullptr;
    FragmentPipeline pipeline;
};

/// A copy to the host that is filled into `out` when the frame has finished.
struct PendingRead {
    std::span<std::byte> out;
    HostSlice slice;
};

/// The resources of a kernel's call, in its order; what is beyond is null.
struct Bindings {
    KeptBuffer* buffers[backend::max_kernel_buffers] = {};
    VkDescriptorBufferInfo infos[backend::max_kernel_buffers] = {};
    Target* targets[backend::max_kernel_targets] = {};
    VkDescriptorImageInfo images[backend::max_kernel_targets] = {};
};

struct Backend::State {
    State(GpuRef device, Host const& owner);

    /// The frame's command buffer; begins the frame if there is none.
    [[nodiscard]] Result<VkCommandBuffer> commands();
    /// Submits and waits. Afterwards there is no frame.
    [[nodiscard]] Result<core::Done> submit();
    /// Ends the frame's recording: everything written is made visible to the host.
    [[nodiscard]] Result<core::Done> close(VkCommandBuffer commands);
    /// Copies what was read back to where it was asked for.
    [[nodiscard]] Result<core::Done> deliver();
    [[nodiscard]] Result<core::Done> collect_times();
    /// Keeps a failure that ends the backend.
    core::Failure<Error> end(core::Failure<Error> failure);
    [[nodiscard]] Result<ComputeKernel const*> compiled(backend::Kernel const& kernel);
    [[nodiscard]] Result<FragmentPipeline*> compiled(backend::FragmentKernel const& kernel);
    [[nodiscard]] Result<DepthPipeline*> compiled(backend::DepthKernel const& kernel);
    /// Looks up what a call of `verb` names.
    ///
    /// expects: no more than a kernel may have: the call is checked.
    /// returns: which id is unknown, or which plane a target has not.
    [[nodiscard]] backend::Result<core::Done> find(std::string_view verb, std::span<backend::BufferId const> wanted_buffers,
                                                   std::span<backend::TargetBinding const> wanted_targets, Bindings& out);
    /// Made when the first list is kept.
    [[nodiscard]] Result<PassPipelinesRef> passes();
    /// Made when the first samples are counted.
    [[nodiscard]] Result<SampleQueries*> counting();
    /// Made when the first pass in whole units is drawn.
    [[nodiscard]] Result<OrthoPipelines*> ortho();
    /// A slice to read back into, and the promise to do so.
    [[nodiscard]] Result<HostSlice> take_read(std::span<std::byte> out);
    /// Destroyed at once where nothing is recorded, else when the frame has finished.
    template <class T>
    void retire(T& resource, std::vector<T>& retired) {
        if (open != VK_NULL_HANDLE) retired.push_back(std::move(resource));
    }

    GpuRef gpu;
    Host host;
    VkCommandBuffer open = VK_NULL_HANDLE;
    FrameCount count;
    Order order;
    Staging uploads;
    Staging downloads;
    DescriptorRing sets;
    StageTimer timer;
    std::optional<core::Failure<Error>> ended;
    std::optional<core::Failure<Error>> stage_failure;

    PassPipelinesRef pass_pipelines;
    std::optional<SampleQueries> queries;
    std::uint32_t loop_rounds = 0;  ///< backend::Limits
    OrthoPipelinesConfig ortho_config;
    std::optional<OrthoPipelines> ortho_pipelines;
    backend::Slots<backend::DrawListId, DrawList> lists;
    backend::Slots<backend::TargetId, Target> targets;
    backend::Slots<backend::BufferId, KeptBuffer> buffers;
    std::vector<CompiledKernel> kernels;
    std::vector<CompiledFragmentKernel> fragment_kernels;
    std::vector<CompiledDepthKernel> depth_kernels;
    std::vector<PendingRead> reads;
    std::vector<backend::DrawListId> uploading;  ///< Kept in this frame: their staging goes when it has finished.
    std::vector<DrawList> retired_lists;
    std::vector<Target> retired_targets;
    std::vector<KeptBuffer> retired_buffers;
    std::vector<backend::StageTime> times;
};

[[nodiscard]] inline core::Failure<backend::Error> a_million_live(std::string_view verb) {
    return {backend::Error::out_of_memory, std::string(verb) + ": a million things live: release some"};
}

/// The image of a target's plane.
struct PlaneImage {
    VkImage image = VK_NULL_HANDLE;
    VkImageView view = VK_NULL_HANDLE;
    VkImageAspectFlags aspect = 0;
};
[[nodiscard]] inline PlaneImage image_of(Target const& target, backend::Plane plane) noexcept {
    if (plane == backend::Plane::triangle)
        return {target.triangle_image(), target.triangle_view(), VK_IMAGE_ASPECT_COLOR_BIT};
    if (plane == backend::Plane::color) return {target.color_image(), target.color_view(), VK_IMAGE_ASPECT_COLOR_BIT};
    return {target.depth_image(), target.depth_view(), VK_IMAGE_ASPECT_DEPTH_BIT};
}

}  // namespace gnomon::vulkan
