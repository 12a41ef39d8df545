#include "detail/gltf_motion.hpp"

#include "detail/gltf_accessor.hpp"

#include <gnomon/math/scalar.hpp>

#include <algorithm>
#include <limits>
#include <optional>

namespace gnomon::scene::detail {

namespace {

constexpr double weight_tolerance = 1e-3;

float to_float_range(double value) noexcept {
    constexpr double largest = std::numeric_limits<float>::max();
    return static_cast<float>(std::clamp(value, -largest, largest));
}

[[noreturn]] void bad(std::string const& where, std::string const& what) {
    fail(SceneError::malformed, where + " " + what + "; export the file again");
}

/// An attribute of a primitive's vertices: an accessor as long as the positions.
std::optional<Accessor> find_attribute(VertexSource const& source, std::map<std::string, int> const& attributes,
                                       std::string const& name, int components) {
    auto const found = attributes.find(name);
    if (found == attributes.end()) return std::nullopt;
    Accessor a = make_accessor(source.document, found->second);
    if (a.components != components)
        bad(source.where, "has " + name + " of " + std::to_string(a.components) + " components where glTF wants " + std::to_string(components));
    if (a.count != source.count)
        bad(source.where, "has " + std::to_string(source.count) + " positions and " + std::to_string(a.count) + " of " + name);
    return a;
}

bool is_unsigned(int component_type) noexcept {
    return component_type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE || component_type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT ||
           component_type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT;
}

/// Puts the weights of one vertex in order: none negative or NaN, their sum 1, and joint 0 where a weight is 0.
///
/// returns: whether something had to be mended.
bool mend_weights(std::span<std::uint16_t> joints, std::span<float> weights) noexcept {
    bool mended = false;
    double sum = 0.0;
    for (float& w : weights) {
        if (!(w >= 0.0F) || !math::is_finite(w)) {
            w = 0.0F;
            mended = true;
        }
        sum += static_cast<double>(w);
    }
    if (sum == 0.0) {
        weights[0] = 1.0F;
        mended = true;
    } else if (std::abs(sum - 1.0) > weight_tolerance) {
        for (float& w : weights) w = static_cast<float>(static_cast<double>(w) / sum);
        mended = true;
    }
    for (std::size_t k = 0; k < weights.size(); ++k)
        if (weights[k] == 0.0F) joints[k] = 0;
    return mended;
}

std::vector<math::vec3> read_offsets(VertexSource const& source, Accessor const& a) {
    source.document.charge_elements(source.chosen.size());
    std::vector<math::vec3> out;
    out.reserve(source.chosen.size());
    for (std::uint32_t v : source.chosen) {
        math::vec3 offset(a.at(v, 0), a.at(v, 1), a.at(v, 2));
        if (!math::is_finite(offset)) {
            ++source.document.notes.mended_offsets;
            offset = math::vec3(0.0F);
        }
        out.push_back(offset);
    }
    return out;
}

std::optional<AnimationPath> path_of(std::string const& name) {
    if (name == "translation") return AnimationPath::translation;
    if (name == "rotation") return AnimationPath::rotation;
    if (name == "scale") return AnimationPath::scale;
    if (name == "weights") return AnimationPath::weights;
    return std::nullopt;
}

std::optional<Interpolation> interpolation_of(std::string const& name) {
    if (name == "STEP") return Interpolation::step;
    if (name == "LINEAR") return Interpolation::linear;
    if (name == "CUBICSPLINE") return Interpolation::cubic_spline;
    return std::nullopt;
}

class AnimationLoader {
public:
    AnimationLoader(Document& document, NodeMap const& map, Scene& scene) : document_(document), map_(map), scene_(scene) {}

    void run() {
        auto const& animations = document_.model.animations;
        for (std::size_t a = 0; a < animations.size(); ++a) {
            animation_ = {animations[a].name, {}};
            for (std::size_t c = 0; c < animations[a].channels.size(); ++c)
                add(animations[a], animations[a].channels[c], item("animation", a) + ", " + item("channel", c));
            if (!animation_.channels.empty()) scene_.animations.push_back(std::move(animation_));
        }
    }

private:
    void drop() { ++document_.notes.dropped_channels; }

