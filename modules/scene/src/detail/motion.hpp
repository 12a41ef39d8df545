#pragma once
// Things that move on loops: a node, its keys in the scene's one clip, and what hangs on it.

#include "turn.hpp"

#include <gnomon/scene/scene.hpp>

#include <cstdint>
#include <string>
#include <vector>

namespace gnomon::scene::detail {

/// Where a thing is at a time, turned about the vertical axis.
struct Waypoint {
    double time_s = 0.0;
    math::dvec3 at{0.0, 0.0, 0.0};
    double turns = 0.0;
};

/// The rotation by `turns` about the vertical axis.
inline math::dvec4 upright_rotation(double turns) noexcept {
    SinCos const half = sin_cos(turns * 0.5);
    return {0.0, half.sin, 0.0, half.cos};
}

/// Appends a channel to the scene's clip (made by the first call, called "loop").
inline AnimationChannel& add_channel(Scene& scene, std::uint32_t node, AnimationPath path) {
    if (scene.animations.empty()) scene.animations.push_back({"loop", {}});
    AnimationChannel channel;
    channel.node = node;
    channel.path = path;
    scene.animations.front().channels.push_back(std::move(channel));
    return scene.animations.front().channels.back();
}

inline void add_key(AnimationChannel& channel, double time_s, std::initializer_list<double> values) {
    channel.times_s.push_back(static_cast<float>(time_s));
    for (double const value : values) channel.values.push_back(static_cast<float>(value));
}

/// A node that goes by straight lines through `stops`, the last of which is where and how the first was.
///
/// expects: at least two stops, times rising from 0; neighbouring turns less than half a turn apart.
inline std::uint32_t add_mover(Scene& scene, std::string name, std::vector<Waypoint> const& stops) {
    auto const id = static_cast<std::uint32_t>(scene.nodes.size());
    Node node;
    node.name = std::move(name);
    node.translation = math::to_double(math::to_float(stops.front().at));
    node.rotation = math::dvec4(math::vec4(upright_rotation(stops.front().turns)));
    scene.nodes.push_back(std::move(node));
    AnimationChannel& moves = add_channel(scene, id, AnimationPath::translation);
    for (Waypoint const& stop : stops) add_key(moves, stop.time_s, {stop.at.x, stop.at.y, stop.at.z});
    AnimationChannel& turns = add_channel(scene, id, AnimationPath::rotation);
    for (Waypoint const& stop : stops) {
        math::dvec4 const q = upright_rotation(stop.turns);
        add_key(turns, stop.time_s, {q.x, q.y, q.z, q.w});
    }
    return id;
}

/// Puts a mesh onto a node.
inline void hang(Scene& scene, std::string name, std::uint32_t mesh, std::uint32_t node,
                 math::dmat4 const& node_from_mesh = math::dmat4(1.0)) {
    Instance instance;
    instance.name = std::move(name);
    instance.mesh = mesh;
    instance.node = node;
    instance.node_from_mesh = node_from_mesh;
    scene.instances.push_back(std::move(instance));
}

}  // namespace gnomon::scene::detail
