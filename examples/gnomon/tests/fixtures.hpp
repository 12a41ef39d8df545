#pragma once
// Small scenes as files, whole and broken.

#include "process.hpp"

#include <gnomon/scene/scene.hpp>
#include <gnomon/scene/write.hpp>

#include <string>

namespace gnomon::command {

/// A table of 4x4 m with a square lid 1 m above its middle, one lamp, one camera; 4 triangles.
inline scene::Scene table_with_lid() {
    scene::Scene scene;
    scene.name = "table";
    scene.materials.resize(1);
    scene.materials[0].name = "paint";
    scene.materials[0].double_sided = true;
    scene::Primitive squares;
    squares.material = 0;
    for (auto const& [half, height] : {std::pair{2.0F, 0.0F}, {0.6F, 1.0F}}) {
        auto const first = static_cast<std::uint32_t>(squares.positions.size());
        for (auto const& [x, z] : {std::pair{-half, -half}, {-half, half}, {half, half}, {half, -half}}) {
            squares.positions.emplace_back(x, height, z);
            squares.normals.emplace_back(0.0F, 1.0F, 0.0F);
        }
        for (std::uint32_t const corner : {0U, 1U, 2U, 0U, 2U, 3U}) squares.indices.push_back(first + corner);
    }
    scene.meshes.push_back({"squares", {squares}});
    scene.instances.push_back({"table", 0, math::dmat4(1.0)});
    scene.cameras.push_back(scene::looking_at("front", {3.0, 3.5, 4.0}, {0.0, 0.0, 0.0}, 0.9));
    scene::Light lamp;
    lamp.name = "lamp";
    lamp.kind = scene::LightKind::point;
    lamp.position_m = {0.7, 4.0, 0.4};
    scene.lights.push_back(lamp);
    return scene;
}

inline std::string write_table(TestFolder const& folder) {
    std::string const path = (folder / "table.glb").string();
    return scene::write_gltf(table_with_lid(), path) ? path : "could not write " + path;
}

/// glTF that needs nothing and holds nothing.
inline std::string const empty_gltf = R"({"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": []}]})";

/// Asks for an extension that nobody has.
inline std::string const demanding_gltf =
    R"({"asset": {"version": "2.0"}, "extensionsRequired": ["KHR_draco_mesh_compression"], )"
    R"("extensionsUsed": ["KHR_draco_mesh_compression"], "scenes": [{"nodes": []}]})";

/// A whole triangle seen by a camera whose far plane lies before its near plane.
inline std::string const short_sighted_gltf =
    R"({"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0, 1]}], "nodes": [{"mesh": 0}, {"camera": 0, )"
    R"("name": "eye"}], "cameras": [{"name": "eye", "type": "perspective", "perspective": {"yfov": 1.0, "znear": 2.0, )"
    R"("zfar": 1.0}}], "meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}], "accessors": [{"bufferView": 0, )"
    R"("componentType": 5126, "count": 3, "type": "VEC3", "min": [0, 0, 0], "max": [1, 1, 0]}], "bufferViews": [)"
    R"({"buffer": 0, "byteLength": 36}], "buffers": [{"byteLength": 36, "uri": )"
    R"("data:application/octet-stream;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA"}]})";

}  // namespace gnomon::command
