// Shows: a shadow map of Gnomon's in a Vulkan program of one's own: own device, own command buffer, own shader.

#include <gnomon/projection.hpp>
#include <gnomon/shadow.hpp>
#include <gnomon/vulkan.hpp>

#include "shaders/vulkan_shadow_comp.hpp"

#include <vulkan/vulkan_raii.hpp>

#include <cstdio>
#include <vector>

using namespace gnomon;

namespace {

constexpr std::uint32_t picture_px = 40;
constexpr std::uint32_t pixels = picture_px * picture_px;

/// A floor of 10 m and a lid of 4 m above its middle, two triangles each.
std::vector<math::vec3> const corners = {{-5, 0, -5}, {-5, 0, 5}, {5, 0, 5}, {-5, 0, -5}, {5, 0, 5}, {5, 0, -5},
                                         {-2, 2, -2}, {-2, 2, 2}, {2, 2, 2}, {-2, 2, -2}, {2, 2, 2}, {2, 2, -2}};

struct Light { shadow::MapView map; formula::GnShadowConfig config; };  // the shader's buffer

/// What every program that draws with Vulkan has; queue family 0 is taken to draw and compute.
struct Engine {
    vk::raii::Context context;
    vk::ApplicationInfo app{"example", 1, "own", 1, VK_API_VERSION_1_3};
    vk::raii::Instance instance{context, vk::InstanceCreateInfo({}, &app)};
    vk::raii::PhysicalDevice physical{vk::raii::PhysicalDevices(instance).front()};
    vulkan::FeatureChain chain{{}};  // no optional feature: Gnomon does without
    float priority = 1.0F;
    vk::DeviceQueueCreateInfo queue_info{{}, 0, 1, &priority};
    vk::raii::Device device{physical, vk::DeviceCreateInfo({}, queue_info, {}, {}, {}, chain.head())};
    vk::raii::CommandPool pool{device, vk::CommandPoolCreateInfo({}, 0)};
    vk::raii::CommandBuffers buffers{device, {*pool, vk::CommandBufferLevel::ePrimary, 1}};
};

/// The program's own shader with a layout of its own: an image and two buffers.
struct FloorShader {
    FloorShader(vk::raii::Device const& d, vk::DescriptorImageInfo const& image, vk::DescriptorBufferInfo const* buffers)
        : device(d) {
        d.updateDescriptorSets({{*sets.front(), 0, 0, 1, vk::DescriptorType::eSampledImage, &image},
                                {*sets.front(), 1, 0, 2, vk::DescriptorType::eStorageBuffer, {}, buffers}}, {});
    }
    vk::raii::Device const& device;
    vk::DescriptorSetLayoutBinding bindings[3] = {
        {0, vk::DescriptorType::eSampledImage, 1, vk::ShaderStageFlagBits::eCompute},
        {1, vk::DescriptorType::eStorageBuffer, 1, vk::ShaderStageFlagBits::eCompute},
        {2, vk::DescriptorType::eStorageBuffer, 1, vk::ShaderStageFlagBits::eCompute}};
    vk::DescriptorPoolSize sizes[2] = {{vk::DescriptorType::eSampledImage, 1}, {vk::DescriptorType::eStorageBuffer, 2}};
    vk::raii::DescriptorSetLayout set_layout{device, vk::DescriptorSetLayoutCreateInfo({}, bindings)};
    vk::raii::PipelineLayout layout{device, vk::PipelineLayoutCreateInfo({}, *set_layout)};
    vk::raii::ShaderModule code{device, {{}, example::vulkan_shadow_comp.size_bytes(), example::vulkan_shadow_comp.data()}};
    vk::PipelineShaderStageCreateInfo stage{{}, vk::ShaderStageFlagBits::eCompute, *code, "main"};
    vk::raii::Pipeline pipeline{device, nullptr, vk::ComputePipelineCreateInfo({}, stage, *layout)};
    vk::raii::DescriptorPool pool{device, {vk::DescriptorPoolCreateFlagBits::eFreeDescriptorSet, 1, sizes}};
    vk::raii::DescriptorSets sets{device, {*pool, *set_layout}};
};

void submit_and_wait(Engine const& engine) {
    vk::raii::Queue const queue(engine.device, 0, 0);
    queue.submit(vk::SubmitInfo({}, {}, *engine.buffers.front()));
    engine.device.waitIdle();
}

/// How much of the floor the picture shows in shadow, which it prints too.
double dark_square_metres(float const* visibility) {
    double dark = 0.0;
    for (std::uint32_t i = 0; i < pixels; ++i) {
        dark += 1.0 - static_cast<double>(visibility[i]);
        std::printf("%c%s", visibility[i] < 0.5F ? '#' : '.', i % picture_px + 1 == picture_px ? "\n" : "");
    }
    return dark * 100.0 / pixels;
}

}  // namespace

int main() {
    Engine engine;
    auto const gpu = vulkan::make_gpu({.loader = engine.instance.getDispatcher()->vkGetInstanceProcAddr,
                                       .instance = *engine.instance,
                                       .physical = *engine.physical,
                                       .device = *engine.device}).value();

    math::View const sun = projection::directional_view({0, -1, 0}, {{-5, 0, -5}, {5, 2, 5}}, {}, {}).value();
    backend::Draw draw;
    draw.positions = std::span(corners);
    auto const pipelines = vulkan::make_pass_pipelines(gpu).value();
    vulkan::DrawList draws = vulkan::make_draw_list(pipelines, std::span(&draw, 1)).value();
    vulkan::Target map = vulkan::make_target(gpu, {.size_px = sun.size_px}).value();
    auto const usage = VK_BUFFER_USAGE_STORAGE_BUFFER_BIT;
    auto const light = vulkan::make_buffer(gpu, sizeof(Light), usage, vulkan::MemoryUse::upload).value();
    auto const picture = vulkan::make_buffer(gpu, pixels * 4, usage, vulkan::MemoryUse::read_back).value();
    new (light.mapped().data()) Light{shadow::make_map_view(sun, {}), shadow::formula_config(shadow::LookupConfig{})};
    vk::DescriptorBufferInfo const in_out[] = {{light.handle.get(), 0, VK_WHOLE_SIZE}, {picture.handle.get(), 0, VK_WHOLE_SIZE}};
    FloorShader const shader(engine.device, {{}, map.depth_view(), vk::ImageLayout::eReadOnlyOptimal}, in_out);

    vk::raii::CommandBuffer const& commands = engine.buffers.front();
    commands.begin({vk::CommandBufferUsageFlagBits::eOneTimeSubmit});
    draws.record_upload(*commands);  // Gnomon's part of the frame: four calls
    backend::PassLayer const layer{.origin = math::to_float(sun.eye_m), .clip_from_relative = math::clip_from_relative(sun)};
    if (!vulkan::record_pass(*commands, draws, map, std::span(&layer, 1))) return 1;
    map.prepare(*commands, vulkan::TargetUse::sample);
    commands.bindPipeline(vk::PipelineBindPoint::eCompute, *shader.pipeline);
    commands.bindDescriptorSets(vk::PipelineBindPoint::eCompute, *shader.layout, 0, *shader.sets.front(), {});
    commands.dispatch(picture_px / 8, picture_px / 8, 1);
    vulkan::order_for_host(*gpu, *commands);
    commands.end();
    submit_and_wait(engine);

    double const dark = dark_square_metres(reinterpret_cast<float const*>(picture.mapped().data()));
    std::printf("%s: %.2f of 16 square metres in shadow\n", gpu->properties.name, dark);
    return dark > 15.5 && dark < 16.5 ? 0 : 1;
}
