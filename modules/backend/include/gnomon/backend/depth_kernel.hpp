#pragma once
// A depth kernel: gives each pixel of a part of a target a depth of its own. A map that scrolls is made of the one before
// by such a kernel.
//
// The GLSL half is a fragment shader that writes gl_FragDepth; it sees buffers, targets and constants as a `Kernel`'s does,
// and its pixel in gl_FragCoord. A unorm16 target rounds what it writes to the nearest code.

#include <gnomon/backend/kernel.hpp>
#include <gnomon/backend/pass.hpp>

#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>

namespace gnomon::backend {

/// One row of pixels to write.
struct DepthRow {
    std::byte* first = nullptr;  ///< Pixel (x, y): a float, or a uint16_t for unorm16 codes.
    std::int32_t x = 0;
    std::int32_t y = 0;
    std::int32_t width = 0;
    DepthFormat format = DepthFormat::f32;

    /// expects: T is float or uint16_t, as the format has it.
    template <class T>
    [[nodiscard]] std::span<T> depths() const noexcept {
        return {reinterpret_cast<T*>(first), static_cast<std::size_t>(width)};
    }
};

/// Writes every pixel of a row. Rows run in any order and at the same time.
using DepthFunction = void (*)(KernelData const& data, DepthRow const& row);

/// Plain data, as a `Kernel` is. Backends know it by its address: it must outlive them.
struct DepthKernel {
    std::string_view name;
    DepthFunction cpu = nullptr;
    std::span<std::uint32_t const> spirv;  ///< Empty: no GPU half.
    std::uint32_t buffers = 0;             ///< A call has exactly so many, and so on.
    std::uint32_t targets = 0;
    std::uint32_t constant_bytes = 0;  ///< A multiple of 4, at most `max_constant_bytes`.
};

/// Arguments of one run of it.
struct DepthCall {
    TargetId to;
    std::uint32_t layer = 0;
    Rect rect;  ///< Within the target. Pixels outside of it stay as they are.
    std::span<BufferId const> buffers{};
    std::span<TargetBinding const> targets{};  ///< None of them `to`.
    std::span<std::byte const> constants{};
};

}  // namespace gnomon::backend
