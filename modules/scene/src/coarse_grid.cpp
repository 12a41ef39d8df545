#include "detail/coarse_grid.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace gnomon::scene::detail {

namespace {

using math::dvec3;
using math::ivec3;

constexpr std::uint32_t most_triangles = 4'000'000;
constexpr std::uint64_t most_entries = 24'000'000;
constexpr double infinite = std::numeric_limits<double>::infinity();

}  // namespace

CoarseGrid::CoarseGrid(Geometry const& geometry) : geometry_(geometry) {
    auto const count = static_cast<std::uint32_t>(geometry.indices.size() / 3);
    step_ = 1 + count / most_triangles;
    lo_ = math::to_double(geometry.bounds.lo);
    hi_ = math::to_double(geometry.bounds.hi);
    if (count == 0) lo_ = hi_ = dvec3(0.0);
    int longest_side = std::clamp(static_cast<int>(std::sqrt(static_cast<double>(count)) * 0.25), 4, 96);
    // Large triangles are listed in many cells; fewer cells then.
    while (choose_cells(longest_side) > most_entries && longest_side > 1) longest_side /= 2;
    fill();
}

std::size_t CoarseGrid::cell_index(ivec3 const& cell) const noexcept {
    return (static_cast<std::size_t>(cell.z) * static_cast<std::size_t>(cells_.y) + static_cast<std::size_t>(cell.y)) *
               static_cast<std::size_t>(cells_.x) +
           static_cast<std::size_t>(cell.x);
}

std::uint64_t CoarseGrid::choose_cells(int longest_side) {
    dvec3 const size = hi_ - lo_;
    double const longest = std::max({size.x, size.y, size.z, 1e-30});
    for (int axis = 0; axis < 3; ++axis) {
        cells_[axis] = std::clamp(static_cast<int>(size[axis] / longest * longest_side), 1, longest_side);
        cell_m_[axis] = std::max(size[axis] / cells_[axis], longest * 1e-6);
    }
    std::uint64_t entries = 0;
    for (std::uint32_t t = 0; t < geometry_.indices.size() / 3; t += step_) {
        Box const box = cells_of(t);
        ivec3 const n = box.hi - box.lo + ivec3(1);
        entries += static_cast<std::uint64_t>(n.x) * static_cast<std::uint64_t>(n.y) * static_cast<std::uint64_t>(n.z);
    }
    return entries;
}

CoarseGrid::Box CoarseGrid::cells_of(std::uint32_t triangle) const {
    Box box{cells_, ivec3(0)};
    for (std::size_t k = 0; k < 3; ++k) {
        dvec3 const p = math::to_double(geometry_.positions[geometry_.indices[std::size_t{triangle} * 3 + k]]);
        for (int axis = 0; axis < 3; ++axis) {
            // Corners are inside the bounds, so the quotient is at most the number of cells.
            int const cell = std::clamp(static_cast<int>((p[axis] - lo_[axis]) / cell_m_[axis]), 0, cells_[axis] - 1);
            box.lo[axis] = std::min(box.lo[axis], cell);
            box.hi[axis] = std::max(box.hi[axis], cell);
        }
    }
    return box;
}

void CoarseGrid::fill() {
    first_.assign(static_cast<std::size_t>(cells_.x) * static_cast<std::size_t>(cells_.y) * static_cast<std::size_t>(cells_.z) + 1, 0);
    auto const each = [&](auto visit) {
        for (std::uint32_t t = 0; t < geometry_.indices.size() / 3; t += step_) {
            Box const box = cells_of(t);
            for (int z = box.lo.z; z <= box.hi.z; ++z)
                for (int y = box.lo.y; y <= box.hi.y; ++y)
                    for (int x = box.lo.x; x <= box.hi.x; ++x) visit(cell_index({x, y, z}), t);
        }
    };
    each([&](std::size_t cell, std::uint32_t) { ++first_[cell + 1]; });
    for (std::size_t i = 1; i < first_.size(); ++i) first_[i] += first_[i - 1];
    triangles_.resize(first_.back());
    std::vector<std::uint32_t> next(first_.begin(), first_.end() - 1);
    each([&](std::size_t cell, std::uint32_t t) { triangles_[next[cell]++] = t; });
}

