#pragma once
// What moves in a scene, as plain data: the nodes that things hang on, the clips that turn them, skins and morph targets.
//
// As in glTF 2.0: a node's transform is T R S, a rotation is a quaternion x y z w, key times are seconds from the start of
// the clip. `pose.hpp` says where everything is at a time.

#include <gnomon/math/vec.hpp>

#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <vector>

namespace gnomon::scene {

/// The index that names nothing.
inline constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();

/// A frame of reference that may move. What never moves needs none: its place in the world says it all.
struct Node {
    std::string name;
    std::uint32_t parent = none;                 ///< A node before this one, or none: the world.
    math::dvec3 translation{0.0, 0.0, 0.0};
    math::dvec4 rotation{0.0, 0.0, 0.0, 1.0};    ///< x y z w; scaled to length 1 when used. Zero: no turn.
    math::dvec3 scale{1.0, 1.0, 1.0};
    std::optional<math::dmat4> matrix;           ///< Instead of the three above; then nothing can animate the node.

    friend bool operator==(Node const&, Node const&) = default;
};

enum class AnimationPath : std::uint8_t {
    translation,  ///< Three numbers per key.
    rotation,     ///< Four: x y z w.
    scale,        ///< Three.
    weights,      ///< One per morph target of the instance's mesh.
};

enum class Interpolation : std::uint8_t {
    step,          ///< A key's value until the next key.
    linear,        ///< Straight; rotations along the shorter great arc.
    cubic_spline,  ///< Per key: in-tangent, value, out-tangent. Rotations are scaled to length 1 afterwards.
};

/// How one property of one node or instance changes over a clip. Before the first key and after the last it stands still.
struct AnimationChannel {
    std::uint32_t node = none;      ///< Into `Scene::nodes`; `none` for weights.
    std::uint32_t instance = none;  ///< Into `Scene::instances`, for weights only.
    AnimationPath path = AnimationPath::translation;
    Interpolation interpolation = Interpolation::linear;
    std::vector<float> times_s;  ///< Of the keys: one at least, not negative, never falling.
    std::vector<float> values;   ///< Per key as `path` says; three times as many for a cubic spline.

    friend bool operator==(AnimationChannel const&, AnimationChannel const&) = default;
};

/// One clip: channels that play together.
struct Animation {
    std::string name;
    std::vector<AnimationChannel> channels;  ///< Where two move the same property, the later one does.

    friend bool operator==(Animation const&, Animation const&) = default;
};

/// The joints that bend a mesh.
struct Skin {
    std::string name;
    std::vector<std::uint32_t> joints;       ///< Into `Scene::nodes`.
    std::vector<math::mat4> inverse_bind;    ///< Joint from mesh, one per joint. The last row is 0 0 0 1.

    friend bool operator==(Skin const&, Skin const&) = default;
};

/// Offsets from a primitive's vertices; a weight says how much of them is added.
struct MorphTarget {
    std::vector<math::vec3> positions;  ///< One per vertex, or none at all.
    std::vector<math::vec3> normals;    ///< One per vertex, or none at all.

    friend bool operator==(MorphTarget const&, MorphTarget const&) = default;
};

/// Numbers per key of a channel with `path`; 0 for weights, which the mesh decides.
[[nodiscard]] constexpr std::uint32_t components_of(AnimationPath path) noexcept {
    switch (path) {
        case AnimationPath::translation:
        case AnimationPath::scale: return 3;
        case AnimationPath::rotation: return 4;
        case AnimationPath::weights: break;
    }
    return 0;
}

/// Time of the last key of any channel; 0 where there is none.
[[nodiscard]] double duration_s(Animation const& animation) noexcept;

}  // namespace gnomon::scene
