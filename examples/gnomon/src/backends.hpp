#pragma once
// The backends that a command's runs ask for, opened once.

#include "devices.hpp"
#include "options.hpp"

#include <gnomon/backend/verbs.hpp>
#include <gnomon/core/executor.hpp>

#include <memory>
#include <string>

namespace gnomon::command {

class Backends {
  public:
    /// returns: those that `options` names; or why the Vulkan device cannot be had.
    [[nodiscard]] static Outcome<Backends> open(RunOptions const& options, core::ExecutorRef executor);

    /// expects: a name that was opened.
    [[nodiscard]] backend::Backend& get(std::string const& name) const noexcept;
    /// What a backend computes with: the Vulkan device's name, or the processor's.
    [[nodiscard]] std::string device_of(std::string const& name) const;

  private:
    std::unique_ptr<backend::Backend> cpu_;
    std::unique_ptr<VulkanDevice> vulkan_;
};

}  // namespace gnomon::command
