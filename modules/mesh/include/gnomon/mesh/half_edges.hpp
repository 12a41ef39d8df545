#pragma once
// Half-edge connectivity over an index list. Half-edge 3t + k runs from corner k of triangle t to the next corner.
//
// Policy, the same for everyone who builds on it:
// - Vertices are places (see weld.hpp): seams of normals and texture coordinates are no borders.
// - A triangle is left out that has a bad index, a position that is not finite, two corners at one place (degenerate), or
//   the same corners in the same turning sense as an earlier one (duplicate, unless `keep_duplicates`). In the opposite
//   sense it is kept: a sheet of two sides. A sliver whose three places lie on one line is kept: it may close the surface.
// - An edge is all half-edges between two places. With two half-edges that run against each other it is `manifold`, and
//   they are twins. With one it is `open`; with two that run the same way `flipped`; with more `non_manifold`. The
//   half-edges of those three kinds have no twin. `Edge` has them all, for algorithms that count how often an edge is
//   crossed, and in which sense.

#include <gnomon/core/contract.hpp>
#include <gnomon/math/vec.hpp>
#include <gnomon/mesh/weld.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace gnomon::mesh {

/// A view of positions and of three indices per triangle.
struct Triangles {
    std::span<math::vec3 const> positions;
    std::span<std::uint32_t const> indices;

    [[nodiscard]] std::size_t size() const noexcept { return indices.size() / 3; }
};

[[nodiscard]] constexpr std::uint32_t triangle_of(std::uint32_t half_edge) noexcept { return half_edge / 3; }
[[nodiscard]] constexpr std::uint32_t next(std::uint32_t half_edge) noexcept {
    return half_edge % 3 == 2 ? half_edge - 2 : half_edge + 1;
}
[[nodiscard]] constexpr std::uint32_t previous(std::uint32_t half_edge) noexcept {
    return half_edge % 3 == 0 ? half_edge + 2 : half_edge - 1;
}

enum class EdgeKind : std::uint8_t { manifold, open, flipped, non_manifold };

/// All half-edges between two places: `HalfEdges::of_edge[first, first + count)`, ascending.
struct Edge {
    std::uint32_t low = no_index;   ///< The two vertices; low < high.
    std::uint32_t high = no_index;
    std::uint32_t first = 0;
    std::uint32_t count = 0;
    std::int32_t balance = 0;   ///< Half-edges from low to high, minus those from high to low. 0 all round: closed.
    EdgeKind kind = EdgeKind::open;

    friend bool operator==(Edge const&, Edge const&) noexcept = default;
};

enum class Fate : std::uint8_t { kept, bad_index, not_finite, degenerate, duplicate };

/// What there was, and what was left out. Nothing of it is an error.
struct MeshReport {
    std::uint64_t manifold_edges = 0;
    std::uint64_t open_edges = 0;
    std::uint64_t flipped_edges = 0;
    std::uint64_t non_manifold_edges = 0;
    std::uint64_t unbalanced_edges = 0;      ///< Of all kinds, those with a balance that is not 0: the surface has a border there.
    std::uint64_t welded_vertices = 0;       ///< Positions that are at the place of an earlier one.
    std::uint64_t bad_index = 0;             ///< Triangles left out, as are the next three; each counts once.
    std::uint64_t not_finite = 0;
    std::uint64_t degenerate_triangles = 0;
    std::uint64_t duplicate_triangles = 0;

    [[nodiscard]] std::uint64_t edges() const noexcept {
        return manifold_edges + open_edges + flipped_edges + non_manifold_edges;
    }
    friend bool operator==(MeshReport const&, MeshReport const&) noexcept = default;
};

/// Made by `build_half_edges`. Per position, triangle or half-edge of the input; left-out triangles have no edges.
struct HalfEdges {
    std::vector<std::uint32_t> vertex_of;  ///< Per position: the first position at its place, the vertex.
    std::vector<Fate> fate;                ///< Per triangle.
    std::vector<std::uint32_t> from;       ///< Per half-edge: the vertex it starts at; none for bad indices.
    std::vector<std::uint32_t> twin;       ///< Per half-edge; none for all but manifold edges.
    std::vector<std::uint32_t> edge_of;    ///< Per half-edge, into `edges`.
    std::vector<Edge> edges;               ///< Ascending by (low, high).
    std::vector<std::uint32_t> of_edge;    ///< The half-edges of each edge.
    MeshReport report;

    [[nodiscard]] std::span<std::uint32_t const> half_edges(Edge const& edge) const noexcept {
        return std::span(of_edge).subspan(edge.first, edge.count);
    }
};

