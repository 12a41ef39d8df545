#include <gnomon/vulkan/gpu.hpp>

#include <string>
#include <vector>

namespace gnomon::vulkan {

namespace {

std::string version_text(std::uint32_t version) {
    return std::to_string(VK_API_VERSION_MAJOR(version)) + "." + std::to_string(VK_API_VERSION_MINOR(version)) + "." +
           std::to_string(VK_API_VERSION_PATCH(version));
}

Result<core::Done> check_queue(Gpu& gpu) {
    std::uint32_t count = 0;
    gpu.call.GetPhysicalDeviceQueueFamilyProperties(gpu.physical, &count, nullptr);
    std::vector<VkQueueFamilyProperties> families(count);
    gpu.call.GetPhysicalDeviceQueueFamilyProperties(gpu.physical, &count, families.data());
    if (gpu.queue_family >= count)
        return core::Failure{Error::bad_argument, "queue family " + std::to_string(gpu.queue_family) + ": the device has " +
                                                      std::to_string(count)};
    VkQueueFamilyProperties const& family = families[gpu.queue_family];
    constexpr VkQueueFlags needed = VK_QUEUE_GRAPHICS_BIT | VK_QUEUE_COMPUTE_BIT;
    if ((family.queueFlags & needed) != needed)
        return core::Failure{Error::missing_feature, "queue family " + std::to_string(gpu.queue_family) +
                                                         " does not both draw and compute; pick one that does"};
    gpu.timestamp_bits = family.timestampValidBits;
    return core::Done{};
}

/// What the caller says to have enabled must be there at all.
Result<core::Done> check_features(Gpu const& gpu) {
    Features const has = supported_features(gpu.call, gpu.physical);
    struct Row {
        char const* name;
        bool Features::* flag;
    };
    constexpr Row rows[] = {
        {"multi_draw_indirect", &Features::multi_draw_indirect},
        {"draw_indirect_first_instance", &Features::draw_indirect_first_instance},
        {"draw_indirect_count", &Features::draw_indirect_count},
        {"layer_from_vertex_shader", &Features::layer_from_vertex_shader},
        {"geometry_shader", &Features::geometry_shader},
        {"depth_clamp", &Features::depth_clamp},
        {"precise_occlusion_queries", &Features::precise_occlusion_queries},
        {"shader_float64", &Features::shader_float64},
        {"shader_int64", &Features::shader_int64},
        {"sparse_residency", &Features::sparse_residency},
    };
    for (Row const& row : rows)
        if (gpu.features.*row.flag && !(has.*row.flag))
            return core::Failure{Error::missing_feature, std::string("GpuConfig::enabled.") + row.name + " is set, but " +
                                                             gpu.properties.name + " has no such feature"};
    return core::Done{};
}

}  // namespace

Result<GpuRef> make_gpu(GpuConfig const& config) {
    if (config.physical == VK_NULL_HANDLE)
        return core::Failure{Error::bad_argument, "the adapters need the caller's VkPhysicalDevice"};
    if ((config.memory.allocate == nullptr) != (config.memory.release == nullptr))
        return core::Failure{Error::bad_argument, "GpuConfig::memory needs both hooks, or none"};
    auto functions = load_functions(config.loader, config.instance, config.device);
    if (!functions) return std::move(functions).failure();
    auto gpu = std::make_shared<Gpu>();
    gpu->physical = config.physical;
    gpu->device = config.device;
    gpu->queue_family = config.queue_family;
    gpu->host = config.host;
    gpu->memory = config.memory;
    gpu->call = *functions;
    gpu->features = config.enabled;
    gpu->properties = properties_of(gpu->call, gpu->physical);
    if (gpu->properties.api_version < VK_API_VERSION_1_3)
        return core::Failure{Error::no_vulkan, std::string(gpu->properties.name) + " has Vulkan " +
                                                   version_text(gpu->properties.api_version) + "; 1.3 is needed"};
    gpu->call.GetPhysicalDeviceMemoryProperties(gpu->physical, &gpu->memory_properties);
    if (auto queue = check_queue(*gpu); !queue) return std::move(queue).failure();
    if (auto features = check_features(*gpu); !features) return std::move(features).failure();
    return GpuRef(std::move(gpu));
}

}  // namespace gnomon::vulkan
