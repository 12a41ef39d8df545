#pragma once
// A scene as plain data: what a file or a generator gives, before any frame. No file format shows through.
//
// Lengths are metres, right-handed, y up by habit. Vertices are floats in their mesh's own frame; where a mesh stands is
// a double matrix, so that a scene 1e7 m from the origin is as exact as one around it. Indices between the arrays are
// plain 32-bit numbers; `none` names nothing. `validate` says whether they all hold.

#include <gnomon/core/result.hpp>
#include <gnomon/math/texel.hpp>
#include <gnomon/math/vec.hpp>
#include <gnomon/scene/animation.hpp>

#include <array>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

namespace gnomon::scene {

enum class SceneError : std::uint8_t {
    not_found,              ///< No such file: check the path.
    unreadable,             ///< The file is there but cannot be read: check what it is and its permissions.
    not_gltf,               ///< Neither glTF JSON nor GLB: give a .gltf or .glb file.
    malformed,              ///< The file breaks a rule of glTF 2.0: export it again.
    unsupported_extension,  ///< The file requires an extension that is not read here: export without it.
    over_limit,             ///< A count or size is above `Limits`: raise the limit or simplify the scene.
    empty,                  ///< No triangle is left to draw.
    bad_config,             ///< A configuration value is out of its range.
    not_writable,           ///< The output cannot be written; nothing was left behind.
};

enum class AlphaMode : std::uint8_t {
    opaque,
    mask,   ///< Alpha at or above the cutoff is solid, below it is not there.
    blend,  ///< Alpha is coverage.
};

/// Pixels as stored in the file: 8-bit RGBA, rows from the top, colours sRGB-encoded, alpha linear, not premultiplied.
struct Image {
    std::string name;
    math::ivec2 size_px{0, 0};
    std::vector<std::uint8_t> rgba;  ///< 4 * width * height bytes.

    friend bool operator==(Image const&, Image const&) = default;
};

struct Texture {
    std::uint32_t image = none;
    math::Wrap wrap_u = math::Wrap::repeat;
    math::Wrap wrap_v = math::Wrap::repeat;
    bool nearest = false;  ///< The file asks for unfiltered magnification.

    friend bool operator==(Texture const&, Texture const&) = default;
};

/// A texture as a material uses it: uv' = offset + rotate(scale * uv), as KHR_texture_transform defines it.
struct TextureUse {
    std::uint32_t texture = none;
    std::uint32_t uv_set = 0;  ///< 0 or 1.
    math::vec2 offset{0.0F, 0.0F};
    math::vec2 scale{1.0F, 1.0F};
    float rotation_rad = 0.0F;

    friend bool operator==(TextureUse const&, TextureUse const&) = default;
};

struct Material {
    std::string name;
    math::vec4 base_color{1.0F, 1.0F, 1.0F, 1.0F};  ///< Linear; multiplies the texture.
    TextureUse base_color_texture;
    float metallic = 1.0F;
    float roughness = 1.0F;
    math::vec3 emissive{0.0F, 0.0F, 0.0F};
    AlphaMode alpha_mode = AlphaMode::opaque;
    float alpha_cutoff = 0.5F;
    bool double_sided = false;

    friend bool operator==(Material const&, Material const&) = default;
};

/// Triangles of one material. Front faces are counter-clockwise, seen from outside.
struct Primitive {
    std::vector<math::vec3> positions;   ///< Finite.
    std::vector<math::vec3> normals;     ///< One per position, unit length.
    std::vector<math::vec2> uv0;         ///< One per position, or none at all.
    std::vector<math::vec2> uv1;         ///< One per position, or none at all.
    std::vector<std::uint32_t> indices;  ///< Three per triangle.
    std::uint32_t material = none;       ///< Always an index in a valid scene.
    std::uint32_t influences = 0;        ///< Joints per position: 0, 4 or 8.
    std::vector<std::uint16_t> joints;   ///< `influences` per position, into the joints of the instance's skin.
    std::vector<float> joint_weights;    ///< As many, not negative; they sum to 1.
    std::vector<MorphTarget> morph_targets;

    friend bool operator==(Primitive const&, Primitive const&) = default;
};

struct Mesh {
    std::string name;
    std::vector<Primitive> primitives;  ///< All with equally many morph targets.
    std::vector<float> weights{};       ///< Of the morph targets while nothing moves them: one each, or none: zeros.

    friend bool operator==(Mesh const&, Mesh const&) = default;
};

/// One mesh standing somewhere. What a file says about nodes that never move is multiplied out, in double.
struct Instance {
    std::string name;
    std::uint32_t mesh = none;
    math::dmat4 world_from_mesh{1.0};  ///< At rest; where a node carries it, as `settle` computes it.
    std::uint32_t node = none;         ///< Into `Scene::nodes`, where one carries it.
    math::dmat4 node_from_mesh{1.0};   ///< With a node only.
    std::uint32_t skin = none;         ///< Its joints then place each vertex, and no matrix here does.
    std::vector<float> weights{};      ///< Of the morph targets, instead of the mesh's: one each, or none.

