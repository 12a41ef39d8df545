#pragma once
// The peer: a depth-only pass of one indexed draw by a Vulkan device, for the comparison only.

#include <gnomon/math/vec.hpp>

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace lavapipe {

/// One scene on the device. Throws std::exception on any Vulkan failure: the comparison cannot go on without it.
class VulkanDepth {
public:
    /// Takes the first CPU device (lavapipe); `size_px` squared, D32_SFLOAT.
    VulkanDepth(std::span<gnomon::math::vec3 const> positions, std::span<std::uint32_t const> indices, int size_px);
    ~VulkanDepth();
    VulkanDepth(VulkanDepth const&) = delete;
    VulkanDepth& operator=(VulkanDepth const&) = delete;

    [[nodiscard]] std::string device_name() const;

    /// Clears to 1, draws with a less test and no culling, and waits.
    ///
    /// returns: milliseconds from submission to completion.
    double draw_ms(gnomon::math::mat4 const& clip_from_position);

    /// The image of the last draw, row by row.
    [[nodiscard]] std::vector<float> read_back();

private:
    struct State;
    std::unique_ptr<State> state_;
};

}  // namespace lavapipe
