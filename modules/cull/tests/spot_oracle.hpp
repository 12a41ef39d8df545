#pragma once
// The truth about spots of less than a right angle: does the sector of a ball meet a cluster? By GJK on the support
// functions of both, in double: a separating plane proves "no", a simplex round the origin proves "yes".

#include "oracle.hpp"

#include <algorithm>
#include <vector>

namespace gnomon::test {

struct V3 {
    double x = 0, y = 0, z = 0;
    friend V3 operator+(V3 a, V3 b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
    friend V3 operator-(V3 a, V3 b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
    friend V3 operator*(V3 a, double s) { return {a.x * s, a.y * s, a.z * s}; }
};
inline double dot(V3 a, V3 b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
inline V3 cross(V3 a, V3 b) { return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x}; }
inline double norm(V3 a) { return std::sqrt(dot(a, a)); }
inline V3 to_v3(math::vec3 const& v) { return {static_cast<double>(v.x), static_cast<double>(v.y), static_cast<double>(v.z)}; }

/// Apex, ball and cone; `hull` alone where `range` is 0 (boxes): any convex hull of points.
struct Solid {
    V3 apex, axis;
    double range = 0, cosine = 1, sine = 0;
    std::vector<V3> hull;

    [[nodiscard]] V3 middle() const {
        V3 sum;
        for (V3 const& p : hull) sum = sum + p * (1.0 / static_cast<double>(hull.size()));
        return sum;
    }
    [[nodiscard]] V3 farthest(V3 n) const {
        if (range <= 0) return *std::max_element(hull.begin(), hull.end(), [&](V3 a, V3 b) { return dot(a, n) < dot(b, n); });
        double const length = norm(n), along = dot(n, axis) / length;
        if (along >= cosine) return apex + n * (range / length);
        V3 side = n * (1 / length) - axis * along;
        double const s = norm(side);
        side = s > 1e-12 ? side * (1 / s) : cross(axis, std::abs(axis.x) < 0.5 ? V3{1, 0, 0} : V3{0, 1, 0});
        V3 const rim = axis * (range * cosine) + side * (range * sine / std::max(1e-300, norm(side)));
        return dot(rim, n) > 0 ? apex + rim : apex;
    }
};

inline Solid solid_of_spot(math::vec3 const& center, float range, math::vec3 const& axis, double cosine, double sine) {
    Solid s;
    s.apex = to_v3(center);
    V3 const a = to_v3(axis);
    s.axis = a * (1 / norm(a));
    s.range = static_cast<double>(range);
    double const unit = std::sqrt(cosine * cosine + sine * sine);
    s.cosine = cosine / unit;
    s.sine = sine / unit;
    return s;
}

/// The ends of an interval; an open one ends a good way off the other.
inline std::array<double, 2> ends_of(float low, float high) {
    std::array<double, 2> e{static_cast<double>(low), static_cast<double>(high)};
    if (!std::isfinite(low)) e[0] = std::isfinite(high) ? e[1] - 2 * std::abs(e[1]) - 10 : -10;
    if (!std::isfinite(high)) e[1] = e[0] + 2 * std::abs(e[0]) + 10;
    return e;
}

/// The corners of a cluster; an open one is cut off (a smaller cluster: what touches it touches the true one).
inline Solid solid_of_cell(cluster::GridView const& g, Cell c) {
    Solid s;
    auto const x = ends_of(g.x[c.column], g.x[c.column + 1]), y = ends_of(g.y[c.row], g.y[c.row + 1]);
    auto const depth = ends_of(g.depth_m[c.slice], g.depth_m[c.slice + 1]);
    for (unsigned i = 0; i < 8; ++i) {
        double const d = depth[i & 1U], f = g.perspective ? d : 1.0;
        s.hull.push_back({x[i >> 1U & 1U] * f, y[i >> 2U & 1U] * f, d});
    }
    return s;
}

struct Simplex {
    V3 p[4];
    int count = 0;
};

/// The nearest point to the origin of the hull of a simplex, which is cut down to the points that carry it.
inline V3 nearest(Simplex& s) {
    V3 best;
    double best_sq = 1e300;
    int best_set = 1;
    for (int set = 1; set < 1 << s.count; ++set) {  // every face whose own nearest point has positive weights
        V3 q[4];
        int n = 0;
        for (int i = 0; i < s.count; ++i)
            if ((set >> i & 1) != 0) q[n++] = s.p[i];
        std::array<std::array<double, 3>, 3> gram{};
        std::array<double, 3> rhs{}, w{};
        for (int i = 1; i < n; ++i) {
            rhs[static_cast<std::size_t>(i - 1)] = -dot(q[0], q[i] - q[0]);
            for (int j = 1; j < n; ++j) gram[static_cast<std::size_t>(i - 1)][static_cast<std::size_t>(j - 1)] = dot(q[i] - q[0], q[j] - q[0]);
        }
        if (n > 1) {
            double const scale = std::max({gram[0][0], gram[1][1], gram[2][2]});
            if (!(scale > 0)) continue;
            for (auto& row : gram)
                for (double& x : row) x /= scale;
            for (double& x : rhs) x /= scale;
            if (!solve(gram, rhs, static_cast<std::size_t>(n - 1), w, 1e-28)) continue;
        }
        double const first = 1 - w[0] - w[1] - w[2];
        if (first < 0 || w[0] < 0 || w[1] < 0 || w[2] < 0) continue;
        V3 v = q[0];
        for (int i = 1; i < n; ++i) v = v + (q[i] - q[0]) * w[static_cast<std::size_t>(i - 1)];
        if (dot(v, v) < best_sq) {
            best_sq = dot(v, v);
            best = v;
            best_set = set;
        }
    }
    Simplex kept;
    for (int i = 0; i < s.count; ++i)
        if ((best_set >> i & 1) != 0) kept.p[kept.count++] = s.p[i];
    s = kept;
    return best;
}

/// returns: undecided where the gap, or the overlap, is below 1e-9 of the size, or the search does not end.
inline Touch solids_touch(Solid const& a, Solid const& b, double size) {
    V3 v = (a.range > 0 ? a.apex : a.middle()) - b.middle();  // no corner: its ray would meet the ball's farthest point
    Simplex s;
    s.p[s.count++] = v;
    for (int step = 0; step < 200; ++step) {
        double const length = norm(v);
        if (length < 1e-9 * size) return Touch::undecided;
        V3 const w = a.farthest(v * -1.0) - b.farthest(v);
        double const bound = dot(v, w) / length;
        if (bound > 1e-9 * size) return Touch::no;
        if (length - bound < 1e-12 * size) return Touch::undecided;
        s.p[s.count++] = w;
        v = nearest(s);
        if (s.count == 4) return Touch::yes;
    }
    return Touch::undecided;
}

}  // namespace gnomon::test
