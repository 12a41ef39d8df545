#pragma once
// The truth for cones against clusters: the cluster is halved until each part's ball lies outside of the cone, or a point
// is found inside. Works by angles and distances, none of which the tests under test use; any half angle.

#include <gnomon/cluster/grid_view.hpp>
#include <gnomon/math/cone.hpp>

#include "oracle.hpp"

#include <array>
#include <cmath>
#include <cstddef>

namespace gnomon::test {

struct ConeOracle {
    std::array<double, 3> apex{}, axis{};
    double range = 0, angle = 0;
    bool perspective = true;

    ConeOracle(math::Cone const& cone, bool perspective_view) : perspective(perspective_view) {
        math::dvec3 const a = math::to_double(cone.axis);
        double const length = std::sqrt(a.x * a.x + a.y * a.y + a.z * a.z);
        for (std::size_t k = 0; k < 3; ++k) {
            auto const i = static_cast<math::axis_t>(k);
            apex[k] = static_cast<double>(cone.apex[i]);
            axis[k] = a[i] / length;
        }
        range = static_cast<double>(cone.range);
        angle = static_cast<double>(cone.half_angle_rad);
    }

    /// Of a point from the cone; negative inside, by how far it may move.
    [[nodiscard]] double distance(std::array<double, 3> const& p) const {
        std::array<double, 3> v{};
        double along = 0;
        double square = 0;
        for (std::size_t k = 0; k < 3; ++k) {
            v[k] = p[k] - apex[k];
            along += v[k] * axis[k];
            square += v[k] * v[k];
        }
        double const length = std::sqrt(square);
        double rest = 0;
        for (std::size_t k = 0; k < 3; ++k) rest += (v[k] - along * axis[k]) * (v[k] - along * axis[k]);
        double const beyond = std::atan2(std::sqrt(rest), along) - angle;
        if (beyond <= 0) {
            double const to_border = -beyond < 1.5707963267948966 ? length * std::sin(-beyond) : length;
            return length > range ? length - range : -std::fmin(to_border, range - length);
        }
        if (beyond >= 1.5707963267948966) return length;
        double const foot = length * std::cos(beyond);
        if (foot <= range) return length * std::sin(beyond);
        return std::sqrt(square + range * range - 2 * length * range * std::cos(beyond));
    }

    /// lo and hi are (x, y, depth) in the grid's units; returns undecided after `budget` parts.
    [[nodiscard]] Touch touches(std::array<double, 3> const& lo, std::array<double, 3> const& hi, int& budget) const {
        std::array<std::array<double, 3>, 8> corner{};
        std::array<double, 3> middle{};
        for (std::size_t i = 0; i < 8; ++i) {
            double const depth = (i & 4U) != 0 ? hi[2] : lo[2];
            double const scale = perspective ? depth : 1;
            corner[i] = {((i & 1U) != 0 ? hi[0] : lo[0]) * scale, ((i & 2U) != 0 ? hi[1] : lo[1]) * scale, depth};
            for (std::size_t k = 0; k < 3; ++k) middle[k] += corner[i][k] / 8;
        }
        double const off = distance(middle);
        if (off <= -1e-9 * (range + 1)) return Touch::yes;
        double size = 0;
        for (auto const& c : corner) size = std::fmax(size, std::hypot(c[0] - middle[0], c[1] - middle[1], c[2] - middle[2]));
        if (off > size + 1e-9 * (size + range)) return Touch::no;
        if (--budget < 0 || size < 1e-9 * (range + 1)) return Touch::undecided;
        std::array<double, 3> const side{std::fabs(corner[7][0] - corner[6][0]), std::fabs(corner[7][1] - corner[5][1]), hi[2] - lo[2]};
        std::size_t const k = side[0] >= side[1] && side[0] >= side[2] ? 0U : side[1] >= side[2] ? 1U : 2U;
        auto first_hi = hi;
        auto second_lo = lo;
        first_hi[k] = second_lo[k] = (lo[k] + hi[k]) / 2;
        Touch const first = touches(lo, first_hi, budget);
        if (first == Touch::yes) return first;
        Touch const second = touches(second_lo, hi, budget);
        return second == Touch::no ? first : second;
    }
};

inline Touch cone_touches(cluster::GridView const& g, Cell c, math::Cone const& cone) {
    auto const at = [](std::span<float const> list, std::uint32_t i) { return static_cast<double>(list[i]); };
    int budget = 20000;
    return ConeOracle(cone, g.perspective)
        .touches({at(g.x, c.column), at(g.y, c.row), at(g.depth_m, c.slice)},
                 {at(g.x, c.column + 1), at(g.y, c.row + 1), at(g.depth_m, c.slice + 1)}, budget);
}

}  // namespace gnomon::test
