#include <gnomon/vulkan/resources.hpp>

#include <string>

namespace gnomon::vulkan {

namespace {

constexpr std::uint32_t no_type = ~0U;

/// The first memory type that is allowed and has all of `flags`.
std::uint32_t type_with(Gpu const& gpu, std::uint32_t allowed, VkMemoryPropertyFlags flags) noexcept {
    for (std::uint32_t i = 0; i < gpu.memory_properties.memoryTypeCount; ++i)
        if (((allowed >> i) & 1U) != 0 && (gpu.memory_properties.memoryTypes[i].propertyFlags & flags) == flags) return i;
    return no_type;
}

std::uint32_t type_for(Gpu const& gpu, std::uint32_t allowed, MemoryUse use) noexcept {
    constexpr VkMemoryPropertyFlags visible = VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT;
    std::uint32_t type = no_type;
    switch (use) {
        case MemoryUse::device: type = type_with(gpu, allowed, VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT); break;
        case MemoryUse::upload: type = type_with(gpu, allowed, visible | VK_MEMORY_PROPERTY_HOST_COHERENT_BIT); break;
        case MemoryUse::read_back: type = type_with(gpu, allowed, visible | VK_MEMORY_PROPERTY_HOST_CACHED_BIT); break;
    }
    if (type != no_type) return type;
    return type_with(gpu, allowed, use == MemoryUse::device ? 0 : visible);
}

VkResult allocate_alone(Gpu const& gpu, VkMemoryRequirements const& need, MemoryUse use, Memory& out) {
    std::uint32_t const type = type_for(gpu, need.memoryTypeBits, use);
    if (type == no_type) return VK_ERROR_OUT_OF_DEVICE_MEMORY;
    VkMemoryAllocateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO;
    info.allocationSize = need.size;
    info.memoryTypeIndex = type;
    VkResult result = gpu.call.AllocateMemory(gpu.device, &info, gpu.host, &out.handle);
    if (result != VK_SUCCESS) return result;
    out.size = need.size;
    out.coherent = (gpu.memory_properties.memoryTypes[type].propertyFlags & VK_MEMORY_PROPERTY_HOST_COHERENT_BIT) != 0;
    if (use == MemoryUse::device) return VK_SUCCESS;
    result = gpu.call.MapMemory(gpu.device, out.handle, 0, VK_WHOLE_SIZE, 0, &out.mapped);
    if (result != VK_SUCCESS) gpu.call.FreeMemory(gpu.device, out.handle, gpu.host);
    return result;
}

/// The range grown to whole atoms, as flushes want it.
VkMappedMemoryRange range_of(Gpu const& gpu, Memory const& memory, VkDeviceSize offset, VkDeviceSize size) noexcept {
    VkDeviceSize const atom = gpu.properties.limits.nonCoherentAtomSize;
    VkDeviceSize const begin = (memory.offset + offset) / atom * atom;
    VkDeviceSize const end = (memory.offset + offset + size + atom - 1) / atom * atom;
    VkMappedMemoryRange range{};
    range.sType = VK_STRUCTURE_TYPE_MAPPED_MEMORY_RANGE;
    range.memory = memory.handle;
    range.offset = begin;
    bool const is_alone = memory.offset == 0 && end >= memory.size;
    range.size = is_alone ? VK_WHOLE_SIZE : end - begin;
    return range;
}

Result<core::Done> check_image(Gpu const& gpu, ImageConfig const& config) {
    std::string const size = std::to_string(config.extent.width) + "x" + std::to_string(config.extent.height) + "x" +
                             std::to_string(config.layers);
    if (config.extent.width == 0 || config.extent.height == 0 || config.layers == 0)
        return core::Failure{Error::bad_argument, "an image of " + size + ": every side must be at least 1"};
    VkImageFormatProperties limits{};
    VkResult const result = gpu.call.GetPhysicalDeviceImageFormatProperties(
        gpu.physical, config.format, VK_IMAGE_TYPE_2D, VK_IMAGE_TILING_OPTIMAL, config.usage, 0, &limits);
    if (result == VK_ERROR_FORMAT_NOT_SUPPORTED)
        return core::Failure{Error::unsupported_format, std::string(gpu.properties.name) + " cannot use VkFormat " +
                                                            std::to_string(config.format) + " with usage " +
                                                            std::to_string(config.usage)};
    if (result != VK_SUCCESS) return failure_of(result, "vkGetPhysicalDeviceImageFormatProperties");
    if (config.extent.width > limits.maxExtent.width || config.extent.height > limits.maxExtent.height ||
        config.layers > limits.maxArrayLayers)
        return core::Failure{Error::too_large, "an image of " + size + ": " + gpu.properties.name + " takes at most " +
                                                   std::to_string(limits.maxExtent.width) + "x" +
                                                   std::to_string(limits.maxExtent.height) + "x" +
                                                   std::to_string(limits.maxArrayLayers)};
    return core::Done{};
}

Result<UniqueImageView> make_array_view(GpuRef const& gpu, Image const& image) {
    VkImageViewCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_IMAGE_VIEW_CREATE_INFO;
    info.image = image.handle.get();
    info.viewType = VK_IMAGE_VIEW_TYPE_2D_ARRAY;
    info.format = image.config.format;
    info.subresourceRange = {image.aspect, 0, 1, 0, image.config.layers};
    VkImageView view = VK_NULL_HANDLE;
    VkResult const result = gpu->call.CreateImageView(gpu->device, &info, gpu->host, &view);
    if (result != VK_SUCCESS) return failure_of(result, "vkCreateImageView");
    return UniqueImageView(gpu, view);
}

}  // namespace

Allocation::Allocation(Allocation&& other) noexcept
    : gpu_(std::move(other.gpu_)), memory_(std::exchange(other.memory_, {})) {}

Allocation& Allocation::operator=(Allocation&& other) noexcept {
    std::swap(gpu_, other.gpu_);
    std::swap(memory_, other.memory_);
    return *this;
}

Allocation::~Allocation() {
    if (gpu_ == nullptr || memory_.handle == VK_NULL_HANDLE) return;
    if (gpu_->memory.release != nullptr) gpu_->memory.release(gpu_->memory.context, memory_);
    else gpu_->call.FreeMemory(gpu_->device, memory_.handle, gpu_->host);
}

Result<Allocation> allocate(GpuRef const& gpu, VkMemoryRequirements const& need, MemoryUse use, std::string_view what) {
    Memory memory;
    VkResult const result = gpu->memory.allocate != nullptr ? gpu->memory.allocate(gpu->memory.context, need, use, memory)
                                                            : allocate_alone(*gpu, need, use, memory);
    if (result != VK_SUCCESS)
        return failure_of(result, "allocating " + std::to_string(need.size) + " bytes for " + std::string(what));
    return Allocation(gpu, memory);
}

Result<core::Done> flush(Gpu const& gpu, Memory const& memory, VkDeviceSize offset, VkDeviceSize size) {
    if (memory.coherent || size == 0) return core::Done{};
    VkMappedMemoryRange const range = range_of(gpu, memory, offset, size);
    VkResult const result = gpu.call.FlushMappedMemoryRanges(gpu.device, 1, &range);
    if (result != VK_SUCCESS) return failure_of(result, "vkFlushMappedMemoryRanges");
    return core::Done{};
}

Result<core::Done> invalidate(Gpu const& gpu, Memory const& memory, VkDeviceSize offset, VkDeviceSize size) {
    if (memory.coherent || size == 0) return core::Done{};
    VkMappedMemoryRange const range = range_of(gpu, memory, offset, size);
    VkResult const result = gpu.call.InvalidateMappedMemoryRanges(gpu.device, 1, &range);
    if (result != VK_SUCCESS) return failure_of(result, "vkInvalidateMappedMemoryRanges");
    return core::Done{};
}

Result<Buffer> make_buffer(GpuRef const& gpu, VkDeviceSize size, VkBufferUsageFlags usage, MemoryUse use) {
    if (size == 0) return core::Failure{Error::bad_argument, "a buffer of 0 bytes"};
    VkBufferCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO;
    info.size = size;
    info.usage = usage;
    VkBuffer handle = VK_NULL_HANDLE;
    VkResult result = gpu->call.CreateBuffer(gpu->device, &info, gpu->host, &handle);
    if (result != VK_SUCCESS) return failure_of(result, "vkCreateBuffer of " + std::to_string(size) + " bytes");
    Buffer buffer;
    buffer.handle = UniqueBuffer(gpu, handle);
    buffer.size = size;
    VkMemoryRequirements need;
    gpu->call.GetBufferMemoryRequirements(gpu->device, handle, &need);
    auto allocation = allocate(gpu, need, use, "a buffer");
    if (!allocation) return std::move(allocation).failure();
    buffer.allocation = *std::move(allocation);
    Memory const& memory = buffer.allocation.memory();
    result = gpu->call.BindBufferMemory(gpu->device, handle, memory.handle, memory.offset);
    if (result != VK_SUCCESS) return failure_of(result, "vkBindBufferMemory");
    return buffer;
}

VkImageAspectFlags aspect_of(VkFormat format) noexcept {
    bool const is_depth = format == VK_FORMAT_D32_SFLOAT || format == VK_FORMAT_D16_UNORM;
    return is_depth ? VK_IMAGE_ASPECT_DEPTH_BIT : VK_IMAGE_ASPECT_COLOR_BIT;
}

Result<Image> make_image(GpuRef const& gpu, ImageConfig const& config) {
    if (auto legal = check_image(*gpu, config); !legal) return std::move(legal).failure();
    VkImageCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_IMAGE_CREATE_INFO;
    info.imageType = VK_IMAGE_TYPE_2D;
    info.format = config.format;
    info.extent = {config.extent.width, config.extent.height, 1};
    info.mipLevels = 1;
    info.arrayLayers = config.layers;
    info.samples = VK_SAMPLE_COUNT_1_BIT;
    info.usage = config.usage;
    VkImage handle = VK_NULL_HANDLE;
    VkResult result = gpu->call.CreateImage(gpu->device, &info, gpu->host, &handle);
    if (result != VK_SUCCESS) return failure_of(result, "vkCreateImage");
    Image image;
    image.handle = UniqueImage(gpu, handle);
    image.config = config;
    image.aspect = aspect_of(config.format);
    VkMemoryRequirements need;
    gpu->call.GetImageMemoryRequirements(gpu->device, handle, &need);
    auto allocation = allocate(gpu, need, MemoryUse::device, "an image");
    if (!allocation) return std::move(allocation).failure();
    image.allocation = *std::move(allocation);
    Memory const& memory = image.allocation.memory();
    result = gpu->call.BindImageMemory(gpu->device, handle, memory.handle, memory.offset);
    if (result != VK_SUCCESS) return failure_of(result, "vkBindImageMemory");
    auto view = make_array_view(gpu, image);
    if (!view) return std::move(view).failure();
    image.array_view = *std::move(view);
    return image;
}

}  // namespace gnomon::vulkan
