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

    NodeMap run() {
        find_parents();
        place_all();
        mark_reached();
        map_.skin_of.assign(document_.model.skins.size(), none);
        map_.node_of.assign(nodes_.size(), none);
        mark_needed();
        keep_needed();
        find_carriers();
        for (std::size_t i = 0; i < nodes_.size(); ++i) {
            map_.first_instance.push_back(static_cast<std::uint32_t>(scene_.instances.size()));
            if (reached_[i]) add(i);
        }
        map_.first_instance.push_back(static_cast<std::uint32_t>(scene_.instances.size()));
        return std::move(map_);
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

    [[nodiscard]] dmat4 local(std::size_t i) const { return local_of(without_name(i)); }

    [[nodiscard]] Node without_name(std::size_t i) const {
        tinygltf::Node const& n = nodes_[i];
        Node out;
        if (!n.matrix.empty()) {
            if (n.matrix.size() != 16) bad_node(i, "has a matrix of " + std::to_string(n.matrix.size()) + " numbers");
            dmat4 m(1.0);
            for (int k = 0; k < 16; ++k)
                if (k % 4 != 3) m[k / 4][k % 4] = n.matrix[static_cast<std::size_t>(k)];
            out.matrix = m;
            return out;
        }
        auto const wrong = [](std::vector<double> const& v, std::size_t size) { return !v.empty() && v.size() != size; };
        if (wrong(n.translation, 3) || wrong(n.rotation, 4) || wrong(n.scale, 3))
            bad_node(i, "has a translation, rotation or scale of the wrong length");
        if (!n.translation.empty()) out.translation = dvec3(n.translation[0], n.translation[1], n.translation[2]);
        if (!n.rotation.empty()) out.rotation = dvec4(n.rotation[0], n.rotation[1], n.rotation[2], n.rotation[3]);
        if (!n.scale.empty()) out.scale = dvec3(n.scale[0], n.scale[1], n.scale[2]);
        return out;
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
            downward_.push_back(visit.node);
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
        for (tinygltf::Scene const& s : scenes) scene_.file_scenes.push_back(s.name);
        std::uint32_t wanted = document_.config.scene_name.empty() ? document_.config.scene_index : scene_named();
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

    [[nodiscard]] std::uint32_t scene_named() const {
        std::string const& name = document_.config.scene_name;
        auto const found = std::find(scene_.file_scenes.begin(), scene_.file_scenes.end(), name);
        if (found != scene_.file_scenes.end()) return static_cast<std::uint32_t>(found - scene_.file_scenes.begin());
        std::string list;
        for (std::size_t i = 0; i < scene_.file_scenes.size() && i < 4; ++i) list += (i == 0 ? "" : ", ") + quoted(scene_.file_scenes[i]);
        fail(SceneError::bad_config, "the scene " + quoted(name) + " is asked for and the file's " + std::to_string(scene_.file_scenes.size()) +
                                         " are " + (list.empty() ? "none" : list) + "; ask for one that exists");
    }

    /// A node whose place can change, or that says so itself: those written here keep the scene's own nodes that way.
    [[nodiscard]] bool is_kept(std::size_t i) const {
        tinygltf::Value const* const mark = member(nodes_[i].extras, "gnomon_node");
        return mark != nullptr && mark->IsBool() && mark->Get<bool>();
    }

    /// Nodes that clips move, joints of the skins in use, and all that those hang on.
    void mark_needed() {
        needed_.assign(nodes_.size(), false);
        moves_.assign(nodes_.size(), false);
        for (tinygltf::Animation const& animation : document_.model.animations)
            for (tinygltf::AnimationChannel const& channel : animation.channels)
                if (moves_a_node(document_, channel)) moves_[static_cast<std::size_t>(channel.target_node)] = true;
        for (std::size_t i = 0; i < nodes_.size(); ++i) {
            if (!reached_[i]) continue;
            if (is_kept(i)) need(i);
            if (nodes_[i].mesh >= 0 && nodes_[i].skin >= 0) use_skin(i);
        }
        for (std::size_t i = 0; i < nodes_.size(); ++i)
            if (moves_[i] && reached_[i]) need(i);
    }

    void need(std::size_t i) {
        for (auto n = static_cast<std::uint32_t>(i); n != none && !needed_[n]; n = parent_[n]) needed_[n] = true;
    }

    void use_skin(std::size_t i) {
        auto const s = static_cast<std::size_t>(nodes_[i].skin);
        if (s >= map_.skin_of.size())
            bad_node(i, "names skin " + std::to_string(s) + " and there are only " + std::to_string(map_.skin_of.size()));
        if (map_.skin_of[s] != none) return;
        map_.skin_of[s] = 0;  // in use; its place follows when all are known
        for (int const joint : document_.model.skins[s].joints) {
            if (joint < 0 || static_cast<std::size_t>(joint) >= nodes_.size())
                fail(SceneError::malformed, item("skin", s) + " names node " + std::to_string(joint) + " and there are only " +
                                                std::to_string(nodes_.size()) + "; export the file again");
            need(static_cast<std::size_t>(joint));
        }
    }

    /// The scene's nodes: those needed, in the file's order, but parents first.
    void keep_needed() {
        std::uint32_t skins = 0;
        for (std::uint32_t& skin : map_.skin_of)
            if (skin != none) skin = skins++;
        scene_.skins.resize(skins);
        std::vector<std::uint32_t> line;
        for (std::size_t i = 0; i < nodes_.size(); ++i) {
            line.clear();
            for (auto n = static_cast<std::uint32_t>(i); n != none && needed_[n] && map_.node_of[n] == none; n = parent_[n]) line.push_back(n);
            for (std::size_t k = line.size(); k-- > 0;) keep(line[k]);
        }
    }

    void keep(std::uint32_t n) {
        map_.node_of[n] = static_cast<std::uint32_t>(scene_.nodes.size());
        Node node = without_name(n);
        node.name = nodes_[n].name;
        if (parent_[n] != none) {
            node.parent = map_.node_of[parent_[n]];
            if (moves_[parent_[n]]) moves_[n] = true;
        }
        scene_.nodes.push_back(std::move(node));
    }

    /// For each node the kept one that carries what it holds, if that can move, and the way from there.
    void find_carriers() {
        if (scene_.nodes.empty()) return;
        carrier_.assign(nodes_.size(), none);
        carrier_from_.assign(nodes_.size(), dmat4(1.0));
        for (std::uint32_t const i : downward_) {
            if (needed_[i]) {
                carrier_[i] = moves_[i] || is_kept(i) ? i : none;
            } else if (parent_[i] != none && carrier_[parent_[i]] != none) {
                carrier_[i] = carrier_[parent_[i]];
                carrier_from_[i] = multiplied(carrier_from_[parent_[i]], local(i));
            }
        }
    }

    /// Where a thing hangs that stands at `own` in node i.
    struct Place {
        dmat4 world{1.0};
        std::uint32_t node = none;
        dmat4 from_node{1.0};
    };

    [[nodiscard]] Place place_in(std::size_t i, dmat4 const* own) const {
        Place place;
        if (carrier_.empty() || carrier_[i] == none) {
            place.world = own == nullptr ? world_[i] : multiplied(world_[i], *own);
        } else {
            place.node = map_.node_of[carrier_[i]];
            place.from_node = own == nullptr ? carrier_from_[i] : multiplied(carrier_from_[i], *own);
            place.world = multiplied(world_[carrier_[i]], place.from_node);
        }
        if (!all_finite(place.world) || !all_finite(place.from_node)) bad_node(i, "has something in it whose transform is not finite");
        return place;
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
        if (many == nullptr) return add_instance(i, mesh, place_in(i, nullptr));
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
            add_instance(i, mesh, place_in(i, &own));
        }
    }

    void add_instance(std::size_t i, std::uint32_t mesh, Place const& place) {
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
        instance.world_from_mesh = place.world;
        instance.node = place.node;
        instance.node_from_mesh = place.from_node;
        if (nodes_[i].skin >= 0) instance.skin = map_.skin_of[static_cast<std::size_t>(nodes_[i].skin)];
        std::uint32_t const targets = count_morph_targets(scene_.meshes[mesh]);
        document_.charge_motion(targets);
        instance.weights = read_default_weights(document_, nodes_[i].weights, targets, item("node", i));
        scene_.instances.push_back(std::move(instance));
    }

    void add_camera(std::size_t i, tinygltf::Camera const& in) {
        Camera out;
        out.name = in.name.empty() ? nodes_[i].name : in.name;
        Place const at = place_in(i, nullptr);
        place(out, camera_placed_by(at.world));
        out.node = at.node;
        out.node_from_camera = at.from_node;
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
        Place const at = place_in(i, nullptr);
        place(out, light_placed_by(at.world));
        out.node = at.node;
        out.node_from_light = at.from_node;
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
    std::vector<std::uint32_t> downward_;  ///< All nodes, parents first.
    std::vector<bool> reached_;
    std::vector<bool> needed_;
    std::vector<bool> moves_;
    std::vector<std::uint32_t> carrier_;  ///< Empty where no node is kept.
    std::vector<dmat4> carrier_from_;
    NodeMap map_;
    std::vector<std::uint64_t> mesh_triangles_;
    std::uint64_t triangles_ = 0;
};

}  // namespace

NodeMap load_nodes(Document& document, std::vector<std::uint32_t> const& mesh_of, Scene& scene) {
    return NodeLoader(document, mesh_of, scene).run();
}

}  // namespace gnomon::scene::detail
