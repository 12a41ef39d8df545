// Parts of targets: copied from one to another, and read back.

#include "backend_state.hpp"

namespace gnomon::vulkan {

namespace {

VkExtent3D extent_of(backend::Rect const& rect) noexcept {
    return {static_cast<std::uint32_t>(rect.width), static_cast<std::uint32_t>(rect.height), 1};
}

bool is_empty(backend::Rect const& rect) noexcept { return rect.width <= 0 || rect.height <= 0; }

/// Between the layer that is read and the one that is written of one image: all are in the layout to read from, and are
/// so again afterwards.
void move_layer(Gpu const& gpu, VkCommandBuffer commands, PlaneImage const& image, std::uint32_t layer, bool to_write) {
    constexpr VkImageLayout read = VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL;
    constexpr VkImageLayout write = VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL;
    VkImageMemoryBarrier2 barrier{};
    barrier.sType = VK_STRUCTURE_TYPE_IMAGE_MEMORY_BARRIER_2;
    barrier.srcStageMask = VK_PIPELINE_STAGE_2_ALL_TRANSFER_BIT;
    barrier.srcAccessMask = to_write ? VK_ACCESS_2_NONE : VK_ACCESS_2_TRANSFER_WRITE_BIT;
    barrier.dstStageMask = VK_PIPELINE_STAGE_2_ALL_TRANSFER_BIT;
    barrier.dstAccessMask = to_write ? VK_ACCESS_2_TRANSFER_WRITE_BIT : VK_ACCESS_2_TRANSFER_READ_BIT;
    barrier.oldLayout = to_write ? read : write;
    barrier.newLayout = to_write ? write : read;
    barrier.srcQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED;
    barrier.dstQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED;
    barrier.image = image.image;
    barrier.subresourceRange = {image.aspect, 0, 1, layer, 1};
    VkDependencyInfo info{};
    info.sType = VK_STRUCTURE_TYPE_DEPENDENCY_INFO;
    info.imageMemoryBarrierCount = 1;
    info.pImageMemoryBarriers = &barrier;
    gpu.call.CmdPipelineBarrier2(commands, &info);
}

}  // namespace

backend::Result<core::Done> Backend::copy(backend::TargetPart const& from, backend::TargetId to, std::uint32_t layer,
                                          math::ivec2 const& at) {
    Target* const source = state_->targets.find(from.target);
    if (source == nullptr) return backend::unknown_id("copy", "target", from.target.value);
    Target* const goal = state_->targets.find(to);
    if (goal == nullptr) return backend::unknown_id("copy", "target", to.value);
    backend::TargetPart const part{to, layer, from.plane, {at.x, at.y, from.rect.width, from.rect.height}};
    if (auto ok = backend::check_copy(from, source->config(), part, goal->config()); !ok) return ok;
    if (is_empty(from.rect)) return core::Done{};
    auto const commands = state_->commands();
    if (!commands) return to_backend(commands.failure());
    PlaneImage const read = image_of(*source, from.plane);
    PlaneImage const written = image_of(*goal, from.plane);
    source->prepare(*commands, TargetUse::copy_from);
    if (source == goal) move_layer(*state_->gpu, *commands, written, layer, true);
    else goal->prepare(*commands, TargetUse::copy_to);
    VkImageCopy region{};
    region.srcSubresource = {read.aspect, 0, from.layer, 1};
    region.srcOffset = {from.rect.x, from.rect.y, 0};
    region.dstSubresource = {written.aspect, 0, layer, 1};
    region.dstOffset = {at.x, at.y, 0};
    region.extent = extent_of(from.rect);
    state_->gpu->call.CmdCopyImage(*commands, read.image, VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL, written.image,
                                   VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, 1, &region);
    if (source == goal) move_layer(*state_->gpu, *commands, written, layer, false);
    return core::Done{};
}

backend::Result<core::Done> Backend::read(backend::TargetPart const& part, std::span<std::byte> out) {
    Target* const target = state_->targets.find(part.target);
    if (target == nullptr) return backend::unknown_id("read", "target", part.target.value);
    if (auto ok = backend::check_read(part, target->config(), out.size()); !ok) return ok;
    if (is_empty(part.rect)) return core::Done{};
    auto const commands = state_->commands();
    if (!commands) return to_backend(commands.failure());
    auto const slice = state_->take_read(out);
    if (!slice) return to_backend(slice.failure());
    target->prepare(*commands, TargetUse::copy_from);
    PlaneImage const image = image_of(*target, part.plane);
    ImagePart source;
    source.image = image.image;
    source.layout = target->layout();
    source.aspect = image.aspect;
    source.layer = part.layer;
    source.offset = {part.rect.x, part.rect.y};
    source.extent = {extent_of(part.rect).width, extent_of(part.rect).height};
    source.pixel_bytes = static_cast<std::uint32_t>(backend::bytes_per_pixel(target->config(), part.plane));
    copy_part(*state_->gpu, *commands, source, *slice);
    return core::Done{};
}

}  // namespace gnomon::vulkan
