#pragma once
// A scene's triangles as one indexed list of floats: the frame's geometry, shared by every pass and by the truth.
//
// Work space: float3 = world - origin, the difference taken in double and rounded once. Whoever draws, samples or traces
// reads these same floats. A triangle's id is its place in `indices` / 3.

#include <gnomon/math/bounds.hpp>
#include <gnomon/scene/scene.hpp>

#include <cstdint>
#include <optional>
#include <vector>

namespace gnomon::scene {

struct FlattenConfig {
    std::optional<math::dvec3> origin_m;  ///< Unset: the scene's centre, rounded to whole `origin_step_m` per axis.
};

/// 0 for a scene around the world's origin; exact in float and double far from it.
inline constexpr double origin_step_m = 1024.0;

/// Triangles of one primitive of one instance, in a row.
struct Range {
    std::uint32_t first_triangle = 0;
    std::uint32_t triangle_count = 0;
    std::uint32_t material = none;  ///< Into `Scene::materials`.
    std::uint32_t instance = none;  ///< Into `Scene::instances`.

    friend bool operator==(Range const&, Range const&) = default;
};

/// Triangles in a row that one draw call can take: same alpha mode, same sidedness.
struct DrawRange {
    std::uint32_t first_triangle = 0;
    std::uint32_t triangle_count = 0;
    AlphaMode alpha_mode = AlphaMode::opaque;
    bool double_sided = false;

    friend bool operator==(DrawRange const&, DrawRange const&) = default;
};

struct Geometry {
    math::dvec3 origin_m{0.0, 0.0, 0.0};
    std::vector<math::vec3> positions;
    std::vector<math::vec3> normals;               ///< Shading normals, unit length, one per position.
    std::vector<math::vec2> uv;                    ///< For the base colour texture: its set, its transform applied.
    std::vector<std::uint32_t> indices;            ///< Three per triangle; counter-clockwise from the front.
    std::vector<std::uint32_t> triangle_material;  ///< One per triangle, into `Scene::materials`.
    std::vector<std::uint32_t> triangle_instance;  ///< One per triangle, into `Scene::instances`.
    std::vector<Range> ranges;                     ///< Cover all triangles in order.
    std::vector<DrawRange> draws;                  ///< Cover all triangles in order; at most six.
    math::Aabb bounds;                             ///< Of the triangles, in work space.
    std::uint64_t non_finite_triangles = 0;        ///< Left out: a corner has no finite float in work space.
};

/// The triangles of `scene` in work space, ordered by (alpha mode, double-sidedness), then as the scene has them.
///
/// A transform that mirrors has its triangles' windings reversed, so a front face stays one.
///
/// expects: `scene` passes `validate`; at most 2^32 - 1 triangles and vertices (the loader's limits are far below).
/// returns: the same bytes on every machine.
/// cost:    O(triangles); allocates the result.
[[nodiscard]] Geometry flatten(Scene const& scene, FlattenConfig const& config = {});

/// A position of the world in the geometry's floats.
[[nodiscard]] inline math::vec3 to_work_space(Geometry const& geometry, math::dvec3 const& world_m) noexcept {
    return math::to_float(world_m - geometry.origin_m);
}

}  // namespace gnomon::scene
