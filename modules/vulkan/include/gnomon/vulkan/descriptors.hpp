#pragma once
// Descriptor sets that live for one frame, from pools that are reset whole.

#include <gnomon/vulkan/frame.hpp>
#include <gnomon/vulkan/gpu.hpp>

#include <cstdint>
#include <vector>

namespace gnomon::vulkan {

/// What a set takes from its pool.
struct SetSize {
    std::uint32_t storage_buffers = 0;
    std::uint32_t sampled_images = 0;
};

/// Sets for the frame that is being recorded. Pools are added when a frame needs more sets than any before, and kept.
class DescriptorRing {
  public:
    /// expects: `frames` in flight at least 1.
    DescriptorRing(GpuRef gpu, std::uint32_t frames) : gpu_(std::move(gpu)), slots_(frames) {}

    /// Takes back the sets of the frame that used this place before.
    [[nodiscard]] Result<core::Done> begin_frame(FrameCount const& count);
    /// returns: a set to be written and bound in this frame.
    [[nodiscard]] Result<VkDescriptorSet> take(VkDescriptorSetLayout layout, SetSize const& size);

  private:
    struct Pool {
        UniqueDescriptorPool handle;
        std::uint32_t sets_left = 0;
        SetSize left;
    };
    struct Slot {
        std::vector<Pool> pools;
        std::size_t current = 0;
    };

    [[nodiscard]] Result<core::Done> add_pool(Slot& slot);

    GpuRef gpu_;
    std::vector<Slot> slots_;
    std::uint32_t now_ = 0;
};

}  // namespace gnomon::vulkan
