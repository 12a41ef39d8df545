#pragma once
// One triangle against one pixel's square, in double: coordinates are below 2^25, so every edge function is an integer
// below 2^53 and exact.

#include <gnomon/raster/conservative.hpp>

#include <cstdint>

namespace gnomon::raster::detail {

/// A triangle made ready for many pixels. Depths are such that the wanted bound is the least: negated for the greatest.
struct PixelTriangle {
    double x[3], y[3], z[3];    // Turned so that the area is positive, or 0.
    double dx[3], dy[3];        // Edge i: from corner i to corner i + 1.
    double per_x[3], per_y[3];  // Of the edge, from 0 to 1, per unit; 0 where it has no extent.
    double spread[3];           // What an edge function varies by, from the square's centre to its corners.
    double reach;               // Half the square's side.
    double area;                // Doubled.
    double least, most;         // Of z.
    double slope1, slope2;      // Depth per edge function 2 and 0; 0 without area.
    double to_least[3];         // From the edge functions at the square's centre to those at its corner of least depth.
    bool is_wide;               // Wide enough beside the square that that corner is known.
};

/// The edge functions at a square's centre.
struct EdgeValues {
    double e[3];
};

[[nodiscard]] inline double square_centre(std::int32_t pixel) noexcept {
    return static_cast<double>(pixel) * 256.0 + 128.0;
}

[[nodiscard]] inline double lesser(double a, double b) noexcept { return b < a ? b : a; }
[[nodiscard]] inline double greater(double a, double b) noexcept { return b > a ? b : a; }
[[nodiscard]] inline double magnitude(double a) noexcept { return a < 0.0 ? -a : a; }

/// The plane's slopes, and the corner of the square where it is least.
///
/// A slope's sign may be wrong where its two terms cancel; then it is below 2^-51.4 of them, and with
/// area >= reach / 4 * (sum of |dx| + |dy|) the depth at the wrong corner is off by less than 2^-47 of the greatest
/// |z|.
inline void set_plane(PixelTriangle& t) noexcept {
    t.is_wide = t.area > 0.0 && t.area * 4.0 >= t.spread[0] + t.spread[1] + t.spread[2];
    if (t.area == 0.0) return;
    double const dz1 = t.z[1] - t.z[0];
    double const dz2 = t.z[2] - t.z[0];
    t.slope1 = dz1 / t.area;
    t.slope2 = dz2 / t.area;
    double const ox = t.dy[2] * dz1 + t.dy[0] * dz2 < 0.0 ? -t.reach : t.reach;
    double const oy = t.dx[2] * dz1 + t.dx[0] * dz2 > 0.0 ? -t.reach : t.reach;
    for (int i = 0; i < 3; ++i) t.to_least[i] = t.dx[i] * oy - t.dy[i] * ox;
}

/// `sign`: 1 bounds the least depth, -1 the greatest.
[[nodiscard]] inline PixelTriangle make_pixel_triangle(SnappedTriangle const& from, std::int32_t slack,
                                                       double sign) noexcept {
    PixelTriangle t{};
    std::int64_t const area = doubled_area(from);
    t.area = static_cast<double>(area < 0 ? -area : area);
    t.reach = 128.0 + slack;
    for (std::size_t i = 0; i < 3; ++i) {
        SnappedVertex const& v = from[area < 0 && i != 0 ? 3 - i : i];
        t.x[i] = v.x;
        t.y[i] = v.y;
        t.z[i] = sign * static_cast<double>(v.z);
    }
    for (int i = 0; i < 3; ++i) {
        int const j = i == 2 ? 0 : i + 1;
        t.dx[i] = t.x[j] - t.x[i];
        t.dy[i] = t.y[j] - t.y[i];
        t.per_x[i] = t.dx[i] == 0.0 ? 0.0 : 1.0 / t.dx[i];
        t.per_y[i] = t.dy[i] == 0.0 ? 0.0 : 1.0 / t.dy[i];
        t.spread[i] = (magnitude(t.dx[i]) + magnitude(t.dy[i])) * t.reach;
    }
    t.least = lesser(lesser(t.z[0], t.z[1]), t.z[2]);
    t.most = greater(greater(t.z[0], t.z[1]), t.z[2]);
    set_plane(t);
    return t;
}

[[nodiscard]] inline EdgeValues edges_at(PixelTriangle const& t, double x, double y) noexcept {
    EdgeValues at{};
    for (int i = 0; i < 3; ++i) at.e[i] = t.dx[i] * (y - t.y[i]) - t.dy[i] * (x - t.x[i]);
    return at;
}

/// No edge has the square wholly on its outer side; without area, on either side. With the bounds of the triangle this
/// is all: two convex polygons that share no point are separated along an edge of one of them.
[[nodiscard]] inline bool edges_touch(PixelTriangle const& t, EdgeValues const& at) noexcept {
    bool touch = true;
    for (int i = 0; i < 3; ++i) touch = touch && at.e[i] + t.spread[i] >= 0.0;
    if (t.area > 0.0) return touch;
    for (int i = 0; i < 3; ++i) touch = touch && at.e[i] - t.spread[i] <= 0.0;
    return touch;
}

[[nodiscard]] inline bool edges_cover(PixelTriangle const& t, EdgeValues const& at) noexcept {
    bool inside = t.area > 0.0;
    for (int i = 0; i < 3; ++i) inside = inside && at.e[i] - t.spread[i] >= 0.0;
    return inside;
}

/// Depth at a point of the triangle, from the edge functions there: barycentric coordinates in [0, 1], three products.
[[nodiscard]] inline double plane_at(PixelTriangle const& t, EdgeValues const& at) noexcept {
    return t.z[0] + (at.e[2] * t.slope1 + at.e[0] * t.slope2);
}

/// The least depth of edge i within the square; the triangle's greatest where they do not meet.
///
///     z_i + t (z_j - z_i) at the end, of the part of [0, 1] that lies in the square, that has the least depth
///
/// Whether any part does is decided exactly, so t is off by a few 2^-53 and the depth by as much of the edge's range.
[[nodiscard]] inline double least_on_edge(PixelTriangle const& t, int i, EdgeValues const& at, double x,
                                          double y) noexcept {
    int const j = i == 2 ? 0 : i + 1;
    double low = 0.0;
    double high = 1.0;
    bool meets = at.e[i] + t.spread[i] >= 0.0 && at.e[i] - t.spread[i] <= 0.0;
    auto const cut = [&](double from, double to, double per_unit, double centre) {
        double const first = centre - t.reach;
        double const last = centre + t.reach;
        meets = meets && lesser(from, to) <= last && greater(from, to) >= first;
        if (per_unit == 0.0) return;
        double const a = (first - from) * per_unit;
        double const b = (last - from) * per_unit;
        low = greater(low, lesser(a, b));
        high = lesser(high, greater(a, b));
    };
    cut(t.x[i], t.x[j], t.per_x[i], x);
    cut(t.y[i], t.y[j], t.per_y[i], y);
    double const dz = t.z[j] - t.z[i];
    return meets ? t.z[i] + dz * (dz < 0.0 ? high : low) : t.most;
}

[[nodiscard]] inline EdgeValues moved(EdgeValues const& at, double const (&by)[3]) noexcept {
    return {{at.e[0] + by[0], at.e[1] + by[1], at.e[2] + by[2]}};
}

[[nodiscard]] inline bool is_inside(EdgeValues const& at) noexcept {
    return at.e[0] >= 0.0 && at.e[1] >= 0.0 && at.e[2] >= 0.0;
}

/// The least depth at the square's corners inside the triangle, or the triangle's greatest.
[[nodiscard]] inline double least_at_corners(PixelTriangle const& t, EdgeValues const& at) noexcept {
    double least = t.most;
    for (int corner = 0; corner < 4; ++corner) {
        double const ox = (corner & 1) != 0 ? t.reach : -t.reach;
        double const oy = (corner & 2) != 0 ? t.reach : -t.reach;
        double by[3];
        for (int i = 0; i < 3; ++i) by[i] = t.dx[i] * oy - t.dy[i] * ox;
        EdgeValues const there = moved(at, by);
        if (is_inside(there)) least = lesser(least, plane_at(t, there));
    }
    return least;
}

[[nodiscard]] inline bool is_inside_square(PixelTriangle const& t, double x, double y) noexcept {
    bool inside = true;
    for (int i = 0; i < 3; ++i) inside = inside && magnitude(t.x[i] - x) <= t.reach && magnitude(t.y[i] - y) <= t.reach;
    return inside;
}

/// The least depth over the part of the triangle in the square around (x, y), within 2^-46 of the greatest |z|.
///
/// expects: a touched square.
[[nodiscard]] inline double least_in_square(PixelTriangle const& t, EdgeValues const& at, double x, double y) noexcept {
    if (is_inside_square(t, x, y)) return t.least;
    EdgeValues const at_least_corner = moved(at, t.to_least);
    if (t.is_wide && is_inside(at_least_corner)) return plane_at(t, at_least_corner);
    // Where the plane's least corner is outside, the least lies on the triangle's border.
    double least = t.is_wide || t.area == 0.0 ? t.most : least_at_corners(t, at);
    for (int i = 0; i < 3; ++i)
        if (lesser(t.z[i], t.z[i == 2 ? 0 : i + 1]) < least) least = lesser(least, least_on_edge(t, i, at, x, y));
    return least;
}

/// Not above `exact`, whose error is below 2^-46 `size`: moved down by that and a rounding to float, and rounded.
[[nodiscard]] inline double rounded_down(double exact, double size) noexcept {
    double const down = exact - (magnitude(exact) * 0x1.00001p-24 + size * 0x1p-46 + 0x1p-149);
    return static_cast<double>(static_cast<float>(down));
}

/// A lower bound of the depth in the square that a float holds; see `depth_bounds`.
[[nodiscard]] inline double lower_bound(PixelTriangle const& t, EdgeValues const& at, double x, double y) noexcept {
    double const size = greater(magnitude(t.least), magnitude(t.most));
    return greater(rounded_down(least_in_square(t, at, x, y), size), t.least);
}

}  // namespace gnomon::raster::detail
