#pragma once
// Shader modules from SPIR-V words, with arithmetic that no driver may contract.

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

/// returns: the module of `without_contraction(words)`, or `shader_rejected` with `name`.
[[nodiscard]] Result<UniqueShader> make_shader(GpuRef const& gpu, std::span<std::uint32_t const> words,
                                               std::string_view name);

}  // namespace gnomon::vulkan
