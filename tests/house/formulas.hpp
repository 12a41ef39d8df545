#pragma once
// The formulas' SPIR-V: every sum, difference, product and quotient of floats must forbid contraction, or a driver may
// fuse two into one rounding and choose another texel than the CPU. `precise` in the GLSL says it; this finds what forgot.

#include "house.hpp"

#include <cstdint>
#include <cstring>
#include <set>

namespace house {

namespace spirv {

inline constexpr std::uint32_t magic = 0x07230203;
inline constexpr std::uint32_t op_ext_inst = 12;
inline constexpr std::uint32_t op_decorate = 71;
inline constexpr std::uint32_t no_contraction = 42;
inline constexpr std::uint32_t fma_instruction = 50;

/// OpFAdd, OpFSub, OpFMul, OpFDiv, OpFRem, OpFMod, and the products of vectors and matrices up to OpDot.
inline bool is_arithmetic(std::uint32_t op) {
    static std::set<std::uint32_t> const ops = {129, 131, 133, 136, 140, 141, 142, 143, 144, 145, 146, 147, 148};
    return ops.contains(op);
}

inline std::vector<std::uint32_t> words_of(std::string const& bytes) {
    std::vector<std::uint32_t> words(bytes.size() / 4);
    if (!words.empty()) std::memcpy(words.data(), bytes.data(), words.size() * 4);
    return words;
}

/// Calls `visit(op, operands...)` for every instruction; false if the words are no SPIR-V.
template <class Visit>
bool for_each_instruction(std::vector<std::uint32_t> const& words, Visit const& visit) {
    if (words.size() < 5 || words[0] != magic) return false;
    for (std::size_t at = 5; at < words.size();) {
        std::size_t const length = words[at] >> 16U;
        if (length == 0 || at + length > words.size()) return false;
        visit(words[at] & 0xFFFFU, words.data() + at + 1, length - 1);
        at += length;
    }
    return true;
}

} // namespace spirv

inline void check_formula(std::string const& path, std::string const& bytes, std::vector<Finding>& findings) {
    std::vector<std::uint32_t> const words = spirv::words_of(bytes);
    std::set<std::uint32_t> exact;
    std::size_t fusable = 0;
    bool const whole = spirv::for_each_instruction(words, [&](std::uint32_t op, std::uint32_t const* operands, std::size_t count) {
        if (op == spirv::op_decorate && count >= 2 && operands[1] == spirv::no_contraction) exact.insert(operands[0]);
        if (spirv::is_arithmetic(op) && count >= 2 && !exact.contains(operands[1])) ++fusable;
        if (op == spirv::op_ext_inst && count >= 4 && operands[3] == spirv::fma_instruction) ++fusable;
    });
    if (fusable != 0)
        findings.push_back({path, 0, std::to_string(fusable) + " operations may be contracted: give their results to `GN_PRECISE` locals"});
    if (!whole) findings.push_back({path, 0, "is no SPIR-V, or cut short"});
}

inline std::vector<Finding> check_formulas(Tree const& tree) {
    std::vector<Finding> findings;
    if (tree.empty()) findings.push_back({"formulas", 0, "there is no SPIR-V to check"});
    for (auto const& [path, bytes] : tree) check_formula(path, bytes, findings);
    return findings;
}

} // namespace house
