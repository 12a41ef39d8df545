#pragma once
// Fans: the corners round a vertex that are joined by twins. A vertex of a manifold has one; more than one mean that
// surfaces meet there in no more than a point, or along edges that are not manifold.

#include <gnomon/mesh/half_edges.hpp>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace gnomon::mesh {

/// Made by `find_fans`.
struct Fans {
    std::vector<std::uint32_t> fan_of;     ///< Per half-edge: the fan of the corner that it starts at; none if left out.
    std::vector<std::uint32_t> vertex_of;  ///< Per fan: its vertex.
    std::vector<std::uint32_t> of_vertex;  ///< Per position: how many fans it has, as a vertex.
    std::size_t split_vertices = 0;        ///< Vertices with more than one fan.
};

/// The next corner round the vertex of half-edge `h`, against the clock; none at a border.
[[nodiscard]] inline std::uint32_t rotated(HalfEdges const& mesh, std::uint32_t h) noexcept {
    return mesh.twin[previous(h)];
}

/// The next corner the other way round; none at a border.
[[nodiscard]] inline std::uint32_t rotated_back(HalfEdges const& mesh, std::uint32_t h) noexcept {
    return mesh.twin[h] == no_index ? no_index : next(mesh.twin[h]);
}

/// Numbers the fans in the order of their lowest half-edges.
///
/// cost: O(n); allocates only where `out` was smaller before.
inline void find_fans(HalfEdges const& mesh, Fans& out) {
    out.fan_of.assign(mesh.from.size(), no_index);
    out.of_vertex.assign(mesh.vertex_of.size(), 0);
    out.vertex_of.clear();
    out.split_vertices = 0;
    for (std::uint32_t h = 0; h < mesh.from.size(); ++h) {
        if (mesh.fate[triangle_of(h)] != Fate::kept || out.fan_of[h] != no_index) continue;
        auto const fan = static_cast<std::uint32_t>(out.vertex_of.size());
        out.vertex_of.push_back(mesh.from[h]);
        out.split_vertices += ++out.of_vertex[mesh.from[h]] == 2 ? 1U : 0U;
        for (std::uint32_t at = h; at != no_index && out.fan_of[at] == no_index; at = rotated(mesh, at)) out.fan_of[at] = fan;
        for (std::uint32_t at = rotated_back(mesh, h); at != no_index && out.fan_of[at] == no_index; at = rotated_back(mesh, at))
            out.fan_of[at] = fan;
    }
}

[[nodiscard]] inline Fans find_fans(HalfEdges const& mesh) {
    Fans out;
    find_fans(mesh, out);
    return out;
}

}  // namespace gnomon::mesh
