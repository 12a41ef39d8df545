#pragma once
// Slow truths for the rasterizer's tests. They share no edge function and no fill rule with the code under test.

#include <gnomon/raster/triangle.hpp>

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

namespace oracle {

__extension__ using Wide = __int128;
__extension__ using Quad = __float128;
using gnomon::raster::SnappedTriangle;
using gnomon::raster::SnappedVertex;

/// splitmix64.
struct Random {
    std::uint64_t state;
    std::uint64_t next() {
        std::uint64_t z = (state += 0x9E3779B97F4A7C15ULL);
        z = (z ^ (z >> 30U)) * 0xBF58476D1CE4E5B9ULL;
        z = (z ^ (z >> 27U)) * 0x94D049BB133111EBULL;
        return z ^ (z >> 31U);
    }
    std::int32_t in(std::int32_t low, std::int32_t high) {
        return low + static_cast<std::int32_t>(next() % static_cast<std::uint64_t>(std::int64_t{high} - low + 1));
    }
    float unit() { return static_cast<float>(next() >> 40U) * 0x1p-24F; }
};

/// Which side of the line a -> b the sample is on when it is moved by an infinitesimal step to the right and an
/// infinitely smaller one down: that is what the top-left rule means. Never 0 unless a == b.
inline int side(SnappedVertex const& a, SnappedVertex const& b, std::int32_t px, std::int32_t py) {
    Wide const dx = Wide{b.x} - a.x;
    Wide const dy = Wide{b.y} - a.y;
    Wide const x = Wide{px} * 256 + 128 - a.x;
    Wide const y = Wide{py} * 256 + 128 - a.y;
    Wide const right = Wide{1} << 28;
    Wide const unit = Wide{1} << 56;
    Wide const cross = dx * (y * unit + 1) - dy * (x * unit + right);
    return cross > 0 ? 1 : cross < 0 ? -1 : 0;
}

inline Wide area(SnappedTriangle const& t) {
    return (Wide{t[1].x} - t[0].x) * (Wide{t[2].y} - t[0].y) - (Wide{t[2].x} - t[0].x) * (Wide{t[1].y} - t[0].y);
}

/// +1 or -1 where the triangle covers the pixel, by its winding; 0 elsewhere.
inline int signed_cover(SnappedTriangle const& t, std::int32_t px, std::int32_t py) {
    Wide const a = area(t);
    if (a == 0) return 0;
    int const s0 = side(t[0], t[1], px, py);
    if (s0 != side(t[1], t[2], px, py) || s0 != side(t[2], t[0], px, py)) return 0;
    return s0;
}

/// How often a polygon winds round the pixel's centre.
inline int winding(std::vector<SnappedVertex> const& polygon, std::int32_t px, std::int32_t py) {
    int sum = 0;
    for (std::size_t i = 2; i < polygon.size(); ++i)
        sum += signed_cover({polygon[0], polygon[i - 1], polygon[i]}, px, py);
    return sum;
}

/// Points of a plane over the image, in any unit that makes them whole.
struct WidePoint {
    Wide x, y;
};
using WideTriangle = std::array<WidePoint, 3>;

inline Wide weight(WidePoint const& a, WidePoint const& b, WidePoint const& at) {
    return (b.x - a.x) * (at.y - a.y) - (at.x - a.x) * (b.y - a.y);
}
/// The plane with values z at the corners, to 113 bits.
inline Quad plane_at(WideTriangle const& t, std::array<Quad, 3> const& z, WidePoint const& at) {
    Quad const sum = static_cast<Quad>(weight(t[1], t[2], at)) * z[0] +
                     static_cast<Quad>(weight(t[2], t[0], at)) * z[1] +
                     static_cast<Quad>(weight(t[0], t[1], at)) * z[2];
    return sum / static_cast<Quad>(weight(t[0], t[1], t[2]));
}

/// The corners in 1/4096 of a fixed-point unit: as snapped, or before.
inline WideTriangle fine_corners(SnappedTriangle const& t, bool snapped) {
    WideTriangle fine;
    for (std::size_t i = 0; i < 3; ++i)
        fine[i] = {Wide{t[i].x} * 4096 + (snapped ? 0 : t[i].residue_x),
                   Wide{t[i].y} * 4096 + (snapped ? 0 : t[i].residue_y)};
    return fine;
}

/// Depths of the corners where they were snapped to: of the plane through the corners before snapping, within limits.
inline std::array<Quad, 3> moved_depths(SnappedTriangle const& t) {
    WideTriangle const before = fine_corners(t, false);
    WideTriangle const after = fine_corners(t, true);
    std::array<Quad, 3> const z{static_cast<Quad>(t[0].z), static_cast<Quad>(t[1].z), static_cast<Quad>(t[2].z)};
    Wide const had = weight(before[0], before[1], before[2]);
    Wide const has = weight(after[0], after[1], after[2]);
    if (has > 0 ? 2 * had < has : 2 * had > has) return z;
    Quad const least = std::min({z[0], z[1], z[2]});
    Quad const most = std::max({z[0], z[1], z[2]});
    Quad const slack = (most - least) / 8;
    Quad const low = std::max(least - slack, std::min<Quad>(least, 0));
    Quad const high = std::min(most + slack, std::max<Quad>(most, 1));
    std::array<Quad, 3> moved;
    for (std::size_t i = 0; i < 3; ++i) moved[i] = std::clamp(plane_at(before, z, after[i]), low, high);
    return moved;
}

/// Depth of the triangle at the pixel's centre, to 113 bits.
inline Quad depth(SnappedTriangle const& t, std::int32_t px, std::int32_t py) {
    return plane_at(fine_corners(t, true), moved_depths(t),
                    {(Wide{px} * 256 + 128) * 4096, (Wide{py} * 256 + 128) * 4096});
}

/// What the rounding of the moved depths adds to a depth's error at most.
inline double moved_error(SnappedTriangle const& t) {
    std::array<Quad, 3> const z = moved_depths(t);
    bool const exact =
        std::all_of(t.begin(), t.end(), [](auto const& v) { return v.residue_x == 0 && v.residue_y == 0; });
    auto const [least, most] = std::minmax({z[0], z[1], z[2]});
    return exact ? 0.0 : 0x1p-24 * static_cast<double>(most) + 0x1p-26 * static_cast<double>(most - least);
}

/// A residue that a corner at `coordinate` may have: a float holds the sum, also when counted from `middle`.
inline std::int16_t residue(Random& random, std::int32_t coordinate, std::int32_t middle) {
    std::int64_t const reach =
        std::max(std::abs(std::int64_t{coordinate}), std::abs(std::int64_t{coordinate} - middle));
    std::int32_t step = 1;
    while ((reach + 1) * 4096 / step >= std::int64_t{1} << 24) step *= 2;
    std::int32_t const steps = 2047 / step;
    return static_cast<std::int16_t>(random.in(-steps, steps) * step);
}

/// FNV-1a over an image's bytes.
template <class T>
std::uint64_t hash(std::vector<T> const& image) {
    std::uint64_t h = 0xCBF29CE484222325ULL;
    auto const* const bytes = reinterpret_cast<unsigned char const*>(image.data());
    for (std::size_t i = 0; i < image.size() * sizeof(T); ++i) h = (h ^ bytes[i]) * 0x100000001B3ULL;
    return h;
}

}  // namespace oracle
