#pragma once
// Checks everything that users of half-edges rely on.

#include <gnomon/mesh/half_edges.hpp>

#include <cstddef>
#include <cstdint>

namespace gnomon::mesh {

enum class MeshFault : std::uint8_t {
    none,
    wrong_size,   ///< Some array has not one entry per position, triangle or half-edge.
    bad_vertex,   ///< A vertex is not the first of its place, or a half-edge does not start where the indices say.
    bad_fate,     ///< A kept triangle has a bad index, a position that is not finite, or two corners at one place.
    bad_edge,     ///< Edges out of order, out of range, or with half-edges of other vertices; or a count that is wrong.
    bad_kind,     ///< Kind or balance do not follow from the half-edges.
    bad_twin,     ///< Twins that do not name each other, do not run against each other, or are not of a manifold edge.
};

namespace detail {

[[nodiscard]] inline MeshFault check_vertices(HalfEdges const& mesh, Triangles const& list) noexcept {
    for (std::size_t i = 0; i < list.positions.size(); ++i) {
        std::uint32_t const v = mesh.vertex_of[i];
        if (v > i || mesh.vertex_of[v] != v || (v != i && !same_place(list.positions[i], list.positions[v])))
            return MeshFault::bad_vertex;
    }
    for (std::size_t h = 0; h < list.indices.size(); ++h) {
        bool const exists = list.indices[h] < list.positions.size();
        if (mesh.from[h] != (exists ? mesh.vertex_of[list.indices[h]] : no_index)) return MeshFault::bad_vertex;
    }
    for (std::size_t t = 0; t < list.size(); ++t) {
        Fate const wanted = fate_of(list, t, mesh.vertex_of);
        if (mesh.fate[t] != wanted && !(mesh.fate[t] == Fate::duplicate && wanted == Fate::kept)) return MeshFault::bad_fate;
    }
    return MeshFault::none;
}

[[nodiscard]] inline MeshFault check_edge(HalfEdges const& mesh, std::size_t e) noexcept {
    Edge const& edge = mesh.edges[e];
    std::int32_t balance = 0;
    for (std::uint32_t const h : mesh.half_edges(edge)) {
        if (h >= mesh.from.size() || mesh.edge_of[h] != e || mesh.fate[triangle_of(h)] != Fate::kept) return MeshFault::bad_edge;
        std::uint32_t const a = mesh.from[h];
        std::uint32_t const b = mesh.from[next(h)];
        if (!((a == edge.low && b == edge.high) || (a == edge.high && b == edge.low))) return MeshFault::bad_edge;
        balance += a == edge.low ? 1 : -1;
        std::uint32_t const twin = mesh.twin[h];
        bool const paired = edge.kind == EdgeKind::manifold;
        if (!paired && twin != no_index) return MeshFault::bad_twin;
        if (paired && (twin >= mesh.twin.size() || mesh.twin[twin] != h || mesh.from[twin] != b || mesh.edge_of[twin] != e))
            return MeshFault::bad_twin;
    }
    EdgeKind const kind = edge.count == 1                   ? EdgeKind::open
                          : edge.count == 2 && balance == 0 ? EdgeKind::manifold
                          : edge.count == 2                 ? EdgeKind::flipped
                                                            : EdgeKind::non_manifold;
    return kind == edge.kind && balance == edge.balance ? MeshFault::none : MeshFault::bad_kind;
}

}  // namespace detail

/// Whether `mesh` is what `build_half_edges` promises of `list`; `MeshFault::none` if so. Duplicates are taken as marked.
///
/// cost: O(n); no allocation.
[[nodiscard]] inline MeshFault validate(HalfEdges const& mesh, Triangles const& list) noexcept {
    std::size_t const half_edges = list.indices.size();
    if (mesh.vertex_of.size() != list.positions.size() || mesh.fate.size() != list.size() || mesh.from.size() != half_edges ||
        mesh.twin.size() != half_edges || mesh.edge_of.size() != half_edges)
        return MeshFault::wrong_size;
    if (MeshFault const fault = detail::check_vertices(mesh, list); fault != MeshFault::none) return fault;
    std::size_t next_first = 0;
    for (std::size_t e = 0; e < mesh.edges.size(); ++e) {
        Edge const& edge = mesh.edges[e];
        bool const in_order = e == 0 || mesh.edges[e - 1].low < edge.low ||
                              (mesh.edges[e - 1].low == edge.low && mesh.edges[e - 1].high < edge.high);
        if (!in_order || edge.low >= edge.high || edge.first != next_first || edge.count == 0 ||
            next_first + edge.count > mesh.of_edge.size())
            return MeshFault::bad_edge;
        next_first += edge.count;
        if (MeshFault const fault = detail::check_edge(mesh, e); fault != MeshFault::none) return fault;
    }
    std::size_t kept = 0;
    for (Fate const fate : mesh.fate) kept += fate == Fate::kept ? 3U : 0U;
    return next_first == kept && kept == mesh.of_edge.size() ? MeshFault::none : MeshFault::bad_edge;
}

}  // namespace gnomon::mesh
