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

constexpr std::uint32_t extension = 10;
constexpr std::uint32_t entry_point = 15;
constexpr std::uint32_t execution_mode = 16;
constexpr std::uint32_t capability = 17;

/// A capability and the execution mode that it allows, for floats of 32 bits.
struct FloatMode {
    std::uint32_t capability;
    std::uint32_t mode;
};
constexpr FloatMode denorm_preserve{4464, 4459};
constexpr FloatMode signed_zero_inf_nan_preserve{4466, 4461};
constexpr FloatMode rounding_mode_rte{4467, 4462};

/// The words of OpExtension with a name, ended by a zero as SPIR-V's strings are.
std::vector<std::uint32_t> extension_words(std::string_view name) {
    std::vector<std::uint32_t> words(1 + name.size() / 4 + 1, 0U);
    words[0] = static_cast<std::uint32_t>(words.size()) << 16U | extension;
    for (std::size_t i = 0; i < name.size(); ++i)
        words[1 + i / 4] |= static_cast<std::uint32_t>(static_cast<unsigned char>(name[i])) << (i % 4 * 8U);
    return words;
}

/// Where the module's capabilities and its execution modes end, and its entry points; all 0 where the words are no SPIR-V.
struct ModuleHead {
    std::size_t capabilities_end = 0;
    std::size_t modes_end = 0;
    std::vector<std::uint32_t> entry_points;
};

ModuleHead head_of(std::span<std::uint32_t const> words) {
    ModuleHead head;
    if (words.size() < header_words || words[0] != magic) return {};
    for (std::size_t at = header_words; at < words.size();) {
        std::uint32_t const op = words[at] & 0xFFFFU;
        std::size_t const length = words[at] >> 16U;
        if (length == 0 || at + length > words.size()) return {};
        if (op == capability) head.capabilities_end = at + length;
        if (op == entry_point || op == execution_mode) head.modes_end = at + length;
        if (op == entry_point && length > 2) head.entry_points.push_back(words[at + 2]);
        at += length;
    }
    return head.capabilities_end != 0 && head.modes_end != 0 ? head : ModuleHead{};
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

FloatControls float_controls_of(Properties const& properties) noexcept {
    return {properties.keeps_nan_f32, properties.keeps_denormals_f32, properties.rounds_to_nearest_f32};
}

std::vector<std::uint32_t> with_float_controls(std::span<std::uint32_t const> words, FloatControls const& controls) {
    std::vector<std::uint32_t> out(words.begin(), words.end());
    ModuleHead const head = head_of(words);
    std::vector<FloatMode> asked;
    if (controls.nan_and_zero_signs) asked.push_back(signed_zero_inf_nan_preserve);
    if (controls.denormals) asked.push_back(denorm_preserve);
    if (controls.round_to_nearest) asked.push_back(rounding_mode_rte);
    if (head.entry_points.empty() || asked.empty()) return out;
    std::vector<std::uint32_t> capabilities;
    std::vector<std::uint32_t> modes;
    for (FloatMode const& mode : asked) {
        capabilities.insert(capabilities.end(), {(2U << 16U) | capability, mode.capability});
        for (std::uint32_t const entry : head.entry_points)
            modes.insert(modes.end(), {(4U << 16U) | execution_mode, entry, mode.mode, 32U});
    }
    std::vector<std::uint32_t> const name = extension_words("SPV_KHR_float_controls");
    capabilities.insert(capabilities.end(), name.begin(), name.end());
    out.insert(out.begin() + static_cast<std::ptrdiff_t>(head.modes_end), modes.begin(), modes.end());
    out.insert(out.begin() + static_cast<std::ptrdiff_t>(head.capabilities_end), capabilities.begin(), capabilities.end());
    return out;
}

Result<UniqueShader> make_shader(GpuRef const& gpu, std::span<std::uint32_t const> words, std::string_view name) {
    if (words.empty())
        return core::Failure{Error::shader_rejected, std::string(name) + ": there is no SPIR-V; glslc was missing when "
                                                                         "this was built"};
    std::vector<std::uint32_t> const exact = with_float_controls(without_contraction(words), float_controls_of(gpu->properties));
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
