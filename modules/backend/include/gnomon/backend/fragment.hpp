#pragma once
// A fragment kernel: one function with two halves, C++ for the CPU and a fragment shader for a GPU, that gives each
// fragment of a pass its colour.
//
// The GLSL half includes <gnomon/backend/fragment.glsl>, which declares what it gets and gives, and early depth tests. It
// sees, in set 1, its storage buffers (`readonly`) at bindings 0, 1, ..., then the targets, both as a `Kernel` does; its
// push constants begin at byte `fragment_constant_offset`.

#include <gnomon/backend/kernel.hpp>
#include <gnomon/backend/pass.hpp>

#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>

namespace gnomon::backend {

inline constexpr std::uint32_t fragment_constant_offset = 64;
inline constexpr std::size_t max_fragment_constant_bytes = max_constant_bytes - fragment_constant_offset;

/// A pixel centre that a triangle covers, and that passed the depth test.
struct Fragment {
    std::uint32_t x = 0;  ///< Pixel.
    std::uint32_t y = 0;
    std::uint32_t triangle = 0;  ///< `Draw::first_triangle` + its place in the draw.
    float depth = 0.0F;
};

/// What a fragment kernel gives: a colour, or nothing.
struct FragmentColor {
    math::vec4 color{0.0F, 0.0F, 0.0F, 0.0F};
    bool discarded = false;
};

/// Gives fragments their colours. They come triangle by triangle in the order of the draws, and a pixel may come more than
/// once. Calls for different pixels run at the same time; `data.buffers` are not written.
using FragmentFunction = void (*)(KernelData const& data, std::span<Fragment const> fragments, std::span<FragmentColor> out);

/// Plain data, as a `Kernel` is. Backends know it by its address: it must outlive them.
struct FragmentKernel {
    std::string_view name;
    FragmentFunction cpu = nullptr;
    std::span<std::uint32_t const> spirv;  ///< Empty: no GPU half.
    std::uint32_t buffers = 0;             ///< A call has exactly so many, and so on.
    std::uint32_t targets = 0;
    std::uint32_t constant_bytes = 0;  ///< A multiple of 4, at most `max_fragment_constant_bytes`.
};

/// Which fragments are shaded.
enum class FragmentTest : std::uint8_t {
    nearer,   ///< Nearer than what the target holds, which then holds them: as `draw`. A kernel must discard none.
    visible,  ///< At the very depth that the target holds: after a `draw` of the same list. Depth stays.
    behind_nothing,  ///< Nearer than what the target holds; depth stays: transparent surfaces, in the order of the draws.
};

/// What becomes of a fragment's colour c over the pixel's p.
enum class Blend : std::uint8_t {
    replace_and_add,  ///< rgb: c. Alpha: c + p, which counts what was shaded, overdraw too.
    over,             ///< All four: c + (1 - c.a) p, c's rgb times its alpha already. Alpha becomes the coverage.
};

/// Arguments of one pass of a fragment kernel.
struct FragmentCall {
    std::span<BufferId const> buffers{};
    std::span<TargetBinding const> targets{};  ///< Of the target that is drawn, only its triangle ids.
    std::span<std::byte const> constants{};
    FragmentTest test = FragmentTest::nearer;
    Blend blend = Blend::replace_and_add;
    Load color = Load::clear;  ///< Of the pass's area, to zeros. `PassLayer::load` is the depth's.
};

}  // namespace gnomon::backend
