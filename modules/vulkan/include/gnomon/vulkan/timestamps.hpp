#pragma once
// How long the stages of a frame took on the device, by its own clock.

#include <gnomon/vulkan/frame.hpp>
#include <gnomon/vulkan/gpu.hpp>

#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

namespace gnomon::vulkan {

struct StageMs {
    std::string_view name;
    double ms = 0.0;
};

/// From one tick count to a later one of a clock that has `valid_bits` and wraps.
[[nodiscard]] constexpr double ms_between(std::uint64_t begin, std::uint64_t end, std::uint32_t valid_bits,
                                          float period_ns) noexcept {
    std::uint64_t const mask = valid_bits >= 64 ? ~std::uint64_t{0} : (std::uint64_t{1} << valid_bits) - 1;
    return static_cast<double>((end - begin) & mask) * static_cast<double>(period_ns) * 1e-6;
}

/// Times stages: each lasts to the next one, the last to `end_frame`. One without a name is not told of.
///
/// A queue without timestamps gives no stages; everything else works. Query pools are added when a frame has more stages
/// than any before, and kept.
class StageTimer {
  public:
    /// expects: `frames` in flight at least 1.
    StageTimer(GpuRef gpu, std::uint32_t frames) : gpu_(std::move(gpu)), slots_(frames) {}

    [[nodiscard]] bool has_clock() const noexcept { return gpu_->timestamp_bits != 0; }

    [[nodiscard]] Result<core::Done> begin_frame(FrameCount const& count);
    /// Outside of a pass. Names are kept as they are: they outlive the reading.
    [[nodiscard]] Result<core::Done> stage(VkCommandBuffer commands, std::string_view name);
    /// Ends the last stage.
    [[nodiscard]] Result<core::Done> end_frame(VkCommandBuffer commands);
    /// The stages of the frame in order, once it has finished and until its place is used again; never waits.
    ///
    /// returns: `bad_argument` when the frame is not known to have finished or was overwritten. The span holds until the
    ///          next call.
    [[nodiscard]] Result<std::span<StageMs const>> times(std::uint64_t frame, std::uint64_t finished);

  private:
    static constexpr std::uint32_t pool_queries = 64;

    struct Slot {
        std::vector<UniqueQueryPool> pools;
        std::vector<std::string_view> names;
        std::uint32_t written = 0;
        std::uint64_t frame = 0;
    };

    [[nodiscard]] Result<core::Done> write(VkCommandBuffer commands);
    [[nodiscard]] Result<core::Done> add_pool(Slot& slot);
    [[nodiscard]] Result<core::Done> read_ticks(Slot const& slot);

    GpuRef gpu_;
    std::vector<Slot> slots_;
    std::uint32_t now_ = 0;
    std::vector<std::uint64_t> ticks_;
    std::vector<StageMs> times_;
};

}  // namespace gnomon::vulkan
