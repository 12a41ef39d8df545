#include "backend_state.hpp"

#include <algorithm>
#include <cstring>
#include <string>

namespace gnomon::vulkan {

namespace {

/// lavapipe counts the rounds of all loops of an invocation together, and ends the one that has the 65,535th.
std::uint32_t loop_rounds_of(Gpu const& gpu) noexcept {
    VkPhysicalDeviceDriverProperties driver{};
    driver.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_DRIVER_PROPERTIES;
    VkPhysicalDeviceProperties2 all{};
    all.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_PROPERTIES_2;
    all.pNext = &driver;
    gpu.call.GetPhysicalDeviceProperties2(gpu.physical, &all);
    return driver.driverID == VK_DRIVER_ID_MESA_LLVMPIPE ? 65'000 : backend::Limits{}.loop_rounds;
}

}  // namespace

Backend::Backend(std::unique_ptr<State> state) noexcept : state_(std::move(state)) {}
Backend::~Backend() = default;

backend::Result<std::unique_ptr<Backend>> Backend::make(GpuRef gpu, Host const& host,
                                                         OrthoPipelinesConfig const& ortho) {
    if (gpu == nullptr || host.begin == nullptr || host.submit_and_wait == nullptr)
        return core::Failure{backend::Error::bad_argument,
                             "vulkan::Backend: it needs a device and both functions of the host"};
    auto state = std::make_unique<State>(std::move(gpu), host);
    state->ortho_config = ortho;
    state->loop_rounds = loop_rounds_of(*state->gpu);
    return std::unique_ptr<Backend>(new Backend(std::move(state)));
}

std::uint64_t Backend::barriers() const noexcept { return state_->order.barriers(); }

backend::Limits Backend::limits() const noexcept {
    VkPhysicalDeviceLimits const& l = state_->gpu->properties.limits;
    backend::Limits limits;
    std::uint32_t const side = std::min({l.maxImageDimension2D, l.maxFramebufferWidth, l.maxFramebufferHeight,
                                         l.maxViewportDimensions[0], l.maxViewportDimensions[1], 16384U});
    limits.target_px = static_cast<std::int32_t>(side);
    limits.target_layers = std::min({l.maxImageArrayLayers, l.maxFramebufferLayers, 256U});
    limits.buffer_bytes = std::min<std::uint64_t>(limits.buffer_bytes, l.maxStorageBufferRange);
    limits.loop_rounds = state_->loop_rounds;
    return limits;
}

backend::Result<backend::BufferId> Backend::make_buffer(std::size_t bytes) {
    if (state_->ended) return to_backend(*state_->ended);
    if (auto ok = backend::check_buffer(bytes, limits()); !ok) return std::move(ok).failure();
    constexpr VkBufferUsageFlags usage = VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_TRANSFER_SRC_BIT |
                                         VK_BUFFER_USAGE_TRANSFER_DST_BIT;
    auto made = vulkan::make_buffer(state_->gpu, (bytes + 3) / 4 * 4, usage, MemoryUse::device);
    if (!made) return to_backend(std::move(made).failure());
    KeptBuffer kept;
    kept.buffer = *std::move(made);
    kept.bytes = bytes;
    backend::BufferId const id = state_->buffers.insert(std::move(kept));
    if (id.is_none()) return a_million_live("make_buffer");
    return id;
}

backend::Result<core::Done> Backend::release(backend::BufferId buffer) {
    KeptBuffer* const kept = state_->buffers.find(buffer);
    if (kept == nullptr) return backend::unknown_id("release", "buffer", buffer.value);
    state_->retire(*kept, state_->retired_buffers);
    state_->buffers.erase(buffer);
    return core::Done{};
}

void Backend::stage(std::string_view name) {
    auto const commands = state_->commands();
    if (!commands) return;  // the next verb says why
    if (auto ok = state_->timer.stage(*commands, name); !ok) state_->stage_failure = std::move(ok).failure();
}

backend::Result<core::Done> Backend::write(backend::BufferId buffer, std::size_t offset,
                                           std::span<std::byte const> bytes) {
    KeptBuffer* const kept = state_->buffers.find(buffer);
    if (kept == nullptr) return backend::unknown_id("write", "buffer", buffer.value);
    if (auto ok = backend::check_range("write", kept->bytes, offset, bytes.size()); !ok) return ok;
    if (bytes.empty()) return core::Done{};
    auto const commands = state_->commands();
    if (!commands) return to_backend(commands.failure());
    auto const slice = state_->uploads.take(bytes.size());
    if (!slice) return to_backend(slice.failure());
    std::memcpy(slice->bytes.data(), bytes.data(), bytes.size());
    state_->order.writes(kept->touched);
    state_->order.apply(*state_->gpu, *commands);
    VkBufferCopy const region{slice->offset, offset, bytes.size()};
    state_->gpu->call.CmdCopyBuffer(*commands, slice->buffer, kept->buffer.handle.get(), 1, &region);
    return core::Done{};
}

backend::Result<core::Done> Backend::read(backend::BufferId buffer, std::size_t offset, std::span<std::byte> out) {
    KeptBuffer* const kept = state_->buffers.find(buffer);
    if (kept == nullptr) return backend::unknown_id("read", "buffer", buffer.value);
    if (auto ok = backend::check_range("read", kept->bytes, offset, out.size()); !ok) return ok;
    if (out.empty()) return core::Done{};
    auto const commands = state_->commands();
    if (!commands) return to_backend(commands.failure());
    auto const slice = state_->take_read(out);
    if (!slice) return to_backend(slice.failure());
    state_->order.reads(kept->touched);
    state_->order.apply(*state_->gpu, *commands);
    VkBufferCopy const region{offset, slice->offset, out.size()};
    state_->gpu->call.CmdCopyBuffer(*commands, kept->buffer.handle.get(), slice->buffer, 1, &region);
    return core::Done{};
}

backend::Result<std::span<backend::StageTime const>> Backend::finish() {
    State& state = *state_;
    if (state.ended) return to_backend(*state.ended);
    state.times.clear();
    if (state.open == VK_NULL_HANDLE) return std::span<backend::StageTime const>(state.times);
    if (auto ok = state.submit(); !ok) return to_backend(std::move(ok).failure());
    if (auto ok = state.deliver(); !ok) return to_backend(std::move(ok).failure());
    if (auto ok = state.collect_times(); !ok) return to_backend(std::move(ok).failure());
    return std::span<backend::StageTime const>(state.times);
}

}  // namespace gnomon::vulkan
