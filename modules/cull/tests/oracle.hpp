#pragma once
// The truth: does a ball touch a cluster? By projection onto every face, edge and vertex of the hexahedron, none of which
// the refinement uses: in double, and in __float128 where double cannot tell.

#include <gnomon/cluster/grid_view.hpp>
#include <gnomon/math/vec.hpp>

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

namespace gnomon::test {

enum class Touch : unsigned char { no, yes, undecided };

struct Cell {
    std::uint32_t column, row, slice;
};

template <class T>
struct Halfspaces {  // n.p <= b, unit normals; open borders have none
    std::array<std::array<T, 4>, 6> list{};
    std::size_t count = 0;

    void add(T x, T y, T d, T b) {
        T const square = x * x + y * y + d * d;
        // A root good to T's last bits out of double's: two steps of Newton's.
        T root = static_cast<T>(std::sqrt(static_cast<double>(square)));
        for (int i = 0; i < 2; ++i) root = (root + square / root) / 2;
        list[count++] = {x / root, y / root, d / root, b / root};
    }
};

template <class T>
Halfspaces<T> halfspaces_of(cluster::GridView const& g, Cell c) {
    Halfspaces<T> h;
    T const one = 1;
    auto const side = [&](float value, T sign, bool vertical) {
        if (!std::isfinite(value)) return;
        T const v = static_cast<T>(value);
        T const d = g.perspective ? -sign * v : T(0);
        h.add(vertical ? sign : T(0), vertical ? T(0) : sign, d, g.perspective ? T(0) : sign * v);
    };
    side(g.x[c.column], -one, true);
    side(g.x[c.column + 1], one, true);
    side(g.y[c.row], -one, false);
    side(g.y[c.row + 1], one, false);
    h.add(T(0), T(0), -one, -static_cast<T>(g.depth_m[c.slice]));
    if (std::isfinite(g.depth_m[c.slice + 1])) h.add(T(0), T(0), one, static_cast<T>(g.depth_m[c.slice + 1]));
    return h;
}

/// Solves a symmetric positive system of up to three unknowns; false where it is singular.
template <class T>
bool solve(std::array<std::array<T, 3>, 3> a, std::array<T, 3> b, std::size_t n, std::array<T, 3>& x, T least = T(1e-14)) {
    for (std::size_t i = 0; i < n; ++i) {
        if (!(a[i][i] > least)) return false;
        for (std::size_t k = i + 1; k < n; ++k) {
            T const f = a[k][i] / a[i][i];
            for (std::size_t j = i; j < n; ++j) a[k][j] -= f * a[i][j];
            b[k] -= f * b[i];
        }
    }
    for (std::size_t i = n; i-- > 0;) {
        x[i] = b[i];
        for (std::size_t j = i + 1; j < n; ++j) x[i] -= a[i][j] * x[j];
        x[i] /= a[i][i];
    }
    return true;
}

/// The squared distance of a point from a non-empty intersection of half-spaces: the nearest of its projections onto the
/// planes, edges and vertices that lies (within `slack`) inside.
template <class T>
T distance_sq(Halfspaces<T> const& h, std::array<T, 3> const& p, T slack) {
    T best = T(1e30);
    std::array<T, 6> off{};
    for (std::size_t i = 0; i < h.count; ++i)
        off[i] = h.list[i][0] * p[0] + h.list[i][1] * p[1] + h.list[i][2] * p[2] - h.list[i][3];
    for (unsigned set = 0; set < 1U << h.count; ++set) {
        if (__builtin_popcount(set) > 3) continue;
        std::array<std::size_t, 3> active{};
        std::size_t n = 0;
        for (std::size_t i = 0; i < h.count; ++i)
            if ((set >> i & 1U) != 0) active[n++] = i;
        std::array<std::array<T, 3>, 3> gram{};
        std::array<T, 3> rhs{}, lambda{};
        for (std::size_t i = 0; i < n; ++i) {
            rhs[i] = off[active[i]];
            for (std::size_t j = 0; j < n; ++j)
                for (std::size_t a = 0; a < 3; ++a) gram[i][j] += h.list[active[i]][a] * h.list[active[j]][a];
        }
        if (!solve(gram, rhs, n, lambda)) continue;
        std::array<T, 3> move{};
        for (std::size_t i = 0; i < n; ++i)
            for (std::size_t a = 0; a < 3; ++a) move[a] += lambda[i] * h.list[active[i]][a];
        bool inside = true;
        for (std::size_t i = 0; i < h.count && inside; ++i)
            inside = off[i] - (h.list[i][0] * move[0] + h.list[i][1] * move[1] + h.list[i][2] * move[2]) <= slack;
        T const square = move[0] * move[0] + move[1] * move[1] + move[2] * move[2];
        if (inside && square < best) best = square;
    }
    return best;
}

/// returns: undecided only within 1e-12 of touching, relative to the coordinates.
inline Touch ball_touches(cluster::GridView const& g, Cell c, math::vec3 const& center, float radius) {
    double const size = std::abs(static_cast<double>(center.x)) + std::abs(static_cast<double>(center.y)) +
                        std::abs(static_cast<double>(center.z)) + static_cast<double>(radius);
    auto const h = halfspaces_of<double>(g, c);
    std::array<double, 3> const p{static_cast<double>(center.x), static_cast<double>(center.y), static_cast<double>(center.z)};
    auto const r = static_cast<double>(radius);
    double const about = std::sqrt(distance_sq(h, p, 1e-11 * size)) - r;
    if (about > 1e-7 * size) return Touch::no;
    if (about < -1e-7 * size) return Touch::yes;
    auto const exact = halfspaces_of<__float128>(g, c);
    __float128 const square = distance_sq<__float128>(exact, {center.x, center.y, center.z}, static_cast<__float128>(1e-22 * size));
    __float128 const wanted = static_cast<__float128>(radius) * static_cast<__float128>(radius);
    __float128 const margin = static_cast<__float128>(1e-12 * size * (r + 1e-12 * size));
    if (square > wanted + margin) return Touch::no;
    return square < wanted - margin ? Touch::yes : Touch::undecided;
}

}  // namespace gnomon::test
