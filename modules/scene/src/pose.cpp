#include <gnomon/scene/pose.hpp>

#include "detail/arcs.hpp"
#include "detail/transforms.hpp"

#include <gnomon/core/contract.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

namespace gnomon::scene {

namespace {

using math::dmat4;
using math::dvec3;
using math::dvec4;

/// Between which keys a time lies, and how far.
struct Place {
    std::size_t key = 0;
    double part = 0.0;    ///< 0 at the key, below 1; 0 before the first key and after the last.
    double length_s = 0.0;  ///< From the key to the next; 0 where the time is not between two.
};

Place find_place(std::vector<float> const& times_s, double time_s) noexcept {
    auto const after = std::upper_bound(times_s.begin(), times_s.end(), time_s,
                                        [](double t, float key) { return t < static_cast<double>(key); });
    if (after == times_s.begin()) return {};
    auto const key = static_cast<std::size_t>(after - times_s.begin()) - 1;
    if (after == times_s.end()) return {key, 0.0, 0.0};
    double const begin = static_cast<double>(times_s[key]);
    double const length = static_cast<double>(*after) - begin;
    return {key, (time_s - begin) / length, length};
}

/// Component `c` of a channel of `width` components at `place`, rotations' linear interpolation excepted.
double component_at(AnimationChannel const& channel, Place const& place, std::size_t width, std::size_t c) noexcept {
    auto const value = [&](std::size_t row) { return static_cast<double>(channel.values[row * width + c]); };
    if (channel.interpolation == Interpolation::cubic_spline) {
        double const here = value(place.key * 3 + 1);
        if (place.length_s == 0.0) return here;
        double const t = place.part;
        double const t2 = t * t;
        double const t3 = t2 * t;
        double const out_tangent = value(place.key * 3 + 2) * place.length_s;
        double const in_tangent = value(place.key * 3 + 3) * place.length_s;
        double const there = value(place.key * 3 + 4);
        return (((2.0 * t3 - 3.0 * t2) + 1.0) * here + ((t3 - 2.0 * t2) + t) * out_tangent) +
               ((3.0 * t2 - 2.0 * t3) * there + (t3 - t2) * in_tangent);
    }
    double const here = value(place.key);
    if (channel.interpolation == Interpolation::step || place.length_s == 0.0) return here;
    return here * (1.0 - place.part) + value(place.key + 1) * place.part;
}

dvec4 rotation_at(AnimationChannel const& channel, Place const& place) noexcept {
    if (channel.interpolation == Interpolation::linear && place.length_s != 0.0) {
        auto const key = [&](std::size_t k) {
            dvec4 q;
            for (std::size_t c = 0; c < 4; ++c)
                q[static_cast<math::axis_t>(c)] = static_cast<double>(channel.values[k * 4 + c]);
            return detail::unit_rotation(q);
        };
        return detail::slerp(key(place.key), key(place.key + 1), place.part);
    }
    dvec4 q;
    for (std::size_t c = 0; c < 4; ++c) q[static_cast<math::axis_t>(c)] = component_at(channel, place, 4, c);
    return detail::unit_rotation(q);
}

class Poser {
public:
    Poser(Scene const& scene, Pose& pose) : scene_(scene), pose_(pose) {}

    void run(PoseConfig const& config) {
        pose_.time_s = time_in_clip(scene_, config);
        rest();
        for (std::uint32_t i = 0; i < scene_.animations.size(); ++i)
            if (config.clip == i || config.clip == all_clips)
                for (AnimationChannel const& channel : scene_.animations[i].channels) play(channel);
        place_nodes();
        place_instances();
        place_joints();
        place_cameras_and_lights();
    }

private:
    void rest() {
        pose_.parent_from_node.resize(scene_.nodes.size());
        for (std::size_t i = 0; i < scene_.nodes.size(); ++i)
            pose_.parent_from_node[i] = {scene_.nodes[i].translation, scene_.nodes[i].rotation, scene_.nodes[i].scale};
        pose_.morph_weights.clear();
        pose_.first_morph_weight.clear();
        for (Instance const& instance : scene_.instances) {
            pose_.first_morph_weight.push_back(static_cast<std::uint32_t>(pose_.morph_weights.size()));
            Mesh const& mesh = scene_.meshes[instance.mesh];
            std::vector<float> const& weights = instance.weights.empty() ? mesh.weights : instance.weights;
            for (std::uint32_t t = 0; t < count_morph_targets(mesh); ++t)
                pose_.morph_weights.push_back(t < weights.size() ? static_cast<double>(weights[t]) : 0.0);
        }
        pose_.first_morph_weight.push_back(static_cast<std::uint32_t>(pose_.morph_weights.size()));
    }

    void play(AnimationChannel const& channel) {
        Place const place = find_place(channel.times_s, pose_.time_s);
        if (channel.path == AnimationPath::weights) {
            std::uint32_t const first = pose_.first_morph_weight[channel.instance];
            std::uint32_t const count = pose_.first_morph_weight[channel.instance + 1] - first;
            for (std::uint32_t c = 0; c < count; ++c)
                pose_.morph_weights[first + c] = component_at(channel, place, count, c);
            return;
        }
        NodeTransform& node = pose_.parent_from_node[channel.node];
        if (channel.path == AnimationPath::rotation) {
            node.rotation = rotation_at(channel, place);
            return;
        }
        dvec3& target = channel.path == AnimationPath::translation ? node.translation : node.scale;
        for (std::size_t c = 0; c < 3; ++c) target[static_cast<math::axis_t>(c)] = component_at(channel, place, 3, c);
    }

