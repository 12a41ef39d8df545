#pragma once
// glTF 2.0 out, so that every scene can be opened elsewhere and read back equal.

#include <gnomon/scene/scene.hpp>

#include <string>

namespace gnomon::scene {

/// Writes `scene` to `path`: one file, .glb binary or .gltf with its data inside, textures as PNG.
///
/// `load_gltf(path)` gives an equal scene, to the last bit of every number.
///
/// returns: done; or why not, and then the file at `path` is as it was: the new one takes its name only when whole.
[[nodiscard]] Result<core::Done> write_gltf(Scene const& scene, std::string const& path);

}  // namespace gnomon::scene
