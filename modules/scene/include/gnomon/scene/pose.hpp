#pragma once
// Where everything in a scene is at a time: nodes, instances, joints, cameras and lights, and how far morph targets are in.
//
// A pose is made anew each frame in the same memory, and `update` (flatten.hpp) moves the frame's triangles to it. Only
// + - * / and square roots are used, so a pose is the same on every machine.

#include <gnomon/math/vec.hpp>
#include <gnomon/scene/scene.hpp>

#include <cstdint>
#include <string_view>
#include <vector>

namespace gnomon::scene {

/// Instead of a clip: all of them at once, each at the same time; where two move the same thing, the later one does.
inline constexpr std::uint32_t all_clips = none - 1;

struct PoseConfig {
    double time_s = 0.0;     ///< Since the clip began. NaN and infinities are taken as 0.
    std::uint32_t clip = 0;  ///< Into `Scene::animations`, or `all_clips`. Where there is no such clip, the scene rests.
    bool loop = true;        ///< Over the clip's duration, and backwards for negative times. Off: the clip's ends stand still.
};

/// A node's own transform, at a time.
struct NodeTransform {
    math::dvec3 translation{0.0, 0.0, 0.0};
    math::dvec4 rotation{0.0, 0.0, 0.0, 1.0};
    math::dvec3 scale{1.0, 1.0, 1.0};

    friend bool operator==(NodeTransform const&, NodeTransform const&) = default;
};

struct CameraPose {
    math::dvec3 eye_m{0.0, 0.0, 0.0};
    math::dvec3 right{1.0, 0.0, 0.0};
    math::dvec3 up{0.0, 1.0, 0.0};
    math::dvec3 back{0.0, 0.0, 1.0};

    friend bool operator==(CameraPose const&, CameraPose const&) = default;
};

struct LightPose {
    math::dvec3 position_m{0.0, 0.0, 0.0};
    math::dvec3 direction{0.0, 0.0, -1.0};

    friend bool operator==(LightPose const&, LightPose const&) = default;
};

struct Pose {
    double time_s = 0.0;                              ///< Within the clip.
    std::vector<NodeTransform> parent_from_node;      ///< Per node.
    std::vector<math::dmat4> world_from_node;         ///< Per node.
    std::vector<math::dmat4> world_from_mesh;         ///< Per instance. Not what places a skinned one's vertices.
    std::vector<math::dmat4> world_from_bind;         ///< All skins' joints in a row: where the joint takes a mesh's vertex.
    std::vector<std::uint32_t> first_joint;           ///< Per skin, into `world_from_bind`; one more at the end.
    std::vector<double> morph_weights;                ///< All instances' in a row.
    std::vector<std::uint32_t> first_morph_weight;    ///< Per instance, into `morph_weights`; one more at the end.
    std::vector<CameraPose> cameras;                  ///< Per camera.
    std::vector<LightPose> lights;                    ///< Per light.

    friend bool operator==(Pose const&, Pose const&) = default;
};

/// The pose of `scene` at a time.
///
/// source:  [glTF 2.0, 3.11 and appendix C]
/// expects: `scene` passes `validate`.
/// returns: finite cameras and lights: one that the clip sends out of range stays where it rests. A matrix may hold
///          infinities where a clip's numbers multiply beyond the doubles.
/// cost:    O(nodes + channels log keys + instances + joints); allocates the result.
[[nodiscard]] Pose pose_at(Scene const& scene, PoseConfig const& config);

/// The same in the memory of `pose`: nothing is allocated if that held a pose of this scene.
void pose_at(Scene const& scene, PoseConfig const& config, Pose& pose);

/// Everything where it rests: no clip plays.
[[nodiscard]] Pose rest_pose(Scene const& scene);

/// returns: the first clip of that name, or `none`.
[[nodiscard]] std::uint32_t find_clip(Scene const& scene, std::string_view name) noexcept;

/// The time within a clip that `config` comes to: wrapped if it loops, else held at its ends.
[[nodiscard]] double time_in_clip(Scene const& scene, PoseConfig const& config) noexcept;

/// A camera of the scene where the pose has it.
///
/// expects: a pose of this scene; `camera` is an index into `Scene::cameras`.
[[nodiscard]] Camera posed_camera(Scene const& scene, Pose const& pose, std::uint32_t camera);

/// A light of the scene where the pose has it.
[[nodiscard]] Light posed_light(Scene const& scene, Pose const& pose, std::uint32_t light);

}  // namespace gnomon::scene
