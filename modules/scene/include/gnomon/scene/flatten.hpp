#pragma once
// A scene's triangles as one indexed list of floats: the frame's geometry, shared by every pass and by the truth.
//
// Work space: float3 = world - origin, the difference taken in double and rounded once. Whoever draws, samples or traces
// reads these same floats. A triangle's id is its place in `indices` / 3.

#include <gnomon/math/bounds.hpp>
#include <gnomon/scene/pose.hpp>
#include <gnomon/scene/scene.hpp>

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

namespace gnomon::scene {

struct FlattenConfig {
    std::optional<math::dvec3> origin_m;  ///< Unset: the centre of the scene at rest, in whole `origin_step_m`.
};

/// 0 for a scene around the world's origin; exact in float and double far from it.
inline constexpr double origin_step_m = 1024.0;

/// Triangles of one primitive of one instance, in a row.
struct Range {
    std::uint32_t first_triangle = 0;
    std::uint32_t triangle_count = 0;
    std::uint32_t material = none;  ///< Into `Scene::materials`.
    std::uint32_t instance = none;  ///< Into `Scene::instances`.
    std::uint32_t primitive = 0;    ///< Into the primitives of the instance's mesh.
    std::uint32_t first_vertex = 0;  ///< Into `Geometry::positions`: vertex k here is vertex k of the primitive.
    std::uint32_t vertex_count = 0;
    bool mirrored = false;  ///< The windings are the primitive's reversed.

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
    std::vector<math::Aabb> instance_bounds;       ///< Per instance, of its triangles, in work space; empty without any.
    math::Aabb bounds;                             ///< Of all triangles, in work space.
    std::uint64_t non_finite_triangles = 0;        ///< Left out: a corner has no finite float in work space.
    std::vector<std::uint32_t> instance_revision;  ///< Per instance: another number after an update that changed it.
    std::shared_ptr<void const> identity;          ///< Of its triangle list: no two calls of `flatten` give the same.
    std::uint64_t held_vertices = 0;               ///< `update` left them in place: the pose has no finite one for them.
};

/// The triangles of `scene` at rest in work space, ordered by (alpha mode, double-sidedness), then as the scene has them.
///
/// A transform that mirrors has its triangles' windings reversed, so a front face stays one.
///
/// expects: `scene` passes `validate`; at most 2^32 - 1 triangles and vertices (the loader's limits are far below).
/// returns: the same bytes on every machine.
/// cost:    O(triangles); allocates the result.
[[nodiscard]] Geometry flatten(Scene const& scene, FlattenConfig const& config = {});

/// The same in a pose: nodes, morph targets and joints applied. The origin is that of the scene at rest, so that it is
/// the same at all times.
///
/// source:  [glTF 2.0, 3.7.2.2 (morph targets) and 3.7.3 (skins)]; a vertex goes by the weighted mean of its joints'
///          matrices, its normal by that mean's cofactors
/// expects: `pose` is one of this scene.
[[nodiscard]] Geometry flatten(Scene const& scene, Pose const& pose, FlattenConfig const& config = {});

/// Moves the triangles of `geometry` to another pose, in place: positions, normals and bounds. The triangles, their order
/// and ids stay, so what was built on them (batches, trees) is refitted and not built again.
///
/// expects: `geometry` was flattened from this scene, at any pose; `pose` is one of this scene.
/// cost:    O(vertices and triangles of the instances that can move); allocates nothing.
void update(Geometry& geometry, Scene const& scene, Pose const& pose);

/// A position of the world in the geometry's floats.
[[nodiscard]] inline math::vec3 to_work_space(Geometry const& geometry, math::dvec3 const& world_m) noexcept {
    return math::to_float(world_m - geometry.origin_m);
}

}  // namespace gnomon::scene
