#pragma once
// What a compute shader says about itself: group size, bindings, the layout of its blocks. Read from the SPIR-V, so that
// C++ and GLSL cannot drift apart unseen.

#include <gnomon/vulkan/error.hpp>

#include <vulkan/vulkan_core.h>

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace gnomon::vulkan {

/// A resource that a shader declares.
struct ShaderBinding {
    std::uint32_t set = 0;
    std::uint32_t binding = 0;
    VkDescriptorType type = VK_DESCRIPTOR_TYPE_MAX_ENUM;  ///< MAX_ENUM: a kind that the adapters do not bind.
    bool read_only = false;  ///< A buffer that is `readonly` as a whole.
};

struct ShaderInterface {
    std::array<std::uint32_t, 3> local_size{0, 0, 0};  ///< 0 where the shader leaves it to a specialization.
    std::vector<ShaderBinding> bindings;
    std::uint32_t constant_bytes = 0;  ///< End of the last member of the push constants.
    bool reads_group_count = false;    ///< gl_NumWorkGroups: the shader knows its place in a grid of any shape.
};

/// returns: the interface, or `shader_rejected` with `name` where the words are no whole SPIR-V.
[[nodiscard]] Result<ShaderInterface> reflect(std::span<std::uint32_t const> words, std::string_view name);

/// A member of a struct in a buffer or in push constants.
struct ShaderMember {
    std::string name;
    std::uint32_t offset = 0;
    std::uint32_t bytes = 0;  ///< 0 for an array without a size.

    friend bool operator==(ShaderMember const&, ShaderMember const&) = default;
};

/// The members of the struct or block of this name as the shader lays them out, for a test against offsetof.
///
/// expects: words not stripped of their names; `reflect` accepts them.
/// returns: empty where there is no such struct, or it has no layout.
[[nodiscard]] std::vector<ShaderMember> members_of(std::span<std::uint32_t const> words, std::string_view struct_name);

}  // namespace gnomon::vulkan
