#pragma once
// One triangle's samples in a tile, in whole units: edge functions exact, depth rounded from differences only.

#include "ortho.hpp"

#include <gnomon/math/texel.hpp>

#include <algorithm>
#include <cstdint>

namespace gnomon::raster::detail {

__extension__ using Wide = __int128;

/// E of the edge from corner i to corner j at a point; positive inside.
[[nodiscard]] inline Wide wide_edge(OrthoRecord const& r, int i, int j, std::int64_t x, std::int64_t y) noexcept {
    return Wide{r.x[j] - r.x[i]} * (y - r.y[i]) - Wide{r.y[j] - r.y[i]} * (x - r.x[i]);
}

/// 0 on a top or left edge, else -1: what is added to E before its sign counts.
[[nodiscard]] inline int ortho_bias(std::int64_t dx, std::int64_t dy) noexcept {
    return dy < 0 || (dy == 0 && dx > 0) ? 0 : -1;
}

/// How a sample's depth becomes a code.
struct OrthoDepth {
    double last_code;
    bool clips;
};

/// The plane, from the first corner.
struct OrthoPlane {
    double z0, slope1, slope2;

    OrthoPlane(OrthoRecord const& r, double area)
        : z0(static_cast<double>(r.z[0])),
          slope1(static_cast<double>(r.z[1] - r.z[0]) / area),
          slope2(static_cast<double>(r.z[2] - r.z[0]) / area) {}

    /// The code, not limited: a whole number. All sums are integers below 2^52, and so exact.
    [[nodiscard]] double code(double edge20, double edge01) const noexcept {
        constexpr double magic = 6755399441055744.0;  // 1.5 * 2^52: rounds to whole, ties to even
        double const from_corner = ((edge20 * slope1 + edge01 * slope2) + magic) - magic;
        // Halves up: no whole number of 256ths and a half is a tie.
        return (((z0 + from_corner) + 0.5) * 0.00390625 + magic) - magic;
    }
};

/// Depth test, range and alpha test of one covered sample.
[[nodiscard]] inline bool write_code(float& held, double code, OrthoDepth const& depth) noexcept {
    bool const in_range = code >= 0.0 && code <= depth.last_code;
    double const limited = code < 0.0 ? 0.0 : code > depth.last_code ? depth.last_code : code;
    float const stored = static_cast<float>(limited);
    if (!(stored < held) || (depth.clips && !in_range)) return false;
    held = stored;
    return true;
}

/// Texture coordinates by the same weights as the depth.
struct OrthoAlpha {
    AlphaTest const* test;
    math::dvec2 uv0, uv1, uv2;
    double per_area;

    OrthoAlpha(AlphaTest const* alpha, OrthoRecord const& r, double area) : test(alpha), uv0(0.0), uv1(0.0), uv2(0.0) {
        per_area = 1.0 / area;
        if (test == nullptr) return;
        math::dvec2* const uv[3] = {&uv0, &uv1, &uv2};
        for (int i = 0; i < 3; ++i) {
            math::vec2 const from = test->uv[r.uv[i]];
            *uv[i] = math::dvec2(static_cast<double>(from.x), static_cast<double>(from.y));
        }
    }
    [[nodiscard]] bool passes(double edge20, double edge01) const noexcept {
        if (test == nullptr) return true;
        double const b1 = edge20 * per_area;
        double const b2 = edge01 * per_area;
        math::dvec2 const uv(uv0.x + ((uv1.x - uv0.x) * b1 + (uv2.x - uv0.x) * b2),
                             uv0.y + ((uv1.y - uv0.y) * b1 + (uv2.y - uv0.y) * b2));
        return math::alpha_at(test->texture, uv) * test->factor >= test->cutoff;
    }
};

/// An edge function along the rows of a tile: positive or 0 inside, the top-left rule included.
template <class Number>
struct OrthoEdge {
    Number at;  ///< At the current row's first sample.
    Number step_x, step_y;
    double per_step;  ///< 1 / step_x: only guesses with it.

    OrthoEdge(OrthoRecord const& r, int i, int j, std::int32_t x, std::int32_t y)
        : at(static_cast<Number>(wide_edge(r, i, j, std::int64_t{x} * 256 + 128, std::int64_t{y} * 256 + 128) +
                                 ortho_bias(r.x[j] - r.x[i], r.y[j] - r.y[i]))),
          step_x(static_cast<Number>((r.y[i] - r.y[j]) * 256)),
          step_y(static_cast<Number>((r.x[j] - r.x[i]) * 256)),
          per_step(step_x == 0 ? 0.0 : 1.0 / static_cast<double>(step_x)) {}

