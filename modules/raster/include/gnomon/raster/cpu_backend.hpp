#pragma once
// The verbs of `backend::Backend` on the CPU: layered passes, sample queries, and kernels' C++ halves, over an
// executor.

#include <gnomon/backend/verbs.hpp>
#include <gnomon/core/executor.hpp>

#include <cstddef>
#include <memory>
#include <span>
#include <string_view>

namespace gnomon::raster {

/// Verbs run when they are called: `finish` has nothing to wait for, and a stage's time is the clock's from `stage` to
/// the next `stage` or `finish`, what the caller does in between included.
///
/// Images are those of `layered_pass`, bit for bit, and so the same for any executor. What a kept list's draws point to
/// is read where it lies; alpha tests without a map get one. Nothing is allocated by `draw`, `draw_ortho`, `write_depth`, `count_samples`, `run`,
/// `write`, `copy`, `read`, `stage` and `finish` once the same calls were made before.
class CpuBackend final : public backend::Backend {
  public:
    /// expects: the executor outlives the backend, or the next `use`.
    explicit CpuBackend(core::ExecutorRef executor);
    ~CpuBackend() override;

    /// Runs on another executor from here on.
    void use(core::ExecutorRef executor) noexcept;
    /// How many lists, targets and buffers live.
    [[nodiscard]] std::size_t live() const noexcept;

    [[nodiscard]] std::string_view name() const noexcept override;
    [[nodiscard]] backend::Limits limits() const noexcept override;

    backend::Result<backend::DrawListId> keep(std::span<backend::Draw const> draws) override;
    backend::Result<backend::TargetId> make_target(backend::TargetConfig const& config) override;
    backend::Result<backend::BufferId> make_buffer(std::size_t bytes) override;
    backend::Result<backend::Done> release(backend::DrawListId list) override;
    backend::Result<backend::Done> release(backend::TargetId target) override;
    backend::Result<backend::Done> release(backend::BufferId buffer) override;

    void stage(std::string_view name) override;
    backend::Result<backend::Done> write(backend::BufferId buffer, std::size_t offset,
                                         std::span<std::byte const> bytes) override;
    /// returns: counts whose `draw_calls` is one for each draw and layer that takes it.
    backend::Result<backend::PassCounts> draw(backend::DrawListId list, backend::TargetId target,
                                              std::span<backend::PassLayer const> layers) override;
    backend::Result<backend::PassCounts> shade(backend::DrawListId list, backend::TargetId target,
                                               backend::PassLayer const& layer, backend::FragmentKernel const& kernel,
                                               backend::FragmentCall const& call) override;
    backend::Result<backend::PassCounts> draw_ortho(backend::DrawListId list, backend::TargetId target,
                                                    std::span<backend::OrthoLayer const> layers) override;
    backend::Result<backend::Done> write_depth(backend::DepthKernel const& kernel,
                                               backend::DepthCall const& call) override;
    /// Exact: a sample counts once, however many faces pass there. See `count_samples_passing`.
    backend::Result<backend::Done> count_samples(std::span<math::Aabb const> boxes, backend::TargetId target,
                                                 backend::PassLayer const& view, backend::BufferId counts,
                                                 std::size_t first) override;
    backend::Result<backend::Done> run(backend::Kernel const& kernel, backend::KernelCall const& call) override;
    backend::Result<backend::Done> copy(backend::TargetPart const& from, backend::TargetId to, std::uint32_t layer,
                                        math::ivec2 const& at) override;
    backend::Result<backend::Done> read(backend::BufferId buffer, std::size_t offset,
                                        std::span<std::byte> out) override;
    backend::Result<backend::Done> read(backend::TargetPart const& part, std::span<std::byte> out) override;
    backend::Result<std::span<backend::StageTime const>> finish() override;

  private:
    struct State;
    std::unique_ptr<State> state_;
};

}  // namespace gnomon::raster
