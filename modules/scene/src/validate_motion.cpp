#include "detail/validate_motion.hpp"

#include "detail/transforms.hpp"

#include <algorithm>
#include <cstddef>

namespace gnomon::scene::detail {

namespace {

using core::Done;

class MotionValidator {
public:
    explicit MotionValidator(Scene const& scene) : scene_(scene) {}

    Result<Done> run() {
        for (std::size_t i = 0; i < scene_.nodes.size(); ++i) check_node(i);
        for (std::size_t i = 0; i < scene_.skins.size(); ++i) check_skin(i);
        for (std::size_t i = 0; i < scene_.meshes.size(); ++i) check_mesh(i);
        for (std::size_t i = 0; i < scene_.instances.size(); ++i) check_instance(i);
        for (std::size_t i = 0; i < scene_.cameras.size(); ++i)
            check_carrier("camera", i, scene_.cameras[i].node, scene_.cameras[i].node_from_camera);
        for (std::size_t i = 0; i < scene_.lights.size(); ++i)
            check_carrier("light", i, scene_.lights[i].node, scene_.lights[i].node_from_light);
        for (std::size_t a = 0; a < scene_.animations.size(); ++a)
            for (std::size_t c = 0; c < scene_.animations[a].channels.size(); ++c)
                check_channel(scene_.animations[a].channels[c], nth("animation", a) + ", " + nth("channel", c));
        if (broken_.empty()) return Done{};
        return core::Failure{SceneError::malformed, broken_};
    }

private:
    static std::string nth(char const* what, std::size_t i) { return std::string(what) + " " + std::to_string(i); }

    /// Keeps the first sentence.
    void expect(bool holds, std::string const& where, char const* rule) {
        if (!holds && broken_.empty()) broken_ = where + " " + rule;
    }

    template <class T>
    static bool finite(std::vector<T> const& values) {
        for (T const& v : values)
            if (!math::is_finite(v)) return false;
        return true;
    }

    void check_node(std::size_t i) {
        Node const& n = scene_.nodes[i];
        expect(n.parent == none || n.parent < i, nth("node", i), "has a parent that does not come before it; order them so");
        bool const turns = math::is_finite(n.rotation.x) && math::is_finite(n.rotation.y) && math::is_finite(n.rotation.z) &&
                           math::is_finite(n.rotation.w);
        bool const sane = math::is_finite(n.translation) && math::is_finite(n.scale) && turns && (!n.matrix || all_finite(*n.matrix));
        expect(sane, nth("node", i), "has a NaN or an infinity in its transform; give finite numbers");
    }

    void check_skin(std::size_t i) {
        Skin const& skin = scene_.skins[i];
        expect(!skin.joints.empty(), nth("skin", i), "has no joints; give it one at least");
        expect(skin.joints.size() == skin.inverse_bind.size(), nth("skin", i), "has not one inverse bind matrix per joint; give it that");
        for (std::uint32_t joint : skin.joints)
            expect(joint < scene_.nodes.size(), nth("skin", i), "names a joint that is no node; give one that exists");
        for (math::mat4 const& m : skin.inverse_bind)
            for (math::axis_t column = 0; column < 4; ++column)
                for (math::axis_t row = 0; row < 4; ++row)
                    expect(math::is_finite(m[column][row]) && (row != 3 || m[column][row] == (column == 3 ? 1.0F : 0.0F)),
                           nth("skin", i), "has an inverse bind matrix that is not finite or not affine; mend it");
    }

    void check_mesh(std::size_t i) {
        Mesh const& mesh = scene_.meshes[i];
        std::size_t const targets = count_morph_targets(mesh);
        expect(mesh.weights.empty() || mesh.weights.size() == targets, nth("mesh", i), "has not one weight per morph target; give it that or none");
        expect(finite(mesh.weights), nth("mesh", i), "has a morph weight that is not finite; mend it");
        joints_of_.push_back(0);
        for (std::size_t p = 0; p < mesh.primitives.size(); ++p) {
            for (std::uint16_t const joint : mesh.primitives[p].joints) joints_of_.back() = std::max(joints_of_.back(), std::size_t{joint} + 1);
            std::string const where = nth("mesh", i) + ", " + nth("primitive", p);
            expect(mesh.primitives[p].morph_targets.size() == targets, where, "has other morph targets than the first; give all as many");
            check_targets(mesh.primitives[p], where);
            check_influences(mesh.primitives[p], where);
        }
    }

