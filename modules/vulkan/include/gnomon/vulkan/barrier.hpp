#pragma once
// The order of what is recorded. All barriers of the module but layout changes are these.

#include <gnomon/vulkan/gpu.hpp>

#include <cstdint>

namespace gnomon::vulkan {

/// Everything recorded before is done, and visible, before anything recorded after begins.
void order_all(Gpu const& gpu, VkCommandBuffer commands) noexcept;

/// Makes everything recorded before visible to the host once the submission has finished.
void order_for_host(Gpu const& gpu, VkCommandBuffer commands) noexcept;

/// When a resource was last touched, counted in barriers.
struct Touched {
    std::uint64_t read = 0;
    std::uint64_t written = 0;
};

/// Puts a barrier between two commands only where the second needs what the first did to a resource, or the other way
/// round: each command says first what it reads and writes, then calls `apply`, then is recorded.
///
///     order.reads(a); order.writes(b); order.apply(gpu, commands); vkCmdDispatch(...)
///
/// One barrier orders everything, so commands that share nothing share one.
class Order {
  public:
    void reads(Touched& resource) noexcept {
        needed_ = needed_ || resource.written == epoch_;
        add(resource, false);
    }
    void writes(Touched& resource) noexcept {
        needed_ = needed_ || resource.written == epoch_ || resource.read == epoch_;
        add(resource, true);
    }
    /// Forces a barrier, where a command touches what nobody keeps book of.
    void all() noexcept { needed_ = true; }
    /// Records the barrier if one is needed.
    void apply(Gpu const& gpu, VkCommandBuffer commands) noexcept;

    [[nodiscard]] std::uint64_t barriers() const noexcept { return epoch_ - 1; }

  private:
    static constexpr std::uint32_t max_pending = 40;

    void add(Touched& resource, bool is_write) noexcept;

    std::uint64_t epoch_ = 1;
    bool needed_ = false;
    std::uint32_t pending_ = 0;
    struct {
        Touched* resource;
        bool is_write;
    } pending_of_[max_pending];
};

}  // namespace gnomon::vulkan
