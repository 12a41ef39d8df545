#include "detail/gltf_accessor.hpp"
#include "detail/gltf_parts.hpp"

#include <gnomon/math/scalar.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

namespace gnomon::scene::detail {

namespace {

using math::dvec3;
using math::vec2;
using math::vec3;

/// The normal of a triangle, of length 1; straight up where it has no area.
vec3 face_normal(vec3 const& a, vec3 const& b, vec3 const& c) noexcept {
    dvec3 const n = glm::cross(math::to_double(b) - math::to_double(a), math::to_double(c) - math::to_double(a));
    double const largest = std::max({std::abs(n.x), std::abs(n.y), std::abs(n.z)});
    if (!(largest > 0.0) || !math::is_finite(largest)) return vec3(0.0F, 1.0F, 0.0F);
    return math::to_float(glm::normalize(n / largest));
}

vec3 read_vec3(Accessor const& a, std::size_t i) noexcept { return {a.at(i, 0), a.at(i, 1), a.at(i, 2)}; }

class PrimitiveLoader {
public:
    PrimitiveLoader(Document& document, Scene& scene, tinygltf::Primitive const& in, std::string where)
        : document_(document), scene_(scene), in_(in), where_(std::move(where)) {}

    /// returns: whether there are triangles.
    bool run(Primitive& out) {
        if (in_.mode >= TINYGLTF_MODE_POINTS && in_.mode < TINYGLTF_MODE_TRIANGLES) {
            ++document_.notes.points_and_lines;
            return false;
        }
        if (in_.mode < 0 || in_.mode > TINYGLTF_MODE_TRIANGLE_FAN)
            fail(SceneError::malformed, where_ + " is of mode " + std::to_string(in_.mode) + "; glTF has modes 0 to 6");
        if (in_.attributes.count("POSITION") == 0) {
            document_.warn(where_ + " has no positions and is left out.");
            return false;
        }
        positions_ = make_accessor(document_, in_.attributes.at("POSITION"));
        need_components(positions_, 3, "POSITION");
        out.material = material();
        out.indices = triangles();
        choose_vertices(out);
        read_vertices(out);
        drop_non_finite(out);
        document_.triangles += out.indices.size() / 3;
        return !out.indices.empty();
    }

private:
    void need_components(Accessor const& a, int components, char const* name) const {
        if (a.components != components)
            fail(SceneError::malformed, where_ + "'s " + name + " has " + std::to_string(a.components) +
                                            " components; glTF wants " + std::to_string(components));
    }

    [[nodiscard]] std::uint32_t material() {
        if (in_.material >= 0 && static_cast<std::size_t>(in_.material) >= document_.model.materials.size())
            fail(SceneError::malformed, where_ + " names material " + std::to_string(in_.material) +
                                            " and there are only " + std::to_string(document_.model.materials.size()) +
                                            "; export the file again");
        if (in_.material >= 0) return static_cast<std::uint32_t>(in_.material);
        // One more material, the default of glTF, for all primitives that name none.
        if (scene_.materials.size() == document_.model.materials.size()) scene_.materials.emplace_back();
        return static_cast<std::uint32_t>(scene_.materials.size() - 1);
    }

    /// The primitive's index list as the file has it, each index checked.
    std::vector<std::uint32_t> corner_list() {
        std::vector<std::uint32_t> corners;
        if (in_.indices < 0) {
            check_triangle_limit(positions_.count);
            document_.charge_elements(positions_.count);
            corners.resize(positions_.count);
            std::iota(corners.begin(), corners.end(), 0U);
            return corners;
        }
        Accessor const list = make_accessor(document_, in_.indices);
        bool const is_unsigned = list.component_type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE ||
                                 list.component_type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT ||
                                 list.component_type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT;
        if (list.components != 1 || !is_unsigned)
            fail(SceneError::malformed, where_ + "'s indices are of component type " +
                                            std::to_string(list.component_type) + " with " +
                                            std::to_string(list.components) + " components; glTF wants unsigned numbers");
        check_triangle_limit(list.count);
        corners.reserve(list.count);
        for (std::size_t i = 0; i < list.count; ++i) {
            std::uint32_t const corner = list.index_at(i);
            if (corner >= positions_.count)
                fail(SceneError::malformed, where_ + " has index " + std::to_string(corner) + " and only " +
                                                std::to_string(positions_.count) + " vertices; export the file again");
            corners.push_back(corner);
        }
        return corners;
    }

