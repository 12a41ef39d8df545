#pragma once
// Compute kernels: one invocation an item, storage buffers, targets to fetch texels from, a few constants.
//
// Set 0 holds the storage buffers at bindings 0, 1, ..., then the targets as texture2DArray or utexture2DArray; the
// constants are the push constants. The local size is 64 in x.

#include <gnomon/vulkan/descriptors.hpp>
#include <gnomon/vulkan/gpu.hpp>
#include <gnomon/vulkan/shader.hpp>

#include <vulkan/vulkan_core.h>

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>

namespace gnomon::vulkan {

inline constexpr std::uint32_t compute_local_size = 64;
inline constexpr std::uint32_t max_compute_buffers = 12;
inline constexpr std::uint32_t max_compute_targets = 4;
inline constexpr std::uint32_t max_compute_constant_bytes = 128;

struct ComputeConfig {
    std::string_view name;  ///< For the messages of failures.
    std::span<std::uint32_t const> spirv;
    std::uint32_t buffers = 0;
    std::uint32_t targets = 0;
    std::uint32_t constant_bytes = 0;  ///< A multiple of 4.
};

/// What a run works on: as many of each as the kernel has.
struct Dispatch {
    std::uint64_t items = 0;  ///< 0 records nothing.
    std::span<VkDescriptorBufferInfo const> buffers;
    std::span<VkDescriptorImageInfo const> targets;  ///< View and layout; no sampler.
    std::span<std::byte const> constants;
};

/// How many groups in x and y.
struct Grid {
    std::uint32_t x = 0;
    std::uint32_t y = 0;

    friend bool operator==(Grid const&, Grid const&) = default;
};

/// A row of groups where the device takes one of this length; else, if the shader can find its item in a grid, a grid
/// with few groups too many.
///
/// returns: `too_large` where neither holds, or 32 bits do not count the invocations.
[[nodiscard]] Result<Grid> grid_of(std::uint64_t items, VkPhysicalDeviceLimits const& limits, bool reads_group_count,
                                   std::string_view name);

class ComputeKernel {
  public:
    ComputeKernel() noexcept = default;

    /// Compares the shader's own words with the configuration, then makes layouts and pipeline.
    ///
    /// returns: the kernel, or `shader_rejected` with what differs: the group size, a binding, the constants.
    [[nodiscard]] static Result<ComputeKernel> make(GpuRef const& gpu, ComputeConfig const& config);

    /// Binds and dispatches. Barriers are the caller's: see barrier.hpp.
    ///
    /// returns: what was refused; then nothing was recorded.
    [[nodiscard]] Result<core::Done> record(VkCommandBuffer commands, DescriptorRing& sets,
                                            Dispatch const& dispatch) const;

    /// Whether the shader may write buffer `i`: false where it calls the buffer `readonly`, or knows it not.
    [[nodiscard]] bool may_write(std::uint32_t i) const noexcept { return ((written_ >> i) & 1U) != 0; }
    /// Whether it runs on more items than one row of groups has.
    [[nodiscard]] bool takes_grids() const noexcept { return takes_grids_; }

  private:
    [[nodiscard]] Result<core::Done> make_layouts();
    [[nodiscard]] Result<core::Done> make_pipeline(std::span<std::uint32_t const> spirv);
    [[nodiscard]] Result<core::Done> check(Dispatch const& dispatch) const;
    void bind(VkCommandBuffer commands, VkDescriptorSet set, Dispatch const& dispatch) const;

    GpuRef gpu_;
    std::string name_;
    UniqueSetLayout set_layout_;
    UniquePipelineLayout pipeline_layout_;
    UniquePipeline pipeline_;
    std::uint32_t buffers_ = 0;
    std::uint32_t targets_ = 0;
    std::uint32_t constant_bytes_ = 0;
    std::uint32_t written_ = 0;
    bool takes_grids_ = false;
};

}  // namespace gnomon::vulkan
