#pragma once
// Clusters in segments: neighbours of one row and slice, which ask the light tree as one.

#include <gnomon/cluster/bounds.hpp>
#include <gnomon/cull/normal_cone.hpp>
#include <gnomon/cull/rows.hpp>
#include <gnomon/lights/detail/sparse_rows.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace gnomon::lights::detail {

/// Clusters [first, last) of the order by dense index.
struct Segment {
    std::uint32_t first;
    std::uint32_t last;
};

/// The most columns of a segment, and the most that may lie empty within it.
inline constexpr std::uint32_t segment_columns = 8, segment_gap = 1;

/// Dense indices in the upper word, places in the caller's list in the lower one, ascending.
inline void order_clusters(cull::RowGrid const& grid, std::span<cluster::ClusterCoordinates const> at, std::vector<std::uint64_t>& order) {
    order.resize(at.size());
    for (std::size_t i = 0; i < at.size(); ++i) {
        cluster::ClusterCoordinates const& c = at[i];
        GNOMON_EXPECT(c.column < grid.columns && c.row < grid.rows && c.slice < grid.slices);
        std::uint64_t const dense = (std::uint64_t{c.slice} * grid.rows + c.row) * grid.columns + c.column;
        order[i] = dense << 32U | i;
    }
    if (!std::is_sorted(order.begin(), order.end())) std::sort(order.begin(), order.end());
}

inline void find_segments(cull::RowGrid const& grid, std::span<std::uint64_t const> order, std::vector<Segment>& segments) {
    segments.clear();
    std::uint64_t begin = 0, previous = 0;
    for (std::size_t i = 0; i < order.size(); ++i) {
        std::uint64_t const dense = order[i] >> 32U;
        bool const goes_on = i != 0 && dense / grid.columns == previous / grid.columns && dense - begin < segment_columns &&
                             dense - previous <= segment_gap + 1;
        if (!goes_on) {
            segments.push_back({static_cast<std::uint32_t>(i), 0});
            begin = dense;
        }
        segments.back().last = static_cast<std::uint32_t>(i + 1);
        previous = dense;
    }
}

/// The box of a segment's hexahedra, rounded outward; that of one cluster where `first == last`.
[[nodiscard]] inline math::Aabb box_of(cull::RowGrid const& grid, SegmentPlace const& at) noexcept {
    std::array const x{grid.left[at.first], grid.right[at.last]};
    std::array const y{grid.y[at.row], grid.y[at.row + 1]};
    std::array const depth_m{grid.depth_m[at.slice], grid.depth_m[at.slice + 1]};
    return cluster::implicit_bounds({x, y, depth_m, grid.perspective}, {});
}

/// The ball about a cluster's samples, for the cone of their normals; `slack_m` larger.
[[nodiscard]] inline formula::GnSphere<float> samples_ball(math::Aabb const& box, float slack_m) noexcept {
    math::Sphere ball = cull::ball_of(box);
    ball.radius = math::next_up(ball.radius + slack_m);
    return math::formula_sphere(ball);
}

}  // namespace gnomon::lights::detail