    void check_triangle_limit(std::size_t corners) const {
        bool const list = in_.mode == TINYGLTF_MODE_TRIANGLES;
        if (corners / (list ? 3 : 1) + document_.triangles > document_.config.limits.max_triangles || corners >= none)
            fail(SceneError::over_limit, where_ + " brings the triangles above the limit of " +
                                             std::to_string(document_.config.limits.max_triangles) +
                                             "; simplify the scene or raise max_triangles");
    }

    std::vector<std::uint32_t> triangles() {
        std::vector<std::uint32_t> corners = corner_list();
        if (in_.mode == TINYGLTF_MODE_TRIANGLES) {
            if (corners.size() % 3 != 0)
                document_.warn(where_ + " has " + std::to_string(corners.size()) + " corners; those beyond whole triangles are left out.");
            corners.resize(corners.size() / 3 * 3);
            return corners;
        }
        bool const fan = in_.mode == TINYGLTF_MODE_TRIANGLE_FAN;
        std::vector<std::uint32_t> out;
        for (std::size_t i = 2; i < corners.size(); ++i) {
            bool const swapped = !fan && i % 2 != 0;
            std::array<std::uint32_t, 3> const t{fan ? corners[0] : corners[swapped ? i - 1 : i - 2],
                                                 fan ? corners[i - 1] : corners[swapped ? i - 2 : i - 1], corners[i]};
            out.insert(out.end(), t.begin(), t.end());
        }
        return out;
    }

    /// Many primitives may share one long vertex array; each keeps what it uses.
    void choose_vertices(Primitive& out) {
        if (out.indices.size() * 2 >= positions_.count) {
            chosen_.resize(positions_.count);
            std::iota(chosen_.begin(), chosen_.end(), 0U);
        } else {
            chosen_ = out.indices;
            std::sort(chosen_.begin(), chosen_.end());
            chosen_.erase(std::unique(chosen_.begin(), chosen_.end()), chosen_.end());
            for (std::uint32_t& index : out.indices)
                index = static_cast<std::uint32_t>(std::lower_bound(chosen_.begin(), chosen_.end(), index) - chosen_.begin());
        }
        document_.charge_elements(chosen_.size());
    }

    /// returns: whether the primitive has the attribute; `out` is then an accessor as long as the positions.
    bool find_attribute(char const* name, int components, Accessor& out) {
        auto const found = in_.attributes.find(name);
        if (found == in_.attributes.end()) return false;
        out = make_accessor(document_, found->second);
        need_components(out, components, name);
        if (out.count != positions_.count)
            fail(SceneError::malformed, where_ + " has " + std::to_string(positions_.count) + " positions and " +
                                            std::to_string(out.count) + " of " + name + "; export the file again");
        return true;
    }

    void read_uv(char const* name, std::vector<vec2>& out) {
        Accessor uv;
        if (!find_attribute(name, 2, uv)) return;
        out.reserve(chosen_.size());
        for (std::uint32_t v : chosen_) {
            vec2 value(uv.at(v, 0), uv.at(v, 1));
            if (!math::is_finite(value.x) || !math::is_finite(value.y)) {
                ++document_.notes.mended_uvs;
                value = vec2(0.0F);
            }
            out.push_back(value);
        }
    }

    void read_vertices(Primitive& out) {
        out.positions.reserve(chosen_.size());
        for (std::uint32_t v : chosen_) out.positions.push_back(read_vec3(positions_, v));
        read_uv("TEXCOORD_0", out.uv0);
        read_uv("TEXCOORD_1", out.uv1);
        VertexSource const source{document_, in_, where_, positions_.count, chosen_};
        read_influences(source, out);
        read_morph_targets(source, out);
        Accessor normals;
        if (find_attribute("NORMAL", 3, normals))
            read_normals(normals, out);
        else
            make_flat(out);
    }

    void read_normals(Accessor const& normals, Primitive& out) {
        for (std::uint32_t v : chosen_) {
            dvec3 const n = math::to_double(read_vec3(normals, v));
            double const length_sq = (n.x * n.x + n.y * n.y) + n.z * n.z;
            bool const usable = math::is_finite(length_sq) && length_sq > 1e-30;
            // What is of length 1 already stays as it is, so that a second reading changes nothing.
            bool const is_unit = std::abs(length_sq - 1.0) < 1e-4;
            out.normals.push_back(!usable ? vec3(0.0F) : math::to_float(is_unit ? n : n / std::sqrt(length_sq)));
        }
        for (std::size_t i = 0; i + 2 < out.indices.size(); i += 3)
            for (std::size_t k = 0; k < 3; ++k)
                if (vec3& n = out.normals[out.indices[i + k]]; n == vec3(0.0F)) {
                    ++document_.notes.mended_normals;
                    n = face_normal(out.positions[out.indices[i]], out.positions[out.indices[i + 1]],
                                    out.positions[out.indices[i + 2]]);
                }
        for (vec3& n : out.normals)
            if (n == vec3(0.0F)) n = vec3(0.0F, 1.0F, 0.0F);
    }

