#pragma once
// The parts of a glTF document, turned into those of a scene.

#include "gltf_document.hpp"
#include "gltf_motion.hpp"

#include <gnomon/math/vec.hpp>

#include <cstdint>
#include <vector>

namespace gnomon::scene::detail {

/// All materials of the file, and the textures and images that their base colours use.
void load_materials(Document& document, Scene& scene);

/// All meshes that hold triangles.
///
/// returns: for each mesh of the file its index in the scene, or `none`.
std::vector<std::uint32_t> load_meshes(Document& document, Scene& scene);

/// The instances, cameras and lights of the nodes that the chosen scene reaches, and the nodes that move or are joints.
///
/// returns: what became of the nodes; room is made for the skins that instances use.
NodeMap load_nodes(Document& document, std::vector<std::uint32_t> const& mesh_of, Scene& scene);

}  // namespace gnomon::scene::detail
