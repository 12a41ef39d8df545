#pragma once
// Adapter: to and from OpenMesh, and levels of detail by its quadric decimater. Needs OpenMesh (libopenmesh-dev); no other
// header includes it. It takes seconds to compile: keep it in one source file.
//
// OpenMesh holds manifolds only. What is not manifold is cut apart: each fan of a vertex (fans.hpp) becomes a vertex of its
// own, so every kept triangle has its place. Where vertices were cut they are locked, so decimation opens no gap there.

#include <gnomon/core/contract.hpp>
#include <gnomon/mesh/deviation.hpp>
#include <gnomon/mesh/fans.hpp>
#include <gnomon/mesh/half_edges.hpp>

#include <OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh>
#include <OpenMesh/Tools/Decimater/DecimaterT.hh>
#include <OpenMesh/Tools/Decimater/ModNormalFlippingT.hh>
#include <OpenMesh/Tools/Decimater/ModQuadricT.hh>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

namespace gnomon::mesh {

using OpenMeshSurface = OpenMesh::TriMesh_ArrayKernelT<>;

/// What `to_openmesh` did.
struct Conversion {
    std::uint64_t faces = 0;
    std::uint64_t vertices = 0;
    std::uint64_t cut_vertices = 0;   ///< Vertices that stand in `out` more than once, once per fan.
    std::uint64_t refused_faces = 0;  ///< That OpenMesh did not take all the same; none is known.
};

/// Makes the OpenMesh surface of all kept triangles, one vertex per fan. Vertices at cuts are locked.
///
/// expects: `half_edges` is of `mesh`.
/// cost:    O(n); allocates.
inline Conversion to_openmesh(Triangles const& mesh, HalfEdges const& half_edges, OpenMeshSurface& out) {
    Fans const fans = find_fans(half_edges);
    out.clear();
    out.request_vertex_status();
    Conversion done;
    done.cut_vertices = fans.split_vertices;
    std::vector<OpenMeshSurface::VertexHandle> vertices;
    for (std::uint32_t const v : fans.vertex_of) {
        math::vec3 const& p = mesh.positions[v];
        vertices.push_back(out.add_vertex(OpenMeshSurface::Point(p.x, p.y, p.z)));
        out.status(vertices.back()).set_locked(fans.of_vertex[v] > 1);
    }
    for (std::size_t t = 0; t < mesh.size(); ++t) {
        if (half_edges.fate[t] != Fate::kept) continue;
        auto const at = [&](std::size_t k) { return vertices[fans.fan_of[3 * t + k]]; };
        bool const taken = out.add_face(at(0), at(1), at(2)).is_valid();
        done.faces += taken ? 1U : 0U;
        done.refused_faces += taken ? 0U : 1U;
    }
    done.vertices = vertices.size();
    return done;
}

/// Triangles of one's own, as indices.
struct IndexedMesh {
    std::vector<math::vec3> positions;
    std::vector<std::uint32_t> indices;

    [[nodiscard]] Triangles triangles() const noexcept { return {positions, indices}; }
};

/// All vertices and faces that are not deleted, in OpenMesh's order.
[[nodiscard]] inline IndexedMesh from_openmesh(OpenMeshSurface const& surface) {
    IndexedMesh mesh;
    std::vector<std::uint32_t> place(surface.n_vertices(), no_index);
    for (auto const v : surface.vertices()) {
        place[static_cast<std::size_t>(v.idx())] = static_cast<std::uint32_t>(mesh.positions.size());
        auto const& p = surface.point(v);
        mesh.positions.emplace_back(p[0], p[1], p[2]);
    }
    for (auto const face : surface.faces())
        for (auto const v : face.vertices()) mesh.indices.push_back(place[static_cast<std::size_t>(v.idx())]);
    return mesh;
}

struct LodConfig {
    std::span<double const> ratios;  ///< Triangles wanted, as parts of the kept ones: in (0, 1], falling.
    double max_error_m = std::numeric_limits<double>::infinity();  ///< Of the distance both ways, its upper bound.
    bool lock_borders = true;        ///< Vertices of edges that are not manifold stay: borders neither shrink nor open.
    DeviationConfig measure = {};
};

/// A level of detail, and how far it is from the whole mesh, measured both ways (deviation.hpp).
struct Lod {
    IndexedMesh mesh;
    Deviation from_whole;  ///< The farthest that a point of the whole mesh is from this one.
    Deviation to_whole;    ///< The farthest that a point of this one is from the whole mesh.

