#pragma once
// Why an adapter refuses or fails. Only what a caller cannot foresee: every failure says which value, and what to change.

#include <gnomon/core/result.hpp>

#include <vulkan/vulkan_core.h>

#include <cstdint>
#include <string_view>

namespace gnomon::vulkan {

enum class Error : std::uint8_t {
    no_vulkan,             ///< No loader, no driver, or one below Vulkan 1.3.
    missing_feature,       ///< The device lacks what no fallback replaces, or the caller did not enable it.
    device_lost,           ///< Nothing on this device works any more: make it anew.
    out_of_host_memory,    ///< The driver could not allocate on the host.
    out_of_device_memory,  ///< Smaller targets or fewer of them would fit.
    unsupported_format,    ///< The device cannot render to or read from the format.
    too_large,             ///< Beyond a limit of the device: the message names it.
    shader_rejected,       ///< The driver refused a shader or pipeline.
    bad_argument,          ///< An argument that no device could take.
    driver,                ///< Another VkResult below zero; the message holds its name.
};

template <class T>
using Result = core::Result<T, Error>;

/// The name of a result as the specification writes it, such as "VK_ERROR_DEVICE_LOST".
[[nodiscard]] std::string_view name_of(VkResult result) noexcept;

/// The failure of the call `what`.
///
/// expects: `result` is an error, that is below 0.
[[nodiscard]] core::Failure<Error> failure_of(VkResult result, std::string_view what);

}  // namespace gnomon::vulkan
