#pragma once
// The verbs of module `backend` on the caller's Vulkan device, over the adapters of this module.

#include <gnomon/backend/verbs.hpp>
#include <gnomon/math/bounds.hpp>
#include <gnomon/vulkan/draws.hpp>
#include <gnomon/vulkan/gpu.hpp>
#include <gnomon/vulkan/ortho.hpp>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string_view>

namespace gnomon::vulkan {

/// What the backend does not do itself: command buffers, submission, waiting.
struct Host {
    void* context = nullptr;
    /// Gives a primary command buffer in the recording state, outside of a pass. Called once a frame, by its first verb.
    VkResult (*begin)(void* context, VkCommandBuffer& out) = nullptr;
    /// Ends and submits it to a queue of the device's family, and returns when it is done. Called by `finish` alone.
    VkResult (*submit_and_wait)(void* context, VkCommandBuffer commands) = nullptr;
};

/// The sentence stays, the code becomes the nearest of the backend's.
[[nodiscard]] core::Failure<backend::Error> to_backend(core::Failure<Error> failure);

/// Draws, kernels, copies and reads are recorded into one command buffer a frame; `finish` ends the frame.
///
/// Memory, descriptor sets, queries and pipelines are kept: a frame that asks for what one before asked for makes no
/// Vulkan object and asks for no memory. A submission that fails, a lost device above all, ends it: every verb then
/// gives that failure again.
class Backend final : public backend::Backend {
  public:
    /// expects: the device, the host's context and the kernels that are run outlive the backend.
    [[nodiscard]] static backend::Result<std::unique_ptr<Backend>> make(GpuRef gpu, Host const& host,
                                                                       OrthoPipelinesConfig const& ortho = {});
    /// What was recorded and not finished is dropped: the host must not submit it.
    ~Backend() override;

    [[nodiscard]] std::string_view name() const noexcept override { return "vulkan"; }
    [[nodiscard]] backend::Limits limits() const noexcept override;

    backend::Result<backend::DrawListId> keep(std::span<backend::Draw const> draws) override;
    backend::Result<backend::TargetId> make_target(backend::TargetConfig const& config) override;
    backend::Result<backend::BufferId> make_buffer(std::size_t bytes) override;
    backend::Result<core::Done> release(backend::DrawListId list) override;
    backend::Result<core::Done> release(backend::TargetId target) override;
    backend::Result<core::Done> release(backend::BufferId buffer) override;

    void stage(std::string_view name) override;
    backend::Result<core::Done> write(backend::BufferId buffer, std::size_t offset,
                                      std::span<std::byte const> bytes) override;
    backend::Result<backend::PassCounts> draw(backend::DrawListId list, backend::TargetId target,
                                              std::span<backend::PassLayer const> layers) override;
    backend::Result<backend::PassCounts> shade(backend::DrawListId list, backend::TargetId target,
                                               backend::PassLayer const& layer, backend::FragmentKernel const& kernel,
                                               backend::FragmentCall const& call) override;
    backend::Result<backend::PassCounts> draw_ortho(backend::DrawListId list, backend::TargetId target,
                                                    std::span<backend::OrthoLayer const> layers) override;
    backend::Result<core::Done> write_depth(backend::DepthKernel const& kernel,
                                            backend::DepthCall const& call) override;
    backend::Result<core::Done> count_samples(std::span<math::Aabb const> boxes, backend::TargetId target,
                                              backend::PassLayer const& view, backend::BufferId counts,
                                              std::size_t first) override;
    backend::Result<core::Done> run(backend::Kernel const& kernel, backend::KernelCall const& call) override;
    backend::Result<core::Done> copy(backend::TargetPart const& from, backend::TargetId to, std::uint32_t layer,
                                     math::ivec2 const& at) override;
    backend::Result<core::Done> read(backend::BufferId buffer, std::size_t offset, std::span<std::byte> out) override;
    backend::Result<core::Done> read(backend::TargetPart const& part, std::span<std::byte> out) override;
    backend::Result<std::span<backend::StageTime const>> finish() override;

    /// What a list that lives left out when it was kept; nothing for an unknown id.
    [[nodiscard]] StagedFaults faults(backend::DrawListId list) const noexcept;
    /// Barriers between verbs over buffers recorded so far, of all frames.
    [[nodiscard]] std::uint64_t barriers() const noexcept;

    struct State;

  private:
    explicit Backend(std::unique_ptr<State> state) noexcept;
    std::unique_ptr<State> state_;
};

}  // namespace gnomon::vulkan
