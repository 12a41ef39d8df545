#pragma once
// From the caller's spans to the arrays that are copied to the device.

#include <gnomon/vulkan/draws.hpp>

#include "draw_list.hpp"

#include <map>
#include <span>
#include <tuple>
#include <vector>

namespace gnomon::vulkan::detail {

/// All arrays of a list on the host.
struct StagedDraws {
    std::vector<float> positions;
    std::vector<float> coordinates;
    std::vector<std::uint32_t> indices;
    std::vector<ItemData> items;
    std::vector<AlphaData> alpha_tests;
    std::vector<std::uint8_t> texels;
    std::vector<math::mat4> instances;
    std::vector<DrawCommand> commands;  ///< In the order of the draws, empty ones left out.
    std::vector<PositionRange> ranges;
    std::vector<GroupTriangles> groups;
    std::uint64_t triangles = 0;
    StagedFaults faults;
};

/// returns: the arrays, or `too_large` where 32 bits do not count them.
[[nodiscard]] Result<StagedDraws> stage_draws(std::span<backend::Draw const> draws, bool alpha_tests);

/// The least alpha in [0, 255] that passes: s / 255 * factor >= cutoff in double. +infinity where none passes, -1 where
/// all do.
struct LeastAlpha {
    float single;
    double exact;
};
[[nodiscard]] LeastAlpha least_alpha(double factor, double cutoff) noexcept;

}  // namespace gnomon::vulkan::detail
