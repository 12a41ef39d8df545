#include <gnomon/scene/flatten.hpp>

#include "detail/posed_part.hpp"

#include <gnomon/core/contract.hpp>
#include <gnomon/math/scalar.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>

namespace gnomon::scene {

namespace {

using detail::PosedPart;
using math::dmat4;
using math::dvec2;
using math::dvec3;
using math::vec2;
using math::vec3;

/// uv' = offset + R(rotation) (scale * uv), with the sense of rotation of KHR_texture_transform.
struct UvTransform {
    dvec2 offset{0.0, 0.0};
    dvec2 scale{1.0, 1.0};
    double cosine = 1.0;
    double sine = 0.0;

    explicit UvTransform(TextureUse const& use) noexcept
        : offset(static_cast<double>(use.offset.x), static_cast<double>(use.offset.y)),
          scale(static_cast<double>(use.scale.x), static_cast<double>(use.scale.y)) {
        if (use.rotation_rad == 0.0F) return;
        cosine = std::cos(static_cast<double>(use.rotation_rad));
        sine = std::sin(static_cast<double>(use.rotation_rad));
    }

    [[nodiscard]] vec2 operator()(vec2 const& uv) const noexcept {
        dvec2 const s(static_cast<double>(uv.x) * scale.x, static_cast<double>(uv.y) * scale.y);
        dvec2 const t(offset.x + (cosine * s.x + sine * s.y), offset.y + (cosine * s.y - sine * s.x));
        vec2 const rounded(static_cast<float>(t.x), static_cast<float>(t.y));
        return math::is_finite(rounded.x) && math::is_finite(rounded.y) ? rounded : vec2(0.0F);
    }
};

/// One primitive of one instance, with the key that orders the draws.
struct Part {
    std::uint32_t instance;
    std::uint32_t primitive;
    unsigned key;
};

constexpr unsigned sort_key(Material const& material) noexcept {
    return static_cast<unsigned>(material.alpha_mode) * 2 + (material.double_sided ? 1U : 0U);
}

std::vector<Part> ordered_parts(Scene const& scene) {
    std::vector<Part> parts;
    for (std::uint32_t i = 0; i < scene.instances.size(); ++i) {
        Mesh const& mesh = scene.meshes[scene.instances[i].mesh];
        for (std::uint32_t p = 0; p < mesh.primitives.size(); ++p)
            if (!mesh.primitives[p].indices.empty())
                parts.push_back({i, p, sort_key(scene.materials[mesh.primitives[p].material])});
    }
    std::stable_sort(parts.begin(), parts.end(), [](Part const& a, Part const& b) { return a.key < b.key; });
    return parts;
}

/// The smallest box of the world that holds the eight corners of boxes wherever matrices take them.
class WorldBox {
public:
    void add(dmat4 const& m, math::Aabb const& box) noexcept {
        for (unsigned corner = 0; corner < 8; ++corner) {
            dvec3 const w = detail::to_world(m, math::to_double(math::corner(box, corner)));
            if (!math::is_finite(w)) continue;
            lo_ = glm::min(lo_, w);
            hi_ = glm::max(hi_, w);
        }
    }

