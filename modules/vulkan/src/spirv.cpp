#include <gnomon/vulkan/spirv.hpp>

#include <algorithm>

namespace gnomon::vulkan {

// A namespace of its own: other files of a unity build name parts of SPIR-V too.
namespace spirv {
namespace {

constexpr std::uint32_t magic = 0x07230203U;
constexpr std::size_t header_words = 5;
constexpr std::uint32_t no_value = ~0U;

enum Op : std::uint32_t {
    inst_name = 5, inst_member_name = 6, inst_execution_mode = 16, inst_int = 21, inst_float = 22, inst_vector = 23, inst_matrix = 24,
    inst_image = 25, inst_array = 28, inst_struct = 30, inst_pointer = 32, inst_constant = 43, inst_variable = 59, inst_decorate = 71,
    inst_member_decorate = 72, inst_execution_mode_id = 331,
};
enum Decoration : std::uint32_t {
    array_stride = 6, matrix_stride = 7, built_in = 11, non_writable = 24, binding = 33, descriptor_set = 34, offset = 35,
};
enum Storage : std::uint32_t { uniform_constant = 0, uniform = 2, push_constant = 9, storage_buffer = 12 };
constexpr std::uint32_t mode_local_size = 17;
constexpr std::uint32_t mode_local_size_id = 38;
constexpr std::uint32_t built_in_group_count = 24;

/// An instruction: operand 0 is the first word after the op.
struct Instruction {
    std::uint32_t op = 0;
    std::span<std::uint32_t const> operands;

    /// 0 where there is none, so that no shader makes the reader run out of a span.
    [[nodiscard]] std::uint32_t operator[](std::size_t i) const noexcept { return i < operands.size() ? operands[i] : 0; }
};

class Module {
  public:
    explicit Module(std::span<std::uint32_t const> words) {
        if (words.size() < header_words || words[0] != magic) return;
        for (std::size_t at = header_words; at < words.size();) {
            std::size_t const length = words[at] >> 16U;
            if (length == 0 || at + length > words.size()) return;
            all_.push_back({words[at] & 0xFFFFU, words.subspan(at + 1, length - 1)});
            at += length;
        }
        is_whole_ = !all_.empty();
    }

    [[nodiscard]] bool is_whole() const noexcept { return is_whole_; }
    [[nodiscard]] std::vector<Instruction> const& all() const noexcept { return all_; }

    /// The type, constant or variable of an id.
    [[nodiscard]] Instruction find(std::uint32_t id) const noexcept {
        for (Instruction const& i : all_) {
            bool const is_type = i.op >= inst_int - 2 && i.op <= inst_pointer;
            bool const is_value = i.op == inst_constant || i.op == inst_variable;
            if ((is_type && i[0] == id) || (is_value && i[1] == id)) return i;
        }
        return {};
    }
    [[nodiscard]] std::uint32_t decoration(std::uint32_t id, std::uint32_t which) const noexcept {
        for (Instruction const& i : all_)
            if (i.op == inst_decorate && i[0] == id && i[1] == which) return i[2];
        return no_value;
    }
    [[nodiscard]] std::uint32_t decoration(std::uint32_t id, std::uint32_t member, std::uint32_t which) const noexcept {
        for (Instruction const& i : all_)
            if (i.op == inst_member_decorate && i[0] == id && i[1] == member && i[2] == which) return i[3];
        return no_value;
    }

    /// Bytes of a type; `stride` is that of a matrix's columns. `depth` ends what a broken module makes endless.
    [[nodiscard]] std::uint32_t bytes_of(std::uint32_t id, std::uint32_t stride, int depth = 0) const noexcept {
        if (depth > 16) return 0;
        Instruction const type = find(id);
        switch (type.op) {
            case inst_int:
            case inst_float: return type[1] / 8;
            case inst_vector: return type[2] * bytes_of(type[1], 0, depth + 1);
            case inst_matrix: return type[2] * stride;
            case inst_array: return find(type[2])[2] * decoration(id, array_stride);
            case inst_struct: return struct_bytes(type, depth);
            default: return 0;
        }
    }
    [[nodiscard]] std::uint32_t struct_bytes(Instruction const& type, int depth = 0) const noexcept {
        std::uint32_t end = 0;
        for (std::uint32_t m = 0; m + 1 < type.operands.size(); ++m) end = std::max(end, member_end(type, m, depth));
        return end;
    }
    [[nodiscard]] std::uint32_t member_end(Instruction const& type, std::uint32_t m, int depth = 0) const noexcept {
        std::uint32_t const start = decoration(type[0], m, offset);
        if (start == no_value) return 0;
        return start + bytes_of(type[1 + m], decoration(type[0], m, matrix_stride), depth + 1);
    }

