#include <gnomon/vulkan/features.hpp>

#include <cstring>

namespace gnomon::vulkan {

Features supported_features(Functions const& functions, VkPhysicalDevice physical) noexcept {
    FeatureChain chain{Features{}};
    functions.GetPhysicalDeviceFeatures2(physical, &chain.core);
    VkPhysicalDeviceFeatures const& core = chain.core.features;
    Features f;
    f.multi_draw_indirect = core.multiDrawIndirect == VK_TRUE;
    f.draw_indirect_first_instance = core.drawIndirectFirstInstance == VK_TRUE;
    f.draw_indirect_count = chain.vulkan12.drawIndirectCount == VK_TRUE;
    f.layer_from_vertex_shader = chain.vulkan12.shaderOutputLayer == VK_TRUE;
    f.geometry_shader = core.geometryShader == VK_TRUE;
    f.depth_clamp = core.depthClamp == VK_TRUE;
    f.precise_occlusion_queries = core.occlusionQueryPrecise == VK_TRUE;
    f.shader_float64 = core.shaderFloat64 == VK_TRUE;
    f.shader_int64 = core.shaderInt64 == VK_TRUE;
    f.sparse_residency = core.sparseResidencyImage2D == VK_TRUE;
    return f;
}

Properties properties_of(Functions const& functions, VkPhysicalDevice physical) noexcept {
    VkPhysicalDeviceVulkan12Properties vulkan12{};
    vulkan12.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_2_PROPERTIES;
    VkPhysicalDeviceVulkan11Properties vulkan11{};
    vulkan11.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_1_PROPERTIES;
    vulkan11.pNext = &vulkan12;
    VkPhysicalDeviceProperties2 all{};
    all.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_PROPERTIES_2;
    all.pNext = &vulkan11;
    functions.GetPhysicalDeviceProperties2(physical, &all);
    Properties p;
    p.limits = all.properties.limits;
    p.subgroup_size = vulkan11.subgroupSize;
    p.rounds_to_nearest_f32 = vulkan12.shaderRoundingModeRTEFloat32 == VK_TRUE;
    p.keeps_denormals_f32 = vulkan12.shaderDenormPreserveFloat32 == VK_TRUE;
    p.keeps_nan_f32 = vulkan12.shaderSignedZeroInfNanPreserveFloat32 == VK_TRUE;
    static_assert(sizeof p.name == sizeof all.properties.deviceName);
    std::memcpy(p.name, all.properties.deviceName, sizeof p.name);
    p.api_version = all.properties.apiVersion;
    p.type = all.properties.deviceType;
    return p;
}

FeatureChain::FeatureChain(Features const& wanted) noexcept {
    auto const flag = [](bool on) noexcept -> VkBool32 { return on ? VK_TRUE : VK_FALSE; };
    core.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_FEATURES_2;
    core.pNext = &vulkan12;
    vulkan12.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_2_FEATURES;
    vulkan12.pNext = &vulkan13;
    vulkan13.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_3_FEATURES;
    core.features.multiDrawIndirect = flag(wanted.multi_draw_indirect);
    core.features.drawIndirectFirstInstance = flag(wanted.draw_indirect_first_instance);
    core.features.geometryShader = flag(wanted.geometry_shader);
    core.features.depthClamp = flag(wanted.depth_clamp);
    core.features.occlusionQueryPrecise = flag(wanted.precise_occlusion_queries);
    core.features.shaderFloat64 = flag(wanted.shader_float64);
    core.features.shaderInt64 = flag(wanted.shader_int64);
    core.features.sparseResidencyImage2D = flag(wanted.sparse_residency);
    vulkan12.drawIndirectCount = flag(wanted.draw_indirect_count);
    vulkan12.shaderOutputLayer = flag(wanted.layer_from_vertex_shader);
    vulkan12.timelineSemaphore = VK_TRUE;
    vulkan13.dynamicRendering = VK_TRUE;
    vulkan13.synchronization2 = VK_TRUE;
}

}  // namespace gnomon::vulkan