    void add(tinygltf::Animation const& animation, tinygltf::AnimationChannel const& in, std::string const& where) {
        if (in.sampler < 0 || static_cast<std::size_t>(in.sampler) >= animation.samplers.size())
            bad(where, "names sampler " + std::to_string(in.sampler) + " and there are only " + std::to_string(animation.samplers.size()));
        if (in.target_node < 0) return drop();
        auto const node = static_cast<std::size_t>(in.target_node);
        if (node >= map_.node_of.size())
            bad(where, "names node " + std::to_string(node) + " and there are only " + std::to_string(map_.node_of.size()));
        tinygltf::AnimationSampler const& sampler = animation.samplers[static_cast<std::size_t>(in.sampler)];
        auto const path = path_of(in.target_path);
        auto const interpolation = interpolation_of(sampler.interpolation);
        if (!path || !interpolation) return drop();
        AnimationChannel channel;
        channel.path = *path;
        channel.interpolation = *interpolation;
        if (*path == AnimationPath::weights) return add_weights(std::move(channel), sampler, node, where);
        if (map_.node_of[node] == none || !moves_a_node(document_, in)) return drop();
        channel.node = map_.node_of[node];
        if (read_keys(channel, sampler, components_of(*path), where)) animation_.channels.push_back(std::move(channel));
    }

    /// One channel for each instance that the node became.
    void add_weights(AnimationChannel channel, tinygltf::AnimationSampler const& sampler, std::size_t node, std::string const& where) {
        std::uint32_t const first = map_.first_instance[node];
        std::uint32_t const end = map_.first_instance[node + 1];
        std::uint32_t const targets = first == end ? 0 : count_morph_targets(scene_.meshes[scene_.instances[first].mesh]);
        if (targets == 0 || !read_keys(channel, sampler, targets, where)) return targets == 0 ? drop() : void();
        for (std::uint32_t i = first; i < end; ++i) {
            if (i != first) document_.charge_motion(channel.times_s.size() + channel.values.size());
            channel.instance = i;
            animation_.channels.push_back(channel);
        }
    }

    /// returns: whether the keys make sense. Those that do not are counted.
    bool read_keys(AnimationChannel& channel, tinygltf::AnimationSampler const& sampler, std::size_t width, std::string const& where) {
        Accessor const times = make_accessor(document_, sampler.input);
        Accessor const values = make_accessor(document_, sampler.output);
        bool const weights = channel.path == AnimationPath::weights;
        std::size_t const rows = channel.interpolation == Interpolation::cubic_spline ? 3 : 1;
        std::size_t const per_key = rows * (weights ? width : 1);
        if (times.components != 1 || times.component_type != TINYGLTF_COMPONENT_TYPE_FLOAT || times.count == 0)
            bad(where, "has key times that are not a list of floats");
        if (static_cast<std::size_t>(values.components) != (weights ? 1 : width))
            bad(where, "has values of " + std::to_string(values.components) + " components where its path wants " + std::to_string(weights ? 1 : width));
        if (values.count / per_key != times.count || values.count % per_key != 0)
            bad(where, "has " + std::to_string(times.count) + " keys and " + std::to_string(values.count) + " values, " +
                           std::to_string(per_key) + " wanted for each");
        document_.charge_motion(times.count + values.count * static_cast<std::size_t>(values.components));
        channel.times_s.reserve(times.count);
        channel.values.reserve(values.count * static_cast<std::size_t>(values.components));
        bool sane = true;
        for (std::size_t k = 0; k < times.count; ++k) {
            float const t = times.at(k, 0);
            sane = sane && math::is_finite(t) && t >= (k == 0 ? 0.0F : channel.times_s.back());
            channel.times_s.push_back(t);
        }
        for (std::size_t k = 0; k < values.count; ++k)
            for (int c = 0; c < values.components; ++c) {
                channel.values.push_back(values.at(k, c));
                sane = sane && math::is_finite(channel.values.back());
            }
        if (!sane) drop();
        return sane;
    }

