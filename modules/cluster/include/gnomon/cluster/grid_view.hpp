#pragma once
// The planes that divide a view into clusters ("froxels"), as whoever culls against them sees it.
//
// View space of the culling: x to the right, y DOWN the image, depth in front of the eye (-z), float, relative to the
// eye. Row 0 is the top of the image. A cluster is the closed hexahedron, in exact arithmetic on these floats,
//
//     depth in [depth_m[k], depth_m[k + 1]],  x in [x[i], x[i + 1]] * depth,  y in [y[j], y[j + 1]] * depth
//
// and without the factor depth where the view is orthographic (x and y then are metres).

#include <gnomon/core/contract.hpp>

#include <cstddef>
#include <cstdint>
#include <span>

namespace gnomon::cluster {

/// expects: each list strictly ascending and of at least two values; `depth_m` above 0 with perspective; only the last
///          value of a list may be infinite, and the first of `x` and `y` minus infinity (an open border).
struct GridView {
    std::span<float const> x;        ///< columns + 1 borders; tangents, or metres
    std::span<float const> y;        ///< rows + 1 borders, y down
    std::span<float const> depth_m;  ///< slices + 1 borders
    bool perspective = true;

    [[nodiscard]] constexpr std::uint32_t columns() const noexcept { return static_cast<std::uint32_t>(x.size() - 1); }
    [[nodiscard]] constexpr std::uint32_t rows() const noexcept { return static_cast<std::uint32_t>(y.size() - 1); }
    [[nodiscard]] constexpr std::uint32_t slices() const noexcept { return static_cast<std::uint32_t>(depth_m.size() - 1); }
    [[nodiscard]] constexpr std::size_t clusters() const noexcept {
        return std::size_t{columns()} * rows() * slices();
    }

    /// The dense index of a cluster: columns run fastest, then rows, then slices.
    [[nodiscard]] constexpr std::size_t index(std::uint32_t column, std::uint32_t row, std::uint32_t slice) const {
        GNOMON_EXPECT(column < columns() && row < rows() && slice < slices());
        return (std::size_t{slice} * rows() + row) * columns() + column;
    }
};

}  // namespace gnomon::cluster