    /// The centre in whole steps; 0 along an axis that has none.
    [[nodiscard]] dvec3 rounded_centre() const noexcept {
        dvec3 origin(0.0);
        for (int axis = 0; axis < 3; ++axis) {
            double const steps = std::round((lo_[axis] * 0.5 + hi_[axis] * 0.5) / origin_step_m);
            // Beyond 2^52 steps a step is less than an ulp; the scene has no detail to save there.
            if (std::abs(steps) < 0x1p52) origin[axis] = steps * origin_step_m + 0.0;
        }
        return origin;
    }

private:
    dvec3 lo_ = dvec3(std::numeric_limits<double>::infinity());
    dvec3 hi_ = dvec3(-std::numeric_limits<double>::infinity());
};

/// The scene's centre at rest, rounded to whole steps. Skinned meshes count as they lie under each of their joints.
dvec3 choose_origin(Scene const& scene, Pose const& rest) {
    std::vector<math::Aabb> boxes;
    std::vector<std::size_t> first_box;
    for (Mesh const& mesh : scene.meshes) {
        first_box.push_back(boxes.size());
        for (Primitive const& p : mesh.primitives)
            boxes.push_back(p.indices.empty() ? math::Aabb{} : math::bounds_of(p.positions));
    }
    WorldBox world;
    for (std::size_t i = 0; i < scene.instances.size(); ++i) {
        Instance const& instance = scene.instances[i];
        for (std::size_t p = 0; p < scene.meshes[instance.mesh].primitives.size(); ++p) {
            math::Aabb const& box = boxes[first_box[instance.mesh] + p];
            if (math::is_empty(box)) continue;
            if (instance.skin == none || scene.meshes[instance.mesh].primitives[p].influences == 0) {
                world.add(rest.world_from_mesh[i], box);
                continue;
            }
            for (std::uint32_t j = rest.first_joint[instance.skin]; j < rest.first_joint[instance.skin + 1]; ++j)
                world.add(rest.world_from_bind[j], box);
        }
    }
    return world.rounded_centre();
}

math::Aabb united(std::vector<math::Aabb> const& boxes) noexcept {
    math::Aabb all;
    for (math::Aabb const& box : boxes)
        if (!math::is_empty(box)) all = math::merged(all, box);
    return all;
}

class Flattener {
public:
    Flattener(Scene const& scene, Pose const& pose, dvec3 const& origin) : scene_(scene), pose_(pose) {
        out_.origin_m = origin;
        out_.instance_bounds.resize(scene.instances.size());
        out_.instance_revision.resize(scene.instances.size());
        out_.identity = std::make_shared<char>();
    }

    Geometry run() {
        std::vector<Part> const parts = ordered_parts(scene_);
        reserve(parts);
        for (Part const& part : parts) {
            Range range{triangle_count(), 0, primitive_of(part).material, part.instance, part.primitive, 0, 0, false};
            range.first_vertex = static_cast<std::uint32_t>(out_.positions.size());
            range.vertex_count = static_cast<std::uint32_t>(primitive_of(part).positions.size());
            add(part, range);
            range.triangle_count = triangle_count() - range.first_triangle;
            if (range.triangle_count != 0) close(range);
        }
        out_.bounds = united(out_.instance_bounds);
        return std::move(out_);
    }

private:
    [[nodiscard]] std::uint32_t triangle_count() const noexcept {
        return static_cast<std::uint32_t>(out_.triangle_material.size());
    }

    [[nodiscard]] Primitive const& primitive_of(Part const& part) const noexcept {
        return scene_.meshes[scene_.instances[part.instance].mesh].primitives[part.primitive];
    }

    void reserve(std::vector<Part> const& parts) {
        std::size_t vertices = 0;
        std::size_t triangles = 0;
        for (Part const& part : parts) {
            vertices += primitive_of(part).positions.size();
            triangles += primitive_of(part).indices.size() / 3;
        }
        GNOMON_EXPECT(vertices < none && triangles < none);
        out_.positions.reserve(vertices);
        out_.normals.reserve(vertices);
        out_.uv.reserve(vertices);
        out_.indices.reserve(triangles * 3);
        out_.triangle_material.reserve(triangles);
        out_.triangle_instance.reserve(triangles);
    }

    void add(Part const& part, Range& range) {
        Primitive const& p = primitive_of(part);
        PosedPart const posed(scene_, pose_, part.instance, part.primitive);
        bool const mirrors = posed.mirrors();
        std::uint32_t const base = range.first_vertex;
        math::Aabb& bounds = out_.instance_bounds[part.instance];
        range.mirrored = mirrors;
        add_vertices(p, posed);
        for (std::size_t i = 0; i + 2 < p.indices.size(); i += 3) {
            std::array<std::uint32_t, 3> t{base + p.indices[i], base + p.indices[i + 1], base + p.indices[i + 2]};
            if (mirrors) std::swap(t[1], t[2]);
            bool finite = true;
            for (std::uint32_t index : t) finite = finite && math::is_finite(out_.positions[index]);
            if (!finite) {
                ++out_.non_finite_triangles;
                continue;
            }
            for (std::uint32_t index : t) {
                out_.indices.push_back(index);
                bounds = math::extended(bounds, out_.positions[index]);
            }
            out_.triangle_material.push_back(p.material);
            out_.triangle_instance.push_back(part.instance);
        }
    }

