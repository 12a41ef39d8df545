#pragma once
// The depth pass on lavapipe: image, pipeline, one recorded command buffer that is submitted again and again.

#include "lavapipe.hpp"

namespace bench {

class LavapipePass {
  public:
    LavapipePass(Vulkan const& vk, std::span<gnomon::math::vec3 const> positions,
                 std::span<std::uint32_t const> indices, std::uint32_t size_px, Push const& push)
        : vk_(vk),
          size_(size_px),
          vertices_(vk, positions.size_bytes(), VK_BUFFER_USAGE_VERTEX_BUFFER_BIT, positions.data()),
          indices_(vk, indices.size_bytes(), VK_BUFFER_USAGE_INDEX_BUFFER_BIT, indices.data()) {
        make_image();
        make_pipeline();
        record(static_cast<std::uint32_t>(indices.size()), push);
    }
    ~LavapipePass() {
        vkDestroyPipeline(vk_.device, pipeline_, nullptr);
        vkDestroyPipelineLayout(vk_.device, layout_, nullptr);
        vkDestroyShaderModule(vk_.device, shader_, nullptr);
        vkDestroyImageView(vk_.device, view_, nullptr);
        vkDestroyImage(vk_.device, image_, nullptr);
        vkFreeMemory(vk_.device, memory_, nullptr);
        vkFreeCommandBuffers(vk_.device, vk_.pool, 1, &commands_);
    }
    LavapipePass(LavapipePass const&) = delete;
    LavapipePass& operator=(LavapipePass const&) = delete;

    void draw() const { vk_.submit_and_wait(commands_); }

    [[nodiscard]] std::vector<float> read() const {
        std::vector<float> depth(std::size_t{size_} * size_);
        DeviceBuffer const copy(vk_, depth.size() * sizeof(float), VK_BUFFER_USAGE_TRANSFER_DST_BIT);
        VkCommandBuffer commands = vk_.begin();
        barrier(commands, VK_IMAGE_LAYOUT_DEPTH_ATTACHMENT_OPTIMAL, VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL);
        VkBufferImageCopy region{};
        region.imageSubresource = {VK_IMAGE_ASPECT_DEPTH_BIT, 0, 0, 1};
        region.imageExtent = {size_, size_, 1};
        vkCmdCopyImageToBuffer(commands, image_, VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL, copy.buffer, 1, &region);
        GNOMON_VK(vkEndCommandBuffer(commands));
        vk_.submit_and_wait(commands);
        vkFreeCommandBuffers(vk_.device, vk_.pool, 1, &commands);
        std::memcpy(depth.data(), copy.mapped, depth.size() * sizeof(float));
        return depth;
    }

  private:
    void make_image() {
        VkImageCreateInfo info{};
        info.sType = VK_STRUCTURE_TYPE_IMAGE_CREATE_INFO;
        info.imageType = VK_IMAGE_TYPE_2D;
        info.format = VK_FORMAT_D32_SFLOAT;
        info.extent = {size_, size_, 1};
        info.mipLevels = 1;
        info.arrayLayers = 1;
        info.samples = VK_SAMPLE_COUNT_1_BIT;
        info.usage = VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT | VK_IMAGE_USAGE_TRANSFER_SRC_BIT;
        GNOMON_VK(vkCreateImage(vk_.device, &info, nullptr, &image_));
        VkMemoryRequirements need;
        vkGetImageMemoryRequirements(vk_.device, image_, &need);
        memory_ = vk_.allocate(need);
        GNOMON_VK(vkBindImageMemory(vk_.device, image_, memory_, 0));
        VkImageViewCreateInfo view{};
        view.sType = VK_STRUCTURE_TYPE_IMAGE_VIEW_CREATE_INFO;
        view.image = image_;
        view.viewType = VK_IMAGE_VIEW_TYPE_2D;
        view.format = info.format;
        view.subresourceRange = {VK_IMAGE_ASPECT_DEPTH_BIT, 0, 1, 0, 1};
        GNOMON_VK(vkCreateImageView(vk_.device, &view, nullptr, &view_));
    }

