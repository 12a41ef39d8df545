#include "devices.hpp"

#include "values.hpp"

#include <gnomon/vulkan/backend.hpp>
#include <gnomon/vulkan/gpu.hpp>

#include <fmt/format.h>
#include <vulkan/vulkan_raii.hpp>

#include <algorithm>
#include <array>

namespace gnomon::command {

namespace {

constexpr char const* how_to_get =
    "install a driver for the graphics card, or a software one (Debian: mesa-vulkan-drivers)";

core::Failure<Exit> no_vulkan(std::string const& why) {
    return failure(fmt::format("there is no Vulkan here: {}; {}, or use --backend cpu", why, how_to_get));
}

vk::raii::Instance make_instance(vk::raii::Context const& context) {
    vk::ApplicationInfo const app("gnomon", 0, "gnomon", 0, VK_API_VERSION_1_3);
    return {context, vk::InstanceCreateInfo({}, &app)};
}

char const* kind_of(vk::PhysicalDeviceType type) {
    switch (type) {
        case vk::PhysicalDeviceType::eDiscreteGpu: return "discrete GPU";
        case vk::PhysicalDeviceType::eIntegratedGpu: return "integrated GPU";
        case vk::PhysicalDeviceType::eVirtualGpu: return "virtual GPU";
        case vk::PhysicalDeviceType::eCpu: return "CPU";
        case vk::PhysicalDeviceType::eOther: break;
    }
    return "other";
}

/// The queue family that draws, computes and, if any does, tells the time.
std::optional<std::uint32_t> queue_family_of(vk::raii::PhysicalDevice const& physical) {
    std::vector<vk::QueueFamilyProperties> const families = physical.getQueueFamilyProperties();
    constexpr vk::QueueFlags needed = vk::QueueFlagBits::eGraphics | vk::QueueFlagBits::eCompute;
    for (bool const timed : {true, false})
        for (std::uint32_t i = 0; i < families.size(); ++i)
            if ((families[i].queueFlags & needed) == needed && (!timed || families[i].timestampValidBits > 0)) return i;
    return std::nullopt;
}

std::string version_text(std::uint32_t version) {
    return fmt::format("{}.{}.{}", VK_API_VERSION_MAJOR(version), VK_API_VERSION_MINOR(version),
                       VK_API_VERSION_PATCH(version));
}

vulkan::Features features_of(vk::raii::Instance const& instance, vk::raii::PhysicalDevice const& physical) {
    auto const functions = vulkan::load_instance_functions(instance.getDispatcher()->vkGetInstanceProcAddr, *instance);
    vulkan::Features features;
    if (functions) features = vulkan::supported_features(*functions, *physical);
    features.sparse_residency = false;  // nothing needs it, and some layers watch it
    return features;
}

std::vector<std::string> lacking(vulkan::Features const& f) {
    std::vector<std::string> names;
    for (auto const& [has, name] : {std::pair{f.multi_draw_indirect, "multi-draw-indirect"},
                                    {f.draw_indirect_count, "draw-indirect-count"},
                                    {f.layer_from_vertex_shader, "layers from vertex shaders"},
                                    {f.geometry_shader, "geometry shaders"},
                                    {f.depth_clamp, "depth clamp"},
                                    {f.precise_occlusion_queries, "precise occlusion queries"},
                                    {f.shader_float64, "64-bit floats in shaders"}})
        if (!has) names.emplace_back(name);
    return names;
}

DeviceInfo describe(vk::raii::Instance const& instance, vk::raii::PhysicalDevice const& physical) {
    vk::PhysicalDeviceProperties const properties = physical.getProperties();
    DeviceInfo info;
    info.name = properties.deviceName.data();
    info.kind = kind_of(properties.deviceType);
    info.api = version_text(properties.apiVersion);
    vk::PhysicalDeviceMemoryProperties const memory = physical.getMemoryProperties();
    for (std::uint32_t i = 0; i < memory.memoryHeapCount; ++i)
        if (memory.memoryHeaps[i].flags & vk::MemoryHeapFlagBits::eDeviceLocal)
            info.memory_bytes = std::max<std::uint64_t>(info.memory_bytes, memory.memoryHeaps[i].size);
    if (properties.apiVersion < VK_API_VERSION_1_3) {
        info.cannot = "it has Vulkan " + info.api + ", and 1.3 is needed";
        return info;
    }
    auto const chain = physical.getProperties2<vk::PhysicalDeviceProperties2, vk::PhysicalDeviceVulkan12Properties>();
    auto const& driver = chain.get<vk::PhysicalDeviceVulkan12Properties>();
    info.driver = fmt::format("{}, {}", driver.driverName.data(), driver.driverInfo.data());
    if (!queue_family_of(physical)) info.cannot = "none of its queues both draws and computes";
    info.lacks = lacking(features_of(instance, physical));
    return info;
}

/// Lower is better.
int rank_of(DeviceInfo const& info) {
    constexpr std::array order{"discrete GPU", "integrated GPU", "virtual GPU", "CPU"};
    return static_cast<int>(std::find(order.begin(), order.end(), info.kind) - order.begin());
}

std::string lower(std::string text) {
    for (char& c : text)
        if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
    return text;
}

std::string names_of(std::vector<DeviceInfo> const& devices) {
    std::vector<std::string> names;
    for (DeviceInfo const& device : devices) names.push_back(device.name);
    return join(names, "; ");
}

/// Which device is meant.
Outcome<std::size_t> choose(std::vector<DeviceInfo> const& devices, std::optional<std::string> const& name) {
    std::vector<std::size_t> fitting;
    auto const number = name ? integer_from(*name) : std::nullopt;
    for (std::size_t i = 0; i < devices.size(); ++i) {
        bool const meant = !name || (number && *number == static_cast<std::int64_t>(i) + 1) ||
                           lower(devices[i].name).find(lower(*name)) != std::string::npos;
        if (meant && (name || devices[i].cannot.empty())) fitting.push_back(i);
    }
    if (fitting.empty() && name)
        return usage_error(fmt::format("--device {}: no device has this in its name; there are: {}", *name,
                                       names_of(devices)));
    if (fitting.empty()) return no_vulkan("no device can be used (" + devices.front().cannot + ")");
    auto const best = std::min_element(fitting.begin(), fitting.end(), [&](std::size_t a, std::size_t b) {
        return std::pair(!devices[a].cannot.empty(), rank_of(devices[a])) <
               std::pair(!devices[b].cannot.empty(), rank_of(devices[b]));
    });
    DeviceInfo const& chosen = devices[*best];
    if (!chosen.cannot.empty())
        return failure(fmt::format("--device {}: {} cannot be used: {}", name.value_or(""), chosen.name, chosen.cannot));
    return *best;
}

/// Runs `use`, which throws as Vulkan-Hpp and the loader do.
template <class T, class Use>
Outcome<T> guarded(Use&& use) {
    try {
        return use();
    } catch (vk::SystemError const& error) {
        return no_vulkan(error.what());
    } catch (std::runtime_error const&) {
        return no_vulkan("libvulkan.so.1 cannot be opened");
    }
}

}  // namespace

struct VulkanDevice::State {
    State(vk::raii::Context&& loader, vk::raii::Instance&& made, vk::raii::PhysicalDevice&& chosen)
        : context(std::move(loader)), instance(std::move(made)), physical(std::move(chosen)) {
        features = features_of(instance, physical);
        queue_family = *queue_family_of(physical);
        float const priority = 1.0F;
        vk::DeviceQueueCreateInfo const queue_info({}, queue_family, 1, &priority);
        vulkan::FeatureChain const chain(features);
        device = vk::raii::Device(physical, vk::DeviceCreateInfo({}, queue_info, {}, {}, {}, chain.head()));
        queue = device.getQueue(queue_family, 0);
        pool = device.createCommandPool({vk::CommandPoolCreateFlagBits::eResetCommandBuffer, queue_family});
        commands = std::move(device.allocateCommandBuffers({*pool, vk::CommandBufferLevel::ePrimary, 1}).front());
        fence = device.createFence({});
    }