    void check_targets(Primitive const& p, std::string const& where) {
        for (MorphTarget const& target : p.morph_targets) {
            bool const whole = (target.positions.empty() || target.positions.size() == p.positions.size()) &&
                               (target.normals.empty() || target.normals.size() == p.positions.size());
            expect(whole, where, "has a morph target of another length; give one offset per position or none");
            expect(finite(target.positions) && finite(target.normals), where, "has a morph target that is not finite; mend it");
        }
    }

    void check_influences(Primitive const& p, std::string const& where) {
        expect(p.influences == 0 || p.influences == 4 || p.influences == 8, where, "has not 0, 4 or 8 joints per position; pad them with weights of 0");
        std::size_t const expected = p.positions.size() * p.influences;
        bool const whole = p.joints.size() == expected && p.joint_weights.size() == expected;
        expect(whole, where, "has not as many joints and weights as its positions need; give all");
        if (!whole || p.influences == 0) return;
        for (std::size_t v = 0; v < p.positions.size(); ++v) {
            double sum = 0.0;
            bool sane = true;
            for (std::size_t k = v * p.influences; k < (v + 1) * p.influences; ++k) {
                sane = sane && p.joint_weights[k] >= 0.0F;
                sum += static_cast<double>(p.joint_weights[k]);
            }
            expect(sane && std::abs(sum - 1.0) < 1e-3, where, "has joint weights that are negative or do not sum to 1; scale them");
        }
    }

    void check_instance(std::size_t i) {
        Instance const& instance = scene_.instances[i];
        check_carrier("instance", i, instance.node, instance.node_from_mesh);
        Mesh const& mesh = scene_.meshes[instance.mesh];
        expect(instance.weights.empty() || instance.weights.size() == count_morph_targets(mesh), nth("instance", i),
               "has not one weight per morph target; give it that or none");
        expect(finite(instance.weights), nth("instance", i), "has a morph weight that is not finite; mend it");
        if (instance.skin == none) return;
        expect(instance.skin < scene_.skins.size(), nth("instance", i), "names a skin that does not exist; give one that does");
        if (instance.skin >= scene_.skins.size()) return;
        expect(joints_of_[instance.mesh] <= scene_.skins[instance.skin].joints.size(), nth("instance", i),
               "has a mesh that names a joint beyond its skin's; give one that exists");
    }

    void check_carrier(char const* what, std::size_t i, std::uint32_t node, math::dmat4 const& node_from_it) {
        expect(node == none || node < scene_.nodes.size(), nth(what, i), "names a node that does not exist; give one that does");
        expect(all_finite(node_from_it), nth(what, i), "has a NaN or an infinity in its place on its node; give finite numbers");
    }

    void check_channel(AnimationChannel const& channel, std::string const& where) {
        std::size_t width = components_of(channel.path);
        bool const moves_node = channel.path != AnimationPath::weights;
        bool const exists = moves_node ? channel.node < scene_.nodes.size() : channel.instance < scene_.instances.size();
        expect(exists, where, "moves nothing that exists; name a node, or for weights an instance");
        if (!exists) return;
        if (moves_node) expect(!scene_.nodes[channel.node].matrix, where, "moves a node that has a matrix; give that its translation, rotation and scale");
        if (!moves_node) width = count_morph_targets(scene_.meshes[scene_.instances[channel.instance].mesh]);
        expect(width != 0, where, "moves the weights of a mesh without morph targets; leave it out");
        std::size_t const rows = channel.times_s.size() * (channel.interpolation == Interpolation::cubic_spline ? 3U : 1U);
        expect(!channel.times_s.empty() && channel.values.size() == rows * width, where, "has not the values that its keys need; give all");
        expect(finite(channel.times_s) && finite(channel.values), where, "has a NaN or an infinity; leave that key out");
        for (std::size_t k = 0; k < channel.times_s.size(); ++k)
            expect(channel.times_s[k] >= (k == 0 ? 0.0F : channel.times_s[k - 1]), where, "has key times that fall or are negative; sort them");
    }

    Scene const& scene_;
    std::string broken_;
    std::vector<std::size_t> joints_of_;  ///< Per mesh, the joints that its skins must have.
};

}  // namespace

Result<core::Done> validate_motion(Scene const& scene) { return MotionValidator(scene).run(); }

}  // namespace gnomon::scene::detail
