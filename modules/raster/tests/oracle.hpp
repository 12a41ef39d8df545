#pragma once
// Slow truths for the rasterizer's tests. They share no edge function and no fill rule with the code under test.

#include <gnomon/raster/triangle.hpp>

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

/// Depth of the plane through the snapped corners at the pixel's centre, to 113 bits.
inline Quad depth(SnappedTriangle const& t, std::int32_t px, std::int32_t py) {
    Wide const x = Wide{px} * 256 + 128;
    Wide const y = Wide{py} * 256 + 128;
    auto const weight = [&](SnappedVertex const& a, SnappedVertex const& b) {
        return static_cast<Quad>((Wide{b.x} - a.x) * (y - a.y) - (x - a.x) * (Wide{b.y} - a.y));
    };
    Quad const sum = weight(t[1], t[2]) * static_cast<Quad>(t[0].z) + weight(t[2], t[0]) * static_cast<Quad>(t[1].z) +
                     weight(t[0], t[1]) * static_cast<Quad>(t[2].z);
    return sum / static_cast<Quad>(area(t));
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