    [[nodiscard]] bool is_inside(std::int32_t k) const noexcept { return at + static_cast<Number>(k) * step_x >= 0; }

    /// Cuts samples [first, last] of the row to those inside: a guess, then exact steps from it.
    void cut(std::int32_t& first, std::int32_t& last) const noexcept {
        if (step_x == 0) {
            if (at < 0) last = first - 1;
            return;
        }
        double const guess = std::min(std::max(-static_cast<double>(at) * per_step, -1.0), 4096.0);
        auto k = static_cast<std::int32_t>(guess);
        if (step_x > 0) {
            k = std::min(std::max(k, first), last + 1);
            while (k > first && is_inside(k - 1)) --k;
            while (k <= last && !is_inside(k)) ++k;
            first = k;
        } else {
            k = std::min(std::max(k, first - 1), last);
            while (k < last && is_inside(k + 1)) ++k;
            while (k >= first && !is_inside(k)) --k;
            last = k;
        }
    }
};

/// The record's samples in the tile. `Number` holds its edge functions exactly: double below 2^53, or 128-bit integers.
template <class Number>
std::uint64_t draw_ortho_with(OrthoTile const& tile, OrthoRecord const& r, OrthoDepth const& depth,
                              AlphaTest const* test) noexcept {
    double const area = static_cast<double>(wide_edge(r, 0, 1, r.x[2], r.y[2]));
    OrthoPlane const plane(r, area);
    OrthoAlpha const alpha(test, r, area);
    std::int32_t const x0 = std::max<std::int32_t>(r.min_x, tile.rect.x0);
    std::int32_t const x1 = std::min<std::int32_t>(r.max_x, tile.rect.x1 - 1);
    std::int32_t const y0 = std::max<std::int32_t>(r.min_y, tile.rect.y0);
    std::int32_t const y1 = std::min<std::int32_t>(r.max_y, tile.rect.y1 - 1);
    OrthoEdge<Number> edges[3] = {{r, 0, 1, x0, y0}, {r, 1, 2, x0, y0}, {r, 2, 0, x0, y0}};
    // The planes read edge functions without the rule's share.
    auto const rule01 = static_cast<Number>(ortho_bias(r.x[1] - r.x[0], r.y[1] - r.y[0]));
    auto const rule20 = static_cast<Number>(ortho_bias(r.x[0] - r.x[2], r.y[0] - r.y[2]));
    std::uint64_t written = 0;
    for (std::int32_t y = y0; y <= y1; ++y) {
        std::int32_t first = 0, last = x1 - x0;
        for (OrthoEdge<Number> const& edge : edges) edge.cut(first, last);
        float* const held = tile.code + std::ptrdiff_t{y - tile.rect.y0} * tile_size + (x0 - tile.rect.x0);
        Number e01 = edges[0].at - rule01 + static_cast<Number>(first) * edges[0].step_x;
        Number e20 = edges[2].at - rule20 + static_cast<Number>(first) * edges[2].step_x;
        for (std::int32_t k = first; k <= last; ++k) {
            auto const edge20 = static_cast<double>(e20), edge01 = static_cast<double>(e01);
            if (alpha.passes(edge20, edge01) && write_code(held[k], plane.code(edge20, edge01), depth)) ++written;
            e01 += edges[0].step_x;
            e20 += edges[2].step_x;
        }
        for (OrthoEdge<Number>& edge : edges) edge.at += edge.step_y;
    }
    return written;
}

[[nodiscard]] inline std::uint64_t draw_ortho(OrthoTile const& tile, OrthoRecord const& r, OrthoDepth const& depth,
                                              AlphaTest const* test) noexcept {
    // Within 2^25 on a side all edge functions in the bounds are below 2^52.
    auto const is_far = [](std::int64_t const(&v)[3]) {
        return std::max({v[0], v[1], v[2]}) - std::min({v[0], v[1], v[2]}) > std::int64_t{1} << 25;
    };
    if (is_far(r.x) || is_far(r.y)) return draw_ortho_with<Wide>(tile, r, depth, test);
    return draw_ortho_with<double>(tile, r, depth, test);
}

}  // namespace gnomon::raster::detail
