#include "detail/gltf_accessor.hpp"
#include "detail/gltf_parts.hpp"
#include "detail/transforms.hpp"

#include <gnomon/math/scalar.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace gnomon::scene::detail {

namespace {

using math::dmat4;
using math::dvec3;
using math::dvec4;

constexpr double half_turn = 3.14159265358979323846;

class NodeLoader {
public:
    NodeLoader(Document& document, std::vector<std::uint32_t> const& mesh_of, Scene& scene)
        : document_(document), nodes_(document.model.nodes), mesh_of_(mesh_of), scene_(scene) {
        for (Mesh const& mesh : scene.meshes) {
            mesh_triangles_.push_back(0);
            for (Primitive const& p : mesh.primitives) mesh_triangles_.back() += p.indices.size() / 3;
        }
    }

    void run() {
        find_parents();
        place_all();
        mark_reached();
        for (std::size_t i = 0; i < nodes_.size(); ++i)
            if (reached_[i]) add(i);
    }

private:
    [[noreturn]] static void bad_node(std::size_t i, std::string const& what) {
        fail(SceneError::malformed, item("node", i) + " " + what + "; export the file again");
    }

    void find_parents() {
        parent_.assign(nodes_.size(), none);
        for (std::size_t i = 0; i < nodes_.size(); ++i)
            for (int child : nodes_[i].children) {
                if (child < 0 || static_cast<std::size_t>(child) >= nodes_.size())
                    bad_node(i, "has the child " + std::to_string(child) + " and there are only " +
                                    std::to_string(nodes_.size()) + " nodes");
                std::uint32_t& parent = parent_[static_cast<std::size_t>(child)];
                if (parent != none)
                    bad_node(static_cast<std::size_t>(child), "is the child of both node " + std::to_string(parent) +
                                                                  " and node " + std::to_string(i));
                parent = static_cast<std::uint32_t>(i);
            }
    }

    [[nodiscard]] dmat4 local(std::size_t i) const {
        tinygltf::Node const& n = nodes_[i];
        if (!n.matrix.empty()) {
            if (n.matrix.size() != 16) bad_node(i, "has a matrix of " + std::to_string(n.matrix.size()) + " numbers");
            dmat4 m(1.0);
            for (int k = 0; k < 16; ++k)
                if (k % 4 != 3) m[k / 4][k % 4] = n.matrix[static_cast<std::size_t>(k)];
            return m;
        }
        auto const wrong = [](std::vector<double> const& v, std::size_t size) { return !v.empty() && v.size() != size; };
        if (wrong(n.translation, 3) || wrong(n.rotation, 4) || wrong(n.scale, 3))
            bad_node(i, "has a translation, rotation or scale of the wrong length");
        dvec3 const t = n.translation.empty() ? dvec3(0.0) : dvec3(n.translation[0], n.translation[1], n.translation[2]);
        dvec3 const s = n.scale.empty() ? dvec3(1.0) : dvec3(n.scale[0], n.scale[1], n.scale[2]);
        dvec4 const r = n.rotation.empty() ? dvec4(0.0, 0.0, 0.0, 1.0)
                                           : dvec4(n.rotation[0], n.rotation[1], n.rotation[2], n.rotation[3]);
        return from_trs({t, r, s});
    }

    /// From the roots down with a list of its own, so that no depth of hierarchy is too deep for the stack.
    void place_all() {
        struct Visit {
            std::uint32_t node;
            std::uint32_t depth;
        };
        world_.assign(nodes_.size(), dmat4(1.0));
        std::vector<Visit> open;
        for (std::size_t i = 0; i < nodes_.size(); ++i)
            if (parent_[i] == none) open.push_back({static_cast<std::uint32_t>(i), 1});
        std::vector<bool> placed(nodes_.size(), false);
        while (!open.empty()) {
            Visit const visit = open.back();
            open.pop_back();
            if (visit.depth > document_.config.limits.max_depth)
                fail(SceneError::over_limit, item("node", visit.node) + " hangs deeper than " +
                                                 std::to_string(document_.config.limits.max_depth) +
                                                 " nodes; flatten the hierarchy or raise max_depth");
            placed[visit.node] = true;
            std::uint32_t const parent = parent_[visit.node];
            world_[visit.node] = parent == none ? local(visit.node) : multiplied(world_[parent], local(visit.node));
            if (!all_finite(world_[visit.node])) bad_node(visit.node, "has a transform too large for a double");
            for (int child : nodes_[visit.node].children) open.push_back({static_cast<std::uint32_t>(child), visit.depth + 1});
        }
        for (std::size_t i = 0; i < nodes_.size(); ++i)
            if (!placed[i]) bad_node(i, "is an ancestor of itself");
    }

