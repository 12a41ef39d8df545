#pragma once
// Count, scan, fill: sums of all numbers before each, and lists made with them. On any device: shared memory alone, no
// subgroup operations, no atomics; the same bits as a loop.

#include <gnomon/vulkan/kernel.hpp>
#include <gnomon/vulkan/resources.hpp>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace gnomon::vulkan {

inline constexpr std::uint32_t max_scan_items = 1U << 24U;
inline constexpr std::uint32_t scan_tile_items = 1024;

/// The sum of all numbers, as a scan leaves it in a buffer: what a list needs room for.
struct ScanTotal {
    std::uint32_t low = 0;
    std::uint32_t high = 0;

    [[nodiscard]] constexpr std::uint64_t value() const noexcept { return std::uint64_t{high} << 32U | low; }
    /// Offsets from here on stand at 2^32 - 1: no list in 32 bits holds what they ask for.
    [[nodiscard]] constexpr bool overflows() const noexcept { return high != 0; }
};

/// Buffers of 32-bit numbers, of usage storage buffer.
struct ScanCall {
    std::uint32_t count = 0;
    VkDescriptorBufferInfo values{};
    VkDescriptorBufferInfo sums{};   ///< May be `values`.
    VkDescriptorBufferInfo total{};  ///< A `ScanTotal`.
};

/// Item i, `counts[i]` times, at places `offsets[i]` and on: a compaction where counts are 0 and 1.
struct FillCall {
    std::uint32_t count = 0;
    std::uint32_t capacity = 0;  ///< Of the list; what is beyond is not written, and the scan's total says what is needed.
    VkDescriptorBufferInfo counts{};
    VkDescriptorBufferInfo offsets{};
    VkDescriptorBufferInfo list{};
};

/// Exclusive scans of up to `max_items` numbers.
///
///     sums[i] = min(values[0] + ... + values[i - 1], 2^32 - 1)
///
/// source:  [Blelloch 1990] reduce, then scan, over tiles of 1024 in up to three levels
/// cost:    two reads and a write of each number; 3 dispatches up to 2^20 numbers, 5 beyond, with barriers between
class Scan {
  public:
    Scan() noexcept = default;

    /// returns: the scan with its scratch memory, 8 bytes a tile; `too_large` above `max_scan_items`.
    [[nodiscard]] static Result<Scan> make(GpuRef const& gpu, std::uint32_t max_items);

    /// Orders itself after what was recorded before; what comes after is the caller's to order. One scan's scratch
    /// serves any number of calls, one after the other on one queue.
    [[nodiscard]] Result<core::Done> record(VkCommandBuffer commands, DescriptorRing& sets, ScanCall const& call) const;
    /// The same for the list.
    [[nodiscard]] Result<core::Done> fill(VkCommandBuffer commands, DescriptorRing& sets, FillCall const& call) const;

    [[nodiscard]] std::uint32_t max_items() const noexcept { return max_items_; }

  private:
    struct Level {
        std::uint32_t count = 0;
        VkDescriptorBufferInfo values{};
        VkDescriptorBufferInfo results{};
        VkDescriptorBufferInfo totals{};  ///< Of the tiles: the numbers of the level above.
    };

    [[nodiscard]] std::uint32_t levels_of(ScanCall const& call, Level* levels) const noexcept;

    GpuRef gpu_;
    ComputeKernel sum_;
    ComputeKernel apply_;
    ComputeKernel fill_;
    Buffer scratch_;
    std::uint32_t max_items_ = 0;
};

}  // namespace gnomon::vulkan
