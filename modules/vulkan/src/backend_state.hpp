#pragma once
// What vulkan::Backend holds: resources by id, and the frame that is being recorded.

#include <gnomon/vulkan/backend.hpp>

#include <gnomon/backend/check.hpp>
#include <gnomon/backend/slots.hpp>
#include <gnomon/vulkan/barrier.hpp>
#include <gnomon/vulkan/kernel.hpp>
#include <gnomon/vulkan/read_back.hpp>
#include <gnomon/vulkan/staging.hpp>
#include <gnomon/vulkan/timestamps.hpp>

#include <optional>
#include <vector>

namespace gnomon::vulkan {

struct KeptBuffer {
    Buffer buffer;
    std::size_t bytes = 0;  ///< As asked for; the memory is a multiple of 4.
    Touched touched;
};

/// A kernel is known by its address.
struct CompiledKernel {
    backend::Kernel const* kernel = nullptr;
    ComputeKernel compute;
};

/// A copy to the host that is filled into `out` when the frame has finished.
struct PendingRead {
    std::span<std::byte> out;
    HostSlice slice;
};

struct Backend::State {
    State(GpuRef device, Host const& owner);

    /// The frame's command buffer; begins the frame if there is none.
    [[nodiscard]] Result<VkCommandBuffer> commands();
    /// Submits and waits. Afterwards there is no frame.
    [[nodiscard]] Result<core::Done> submit();
    /// Ends the frame's recording: everything written is made visible to the host.
    [[nodiscard]] Result<core::Done> close(VkCommandBuffer commands);
    /// Copies what was read back to where it was asked for.
    [[nodiscard]] Result<core::Done> deliver();
    [[nodiscard]] Result<core::Done> collect_times();
    /// Keeps a failure that ends the backend.
    core::Failure<Error> end(core::Failure<Error> failure);
    [[nodiscard]] Result<ComputeKernel const*> compiled(backend::Kernel const& kernel);
    /// A slice to read back into, and the promise to do so.
    [[nodiscard]] Result<HostSlice> take_read(std::span<std::byte> out);
    /// Destroyed at once where nothing is recorded, else when the frame has finished.
    template <class T>
    void retire(T& resource, std::vector<T>& retired) {
        if (open != VK_NULL_HANDLE) retired.push_back(std::move(resource));
    }

    GpuRef gpu;
    Host host;
    VkCommandBuffer open = VK_NULL_HANDLE;
    FrameCount count;
    Order order;
    Staging uploads;
    Staging downloads;
    DescriptorRing sets;
    StageTimer timer;
    std::optional<core::Failure<Error>> ended;
    std::optional<core::Failure<Error>> stage_failure;

    backend::Slots<backend::BufferId, KeptBuffer> buffers;
    std::vector<CompiledKernel> kernels;
    std::vector<PendingRead> reads;
    std::vector<KeptBuffer> retired_buffers;
    std::vector<backend::StageTime> times;
};

/// A vulkan result as a backend result, the value left out.
[[nodiscard]] inline core::Failure<backend::Error> refused(core::Failure<Error> const& failure) {
    return to_backend(failure);
}

}  // namespace gnomon::vulkan
