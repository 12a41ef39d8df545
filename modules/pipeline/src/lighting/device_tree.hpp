#pragma once
// The light tree as the C++ halves of kernels read it.

#include <gnomon/math/formula/touch.glsl>

#include "device_kernels.hpp"

#include <cstddef>
#include <span>

namespace gnomon::pipeline {

inline constexpr std::uint32_t tree_width = 32;

/// The arrays of a tree that kernels read.
struct TreeBuffers {
    std::span<float const> items;
    std::span<float const> nodes;
    DeviceStateStd const& state;

    [[nodiscard]] formula::GnBox<float> item_box(std::size_t slot) const noexcept {
        std::size_t const slots = state.item_slots;
        return gn_box_of(formula::GnSphere<float>{formula::Vec3<float>(items[slot], items[slots + slot], items[2 * slots + slot]),
                                                  formula::Float<float>(items[3 * slots + slot])});
    }
    [[nodiscard]] formula::GnBox<float> node_box(std::uint32_t level, std::size_t node) const noexcept {
        std::size_t const slots = state.node_slots;
        std::size_t const at = state.first[level] + node;
        return {formula::Vec3<float>(nodes[at], nodes[slots + at], nodes[2 * slots + at]),
                formula::Vec3<float>(nodes[3 * slots + at], nodes[4 * slots + at], nodes[5 * slots + at])};
    }
};

}  // namespace gnomon::pipeline
