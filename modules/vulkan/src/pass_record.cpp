#include "pass_record.hpp"

#include "graphics_pipeline.hpp"
#include "memory_barrier.hpp"

#include <algorithm>
#include <string>

namespace gnomon::vulkan::detail {

namespace {

constexpr VkPipelineStageFlags2 copy_stage = VK_PIPELINE_STAGE_2_ALL_TRANSFER_BIT;
constexpr VkPipelineStageFlags2 draw_stages =
    VK_PIPELINE_STAGE_2_VERTEX_SHADER_BIT | VK_PIPELINE_STAGE_2_FRAGMENT_SHADER_BIT;
constexpr VkPipelineStageFlags2 compute_stage = VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT;

/// Before a slot or the matrices are written again: what was recorded with them has read them.
void wait_for_readers(DrawList::State const& list, VkCommandBuffer commands) {
    if (list.next_slot != 0 && list.instanced == 0) return;
    constexpr VkAccessFlags2 writes = VK_ACCESS_2_TRANSFER_WRITE_BIT | VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT;
    record_barrier(*list.pipelines->gpu(), commands, {draw_stages | compute_stage | copy_stage, writes},
                   {compute_stage | copy_stage, writes});
}

/// returns: the slot's dynamic offset.
std::uint32_t write_slot(VkCommandBuffer commands, DrawList::State& list, std::span<std::byte const> bytes) {
    wait_for_readers(list, commands);
    std::uint32_t const offset = list.next_slot * static_cast<std::uint32_t>(view_slot_bytes);
    list.next_slot = (list.next_slot + 1) % view_slots;
    list.pipelines->gpu()->call.CmdUpdateBuffer(commands, list.changing.handle.get(), offset, bytes.size(), bytes.data());
    return offset;
}

void show_to_draws(VkCommandBuffer commands, DrawList::State const& list) {
    record_barrier(*list.pipelines->gpu(), commands,
                   {copy_stage | compute_stage,
                    VK_ACCESS_2_TRANSFER_WRITE_BIT | VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT},
                   {draw_stages, VK_ACCESS_2_UNIFORM_READ_BIT | VK_ACCESS_2_SHADER_STORAGE_READ_BIT});
}

/// One thread a column, by the device.
void make_matrices_there(VkCommandBuffer commands, DrawList::State const& list, Chunk const& chunk,
                         std::uint32_t offset) {
    Gpu const& gpu = *list.pipelines->gpu();
    record_barrier(gpu, commands, {copy_stage, VK_ACCESS_2_TRANSFER_WRITE_BIT},
                   {compute_stage, VK_ACCESS_2_UNIFORM_READ_BIT | VK_ACCESS_2_SHADER_STORAGE_READ_BIT});
    VkPipelineLayout const layout = list.pipelines->layout();
    gpu.call.CmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_COMPUTE, list.pipelines->instances());
    gpu.call.CmdBindDescriptorSets(commands, VK_PIPELINE_BIND_POINT_COMPUTE, layout, 0, 1, &list.set, 1, &offset);
    PassPush push;
    push.layers = chunk.view_count;
    push.matrix_views = chunk.view_count;
    push.instanced = list.instanced;
    gpu.call.CmdPushConstants(commands, layout, push_stages, 0, sizeof push, &push);
    std::uint64_t const groups = (std::uint64_t{list.instanced} * chunk.view_count * 4 + 63) / 64;
    constexpr std::uint64_t across = 32768;
    gpu.call.CmdDispatch(commands, static_cast<std::uint32_t>(std::min(groups, across)),
                         static_cast<std::uint32_t>((groups + across - 1) / across), 1);
}

/// By the host, where the device has no doubles: written into the command buffer.
void make_matrices_here(VkCommandBuffer commands, DrawList::State const& list, Chunk const& chunk) {
    Gpu const& gpu = *list.pipelines->gpu();
    constexpr std::size_t batch = 256;
    std::array<math::mat4, batch> matrices;
    VkDeviceSize offset = list.bound[binding_matrices].offset;
    std::size_t count = 0;
    auto const send = [&] {
        if (count == 0) return;
        gpu.call.CmdUpdateBuffer(commands, list.changing.handle.get(), offset, count * sizeof(math::mat4),
                                 matrices.data());
        offset += count * sizeof(math::mat4);
        count = 0;
    };
    for (math::mat4 const& instance : list.instances)
        for (std::uint32_t v = 0; v < chunk.view_count; ++v) {
            matrices[count++] =
                backend::clip_from_instance(chunk.views[v]->clip_from_relative, chunk.views[v]->origin, instance);
            if (count == batch) send();
        }
    send();
}

}  // namespace

