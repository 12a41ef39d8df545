#pragma once
// Lights as meshes for a rasterizer that finds the tiles they touch: twenty triangles, a ball's or a narrow spot's.
//
// What the triangles are and why no tile is missed is said in formula/hull.glsl. Culling space: x right, y down, depth.
//
// source: [Olsson 2014, Paper I, 6.1]; [Hasselgren et al. 2005]

#include <gnomon/lights/admit.hpp>
#include <gnomon/lights/bounding_ball.hpp>
#include <gnomon/lights/formula/hull.glsl>
#include <gnomon/lights/light.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <type_traits>

namespace gnomon::lights {

using Hull = formula::GnHull;
using HullFace = formula::GnHullFace;

static_assert(sizeof(Hull) == 64 && std::is_trivially_copyable_v<Hull>);

inline constexpr std::uint32_t hull_faces = formula::gn_hull_faces();
/// Side of the blocks of tiles that are tested first. Products, greatest values and sums round monotonically: a block that
/// a face leaves out has no tile that it does not.
inline constexpr std::uint32_t hull_block = 8;

enum class HullKind : std::uint32_t {
    ball,
    cone,
    everywhere,
    nowhere,
};

namespace detail {

/// Columns times `scale_u` and so on: `w` along `axis`, of length 1, u and v across.
[[nodiscard]] inline Hull make_frame(HullKind kind, math::dvec3 const& origin, math::dvec3 const& axis, double across, double along) {
    math::dvec3 const aside = std::abs(axis.z) < 0.9 ? math::dvec3(0.0, 0.0, 1.0) : math::dvec3(1.0, 0.0, 0.0);
    math::dvec3 const u = glm::normalize(glm::cross(aside, axis));
    math::dvec3 const v = glm::cross(axis, u);
    return {math::to_float(origin), static_cast<std::uint32_t>(kind), math::to_float(u * across), 0, math::to_float(v * across), 0,
            math::to_float(axis * along), 0};
}

[[nodiscard]] inline double size_of(math::vec3 const& v) noexcept {
    return std::abs(static_cast<double>(v.x)) + std::abs(static_cast<double>(v.y)) + std::abs(static_cast<double>(v.z));
}

}  // namespace detail

/// A mesh that holds the light and 2^-17 of its coordinates' sum more: a pyramid for a spot of at most 45 degrees, else
/// the icosahedron of its ball, a corner toward the eye.
///
///     icosahedron: circumradius over inradius 1.2584086       pyramid: 1 / cos(18 degrees) for its ten sides
///
/// returns: `everywhere` for a directional light, `nowhere` for one that is not sound
[[nodiscard]] inline Hull make_hull(Light const& l, bool perspective) noexcept {
    math::Sphere const ball = bounding_ball(l);
    if (!(ball.radius >= 0.0F) || l.kind == Kind::directional) {
        HullKind const kind = l.kind == Kind::directional ? HullKind::everywhere : HullKind::nowhere;
        return detail::make_frame(kind, math::dvec3(0.0), math::dvec3(0.0, 0.0, 1.0), 0.0, 0.0);
    }
    math::dvec3 const center = math::to_double(ball.center);
    if (l.kind != Kind::spot || l.cos_half < l.sin_half) {
        double const far = glm::length(center);
        math::dvec3 const axis = perspective && far > 0.0 ? center / far : math::dvec3(0.0, 0.0, 1.0);
        double const r = 1.2584086 * (static_cast<double>(ball.radius) + 0x1p-17 * (detail::size_of(ball.center) + static_cast<double>(ball.radius)));
        return detail::make_frame(HullKind::ball, center, axis, r, r);
    }
    // Sides and base stand off by the margin: the apex is moved back, the base forward.
    double const half = std::max(std::atan2(static_cast<double>(l.sin_half), static_cast<double>(l.cos_half)), 1e-3);
    auto const range = static_cast<double>(l.range_m);
    double const margin = 0x1p-17 * (detail::size_of(l.center) + 2.0 * range);
    double const back = margin / std::sin(half);
    math::dvec3 const axis = glm::normalize(math::to_double(l.axis));
    double const along = range + back + margin;
    return detail::make_frame(HullKind::cone, math::to_double(l.center) - axis * back, axis, along * std::tan(half) / 0.95105651, along);
}

namespace detail {

/// How many of `count` ascending borders hold for `is_past`, by binary search: those before the first that does not.
template <class Past>
[[nodiscard]] constexpr std::uint32_t count_past(std::uint32_t count, Past&& is_past) {
    std::uint32_t first = 0;
    for (std::uint32_t rest = count; rest > 0;) {
        std::uint32_t const half = rest / 2;
        bool const past = is_past(first + half);
        first = past ? first + half + 1 : first;
        rest = past ? rest - half - 1 : half;
    }
    return first;
}

}  // namespace detail

/// Tiles of an image: borders between columns, then between rows, x / depth and y / depth or x and y; both ascend.
struct HullTiles {
    std::span<float const> x;
    std::span<float const> y;
    bool perspective = true;
};

/// Calls `visit(column, row)` once for each tile that one of a hull's triangles may touch; nothing for one that faces the eye.
///
/// expects: a hull that is a mesh; `make_hull` of the same kind of view
template <class Visit>
void for_each_tile(Hull const& hull, std::uint32_t f, HullTiles const& tiles, Visit&& visit) {
    using namespace formula;
    HullFace const face = gn_hull_face(hull, f, tiles.perspective);
    if (face.kind == 0) return;
    auto const columns = static_cast<std::uint32_t>(tiles.x.size() - 1), rows = static_cast<std::uint32_t>(tiles.y.size() - 1);
    std::uint32_t const left = detail::count_past(columns, [&](std::uint32_t i) { return gn_is_face_right(face, tiles.x[i + 1], 1.0F); });
    std::uint32_t const right = detail::count_past(columns, [&](std::uint32_t i) { return !gn_is_face_right(face, -tiles.x[i], -1.0F); });
    std::uint32_t const top = detail::count_past(rows, [&](std::uint32_t j) { return gn_is_face_below(face, tiles.y[j + 1], 1.0F); });
    std::uint32_t const bottom = detail::count_past(rows, [&](std::uint32_t j) { return !gn_is_face_below(face, -tiles.y[j], -1.0F); });
    auto const covers = [&](std::uint32_t i, std::uint32_t i_end, std::uint32_t j, std::uint32_t j_end) {
        return gn_may_cover(face, {tiles.x[i], tiles.x[i_end], tiles.y[j], tiles.y[j_end]});
    };
    for (std::uint32_t block_j = top; block_j < bottom; block_j += hull_block)
        for (std::uint32_t block_i = left; block_i < right; block_i += hull_block) {
            std::uint32_t const j_end = std::min(block_j + hull_block, bottom), i_end = std::min(block_i + hull_block, right);
            if (!covers(block_i, i_end, block_j, j_end)) continue;
            for (std::uint32_t j = block_j; j < j_end; ++j)
                for (std::uint32_t i = block_i; i < i_end; ++i)
                    if (covers(i, i + 1, j, j + 1)) visit(i, j);
        }
}

}  // namespace gnomon::lights