  private:
    std::vector<Instruction> all_;
    bool is_whole_ = false;
};

/// The literal string that begins at operand `first`.
std::string text_at(Instruction const& i, std::size_t first) {
    std::string text;
    for (std::size_t w = first; w < i.operands.size(); ++w)
        for (std::uint32_t byte = 0; byte < 4; ++byte) {
            auto const c = static_cast<char>((i.operands[w] >> (8 * byte)) & 0xFFU);
            if (c == '\0') return text;
            text += c;
        }
    return text;
}

VkDescriptorType type_of(Module const& module, Instruction const& variable) noexcept {
    if (variable[2] == storage_buffer) return VK_DESCRIPTOR_TYPE_STORAGE_BUFFER;
    if (variable[2] == uniform) return VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER;
    Instruction const pointee = module.find(module.find(variable[0])[2]);
    bool const is_sampled_image = pointee.op == inst_image && pointee[6] == 1;
    return is_sampled_image ? VK_DESCRIPTOR_TYPE_SAMPLED_IMAGE : VK_DESCRIPTOR_TYPE_MAX_ENUM;
}

/// GLSL's `readonly` stands on the variable or on every member of its block.
bool is_read_only(Module const& module, Instruction const& variable) noexcept {
    auto const is_marked = [](Instruction const& i, std::size_t at) {
        return i.operands.size() > at && i.operands[at] == non_writable;
    };
    Instruction const block = module.find(module.find(variable[0])[2]);
    if (block.op != inst_struct || block.operands.size() < 2) return false;
    std::size_t marked = 0;
    for (Instruction const& i : module.all()) {
        if (i.op == inst_decorate && i[0] == variable[1] && is_marked(i, 1)) return true;
        if (i.op == inst_member_decorate && i[0] == block[0] && is_marked(i, 2)) ++marked;
    }
    return marked + 1 == block.operands.size();
}

void add_variable(Module const& module, Instruction const& variable, ShaderInterface& out) {
    std::uint32_t const storage = variable[2];
    if (storage == push_constant)
        out.constant_bytes = std::max(out.constant_bytes, module.bytes_of(module.find(variable[0])[2], 0));
    if (storage != storage_buffer && storage != uniform && storage != uniform_constant) return;
    ShaderBinding b;
    b.set = module.decoration(variable[1], descriptor_set);
    b.binding = module.decoration(variable[1], binding);
    b.type = type_of(module, variable);
    b.read_only = is_read_only(module, variable);
    out.bindings.push_back(b);
}

}  // namespace
}  // namespace spirv

Result<ShaderInterface> reflect(std::span<std::uint32_t const> words, std::string_view name) {
    using namespace spirv;
    Module const module(words);
    if (!module.is_whole())
        return core::Failure{Error::shader_rejected, std::string(name) + ": " + std::to_string(words.size()) +
                                                         " words that are no whole SPIR-V module"};
    ShaderInterface out;
    for (Instruction const& i : module.all()) {
        if (i.op == inst_execution_mode && i[1] == mode_local_size) out.local_size = {i[2], i[3], i[4]};
        if (i.op == inst_execution_mode_id && i[1] == mode_local_size_id)
            out.local_size = {module.find(i[2])[2], module.find(i[3])[2], module.find(i[4])[2]};
        if (i.op == inst_decorate && i[1] == built_in && i[2] == built_in_group_count) out.reads_group_count = true;
        if (i.op == inst_variable) add_variable(module, i, out);
    }
    std::sort(out.bindings.begin(), out.bindings.end(), [](ShaderBinding const& a, ShaderBinding const& b) {
        return a.set != b.set ? a.set < b.set : a.binding < b.binding;
    });
    return out;
}

std::vector<ShaderMember> members_of(std::span<std::uint32_t const> words, std::string_view struct_name) {
    using namespace spirv;
    Module const module(words);
    for (Instruction const& named : module.all()) {
        if (named.op != inst_name || text_at(named, 1) != struct_name) continue;
        Instruction const type = module.find(named[0]);
        if (type.op != inst_struct || module.decoration(type[0], 0, offset) == no_value) continue;
        std::vector<ShaderMember> members;
        for (std::uint32_t m = 0; m + 1 < type.operands.size(); ++m) {
            ShaderMember member;
            member.offset = module.decoration(type[0], m, offset);
            member.bytes = module.member_end(type, m) - member.offset;
            for (Instruction const& i : module.all())
                if (i.op == inst_member_name && i[0] == type[0] && i[1] == m) member.name = text_at(i, 2);
            members.push_back(std::move(member));
        }
        return members;
    }
    return {};
}

}  // namespace gnomon::vulkan
