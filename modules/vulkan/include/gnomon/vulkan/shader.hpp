#pragma once
// Shader modules from SPIR-V words, with arithmetic that no driver may contract or take for that of ordinary numbers.

#include <gnomon/vulkan/gpu.hpp>

#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

namespace gnomon::vulkan {

/// The module with every float addition, subtraction, multiplication, division and dot product marked NoContraction,
/// as `precise` would.
///
/// Formulas that decide integers give the same bits on every device only if products and sums are rounded one by one. A
/// `precise` on each local is easily forgotten, and a caller of a function cannot add it; so the loader marks them all.
/// returns: the words as they are where they are no SPIR-V.
[[nodiscard]] std::vector<std::uint32_t> without_contraction(std::span<std::uint32_t const> words);

/// What a shader's 32-bit arithmetic is asked to keep to.
struct FloatControls {
    bool nan_and_zero_signs = false;  ///< Else a comparison and a choice may become a minimum that knows neither.
    bool denormals = false;
    bool round_to_nearest = false;
};

/// All that the device can be asked for.
[[nodiscard]] FloatControls float_controls_of(Properties const& properties) noexcept;

/// The module with these asked for at every entry point (SPV_KHR_float_controls).
///
/// returns: the words as they are where they are no SPIR-V, or nothing is asked for.
[[nodiscard]] std::vector<std::uint32_t> with_float_controls(std::span<std::uint32_t const> words, FloatControls const& controls);

/// returns: the module of `without_contraction(words)` with all float controls that the device has, or `shader_rejected` with `name`.
[[nodiscard]] Result<UniqueShader> make_shader(GpuRef const& gpu, std::span<std::uint32_t const> words,
                                               std::string_view name);

}  // namespace gnomon::vulkan
