#pragma once
// The parts of a glTF document that move: joints and morph targets of vertices, skins, clips.

#include "gltf_document.hpp"

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace gnomon::scene::detail {

/// The vertices of a primitive that are to be read.
struct VertexSource {
    Document& document;
    tinygltf::Primitive const& in;
    std::string const& where;              ///< The primitive's name in messages.
    std::size_t count = 0;                 ///< Positions in the file.
    std::span<std::uint32_t const> chosen;  ///< Those to read, each below `count`.
};

/// JOINTS_0 and _1 and their weights, made to sum to 1.
void read_influences(VertexSource const& source, Primitive& out);

void read_morph_targets(VertexSource const& source, Primitive& out);

/// Weights of morph targets as `count` floats; none where the file has none.
std::vector<float> read_default_weights(Document& document, std::vector<double> const& in, std::size_t count,
                                        std::string const& where);

/// What became of the file's nodes and skins.
struct NodeMap {
    std::vector<std::uint32_t> node_of;         ///< Per node of the file: its index in the scene, or `none`.
    std::vector<std::uint32_t> first_instance;  ///< Per node of the file, and one more at the end.
    std::vector<std::uint32_t> skin_of;         ///< Per skin of the file: its index in the scene, or `none`.
};

/// Whether `channel` could move its node, if the scene has that.
bool moves_a_node(Document const& document, tinygltf::AnimationChannel const& channel);

void load_skins(Document& document, NodeMap const& map, Scene& scene);

/// Fails where a mesh names a joint that the skin of one of its instances does not have.
void check_joints(Scene const& scene);

void load_animations(Document& document, NodeMap const& map, Scene& scene);

}  // namespace gnomon::scene::detail