    /// glTF's rule where normals are missing: each triangle gets its own, so it gets its own vertices.
    void make_flat(Primitive& out) {
        document_.charge_elements(out.indices.size());
        Primitive flat;
        flat.material = out.material;
        expand_motion(out, flat);
        for (std::size_t i = 0; i + 2 < out.indices.size(); i += 3) {
            vec3 const n = face_normal(out.positions[out.indices[i]], out.positions[out.indices[i + 1]],
                                       out.positions[out.indices[i + 2]]);
            for (std::size_t k = i; k < i + 3; ++k) {
                std::uint32_t const v = out.indices[k];
                flat.indices.push_back(static_cast<std::uint32_t>(k));
                flat.positions.push_back(out.positions[v]);
                flat.normals.push_back(n);
                if (!out.uv0.empty()) flat.uv0.push_back(out.uv0[v]);
                if (!out.uv1.empty()) flat.uv1.push_back(out.uv1[v]);
            }
        }
        out = std::move(flat);
    }

    /// The joints and morph targets of each corner's vertex. The targets' normals belong to smooth ones and are left out.
    void expand_motion(Primitive const& in, Primitive& flat) {
        document_.charge_elements(in.indices.size() * (in.influences / 4 + in.morph_targets.size()));
        flat.influences = in.influences;
        flat.morph_targets.resize(in.morph_targets.size());
        for (std::uint32_t const v : in.indices)
            for (std::size_t k = v * std::size_t{in.influences}; k < (v + std::size_t{1}) * in.influences; ++k) {
                flat.joints.push_back(in.joints[k]);
                flat.joint_weights.push_back(in.joint_weights[k]);
            }
        for (std::size_t t = 0; t < in.morph_targets.size(); ++t)
            if (!in.morph_targets[t].positions.empty())
                for (std::uint32_t const v : in.indices) flat.morph_targets[t].positions.push_back(in.morph_targets[t].positions[v]);
    }

    void drop_non_finite(Primitive& out) {
        std::size_t kept = 0;
        for (std::size_t i = 0; i + 2 < out.indices.size(); i += 3) {
            bool finite = true;
            for (std::size_t k = i; k < i + 3; ++k) finite = finite && math::is_finite(out.positions[out.indices[k]]);
            if (!finite) {
                ++document_.notes.non_finite_triangles;
                continue;
            }
            for (std::size_t k = i; k < i + 3; ++k) out.indices[kept++] = out.indices[k];
        }
        out.indices.resize(kept);
        for (vec3& p : out.positions)
            if (!math::is_finite(p)) p = vec3(0.0F);
    }

    Document& document_;
    Scene& scene_;
    tinygltf::Primitive const& in_;
    std::string where_;
    Accessor positions_;
    std::vector<std::uint32_t> chosen_;  ///< The vertices to read, ascending.
};

}  // namespace

std::vector<std::uint32_t> load_meshes(Document& document, Scene& scene) {
    std::vector<std::uint32_t> mesh_of(document.model.meshes.size(), none);
    for (std::size_t m = 0; m < document.model.meshes.size(); ++m) {
        tinygltf::Mesh const& in = document.model.meshes[m];
        Mesh mesh;
        mesh.name = in.name;
        for (std::size_t p = 0; p < in.primitives.size(); ++p) {
            Primitive primitive;
            if (PrimitiveLoader(document, scene, in.primitives[p], item("mesh", m) + ", " + item("primitive", p)).run(primitive))
                mesh.primitives.push_back(std::move(primitive));
        }
        if (mesh.primitives.empty()) continue;
        for (Primitive const& p : mesh.primitives)
            if (p.morph_targets.size() != count_morph_targets(mesh))
                fail(SceneError::malformed, item("mesh", m) + " has primitives of " + std::to_string(p.morph_targets.size()) + " and of " +
                                                std::to_string(count_morph_targets(mesh)) + " morph targets; export the file again");
        mesh.weights = read_default_weights(document, in.weights, count_morph_targets(mesh), item("mesh", m));
        mesh_of[m] = static_cast<std::uint32_t>(scene.meshes.size());
        scene.meshes.push_back(std::move(mesh));
    }
    return mesh_of;
}

}  // namespace gnomon::scene::detail