    [[nodiscard]] double error_m() const noexcept { return std::max(from_whole.at_most_m, to_whole.at_most_m); }
};

namespace detail {

class LodMaker {
public:
    LodMaker(Triangles const& whole, HalfEdges const& half_edges, LodConfig const& config) : whole_(whole), config_(config) {
        static_cast<void>(to_openmesh(whole, half_edges, surface_));
        surface_.request_face_normals();
        surface_.update_face_normals();
        if (!config.lock_borders) return;
        for (auto const v : surface_.vertices())
            if (surface_.is_boundary(v)) surface_.status(v).set_locked(true);
    }

    [[nodiscard]] std::size_t faces() const noexcept { return surface_.n_faces(); }

    [[nodiscard]] Lod make(std::size_t target_faces) const {
        OpenMeshSurface surface = surface_;
        {
            OpenMesh::Decimater::DecimaterT<OpenMeshSurface> decimater(surface);
            OpenMesh::Decimater::ModQuadricT<OpenMeshSurface>::Handle quadric;
            OpenMesh::Decimater::ModNormalFlippingT<OpenMeshSurface>::Handle flipping;
            decimater.add(quadric);
            decimater.add(flipping);
            decimater.module(quadric).unset_max_err();
            if (decimater.initialize()) decimater.decimate_to_faces(0, target_faces);
            surface.garbage_collection();  // while the decimater keeps the status flags alive
        }
        Lod lod;
        lod.mesh = from_openmesh(surface);
        lod.from_whole = deviation(whole_, lod.mesh.triangles(), config_.measure);
        lod.to_whole = deviation(lod.mesh.triangles(), whole_, config_.measure);
        return lod;
    }

    /// The coarsest that is found to keep `max_error_m`, with more than `too_few` faces and less than `enough`; 6 tries.
    [[nodiscard]] bool bisect(std::size_t too_few, std::size_t enough, Lod& out) const {
        bool found = false;
        for (int i = 0; i < 6 && too_few + 1 < enough; ++i) {
            std::size_t const middle = too_few + (enough - too_few) / 2;
            Lod lod = make(middle);
            bool const good = lod.error_m() <= config_.max_error_m;
            (good ? enough : too_few) = middle;
            found = found || good;
            if (good) out = std::move(lod);
        }
        return found;
    }

private:
    Triangles whole_;
    LodConfig config_;
    OpenMeshSurface surface_;
};

}  // namespace detail

/// Levels of detail of a shadow caster: one per ratio, until one would be no smaller than the one before, or farther
/// from `mesh` than `max_error_m`; then a last one, the coarsest that is found to keep it.
///
/// expects: ratios in (0, 1], falling.
/// returns: LODs with fewer and fewer triangles, each a subset of the places of `mesh`. Closed meshes stay closed. A
///          LOD can have more triangles than its ratio asks for: topology, borders and normals (no triangle turns by more
///          than 90 degrees in one step) are kept.
/// cost:    a decimation and two measurements per LOD, each O(n log n); allocates.
[[nodiscard]] inline std::vector<Lod> make_lods(Triangles const& mesh, LodConfig const& config) {
    HalfEdges const half_edges = build_half_edges(mesh);
    detail::LodMaker const maker(mesh, half_edges, config);
    std::vector<Lod> lods;
    std::size_t before = maker.faces();
    for (std::size_t i = 0; i < config.ratios.size() && maker.faces() != 0; ++i) {
        double const ratio = config.ratios[i];
        GNOMON_EXPECT(ratio > 0.0 && ratio <= 1.0 && (i == 0 || ratio < config.ratios[i - 1]));
        auto const target = static_cast<std::size_t>(std::ceil(ratio * static_cast<double>(maker.faces())));
        Lod lod = maker.make(target);
        if (!lods.empty() && lod.mesh.indices.size() >= lods.back().mesh.indices.size()) break;
        bool const good = lod.error_m() <= config.max_error_m;
        if (good || maker.bisect(target, before, lod)) lods.push_back(std::move(lod));
        if (!good) break;
        before = target;
    }
    return lods;
}

}  // namespace gnomon::mesh
