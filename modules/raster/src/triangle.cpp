#include <gnomon/raster/triangle.hpp>

#include "pieces.hpp"

#include <cmath>

namespace gnomon::raster {

namespace {

using detail::Clip4;
using detail::Corner;

Corner corner_of(SnappedVertex const& v) { return {v.x, v.y, v.z, detail::packed_residues(v.residue_x, v.residue_y)}; }

/// Signed distance of a corner from plane `plane` of the outcode, scaled; >= 0 inside.
double distance(math::vec4 const& c, int plane, ViewportTransform const& v) {
    double const w = static_cast<double>(c.w);
    // The guard planes' products are rounded to float, as the outcode's are.
    double const gx = static_cast<double>(v.guard_x * c.w);
    double const gy = static_cast<double>(v.guard_y * c.w);
    switch (plane) {
        case 0: return w - static_cast<double>(min_w);
        case 1: return static_cast<double>(c.z);
        case 2: return w - static_cast<double>(c.z);
        case 3: return static_cast<double>(c.x) + gx;
        case 4: return gx - static_cast<double>(c.x);
        case 5: return static_cast<double>(c.y) + gy;
        default: return gy - static_cast<double>(c.y);
    }
}

/// Where the edge from `in` to `out` meets the plane: always computed in this direction.
math::vec4 cut(math::vec4 const& in, double d_in, math::vec4 const& out, double d_out) {
    double const t = d_in / (d_in - d_out);
    math::vec4 at(0.0F);
    for (math::axis_t i = 0; i < 4; ++i) {
        double const a = static_cast<double>(in[i]);
        at[i] = static_cast<float>(a + t * (static_cast<double>(out[i]) - a));
    }
    return at;
}

ClipPolygon cut_polygon(ClipPolygon const& from, int plane, ViewportTransform const& viewport) {
    ClipPolygon to;
    for (int i = 0; i < from.count; ++i) {
        math::vec4 const& a = from.corner[static_cast<std::size_t>(i)];
        math::vec4 const& b = from.corner[static_cast<std::size_t>(i + 1 == from.count ? 0 : i + 1)];
        double const da = distance(a, plane, viewport);
        double const db = distance(b, plane, viewport);
        // Rounding can make a cut polygon very slightly concave and add a corner; there is room for one per plane.
        if (da >= 0.0 && to.count < 10) to.corner[static_cast<std::size_t>(to.count++)] = a;
        if ((da >= 0.0) != (db >= 0.0) && to.count < 10)
            to.corner[static_cast<std::size_t>(to.count++)] = da >= 0.0 ? cut(a, da, b, db) : cut(b, db, a, da);
    }
    return to;
}

/// Back inside by what rounding took it out: nothing but a last place or so, except where the corners' sizes differ by
/// many orders of magnitude. A corner that is inside stays as it is.
void settle(math::vec4& c, ViewportTransform const& v) {
    auto const limited = [](float x, float limit) { return x > limit ? limit : x < -limit ? -limit : x; };
    c.w = c.w < min_w ? min_w : c.w;
    c.x = limited(c.x, v.guard_x * c.w);
    c.y = limited(c.y, v.guard_y * c.w);
}

}  // namespace

ViewportTransform make_viewport(Rect const& viewport, bool clip_depth) noexcept {
    GNOMON_EXPECT(viewport.width >= 1 && viewport.width <= max_size_px);
    GNOMON_EXPECT(viewport.height >= 1 && viewport.height <= max_size_px);
    GNOMON_EXPECT(viewport.x >= -max_size_px && viewport.x <= max_size_px);
    GNOMON_EXPECT(viewport.y >= -max_size_px && viewport.y <= max_size_px);
    float const half_width = static_cast<float>(viewport.width) * 0.5F;
    float const half_height = static_cast<float>(viewport.height) * 0.5F;
    // 24,000 px from the centre: 256 (24,000 + 8,192) is below 2^23, where a float holds 1/512 of a pixel.
    constexpr float guard_px = 24000.0F;
    return {half_width,
            half_height,
            viewport.x * subpixel_units,
            viewport.y * subpixel_units,
            guard_px / half_width,
            guard_px / half_height,
            clip_depth};
}

std::uint32_t outcode(math::vec4 const& clip, ViewportTransform const& viewport) noexcept {
    return detail::outcode_of({clip.x, clip.y, clip.z, clip.w}, viewport.guard_x, viewport.guard_y,
                              viewport.clip_depth);
}

ClipPolygon clip_triangle(std::array<math::vec4, 3> const& corners, ViewportTransform const& viewport) noexcept {
    ClipPolygon polygon;
    for (math::vec4 const& corner : corners) polygon.corner[static_cast<std::size_t>(polygon.count++)] = corner;
    // Every plane, even one that no corner is outside of: a shared edge must go through the same steps in both
    // triangles, whatever their third corners are.
    for (int plane = 0; plane < 7 && polygon.count != 0; ++plane)
        if (viewport.clip_depth || (plane != 1 && plane != 2)) polygon = cut_polygon(polygon, plane, viewport);
    for (int i = 0; i < polygon.count; ++i) settle(polygon.corner[static_cast<std::size_t>(i)], viewport);
    return polygon;
}

SnappedVertex snap(math::vec4 const& clip, ViewportTransform const& viewport) noexcept {
    Corner const c = detail::snap_of(Clip4{clip.x, clip.y, clip.z, clip.w}, viewport, viewport.half_width_px,
                                     viewport.half_height_px);
    return {c.x, c.y, c.z, static_cast<std::int16_t>(detail::residue_x(c)),
            static_cast<std::int16_t>(detail::residue_y(c))};
}

bool covers(SnappedTriangle const& triangle, std::int32_t x, std::int32_t y) noexcept {
    std::int64_t const area = doubled_area(triangle);
    if (area == 0) return false;
    detail::Oriented const t =
        detail::orient(corner_of(triangle[0]), corner_of(triangle[1]), corner_of(triangle[2]), area);
    bool inside = true;
    for (int i = 0; i < 3; ++i) inside = inside && detail::shifted_edge(t, i, x, y).value >= 0;
    return inside;
}

float depth_at(SnappedTriangle const& triangle, std::int32_t x, std::int32_t y) noexcept {
    std::int64_t const area = doubled_area(triangle);
    GNOMON_EXPECT(area != 0);
    detail::Oriented const t =
        detail::orient(corner_of(triangle[0]), corner_of(triangle[1]), corner_of(triangle[2]), area);
    detail::ShiftedEdge const edge01 = detail::shifted_edge(t, 0, x, y);
    detail::ShiftedEdge const edge20 = detail::shifted_edge(t, 2, x, y);
    detail::DepthGradient const g = detail::depth_gradient(t, edge20.fraction, edge01.fraction);
    if (detail::is_large(t))
        return detail::large_depth(g, static_cast<double>(edge20.value), static_cast<double>(edge01.value));
    return detail::regular_depth(static_cast<float>(g.z0), static_cast<float>(g.g1), static_cast<float>(g.g2),
                                 static_cast<std::int32_t>(edge20.value), static_cast<std::int32_t>(edge01.value));
}

}  // namespace gnomon::raster
