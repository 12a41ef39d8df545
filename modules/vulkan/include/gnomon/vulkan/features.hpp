#pragma once
// What a device can do beyond Vulkan 1.3's own promises, and how a caller asks a device for it.

#include <gnomon/vulkan/functions.hpp>

#include <vulkan/vulkan_core.h>

#include <cstdint>

namespace gnomon::vulkan {

/// Optional features: the adapters use each where it is set and do without where it is not.
struct Features {
    bool multi_draw_indirect = false;         ///< Else: a recorded call for each draw.
    bool draw_indirect_first_instance = false;  ///< Else: direct draws.
    bool draw_indirect_count = false;         ///< Else: the whole list, with empty draws.
    bool layer_from_vertex_shader = false;    ///< shaderOutputLayer. Else: geometry shader, or a pass for each layer.
    bool geometry_shader = false;             ///< Also gives gl_PrimitiveID. Else: ids by pulled vertices.
    bool depth_clamp = false;                 ///< Else: the fragment shader clamps.
    bool precise_occlusion_queries = false;   ///< Else: sample counts are refused.
    bool shader_float64 = false;
    bool shader_int64 = false;
    bool sparse_residency = false;            ///< Nothing here needs it.
};

/// What the device reports about itself.
struct Properties {
    VkPhysicalDeviceLimits limits{};
    std::uint32_t subgroup_size = 1;
    bool rounds_to_nearest_f32 = false;  ///< Shaders can ask for round-to-nearest-even.
    bool keeps_denormals_f32 = false;    ///< Shaders can ask for subnormal operands and results as they are.
    bool keeps_nan_f32 = false;          ///< Shaders can ask that NaN, infinities and the sign of zero count.
    char name[VK_MAX_PHYSICAL_DEVICE_NAME_SIZE] = {};
    std::uint32_t api_version = 0;
    VkPhysicalDeviceType type = VK_PHYSICAL_DEVICE_TYPE_OTHER;
};

[[nodiscard]] Features supported_features(Functions const& functions, VkPhysicalDevice physical) noexcept;
[[nodiscard]] Properties properties_of(Functions const& functions, VkPhysicalDevice physical) noexcept;

/// Structures to hang into VkDeviceCreateInfo::pNext, for a caller who makes a device for the adapters. Those who have
/// a device already check theirs against `required` in features.cpp's words: dynamicRendering, synchronization2,
/// timelineSemaphore.
///
/// The chain points into itself: it is not copied.
struct FeatureChain {
    explicit FeatureChain(Features const& wanted) noexcept;
    FeatureChain(FeatureChain const&) = delete;
    FeatureChain& operator=(FeatureChain const&) = delete;

    [[nodiscard]] void const* head() const noexcept { return &core; }

    VkPhysicalDeviceFeatures2 core{};
    VkPhysicalDeviceVulkan12Features vulkan12{};
    VkPhysicalDeviceVulkan13Features vulkan13{};
};

}  // namespace gnomon::vulkan