    void make_layout() {
        VkShaderModuleCreateInfo module{};
        module.sType = VK_STRUCTURE_TYPE_SHADER_MODULE_CREATE_INFO;
        module.codeSize = sizeof depth_vert_spv;
        module.pCode = depth_vert_spv;
        GNOMON_VK(vkCreateShaderModule(vk_.device, &module, nullptr, &shader_));
        VkPushConstantRange const range{VK_SHADER_STAGE_VERTEX_BIT, 0, sizeof(Push)};
        VkPipelineLayoutCreateInfo layout{};
        layout.sType = VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO;
        layout.pushConstantRangeCount = 1;
        layout.pPushConstantRanges = &range;
        GNOMON_VK(vkCreatePipelineLayout(vk_.device, &layout, nullptr, &layout_));
    }

    void make_pipeline() {
        make_layout();
        VkPipelineShaderStageCreateInfo stage{};
        stage.sType = VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO;
        stage.stage = VK_SHADER_STAGE_VERTEX_BIT;
        stage.module = shader_;
        stage.pName = "main";
        VkVertexInputBindingDescription const binding{0, 12, VK_VERTEX_INPUT_RATE_VERTEX};
        VkVertexInputAttributeDescription const attribute{0, 0, VK_FORMAT_R32G32B32_SFLOAT, 0};
        VkPipelineVertexInputStateCreateInfo input{};
        input.sType = VK_STRUCTURE_TYPE_PIPELINE_VERTEX_INPUT_STATE_CREATE_INFO;
        input.vertexBindingDescriptionCount = 1;
        input.pVertexBindingDescriptions = &binding;
        input.vertexAttributeDescriptionCount = 1;
        input.pVertexAttributeDescriptions = &attribute;
        VkPipelineInputAssemblyStateCreateInfo assembly{};
        assembly.sType = VK_STRUCTURE_TYPE_PIPELINE_INPUT_ASSEMBLY_STATE_CREATE_INFO;
        assembly.topology = VK_PRIMITIVE_TOPOLOGY_TRIANGLE_LIST;
        auto const side = static_cast<float>(size_);
        VkViewport const area{0, 0, side, side, 0, 1};
        VkRect2D const scissor{{0, 0}, {size_, size_}};
        VkPipelineViewportStateCreateInfo viewport{};
        viewport.sType = VK_STRUCTURE_TYPE_PIPELINE_VIEWPORT_STATE_CREATE_INFO;
        viewport.viewportCount = 1;
        viewport.pViewports = &area;
        viewport.scissorCount = 1;
        viewport.pScissors = &scissor;
        VkPipelineRasterizationStateCreateInfo raster{};
        raster.sType = VK_STRUCTURE_TYPE_PIPELINE_RASTERIZATION_STATE_CREATE_INFO;
        raster.lineWidth = 1.0F;
        VkPipelineMultisampleStateCreateInfo samples{};
        samples.sType = VK_STRUCTURE_TYPE_PIPELINE_MULTISAMPLE_STATE_CREATE_INFO;
        samples.rasterizationSamples = VK_SAMPLE_COUNT_1_BIT;
        VkPipelineDepthStencilStateCreateInfo depth{};
        depth.sType = VK_STRUCTURE_TYPE_PIPELINE_DEPTH_STENCIL_STATE_CREATE_INFO;
        depth.depthTestEnable = VK_TRUE;
        depth.depthWriteEnable = VK_TRUE;
        depth.depthCompareOp = VK_COMPARE_OP_LESS;
        VkPipelineRenderingCreateInfo rendering{};
        rendering.sType = VK_STRUCTURE_TYPE_PIPELINE_RENDERING_CREATE_INFO;
        rendering.depthAttachmentFormat = VK_FORMAT_D32_SFLOAT;
        VkGraphicsPipelineCreateInfo info{};
        info.sType = VK_STRUCTURE_TYPE_GRAPHICS_PIPELINE_CREATE_INFO;
        info.pNext = &rendering;
        info.stageCount = 1;
        info.pStages = &stage;
        info.pVertexInputState = &input;
        info.pInputAssemblyState = &assembly;
        info.pViewportState = &viewport;
        info.pRasterizationState = &raster;
        info.pMultisampleState = &samples;
        info.pDepthStencilState = &depth;
        info.layout = layout_;
        GNOMON_VK(vkCreateGraphicsPipelines(vk_.device, VK_NULL_HANDLE, 1, &info, nullptr, &pipeline_));
    }