    void add_vertices(Primitive const& p, PosedPart const& posed) {
        Material const& material = scene_.materials[p.material];
        UvTransform const transform(material.base_color_texture);
        std::vector<vec2> const& uv = material.base_color_texture.uv_set == 1 ? p.uv1 : p.uv0;
        for (std::size_t v = 0; v < p.positions.size(); ++v) {
            PosedPart::Vertex const vertex = posed.vertex(v);
            out_.positions.push_back(math::to_float(vertex.world_m - out_.origin_m));
            out_.normals.push_back(vertex.normal);
            out_.uv.push_back(transform(uv.empty() ? vec2(0.0F) : uv[v]));
        }
    }

    void close(Range const& range) {
        Material const& material = scene_.materials[range.material];
        out_.ranges.push_back(range);
        bool const goes_on = !out_.draws.empty() && out_.draws.back().alpha_mode == material.alpha_mode &&
                             out_.draws.back().double_sided == material.double_sided;
        if (goes_on)
            out_.draws.back().triangle_count += range.triangle_count;
        else
            out_.draws.push_back({range.first_triangle, range.triangle_count, material.alpha_mode, material.double_sided});
    }

    Scene const& scene_;
    Pose const& pose_;
    Geometry out_;
};

/// Moves the vertices of one range; those that have no finite place stay.
///
/// returns: whether any moved.
bool move_vertices(Geometry& geometry, Range const& range, PosedPart const& posed) noexcept {
    bool moved = false;
    for (std::uint32_t v = 0; v < range.vertex_count; ++v) {
        PosedPart::Vertex const vertex = posed.vertex(v);
        vec3 const position = math::to_float(vertex.world_m - geometry.origin_m);
        if (!math::is_finite(position)) {
            ++geometry.held_vertices;
            continue;
        }
        moved = moved || geometry.positions[range.first_vertex + v] != position;
        geometry.positions[range.first_vertex + v] = position;
        geometry.normals[range.first_vertex + v] = vertex.normal;
    }
    return moved;
}

/// returns: whether its triangles changed.
bool move_range(Geometry& geometry, Range& range, PosedPart const& posed) noexcept {
    bool const moved = move_vertices(geometry, range, posed);
    math::Aabb& bounds = geometry.instance_bounds[range.instance];
    bool const turned = range.mirrored != posed.mirrors();
    range.mirrored = posed.mirrors();
    std::size_t const end = (static_cast<std::size_t>(range.first_triangle) + range.triangle_count) * 3;
    for (std::size_t i = static_cast<std::size_t>(range.first_triangle) * 3; i < end; i += 3) {
        if (turned) std::swap(geometry.indices[i + 1], geometry.indices[i + 2]);
        for (std::size_t k = i; k < i + 3; ++k) bounds = math::extended(bounds, geometry.positions[geometry.indices[k]]);
    }
    return moved || turned;
}

}  // namespace

Geometry flatten(Scene const& scene, Pose const& pose, FlattenConfig const& config) {
    return Flattener(scene, pose, config.origin_m ? *config.origin_m : choose_origin(scene, rest_pose(scene))).run();
}

Geometry flatten(Scene const& scene, FlattenConfig const& config) {
    Pose const rest = rest_pose(scene);
    return Flattener(scene, rest, config.origin_m ? *config.origin_m : choose_origin(scene, rest)).run();
}

void update(Geometry& geometry, Scene const& scene, Pose const& pose) {
    GNOMON_EXPECT(geometry.instance_bounds.size() == scene.instances.size() &&
                  pose.world_from_mesh.size() == scene.instances.size());
    geometry.held_vertices = 0;
    for (std::size_t i = 0; i < scene.instances.size(); ++i)
        if (is_posed(scene, scene.instances[i])) geometry.instance_bounds[i] = math::Aabb{};
    for (Range& range : geometry.ranges)
        if (is_posed(scene, scene.instances[range.instance]) &&
            move_range(geometry, range, PosedPart(scene, pose, range.instance, range.primitive)))
            ++geometry.instance_revision[range.instance];
    geometry.bounds = united(geometry.instance_bounds);
}

}  // namespace gnomon::scene