    Document& document_;
    NodeMap const& map_;
    Scene& scene_;
    Animation animation_;
};

}  // namespace

void read_influences(VertexSource const& source, Primitive& out) {
    std::vector<Accessor> joints;
    std::vector<Accessor> weights;
    for (int set = 0; set < 2; ++set) {
        auto j = find_attribute(source, source.in.attributes, "JOINTS_" + std::to_string(set), 4);
        auto w = find_attribute(source, source.in.attributes, "WEIGHTS_" + std::to_string(set), 4);
        if (!j && !w) break;
        if (!j || !w) bad(source.where, "has joints without weights or weights without joints");
        if (!is_unsigned(j->component_type)) bad(source.where, "has joints of component type " + std::to_string(j->component_type));
        joints.push_back(std::move(*j));
        weights.push_back(std::move(*w));
    }
    if (source.in.attributes.count("JOINTS_2") != 0)
        source.document.warn(source.where + " has more than 8 joints per vertex; the 8 of its first two sets are used.");
    if (joints.empty()) return;
    out.influences = static_cast<std::uint32_t>(joints.size() * 4);
    source.document.charge_elements(source.chosen.size() * joints.size());
    for (std::uint32_t v : source.chosen) {
        for (std::size_t k = 0; k < out.influences; ++k) {
            auto const component = static_cast<int>(k % 4);
            std::uint32_t const joint = joints[k / 4].whole_at(v, component);
            out.joint_weights.push_back(weights[k / 4].at(v, component));
            if (joint > 0xFFFFU && out.joint_weights.back() != 0.0F) bad(source.where, "names joint " + std::to_string(joint));
            out.joints.push_back(static_cast<std::uint16_t>(joint & 0xFFFFU));
        }
        std::size_t const first = out.joints.size() - out.influences;
        if (mend_weights(std::span(out.joints).subspan(first), std::span(out.joint_weights).subspan(first)))
            ++source.document.notes.mended_weights;
    }
}

void read_morph_targets(VertexSource const& source, Primitive& out) {
    source.document.charge_motion(source.in.targets.size());
    out.morph_targets.reserve(source.in.targets.size());
    for (auto const& attributes : source.in.targets) {
        MorphTarget& target = out.morph_targets.emplace_back();
        if (auto const a = find_attribute(source, attributes, "POSITION", 3)) target.positions = read_offsets(source, *a);
        if (auto const a = find_attribute(source, attributes, "NORMAL", 3)) target.normals = read_offsets(source, *a);
    }
}

std::vector<float> read_default_weights(Document& document, std::vector<double> const& in, std::size_t count,
                                        std::string const& where) {
    if (in.empty() || count == 0) return {};
    if (in.size() != count)
        document.warn(where + " has " + std::to_string(in.size()) + " weights for " + std::to_string(count) +
                      " morph targets; those that are missing are 0, those beyond are left out.");
    document.charge_motion(count);
    std::vector<float> out(count, 0.0F);
    for (std::size_t i = 0; i < std::min(count, in.size()); ++i) out[i] = to_float_range(in[i]);
    return out;
}

bool moves_a_node(Document const& document, tinygltf::AnimationChannel const& channel) {
    auto const path = path_of(channel.target_path);
    auto const node = static_cast<std::size_t>(channel.target_node);
    return path && *path != AnimationPath::weights && channel.target_node >= 0 && node < document.model.nodes.size() &&
           document.model.nodes[node].matrix.empty();
}

void load_skins(Document& document, NodeMap const& map, Scene& scene) {
    for (std::size_t s = 0; s < document.model.skins.size(); ++s) {
        if (map.skin_of[s] == none) continue;
        tinygltf::Skin const& in = document.model.skins[s];
        Skin& skin = scene.skins[map.skin_of[s]];
        skin.name = in.name;
        if (in.joints.empty()) bad(item("skin", s), "has no joints");
        document.charge_motion(in.joints.size() * 16);
        for (int joint : in.joints) skin.joints.push_back(map.node_of[static_cast<std::size_t>(joint)]);
        skin.inverse_bind.assign(in.joints.size(), math::mat4(1.0F));
        if (in.inverseBindMatrices < 0) continue;
        Accessor const matrices = make_accessor(document, in.inverseBindMatrices);
        if (matrices.components != 16 || matrices.component_type != TINYGLTF_COMPONENT_TYPE_FLOAT || matrices.count < in.joints.size())
            bad(item("skin", s), "has " + std::to_string(in.joints.size()) + " joints and not as many inverse bind matrices of floats");
        for (std::size_t j = 0; j < in.joints.size(); ++j)
            for (int k = 0; k < 16; ++k) {
                if (k % 4 == 3) continue;
                float const number = matrices.at(j, k);
                if (!math::is_finite(number)) bad(item("skin", s), "has a NaN or an infinity in inverse bind matrix " + std::to_string(j));
                skin.inverse_bind[j][k / 4][k % 4] = number;
            }
    }
}

void check_joints(Scene const& scene) {
    // A mesh that many instances share is looked at once for each skin, the smallest that bends it deciding.
    std::vector<std::uint32_t> fewest(scene.meshes.size(), none);
    for (Instance const& instance : scene.instances)
        if (instance.skin != none)
            fewest[instance.mesh] = std::min(fewest[instance.mesh], static_cast<std::uint32_t>(scene.skins[instance.skin].joints.size()));
    for (std::size_t m = 0; m < scene.meshes.size(); ++m)
        for (Primitive const& p : scene.meshes[m].primitives)
            for (std::uint16_t const joint : p.joints)
                if (joint >= fewest[m])
                    bad("mesh " + quoted(scene.meshes[m].name), "names joint " + std::to_string(joint) + " and its skin has only " + std::to_string(fewest[m]));
}

void load_animations(Document& document, NodeMap const& map, Scene& scene) { AnimationLoader(document, map, scene).run(); }

}  // namespace gnomon::scene::detail