std::uint32_t record_views(VkCommandBuffer commands, DrawList::State& list, Chunk const& chunk) {
    std::array<ViewData, max_views> views;
    for (std::uint32_t i = 0; i < chunk.view_count; ++i) views[i] = view_data(*chunk.views[i]);
    std::uint32_t const offset = write_slot(commands, list, std::as_bytes(std::span(views).first(chunk.view_count)));
    if (list.instanced != 0) {
        if (list.pipelines->instances() != VK_NULL_HANDLE)
            make_matrices_there(commands, list, chunk, offset);
        else
            make_matrices_here(commands, list, chunk);
    }
    show_to_draws(commands, list);
    return offset;
}

std::uint32_t record_slot(VkCommandBuffer commands, DrawList::State& list, std::span<std::byte const> bytes) {
    std::uint32_t const offset = write_slot(commands, list, bytes);
    show_to_draws(commands, list);
    return offset;
}

void begin_rendering(Gpu const& gpu, VkCommandBuffer commands, Rendering const& rendering) {
    VkRenderingAttachmentInfo depth{};
    depth.sType = VK_STRUCTURE_TYPE_RENDERING_ATTACHMENT_INFO;
    depth.imageView = rendering.depth;
    depth.imageLayout = rendering.layout;
    depth.loadOp = rendering.clears ? VK_ATTACHMENT_LOAD_OP_CLEAR : VK_ATTACHMENT_LOAD_OP_LOAD;
    depth.storeOp = rendering.reads_only ? VK_ATTACHMENT_STORE_OP_NONE : VK_ATTACHMENT_STORE_OP_STORE;
    depth.clearValue.depthStencil.depth = rendering.clear_depth;
    VkRenderingAttachmentInfo triangle = depth;
    triangle.imageView = rendering.triangle;
    triangle.clearValue.color.uint32[0] = backend::no_triangle;
    VkRenderingInfo info{};
    info.sType = VK_STRUCTURE_TYPE_RENDERING_INFO;
    info.renderArea.extent = {static_cast<std::uint32_t>(rendering.size_px.x),
                              static_cast<std::uint32_t>(rendering.size_px.y)};
    info.layerCount = rendering.layers;
    info.pDepthAttachment = &depth;
    if (rendering.triangle != VK_NULL_HANDLE) {
        info.colorAttachmentCount = 1;
        info.pColorAttachments = &triangle;
    }
    gpu.call.CmdBeginRendering(commands, &info);
}

void clear_depths(Gpu const& gpu, VkCommandBuffer commands, Target& target, float depth) {
    target.prepare(commands, TargetUse::copy_to);
    VkClearDepthStencilValue const value{depth, 0};
    VkImageSubresourceRange const range{VK_IMAGE_ASPECT_DEPTH_BIT, 0, 1, 0, target.config().layers};
    gpu.call.CmdClearDepthStencilImage(commands, target.depth_image(), VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, &value, 1, &range);
}

