#include <gnomon/math/scalar.hpp>
#include <gnomon/scene/flatten.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>

namespace gnomon::scene {

namespace {

using math::dmat3;
using math::dmat4;
using math::dvec2;
using math::dvec3;
using math::vec2;
using math::vec3;

/// Where a vertex stands in the world: M p, in double, in a fixed order of operations.
dvec3 to_world(dmat4 const& m, vec3 const& position) noexcept {
    dvec3 const p = math::to_double(position);
    dvec3 w;
    for (int row = 0; row < 3; ++row) w[row] = ((m[0][row] * p.x + m[1][row] * p.y) + m[2][row] * p.z) + m[3][row];
    return w;
}

double determinant(dmat4 const& m) noexcept {
    return m[0][0] * (m[1][1] * m[2][2] - m[2][1] * m[1][2]) - m[1][0] * (m[0][1] * m[2][2] - m[2][1] * m[0][2]) +
           m[2][0] * (m[0][1] * m[1][2] - m[1][1] * m[0][2]);
}

/// Turns normals as the matrix turns planes: its cofactors, whose sign a mirroring matrix changes, so that is undone.
dmat3 normal_matrix(dmat4 const& m, bool mirrors) noexcept {
    auto const column = [&](int i) { return dvec3(m[i][0], m[i][1], m[i][2]); };
    double const sign = mirrors ? -1.0 : 1.0;
    dmat3 n(0.0);
    n[0] = glm::cross(column(1), column(2)) * sign;
    n[1] = glm::cross(column(2), column(0)) * sign;
    n[2] = glm::cross(column(0), column(1)) * sign;
    return n;
}

/// `v` with length 1; where it has none to scale, `fallback`.
vec3 unit_or(dvec3 v, vec3 const& fallback) noexcept {
    double const largest = std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)});
    if (!(largest > 0.0) || !math::is_finite(largest)) return fallback;
    v = v / largest;
    return math::to_float(v / std::sqrt((v.x * v.x + v.y * v.y) + v.z * v.z));
}

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

/// The scene's centre, rounded to whole steps: of each primitive's box, its eight corners in the world.
dvec3 choose_origin(Scene const& scene) {
    constexpr double inf = std::numeric_limits<double>::infinity();
    std::vector<math::Aabb> boxes;
    std::vector<std::size_t> first_box;
    for (Mesh const& mesh : scene.meshes) {
        first_box.push_back(boxes.size());
        for (Primitive const& p : mesh.primitives)
            boxes.push_back(p.indices.empty() ? math::Aabb{} : math::bounds_of(p.positions));
    }
    dvec3 lo(inf);
    dvec3 hi(-inf);
    for (Instance const& instance : scene.instances)
        for (std::size_t p = 0; p < scene.meshes[instance.mesh].primitives.size(); ++p) {
            math::Aabb const& box = boxes[first_box[instance.mesh] + p];
            if (math::is_empty(box)) continue;
            for (unsigned corner = 0; corner < 8; ++corner) {
                dvec3 const w = to_world(instance.world_from_mesh, math::corner(box, corner));
                if (!math::is_finite(w)) continue;
                lo = glm::min(lo, w);
                hi = glm::max(hi, w);
            }
        }
    dvec3 origin(0.0);
    for (int axis = 0; axis < 3; ++axis) {
        double const steps = std::round((lo[axis] * 0.5 + hi[axis] * 0.5) / origin_step_m);
        // Beyond 2^52 steps a step is less than an ulp; the scene has no detail to save there.
        if (std::abs(steps) < 0x1p52) origin[axis] = steps * origin_step_m + 0.0;
    }
    return origin;
}

class Flattener {
public:
    Flattener(Scene const& scene, dvec3 const& origin) : scene_(scene) { out_.origin_m = origin; }

    Geometry run() {
        std::vector<Part> const parts = ordered_parts(scene_);
        reserve(parts);
        for (Part const& part : parts) {
            auto const first = triangle_count();
            add(part);
            if (triangle_count() != first) close_range(part, first);
        }
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

    void add(Part const& part) {
        Primitive const& p = primitive_of(part);
        dmat4 const& m = scene_.instances[part.instance].world_from_mesh;
        bool const mirrors = determinant(m) < 0.0;
        auto const base = static_cast<std::uint32_t>(out_.positions.size());
        add_vertices(p, m, mirrors);
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
                out_.bounds = math::extended(out_.bounds, out_.positions[index]);
            }
            out_.triangle_material.push_back(p.material);
            out_.triangle_instance.push_back(part.instance);
        }
    }

    void add_vertices(Primitive const& p, dmat4 const& m, bool mirrors) {
        dmat3 const turn = normal_matrix(m, mirrors);
        Material const& material = scene_.materials[p.material];
        UvTransform const transform(material.base_color_texture);
        std::vector<vec2> const& uv = material.base_color_texture.uv_set == 1 ? p.uv1 : p.uv0;
        for (std::size_t v = 0; v < p.positions.size(); ++v) {
            out_.positions.push_back(math::to_float(to_world(m, p.positions[v]) - out_.origin_m));
            dvec3 const n = math::to_double(p.normals[v]);
            out_.normals.push_back(unit_or(turn[0] * n.x + turn[1] * n.y + turn[2] * n.z, vec3(0.0F, 1.0F, 0.0F)));
            out_.uv.push_back(transform(uv.empty() ? vec2(0.0F) : uv[v]));
        }
    }

    void close_range(Part const& part, std::uint32_t first) {
        Material const& material = scene_.materials[primitive_of(part).material];
        std::uint32_t const count = triangle_count() - first;
        out_.ranges.push_back({first, count, primitive_of(part).material, part.instance});
        bool const goes_on = !out_.draws.empty() && out_.draws.back().alpha_mode == material.alpha_mode &&
                             out_.draws.back().double_sided == material.double_sided;
        if (goes_on)
            out_.draws.back().triangle_count += count;
        else
            out_.draws.push_back({first, count, material.alpha_mode, material.double_sided});
    }

    Scene const& scene_;
    Geometry out_;
};

}  // namespace

Geometry flatten(Scene const& scene, FlattenConfig const& config) {
    return Flattener(scene, config.origin_m ? *config.origin_m : choose_origin(scene)).run();
}

}  // namespace gnomon::scene
