#include "test_device.hpp"

#include <gnomon/check/check.hpp>

#include <cstdlib>
#include <cstring>
#include <utility>

namespace gnomon::vulkan::test {

namespace {

// Vulkan's function pointers carry no context, so the counts stand beside the one device that a test has.
LiveObjects& live_objects() {
    static LiveObjects live;
    return live;
}

struct Fault {
    std::uint64_t after = 0;
    VkResult result = VK_SUCCESS;
};

Fault& fault() {
    static Fault next;
    return next;
}

/// Whether this call is the one that fails.
bool fails_now() {
    ++live_objects().calls;
    if (fault().result == VK_SUCCESS) return false;
    return fault().after-- == 0;
}

PFN_vkGetDeviceProcAddr real_device_loader = nullptr;

// Each pair: a function that makes something, and the one that destroys it.
#define GNOMON_TEST_WRAP_MAKER(name, Info, Handle, kind)                                                            \
    PFN_vk##name real_##name = nullptr;                                                                              \
    VKAPI_ATTR VkResult VKAPI_CALL counted_##name(VkDevice device, Info const* info, VkAllocationCallbacks const* host, \
                                                  Handle* out) {                                                     \
        if (fails_now()) return std::exchange(fault().result, VK_SUCCESS);                                           \
        VkResult const result = real_##name(device, info, host, out);                                                \
        if (result == VK_SUCCESS) ++live_objects().made[kind];                                                       \
        return result;                                                                                               \
    }
#define GNOMON_TEST_WRAP_DESTROYER(name, Handle, kind)                                                       \
    PFN_vk##name real_##name = nullptr;                                                                      \
    VKAPI_ATTR void VKAPI_CALL counted_##name(VkDevice device, Handle handle, VkAllocationCallbacks const* host) { \
        if (handle != VK_NULL_HANDLE) --live_objects().made[kind];                                           \
        real_##name(device, handle, host);                                                                   \
    }
#define GNOMON_TEST_PAIRS(MAKE, BREAK)                                                                     \
    MAKE(AllocateMemory, VkMemoryAllocateInfo, VkDeviceMemory, "memory") BREAK(FreeMemory, VkDeviceMemory, "memory") \
    MAKE(CreateBuffer, VkBufferCreateInfo, VkBuffer, "buffer") BREAK(DestroyBuffer, VkBuffer, "buffer")     \
    MAKE(CreateImage, VkImageCreateInfo, VkImage, "image") BREAK(DestroyImage, VkImage, "image")            \
    MAKE(CreateImageView, VkImageViewCreateInfo, VkImageView, "view")                                       \
    BREAK(DestroyImageView, VkImageView, "view")                                                            \
    MAKE(CreateShaderModule, VkShaderModuleCreateInfo, VkShaderModule, "shader")                            \
    BREAK(DestroyShaderModule, VkShaderModule, "shader")                                                    \
    MAKE(CreateDescriptorSetLayout, VkDescriptorSetLayoutCreateInfo, VkDescriptorSetLayout, "set layout")   \
    BREAK(DestroyDescriptorSetLayout, VkDescriptorSetLayout, "set layout")                                  \
    MAKE(CreatePipelineLayout, VkPipelineLayoutCreateInfo, VkPipelineLayout, "pipeline layout")             \
    BREAK(DestroyPipelineLayout, VkPipelineLayout, "pipeline layout")                                       \
    MAKE(CreateDescriptorPool, VkDescriptorPoolCreateInfo, VkDescriptorPool, "descriptor pool")             \
    BREAK(DestroyDescriptorPool, VkDescriptorPool, "descriptor pool")                                       \
    MAKE(CreateQueryPool, VkQueryPoolCreateInfo, VkQueryPool, "query pool")                                 \
    BREAK(DestroyQueryPool, VkQueryPool, "query pool")
GNOMON_TEST_PAIRS(GNOMON_TEST_WRAP_MAKER, GNOMON_TEST_WRAP_DESTROYER)
GNOMON_TEST_WRAP_DESTROYER(DestroyPipeline, VkPipeline, "pipeline")

