#include "backends.hpp"

#include "report.hpp"

#include <gnomon/raster/cpu_backend.hpp>

#include <algorithm>

namespace gnomon::command {

Outcome<Backends> Backends::open(RunOptions const& options, core::ExecutorRef executor) {
    Backends backends;
    auto const asked_for = [&](char const* name) {
        return std::find(options.backends.begin(), options.backends.end(), name) != options.backends.end();
    };
    if (asked_for("cpu")) backends.cpu_ = std::make_unique<raster::CpuBackend>(executor);
    if (asked_for("vulkan")) {
        auto device = VulkanDevice::open(options.device);
        if (!device) return std::move(device).failure();
        backends.vulkan_ = *std::move(device);
    }
    return backends;
}

backend::Backend& Backends::get(std::string const& name) const noexcept {
    return name == "vulkan" ? vulkan_->backend() : *cpu_;
}

std::string Backends::device_of(std::string const& name) const {
    return name == "vulkan" ? vulkan_->info().name : this_machine().cpu;
}

}  // namespace gnomon::command
