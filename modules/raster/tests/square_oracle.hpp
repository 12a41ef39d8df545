#pragma once
// Which points a triangle and a pixel's square share, by intersecting segments in 128-bit integers: no edge is moved,
// no maximum taken, nothing shared with the code under test.

#include "oracle.hpp"

#include <algorithm>
#include <optional>

namespace oracle {

using Points = std::array<WidePoint, 4>;

/// Sign of the area of (a, b, c).
inline int turn(WidePoint const& a, WidePoint const& b, WidePoint const& c) {
    Wide const area = (b.x - a.x) * (c.y - a.y) - (c.x - a.x) * (b.y - a.y);
    return area > 0 ? 1 : area < 0 ? -1 : 0;
}

inline bool on_segment(WidePoint const& a, WidePoint const& b, WidePoint const& p) {
    return turn(a, b, p) == 0 && std::min(a.x, b.x) <= p.x && p.x <= std::max(a.x, b.x) && std::min(a.y, b.y) <= p.y &&
           p.y <= std::max(a.y, b.y);
}

/// Closed segments a-b and c-d share a point.
inline bool segments_meet(WidePoint const& a, WidePoint const& b, WidePoint const& c, WidePoint const& d) {
    if (turn(a, b, c) * turn(a, b, d) < 0 && turn(c, d, a) * turn(c, d, b) < 0) return true;
    return on_segment(a, b, c) || on_segment(a, b, d) || on_segment(c, d, a) || on_segment(c, d, b);
}

/// A pixel's square, larger by `slack` on each side, and a triangle, in whole units.
struct SquareTruth {
    WideTriangle t;
    std::array<Quad, 3> z;
    WidePoint low, high;

    SquareTruth(SnappedTriangle const& from, std::int32_t px, std::int32_t py, std::int32_t slack)
        : low{Wide{px} * 256 - slack, Wide{py} * 256 - slack},
          high{Wide{px} * 256 + 256 + slack, Wide{py} * 256 + 256 + slack} {
        for (std::size_t i = 0; i < 3; ++i) {
            t[i] = {Wide{from[i].x}, Wide{from[i].y}};
            z[i] = static_cast<Quad>(from[i].z);
        }
    }
    [[nodiscard]] Points corners() const { return {low, {high.x, low.y}, high, {low.x, high.y}}; }
    [[nodiscard]] bool square_has(WidePoint const& p) const {
        return low.x <= p.x && p.x <= high.x && low.y <= p.y && p.y <= high.y;
    }
    [[nodiscard]] bool triangle_has(WidePoint const& p) const {
        int const a = turn(t[0], t[1], p);
        int const b = turn(t[1], t[2], p);
        int const c = turn(t[2], t[0], p);
        if (turn(t[0], t[1], t[2]) == 0)
            return on_segment(t[0], t[1], p) || on_segment(t[1], t[2], p) || on_segment(t[2], t[0], p);
        return (a >= 0 && b >= 0 && c >= 0) || (a <= 0 && b <= 0 && c <= 0);
    }
    [[nodiscard]] bool far_apart() const {
        auto const [x0, x1] = std::minmax({t[0].x, t[1].x, t[2].x});
        auto const [y0, y1] = std::minmax({t[0].y, t[1].y, t[2].y});
        return x1 < low.x || x0 > high.x || y1 < low.y || y0 > high.y;
    }
    [[nodiscard]] bool touched() const {
        if (far_apart()) return false;
        Points const c = corners();
        for (WidePoint const& p : t)
            if (square_has(p)) return true;
        for (WidePoint const& p : c)
            if (triangle_has(p)) return true;
        for (std::size_t i = 0; i < 3; ++i)
            for (std::size_t k = 0; k < 4; ++k)
                if (segments_meet(t[i], t[(i + 1) % 3], c[k], c[(k + 1) % 4])) return true;
        return false;
    }
    [[nodiscard]] bool covered() const {
        Points const c = corners();
        return turn(t[0], t[1], t[2]) != 0 && std::all_of(c.begin(), c.end(), [&](auto& p) { return triangle_has(p); });
    }

    struct Range {
        Quad least, greatest;
        void add(Quad d) {
            least = std::min(least, d);
            greatest = std::max(greatest, d);
        }
    };
    /// Depths over the shared points, to 113 bits: at the triangle's corners in the square, at the square's in the
    /// triangle, and where the triangle's edges cross the lines of the square's sides within them.
    [[nodiscard]] Range depths() const {
        Range range{static_cast<Quad>(1e30), static_cast<Quad>(-1e30)};
        for (std::size_t i = 0; i < 3; ++i)
            if (square_has(t[i])) range.add(z[i]);
        if (turn(t[0], t[1], t[2]) != 0)
            for (WidePoint const& p : corners())
                if (triangle_has(p)) range.add(plane_at(t, z, p));
        for (std::size_t i = 0; i < 3; ++i) {
            std::size_t const j = (i + 1) % 3;
            add_crossings(range, t[i].x, t[j].x, t[i].y, t[j].y, {z[i], z[j], low.x, high.x, low.y, high.y});
            add_crossings(range, t[i].y, t[j].y, t[i].x, t[j].x, {z[i], z[j], low.y, high.y, low.x, high.x});
        }
        return range;
    }

  private:
    struct Sides {
        Quad z0, z1;
        Wide u0, u1, v0, v1;
    };
    /// Crossings of the edge (u, v) -> (u', v') with the lines u = u0 and u = u1, where v is in [v0, v1].
    static void add_crossings(Range& range, Wide u, Wide to_u, Wide v, Wide to_v, Sides const& s) {
        Wide const du = to_u - u;
        if (du == 0) return;
        for (Wide const line : {s.u0, s.u1}) {
            if (line < std::min(u, to_u) || line > std::max(u, to_u)) continue;
            Wide const scaled = v * du + (to_v - v) * (line - u);  // v there, times du
            Wide const a = s.v0 * du;
            Wide const b = s.v1 * du;
            if (scaled < std::min(a, b) || scaled > std::max(a, b)) continue;
            range.add(s.z0 + (s.z1 - s.z0) * (static_cast<Quad>(line - u) / static_cast<Quad>(du)));
        }
    }
};

}  // namespace oracle
