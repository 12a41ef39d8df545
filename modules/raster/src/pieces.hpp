#pragma once
// The arithmetic of the rasterizer, once, in scalar form: the reference that kernels equal bit for bit.

#include <gnomon/math/formula/bits.glsl>
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
template <class Real>
[[nodiscard]] constexpr Real at_least(Real x, Real low) noexcept {
    return x > low ? x : low;
}
template <class Real>
[[nodiscard]] constexpr Real at_most(Real x, Real high) noexcept {
    return x < high ? x : high;
}

/// What rounding took from a coordinate, in [-2048, 2047], and its place in `Corner::code`.
[[nodiscard]] inline std::int32_t residue_of(float scaled, std::int32_t rounded) noexcept {
    float const rest = (scaled - static_cast<float>(rounded)) * static_cast<float>(residue_scale);  // exact
    std::int32_t const residue = round_even(static_cast<double>(rest));
    return residue < 2047 ? residue : 2047;
}
[[nodiscard]] constexpr std::uint32_t packed_residues(std::int32_t x, std::int32_t y) noexcept {
    return static_cast<std::uint32_t>(y) << 20U | (static_cast<std::uint32_t>(x) & 0xFFFU) << 8U;
}
[[nodiscard]] constexpr std::int32_t residue_x(Corner const& c) noexcept {
    return static_cast<std::int32_t>(c.code << 12U) >> 20;
}
[[nodiscard]] constexpr std::int32_t residue_y(Corner const& c) noexcept {
    return static_cast<std::int32_t>(c.code) >> 20;
}

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
    std::int32_t const snapped_x = round_even(static_cast<double>(x * 256.0F));
    std::int32_t const snapped_y = round_even(static_cast<double>(y * 256.0F));
    return {snapped_x + v.offset_x, snapped_y + v.offset_y, z,
            packed_residues(residue_of(x * 256.0F, snapped_x), residue_of(y * 256.0F, snapped_y))};
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

/// A triangle with positive area whose corner 0 has the least depth, once the depths are moved.
struct Oriented {
    std::int32_t x[3], y[3];
    float z[3];
    std::int64_t area;
};

[[nodiscard]] inline std::int64_t area_of(Corner const& a, Corner const& b, Corner const& c) noexcept {
    return (std::int64_t{b.x} - a.x) * (std::int64_t{c.y} - a.y) -
           (std::int64_t{c.x} - a.x) * (std::int64_t{b.y} - a.y);
}

/// From a to b before snapping, in residue units: exact.
[[nodiscard]] inline double unsnapped(std::int32_t a, std::int32_t b, std::int32_t residue_a,
                                      std::int32_t residue_b) noexcept {
    return static_cast<double>(b - a) * residue_scale + static_cast<double>(residue_b - residue_a);
}

/// Moves the corners' depths along the plane through the corners before snapping, to where they were snapped to.
///
///     z_i' = z_i - gradient . residue_i, at most 1/8 of the depths' range beyond the range, and not across 0 or 1
///
/// A sliver that had less than a sixteenth of the area before snapping has no such plane worth following: its depths
/// stay.
/// expects: positive `area`, corner 0 the one with the least z, so that any order of the corners gives the same.
inline void move_depths(Corner const* const (&v)[3], std::int64_t area, float (&z)[3]) noexcept {
    double const z0 = static_cast<double>(v[0]->z);
    double const z1 = static_cast<double>(v[1]->z);
    double const z2 = static_cast<double>(v[2]->z);
    double const x1 = unsnapped(v[0]->x, v[1]->x, residue_x(*v[0]), residue_x(*v[1]));
    double const y1 = unsnapped(v[0]->y, v[1]->y, residue_y(*v[0]), residue_y(*v[1]));
    double const x2 = unsnapped(v[0]->x, v[2]->x, residue_x(*v[0]), residue_x(*v[2]));
    double const y2 = unsnapped(v[0]->y, v[2]->y, residue_y(*v[0]), residue_y(*v[2]));
    double const true_area = x1 * y2 - x2 * y1;
    double const least_area = static_cast<double>(area) * (0.0625 * residue_scale * residue_scale);
    double const scale = true_area >= least_area ? 1.0 / true_area : 0.0;
    double const gx = ((z1 - z0) * y2 - (z2 - z0) * y1) * scale;
    double const gy = ((z2 - z0) * x1 - (z1 - z0) * x2) * scale;
    double const most = at_least(z1, z2);
    double const slack = (most - z0) * 0.125;
    double const low = at_least(z0 - slack, at_most(z0, 0.0));
    double const high = at_most(most + slack, at_least(most, 1.0));
    for (int i = 0; i < 3; ++i) {
        double const shift = gx * static_cast<double>(residue_x(*v[i])) + gy * static_cast<double>(residue_y(*v[i]));
        z[i] = static_cast<float>(at_most(at_least(static_cast<double>(v[i]->z) - shift, low), high));
    }
}

/// The corner from which to count, so that the first has the least of three depths.
[[nodiscard]] inline int least_of(float z0, float z1, float z2) noexcept {
    int first = 0;
    float least = z0;
    if (z1 < least) {
        first = 1;
        least = z1;
    }
    return z2 < least ? 2 : first;
}

/// expects: `area` is theirs and not 0.
[[nodiscard]] inline Oriented orient(Corner const& a, Corner const& b, Corner const& c, std::int64_t area) noexcept {
    Corner const* const turned[3] = {&a, area > 0 ? &b : &c, area > 0 ? &c : &b};
    int const nearest = least_of(turned[0]->z, turned[1]->z, turned[2]->z);
    Corner const* const v[3] = {turned[nearest], turned[(nearest + 1) % 3], turned[(nearest + 2) % 3]};
    Oriented t{};
    t.area = area > 0 ? area : -area;
    float z[3];
    move_depths(v, t.area, z);
    int const first = least_of(z[0], z[1], z[2]);
    for (int i = 0; i < 3; ++i) {
        int const from = (first + i) % 3;
        t.x[i] = v[from]->x;
        t.y[i] = v[from]->y;
        t.z[i] = z[from];
    }
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
    return gn_code_of_depth(formula::Float<float>(depth)).v;
}

}  // namespace gnomon::raster::detail