    [[nodiscard]] std::vector<int> roots() {
        auto const& scenes = document_.model.scenes;
        std::uint32_t wanted = document_.config.scene_index;
        int const own = document_.model.defaultScene;
        if (wanted == none && own >= 0) wanted = static_cast<std::uint32_t>(own);
        if (wanted == none && !scenes.empty()) wanted = 0;
        if (wanted != none && wanted >= scenes.size())
            fail(document_.config.scene_index == none ? SceneError::malformed : SceneError::bad_config,
                 item("scene", wanted) + " is asked for and there are only " + std::to_string(scenes.size()) +
                     "; ask for one that exists");
        if (wanted != none) {
            scene_.name = scenes[wanted].name;
            return scenes[wanted].nodes;
        }
        std::vector<int> all;
        for (std::size_t i = 0; i < nodes_.size(); ++i)
            if (parent_[i] == none) all.push_back(static_cast<int>(i));
        return all;
    }

    void mark_reached() {
        reached_.assign(nodes_.size(), false);
        std::vector<int> open = roots();
        for (int root : open)
            if (root < 0 || static_cast<std::size_t>(root) >= nodes_.size())
                fail(SceneError::malformed, "the scene names node " + std::to_string(root) + " and there are only " +
                                                std::to_string(nodes_.size()) + "; export the file again");
        while (!open.empty()) {
            auto const i = static_cast<std::size_t>(open.back());
            open.pop_back();
            if (reached_[i]) continue;
            reached_[i] = true;
            open.insert(open.end(), nodes_[i].children.begin(), nodes_[i].children.end());
        }
    }

    void add(std::size_t i) {
        tinygltf::Node const& node = nodes_[i];
        if (node.mesh >= 0) {
            if (static_cast<std::size_t>(node.mesh) >= mesh_of_.size())
                bad_node(i, "names mesh " + std::to_string(node.mesh) + " and there are only " + std::to_string(mesh_of_.size()));
            add_mesh(i, mesh_of_[static_cast<std::size_t>(node.mesh)]);
        }
        if (node.camera >= 0) {
            if (static_cast<std::size_t>(node.camera) >= document_.model.cameras.size())
                bad_node(i, "names camera " + std::to_string(node.camera) + " and there are only " +
                                std::to_string(document_.model.cameras.size()));
            add_camera(i, document_.model.cameras[static_cast<std::size_t>(node.camera)]);
        }
        if (auto const* light = extension(node.extensions, "KHR_lights_punctual")) {
            std::uint32_t const index = whole_or_none(member(*light, "light"));
            if (index >= document_.model.lights.size())
                bad_node(i, "names light " + std::to_string(index) + " and there are only " +
                                std::to_string(document_.model.lights.size()));
            add_light(i, document_.model.lights[index]);
        }
    }

    void add_mesh(std::size_t i, std::uint32_t mesh) {
        if (mesh == none) return;
        auto const* many = extension(nodes_[i].extensions, "EXT_mesh_gpu_instancing");
        if (many == nullptr) return add_instance(i, mesh, world_[i]);
        auto const* attributes = member(*many, "attributes");
        if (attributes == nullptr) bad_node(i, "is instanced without attributes");
        auto const read = [&](char const* name, int components) {
            std::uint32_t const index = whole_or_none(member(*attributes, name));
            Accessor a;
            if (index == none) return a;
            a = make_accessor(document_, static_cast<int>(index));
            if (a.components != components) bad_node(i, std::string("is instanced with a wrong ") + name);
            return a;
        };
        Accessor const t = read("TRANSLATION", 3);
        Accessor const r = read("ROTATION", 4);
        Accessor const s = read("SCALE", 3);
        std::size_t const count = std::max({t.count, r.count, s.count});
        for (Accessor const* a : {&t, &r, &s})
            if (a->components != 0 && a->count != count) bad_node(i, "is instanced with attributes of unequal length");
        for (std::size_t k = 0; k < count; ++k) {
            auto const number = [&](Accessor const& a, int c, double fallback) {
                return a.components == 0 ? fallback : static_cast<double>(a.at(k, c));
            };
            dmat4 const own = from_trs({{number(t, 0, 0.0), number(t, 1, 0.0), number(t, 2, 0.0)},
                                        {number(r, 0, 0.0), number(r, 1, 0.0), number(r, 2, 0.0), number(r, 3, 1.0)},
                                        {number(s, 0, 1.0), number(s, 1, 1.0), number(s, 2, 1.0)}});
            add_instance(i, mesh, multiplied(world_[i], own));
        }
    }

