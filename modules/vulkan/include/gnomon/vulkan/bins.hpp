#pragma once
// Lists of items per bin, in the items' own order: lights per cluster, triangles per tile. No atomics, so the lists are
// the same in every run, on every device, and the CPU's.

#include <gnomon/vulkan/scan.hpp>

#include <cstdint>

namespace gnomon::vulkan {

inline constexpr std::uint32_t max_bins = 1U << 24U;

/// Buffers of 32-bit numbers, of usage storage buffer.
struct BinCall {
    std::uint32_t count = 0;     ///< Items.
    std::uint32_t bins = 0;
    std::uint32_t capacity = 0;  ///< Of the list; what is beyond is not written.
    VkDescriptorBufferInfo bin_of_item{};  ///< Any number that is no bin: the item is in no list.
    VkDescriptorBufferInfo begins{};  ///< bins + 1 numbers: list b is [begins[b], begins[b + 1]); the last is what is needed.
    VkDescriptorBufferInfo list{};    ///< Items.
};

/// Stable radix sort by bin, four bits at a time, through the scan.
///
/// cost: for every four bits of `bins`, six dispatches; two reads and a write of each item and of 16 counts a tile
class BinLists {
  public:
    BinLists() noexcept = default;

    /// returns: the kernels and their scratch, 16 bytes an item and 64 a tile of 1024; `too_large` beyond the scan's.
    [[nodiscard]] static Result<BinLists> make(GpuRef const& gpu, std::uint32_t max_items);

    /// Orders itself after what was recorded before; what comes after is the caller's to order.
    [[nodiscard]] Result<core::Done> record(VkCommandBuffer commands, DescriptorRing& sets, BinCall const& call) const;

  private:
    /// The pass by the bits from `shift` on: pairs go from `from` to `to`.
    [[nodiscard]] Result<core::Done> sort(VkCommandBuffer commands, DescriptorRing& sets, BinCall const& call,
                                          std::uint32_t shift) const;
    /// The pairs after `passes`.
    [[nodiscard]] VkDescriptorBufferInfo pairs(std::uint32_t passes) const noexcept;

    GpuRef gpu_;
    Scan scan_;
    ComputeKernel count_;
    ComputeKernel scatter_;
    ComputeKernel lists_;
    Buffer pairs_[2];
    Buffer counts_;
    Buffer total_;
    std::uint32_t max_items_ = 0;
};

}  // namespace gnomon::vulkan
