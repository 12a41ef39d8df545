#pragma once
// Transparent triangles in the order in which they are drawn.

#include <gnomon/pipeline/frame.hpp>

#include <cstdint>
#include <vector>

namespace gnomon::pipeline {

/// The frame's triangles whose material blends, the farthest centre first; of equal ones the lower id.
[[nodiscard]] std::vector<std::uint32_t> sort_back_to_front(Frame const& frame);

}  // namespace gnomon::pipeline
