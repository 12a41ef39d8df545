// The pieces of conservative rasterization, one triangle and one pixel at a time.

#include "conservative.hpp"

#include <algorithm>

namespace gnomon::raster {

namespace {

bool bounds_touch(SnappedTriangle const& t, std::int32_t x, std::int32_t y, std::int32_t slack) {
    auto const overlap = [slack](std::int32_t a, std::int32_t b, std::int32_t c, std::int32_t pixel) {
        return std::min({a, b, c}) <= pixel * 256 + 256 + slack && std::max({a, b, c}) >= pixel * 256 - slack;
    };
    return overlap(t[0].x, t[1].x, t[2].x, x) && overlap(t[0].y, t[1].y, t[2].y, y);
}

}  // namespace

bool touches(SnappedTriangle const& triangle, std::int32_t x, std::int32_t y, std::int32_t slack) noexcept {
    GNOMON_EXPECT(slack >= 0 && slack <= max_slack);
    detail::PixelTriangle const t = detail::make_pixel_triangle(triangle, slack, 1.0);
    return bounds_touch(triangle, x, y, slack) &&
           detail::edges_touch(t, detail::edges_at(t, detail::square_centre(x), detail::square_centre(y)));
}

bool covers_fully(SnappedTriangle const& triangle, std::int32_t x, std::int32_t y, std::int32_t slack) noexcept {
    GNOMON_EXPECT(slack >= 0 && slack <= max_slack);
    detail::PixelTriangle const t = detail::make_pixel_triangle(triangle, slack, 1.0);
    return detail::edges_cover(t, detail::edges_at(t, detail::square_centre(x), detail::square_centre(y)));
}

DepthBounds depth_bounds(SnappedTriangle const& triangle, std::int32_t x, std::int32_t y, std::int32_t slack) noexcept {
    GNOMON_EXPECT(touches(triangle, x, y, slack));
    double const cx = detail::square_centre(x);
    double const cy = detail::square_centre(y);
    double bound[2];
    for (int i = 0; i < 2; ++i) {
        detail::PixelTriangle const t = detail::make_pixel_triangle(triangle, slack, i == 0 ? 1.0 : -1.0);
        bound[i] = detail::lower_bound(t, detail::edges_at(t, cx, cy), cx, cy);
    }
    return {static_cast<float>(bound[0]), static_cast<float>(-bound[1])};
}

}  // namespace gnomon::raster
