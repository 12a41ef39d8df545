#pragma once
// The independent check on the truth: Embree in ROBUST mode, given the same floats.

#include <gnomon/pipeline/frame.hpp>

#include <cstdint>
#include <vector>

namespace truth {

/// Per sample of the frame: 1 if Embree finds nothing between it and the light, 0 if it does. Embree is asked about the
/// open segment to a point light, or the ray toward a directional one; the sample's own triangle is filtered out.
///
/// Throws std::runtime_error when Embree fails.
[[nodiscard]] std::vector<std::uint8_t> embree_lit(gnomon::pipeline::Frame const& frame);

}  // namespace truth