    void add_instance(std::size_t i, std::uint32_t mesh, dmat4 const& world) {
        if (!all_finite(world)) bad_node(i, "has an instance whose transform is not finite");
        if (scene_.instances.size() >= document_.config.limits.max_nodes)
            fail(SceneError::over_limit, item("node", i) + " brings the instances above the limit of " +
                                             std::to_string(document_.config.limits.max_nodes) + "; raise max_nodes");
        triangles_ += mesh_triangles_[mesh];
        if (triangles_ > document_.config.limits.max_triangles)
            fail(SceneError::over_limit, item("node", i) + " brings the drawn triangles above the limit of " +
                                             std::to_string(document_.config.limits.max_triangles) +
                                             "; simplify the scene or raise max_triangles");
        Instance instance;
        instance.name = nodes_[i].name;
        instance.mesh = mesh;
        instance.world_from_mesh = world;
        scene_.instances.push_back(std::move(instance));
    }

    void add_camera(std::size_t i, tinygltf::Camera const& in) {
        Camera out;
        out.name = in.name.empty() ? nodes_[i].name : in.name;
        place(out, camera_placed_by(world_[i]));
        bool usable = false;
        if (in.type == "orthographic") {
            out.kind = CameraKind::orthographic;
            out.half_width_m = in.orthographic.xmag;
            out.half_height_m = in.orthographic.ymag;
            out.near_m = in.orthographic.znear;
            out.far_m = in.orthographic.zfar;
            usable = out.half_width_m > 0.0 && out.half_height_m > 0.0;
        } else {
            out.fov_y_rad = in.perspective.yfov;
            out.near_m = in.perspective.znear;
            out.far_m = in.perspective.zfar > 0.0 ? in.perspective.zfar : std::numeric_limits<double>::infinity();
            usable = out.fov_y_rad > 0.0 && out.fov_y_rad < half_turn && out.near_m > 0.0;
        }
        if (usable && out.near_m < out.far_m)
            scene_.cameras.push_back(std::move(out));
        else
            document_.warn("Camera " + quoted(out.name) + " has an unusable lens and is left out.");
    }

    void add_light(std::size_t i, tinygltf::Light const& in) {
        Light out;
        out.name = in.name.empty() ? nodes_[i].name : in.name;
        if (in.type != "directional" && in.type != "point" && in.type != "spot")
            return document_.warn("Light " + quoted(out.name) + " is of the unknown kind " + quoted(in.type) + " and is left out.");
        out.kind = in.type == "directional" ? LightKind::directional
                   : in.type == "point"     ? LightKind::point
                                            : LightKind::spot;
        place(out, light_placed_by(world_[i]));
        for (std::size_t c = 0; c < in.color.size() && c < 3; ++c) out.color[static_cast<int>(c)] = rounded(in.color[c]);
        out.intensity = std::max(rounded(in.intensity), 0.0F);
        if (in.range > 0.0) out.range_m = rounded(in.range);
        if (out.kind == LightKind::spot) {
            out.outer_cone_rad = rounded(std::clamp(in.spot.outerConeAngle, 0.0, half_turn * 0.5));
            out.inner_cone_rad = std::clamp(rounded(in.spot.innerConeAngle), 0.0F, out.outer_cone_rad);
        }
        scene_.lights.push_back(std::move(out));
    }

    static float rounded(double value) noexcept {
        constexpr double largest = std::numeric_limits<float>::max();
        return static_cast<float>(std::clamp(value, -largest, largest));
    }

    Document& document_;
    std::vector<tinygltf::Node> const& nodes_;
    std::vector<std::uint32_t> const& mesh_of_;
    Scene& scene_;
    std::vector<std::uint32_t> parent_;
    std::vector<dmat4> world_;
    std::vector<bool> reached_;
    std::vector<std::uint64_t> mesh_triangles_;
    std::uint64_t triangles_ = 0;
};

}  // namespace

void load_nodes(Document& document, std::vector<std::uint32_t> const& mesh_of, Scene& scene) {
    NodeLoader(document, mesh_of, scene).run();
}

}  // namespace gnomon::scene::detail
