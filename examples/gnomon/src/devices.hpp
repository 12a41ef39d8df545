#pragma once
// The Vulkan devices of this machine, and the one that the command draws with. The loader is opened while the program
// runs: without one there is a sentence, and everything else works.

#include "outcome.hpp"

#include <gnomon/backend/verbs.hpp>

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace gnomon::command {

/// A device as `gnomon info --devices` shows it.
struct DeviceInfo {
    std::string name;
    std::string kind;    ///< "discrete GPU", "integrated GPU", "virtual GPU", "CPU" or "other".
    std::string api;     ///< The Vulkan version that it implements: "1.3.230".
    std::string driver;  ///< "llvmpipe, Mesa 22.3.6".
    std::uint64_t memory_bytes = 0;  ///< Of its largest heap of its own.
    std::string cannot;              ///< Why the command cannot use it; empty: it can.
    std::vector<std::string> lacks;  ///< Optional features that it does without.
};

/// returns: all devices in the loader's order; or one sentence that says why there is no Vulkan.
[[nodiscard]] Outcome<std::vector<DeviceInfo>> vulkan_devices();

/// Instance, device, queue and command buffer of the command's own, and the backend that records for them.
class VulkanDevice {
  public:
    /// `name`: all or a part of a device's name, in any case, or its number from 1 as `info --devices` counts. Without
    /// one the first of the fastest kind: discrete, integrated, virtual, CPU.
    ///
    /// returns: the device; or why there is none, with the names of those there are.
    [[nodiscard]] static Outcome<std::unique_ptr<VulkanDevice>> open(std::optional<std::string> const& name);
    ~VulkanDevice();

    [[nodiscard]] DeviceInfo const& info() const noexcept;
    [[nodiscard]] backend::Backend& backend() noexcept;

  private:
    struct State;
    explicit VulkanDevice(std::unique_ptr<State> state);
    std::unique_ptr<State> state_;
};

}  // namespace gnomon::command