    void place_nodes() {
        pose_.world_from_node.resize(scene_.nodes.size());
        for (std::size_t i = 0; i < scene_.nodes.size(); ++i) {
            Node const& node = scene_.nodes[i];
            dmat4 const local = node.matrix ? *node.matrix : detail::from_trs(pose_.parent_from_node[i]);
            pose_.world_from_node[i] =
                node.parent == none ? local : detail::multiplied(pose_.world_from_node[node.parent], local);
        }
    }

    void place_instances() {
        pose_.world_from_mesh.resize(scene_.instances.size());
        for (std::size_t i = 0; i < scene_.instances.size(); ++i) {
            Instance const& instance = scene_.instances[i];
            pose_.world_from_mesh[i] = instance.node == none ? instance.world_from_mesh
                                                             : carried(instance.node, instance.node_from_mesh);
        }
    }

    void place_joints() {
        pose_.first_joint.clear();
        pose_.world_from_bind.clear();
        for (Skin const& skin : scene_.skins) {
            pose_.first_joint.push_back(static_cast<std::uint32_t>(pose_.world_from_bind.size()));
            for (std::size_t j = 0; j < skin.joints.size(); ++j) {
                dmat4 bind(1.0);
                for (math::axis_t column = 0; column < 4; ++column)
                    for (math::axis_t row = 0; row < 3; ++row)
                        bind[column][row] = static_cast<double>(skin.inverse_bind[j][column][row]);
                pose_.world_from_bind.push_back(carried(skin.joints[j], bind));
            }
        }
        pose_.first_joint.push_back(static_cast<std::uint32_t>(pose_.world_from_bind.size()));
    }

    void place_cameras_and_lights() {
        pose_.cameras.resize(scene_.cameras.size());
        for (std::size_t i = 0; i < scene_.cameras.size(); ++i) {
            Camera const& camera = scene_.cameras[i];
            pose_.cameras[i] = {camera.eye_m, camera.right, camera.up, camera.back};
            if (camera.node == none) continue;
            dmat4 const world = carried(camera.node, camera.node_from_camera);
            if (detail::all_finite(world)) pose_.cameras[i] = detail::camera_placed_by(world);
        }
        pose_.lights.resize(scene_.lights.size());
        for (std::size_t i = 0; i < scene_.lights.size(); ++i) {
            Light const& light = scene_.lights[i];
            pose_.lights[i] = {light.position_m, light.direction};
            if (light.node == none) continue;
            dmat4 const world = carried(light.node, light.node_from_light);
            if (detail::all_finite(world)) pose_.lights[i] = detail::light_placed_by(world);
        }
    }

    [[nodiscard]] dmat4 carried(std::uint32_t node, dmat4 const& node_from_it) const noexcept {
        return detail::multiplied(pose_.world_from_node[node], node_from_it);
    }

    Scene const& scene_;
    Pose& pose_;
};

}  // namespace

double duration_s(Animation const& animation) noexcept {
    double end = 0.0;
    for (AnimationChannel const& channel : animation.channels)
        if (!channel.times_s.empty()) end = std::max(end, static_cast<double>(channel.times_s.back()));
    return end;
}

double time_in_clip(Scene const& scene, PoseConfig const& config) noexcept {
    double end = 0.0;
    for (std::uint32_t i = 0; i < scene.animations.size(); ++i)
        if (config.clip == i || config.clip == all_clips) end = std::max(end, duration_s(scene.animations[i]));
    if (!math::is_finite(config.time_s) || end == 0.0) return 0.0;
    if (!config.loop) return std::clamp(config.time_s, 0.0, end);
    double const rest = std::fmod(config.time_s, end);
    double const wrapped = rest < 0.0 ? rest + end : rest;
    return wrapped < end ? wrapped + 0.0 : 0.0;
}

void pose_at(Scene const& scene, PoseConfig const& config, Pose& pose) { Poser(scene, pose).run(config); }

Pose pose_at(Scene const& scene, PoseConfig const& config) {
    Pose pose;
    pose_at(scene, config, pose);
    return pose;
}

Pose rest_pose(Scene const& scene) { return pose_at(scene, {0.0, none, true}); }

std::uint32_t find_clip(Scene const& scene, std::string_view name) noexcept {
    for (std::uint32_t i = 0; i < scene.animations.size(); ++i)
        if (scene.animations[i].name == name) return i;
    return none;
}

Camera posed_camera(Scene const& scene, Pose const& pose, std::uint32_t camera) {
    GNOMON_EXPECT(camera < scene.cameras.size() && pose.cameras.size() == scene.cameras.size());
    Camera out = scene.cameras[camera];
    detail::place(out, pose.cameras[camera]);
    return out;
}

Light posed_light(Scene const& scene, Pose const& pose, std::uint32_t light) {
    GNOMON_EXPECT(light < scene.lights.size() && pose.lights.size() == scene.lights.size());
    Light out = scene.lights[light];
    detail::place(out, pose.lights[light]);
    return out;
}

void settle(Scene& scene) {
    Pose const pose = rest_pose(scene);
    for (std::size_t i = 0; i < scene.instances.size(); ++i) scene.instances[i].world_from_mesh = pose.world_from_mesh[i];
    for (std::size_t i = 0; i < scene.cameras.size(); ++i) detail::place(scene.cameras[i], pose.cameras[i]);
    for (std::size_t i = 0; i < scene.lights.size(); ++i) detail::place(scene.lights[i], pose.lights[i]);
}

}  // namespace gnomon::scene
