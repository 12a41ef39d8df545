#pragma once
// Lights and clusters that nearly touch, in every kind of grid: in and behind the eye, across near and far planes,
// off-centre and jittered windows, open borders and slices, orthographic views, from millimetres to kilometres.

#include "spot_oracle.hpp"

#include <gnomon/cluster/grid_view.hpp>
#include <gnomon/math/vec.hpp>

#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

namespace gnomon::test {

struct Draw {
    std::uint64_t state;

    std::uint64_t bits() {
        state += 0x9E3779B97F4A7C15U;
        std::uint64_t z = state;
        z = (z ^ (z >> 30U)) * 0xBF58476D1CE4E5B9U;
        z = (z ^ (z >> 27U)) * 0x94D049BB133111EBU;
        return z ^ (z >> 31U);
    }
    double unit() { return static_cast<double>(bits() >> 11U) / 9007199254740992.0; }
    double in(double low, double high) { return low + (high - low) * unit(); }
    unsigned below(unsigned n) { return static_cast<unsigned>(bits() % n); }
};

struct HardGrid {
    std::vector<float> x, y, depth_m;
    bool perspective = true;

    [[nodiscard]] cluster::GridView view() const { return {x, y, depth_m, perspective}; }
};

inline std::vector<float> edges(Draw& draw, double low, double high, unsigned count) {
    std::vector<float> list;
    for (unsigned i = 0; i <= count; ++i) list.push_back(static_cast<float>(low + (high - low) * i / count));
    if (draw.below(8) == 0) list.front() = -std::numeric_limits<float>::infinity();
    if (draw.below(8) == 0) list.back() = std::numeric_limits<float>::infinity();
    return list;
}

inline HardGrid make_hard_grid(Draw& draw) {
    HardGrid g;
    g.perspective = draw.below(4) != 0;
    double const half_x = g.perspective ? draw.in(0.05, 2.5) : draw.in(1, 200);
    double const half_y = g.perspective ? draw.in(0.05, 2.5) : draw.in(1, 200);
    double const shift_x = draw.below(2) != 0 ? draw.in(-1, 1) * half_x : 0.0;  // off-centre; jitter is a small one
    double const shift_y = draw.below(2) != 0 ? draw.in(-1, 1) * half_y : 1e-3 * half_y;
    unsigned const columns = 1 + draw.below(40), rows = 1 + draw.below(24), slices = 1 + draw.below(20);
    double const extra = draw.in(1.0, 1.2);  // the last tile hangs over the window's border
    g.x = edges(draw, shift_x - half_x, shift_x + half_x * extra, columns);
    g.y = edges(draw, shift_y - half_y, shift_y + half_y * extra, rows);
    double const near = std::pow(10.0, draw.in(-2, 1)), ratio = draw.in(1.02, 3);
    double d = near;
    for (unsigned k = 0; k <= slices; ++k, d *= ratio) g.depth_m.push_back(static_cast<float>(d));
    if (draw.below(4) == 0) g.depth_m.back() = std::numeric_limits<float>::infinity();
    return g;
}

struct HardLight {
    math::vec3 center;
    float range;
    math::vec3 axis;
    float cosine, sine;
    math::vec3 half[3];  ///< of a box
};

inline V3 direction(Draw& draw) {
    double const z = draw.in(-1, 1);
    double const phi = draw.in(0, 6.283185307179586);
    double const s = std::sqrt(1 - z * z);
    V3 v{s * std::cos(phi), s * std::sin(phi), z};
    if (draw.below(6) == 0) v = draw.below(2) != 0 ? V3{0, 0, z < 0 ? -1.0 : 1.0} : V3{z < 0 ? -1.0 : 1.0, 0, 0};
    return v;
}

inline math::vec3 to_vec3(V3 v) { return math::to_float(math::dvec3(v.x, v.y, v.z)); }

/// A light that is about to touch a point of the cell, or holds it, or misses it.
inline HardLight make_hard_light(Draw& draw, HardGrid const& g, Cell c) {
    auto const between = [&](float a, float b) {
        auto const [low, high] = ends_of(a, b);
        unsigned const where = draw.below(4);
        double const inside = draw.in(low, high);
        return where == 0 ? low : where == 1 ? high : inside;
    };
    double const d = between(g.depth_m[c.slice], g.depth_m[c.slice + 1]), f = g.perspective ? d : 1.0;
    double const x = between(g.x[c.column], g.x[c.column + 1]) * f;
    double const y = between(g.y[c.row], g.y[c.row + 1]) * f;
    double const range = std::pow(10.0, draw.in(-2, 2.5)) * (draw.below(2) != 0 ? 1.0 : d * 0.1);
    double const reaches[] = {0.0, 0.6, 0.999, 0.99999, 1.00001, 1.01, 1.5, 3.0};
    double const reach = reaches[draw.below(8)];
    V3 const to = direction(draw);
    HardLight l;
    l.range = static_cast<float>(range);
    V3 const center = V3{x, y, d} - to * (range * reach);
    l.center = to_vec3(center);
    double const angle = draw.in(0.5, 88) * 0.017453292519943295;
    l.cosine = static_cast<float>(std::cos(angle));
    l.sine = static_cast<float>(std::sin(angle));
    V3 const side = cross(to, direction(draw));
    double const tilt = draw.below(3) == 0 ? draw.in(0, 3.1) : angle * draw.in(0.9, 1.1);
    l.axis = to_vec3(norm(side) > 1e-3 ? to * std::cos(tilt) + side * (std::sin(tilt) / norm(side)) : to);
    for (math::vec3& h : l.half) {
        V3 const along = direction(draw);
        double const length = range * draw.in(0.05, 1);
        h = to_vec3(along * length);
    }
    return l;
}

inline Solid solid_of_box(HardLight const& l) {
    Solid s;
    for (int i = 0; i < 8; ++i) {
        V3 p = to_v3(l.center);
        for (int a = 0; a < 3; ++a) p = p + to_v3(l.half[a]) * ((i >> a & 1) != 0 ? 1.0 : -1.0);
        s.hull.push_back(p);
    }
    return s;
}

}  // namespace gnomon::test
