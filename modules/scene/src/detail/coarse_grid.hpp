#pragma once
// A uniform grid over a frame's triangles, for the few thousand rays that choose a view. Good enough to look around with;
// what is visible for certain is the business of the trace module.

#include <gnomon/scene/flatten.hpp>

#include <cstdint>
#include <vector>

namespace gnomon::scene::detail {

struct GridHit {
    double distance = 0.0;  ///< In units of the direction's length; infinite where nothing is hit.
    std::uint32_t triangle = none;
    bool front = false;  ///< Seen from its front, or double-sided.
};

class CoarseGrid {
public:
    /// expects: `geometry` outlives the grid.
    explicit CoarseGrid(Geometry const& geometry);

    /// The first triangle on the ray, in work space.
    [[nodiscard]] GridHit cast(math::dvec3 const& start, math::dvec3 const& direction) const;

private:
    struct Box {
        math::ivec3 lo;
        math::ivec3 hi;
    };

    [[nodiscard]] Box cells_of(std::uint32_t triangle) const;
    [[nodiscard]] std::size_t cell_index(math::ivec3 const& cell) const noexcept;
    std::uint64_t choose_cells(int longest_side);
    void fill();
    void test_cell(std::size_t cell, math::dvec3 const& start, math::dvec3 const& direction, GridHit& best) const;

    Geometry const& geometry_;
    std::uint32_t step_ = 1;               ///< Every how many triangles one is kept; 1 but for giants.
    math::ivec3 cells_{1, 1, 1};
    math::dvec3 lo_{0.0, 0.0, 0.0};
    math::dvec3 hi_{0.0, 0.0, 0.0};
    math::dvec3 cell_m_{1.0, 1.0, 1.0};
    std::vector<std::uint32_t> first_;     ///< Where each cell's triangles start in `triangles_`; one more than cells.
    std::vector<std::uint32_t> triangles_;
};

}  // namespace gnomon::scene::detail
