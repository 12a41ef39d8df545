#pragma once
// glTF 2.0 in. Any bytes give a scene or an error that names what is wrong; never a crash, a hang or unbounded memory.
//
// Read: .gltf and .glb, data URIs, buffers and images in the file's folder or below it, every component type, normalized
// and quantized attributes (KHR_mesh_quantization), strided and sparse accessors, triangle lists, strips and fans with
// or without indices, node hierarchies, shared meshes, EXT_mesh_gpu_instancing, cameras, KHR_lights_punctual,
// KHR_texture_transform. Skins, morph targets and animations are not applied: the scene stands in its rest pose.

#include <gnomon/scene/scene.hpp>

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>

namespace gnomon::scene {

/// Bounds on what one file may ask for. Raise one where the error says so.
struct Limits {
    std::uint64_t max_file_bytes = std::uint64_t{1} << 31U;  ///< Of the file and all that it refers to, together.
    std::uint64_t max_triangles = std::uint64_t{1} << 25U;   ///< Drawn: every instance counts.
    std::uint64_t max_vertices = std::uint64_t{1} << 26U;    ///< Stored, over all meshes.
    std::uint64_t max_motion_values = std::uint64_t{1} << 26U;  ///< Numbers of all clips, joints and morph weights.
    std::uint64_t max_zero_elements = std::uint64_t{1} << 20U;  ///< Of an accessor that has no bytes in the file.
    std::uint32_t max_nodes = 1U << 20U;                        ///< Instances that a node multiplies count as nodes.
    std::uint32_t max_depth = 1024;                             ///< Of the node hierarchy.
    std::uint32_t max_json_depth = 128;                         ///< Of nested brackets in the JSON.
    std::uint64_t max_json_values = std::uint64_t{1} << 23U;    ///< Numbers, strings and brackets of the JSON.
    std::uint32_t max_image_side_px = 16384;
    std::uint64_t max_image_bytes = std::uint64_t{1} << 30U;  ///< Of all decoded images together.
    std::uint32_t max_warnings = 32;
};

struct LoadConfig {
    Limits limits;
    std::uint32_t scene_index = none;  ///< `none`: the file's default scene, or its first, or all root nodes.
    std::string scene_name;            ///< The first of that name, if not empty; `scene_index` is then not asked.
    bool load_images = true;           ///< Off: every texture is plain white.
};

/// The scene in the file at `path`.
///
/// returns: a valid scene with at least one triangle, or why not. What was left out is counted in `Scene::notes`.
/// cost:    memory in proportion to the file and its decoded images.
[[nodiscard]] Result<Scene> load_gltf(std::string const& path, LoadConfig const& config = {});

/// The same from memory. `base_dir` is where relative URIs start; empty: there are none to follow.
[[nodiscard]] Result<Scene> load_gltf_bytes(std::span<std::byte const> bytes, std::string const& base_dir,
                                            LoadConfig const& config = {});

}  // namespace gnomon::scene