void CoarseGrid::test_cell(std::size_t cell, dvec3 const& start, dvec3 const& direction, GridHit& best) const {
    for (std::uint32_t i = first_[cell]; i < first_[cell + 1]; ++i) {
        std::size_t const t = triangles_[i];
        dvec3 const a = math::to_double(geometry_.positions[geometry_.indices[t * 3]]);
        dvec3 const ab = math::to_double(geometry_.positions[geometry_.indices[t * 3 + 1]]) - a;
        dvec3 const ac = math::to_double(geometry_.positions[geometry_.indices[t * 3 + 2]]) - a;
        dvec3 const p = glm::cross(direction, ac);
        double const det = glm::dot(ab, p);
        if (det == 0.0) continue;
        dvec3 const s = start - a;
        double const u = glm::dot(s, p) / det;
        dvec3 const q = glm::cross(s, ab);
        double const v = glm::dot(direction, q) / det;
        double const distance = glm::dot(ac, q) / det;
        if (!(u >= 0.0 && v >= 0.0 && u + v <= 1.0 && distance > 0.0 && distance < best.distance)) continue;
        best = {distance, static_cast<std::uint32_t>(t), det > 0.0};
    }
}

GridHit CoarseGrid::cast(dvec3 const& start, dvec3 const& direction) const {
    GridHit best;
    best.distance = infinite;
    double enter = 0.0;
    double leave = infinite;
    for (int axis = 0; axis < 3; ++axis) {
        double const a = (lo_[axis] - start[axis]) / direction[axis];
        double const b = (hi_[axis] - start[axis]) / direction[axis];
        if (direction[axis] == 0.0 && (start[axis] < lo_[axis] || start[axis] > hi_[axis])) return best;
        if (direction[axis] == 0.0) continue;
        enter = std::max(enter, std::min(a, b));
        leave = std::min(leave, std::max(a, b));
    }
    if (!(enter <= leave)) return best;
    ivec3 cell(0);
    dvec3 next(infinite);   // distance at which the ray passes into the next cell, per axis
    dvec3 stride(infinite);
    for (int axis = 0; axis < 3; ++axis) {
        double const at = (start[axis] + enter * direction[axis] - lo_[axis]) / cell_m_[axis];
        cell[axis] = std::clamp(static_cast<int>(std::clamp(at, 0.0, 1e6)), 0, cells_[axis] - 1);
        if (direction[axis] == 0.0) continue;
        double const border = lo_[axis] + (cell[axis] + (direction[axis] > 0.0 ? 1 : 0)) * cell_m_[axis];
        next[axis] = (border - start[axis]) / direction[axis];
        stride[axis] = cell_m_[axis] / std::abs(direction[axis]);
    }
    while (true) {
        test_cell(cell_index(cell), start, direction, best);
        int const axis = next.x <= next.y && next.x <= next.z ? 0 : next.y <= next.z ? 1 : 2;
        // A hit beyond this cell may not be the first: go on until the cell that holds it has been tested.
        if (best.distance <= next[axis] || !(next[axis] <= leave)) break;
        cell[axis] += direction[axis] > 0.0 ? 1 : -1;
        if (cell[axis] < 0 || cell[axis] >= cells_[axis]) break;
        next[axis] += stride[axis];
    }
    if (best.triangle == none) return best;
    for (DrawRange const& draw : geometry_.draws)
        if (draw.double_sided && best.triangle - draw.first_triangle < draw.triangle_count && best.triangle >= draw.first_triangle)
            best.front = true;
    return best;
}

}  // namespace gnomon::scene::detail
