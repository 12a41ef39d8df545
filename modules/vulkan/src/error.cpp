#include <gnomon/vulkan/error.hpp>

#include <string>

namespace gnomon::vulkan {

std::string_view name_of(VkResult result) noexcept {
#define GNOMON_VULKAN_NAME(code) if (result == code) return #code;
    GNOMON_VULKAN_NAME(VK_SUCCESS)
    GNOMON_VULKAN_NAME(VK_NOT_READY)
    GNOMON_VULKAN_NAME(VK_TIMEOUT)
    GNOMON_VULKAN_NAME(VK_INCOMPLETE)
    GNOMON_VULKAN_NAME(VK_ERROR_OUT_OF_HOST_MEMORY)
    GNOMON_VULKAN_NAME(VK_ERROR_OUT_OF_DEVICE_MEMORY)
    GNOMON_VULKAN_NAME(VK_ERROR_INITIALIZATION_FAILED)
    GNOMON_VULKAN_NAME(VK_ERROR_DEVICE_LOST)
    GNOMON_VULKAN_NAME(VK_ERROR_MEMORY_MAP_FAILED)
    GNOMON_VULKAN_NAME(VK_ERROR_LAYER_NOT_PRESENT)
    GNOMON_VULKAN_NAME(VK_ERROR_EXTENSION_NOT_PRESENT)
    GNOMON_VULKAN_NAME(VK_ERROR_FEATURE_NOT_PRESENT)
    GNOMON_VULKAN_NAME(VK_ERROR_INCOMPATIBLE_DRIVER)
    GNOMON_VULKAN_NAME(VK_ERROR_TOO_MANY_OBJECTS)
    GNOMON_VULKAN_NAME(VK_ERROR_FORMAT_NOT_SUPPORTED)
    GNOMON_VULKAN_NAME(VK_ERROR_FRAGMENTED_POOL)
    GNOMON_VULKAN_NAME(VK_ERROR_OUT_OF_POOL_MEMORY)
    GNOMON_VULKAN_NAME(VK_ERROR_FRAGMENTATION)
    GNOMON_VULKAN_NAME(VK_ERROR_INVALID_SHADER_NV)
#undef GNOMON_VULKAN_NAME
    return "an unnamed VkResult";
}

core::Failure<Error> failure_of(VkResult result, std::string_view what) {
    std::string text = std::string(what) + " gave " + std::string(name_of(result));
    if (name_of(result) == "an unnamed VkResult") text += " (" + std::to_string(static_cast<int>(result)) + ")";
    if (result == VK_ERROR_DEVICE_LOST) return {Error::device_lost, text + ": make the device anew"};
    if (result == VK_ERROR_OUT_OF_HOST_MEMORY) return {Error::out_of_host_memory, text};
    if (result == VK_ERROR_OUT_OF_DEVICE_MEMORY || result == VK_ERROR_OUT_OF_POOL_MEMORY)
        return {Error::out_of_device_memory, text + ": use smaller targets, or fewer"};
    if (result == VK_ERROR_FORMAT_NOT_SUPPORTED) return {Error::unsupported_format, text};
    if (result == VK_ERROR_FEATURE_NOT_PRESENT || result == VK_ERROR_EXTENSION_NOT_PRESENT)
        return {Error::missing_feature, text};
    if (result == VK_ERROR_INCOMPATIBLE_DRIVER) return {Error::no_vulkan, text};
    if (result == VK_ERROR_INVALID_SHADER_NV) return {Error::shader_rejected, text};
    return {Error::driver, text};
}

}  // namespace gnomon::vulkan