    [[nodiscard]] vulkan::GpuConfig gpu_config() const {
        vulkan::GpuConfig config;
        config.loader = instance.getDispatcher()->vkGetInstanceProcAddr;
        config.instance = *instance;
        config.physical = *physical;
        config.device = *device;
        config.queue_family = queue_family;
        config.enabled = features;
        return config;
    }

    static VkResult begin(void* context, VkCommandBuffer& out) {
        auto& self = *static_cast<State*>(context);
        out = *self.commands;
        VkCommandBufferBeginInfo info{};
        info.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO;
        info.flags = VK_COMMAND_BUFFER_USAGE_ONE_TIME_SUBMIT_BIT;
        return self.device.getDispatcher()->vkBeginCommandBuffer(out, &info);
    }

    static VkResult submit_and_wait(void* context, VkCommandBuffer commands) {
        auto& self = *static_cast<State*>(context);
        auto const& call = *self.device.getDispatcher();
        VkFence const fence = *self.fence;
        if (VkResult const ended = call.vkEndCommandBuffer(commands); ended != VK_SUCCESS) return ended;
        VkCommandBufferSubmitInfo buffer{};
        buffer.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_SUBMIT_INFO;
        buffer.commandBuffer = commands;
        VkSubmitInfo2 submit{};
        submit.sType = VK_STRUCTURE_TYPE_SUBMIT_INFO_2;
        submit.commandBufferInfoCount = 1;
        submit.pCommandBufferInfos = &buffer;
        if (VkResult const sent = call.vkQueueSubmit2(*self.queue, 1, &submit, fence); sent != VK_SUCCESS) return sent;
        constexpr std::uint64_t forever = ~std::uint64_t{0};
        if (VkResult const done = call.vkWaitForFences(*self.device, 1, &fence, VK_TRUE, forever); done != VK_SUCCESS)
            return done;
        return call.vkResetFences(*self.device, 1, &fence);
    }

