#pragma once
// The independent check on the truth: Embree in ROBUST mode, given the same floats.

#include <gnomon/pipeline/frame.hpp>

#include <cstdint>
#include <vector>

namespace truth {

inline constexpr std::uint32_t no_blocker = ~0U;

/// Per sample of the frame: the triangle that Embree finds between it and the light, or `no_blocker`. Embree is asked
/// about the open segment to a point light, or the ray toward a directional one; the sample's own triangle is filtered
/// out.
///
/// Throws std::runtime_error when Embree fails.
[[nodiscard]] std::vector<std::uint32_t> embree_blockers(gnomon::pipeline::Frame const& frame);

}  // namespace truth
