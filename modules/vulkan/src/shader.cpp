#include <gnomon/vulkan/shader.hpp>

#include <string>

namespace gnomon::vulkan {

namespace {

constexpr std::uint32_t magic = 0x07230203U;
constexpr std::size_t header_words = 5;
constexpr std::uint32_t decorate = 71;
constexpr std::uint32_t no_contraction_mark = 42;

/// Whether contraction concerns the instruction: float sums, products and what is made of them.
constexpr bool is_arithmetic(std::uint32_t op) noexcept {
    switch (op) {
        case 127:  // OpFNegate
        case 129:  // OpFAdd
        case 131:  // OpFSub
        case 133:  // OpFMul
        case 136:  // OpFDiv
        case 140:  // OpFRem
        case 141:  // OpFMod
        case 142:  // OpVectorTimesScalar
        case 143:  // OpMatrixTimesScalar
        case 144:  // OpVectorTimesMatrix
        case 145:  // OpMatrixTimesVector
        case 146:  // OpMatrixTimesMatrix
        case 147:  // OpOuterProduct
        case 148:  // OpDot
            return true;
        default: return false;
    }
}

/// Annotations end where types, constants and variables begin.
constexpr bool begins_types(std::uint32_t op) noexcept { return op >= 19 && op <= 59; }

}  // namespace

std::vector<std::uint32_t> without_contraction(std::span<std::uint32_t const> words) {
    std::vector<std::uint32_t> out(words.begin(), words.end());
    if (words.size() < header_words || words[0] != magic) return out;
    std::size_t types = 0;
    std::vector<std::uint32_t> marks;
    std::vector<std::uint32_t> marked(words[3], 0);
    for (std::size_t at = header_words; at < words.size();) {
        std::uint32_t const op = words[at] & 0xFFFFU;
        std::size_t const length = words[at] >> 16U;
        if (length == 0 || at + length > words.size()) return out;
        if (types == 0 && begins_types(op)) types = at;
        bool const is_mark = op == decorate && length == 3 && words[at + 2] == no_contraction_mark;
        if (is_mark && words[at + 1] < marked.size()) marked[words[at + 1]] = 1;
        if (is_arithmetic(op) && length > 2 && words[at + 2] < marked.size() && marked[words[at + 2]] == 0)
            marks.insert(marks.end(), {(3U << 16U) | decorate, words[at + 2], no_contraction_mark});
        at += length;
    }
    if (types != 0) out.insert(out.begin() + static_cast<std::ptrdiff_t>(types), marks.begin(), marks.end());
    return out;
}

Result<UniqueShader> make_shader(GpuRef const& gpu, std::span<std::uint32_t const> words, std::string_view name) {
    if (words.empty())
        return core::Failure{Error::shader_rejected, std::string(name) + ": there is no SPIR-V; glslc was missing when "
                                                                         "this was built"};
    std::vector<std::uint32_t> const exact = without_contraction(words);
    VkShaderModuleCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_SHADER_MODULE_CREATE_INFO;
    info.codeSize = exact.size() * sizeof(std::uint32_t);
    info.pCode = exact.data();
    VkShaderModule shader = VK_NULL_HANDLE;
    VkResult const result = gpu->call.CreateShaderModule(gpu->device, &info, gpu->host, &shader);
    if (result != VK_SUCCESS) return failure_of(result, "vkCreateShaderModule of " + std::string(name));
    return UniqueShader(gpu, shader);
}

}  // namespace gnomon::vulkan
