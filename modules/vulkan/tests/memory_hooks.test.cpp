// The caller's own allocator: everything comes from its three blocks, at offsets, and goes back to it.

#include "pass_rig.hpp"
#include "pass_scenes.hpp"
#include "test_host.hpp"
#include "test_kernels.hpp"

#include <gnomon/check/check.hpp>
#include <gnomon/vulkan/backend.hpp>

#include <vulkan/vulkan.h>

#include <algorithm>
#include <numeric>
#include <vector>

using namespace gnomon;
using namespace gnomon::vulkan::test;

namespace {

/// One block for each use, filled from its start, as an engine's allocator does it. `is_coherent` off: the adapters must
/// flush and invalidate, which is legal on any memory.
class Blocks {
  public:
    Blocks(vulkan::GpuConfig const& config, bool is_coherent) : device_(config.device), is_coherent_(is_coherent) {
        VkPhysicalDeviceMemoryProperties properties;
        vkGetPhysicalDeviceMemoryProperties(config.physical, &properties);
        for (Block& block : blocks_) {
            VkMemoryAllocateInfo info{};
            info.sType = VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO;
            info.allocationSize = size;
            while ((properties.memoryTypes[info.memoryTypeIndex].propertyFlags & VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT) == 0)
                ++info.memoryTypeIndex;
            REQUIRE(vkAllocateMemory(device_, &info, nullptr, &block.handle) == VK_SUCCESS);
            REQUIRE(vkMapMemory(device_, block.handle, 0, VK_WHOLE_SIZE, 0, &block.mapped) == VK_SUCCESS);
            block.type = info.memoryTypeIndex;
        }
    }
    ~Blocks() {
        for (Block const& block : blocks_) vkFreeMemory(device_, block.handle, nullptr);
    }
    Blocks(Blocks const&) = delete;
    Blocks& operator=(Blocks const&) = delete;

    [[nodiscard]] vulkan::MemoryHooks hooks() {
        return {this,
                [](void* self, VkMemoryRequirements const& need, vulkan::MemoryUse use, vulkan::Memory& out) {
                    return static_cast<Blocks*>(self)->take(need, use, out);
                },
                [](void* self, vulkan::Memory const& memory) { static_cast<Blocks*>(self)->give_back(memory); }};
    }

    std::size_t taken = 0;
    std::size_t given_back = 0;
    std::size_t at_offsets = 0;

  private:
    static constexpr VkDeviceSize size = VkDeviceSize{48} << 20U;

    struct Block {
        VkDeviceMemory handle = VK_NULL_HANDLE;
        void* mapped = nullptr;
        VkDeviceSize used = 256;  // Nothing lies at 0.
        std::uint32_t type = 0;
    };

    VkResult take(VkMemoryRequirements const& need, vulkan::MemoryUse use, vulkan::Memory& out) {
        Block& block = blocks_[static_cast<std::size_t>(use)];
        if (((need.memoryTypeBits >> block.type) & 1U) == 0) return VK_ERROR_OUT_OF_DEVICE_MEMORY;
        // Flushed ranges are whole atoms, and images stand apart from buffers: 4096 is enough for both.
        VkDeviceSize const alignment = std::max<VkDeviceSize>(need.alignment, 4096);
        VkDeviceSize const offset = (block.used + alignment - 1) / alignment * alignment;
        if (offset + need.size > size) return VK_ERROR_OUT_OF_DEVICE_MEMORY;
        block.used = offset + need.size;
        bool const is_mapped = use != vulkan::MemoryUse::device;
        out.handle = block.handle;
        out.offset = offset;
        out.size = need.size;
        out.mapped = is_mapped ? static_cast<char*>(block.mapped) + offset : nullptr;
        out.coherent = is_coherent_;
        out.user = this;
        ++taken;
        at_offsets += offset != 0 ? 1U : 0U;
        return VK_SUCCESS;
    }

    void give_back(vulkan::Memory const& memory) {
        CHECK(memory.user == this);
        ++given_back;
    }

    VkDevice device_;
    bool is_coherent_;
    Block blocks_[3];
};

Pixels draw_with(Device& device, vulkan::GpuRef gpu) {
    PassRig rig(device, std::move(gpu));
    Soup const soup = make_soup(7, 40, 1.0F);
    backend::Draw const draw = soup.draw();
    backend::TargetConfig const config{.size_px = {64, 64}, .triangle_ids = true};
    return rig.draw_all({&draw, 1}, config, std::vector<std::vector<backend::PassLayer>>{{layer_of(camera(config.size_px))}});
}

std::vector<std::uint32_t> run_with(Device& device, vulkan::GpuRef gpu) {
    TestHost host(device);
    auto const b = vulkan::Backend::make(std::move(gpu), host.host());
    REQUIRE(b);
    constexpr std::uint32_t n = 1000;
    std::vector<std::uint32_t> values(n);
    std::iota(values.begin(), values.end(), 5U);
    auto const in = (*b)->make_buffer(n * 4);
    auto const out = (*b)->make_buffer(n * 4);
    REQUIRE(in);
    REQUIRE(out);
    backend::BufferId const buffers[] = {*in, *out};
    Affine const affine{n, 3, 1};
    CHECK((*b)->write(*in, 0, std::as_bytes(std::span(values))));
    CHECK((*b)->run(affine_kernel, {n, buffers, {}, backend::bytes_of(affine)}));
    CHECK((*b)->read(*out, 0, std::as_writable_bytes(std::span(values))));
    CHECK((*b)->finish());
    return values;
}

}  // namespace

TEST_CASE("the caller's allocator gives all memory, coherent or not, and gets it back", "[vulkan][memory]") {
    auto const device = Device::make();
    REQUIRE(device != nullptr);
    Pixels const expected = draw_with(*device, device->gpu());
    std::vector<std::uint32_t> const values = run_with(*device, device->gpu());
    CHECK(values[10] == 15 * 3 + 1);
    for (bool const is_coherent : {true, false}) {
        CAPTURE(is_coherent);
        Blocks blocks(device->config(), is_coherent);
        vulkan::GpuConfig config = device->config();
        config.memory = blocks.hooks();
        {
            auto const gpu = vulkan::make_gpu(config);
            REQUIRE(gpu);
            Pixels const drawn = draw_with(*device, *gpu);
            CHECK(drawn.depth == expected.depth);
            CHECK(drawn.triangle == expected.triangle);
            CHECK(run_with(*device, *gpu) == values);
            CHECK(device->live().made.at("memory") == 0);  // none but the blocks', which are not counted
        }
        CHECK(blocks.taken > 5);
        CHECK(blocks.at_offsets == blocks.taken);
        CHECK(blocks.given_back == blocks.taken);
        CHECK(device->live().total() == 0);
    }
    CHECK(device->take_messages() == "");
}