    void barrier(VkCommandBuffer commands, VkImageLayout from, VkImageLayout to) const {
        VkImageMemoryBarrier b{};
        b.sType = VK_STRUCTURE_TYPE_IMAGE_MEMORY_BARRIER;
        b.srcAccessMask = VK_ACCESS_MEMORY_WRITE_BIT;
        b.dstAccessMask = VK_ACCESS_MEMORY_READ_BIT | VK_ACCESS_MEMORY_WRITE_BIT;
        b.oldLayout = from;
        b.newLayout = to;
        b.srcQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED;
        b.dstQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED;
        b.image = image_;
        b.subresourceRange = {VK_IMAGE_ASPECT_DEPTH_BIT, 0, 1, 0, 1};
        vkCmdPipelineBarrier(commands, VK_PIPELINE_STAGE_ALL_COMMANDS_BIT, VK_PIPELINE_STAGE_ALL_COMMANDS_BIT, 0, 0,
                             nullptr, 0, nullptr, 1, &b);
    }

    void record(std::uint32_t index_count, Push const& push) {
        commands_ = vk_.begin();
        barrier(commands_, VK_IMAGE_LAYOUT_UNDEFINED, VK_IMAGE_LAYOUT_DEPTH_ATTACHMENT_OPTIMAL);
        VkRenderingAttachmentInfo attachment{};
        attachment.sType = VK_STRUCTURE_TYPE_RENDERING_ATTACHMENT_INFO;
        attachment.imageView = view_;
        attachment.imageLayout = VK_IMAGE_LAYOUT_DEPTH_ATTACHMENT_OPTIMAL;
        attachment.loadOp = VK_ATTACHMENT_LOAD_OP_CLEAR;
        attachment.storeOp = VK_ATTACHMENT_STORE_OP_STORE;
        attachment.clearValue.depthStencil.depth = 1.0F;
        VkRenderingInfo rendering{};
        rendering.sType = VK_STRUCTURE_TYPE_RENDERING_INFO;
        rendering.renderArea = {{0, 0}, {size_, size_}};
        rendering.layerCount = 1;
        rendering.pDepthAttachment = &attachment;
        vkCmdBeginRendering(commands_, &rendering);
        vkCmdBindPipeline(commands_, VK_PIPELINE_BIND_POINT_GRAPHICS, pipeline_);
        VkDeviceSize const start = 0;
        vkCmdBindVertexBuffers(commands_, 0, 1, &vertices_.buffer, &start);
        vkCmdBindIndexBuffer(commands_, indices_.buffer, 0, VK_INDEX_TYPE_UINT32);
        vkCmdPushConstants(commands_, layout_, VK_SHADER_STAGE_VERTEX_BIT, 0, sizeof push, &push);
        vkCmdDrawIndexed(commands_, index_count, 1, 0, 0, 0);
        vkCmdEndRendering(commands_);
        GNOMON_VK(vkEndCommandBuffer(commands_));
    }

    Vulkan const& vk_;
    std::uint32_t size_;
    DeviceBuffer vertices_;
    DeviceBuffer indices_;
    VkImage image_ = VK_NULL_HANDLE;
    VkDeviceMemory memory_ = VK_NULL_HANDLE;
    VkImageView view_ = VK_NULL_HANDLE;
    VkShaderModule shader_ = VK_NULL_HANDLE;
    VkPipelineLayout layout_ = VK_NULL_HANDLE;
    VkPipeline pipeline_ = VK_NULL_HANDLE;
    VkCommandBuffer commands_ = VK_NULL_HANDLE;
};

}  // namespace bench
