#include <gnomon/vulkan/descriptors.hpp>

namespace gnomon::vulkan {

namespace {

constexpr std::uint32_t sets_per_pool = 64;
constexpr SetSize pool_size{.storage_buffers = 6 * sets_per_pool, .sampled_images = 2 * sets_per_pool};

}  // namespace

Result<core::Done> DescriptorRing::begin_frame(FrameCount const& count) {
    auto const slot = slot_of(count, static_cast<std::uint32_t>(slots_.size()));
    if (!slot) return slot.failure();
    now_ = *slot;
    slots_[now_].current = 0;
    for (Pool& pool : slots_[now_].pools) {
        VkResult const result = gpu_->call.ResetDescriptorPool(gpu_->device, pool.handle.get(), 0);
        if (result != VK_SUCCESS) return failure_of(result, "vkResetDescriptorPool");
        pool.sets_left = sets_per_pool;
        pool.left = pool_size;
    }
    return core::Done{};
}

Result<core::Done> DescriptorRing::add_pool(Slot& slot) {
    VkDescriptorPoolSize const sizes[] = {{VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, pool_size.storage_buffers},
                                          {VK_DESCRIPTOR_TYPE_SAMPLED_IMAGE, pool_size.sampled_images}};
    VkDescriptorPoolCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_POOL_CREATE_INFO;
    info.maxSets = sets_per_pool;
    info.poolSizeCount = 2;
    info.pPoolSizes = sizes;
    VkDescriptorPool pool = VK_NULL_HANDLE;
    VkResult const result = gpu_->call.CreateDescriptorPool(gpu_->device, &info, gpu_->host, &pool);
    if (result != VK_SUCCESS) return failure_of(result, "vkCreateDescriptorPool");
    slot.pools.push_back({UniqueDescriptorPool(gpu_, pool), sets_per_pool, pool_size});
    return core::Done{};
}

Result<VkDescriptorSet> DescriptorRing::take(VkDescriptorSetLayout layout, SetSize const& size) {
    Slot& slot = slots_[now_];
    auto const fits = [&](Pool const& pool) {
        return pool.sets_left > 0 && pool.left.storage_buffers >= size.storage_buffers &&
               pool.left.sampled_images >= size.sampled_images;
    };
    while (slot.current < slot.pools.size() && !fits(slot.pools[slot.current])) ++slot.current;
    if (slot.current == slot.pools.size())
        if (auto added = add_pool(slot); !added) return std::move(added).failure();
    Pool& pool = slot.pools[slot.current];
    if (!fits(pool)) return core::Failure{Error::too_large, "a descriptor set of more bindings than a pool has"};
    VkDescriptorSetAllocateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_SET_ALLOCATE_INFO;
    info.descriptorPool = pool.handle.get();
    info.descriptorSetCount = 1;
    info.pSetLayouts = &layout;
    VkDescriptorSet set = VK_NULL_HANDLE;
    VkResult const result = gpu_->call.AllocateDescriptorSets(gpu_->device, &info, &set);
    if (result != VK_SUCCESS) return failure_of(result, "vkAllocateDescriptorSets");
    --pool.sets_left;
    pool.left.storage_buffers -= size.storage_buffers;
    pool.left.sampled_images -= size.sampled_images;
    return set;
}

}  // namespace gnomon::vulkan
