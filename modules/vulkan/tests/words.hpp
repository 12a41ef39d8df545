#pragma once
// Buffers of words that the host sees, for the tests.

#include <gnomon/check/check.hpp>
#include <gnomon/vulkan/resources.hpp>

#include <cstdint>
#include <span>

namespace gnomon::vulkan::test {

inline VkDescriptorBufferInfo whole(Buffer const& buffer) { return {buffer.handle.get(), 0, VK_WHOLE_SIZE}; }

inline Buffer words_buffer(GpuRef const& gpu, std::size_t count) {
    constexpr VkBufferUsageFlags usage = VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_TRANSFER_SRC_BIT |
                                         VK_BUFFER_USAGE_TRANSFER_DST_BIT;
    auto made = make_buffer(gpu, count * 4, usage, MemoryUse::upload);
    REQUIRE(made);
    return *std::move(made);
}

inline std::span<std::uint32_t> words_of(Buffer const& buffer) {
    return {reinterpret_cast<std::uint32_t*>(buffer.mapped().data()), buffer.mapped().size() / 4};
}

}  // namespace gnomon::vulkan::test
