#include <gnomon/vulkan/target.hpp>

#include <string>

namespace gnomon::vulkan {

namespace {

/// What a use touches. `depth` and `triangle` stages differ for attachments only.
struct Access {
    VkImageLayout layout;
    VkPipelineStageFlags2 depth_stages;
    VkPipelineStageFlags2 triangle_stages;
    VkAccessFlags2 depth_access;
    VkAccessFlags2 triangle_access;
};

/// The same for colours: as triangles, but for what shading does.
Access color_access_of(TargetUse use) noexcept;

Access access_of(TargetUse use) noexcept {
    constexpr VkPipelineStageFlags2 tests =
        VK_PIPELINE_STAGE_2_EARLY_FRAGMENT_TESTS_BIT | VK_PIPELINE_STAGE_2_LATE_FRAGMENT_TESTS_BIT;
    constexpr VkPipelineStageFlags2 shaders = VK_PIPELINE_STAGE_2_VERTEX_SHADER_BIT |
                                              VK_PIPELINE_STAGE_2_FRAGMENT_SHADER_BIT |
                                              VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT;
    constexpr VkPipelineStageFlags2 copies = VK_PIPELINE_STAGE_2_ALL_TRANSFER_BIT;
    constexpr VkAccessFlags2 reads = VK_ACCESS_2_TRANSFER_READ_BIT;
    constexpr VkAccessFlags2 writes = VK_ACCESS_2_TRANSFER_WRITE_BIT;
    switch (use) {
        case TargetUse::nothing: return {VK_IMAGE_LAYOUT_UNDEFINED, 0, 0, 0, 0};
        case TargetUse::draw:
            return {VK_IMAGE_LAYOUT_ATTACHMENT_OPTIMAL, tests, VK_PIPELINE_STAGE_2_COLOR_ATTACHMENT_OUTPUT_BIT,
                    VK_ACCESS_2_DEPTH_STENCIL_ATTACHMENT_READ_BIT | VK_ACCESS_2_DEPTH_STENCIL_ATTACHMENT_WRITE_BIT,
                    VK_ACCESS_2_COLOR_ATTACHMENT_READ_BIT | VK_ACCESS_2_COLOR_ATTACHMENT_WRITE_BIT};
        case TargetUse::shade:
            return {VK_IMAGE_LAYOUT_ATTACHMENT_OPTIMAL, tests, VK_PIPELINE_STAGE_2_FRAGMENT_SHADER_BIT,
                    VK_ACCESS_2_DEPTH_STENCIL_ATTACHMENT_READ_BIT | VK_ACCESS_2_DEPTH_STENCIL_ATTACHMENT_WRITE_BIT,
                    VK_ACCESS_2_SHADER_SAMPLED_READ_BIT};
        case TargetUse::count:
            return {Target::sampled_layout, tests, tests, VK_ACCESS_2_DEPTH_STENCIL_ATTACHMENT_READ_BIT, 0};
        case TargetUse::sample:
            return {Target::sampled_layout, shaders, shaders, VK_ACCESS_2_SHADER_SAMPLED_READ_BIT,
                    VK_ACCESS_2_SHADER_SAMPLED_READ_BIT};
        case TargetUse::copy_from: return {VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL, copies, copies, reads, reads};
        case TargetUse::copy_to: return {VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, copies, copies, writes, writes};
        case TargetUse::copy_within:
            return {VK_IMAGE_LAYOUT_GENERAL, copies, copies, reads | writes, reads | writes};
    }
    return {VK_IMAGE_LAYOUT_UNDEFINED, 0, 0, 0, 0};
}

Access color_access_of(TargetUse use) noexcept { return access_of(use == TargetUse::shade ? TargetUse::draw : use); }

/// What a use finds the triangle ids in.
VkImageLayout triangle_layout_of(TargetUse use) noexcept {
    return use == TargetUse::shade ? Target::sampled_layout : access_of(use).layout;
}

constexpr bool only_reads(TargetUse use) noexcept {
    return use == TargetUse::count || use == TargetUse::sample || use == TargetUse::copy_from;
}

struct Layouts {
    VkImageLayout from;
    VkImageLayout to;
};

VkImageMemoryBarrier2 image_barrier(Image const& image, Layouts const& layouts) noexcept {
    VkImageMemoryBarrier2 barrier{};
    barrier.sType = VK_STRUCTURE_TYPE_IMAGE_MEMORY_BARRIER_2;
    barrier.oldLayout = layouts.from;
    barrier.newLayout = layouts.to;
    barrier.srcQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED;
    barrier.dstQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED;
    barrier.image = image.handle.get();
    barrier.subresourceRange = {image.aspect, 0, 1, 0, image.config.layers};
    return barrier;
}

Result<std::vector<UniqueImageView>> make_layer_views(GpuRef const& gpu, Image const& image) {
    std::vector<UniqueImageView> views;
    views.reserve(image.config.layers);
    for (std::uint32_t layer = 0; layer < image.config.layers; ++layer) {
        VkImageViewCreateInfo info{};
        info.sType = VK_STRUCTURE_TYPE_IMAGE_VIEW_CREATE_INFO;
        info.image = image.handle.get();
        info.viewType = VK_IMAGE_VIEW_TYPE_2D;
        info.format = image.config.format;
        info.subresourceRange = {image.aspect, 0, 1, layer, 1};
        VkImageView view = VK_NULL_HANDLE;
        VkResult const result = gpu->call.CreateImageView(gpu->device, &info, gpu->host, &view);
        if (result != VK_SUCCESS) return failure_of(result, "vkCreateImageView of layer " + std::to_string(layer));
        views.emplace_back(gpu, view);
    }
    return views;
}

constexpr VkImageUsageFlags common_usage =
    VK_IMAGE_USAGE_SAMPLED_BIT | VK_IMAGE_USAGE_TRANSFER_SRC_BIT | VK_IMAGE_USAGE_TRANSFER_DST_BIT;

}  // namespace

Result<Target> make_target(GpuRef const& gpu, backend::TargetConfig const& config) {
    if (config.size_px.x < 1 || config.size_px.y < 1)
        return core::Failure{Error::bad_argument, "a target of " + std::to_string(config.size_px.x) + " x " +
                                                      std::to_string(config.size_px.y) +
                                                      " pixels: every side must be at least 1"};
    Target target;
    target.gpu_ = gpu;
    target.config_ = config;
    ImageConfig image{};
    image.format = config.depth == backend::DepthFormat::f32 ? VK_FORMAT_D32_SFLOAT : VK_FORMAT_D16_UNORM;
    image.extent = {static_cast<std::uint32_t>(config.size_px.x), static_cast<std::uint32_t>(config.size_px.y)};
    image.layers = config.layers;
    image.usage = VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT | common_usage;
    auto depth = make_image(gpu, image);
    if (!depth) return std::move(depth).failure();
    target.depth_ = *std::move(depth);
    if (config.triangle_ids) {
        image.format = VK_FORMAT_R32_UINT;
        image.usage = VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT | common_usage;
        auto triangle = make_image(gpu, image);
        if (!triangle) return std::move(triangle).failure();
        target.triangle_ = *std::move(triangle);
    }
    if (config.color) {
        image.format = color_format;
        image.usage = VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT | common_usage;
        auto color = make_image(gpu, image);
        if (!color) return std::move(color).failure();
        target.color_ = *std::move(color);
        auto color_views = make_layer_views(gpu, target.color_);
        if (!color_views) return std::move(color_views).failure();
        target.color_views_ = *std::move(color_views);
    }
    auto depth_views = make_layer_views(gpu, target.depth_);
    if (!depth_views) return std::move(depth_views).failure();
    target.depth_views_ = *std::move(depth_views);
    bool const draws_all_layers = gpu->features.layer_from_vertex_shader || gpu->features.geometry_shader;
    if (!config.triangle_ids || draws_all_layers) return target;
    auto triangle_views = make_layer_views(gpu, target.triangle_);
    if (!triangle_views) return std::move(triangle_views).failure();
    target.triangle_views_ = *std::move(triangle_views);
    return target;
}

VkImageLayout Target::layout() const noexcept { return access_of(use_).layout; }

VkImageView Target::depth_view_of(std::uint32_t layer) const noexcept {
    return layer < depth_views_.size() ? depth_views_[layer].get() : VK_NULL_HANDLE;
}

VkImageView Target::triangle_view_of(std::uint32_t layer) const noexcept {
    return layer < triangle_views_.size() ? triangle_views_[layer].get() : VK_NULL_HANDLE;
}

VkImageView Target::color_view_of(std::uint32_t layer) const noexcept {
    return layer < color_views_.size() ? color_views_[layer].get() : VK_NULL_HANDLE;
}

void Target::prepare(VkCommandBuffer commands, TargetUse use) {
    if (use == use_ && only_reads(use)) return;
    VkImageMemoryBarrier2 barriers[3];
    std::uint32_t count = 0;
    auto const add = [&](Image const& image, Access const& from, Access const& to, Layouts const& layouts, bool depth) {
        VkImageMemoryBarrier2& barrier = barriers[count++] = image_barrier(image, layouts);
        barrier.srcStageMask = depth ? from.depth_stages : from.triangle_stages;
        barrier.srcAccessMask = only_reads(use_) ? 0 : depth ? from.depth_access : from.triangle_access;
        barrier.dstStageMask = depth ? to.depth_stages : to.triangle_stages;
        barrier.dstAccessMask = depth ? to.depth_access : to.triangle_access;
    };
    Access const from = access_of(use_);
    Access const to = access_of(use);
    add(depth_, from, to, {from.layout, to.layout}, true);
    if (config_.triangle_ids) add(triangle_, from, to, {triangle_layout_of(use_), triangle_layout_of(use)}, false);
    if (config_.color) add(color_, color_access_of(use_), color_access_of(use), {from.layout, to.layout}, false);
    VkDependencyInfo info{};
    info.sType = VK_STRUCTURE_TYPE_DEPENDENCY_INFO;
    info.imageMemoryBarrierCount = count;
    info.pImageMemoryBarriers = barriers;
    gpu_->call.CmdPipelineBarrier2(commands, &info);
    use_ = use;
    is_defined_ = is_defined_ || use == TargetUse::draw || use == TargetUse::shade || use == TargetUse::copy_to || use == TargetUse::copy_within;
}

}  // namespace gnomon::vulkan