void bind_list(VkCommandBuffer commands, DrawList::State const& list, std::uint32_t offset) {
    Gpu const& gpu = *list.pipelines->gpu();
    gpu.call.CmdBindDescriptorSets(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, list.pipelines->layout(), 0, 1, &list.set, 1,
                                   &offset);
    VkBuffer const buffer = list.fixed.handle.get();
    VkDeviceSize const positions = list.bound[binding_positions].offset;
    gpu.call.CmdBindVertexBuffers(commands, 0, 1, &buffer, &positions);
    gpu.call.CmdBindIndexBuffer(commands, buffer, 0, VK_INDEX_TYPE_UINT32);
}

void set_area(Gpu const& gpu, VkCommandBuffer commands, Bundle const& bundle) {
    VkViewport const viewport{static_cast<float>(bundle.viewport.x) + static_cast<float>(bundle.subpixel.x) / 256.0F,
                              static_cast<float>(bundle.viewport.y) + static_cast<float>(bundle.subpixel.y) / 256.0F,
                              static_cast<float>(bundle.viewport.width),
                              static_cast<float>(bundle.viewport.height),
                              0.0F,
                              1.0F};
    VkRect2D const scissor{{bundle.area.x, bundle.area.y},
                           {static_cast<std::uint32_t>(bundle.area.width),
                            static_cast<std::uint32_t>(bundle.area.height)}};
    gpu.call.CmdSetViewport(commands, 0, 1, &viewport);
    gpu.call.CmdSetScissor(commands, 0, 1, &scissor);
    gpu.call.CmdSetDepthCompareOp(
        commands, bundle.depth == math::Depth::reversed ? VK_COMPARE_OP_GREATER : VK_COMPARE_OP_LESS);
}

void clear_area(Gpu const& gpu, VkCommandBuffer commands, Bundle const& bundle, std::uint32_t layer,
                bool triangle_ids) {
    VkClearAttachment clears[2]{};
    clears[0].aspectMask = VK_IMAGE_ASPECT_DEPTH_BIT;
    clears[0].clearValue.depthStencil.depth = farthest(bundle.depth);
    clears[1].aspectMask = VK_IMAGE_ASPECT_COLOR_BIT;
    clears[1].clearValue.color.uint32[0] = backend::no_triangle;
    VkClearRect rect{};
    rect.rect = {{bundle.area.x, bundle.area.y},
                 {static_cast<std::uint32_t>(bundle.area.width), static_cast<std::uint32_t>(bundle.area.height)}};
    rect.baseArrayLayer = layer;
    rect.layerCount = 1;
    gpu.call.CmdClearAttachments(commands, triangle_ids ? 2 : 1, clears, 1, &rect);
}

Result<core::Done> check_layer(Gpu const& gpu, backend::PassLayer const& layer, Target const& target) {
    if (layer.layer >= target.config().layers)
        return core::Failure{Error::bad_argument, "a pass into layer " + std::to_string(layer.layer) +
                                                      " of a target of " + std::to_string(target.config().layers)};
    if (!layer.viewport) return core::Done{};
    backend::Rect const& v = *layer.viewport;
    VkPhysicalDeviceLimits const& limits = gpu.properties.limits;
    auto const is_beyond = [&](std::int32_t at, std::int32_t size, std::uint32_t most) {
        return size > 0 && (static_cast<std::uint32_t>(size) > most ||
                            static_cast<float>(at) < limits.viewportBoundsRange[0] ||
                            static_cast<float>(at) + static_cast<float>(size) > limits.viewportBoundsRange[1]);
    };
    if (is_beyond(v.x, v.width, limits.maxViewportDimensions[0]) ||
        is_beyond(v.y, v.height, limits.maxViewportDimensions[1]))
        return core::Failure{Error::too_large, "a viewport of " + std::to_string(v.width) + " x " +
                                                   std::to_string(v.height) + " pixels; " + gpu.properties.name +
                                                   " takes at most " + std::to_string(limits.maxViewportDimensions[0]) +
                                                   " x " + std::to_string(limits.maxViewportDimensions[1])};
    return core::Done{};
}

}  // namespace gnomon::vulkan::detail
