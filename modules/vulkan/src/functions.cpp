#include <gnomon/vulkan/functions.hpp>

#include <string>

namespace gnomon::vulkan {

namespace {

core::Failure<Error> lacks(char const* name) {
    return {Error::no_vulkan, std::string("the Vulkan loader gives no ") + name + ": the adapters need Vulkan 1.3"};
}

}  // namespace

Result<Functions> load_instance_functions(PFN_vkGetInstanceProcAddr loader, VkInstance instance) {
    if (loader == nullptr || instance == VK_NULL_HANDLE)
        return core::Failure{Error::bad_argument, "the adapters need the caller's vkGetInstanceProcAddr and VkInstance"};
    Functions functions;
#define GNOMON_VULKAN_LOAD(name)                                                                  \
    functions.name = reinterpret_cast<PFN_vk##name>(loader(instance, "vk" #name));                \
    if (functions.name == nullptr) return lacks("vk" #name);
    GNOMON_VULKAN_INSTANCE_FUNCTIONS(GNOMON_VULKAN_LOAD)
#undef GNOMON_VULKAN_LOAD
    return functions;
}

Result<Functions> load_functions(PFN_vkGetInstanceProcAddr loader, VkInstance instance, VkDevice device) {
    auto loaded = load_instance_functions(loader, instance);
    if (!loaded) return loaded;
    if (device == VK_NULL_HANDLE) return core::Failure{Error::bad_argument, "the adapters need the caller's VkDevice"};
    Functions functions = *loaded;
#define GNOMON_VULKAN_LOAD(name)                                                                            \
    functions.name = reinterpret_cast<PFN_vk##name>(functions.GetDeviceProcAddr(device, "vk" #name));       \
    if (functions.name == nullptr) return lacks("vk" #name);
    GNOMON_VULKAN_DEVICE_FUNCTIONS(GNOMON_VULKAN_LOAD)
#undef GNOMON_VULKAN_LOAD
    return functions;
}

}  // namespace gnomon::vulkan