    vk::raii::Context context;
    vk::raii::Instance instance;
    vk::raii::PhysicalDevice physical;
    vulkan::Features features;
    std::uint32_t queue_family = 0;
    vk::raii::Device device = nullptr;
    vk::raii::Queue queue = nullptr;
    vk::raii::CommandPool pool = nullptr;
    vk::raii::CommandBuffer commands = nullptr;
    vk::raii::Fence fence = nullptr;
    DeviceInfo info;
    std::unique_ptr<vulkan::Backend> backend;  ///< Last: the first to go.
};

VulkanDevice::VulkanDevice(std::unique_ptr<State> state) : state_(std::move(state)) {}
VulkanDevice::~VulkanDevice() = default;

DeviceInfo const& VulkanDevice::info() const noexcept { return state_->info; }
backend::Backend& VulkanDevice::backend() noexcept { return *state_->backend; }

Outcome<std::vector<DeviceInfo>> vulkan_devices() {
    return guarded<std::vector<DeviceInfo>>([]() -> Outcome<std::vector<DeviceInfo>> {
        vk::raii::Context const context;
        vk::raii::Instance const instance = make_instance(context);
        std::vector<DeviceInfo> devices;
        for (vk::raii::PhysicalDevice const& physical : instance.enumeratePhysicalDevices())
            devices.push_back(describe(instance, physical));
        if (devices.empty()) return no_vulkan("the loader finds no device");
        return devices;
    });
}

Outcome<std::unique_ptr<VulkanDevice>> VulkanDevice::open(std::optional<std::string> const& name) {
    using Opened = std::unique_ptr<VulkanDevice>;
    return guarded<Opened>([&]() -> Outcome<Opened> {
        vk::raii::Context context;
        vk::raii::Instance instance = make_instance(context);
        std::vector<vk::raii::PhysicalDevice> physicals = instance.enumeratePhysicalDevices();
        std::vector<DeviceInfo> devices;
        for (vk::raii::PhysicalDevice const& physical : physicals) devices.push_back(describe(instance, physical));
        if (devices.empty()) return no_vulkan("the loader finds no device");
        auto const chosen = choose(devices, name);
        if (!chosen) return chosen.failure();
        auto state = std::make_unique<State>(std::move(context), std::move(instance), std::move(physicals[*chosen]));
        state->info = devices[*chosen];
        auto gpu = vulkan::make_gpu(state->gpu_config());
        if (!gpu) return failure(gpu.failure().message);
        auto made = vulkan::Backend::make(*std::move(gpu), {state.get(), &State::begin, &State::submit_and_wait});
        if (!made) return failure(made.failure().message);
        state->backend = *std::move(made);
        return Opened(new VulkanDevice(std::move(state)));
    });
}

}  // namespace gnomon::command
