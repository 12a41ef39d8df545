#pragma once
// A kernel: one function with two halves, C++ for the CPU and SPIR-V for a GPU, over buffers, targets and constants.
//
// The GLSL half sees, in set 0, the storage buffers at bindings 0, 1, ... in the call's order, then the targets as
// texture2DArray or utexture2DArray (texelFetch; GL_EXT_samplerless_texture_functions); the constants are its push
// constants. Its local size is 64 in x, one invocation an item: what it must know of their number is in the constants,
// and it returns where gl_GlobalInvocationID is at or beyond it. Structs in buffers are laid out by std430.

#include <gnomon/backend/pass.hpp>
#include <gnomon/core/contract.hpp>
#include <gnomon/core/id.hpp>
#include <gnomon/math/vec.hpp>

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <string_view>
#include <type_traits>

namespace gnomon::backend {

using DrawListId = core::Id<struct DrawListTag>;
using TargetId = core::Id<struct TargetTag>;
using BufferId = core::Id<struct BufferTag>;

inline constexpr std::size_t max_constant_bytes = 128;
inline constexpr std::size_t max_kernel_buffers = 12;
inline constexpr std::size_t max_kernel_targets = 4;
inline constexpr std::uint32_t kernel_local_size = 64;

/// A plane of a target as the C++ half of a kernel reads it: packed rows, packed layers.
struct TexelView {
    std::byte const* data = nullptr;
    math::ivec2 size_px{0, 0};
    std::uint32_t layers = 0;
    DepthFormat depth = DepthFormat::f32;
    Plane plane = Plane::depth;

    /// Row 0 of an array layer; rows are `size_px.x` texels apart.
    ///
    /// expects: T is float, or uint16_t for unorm16 codes, or uint32_t for triangle ids, as the plane has them.
    template <class T>
    [[nodiscard]] T const* layer(std::uint32_t i) const noexcept {
        GNOMON_EXPECT(i < layers);
        std::size_t const texels = static_cast<std::size_t>(size_px.x) * static_cast<std::size_t>(size_px.y);
        return reinterpret_cast<T const*>(data) + i * texels;
    }
};

/// What the C++ half of a kernel works on. Valid during the call.
struct KernelData {
    std::span<std::span<std::byte> const> buffers;
    std::span<TexelView const> targets;
    std::span<std::byte const> constants;

    /// The whole elements of buffer `i`; the first is aligned to 64 bytes.
    template <class T>
    requires std::is_trivially_copyable_v<T>
    [[nodiscard]] std::span<T> buffer(std::size_t i) const noexcept {
        GNOMON_EXPECT(i < buffers.size());
        return {reinterpret_cast<T*>(buffers[i].data()), buffers[i].size() / sizeof(T)};
    }
    /// A copy of the constants.
    template <class T>
    requires std::is_trivially_copyable_v<T>
    [[nodiscard]] T constant() const noexcept {
        GNOMON_EXPECT(sizeof(T) == constants.size());
        T value;
        std::memcpy(&value, constants.data(), sizeof(T));
        return value;
    }
};

/// Does items [begin, end). Ranges run in any order and at the same time; a kernel writes no item of another range, but by
/// atomic operations (std::atomic_ref) whose order makes no difference.
///
/// A shader whose groups of 64 work together has 64 items a group: its C++ half does those groups that begin in the range.
using KernelFunction = void (*)(KernelData const& data, std::size_t begin, std::size_t end);

/// Plain data, usually a constant of the program. Backends know a kernel by its address: it must outlive them.
struct Kernel {
    std::string_view name;
    KernelFunction cpu = nullptr;
    std::span<std::uint32_t const> spirv;  ///< Empty: the kernel has no GPU half, and a GPU answers missing_feature.
    std::uint32_t buffers = 0;             ///< A call has exactly so many, and so on.
    std::uint32_t targets = 0;
    std::uint32_t constant_bytes = 0;  ///< A multiple of 4, at most `max_constant_bytes`.
    std::size_t grain = 4096;          ///< Items that one CPU task takes.
};

struct TargetBinding {
    TargetId target;
    Plane plane = Plane::depth;
};

/// Arguments of one run of a kernel.
struct KernelCall {
    std::size_t count = 0;  ///< Items; 0 is legal and does nothing.
    std::span<BufferId const> buffers;
    std::span<TargetBinding const> targets;
    std::span<std::byte const> constants;
};

/// A value's bytes, for `KernelCall::constants` and `Backend::write`.
///
/// expects: the value outlives the call.
template <class T>
requires std::is_trivially_copyable_v<T>
[[nodiscard]] std::span<std::byte const> bytes_of(T const& value) noexcept {
    return std::as_bytes(std::span<T const, 1>(&value, 1));
}

}  // namespace gnomon::backend