/// Every edge is manifold: each triangle has three neighbours, all turning the same way.
[[nodiscard]] inline bool is_closed_manifold(MeshReport const& report) noexcept {
    return report.edges() == report.manifold_edges;
}

/// Every edge is passed as often one way as the other: inside and outside are defined, though edges may be shared by more
/// than two triangles.
[[nodiscard]] inline bool is_closed(MeshReport const& report) noexcept { return report.unbalanced_edges == 0; }

struct HalfEdgeConfig {
    bool keep_duplicates = false;  ///< They are counted all the same, and their edges are not manifold.
};

/// Memory that `build_half_edges` keeps from call to call.
struct Workspace {
    std::vector<std::uint32_t> table;
    std::vector<std::uint32_t> first;                   ///< Where each vertex's bucket begins.
    std::vector<std::array<std::uint32_t, 3>> entries;  ///< Two keys and what they are of, in buckets.
};

namespace detail {

/// Sorts entries (vertex, key, key, payload) by bucket, then by the keys and payload. `visit(emit)` calls
/// `emit(vertex, entry)` for all of them, twice the same. Afterwards bucket v is entries[first[v], first[v + 1]).
template <class Visit>
void sort_into_buckets(Workspace& workspace, std::size_t vertices, Visit const& visit) {
    std::vector<std::uint32_t>& first = workspace.first;
    first.assign(vertices + 2, 0);
    visit([&](std::uint32_t vertex, std::array<std::uint32_t, 3> const&) { ++first[vertex + 2]; });
    for (std::size_t v = 2; v < first.size(); ++v) first[v] += first[v - 1];
    workspace.entries.resize(first.back());
    visit([&](std::uint32_t vertex, std::array<std::uint32_t, 3> const& entry) {
        workspace.entries[first[vertex + 1]++] = entry;
    });
    auto const begin = workspace.entries.begin();
    for (std::size_t v = 0; v < vertices; ++v)
        std::sort(begin + static_cast<std::ptrdiff_t>(first[v]), begin + static_cast<std::ptrdiff_t>(first[v + 1]));
}

[[nodiscard]] inline Fate fate_of(Triangles const& mesh, std::size_t t, std::span<std::uint32_t const> vertex_of) noexcept {
    for (std::size_t k = 0; k < 3; ++k)
        if (mesh.indices[3 * t + k] >= mesh.positions.size()) return Fate::bad_index;
    for (std::size_t k = 0; k < 3; ++k)
        if (!math::is_finite(mesh.positions[mesh.indices[3 * t + k]])) return Fate::not_finite;
    std::uint32_t const a = vertex_of[mesh.indices[3 * t]];
    std::uint32_t const b = vertex_of[mesh.indices[3 * t + 1]];
    std::uint32_t const c = vertex_of[mesh.indices[3 * t + 2]];
    return a == b || b == c || c == a ? Fate::degenerate : Fate::kept;
}

/// Marks triangles that an earlier one equals, turned so that the lowest vertex comes first.
inline void find_duplicates(HalfEdges& mesh, Workspace& workspace) {
    sort_into_buckets(workspace, mesh.vertex_of.size(), [&](auto const& emit) {
        for (std::uint32_t t = 0; t < mesh.fate.size(); ++t) {
            if (mesh.fate[t] != Fate::kept) continue;
            std::array<std::uint32_t, 3> v{mesh.from[3 * t], mesh.from[3 * t + 1], mesh.from[3 * t + 2]};
            std::rotate(v.begin(), std::min_element(v.begin(), v.end()), v.end());
            emit(v[0], {v[1], v[2], t});
        }
    });
    for (std::size_t v = 0; v < mesh.vertex_of.size(); ++v)
        for (std::size_t i = std::size_t{workspace.first[v]} + 1; i < workspace.first[v + 1]; ++i) {
            auto const& a = workspace.entries[i - 1];
            auto const& b = workspace.entries[i];
            if (a[0] == b[0] && a[1] == b[1]) mesh.fate[b[2]] = Fate::duplicate;
        }
}

inline void count_fates(HalfEdges& mesh) noexcept {
    for (Fate const fate : mesh.fate) switch (fate) {
            case Fate::kept: break;
            case Fate::bad_index: ++mesh.report.bad_index; break;
            case Fate::not_finite: ++mesh.report.not_finite; break;
            case Fate::degenerate: ++mesh.report.degenerate_triangles; break;
            case Fate::duplicate: ++mesh.report.duplicate_triangles; break;
        }
}

/// Kind and twins of an edge whose half-edges are known.
inline void classify(Edge& edge, HalfEdges& mesh) noexcept {
    std::span<std::uint32_t const> const halves = mesh.half_edges(edge);
    for (std::uint32_t const h : halves) edge.balance += mesh.from[h] == edge.low ? 1 : -1;
    bool const pair = halves.size() == 2;
    edge.kind = halves.size() == 1            ? EdgeKind::open
                : pair && edge.balance == 0   ? EdgeKind::manifold
                : pair                        ? EdgeKind::flipped
                                              : EdgeKind::non_manifold;
    if (edge.kind == EdgeKind::manifold) {
        mesh.twin[halves[0]] = halves[1];
        mesh.twin[halves[1]] = halves[0];
    }
    mesh.report.manifold_edges += edge.kind == EdgeKind::manifold ? 1U : 0U;
    mesh.report.open_edges += edge.kind == EdgeKind::open ? 1U : 0U;
    mesh.report.flipped_edges += edge.kind == EdgeKind::flipped ? 1U : 0U;
    mesh.report.non_manifold_edges += edge.kind == EdgeKind::non_manifold ? 1U : 0U;
    mesh.report.unbalanced_edges += edge.balance != 0 ? 1U : 0U;
}

inline void find_edges(HalfEdges& mesh, Workspace& workspace) {
    sort_into_buckets(workspace, mesh.vertex_of.size(), [&](auto const& emit) {
        for (std::uint32_t h = 0; h < mesh.from.size(); ++h) {
            if (mesh.fate[triangle_of(h)] != Fate::kept) continue;
            std::uint32_t const a = mesh.from[h];
            std::uint32_t const b = mesh.from[next(h)];
            emit(std::min(a, b), {std::max(a, b), h, 0});
        }
    });
    mesh.edges.clear();
    mesh.of_edge.clear();
    for (std::uint32_t v = 0; v < mesh.vertex_of.size(); ++v)
        for (std::size_t i = workspace.first[v]; i < workspace.first[v + 1]; ++i) {
            auto const& [other, h, unused] = workspace.entries[i];
            if (i == workspace.first[v] || workspace.entries[i - 1][0] != other)
                mesh.edges.push_back({v, other, static_cast<std::uint32_t>(mesh.of_edge.size()), 0, 0, EdgeKind::open});
            mesh.edge_of[h] = static_cast<std::uint32_t>(mesh.edges.size() - 1);
            mesh.of_edge.push_back(h);
            ++mesh.edges.back().count;
        }
    for (Edge& edge : mesh.edges) classify(edge, mesh);
}

}  // namespace detail

