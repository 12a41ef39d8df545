#include <gnomon/check/check.hpp>
#include <gnomon/mesh/fans.hpp>

#include "meshes.hpp"

#include <set>
#include <utility>

using namespace gnomon;

namespace {

/// Fans per vertex by joining corners until nothing changes, through shared manifold edges.
std::size_t fans_by_joining(mesh::HalfEdges const& m) {
    std::vector<std::uint32_t> label(m.from.size());
    for (std::uint32_t h = 0; h < label.size(); ++h) label[h] = h;
    for (bool changed = true; changed;) {
        changed = false;
        for (std::uint32_t h = 0; h < label.size(); ++h) {
            if (m.twin[h] == mesh::no_index) continue;
            // Both ends of the edge: the corners of the two triangles at the same vertex.
            for (auto const& [a, b] : {std::pair(h, mesh::next(m.twin[h])), std::pair(mesh::next(h), m.twin[h])}) {
                std::uint32_t const lower = std::min(label[a], label[b]);
                changed = changed || label[a] != lower || label[b] != lower;
                label[a] = label[b] = lower;
            }
        }
    }
    std::set<std::uint32_t> fans;
    for (std::uint32_t h = 0; h < label.size(); ++h)
        if (m.fate[mesh::triangle_of(h)] == mesh::Fate::kept) fans.insert(label[h]);
    return fans.size();
}

}  // namespace

TEST_CASE("a manifold has one fan a vertex", "[mesh]") {
    for (meshes::Mesh const& m : {meshes::sphere(6), meshes::sheet(5)}) {
        mesh::HalfEdges const built = mesh::build_half_edges(m.list());
        mesh::Fans const fans = find_fans(built);
        CHECK(fans.split_vertices == 0);
        CHECK(fans.vertex_of.size() == m.positions.size() - built.report.welded_vertices);
        CHECK(fans.vertex_of.size() == fans_by_joining(built));
    }
}

TEST_CASE("surfaces that meet in a point or along an edge split its vertices", "[mesh]") {
    meshes::Mesh tips = meshes::tetrahedron();
    tips.append(meshes::tetrahedron(), math::vec3(1.0F, 0.0F, 0.0F));  // vertex 1 of one is vertex 0 of the other
    mesh::Fans const at_a_point = find_fans(mesh::build_half_edges(tips.list()));
    CHECK(at_a_point.split_vertices == 1);
    CHECK(at_a_point.of_vertex[1] == 2);

    meshes::Mesh fin = meshes::sheet(4);
    fin.positions.emplace_back(0.0F, 5.0F, 0.0F);
    fin.add({12, 13, static_cast<std::uint32_t>(fin.positions.size() - 1)});
    mesh::HalfEdges const built = mesh::build_half_edges(fin.list());
    mesh::Fans const along_an_edge = find_fans(built);
    CHECK(built.report.non_manifold_edges == 1);
    CHECK(along_an_edge.split_vertices == 2);
    CHECK(along_an_edge.vertex_of.size() == fans_by_joining(built));
}
