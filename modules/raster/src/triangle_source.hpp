#pragma once
// A draw's triangles, corner by corner, for the passes that transform each as they need it.

#include "pieces.hpp"

#include <cstddef>
#include <cstdint>

namespace gnomon::raster::detail {

/// returns: false where an index is out of range.
[[nodiscard]] inline bool triangle_indices(SetupJob const& job, std::size_t triangle,
                                           std::uint32_t (&index)[3]) noexcept {
    bool good = true;
    for (std::size_t i = 0; i < 3; ++i) {
        std::size_t const at = triangle * 3 + i;
        index[i] = job.index32 != nullptr   ? job.index32[at]
                   : job.index16 != nullptr ? job.index16[at]
                                            : static_cast<std::uint32_t>(at);
        good = good && index[i] - job.first_corner < job.corner_count;
    }
    return good;
}

inline void read_position(VertexJob const& job, std::uint32_t index, float (&position)[3]) noexcept {
    __builtin_memcpy(position, job.positions + index * job.stride, sizeof position);
}

}  // namespace gnomon::raster::detail