    friend bool operator==(Instance const&, Instance const&) = default;
};

enum class CameraKind : std::uint8_t {
    perspective,
    orthographic,
};

/// A camera with its pose in the world, at rest. Axes are orthonormal; it looks along -back.
struct Camera {
    std::string name;
    CameraKind kind = CameraKind::perspective;
    math::dvec3 eye_m{0.0, 0.0, 0.0};
    math::dvec3 right{1.0, 0.0, 0.0};
    math::dvec3 up{0.0, 1.0, 0.0};
    math::dvec3 back{0.0, 0.0, 1.0};
    double fov_y_rad = 1.0471975511965976;  ///< Perspective only.
    double half_width_m = 1.0;              ///< Orthographic only.
    double half_height_m = 1.0;             ///< Orthographic only.
    double near_m = 0.1;
    double far_m = std::numeric_limits<double>::infinity();
    std::uint32_t node = none;          ///< Into `Scene::nodes`, where one carries it.
    math::dmat4 node_from_camera{1.0};  ///< With a node only.

    friend bool operator==(Camera const&, Camera const&) = default;
};

enum class LightKind : std::uint8_t {
    directional,
    point,
    spot,
};

/// A light of KHR_lights_punctual with its pose in the world, at rest.
struct Light {
    std::string name;
    LightKind kind = LightKind::directional;
    math::dvec3 position_m{0.0, 0.0, 0.0};   ///< Point and spot.
    math::dvec3 direction{0.0, 0.0, -1.0};   ///< Where the light goes, unit length. Directional and spot.
    math::vec3 color{1.0F, 1.0F, 1.0F};      ///< Linear.
    float intensity = 1.0F;                  ///< Lux (directional) or candela.
    float range_m = std::numeric_limits<float>::infinity();  ///< Point and spot; no light beyond it.
    float inner_cone_rad = 0.0F;                             ///< Half angle. Spot only.
    float outer_cone_rad = 0.78539816339744831F;             ///< Half angle. Spot only.
    std::uint32_t node = none;                               ///< Into `Scene::nodes`, where one carries it.
    math::dmat4 node_from_light{1.0};                        ///< With a node only. Light goes along -z.

    friend bool operator==(Light const&, Light const&) = default;
};

/// What was left out or mended on the way in; nothing is dropped without a count here.
struct Notes {
    std::uint64_t non_finite_triangles = 0;  ///< A corner was NaN or infinite; left out.
    std::uint64_t points_and_lines = 0;      ///< Primitives that hold no triangles; left out.
    std::uint64_t mended_normals = 0;        ///< Zero, NaN or infinite; the triangle's own normal stands in.
    std::uint64_t mended_uvs = 0;            ///< NaN or infinite; 0 stands in.
    std::uint64_t failed_images = 0;         ///< Missing or unreadable; plain white stands in.
    std::uint64_t mended_weights = 0;        ///< Vertices whose joint weights did not sum to 1; scaled to it.
    std::uint64_t mended_offsets = 0;        ///< Of morph targets, NaN or infinite; 0 stands in.
    std::uint64_t dropped_channels = 0;      ///< Of animations: nothing here to move, or keys that make no sense; left out.
    std::vector<std::string> warnings;       ///< One sentence each, at most `Limits::max_warnings`.

    friend bool operator==(Notes const&, Notes const&) = default;
};

struct Scene {
    std::string name;
    std::vector<Mesh> meshes;
    std::vector<Instance> instances;
    std::vector<Material> materials;
    std::vector<Texture> textures;
    std::vector<Image> images;
    std::vector<Camera> cameras;  ///< Named views too: `A`, `street`.
    std::vector<Light> lights;
    std::vector<Node> nodes;            ///< Those that move, and what they and the joints hang on. Parents come first.
    std::vector<Skin> skins;
    std::vector<Animation> animations;  ///< The clips; one plays at a time, unless all are asked for.
    std::vector<std::string> file_scenes;  ///< The names of all scenes of the file it was read from. Not compared.
    Notes notes;                           ///< Not a part of what the scene is: not compared.

    friend bool operator==(Scene const& a, Scene const& b) {
        return a.name == b.name && a.meshes == b.meshes && a.instances == b.instances && a.materials == b.materials &&
               a.textures == b.textures && a.images == b.images && a.cameras == b.cameras && a.lights == b.lights &&
               a.nodes == b.nodes && a.skins == b.skins && a.animations == b.animations;
    }
};

template <class T>
using Result = core::Result<T, SceneError>;

/// Triangles that are drawn: those of every instance, counted each time.
[[nodiscard]] std::uint64_t count_triangles(Scene const& scene) noexcept;

/// Triangles that are stored: those of every mesh, counted once.
[[nodiscard]] std::uint64_t count_unique_triangles(Scene const& scene) noexcept;

/// The first rule of this header that `scene` breaks, in one sentence: an index out of range, arrays of unequal length,
/// a number that is not finite. For scenes put together by hand; the loader and the generators give valid ones.
[[nodiscard]] Result<core::Done> validate(Scene const& scene);

/// Morph targets of `mesh`, the same for each of its primitives.
[[nodiscard]] std::uint32_t count_morph_targets(Mesh const& mesh) noexcept;

/// Whether the instance's vertices may differ from those of the mesh where `world_from_mesh` puts them: a node carries it,
/// or joints or morph targets bend it.
[[nodiscard]] bool is_posed(Scene const& scene, Instance const& instance) noexcept;

/// Puts the instances, cameras and lights that nodes carry where the nodes, at rest, put them. For scenes put together by
/// hand, after the last node, instance, camera and light.
///
/// expects: the indices hold, as `validate` says.
void settle(Scene& scene);

/// A camera at `eye_m` that looks at `target_m`, upright.
///
/// expects: two finite points apart from each other.
[[nodiscard]] Camera looking_at(std::string name, math::dvec3 const& eye_m, math::dvec3 const& target_m,
                                double fov_y_rad);

}  // namespace gnomon::scene