#define GNOMON_TEST_WRAP_PIPELINES(name, Info)                                                               \
    PFN_vk##name real_##name = nullptr;                                                                      \
    VKAPI_ATTR VkResult VKAPI_CALL counted_##name(VkDevice device, VkPipelineCache cache, std::uint32_t count, \
                                                  Info const* infos, VkAllocationCallbacks const* host,      \
                                                  VkPipeline* out) {                                         \
        if (fails_now()) {                                                                                   \
            for (std::uint32_t i = 0; i < count; ++i) out[i] = VK_NULL_HANDLE;                               \
            return std::exchange(fault().result, VK_SUCCESS);                                                \
        }                                                                                                    \
        VkResult const result = real_##name(device, cache, count, infos, host, out);                         \
        if (result == VK_SUCCESS) live_objects().made["pipeline"] += count;                                  \
        return result;                                                                                       \
    }
GNOMON_TEST_WRAP_PIPELINES(CreateComputePipelines, VkComputePipelineCreateInfo)
GNOMON_TEST_WRAP_PIPELINES(CreateGraphicsPipelines, VkGraphicsPipelineCreateInfo)

VKAPI_ATTR PFN_vkVoidFunction VKAPI_CALL counting_device_loader(VkDevice device, char const* name) {
    PFN_vkVoidFunction const real = real_device_loader(device, name);
#define GNOMON_TEST_SWAP(function, ...)                                  \
    if (std::strcmp(name, "vk" #function) == 0) {                        \
        real_##function = reinterpret_cast<PFN_vk##function>(real);      \
        return reinterpret_cast<PFN_vkVoidFunction>(&counted_##function); \
    }
    GNOMON_TEST_PAIRS(GNOMON_TEST_SWAP, GNOMON_TEST_SWAP)
    GNOMON_TEST_SWAP(DestroyPipeline)
    GNOMON_TEST_SWAP(CreateComputePipelines)
    GNOMON_TEST_SWAP(CreateGraphicsPipelines)
#undef GNOMON_TEST_SWAP
    return real;
}

VKAPI_ATTR PFN_vkVoidFunction VKAPI_CALL counting_loader(VkInstance instance, char const* name) {
    PFN_vkVoidFunction const real = vkGetInstanceProcAddr(instance, name);
    if (std::strcmp(name, "vkGetDeviceProcAddr") != 0) return real;
    real_device_loader = reinterpret_cast<PFN_vkGetDeviceProcAddr>(real);
    return reinterpret_cast<PFN_vkVoidFunction>(&counting_device_loader);
}

VKAPI_ATTR VkBool32 VKAPI_CALL note_message(VkDebugUtilsMessageSeverityFlagBitsEXT, VkDebugUtilsMessageTypeFlagsEXT,
                                            VkDebugUtilsMessengerCallbackDataEXT const* data, void* user) {
    static_cast<std::vector<std::string>*>(user)->emplace_back(data->pMessage);
    return VK_FALSE;
}

VkDebugUtilsMessengerCreateInfoEXT messenger_info(std::vector<std::string>& messages) {
    VkDebugUtilsMessengerCreateInfoEXT info{};
    info.sType = VK_STRUCTURE_TYPE_DEBUG_UTILS_MESSENGER_CREATE_INFO_EXT;
    info.messageSeverity =
        VK_DEBUG_UTILS_MESSAGE_SEVERITY_WARNING_BIT_EXT | VK_DEBUG_UTILS_MESSAGE_SEVERITY_ERROR_BIT_EXT;
    info.messageType = VK_DEBUG_UTILS_MESSAGE_TYPE_GENERAL_BIT_EXT | VK_DEBUG_UTILS_MESSAGE_TYPE_VALIDATION_BIT_EXT |
                       VK_DEBUG_UTILS_MESSAGE_TYPE_PERFORMANCE_BIT_EXT;
    info.pfnUserCallback = &note_message;
    info.pUserData = &messages;
    return info;
}

VkResult make_instance(std::vector<std::string>& messages, VkInstance& instance) {
    VkApplicationInfo app{};
    app.sType = VK_STRUCTURE_TYPE_APPLICATION_INFO;
    app.apiVersion = VK_API_VERSION_1_3;
    constexpr VkValidationFeatureEnableEXT enabled[] = {VK_VALIDATION_FEATURE_ENABLE_SYNCHRONIZATION_VALIDATION_EXT};
    VkValidationFeaturesEXT features{};
    features.sType = VK_STRUCTURE_TYPE_VALIDATION_FEATURES_EXT;
    features.enabledValidationFeatureCount = 1;
    features.pEnabledValidationFeatures = enabled;
    VkDebugUtilsMessengerCreateInfoEXT const messenger = messenger_info(messages);
    features.pNext = &messenger;
    char const* const layers[] = {"VK_LAYER_KHRONOS_validation"};
    char const* const extensions[] = {VK_EXT_DEBUG_UTILS_EXTENSION_NAME, VK_EXT_VALIDATION_FEATURES_EXTENSION_NAME};
    VkInstanceCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_INSTANCE_CREATE_INFO;
    info.pNext = &features;
    info.pApplicationInfo = &app;
    info.enabledLayerCount = 1;
    info.ppEnabledLayerNames = layers;
    info.enabledExtensionCount = 2;
    info.ppEnabledExtensionNames = extensions;
    return vkCreateInstance(&info, nullptr, &instance);
}

/// lavapipe, so that every machine tests the same device; else the first one.
VkPhysicalDevice pick_physical(VkInstance instance) {
    std::uint32_t count = 16;
    VkPhysicalDevice all[16];
    vkEnumeratePhysicalDevices(instance, &count, all);
    for (std::uint32_t i = 0; i < count; ++i) {
        VkPhysicalDeviceProperties properties;
        vkGetPhysicalDeviceProperties(all[i], &properties);
        if (std::strstr(properties.deviceName, "llvmpipe") != nullptr) return all[i];
    }
    return count > 0 ? all[0] : VK_NULL_HANDLE;
}

VkResult make_device(VkPhysicalDevice physical, Features const& features, VkDevice& device) {
    float const priority = 1.0F;
    VkDeviceQueueCreateInfo queue{};
    queue.sType = VK_STRUCTURE_TYPE_DEVICE_QUEUE_CREATE_INFO;
    queue.queueCount = 1;
    queue.pQueuePriorities = &priority;
    FeatureChain const chain(features);
    VkDeviceCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_DEVICE_CREATE_INFO;
    info.pNext = chain.head();
    info.queueCreateInfoCount = 1;
    info.pQueueCreateInfos = &queue;
    return vkCreateDevice(physical, &info, nullptr, &device);
}

}  // namespace

std::int64_t LiveObjects::total() const {
    std::int64_t sum = 0;
    for (auto const& [kind, count] : made) sum += count;
    return sum;
}

std::unique_ptr<Device> Device::make() {
    std::unique_ptr<Device> d(new Device);
    VkResult result = make_instance(d->messages_, d->instance_);
    if (result == VK_SUCCESS) d->physical_ = pick_physical(d->instance_);
    if (d->physical_ == VK_NULL_HANDLE) {
        FAIL("no Vulkan with validation here (" + std::string(name_of(result)) +
             "); Debian has it in mesa-vulkan-drivers and vulkan-validationlayers");
        return nullptr;
    }
    auto const functions = load_instance_functions(&vkGetInstanceProcAddr, d->instance_);
    REQUIRE(functions);
    d->features_ = supported_features(*functions, d->physical_);
    d->features_.sparse_residency = false;
    auto const make_messenger = reinterpret_cast<PFN_vkCreateDebugUtilsMessengerEXT>(
        vkGetInstanceProcAddr(d->instance_, "vkCreateDebugUtilsMessengerEXT"));
    VkDebugUtilsMessengerCreateInfoEXT const info = messenger_info(d->messages_);
    REQUIRE(make_messenger(d->instance_, &info, nullptr, &d->messenger_) == VK_SUCCESS);
    REQUIRE(make_device(d->physical_, d->features_, d->device_) == VK_SUCCESS);
    vkGetDeviceQueue(d->device_, 0, 0, &d->queue_);
    VkCommandPoolCreateInfo pool{};
    pool.sType = VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO;
    pool.flags = VK_COMMAND_POOL_CREATE_RESET_COMMAND_BUFFER_BIT;
    REQUIRE(vkCreateCommandPool(d->device_, &pool, nullptr, &d->pool_) == VK_SUCCESS);
    VkCommandBufferAllocateInfo buffer{};
    buffer.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO;
    buffer.commandPool = d->pool_;
    buffer.commandBufferCount = 1;
    REQUIRE(vkAllocateCommandBuffers(d->device_, &buffer, &d->commands_) == VK_SUCCESS);
    VkFenceCreateInfo fence{};
    fence.sType = VK_STRUCTURE_TYPE_FENCE_CREATE_INFO;
    REQUIRE(vkCreateFence(d->device_, &fence, nullptr, &d->fence_) == VK_SUCCESS);
    live_objects() = {};
    fault() = {};
    return d;
}

Device::~Device() {
    if (device_ != VK_NULL_HANDLE) {
        vkDestroyFence(device_, fence_, nullptr);
        vkDestroyCommandPool(device_, pool_, nullptr);
        vkDestroyDevice(device_, nullptr);
    }
    if (messenger_ != VK_NULL_HANDLE) {
        auto const destroy = reinterpret_cast<PFN_vkDestroyDebugUtilsMessengerEXT>(
            vkGetInstanceProcAddr(instance_, "vkDestroyDebugUtilsMessengerEXT"));
        destroy(instance_, messenger_, nullptr);
    }
    if (instance_ != VK_NULL_HANDLE) vkDestroyInstance(instance_, nullptr);
}

GpuConfig Device::config() const {
    GpuConfig config;
    config.loader = &counting_loader;
    config.instance = instance_;
    config.physical = physical_;
    config.device = device_;
    config.enabled = features_;
    return config;
}

GpuRef Device::gpu() const { return gpu_with(features_); }

GpuRef Device::gpu_with(Features const& enabled) const {
    GpuConfig with = config();
    with.enabled = enabled;
    auto made = make_gpu(with);
    REQUIRE(made);
    return *std::move(made);
}

VkCommandBuffer Device::begin() {
    VkCommandBufferBeginInfo info{};
    info.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO;
    info.flags = VK_COMMAND_BUFFER_USAGE_ONE_TIME_SUBMIT_BIT;
    REQUIRE(vkBeginCommandBuffer(commands_, &info) == VK_SUCCESS);
    return commands_;
}

void Device::submit_and_wait() {
    REQUIRE(vkEndCommandBuffer(commands_) == VK_SUCCESS);
    VkCommandBufferSubmitInfo commands{};
    commands.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_SUBMIT_INFO;
    commands.commandBuffer = commands_;
    VkSubmitInfo2 submit{};
    submit.sType = VK_STRUCTURE_TYPE_SUBMIT_INFO_2;
    submit.commandBufferInfoCount = 1;
    submit.pCommandBufferInfos = &commands;
    REQUIRE(vkQueueSubmit2(queue_, 1, &submit, fence_) == VK_SUCCESS);
    REQUIRE(vkWaitForFences(device_, 1, &fence_, VK_TRUE, ~std::uint64_t{0}) == VK_SUCCESS);
    REQUIRE(vkResetFences(device_, 1, &fence_) == VK_SUCCESS);
}

std::string Device::take_messages() {
    std::string text;
    for (std::string const& message : messages_) text += message + '\n';
    messages_.clear();
    return text;
}

LiveObjects const& Device::live() const noexcept { return live_objects(); }

void Device::fail_call(std::uint64_t n, VkResult result) { fault() = {n, result}; }

}  // namespace gnomon::vulkan::test