/// Finds the connectivity of `mesh`; see the policy above.
///
/// expects: three indices per triangle, fewer than 2^32 of them, fewer than 2^31 positions.
/// returns: in `out`, the same on every machine. Any data is legal; what is left out is counted in `out.report`.
/// cost:    O(n log v), v the most triangles at one vertex. `workspace` and `out` allocate only where they were smaller before.
inline void build_half_edges(Triangles const& mesh, Workspace& workspace, HalfEdges& out, HalfEdgeConfig const& config = {}) {
    GNOMON_EXPECT(mesh.indices.size() % 3 == 0 && mesh.indices.size() < no_index);
    out.report = {};
    out.vertex_of.resize(mesh.positions.size());
    out.report.welded_vertices = weld(mesh.positions, out.vertex_of, workspace.table);
    out.fate.resize(mesh.size());
    for (std::size_t t = 0; t < mesh.size(); ++t) out.fate[t] = detail::fate_of(mesh, t, out.vertex_of);
    out.from.resize(mesh.indices.size());
    for (std::size_t h = 0; h < mesh.indices.size(); ++h)
        out.from[h] = mesh.indices[h] < mesh.positions.size() ? out.vertex_of[mesh.indices[h]] : no_index;
    out.twin.assign(mesh.indices.size(), no_index);
    out.edge_of.assign(mesh.indices.size(), no_index);
    detail::find_duplicates(out, workspace);
    detail::count_fates(out);
    if (config.keep_duplicates) std::replace(out.fate.begin(), out.fate.end(), Fate::duplicate, Fate::kept);
    detail::find_edges(out, workspace);
}

[[nodiscard]] inline HalfEdges build_half_edges(Triangles const& mesh, HalfEdgeConfig const& config = {}) {
    Workspace workspace;
    HalfEdges out;
    build_half_edges(mesh, workspace, out, config);
    return out;
}

}  // namespace gnomon::mesh
