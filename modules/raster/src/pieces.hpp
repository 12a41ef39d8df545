#pragma once
// The arithmetic of the rasterizer, once, in scalar form: the reference that kernels equal bit for bit.

#include <gnomon/raster/triangle.hpp>

#include "kernel.hpp"

#include <bit>
#include <cstdint>

namespace gnomon::raster::detail {

/// Bits of an outcode, one per plane, in the order in which the clipper cuts.
enum : std::uint32_t {
    code_w = 1,
    code_z_low = 2,
    code_z_high = 4,
    code_x_low = 8,
    code_x_high = 16,
    code_y_low = 32,
    code_y_high = 64,
    code_not_finite = 128,
};

/// To the nearest integer, ties to even, without touching the rounding mode or libm.
///
/// expects: |x| below 2^31.
[[nodiscard]] inline std::int32_t round_even(double x) noexcept {
    constexpr double magic = 6755399441055744.0;  // 1.5 * 2^52: the sum's low bits are the integer.
    return static_cast<std::int32_t>(static_cast<std::uint32_t>(std::bit_cast<std::uint64_t>(x + magic)));
}

/// a < b ? b : a and its twin, which are what the vector instructions do with equal zeros.
[[nodiscard]] inline float at_least(float x, float low) noexcept { return x > low ? x : low; }
[[nodiscard]] inline float at_most(float x, float high) noexcept { return x < high ? x : high; }

struct Clip4 {
    float x, y, z, w;
};

/// Row r of the matrix: ((m0 x + m1 y) + m2 z) + m3.
[[nodiscard]] inline Clip4 to_clip(VertexJob const& job, float const (&position)[3]) noexcept {
    float const x = position[0] - job.origin[0];
    float const y = position[1] - job.origin[1];
    float const z = position[2] - job.origin[2];
    float clip[4];
    for (int r = 0; r < 4; ++r) clip[r] = ((job.row[r][0] * x + job.row[r][1] * y) + job.row[r][2] * z) + job.row[r][3];
    return {clip[0], clip[1], clip[2], clip[3]};
}

[[nodiscard]] inline bool is_usable(float c) noexcept {
    return c <= max_clip_coordinate && c >= -max_clip_coordinate;  // false for NaN
}

[[nodiscard]] inline std::uint32_t outcode_of(Clip4 const& c, float guard_x, float guard_y, bool clip_depth) noexcept {
    if (!(is_usable(c.x) && is_usable(c.y) && is_usable(c.z) && is_usable(c.w))) return code_not_finite;
    float const gx = guard_x * c.w;
    float const gy = guard_y * c.w;
    std::uint32_t code = 0;
    if (c.w < min_w) code |= code_w;
    if (clip_depth && c.z < 0.0F) code |= code_z_low;
    if (clip_depth && c.z > c.w) code |= code_z_high;
    if (c.x < -gx) code |= code_x_low;
    if (c.x > gx) code |= code_x_high;
    if (c.y < -gy) code |= code_y_low;
    if (c.y > gy) code |= code_y_high;
    return code;
}

/// expects: an outcode of 0, so that |x r half + half| stays below 2^15 and 256 times it below 2^23.
template <class Viewport>
[[nodiscard]] inline Corner snap_of(Clip4 const& c, Viewport const& v, float half_width, float half_height) noexcept {
    float const r = 1.0F / c.w;
    float const x = (c.x * r) * half_width + half_width;
    float const y = (c.y * r) * half_height + half_height;
    float z = c.z * r;
    if (v.clip_depth) z = at_most(at_least(z, 0.0F), 1.0F);
    return {round_even(static_cast<double>(x * 256.0F)) + v.offset_x,
            round_even(static_cast<double>(y * 256.0F)) + v.offset_y, z, 0};
}

/// First and last pixel whose centre lies in [low, high) of snapped coordinates; empty when first > last.
///
/// Exact for the top-left rule: a centre at the greatest x or y of a triangle is never covered, one at the least may
/// be.
[[nodiscard]] inline std::int32_t first_pixel(std::int32_t low) noexcept { return (low + 127) >> fraction_bits; }
[[nodiscard]] inline std::int32_t last_pixel(std::int32_t high) noexcept { return (high - 129) >> fraction_bits; }

/// 0 on a top or left edge of a clockwise (positive) triangle, else -1.
[[nodiscard]] inline std::int32_t edge_bias(std::int64_t dx, std::int64_t dy) noexcept {
    return dy < 0 || (dy == 0 && dx > 0) ? 0 : -1;
}

/// A triangle with positive area whose corner 0 has the least depth.
struct Oriented {
    std::int32_t x[3], y[3];
    float z[3];
    std::int64_t area;
};

[[nodiscard]] inline std::int64_t area_of(Corner const& a, Corner const& b, Corner const& c) noexcept {
    return (std::int64_t{b.x} - a.x) * (std::int64_t{c.y} - a.y) -
           (std::int64_t{c.x} - a.x) * (std::int64_t{b.y} - a.y);
}

/// expects: `area` is theirs and not 0.
[[nodiscard]] inline Oriented orient(Corner const& a, Corner const& b, Corner const& c, std::int64_t area) noexcept {
    Corner const* v[3] = {&a, area > 0 ? &b : &c, area > 0 ? &c : &b};
    int first = 0;
    if (v[1]->z < v[first]->z) first = 1;
    if (v[2]->z < v[first]->z) first = 2;
    Oriented t{};
    for (int i = 0; i < 3; ++i) {
        Corner const& from = *v[(first + i) % 3];
        t.x[i] = from.x;
        t.y[i] = from.y;
        t.z[i] = from.z;
    }
    t.area = area > 0 ? area : -area;
    return t;
}

/// E of the edge from corner i to corner j at a point, in units of 1/65536 square pixel; positive inside.
[[nodiscard]] inline std::int64_t edge_at(Oriented const& t, int i, int j, std::int64_t x, std::int64_t y) noexcept {
    return (std::int64_t{t.x[j]} - t.x[i]) * (y - t.y[i]) - (std::int64_t{t.y[j]} - t.y[i]) * (x - t.x[i]);
}

/// E + bias of edge i, shifted down, at a pixel's centre, and what the shift took from E, in [0, 256].
struct ShiftedEdge {
    std::int64_t value;
    std::int32_t fraction;
    std::int32_t step_x, step_y;
};

[[nodiscard]] inline ShiftedEdge shifted_edge(Oriented const& t, int i, std::int32_t px, std::int32_t py) noexcept {
    int const j = i == 2 ? 0 : i + 1;
    std::int32_t const dx = t.x[j] - t.x[i];
    std::int32_t const dy = t.y[j] - t.y[i];
    std::int32_t const bias = edge_bias(dx, dy);
    std::int64_t const biased =
        edge_at(t, i, j, std::int64_t{px} * 256 + half_pixel, std::int64_t{py} * 256 + half_pixel) + bias;
    return {biased >> fraction_bits, static_cast<std::int32_t>(biased & 255) - bias, -dy, dx};
}

/// The depth plane in terms of the shifted edges: z = z0 + (E'20 g1 + E'01 g2), in double; see `depth_at`.
struct DepthGradient {
    double z0, g1, g2;
};

[[nodiscard]] inline DepthGradient depth_gradient(Oriented const& t, std::int32_t fraction20,
                                                  std::int32_t fraction01) noexcept {
    double const scale = 256.0 / static_cast<double>(t.area);
    double const z0 = static_cast<double>(t.z[0]);
    double const g1 = (static_cast<double>(t.z[1]) - z0) * scale;
    double const g2 = (static_cast<double>(t.z[2]) - z0) * scale;
    double const at_shifted =
        (static_cast<double>(fraction20) * 0.00390625) * g1 + (static_cast<double>(fraction01) * 0.00390625) * g2;
    return {z0 + at_shifted, g1, g2};
}

/// Whether the edge functions of the triangle leave 32 bits somewhere in its bounds.
[[nodiscard]] inline bool is_large(Oriented const& t) noexcept {
    auto const extent = [](std::int32_t a, std::int32_t b, std::int32_t c) {
        std::int32_t const low = a < b ? (a < c ? a : c) : (b < c ? b : c);
        std::int32_t const high = a > b ? (a > c ? a : c) : (b > c ? b : c);
        return high - low;
    };
    return extent(t.x[0], t.x[1], t.x[2]) > regular_extent || extent(t.y[0], t.y[1], t.y[2]) > regular_extent;
}

/// Depth of a regular triangle from its shifted edges: the formula of every kernel.
[[nodiscard]] inline float regular_depth(float z0, float g1, float g2, std::int32_t edge20,
                                         std::int32_t edge01) noexcept {
    return z0 + (static_cast<float>(edge20) * g1 + static_cast<float>(edge01) * g2);
}

/// The same for a large one: integers below 2^53 are exact in double.
[[nodiscard]] inline float large_depth(DepthGradient const& g, double edge20, double edge01) noexcept {
    return static_cast<float>(g.z0 + (edge20 * g.g1 + edge01 * g.g2));
}

/// What a 16-bit target stores, as a float: the nearest code, ties to even.
[[nodiscard]] inline float to_code(float depth) noexcept {
    constexpr float magic = 8388608.0F;  // 2^23
    return (depth * 65535.0F + magic) - magic;
}

}  // namespace gnomon::raster::detail
